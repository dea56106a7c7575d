//! One meaning per word: a type's name is declared once.

use super::source::{Source, TextFile};
use std::collections::{BTreeMap, BTreeSet};

/// Terms of the glossary that exactly one type of the workspace may have as its name, private types included.
pub const TERMS: &[&str] =
    &["Frame", "Scene", "SceneFile", "Source", "SourceFile", "Stage", "Submission", "Target", "Testbench", "Verdict"];

/// Limit on the number of names that public types of several crates share. Types for the same idea in different layers count
/// too. The lower crate keeps the plain noun; the higher one takes the specific noun of its field, such as `PicturePlan`.
pub const MOST_SHARED: usize = 1;

/// A name and the files that declare a type of that name.
pub type Declarations = BTreeMap<String, BTreeSet<String>>;

/// Types of the shipped code by name: public ones, and all. Tests are left out.
pub fn declarations(files: &[TextFile]) -> (Declarations, Declarations) {
    let (mut public, mut all) = (Declarations::new(), Declarations::new());
    let shipped = |path: &str| {
        path.starts_with("crates/")
            && path.contains("/src/")
            && !path.contains("/tests/")
            && !path.ends_with("tests.rs")
    };
    for file in files.iter().filter(|f| f.is_rust() && shipped(&f.path)) {
        for line in &Source::parse(&file.text).code {
            let Some((is_public, name)) = declared(line) else { continue };
            all.entry(name.to_owned()).or_default().insert(file.path.clone());
            if is_public {
                public.entry(name.to_owned()).or_default().insert(file.path.clone());
            }
        }
    }
    (public, all)
}

/// Terms that several types have as their name, with the files.
pub fn ambiguous_terms(all: &Declarations, terms: &[&str]) -> Vec<String> {
    terms
        .iter()
        .filter_map(|term| Some((term, all.get(*term).filter(|files| files.len() > 1)?)))
        .map(|(term, files)| {
            let files: Vec<&str> = files.iter().map(String::as_str).collect();
            format!("`{term}` names {} types: {}", files.len(), files.join(", "))
        })
        .collect()
}

/// Names of public types that several crates declare, each with its crates. Two such types cannot be imported side by side, and
/// a reader has to look up which one is meant. Names that one crate declares twice do not count.
pub fn shared_names(public: &Declarations) -> Vec<String> {
    public
        .iter()
        .filter_map(|(name, files)| {
            let crates: BTreeSet<&str> = files.iter().filter_map(|path| path.split('/').nth(1)).collect();
            (crates.len() > 1).then(|| format!("{name} ({})", crates.into_iter().collect::<Vec<_>>().join(", ")))
        })
        .collect()
}

/// The type that a line of code declares, and whether it is public.
fn declared(line: &str) -> Option<(bool, &str)> {
    let line = line.trim_start();
    let (is_public, rest) = match line.strip_prefix("pub ") {
        Some(rest) => (true, rest),
        None if line.starts_with("pub(") => (false, line.split_once(") ")?.1),
        None => (false, line),
    };
    let (keyword, rest) = rest.split_once(' ')?;
    // An indented `type` belongs to a trait or its implementation.
    if !matches!(keyword, "struct" | "enum" | "trait" | "union") {
        return None;
    }
    let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()?;
    name.starts_with(char::is_uppercase).then_some((is_public, name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: path.into(), text: text.into() }
    }

    #[test]
    fn a_term_with_two_types_is_found_wherever_they_are_declared() {
        let files = [
            file("crates/a/src/x.rs", "pub struct Stage;\npub enum Other { Stage }\n// struct Source;\n"),
            file("crates/a/src/y.rs", "pub(super) enum Stage { A }\nstruct Source<T>(T);\n"),
            file("crates/a/src/y/tests.rs", "struct Source;"),
        ];
        let (_, all) = declarations(&files);
        assert_eq!(
            ambiguous_terms(&all, &["Source", "Stage"]),
            ["`Stage` names 2 types: crates/a/src/x.rs, crates/a/src/y.rs"]
        );
    }

    #[test]
    fn a_public_name_is_shared_only_between_crates() {
        let files = [
            file("crates/a/src/x.rs", "pub struct Limits;\npub struct Layout;"),
            file("crates/a/src/y.rs", "pub struct Layout;\ntype Limits = u8;"),
            file("crates/b/src/lib.rs", "    pub enum Limits {}\nstruct Layout;"),
        ];
        let (public, _) = declarations(&files);
        assert_eq!(shared_names(&public), ["Limits (a, b)"]);
    }
}
