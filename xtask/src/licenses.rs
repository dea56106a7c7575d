//! `cargo xtask licenses`: the third-party notices.
//!
//! The text is checked in, so that a build needs no network. A check of the house compares its lists with `Cargo.lock`.

use crate::process;
use crate::report::Findings;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The text that `gonio licenses` prints.
const NOTICES: &str = "crates/gonio/THIRD-PARTY.txt";

/// The crates of what is shipped: the command line, the page that it can contain, and the Python package.
const SHIPPED: [&str; 3] = ["gonio", "gonio-web", "gonio-python"];

const IN_GONIO: &str = "Crates in gonio";
const BESIDES: &str = "Crates that only build or test gonio";

const HEAD: &str = "\
Third-party notices of gonio

gonio is licensed under either of the MIT licence and the Apache License 2.0, at your choice. It contains the crates, fonts and
models of others that are listed here. Of crates that offer a choice of licences, gonio takes the Apache License 2.0 if offered.
The numbers in brackets refer to the licence texts at the end.
";

const ASSETS: &str = "\
Fonts (reduced to the characters that gonio uses)

Inter Regular and SemiBold        The Inter Project Authors                      OFL-1.1  https://rsms.me/inter
JetBrains Mono Regular            The JetBrains Mono Project Authors             OFL-1.1  https://www.jetbrains.com/lp/mono
KaTeX Main, Math Italic, Size2    Khan Academy and other contributors            OFL-1.1  https://katex.org
Phosphor Icons                    Helena Zhang and Tobias Fried                  MIT      https://phosphoricons.com

Models, textures, environments and scenes

