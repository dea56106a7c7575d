//! `cargo xtask dist`: the archives that users get, and what package managers want.
//!
//! ```text
//! web/, gonio-web   cargo xtask web                  dist/, which gonio's build script embeds
//! gonio             cargo, profile `dist`            one executable
//!                   gonio completions, gonio man     scripts of shells, manual pages
//!                   archive                          target/packages/gonio-VERSION-TARGET.tar.gz or .zip
//! gonio-python      maturin, profile `dist`          with --wheel: target/packages/gonio-VERSION-cp311-abi3-SYSTEM.whl
//!                   sha256, manifests                SHA256SUMS; packaging/ filled in: target/packages/manifests
//! ```

pub mod archive;
pub mod manifests;
pub mod sha256;
pub mod trial;
mod wheel;

use crate::target::target_folder;
use crate::web;
use crate::{book, process, root};
use archive::ArchiveFile;
use manifests::Release;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The targets of a release. The last is the two executables of macOS in one file.
pub const TARGETS: &[&str] = &["x86_64-unknown-linux-gnu", "x86_64-pc-windows-gnu", UNIVERSAL];
const UNIVERSAL: &str = "universal-apple-darwin";
const UNIVERSAL_PARTS: [&str; 2] = ["aarch64-apple-darwin", "x86_64-apple-darwin"];

/// Completion scripts: the shell, and the name by which it looks for one.
const SHELLS: &[(&str, &str)] =
    &[("bash", "gonio.bash"), ("zsh", "_gonio"), ("fish", "gonio.fish"), ("powershell", "_gonio.ps1")];

/// Files of the repository that accompany the program.
const DOCUMENTS: &[(&str, &str)] = &[
    ("README.md", "README.md"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    ("LICENSE-MIT", "LICENSE-MIT"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("crates/gonio/THIRD-PARTY.txt", "THIRD-PARTY.txt"),
];

/// Options of `cargo xtask dist`.
#[derive(Debug, Default, PartialEq, Eq)]
struct Options {
    /// The target; the host's by default.
    target: Option<String>,
    /// Embed the page that is in `dist/` instead of building one.
    built_page: bool,
    /// Write the sums and manifests of the archives that are there, and build nothing.
    only_manifests: bool,
    /// Build the wheel of the Python package instead of the archive.
    wheel: bool,
}

fn options(words: &[&str]) -> Result<Options, String> {
    let mut options = Options::default();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        match *word {
            "--target" => options.target = Some(words.next().ok_or("--target needs a target")?.to_string()),
            "--built-page" => options.built_page = true,
            "--manifests" => options.only_manifests = true,
            "--wheel" => options.wheel = true,
            _ => {
                return Err(format!(
                    "unknown option `{word}`; the options are --target T, --built-page, --manifests, --wheel"
                ));
            }
        }
    }
    Ok(options)
}

pub fn run(words: &[&str]) -> ExitCode {
    let root = root();
    match options(words).and_then(|options| make(&root, &options, &mut |step| println!("{step}"))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: dist: {}", error.trim_end());
            ExitCode::from(2)
        }
    }
}

fn make(root: &Path, options: &Options, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let package = Package::read(root)?;
    let folder = packages_folder(root);
    std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    if options.wheel {
        let target = options.target.clone().map_or_else(|| host(root), Ok)?;
        let wheel = wheel::build(root, &target, say)?;
        say(&wheel.display().to_string());
    } else if !options.only_manifests {
        if !options.built_page {
            web::build_page(root, web::Build::Shipped, say)?;
        }
        let target = options.target.clone().map_or_else(|| host(root), Ok)?;
        if !TARGETS.contains(&target.as_str()) {
            say(&format!("no manifest names an archive of {target}, only those of {}", TARGETS.join(", ")));
        }
        let archive = build(root, &package, &target, say)?;
        say(&archive.display().to_string());
    }
    let release = Release::read(&folder, &package.version, &package.repository)?;
    let (files, left_out) = release.write(&root.join("packaging"), &folder)?;
    for file in files {
        say(&file.display().to_string());
    }
    for line in left_out {
        say(&line);
    }
    Ok(())
}

