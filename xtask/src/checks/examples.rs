//! Examples in the documentation that nobody would run: `cargo xtask test` runs no doc tests, for rustdoc takes minutes to
//! look for them. What is worth running is a test; what stands in documentation says which language it is.

use super::tree::TextFile;

/// What rustdoc takes for Rust: no language at all, and its own words.
const RUST: &[&str] = &["", "rust", "should_panic", "no_run", "ignore", "compile_fail"];

/// Complaints about blocks of code that rustdoc would take for examples.
pub fn check(files: &[TextFile]) -> Vec<String> {
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

    fn complaints(text: &str) -> Vec<String> {
        check(&[TextFile { path: "crates/gonio-mesh/src/obj.rs".into(), text: text.into() }])
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