Suzanne is the test model that Blender generates (https://www.blender.org); Blender makes no claim to what it generates. All other
models, textures, environments and scenes were made for gonio and have its licence.
";

/// A crate of the dependency graph.
struct Package {
    name: String,
    version: String,
    /// An SPDX expression, if the crate states one.
    license: String,
    authors: Vec<String>,
    repository: String,
    folder: PathBuf,
    is_ours: bool,
    is_proc_macro: bool,
    /// The ids of crates that it links.
    links: Vec<String>,
}

pub fn run(root: &Path) -> ExitCode {
    match write(root) {
        Ok(summary) => {
            println!("{summary}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("xtask: {error}");
            ExitCode::from(2)
        }
    }
}

/// The check that the lists in the notices match `Cargo.lock`.
pub fn step(root: &Path) -> Findings {
    let read = |name: &str| std::fs::read_to_string(root.join(name)).map_err(|error| format!("{name}: {error}"));
    match (read("Cargo.lock"), read(NOTICES)) {
        (Ok(lock), Ok(notices)) => Findings::of_complaints(&check(&lock, &notices)),
        (Err(error), _) | (_, Err(error)) => Findings::fail(error),
    }
}

fn write(root: &Path) -> Result<String, String> {
    let arguments = ["metadata", "--locked", "--format-version", "1"];
    let metadata = process::stdout_of(process::cargo(root).args(arguments))?;
    let packages = read_packages(&metadata)?;
    let lock = std::fs::read_to_string(root.join("Cargo.lock")).map_err(|error| format!("Cargo.lock: {error}"))?;
    let shipped = shipped(&packages)?;
    let text = notices(root, &shipped, &locked(&lock))?;
    let path = root.join(NOTICES);
    std::fs::write(&path, &text).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(format!("{}: {} crates, {} KiB", path.display(), shipped.len(), text.len() >> 10))
}

/// The crates in what `cargo metadata` prints, by their ids.
fn read_packages(json: &str) -> Result<BTreeMap<String, Package>, String> {
    let metadata: Value = serde_json::from_str(json).map_err(|error| format!("cargo metadata: {error}"))?;
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let mut packages = BTreeMap::new();
    for package in list(&metadata["packages"]) {
        let kinds: Vec<Value> = list(&package["targets"]).iter().flat_map(|target| list(&target["kind"])).collect();
        let manifest = PathBuf::from(text(&package["manifest_path"]));
        packages.insert(
            text(&package["id"]),
            Package {
                name: text(&package["name"]),
                version: text(&package["version"]),
                license: text(&package["license"]).replace('/', " OR "),
                authors: list(&package["authors"]).iter().map(text).collect(),
                repository: text(&package["repository"]),
                folder: manifest.parent().map(Path::to_owned).unwrap_or_default(),
                is_ours: package["source"].is_null(),
                is_proc_macro: kinds.iter().any(|kind| kind == "proc-macro"),
                links: Vec::new(),
            },
        );
    }
    for node in list(&metadata["resolve"]["nodes"]) {
        let links = list(&node["deps"]).into_iter().filter(|dependency| {
            // Neither tests nor build scripts are part of the program.
            list(&dependency["dep_kinds"]).iter().any(|kind| kind["kind"].is_null())
        });
        if let Some(package) = packages.get_mut(&text(&node["id"])) {
            package.links = links.map(|dependency| text(&dependency["pkg"])).collect();
        }
    }
    if packages.is_empty() { Err("cargo metadata: no packages".into()) } else { Ok(packages) }
}

/// Third-party crates in the shipped programs, on any platform, sorted.
fn shipped(packages: &BTreeMap<String, Package>) -> Result<Vec<&Package>, String> {
    let mut open: Vec<&str> = Vec::new();
    for name in SHIPPED {
        let root = packages.iter().find(|(_, package)| package.is_ours && package.name == name);
        open.push(root.map(|(id, _)| id.as_str()).ok_or_else(|| format!("cargo metadata: there is no crate {name}"))?);
    }
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        // A procedural macro runs in the compiler.
        if let Some(package) = packages.get(id).filter(|package| !package.is_proc_macro)
            && seen.insert(id)
        {
            open.extend(package.links.iter().map(String::as_str));
        }
    }
    let mut shipped: Vec<&Package> = seen.into_iter().filter_map(|id| packages.get(id)).collect();
    shipped.retain(|package| !package.is_ours);
    shipped.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    Ok(shipped)
}

fn notices(root: &Path, shipped: &[&Package], locked: &BTreeSet<String>) -> Result<String, String> {
    let mut texts = Texts::default();
    let read = |name: &str| std::fs::read_to_string(root.join(name)).map_err(|error| format!("{name}: {error}"));
    let (apache, mit) = (read("LICENSE-APACHE")?, read("LICENSE-MIT")?);
    let apache = texts.number(&apache);
    let mut numbers: Vec<Vec<usize>> = Vec::new();
    for package in shipped {
        let mut own = Vec::new();
        for file in license_files(package)? {
            let bytes = std::fs::read(&file).map_err(|error| format!("{}: {error}", file.display()))?;
            own.push(texts.number(&String::from_utf8_lossy(&bytes)));
        }
        numbers.push(own);
    }
    let mut crates = String::new();
    for (index, package) in shipped.iter().enumerate() {
        let mut own = numbers[index].clone();
        if own.is_empty() {
            // The crate's archive has no licence text. That of another crate is the same, except for the copyright holder of MIT.
            let same =
                shipped.iter().zip(&numbers).find(|(other, own)| other.license == package.license && own.len() == 1);
            own.push(match same {
                _ if offers(&package.license, "Apache-2.0") => apache,
                _ if offers(&package.license, "MIT") => texts.number(&mit_of(&mit, &package.authors.join(", "))),
                Some((_, own)) => own[0],
                None => return Err(format!("{}: there is no text of {}", package.folder.display(), package.license)),
            });
        }
        own.sort_unstable();
        own.dedup();
        let own: Vec<String> = own.iter().map(|number| format!("[{number}]")).collect();
        let fields =
            [format!("{} {}", package.name, package.version), package.license.clone(), package.repository.clone()];
        let fields = fields.into_iter().filter(|field| !field.is_empty()).chain([own.join(" ")]);
        crates.push_str(&(fields.collect::<Vec<_>>().join("  ") + "\n"));
    }
    let ofl = texts.number(&read("assets/fonts/OFL.txt")?);
    let icons = texts.number(&mit_of(&mit, "Phosphor Icons"));
    let listed: BTreeSet<String> =
        shipped.iter().map(|package| format!("{} {}", package.name, package.version)).collect();
    let besides: String = locked.difference(&listed).map(|name| format!("{name}\n")).collect();
    let fonts = format!("The texts of OFL-1.1 and MIT are [{ofl}] and [{icons}].\n");
    let mut all = format!("{HEAD}\n\n{IN_GONIO}\n\n{crates}\n\n{ASSETS}\n{fonts}\n\n{BESIDES}\n\n{besides}");
    for (index, text) in texts.all.iter().enumerate() {
        let _ = write!(all, "\n\n{}\n[{}]\n\n{}\n", "-".repeat(80), index + 1, text);
    }
    Ok(all)
}

/// Licence texts, each once.
#[derive(Default)]
struct Texts {
    all: Vec<String>,
    by_words: BTreeMap<String, usize>,
}

impl Texts {
    /// The number of a text; texts that differ in white space, or in the appendix of the Apache License, are the same.
    fn number(&mut self, text: &str) -> usize {
        // A form feed or a tab would be shown as an escape on a terminal.
        let text = text.replace(['\r', '\u{c}', '\u{feff}'], "").replace('\t', "    ");
        let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let words = apache_terms(&words).unwrap_or(words);
        *self.by_words.entry(words).or_insert_with(|| {
            self.all.push(lines.join("\n").trim_matches('\n').to_owned());
            self.all.len()
        })
    }
}

/// The terms of a text that consists of the Apache License, with or without its appendix, and nothing else.
fn apache_terms(words: &str) -> Option<String> {
    const END: &str = "END OF TERMS AND CONDITIONS";
    let (head, terms) = words.split_once("1. Definitions.")?;
    let (terms, appendix) = terms.split_once(END).unwrap_or((terms, ""));
    let is_alone = head.len() < 200 && appendix.split(' ').count() < 230 && !appendix.contains("xception");
    (head.contains("Apache License") && is_alone).then(|| terms.trim().to_lowercase())
}

/// The MIT licence with another holder of the copyright.
fn mit_of(mit: &str, holder: &str) -> String {
    let line = |line: &str| match line.starts_with("Copyright") {
        true => format!("Copyright (c) {holder}\n"),
        false => format!("{line}\n"),
    };
    mit.lines().map(line).collect()
}

/// Whether an SPDX expression offers this licence as a choice on its own.
fn offers(expression: &str, license: &str) -> bool {
    !expression.contains(" AND ") && expression.split(" OR ").any(|choice| choice.trim() == license)
}

/// The files with a crate's licence texts and notices; for a choice of licences, the Apache License only.
fn license_files(package: &Package) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    // Fonts are in a folder below, with licences of their own.
    list_licenses(&package.folder, 1, &mut files)?;
    files.sort();
    if offers(&package.license, "Apache-2.0") {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().to_ascii_uppercase();
        let is_apache = |path: &PathBuf| name(path).contains("APACHE") || name(path).starts_with("NOTICE");
        if files.iter().any(|path| name(path).contains("APACHE")) {
            files.retain(is_apache);
        }
    }
    Ok(files)
}