/// Where archives and manifests are written.
pub fn packages_folder(root: &Path) -> PathBuf {
    target_folder(root).join("packages")
}

/// The file name of a target's archive.
pub fn archive_name(version: &str, target: &str) -> String {
    let extension = if target.contains("windows") { "zip" } else { "tar.gz" };
    format!("gonio-{version}-{target}.{extension}")
}

/// What the manifest of `gonio` states.
pub struct Package {
    /// The version.
    pub version: String,
    /// The address of the repository.
    pub repository: String,
}

impl Package {
    /// Asks Cargo.
    pub fn read(root: &Path) -> Result<Package, String> {
        let arguments = ["metadata", "--locked", "--no-deps", "--format-version", "1"];
        let json = process::stdout_of(process::cargo(root).args(arguments))?;
        let metadata: serde_json::Value =
            serde_json::from_str(&json).map_err(|error| format!("cargo metadata: {error}"))?;
        let gonio =
            metadata["packages"].as_array().and_then(|all| all.iter().find(|package| package["name"] == "gonio"));
        let text = |key: &str| gonio.and_then(|gonio| Some(gonio[key].as_str()?.to_owned()));
        match (text("version"), text("repository")) {
            (Some(version), Some(repository)) => Ok(Package { version, repository }),
            _ => Err("cargo metadata: gonio has no version or no repository".into()),
        }
    }
}

/// The target that programs are built for by default.
pub fn host(root: &Path) -> Result<String, String> {
    let version = process::stdout_of(process::cargo(root).arg("-vV"))?;
    let line = version.lines().find_map(|line| line.strip_prefix("host: "));
    line.map(str::to_owned).ok_or_else(|| "`cargo -vV` names no host".into())
}

/// Builds a target's archive, with the page in `dist/`; returns its path.
pub fn build(root: &Path, package: &Package, target: &str, say: &mut dyn FnMut(&str)) -> Result<PathBuf, String> {
    if !root.join("dist/index.html").is_file() {
        return Err("there is no page in dist to embed: `cargo xtask web` builds it".into());
    }
    let program = match target {
        UNIVERSAL => universal(root, say)?,
        target => compile(root, target, say)?,
    };
    say("writing completions and manual pages");
    let runs_here = target == host(root)? || target == UNIVERSAL;
    // Completions and manual pages are the same on every system.
    let generator = if runs_here { program.clone() } else { book::program(root)? };
    let top = format!("gonio-{}-{target}", package.version);
    let mut files = accompanying(root, &generator, &top)?;
    let exe = if target.contains("windows") { ".exe" } else { "" };
    files.push(ArchiveFile { name: format!("{top}/gonio{exe}"), bytes: read(&program)?, executable: true });
    let time = time(root)?;
    let name = archive_name(&package.version, target);
    let bytes = if name.ends_with(".zip") { archive::zip(&files, time) } else { archive::tar_gz(&files, time) }?;
    let path = packages_folder(root).join(name);
    std::fs::create_dir_all(packages_folder(root))
        .and_then(|()| std::fs::write(&path, bytes))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(path)
}

/// Compiles the program with the profile `dist`; returns its path.
fn compile(root: &Path, target: &str, say: &mut dyn FnMut(&str)) -> Result<PathBuf, String> {
    say(&format!("building gonio for {target}"));
    let mut cargo = process::cargo(root);
    cargo.args(["build", "--locked", "--package", "gonio", "--profile", "dist", "--target", target]);
    cargo.arg("--config").arg(format!("target.{target}.rustflags=[{}]", without_paths(root).join(", ")));
    let outcome = process::run(&mut cargo);
    if !outcome.success {
        return Err(outcome.text);
    }
    let exe = if target.contains("windows") { ".exe" } else { "" };
    Ok(target_folder(root).join(target).join("dist").join(format!("gonio{exe}")))
}

