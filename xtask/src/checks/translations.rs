//! Texts of the Fluent files and their uses in the code.

use super::source::TextFile;
use std::collections::{BTreeSet, HashSet};

/// The folder of the texts in the language of the sources.
const ENGLISH: &str = "crates/gonio-language/locales/en/";

/// Finds texts that no code names, and names of texts that do not exist.
pub fn check(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut ids = BTreeSet::new();
    let code: Vec<&TextFile> = files.iter().filter(|file| file.is_rust() && !file.path.starts_with("xtask")).collect();
    let literals: HashSet<&str> =
        code.iter().flat_map(|file| file.text.split('"')).filter(|part| part.len() < 100).collect();
    for file in files.iter().filter(|file| file.path.starts_with(ENGLISH)) {
        for id in ids_of(&file.text) {
            if !beginnings(&id).any(|begun| literals.contains(begun)) {
                complaints.push(format!("{}: no code names the text `{id}`", file.path));
            }
            ids.insert(id);
        }
    }
    for file in code {
        for id in named(&file.text).filter(|id| !ids.contains(*id)) {
            complaints.push(format!("{}: there is no text `{id}` in {ENGLISH}", file.path));
        }
    }
    complaints
}

/// The literals that name a text: its id, and beginnings of at least two words to which code adds the rest.
fn beginnings(id: &str) -> impl Iterator<Item = &str> {
    let ends = id.match_indices(['-', '.']).skip(1).flat_map(|(at, _)| [at, at + 1]);
    std::iter::once(id).chain(ends.filter_map(|end| id.get(..end)))
}

/// The ids of messages, and `ID.NAME` of attributes.
fn ids_of(text: &str) -> Vec<String> {
    let mut ids = Vec::new();
    let mut message = "";
    for line in text.lines() {
        let Some((name, _)) = line.split_once('=').map(|(name, rest)| (name.trim(), rest)) else { continue };
        if line.starts_with(|c: char| c.is_ascii_alphabetic()) {
            message = name;
            ids.push(name.to_owned());
        } else if let Some(attribute) = name.strip_prefix('.') {
            ids.push(format!("{message}.{attribute}"));
        }
    }
    ids
}

/// The ids in calls of `tr!` with a literal, with or without arguments.
fn named(text: &str) -> impl Iterator<Item = &str> {
    let uses = text.match_indices("tr!(").filter(|(at, _)| {
        let before = text.get(..*at).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        // Neither `include_str!` nor a comment.
        !before.ends_with(|c: char| c.is_alphanumeric() || c == '_') && !line.trim_start().starts_with("//")
    });
    let rest = uses.filter_map(|(at, name)| text.get(at + name.len()..)?.trim_start().strip_prefix('"'));
    rest.filter_map(|rest| rest.split('"').next())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: path.into(), text: text.into() }
    }

    #[test]
    fn texts_and_their_uses_correspond() {
        let texts = file(
            "crates/gonio-language/locales/en/a.ftl",
            "# = no text\nsaved = saved { $place }\nlight =\n    .tip = A light\nlost = nobody says this\n",
        );
        let code =
            file("a.rs", "tr!(\n    \"saved\", place = p); const TIP: &str = \"light.tip\"; tr!(\"light\"); tr!(id)");
        assert_eq!(
            check(&[file(&texts.path, &texts.text), code]),
            ["crates/gonio-language/locales/en/a.ftl: no code names the text `lost`"]
        );
        let code = file("b.rs", "tr!(\"saved\") + tr!(\"gone\"); \"light\" \"light.tip\" \"lost\"");
        assert_eq!(check(&[texts, code]), [format!("b.rs: there is no text `gone` in {ENGLISH}")]);
    }
}
