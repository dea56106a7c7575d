//! The lints that only declared files may allow.
//!
//! The compiler and clippy find `unsafe` code, output, and calls that read the environment (`[workspace.lints]` and
//! `clippy.toml`). They cannot find code that switches them off in a new place.

use super::source::{Source, TextFile, find_words};

/// The files that may use `unsafe`.
pub const UNSAFE_CODE: &[&str] = &[
    "crates/gonio-gl/src/capture.rs",
    "crates/gonio-gl/src/functions.rs",
    "crates/gonio-gl/src/headless/cgl.rs",
    "crates/gonio-gl/src/headless/egl.rs",
    "crates/gonio-gl/src/headless/wgl.rs",
    "crates/gonio-python/src/array.rs",
    "crates/gonio-scene/src/files/disk.rs",
];

/// The file that prints.
const REPORT: &[&str] = &["crates/gonio/src/report.rs"];
/// The file that prints, and a test that prints its measurements.
const REPORT_AND_TEST: &[&str] = &["crates/gonio/src/report.rs", "crates/gonio/tests/hostile/main.rs"];
/// The file that writes the terminal's escape sequences.
const TERMINAL: &[&str] = &["crates/gonio/src/terminal.rs"];

/// Lints, and the files that may allow them.
pub const GUARDED: &[(&str, &[&str])] = &[
    ("unsafe_code", UNSAFE_CODE),
    ("undocumented_unsafe_blocks", &[]),
    ("print_stdout", REPORT_AND_TEST),
    ("print_stderr", REPORT),
    ("dbg_macro", &[]),
    ("disallowed_methods", REPORT),
    ("disallowed_types", TERMINAL),
];

/// Clippy's configurations. One in a folder replaces those above it.
pub const CONFIGURATIONS: &[&str] = &[
    "crates/clippy.toml",
    "crates/gonio/clippy.toml",
    "crates/gonio-app/clippy.toml",
    "crates/gonio-fixtures/clippy.toml",
    "crates/gonio-python/clippy.toml",
];

/// Finds lints that are allowed outside their declared files, and configurations of clippy in other places.
pub fn check(files: &[TextFile], guarded: &[(&str, &[&str])], configurations: &[&str]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files.iter().filter(|f| f.is_rust()) {
        let source = Source::parse(&file.text);
        for (index, code) in source.code.iter().enumerate() {
            let permits = ["allow", "expect", "warn"].iter().any(|level| code.contains(&format!("{level}(")));
            // The list may go on over several lines.
            let continues = !code.contains('(') && code.trim_end().ends_with([',', ')', ']']);
            if !(permits || continues && in_attribute(&source, index)) {
                continue;
            }
            for (lint, places) in guarded {
                if find_words(code, lint).next().is_some() && !places.contains(&file.path.as_str()) {
                    complaints.push(format!("{}:{}: `{lint}` may not be allowed here", file.path, index + 1));
                }
            }
        }
    }
    for file in files.iter().filter(|f| f.path.rsplit('/').next().is_some_and(|name| name.ends_with("clippy.toml"))) {
        if !configurations.contains(&file.path.as_str()) {
            complaints.push(format!("{}: replaces the configuration of clippy above it", file.path));
        }
    }
    complaints
}

/// Whether a line continues an attribute that begins above it.
fn in_attribute(source: &Source, index: usize) -> bool {
    let above = source.code[..index].iter().rev().take_while(|code| !code.contains([';', '{', '}']));
    above.map(|code| code.trim_start()).any(|code| code.starts_with("#[") || code.starts_with("#!["))
}

/// Finds manifests of crates that do not take the workspace's lints, or at least deny `unsafe_code`.
pub fn check_manifests(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut seen = 0;
    for file in files.iter().filter(|f| f.path.ends_with("/Cargo.toml")) {
        seen += 1;
        let lines: Vec<&str> = file.text.lines().map(str::trim).collect();
        let inherits = lines.windows(2).any(|pair| pair == ["[lints]", "workspace = true"]);
        let own = lines.iter().any(|l| matches!(*l, "unsafe_code = \"deny\"" | "unsafe_code = \"forbid\""));
        if !inherits && !own {
            complaints.push(format!("{}: neither takes the workspace's lints nor denies `unsafe_code`", file.path));
        }
    }
    if seen == 0 {
        complaints.push("no crate's Cargo.toml was found".into());
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: path.into(), text: text.into() }
    }

    const LITTLE: &[(&str, &[&str])] = &[("unsafe_code", &["gl/memory.rs"]), ("print_stdout", &["report.rs"])];

    #[test]
    fn a_permission_outside_of_the_declared_files_is_found() {
        for text in [
            "#![allow(unsafe_code)]\n",
            "#[expect(unsafe_code, reason = \"none\")]\nfn f() {}\n",
            "#![allow(clippy::print_stdout, unsafe_code)]\n",
            "#![warn(unsafe_code)]\n",
        ] {
            let files = [file("report.rs", text), file("gl/memory.rs", "#![allow(unsafe_code)]\n")];
            assert_eq!(check(&files, LITTLE, &[]), ["report.rs:1: `unsafe_code` may not be allowed here"], "{text}");
        }
        let lines = "#![allow(\n    dead_code,\n    clippy::print_stdout,\n)]\n";
        assert_eq!(check(&[file("a.rs", lines)], LITTLE, &[]), ["a.rs:3: `print_stdout` may not be allowed here"]);
    }

    #[test]
    fn denials_comments_and_texts_are_no_permissions() {
        let text = "#![deny(unsafe_code)]\n// #![allow(unsafe_code)]\nconst A: &str = \"allow(unsafe_code)\";\n\
                    pub const B: &[&str] = &[\n    unsafe_code,\n];\n";
        assert!(check(&[file("a.rs", text)], LITTLE, &[]).is_empty());
    }

    #[test]
    fn another_configuration_of_clippy_is_found() {
        let files = [file("crates/clippy.toml", ""), file("crates/a/clippy.toml", ""), file("b/.clippy.toml", "")];
        assert_eq!(check(&files, LITTLE, &["crates/clippy.toml"]).len(), 2);
    }

    #[test]
    fn a_crate_that_leaves_the_lints_is_found() {
        let good = file("crates/a/Cargo.toml", "[lints]\nworkspace = true\n");
        let bad = file("crates/b/Cargo.toml", "[package]\nname = \"b\"\n[dependencies]\nc = { workspace = true }\n");
        assert!(check_manifests(std::slice::from_ref(&good)).is_empty());
        assert_eq!(check_manifests(&[good, bad]).len(), 1);
        assert_eq!(check_manifests(&[]).len(), 1);
    }
}
