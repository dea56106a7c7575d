//! Rules about the text of files: their length, paths of one machine in them, and examples that nothing runs.

use super::source::TextFile;

/// Longer files are listed.
const LONG: usize = 500;
/// Longer files fail the check.
const TOO_LONG: usize = 900;

/// File name endings of source code.
const CODE: &[&str] = &[".rs", ".glsl", ".vert", ".frag", ".py", ".js", ".ts", ".sh"];

/// The longest source file, and its number of lines.
pub fn longest(files: &[TextFile]) -> Option<(&str, usize)> {
    let code = files.iter().filter(|f| CODE.iter().any(|end| f.path.ends_with(end)));
    code.map(|f| (f.path.as_str(), f.text.lines().count())).max_by_key(|(_, lines)| *lines)
}

/// Returns the files that are listed and the files that are too long, each with the longest first.
pub fn check_length(files: &[TextFile]) -> (Vec<String>, Vec<String>) {
    let mut long: Vec<(usize, &str)> = files
        .iter()
        .filter(|f| CODE.iter().any(|end| f.path.ends_with(end)))
        .map(|f| (f.text.lines().count(), f.path.as_str()))
        .filter(|(lines, _)| *lines > LONG)
        .collect();
    long.sort_by(|a, b| b.cmp(a));
    let describe = |(lines, path): &(usize, &str)| {
        if *lines > TOO_LONG {
            format!("{path}: {lines} lines; split it (at most {TOO_LONG})")
        } else {
            format!("{path}: {lines} lines (more than {LONG})")
        }
    };
    let (too_long, only_long): (Vec<_>, Vec<_>) = long.iter().partition(|(lines, _)| *lines > TOO_LONG);
    (only_long.iter().map(describe).collect(), too_long.iter().map(describe).collect())
}

/// Beginnings of paths that exist on the machines where gonio is developed. (A model in a test's corpus may well name somebody's
/// home.) They are concatenated, or this file itself would be reported.
const MACHINE_PATHS: &[&str] = &[concat!("/", "work/"), concat!("/", "root/"), concat!("/", "tmp/bash")];

/// Complaints about paths of a machine in tracked files.
pub fn check_paths(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files {
        for (index, line) in file.text.lines().enumerate() {
            if let Some(path) = MACHINE_PATHS.iter().find(|path| has_absolute(line, path)) {
                complaints.push(format!("{}:{}: `{path}` is a path of one machine", file.path, index + 1));
            }
        }
    }
    complaints
}

/// Whether `line` contains `path` as the beginning of an absolute path, unlike `target/work/` and `https://x/work/`.
fn has_absolute(line: &str, path: &str) -> bool {
    line.match_indices(path).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/' | '}'))
    })
}

/// Languages of code blocks that rustdoc takes for Rust.
const RUST: &[&str] = &["", "rust", "should_panic", "no_run", "ignore", "compile_fail"];

/// Complaints about code blocks that rustdoc would take for examples. `cargo xtask test` runs no doc tests, because rustdoc takes
/// minutes to look for them: an example worth running is a test.
pub fn check_examples(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files.iter().filter(|f| f.is_rust()) {
        let mut inside = false;
        for (index, line) in file.text.lines().enumerate() {
            let line = line.trim_start();
            let Some(text) = line.strip_prefix("//!").or_else(|| line.strip_prefix("///")) else {
                inside = false;
                continue;
            };
            let Some(fence) = text.trim().strip_prefix("```") else { continue };
            inside = !inside;
            let language = fence.split([',', ' ', '{']).next().unwrap_or_default();
            if inside && RUST.contains(&language) {
                complaints.push(format!(
                    "{}:{}: an example that nothing runs: make it a test, or write ```text",
                    file.path,
                    index + 1
                ));
            }
        }
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_limits_hold() {
        let file = |path: &str, lines: usize| TextFile { path: path.into(), text: "x\n".repeat(lines) };
        let files =
            [file("a.rs", 500), file("b.rs", 501), file("c.vert", 900), file("d.rs", 901), file("model.obj", 10_000)];
        let (warnings, complaints) = check_length(&files);
        assert_eq!(warnings, ["c.vert: 900 lines (more than 500)", "b.rs: 501 lines (more than 500)"]);
        assert_eq!(longest(&files), Some(("d.rs", 901)));
        assert_eq!(complaints, ["d.rs: 901 lines; split it (at most 900)"]);
    }

    #[test]
    fn absolute_paths_are_found_and_relative_ones_are_not() {
        let check_line = |line: String| check_paths(&[TextFile { path: "a.md".into(), text: format!("\n{line}\n") }]);
        let found = check_line(format!("see {}thing", concat!("/", "work/")));
        assert_eq!(found, [format!("a.md:2: `{}` is a path of one machine", concat!("/", "work/"))]);
        assert_eq!(check_line(format!("\"{}x\"", concat!("/", "root/"))).len(), 1);
        assert!(
            check_line(format!("target{}x https://a.org{}y", concat!("/", "work/"), concat!("/", "root/"))).is_empty()
        );
    }

    fn complaints(text: &str) -> Vec<String> {
        check_examples(&[TextFile { path: "crates/gonio-mesh/src/obj.rs".into(), text: text.into() }])
    }

    #[test]
    fn examples_that_rustdoc_would_run_are_found() {
        for fence in ["```", "```rust", "```no_run", "```should_panic", "```ignore", "```rust,no_run"] {
            let text = format!("//! A text.\n//!\n//! {fence}\n//! let a = 1;\n//! ```\n");
            let found = complaints(&text);
            assert_eq!(found.len(), 1, "{fence}");
            assert!(found[0].starts_with("crates/gonio-mesh/src/obj.rs:3: "), "{found:?}");
        }
        assert_eq!(
            complaints("    /// ```\n    /// a();\n    /// ```\n    fn b() {}\n    /// ```\n    /// ```\n").len(),
            2
        );
    }

    #[test]
    fn blocks_of_another_language_and_code_are_not() {
        assert!(complaints("//! ```text\n//! a b\n//! ```\n//! ```glsl\n//! vec3 v;\n//! ```\n").is_empty());
        assert!(complaints("// ```\nlet a = \"```\";\n").is_empty());
    }
}
