//! The crates that others would use are packed as for a registry, and each package is compiled by itself.

use crate::process;
use crate::report::Findings;
use std::path::Path;

/// The crates: those in `[workspace.dependencies]` with a version.
const CRATES: &[&str] = &["gonio-light", "gonio-threads", "gonio-mesh", "gonio-glsl"];

/// `cargo publish --dry-run`, which uploads nothing. Warnings are failures: they name metadata that is missing.
pub fn step(root: &Path) -> Findings {
    let mut cargo = process::cargo(root);
    // A working tree in development is not committed.
    cargo.args(["publish", "--dry-run", "--locked", "--allow-dirty"]);
    for krate in CRATES {
        cargo.args(["--package", krate]);
    }
    let outcome = process::run(&mut cargo);
    let complaints = complaints(&outcome.text);
    match outcome.success {
        false => Findings::fail(outcome.text),
        true if complaints.is_empty() => Findings { passed: CRATES.len(), ..Findings::default() },
        true => Findings::of_complaints(&complaints),
    }
}

/// The warnings in Cargo's output, but for the one that every dry run ends with, and those that tests and their fixtures are not packed.
fn complaints(text: &str) -> Vec<String> {
    let expected = ["warning: aborting upload due to dry run", "warning: ignoring test "];
    let warnings = text.lines().filter(|line| line.starts_with("warning: "));
    warnings.filter(|line| !expected.iter().any(|start| line.starts_with(start))).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unexpected_warnings_are_complaints() {
        let text = "   Packaging a v0.1.0\nwarning: manifest has no description\n\
            warning: ignoring test `a` as `tests/a.rs` is not included in the published package\nwarning: aborting upload due to dry run\n";
        assert_eq!(complaints(text), ["warning: manifest has no description"]);
    }

    /// A crate that is published may depend on no crate that is not.
    #[test]
    fn published_crates_are_named_with_a_version() {
        let manifest = std::fs::read_to_string(crate::root().join("Cargo.toml")).unwrap_or_default();
        for krate in CRATES {
            let line = manifest.lines().find(|line| line.starts_with(&format!("{krate} = ")));
            assert!(line.is_some_and(|line| line.contains("version = ")), "{krate}: {line:?}");
        }
    }
}
