//! What package managers want: the templates of `packaging/` with version, addresses and hashes.

use super::sha256;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Templates below `packaging/`, and where each is written below the folder of manifests.
const TEMPLATES: &[(&str, &str)] = &[
    ("Containerfile", "Containerfile"),
    ("homebrew/gonio.rb", "gonio.rb"),
    ("scoop/gonio.json", "gonio.json"),
    ("winget/Gonio.Gonio.installer.yaml", "winget/Gonio.Gonio.installer.yaml"),
    ("winget/Gonio.Gonio.locale.en-US.yaml", "winget/Gonio.Gonio.locale.en-US.yaml"),
    ("winget/Gonio.Gonio.yaml", "winget/Gonio.Gonio.yaml"),
];

/// The templates, filled in.
#[derive(Debug, Default)]
pub struct Filled {
    /// The manifests by their names.
    pub manifests: Vec<(&'static str, String)>,
    /// A sentence about each one whose archive is missing.
    pub left_out: Vec<String>,
}

/// The archives of one version.
pub struct Release {
    /// The version, without `v`.
    pub version: String,
    /// The address of the repository.
    pub repository: String,
    /// The hash of each archive, and of each wheel of the Python package, by its name.
    pub hashes: BTreeMap<String, String>,
}

impl Release {
    /// The release of the archives of `version` in a folder.
    pub fn read(folder: &Path, version: &str, repository: &str) -> Result<Release, String> {
        let unread = |error| format!("cannot read {}: {error}", folder.display());
        let mut hashes = BTreeMap::new();
        for entry in std::fs::read_dir(folder).map_err(unread)? {
            let path = entry.map_err(unread)?.path();
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let is_archive = [".tar.gz", ".zip", ".whl"].iter().any(|end| name.ends_with(end));
            if is_archive && name.starts_with(&format!("gonio-{version}-")) {
                let bytes = std::fs::read(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
                hashes.insert(name, sha256::hex(&bytes));
            }
        }
        Ok(Release { version: version.to_owned(), repository: repository.to_owned(), hashes })
    }

    /// The text of `SHA256SUMS`, which `sha256sum -c` reads.
    pub fn sums(&self) -> String {
        self.hashes.iter().map(|(name, hash)| format!("{hash}  {name}\n")).collect()
    }

    /// A template with everything filled in. `Err(Some(name))`: that archive is missing; `Err(None)`: the template is damaged.
    fn fill(&self, template: &str) -> Result<String, Option<String>> {
        let mut text = String::with_capacity(template.len());
        let mut rest = template;
        while let Some((before, after)) = rest.split_once("{{") {
            let (key, behind) = after.split_once("}}").ok_or(None)?;
            text += before;
            text += &match key.split_once(':') {
                Some(("url", target)) => {
                    let name = self.archive(target)?;
                    format!("{}/releases/download/v{}/{name}", self.repository, self.version)
                }
                Some(("sha256", target)) => self.hashes[&self.archive(target)?].clone(),
                None if key == "version" => self.version.clone(),
                None if key == "tag" => format!("v{}", self.version),
                None if key == "repository" => self.repository.clone(),
                _ => return Err(None),
            };
            rest = behind;
        }
        Ok(text + rest)
    }

    /// The name of a target's archive, if it is there; otherwise the name as the error.
    fn archive(&self, target: &str) -> Result<String, Option<String>> {
        let name = super::archive_name(&self.version, target);
        if self.hashes.contains_key(&name) { Ok(name) } else { Err(Some(name)) }
    }

    /// The templates, as far as the archives are there.
    pub fn manifests(&self, packaging: &Path) -> Result<Filled, String> {
        let mut filled = Filled::default();
        for (from, to) in TEMPLATES {
            let path = packaging.join(from);
            let template =
                std::fs::read_to_string(&path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
            match self.fill(&template) {
                Ok(text) => filled.manifests.push((*to, text)),
                Err(Some(archive)) => filled.left_out.push(format!("{to}: left out, because {archive} is missing")),
                Err(None) => return Err(format!("{}: an unknown or unfinished `{{{{...}}}}`", path.display())),
            }
        }
        Ok(filled)
    }

    /// Writes `SHA256SUMS` and the manifests into the archives' folder; returns the files, and a sentence about each manifest that
    /// was left out.
    pub fn write(&self, packaging: &Path, folder: &Path) -> Result<(Vec<PathBuf>, Vec<String>), String> {
        let Filled { manifests, left_out } = self.manifests(packaging)?;
        let mut files = vec![(folder.join("SHA256SUMS"), self.sums())];
        files.extend(manifests.into_iter().map(|(name, text)| (folder.join("manifests").join(name), text)));
        for (path, text) in &files {
            let parent = path.parent().unwrap_or(folder);
            std::fs::create_dir_all(parent)
                .and_then(|()| std::fs::write(path, text))
                .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        }
        Ok((files.into_iter().map(|(path, _)| path).collect(), left_out))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::dist::{TARGETS, archive_name};
    use crate::process;
    use std::process::Command;

    const REPOSITORY: &str = "https://example.org/gonio";

    /// A folder with an archive of a few bytes for each target, removed when this is dropped.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str, targets: &[&str]) -> Folder {
            let folder = std::env::temp_dir().join(format!("gonio-{name}-{}", std::process::id()));
            std::fs::create_dir_all(&folder).unwrap();
            for target in targets {
                std::fs::write(folder.join(archive_name("1.2.3", target)), target).unwrap();
            }
            Folder(folder)
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            std::fs::remove_dir_all(&self.0).unwrap();
        }
    }

    fn packaging() -> PathBuf {
        crate::root().join("packaging")
    }

    #[test]
    fn the_sums_are_those_of_sha256sum() {
        let folder = Folder::new("sums", TARGETS);
        // Neither is an archive of this version.
        std::fs::write(folder.0.join("gonio-1.2.2-x86_64-unknown-linux-gnu.tar.gz"), "old").unwrap();
        std::fs::write(folder.0.join("notes.txt"), "notes").unwrap();
        let release = Release::read(&folder.0, "1.2.3", REPOSITORY).unwrap();
        release.write(&packaging(), &folder.0).unwrap();
        assert_eq!(release.sums().lines().count(), TARGETS.len());
        let check = process::stdout_of(Command::new("sha256sum").args(["-c", "SHA256SUMS"]).current_dir(&folder.0));
        assert_eq!(check.unwrap().matches(": OK").count(), TARGETS.len());
    }

    #[test]
    fn manifests_name_the_version_and_each_archive_with_its_hash() {
        let folder = Folder::new("manifests", TARGETS);
        let release = Release::read(&folder.0, "1.2.3", REPOSITORY).unwrap();
        let Filled { manifests, left_out } = release.manifests(&packaging()).unwrap();
        assert!(left_out.is_empty(), "{left_out:?}");
        assert_eq!(manifests.len(), TEMPLATES.len());
        let text = |name: &str| manifests.iter().find(|(known, _)| *known == name).unwrap().1.clone();
        for (name, text) in &manifests {
            assert!(text.contains("1.2.3") && !text.contains("{{"), "{name}: {text}");
        }
        let pair = |target: &str| {
            let name = archive_name("1.2.3", target);
            (format!("{REPOSITORY}/releases/download/v1.2.3/{name}"), release.hashes[&name].clone())
        };
        let (mac, linux, windows) =
            (pair("universal-apple-darwin"), pair("x86_64-unknown-linux-gnu"), pair("x86_64-pc-windows-gnu"));
        for (name, archives) in [
            ("gonio.rb", vec![&mac, &linux]),
            ("gonio.json", vec![&windows]),
            ("winget/Gonio.Gonio.installer.yaml", vec![&windows]),
            ("Containerfile", vec![&linux]),
        ] {
            for (url, hash) in archives {
                assert!(text(name).contains(url.as_str()) && text(name).contains(hash.as_str()), "{name}");
            }
        }
        let scoop: serde_json::Value = serde_json::from_str(&text("gonio.json")).unwrap();
        assert_eq!(scoop["architecture"]["64bit"]["hash"], windows.1);
    }

    #[test]
    fn a_manifest_without_its_archive_is_left_out() {
        let folder = Folder::new("partial", &["x86_64-unknown-linux-gnu"]);
        let release = Release::read(&folder.0, "1.2.3", REPOSITORY).unwrap();
        let Filled { manifests, left_out } = release.manifests(&packaging()).unwrap();
        let names: Vec<&str> = manifests.iter().map(|(name, _)| *name).collect();
        assert!(names.contains(&"Containerfile") && !names.contains(&"gonio.rb") && !names.contains(&"gonio.json"));
        assert!(left_out.iter().any(|line| line.contains("gonio-1.2.3-universal-apple-darwin.tar.gz")), "{left_out:?}");
    }

    #[test]
    fn a_damaged_template_is_an_error() {
        let release = Release { version: "1".into(), repository: REPOSITORY.into(), hashes: BTreeMap::new() };
        for bad in ["{{version", "{{versoin}}", "{{sha1:x}}"] {
            assert_eq!(release.fill(bad), Err(None), "{bad}");
        }
        assert_eq!(release.fill("a {{version}} {{tag}} b"), Ok("a 1 v1 b".to_owned()));
    }

    /// What `cargo binstall` makes of the crate's metadata must be an archive that exists.
    #[test]
    fn binstall_finds_the_archives() {
        let json = process::stdout_of(process::cargo(&crate::root()).args([
            "metadata",
            "--locked",
            "--no-deps",
            "--format-version",
            "1",
        ]));
        let metadata: serde_json::Value = serde_json::from_str(&json.unwrap()).unwrap();
        let gonio = metadata["packages"].as_array().unwrap().iter().find(|package| package["name"] == "gonio").unwrap();
        let binstall = &gonio["metadata"]["binstall"];
        let (version, repository) = (gonio["version"].as_str().unwrap(), gonio["repository"].as_str().unwrap());
        for (target, archived_as) in [
            ("x86_64-unknown-linux-gnu", "x86_64-unknown-linux-gnu"),
            ("x86_64-pc-windows-gnu", "x86_64-pc-windows-gnu"),
            ("x86_64-pc-windows-msvc", "x86_64-pc-windows-gnu"),
            ("aarch64-apple-darwin", "universal-apple-darwin"),
            ("x86_64-apple-darwin", "universal-apple-darwin"),
        ] {
            let value = |key: &str| {
                let own = binstall["overrides"][target][key].as_str();
                own.or_else(|| binstall[key].as_str()).unwrap().to_owned()
            };
            let (suffix, exe) = if value("pkg-fmt") == "zip" { (".zip", ".exe") } else { (".tar.gz", "") };
            let expand = |text: String| {
                [("name", "gonio"), ("bin", "gonio"), ("repo", repository), ("version", version), ("target", target)]
                    .into_iter()
                    .chain([("archive-suffix", suffix), ("binary-ext", exe)])
                    .fold(text, |text, (key, value)| text.replace(&format!("{{ {key} }}"), value))
            };
            let name = archive_name(version, archived_as);
            assert_eq!(expand(value("pkg-url")), format!("{repository}/releases/download/v{version}/{name}"));
            assert_eq!(expand(value("bin-dir")), format!("gonio-{version}-{archived_as}/gonio{exe}"));
        }
    }
}
