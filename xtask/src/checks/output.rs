//! Below the command line and the application nothing prints, ends the process or reads the
//! environment: results and errors are values, and whoever called decides.

use super::source::{Source, find_words};
use super::tree::TextFile;

/// The crates that talk to people.
const MAY_TALK: &[&str] = &["crates/gonio/", "crates/gonio-app/"];

/// What only those may do. Words, so that `env!("CARGO_MANIFEST_DIR")` stays allowed.
const FORBIDDEN: &[(&str, &str)] = &[
    ("print!", "prints"),
    ("println!", "prints"),
    ("eprint!", "prints"),
    ("eprintln!", "prints"),
    ("dbg!", "prints"),
    ("stdout()", "prints"),
    ("stderr()", "prints"),
    ("std::env", "reads the environment"),
    ("env::var", "reads the environment"),
    ("env::var_os", "reads the environment"),
    ("env::vars", "reads the environment"),
    ("env::args", "reads the environment"),
    ("process::exit", "ends the process"),
];

/// Complaints about library code that does. Tests may.
pub fn check(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files.iter().filter(|f| f.is_rust() && is_library(&f.path)) {
        let source = Source::parse(&file.text);
        let test_lines = source.test_lines();
        for (index, code) in source.code.iter().enumerate().filter(|(index, _)| !test_lines[*index]) {
            // One complaint a line: `std::env::var` is three of the words.
            if let Some((word, what)) = FORBIDDEN.iter().find(|(word, _)| has(code, word)) {
                complaints.push(format!("{}:{}: `{word}`: {what}, below the command line", file.path, index + 1));
            }
        }
    }
    complaints
}

fn is_library(path: &str) -> bool {
    path.starts_with("crates/") && path.contains("/src/") && !MAY_TALK.iter().any(|place| path.starts_with(place))
}

/// `!` and `()` end a word by themselves.
fn has(code: &str, word: &str) -> bool {
    match word.strip_suffix('!').or_else(|| word.strip_suffix("()")) {
        None => find_words(code, word).next().is_some(),
        Some(name) => find_words(code, name).any(|at| code[at..].starts_with(word)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaints(path: &str, text: &str) -> Vec<String> {
        check(&[TextFile { path: path.into(), text: text.into() }])
    }

    #[test]
    fn printing_and_the_environment_are_found_in_libraries() {
        for bad in [
            "println!(\"a\");",
            "std::eprintln!(\"a\");",
            "let a = std::env::var(\"A\");",
            "use std::env;",
            "env::var_os(\"A\");",
            "std::process::exit(1);",
            "io::stdout().write();",
        ] {
            assert_eq!(complaints("crates/gonio-mesh/src/obj.rs", bad).len(), 1, "{bad}");
        }
        assert!(
            complaints("crates/gonio-mesh/src/a/b.rs", "\nprintln!();")[0]
                .starts_with("crates/gonio-mesh/src/a/b.rs:2: ")
        );
    }

    #[test]
    fn what_is_allowed_is_not_found() {
        let text = "// println!\nlet a = \"println!\"; env!(\"A\"); pretty_print!(); blueprint!(); self.print(stdout);\n#[cfg(test)]\nmod tests {\n std::env::temp_dir();\n}\n";
        assert!(complaints("crates/gonio-mesh/src/obj.rs", text).is_empty());
        assert!(complaints("crates/gonio/src/main.rs", "println!();").is_empty());
        assert!(complaints("crates/gonio-mesh/tests/obj.rs", "println!();").is_empty());
    }
}