fn list_licenses(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<(), String> {
    const NAMES: [&str; 8] = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE", "OFL", "UFL"];
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name().to_string_lossy().to_ascii_uppercase();
        let kind = entry.file_type().map_err(failed)?;
        let is_text = !name.ends_with(".RS") && !name.ends_with(".HTML") && !name.ends_with(".JSON");
        if kind.is_file() && is_text && NAMES.iter().any(|known| name.starts_with(known)) {
            files.push(entry.path());
        } else if kind.is_dir() && depth > 0 && ["FONTS", "LICENSES"].contains(&name.as_str()) {
            list_licenses(&entry.path(), depth - 1, files)?;
        }
    }
    Ok(())
}

/// `NAME VERSION` of every third-party crate in `Cargo.lock`.
fn locked(lock: &str) -> BTreeSet<String> {
    let mut crates = BTreeSet::new();
    for package in lock.split("[[package]]").skip(1) {
        let value = |key: &str| {
            let line = package.lines().find_map(|line| line.strip_prefix(key)?.trim_start().strip_prefix('='));
            line.map(|value| value.trim().trim_matches('"').to_owned())
        };
        if let (Some(name), Some(version), Some(_)) = (value("name"), value("version"), value("source")) {
            crates.insert(format!("{name} {version}"));
        }
    }
    crates
}

/// `NAME VERSION` of every crate that the notices list under a heading.
fn listed(notices: &str, heading: &str) -> BTreeSet<String> {
    let lines = notices.lines().skip_while(|line| *line != heading).skip(2).take_while(|line| !line.is_empty());
    lines.map(|line| line.split_whitespace().take(2).collect::<Vec<_>>().join(" ")).collect()
}

