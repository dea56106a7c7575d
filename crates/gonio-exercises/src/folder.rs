//! The exercise that a student's folder is for.

use crate::exercise::{self, Exercise};
use gonio_check::roles::NamesFile;
use gonio_language::Language;

/// Finds the exercise of a folder: the one that its `names.toml` states; else the one whose text is its `text.md`, as
/// `gonio lab start` writes it; else the one in its name, as in `ex04` or `ex04-mine`. The first line of a text is enough, so
/// notes below it do no harm.
#[must_use]
pub fn exercise_of_folder(name: &str, names_toml: Option<&str>, text_md: Option<&str>) -> Option<&'static Exercise> {
    let stated = names_toml.and_then(|text| NamesFile::parse(text).ok()?.exercise);
    if let Some(word) = stated {
        return exercise::find(&word);
    }
    text_md.and_then(with_text).or_else(|| named(name))
}

fn with_text(text: &str) -> Option<&'static Exercise> {
    let first = |text: &str| text.trim_start_matches('\u{feff}').lines().next().unwrap_or_default().trim().to_owned();
    let title = first(text);
    let has_title =
        |exercise: &&Exercise| Language::ALL.into_iter().any(|language| first(exercise.text_in(language)) == title);
    exercise::all().iter().find(has_title)
}

/// A number alone is no exercise: many folders have one.
fn named(name: &str) -> Option<&'static Exercise> {
    let name = name.to_lowercase();
    let words: Vec<&str> = name.split(|c: char| !c.is_alphanumeric()).collect();
    let at = |index: usize| {
        let word = words.get(index)?;
        let rest = ["exercise", "exercice", "exo", "ex"].iter().find_map(|begin| word.strip_prefix(begin))?;
        let number = if rest.is_empty() { words.get(index + 1)? } else { rest };
        let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        if is_number { exercise::find(number) } else { None }
    };
    // Those without a number in their id: `s1`.
    let first = || exercise::find(words.first()?).filter(|found| name.starts_with(&found.id));
    (0..words.len()).find_map(at).or_else(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, names: Option<&str>, text: Option<&str>) -> Option<&'static str> {
        exercise_of_folder(name, names, text).map(|exercise| exercise.id.as_str())
    }

    #[test]
    fn names_toml_precedes_the_text_and_the_text_the_folders_name() {
        let ex07 = exercise::find("ex07").unwrap();
        for language in Language::ALL {
            let text = format!("{}\r\nmy notes\r\n", ex07.text_in(language).lines().next().unwrap());
            assert_eq!(of("ex04", None, Some(&text)), Some("ex07"));
            assert_eq!(of("ex04", Some("exercise = \"3\"\n"), Some(&text)), Some("ex03"));
            assert_eq!(of("mine", Some("[names]\n"), Some(&text)), Some("ex07"));
        }
        assert_eq!(of("ex04", Some("exercise = \"none\""), None), None);
        assert_eq!(of("mine", None, Some("# Another text")), None);
    }

    #[test]
    fn a_folders_name_contains_the_exercise() {
        for (name, id) in [
            ("ex04", Some("ex04")),
            ("EX4", Some("ex04")),
            ("ex04-phong-diffuse", Some("ex04")),
            ("anna_ex07_final", Some("ex07")),
            ("exercise 10", Some("ex10")),
            ("s1", Some("s1")),
            ("s1-panorama", Some("s1")),
            ("4", None),
            ("2024", None),
            ("example", None),
            ("ex99", None),
            ("s12", None),
            ("", None),
        ] {
            assert_eq!(of(name, None, None), id, "{name}");
        }
    }
}
