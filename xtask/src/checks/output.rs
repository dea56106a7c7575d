//! Below the command line and the application nothing prints, ends the process or reads the
//! environment: results and errors are values, and whoever called decides. In the command line one file prints, and one
//! writes the terminal's sequences: all that is quoted of files passes through both.

use super::source::{Source, find_words};
use super::tree::TextFile;

/// The crates that talk to people; in `gonio-fixtures` an environment variable selects test cases.
const MAY_TALK: &[&str] = &["crates/gonio/", "crates/gonio-app/", "crates/gonio-fixtures/"];

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

/// Who does what in the command line: a word, and the file that alone may use it.
const IN_ONE_PLACE: &[(&str, &str)] = &[
    ("print!", REPORT),
    ("println!", REPORT),
    ("eprint!", REPORT),
    ("eprintln!", REPORT),
    ("dbg!", REPORT),
    ("stdout()", REPORT),
    ("stderr()", REPORT),
    ("anstream", REPORT),
    ("anstyle", "crates/gonio/src/page.rs"),
];
const REPORT: &str = "crates/gonio/src/report.rs";

/// Complaints about library code that does, and about other files of the command line. Tests may.
pub fn check(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files.iter().filter(|f| f.is_rust() && f.path.starts_with("crates/gonio/src/")) {
        let source = Source::parse(&file.text);
        let test_lines = source.test_lines();
        for (index, code) in source.code.iter().enumerate().filter(|(index, _)| !test_lines[*index]) {
            let is_elsewhere = |(word, place): &&(&str, &str)| file.path != *place && has(code, word);
            if let Some((word, place)) = IN_ONE_PLACE.iter().find(is_elsewhere) {
                complaints.push(format!("{}:{}: `{word}` belongs to {place} alone", file.path, index + 1));
            }
        }
    }
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
    fn the_command_line_prints_in_one_place() {
        for (word, place) in IN_ONE_PLACE {
            let text = if word.ends_with(['!', ')']) { format!("{word};") } else { format!("use {word}::x;") };
            assert_eq!(complaints("crates/gonio/src/commands/new.rs", &text).len(), 1, "{word}");
            assert!(complaints(place, &text).is_empty(), "{word}");
        }
        assert!(complaints("crates/gonio/src/commands/new.rs", "reporter.text(&page)?;").is_empty());
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
        assert!(complaints("crates/gonio/src/report.rs", "println!();").is_empty());
        assert!(complaints("crates/gonio-mesh/tests/obj.rs", "println!();").is_empty());
    }
}