/// Complaints about crates that are missing from the notices, or listed without being used.
fn check(lock: &str, notices: &str) -> Vec<String> {
    let locked = locked(lock);
    let listed: BTreeSet<String> = [IN_GONIO, BESIDES].iter().flat_map(|heading| listed(notices, heading)).collect();
    let missing = locked.difference(&listed).map(|name| format!("{NOTICES} lacks {name}; run `cargo xtask licenses`"));
    let extra = listed.difference(&locked);
    let extra =
        extra.map(|name| format!("{NOTICES} lists {name}, which is not in Cargo.lock; run `cargo xtask licenses`"));
    missing.chain(extra).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const LOCK: &str = "version = 4\n\n[[package]]\nname = \"ours\"\nversion = \"0.1.0\"\n\n[[package]]\nname = \"a\"\n\
                        version = \"1.0.0\"\nsource = \"registry+x\"\n\n[[package]]\nname = \"b\"\nversion = \"2.0.0\"\n\
                        source = \"registry+x\"\n";

    fn notices(shipped: &str, besides: &str) -> String {
        format!("head\n\n{IN_GONIO}\n\n{shipped}\n\n{BESIDES}\n\n{besides}\n\n---\n[1]\n\ntext\n")
    }

    #[test]
    fn lists_that_differ_from_the_lock_file_are_found() {
        assert_eq!(check(LOCK, &notices("a 1.0.0  MIT  x  [1]\n", "b 2.0.0\n")), [""; 0]);
        let complaints = check(LOCK, &notices("a 1.0.1  MIT  x  [1]\n", "b 2.0.0\n"));
        assert_eq!(complaints.len(), 2, "{complaints:?}");
        assert!(complaints[0].contains("lacks a 1.0.0") && complaints[1].contains("lists a 1.0.1"), "{complaints:?}");
        assert_eq!(check(LOCK, "").len(), 2);
    }

    #[test]
    fn a_choice_is_told_from_a_sum() {
        assert!(offers("MIT OR Apache-2.0", "Apache-2.0") && offers("MIT", "MIT"));
        assert!(!offers("(MIT OR Apache-2.0) AND OFL-1.1", "Apache-2.0") && !offers("Zlib", "MIT"));
    }

    #[test]
    fn the_apache_license_is_the_same_with_and_without_its_appendix() {
        let mut texts = Texts::default();
        let license = "Apache License Version 2.0\n1. Definitions.\nTerms.\n";
        let first = texts.number(license);
        assert_eq!(texts.number(&format!("{license}END OF TERMS AND CONDITIONS\nAPPENDIX: Copyright 2020 A")), first);
        assert_ne!(texts.number(&format!("{license}END OF TERMS AND CONDITIONS\nLLVM Exceptions")), first);
        assert_ne!(texts.number(&format!("{license}Other terms.")), first);
    }

    #[test]
    fn a_text_is_kept_once() {
        let mut texts = Texts::default();
        assert_eq!((texts.number("a  b\r\n c"), texts.number("a b c\n"), texts.number("a b d")), (1, 1, 2));
        assert_eq!(texts.all, ["a  b\n c", "a b d"]);
    }

    #[test]
    fn tests_build_scripts_and_macros_are_not_shipped() {
        let package = |id: &str, source: &str, kind: &str| {
            format!(
                r#"{{"id":"{id}","name":"{id}","version":"1.0.0","license":"MIT","authors":[],"repository":null,
                    "manifest_path":"/x/Cargo.toml","source":{source},"targets":[{{"kind":["{kind}"]}}]}}"#
            )
        };
        let packages = [
            package("gonio", "null", "bin"),
            package("gonio-web", "null", "lib"),
            package("gonio-python", "null", "lib"),
            package("a", "\"r\"", "lib"),
            package("macro", "\"r\"", "proc-macro"),
            package("syn", "\"r\"", "lib"),
            package("dev", "\"r\"", "lib"),
            package("build", "\"r\"", "lib"),
        ];
        let dependency = |id: &str, kind: &str| format!(r#"{{"pkg":"{id}","dep_kinds":[{{"kind":{kind}}}]}}"#);
        let deps = [("a", "null"), ("macro", "null"), ("dev", "\"dev\""), ("build", "\"build\"")]
            .map(|(id, kind)| dependency(id, kind));
        let json = format!(
            r#"{{"packages":[{}],"resolve":{{"nodes":[{{"id":"gonio","deps":[{}]}},{{"id":"macro","deps":[{}]}}]}}}}"#,
            packages.join(","),
            deps.join(","),
            dependency("syn", "null")
        );
        let packages = read_packages(&json).unwrap();
        let names: Vec<&str> = shipped(&packages).unwrap().iter().map(|package| package.name.as_str()).collect();
        assert_eq!(names, ["a"]);
    }
}