/// Options of rustc, as TOML, that leave this machine's paths out of the program: messages of panics contain them.
fn without_paths(root: &Path) -> Vec<String> {
    let cargo_home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let cargo_home = cargo_home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo"))).unwrap_or_default();
    let mut prefixes = vec![(root.to_owned(), "gonio")];
    let sources = cargo_home.join("registry/src");
    let registries = std::fs::read_dir(&sources).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    prefixes.extend(registries.map(|registry| (registry, "crates")));
    // The last prefix that fits counts: a target folder or registry inside of the repository has its own.
    prefixes.sort();
    prefixes.iter().map(|(path, name)| format!("'--remap-path-prefix={}={name}'", path.display())).collect()
}

/// The executable of macOS for both of its processors.
fn universal(root: &Path, say: &mut dyn FnMut(&str)) -> Result<PathBuf, String> {
    let mut parts = Vec::new();
    for target in UNIVERSAL_PARTS {
        parts.push(compile(root, target, say)?);
    }
    let folder = target_folder(root).join(UNIVERSAL).join("dist");
    std::fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let program = folder.join("gonio");
    process::stdout_of(Command::new("lipo").args(["-create", "-output"]).arg(&program).args(&parts))?;
    Ok(program)
}

/// Everything but the program.
fn accompanying(root: &Path, generator: &Path, top: &str) -> Result<Vec<ArchiveFile>, String> {
    let file = |name: String, bytes| ArchiveFile { name: format!("{top}/{name}"), bytes, executable: false };
    let mut files = Vec::new();
    for (from, to) in DOCUMENTS {
        files.push(file((*to).to_owned(), read(&root.join(from))?));
    }
    for (shell, name) in SHELLS {
        let script = process::stdout_of(Command::new(generator).args(["completions", shell]))?;
        files.push(file(format!("completions/{name}"), script.into_bytes()));
    }
    let manual = packages_folder(root).join("man");
    crate::cases::empty_folder(&manual)?;
    process::stdout_of(Command::new(generator).arg("man").arg(&manual))?;
    let entries = std::fs::read_dir(&manual).map_err(|error| format!("cannot read {}: {error}", manual.display()))?;
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        files.push(file(format!("man/{name}"), read(&path)?));
    }
    Ok(files)
}

/// The time of every file in an archive, in seconds since 1970: that of the commit.
fn time(root: &Path) -> Result<u64, String> {
    let text = match std::env::var("SOURCE_DATE_EPOCH") {
        Ok(text) => text,
        Err(_) => process::stdout_of(Command::new("git").current_dir(root).args(["log", "-1", "--format=%ct"]))?,
    };
    text.trim().parse().map_err(|_| format!("`{}` is not a time in seconds since 1970", text.trim()))
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn options_are_read_and_others_refused() {
        assert_eq!(options(&[]).unwrap(), Options::default());
        let expected = Options { target: Some("t".into()), built_page: true, only_manifests: true, wheel: true };
        assert_eq!(options(&["--built-page", "--target", "t", "--manifests", "--wheel"]).unwrap(), expected);
        assert!(options(&["--target"]).is_err());
        assert!(options(&["--tarket", "t"]).unwrap_err().contains("--tarket"));
    }

    #[test]
    fn every_file_that_states_the_version_states_the_same() {
        let root = crate::root();
        let version = Package::read(&root).unwrap().version;
        for (path, line) in [
            ("CITATION.cff", format!("version: {version}")),
            ("editors/vscode/package.json", format!("\"version\": \"{version}\"")),
        ] {
            let text = std::fs::read_to_string(root.join(path)).unwrap();
            assert!(text.contains(&line), "{path} does not state `{line}`");
        }
    }

    #[test]
    fn an_archive_has_what_accompanies_the_program() {
        let root = crate::root();
        for (path, _) in DOCUMENTS {
            assert!(root.join(path).is_file(), "{path}");
        }
        assert_eq!(archive_name("1.0.0", "x86_64-pc-windows-gnu"), "gonio-1.0.0-x86_64-pc-windows-gnu.zip");
        assert_eq!(archive_name("1.0.0", UNIVERSAL), "gonio-1.0.0-universal-apple-darwin.tar.gz");
    }
}
