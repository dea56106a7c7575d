//! The catalogue of mistakes: each a small change to one of the models, with its name, its symptom and its fix.

mod compose;
pub mod faces;
mod model;
mod structural;

pub use compose::{Hypotheses, Hypothesis};
pub use model::Model;
pub use structural::structural;

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A mistake, or a harmless peculiarity, in the models that it can be made in.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// A stable kebab-case word.
    pub id: String,
    /// The mistake in half a sentence.
    pub name: String,
    /// The models in which it can be made.
    pub models: Vec<Model>,
    /// A right answer that looks different.
    #[serde(default)]
    pub harmless: bool,
    /// The lab's own solutions do the same.
    #[serde(default)]
    pub lab_does_it: bool,
    /// The symptom in the picture; empty for harmless peculiarities.
    #[serde(default)]
    pub looks_like: String,
    /// How to fix it; empty for harmless peculiarities.
    #[serde(default)]
    pub fix: String,
    /// The section of the lecture that teaches it; empty for what is harmless.
    #[serde(default)]
    pub lecture_section: String,
    /// Its picture is no sum of terms: strengths that have to be found are one factor for all.
    #[serde(default)]
    pub whole: bool,
    /// Other ids whose pictures are the same in principle.
    #[serde(default)]
    pub looks_the_same_as: Vec<String>,
    /// Ways to make it: what is written to which variable of the model instead.
    pub change: Vec<BTreeMap<String, String>>,
}

/// The terms of the light equation, in the order of [`crate::verdict::Verdict::terms`].
pub const TERMS: [&str; 3] = ["ambient", "diffuse", "specular"];

/// The one term that a mistake is made with, by its id: `specular-missing` is the specular term's. `None` for what concerns
/// several terms, such as a normal, or none.
pub fn term_of(id: &str) -> Option<&'static str> {
    TERMS.into_iter().find(|term| id.strip_prefix(term).is_some_and(|rest| rest.starts_with('-')))
}

/// The bank's files: one for all that is light, and those of single exercises.
const TEXTS: [&str; 3] = [
    include_str!("../../../../exercises/mistakes.toml"),
    include_str!("../../../../exercises/ex01-camera/mistakes.toml"),
    include_str!("../../../../exercises/s1-panorama-to-cubemap/mistakes.toml"),
];

#[derive(Deserialize)]
struct File {
    mistake: Vec<Mistake>,
}

/// All of them, in the order of the files, and those of single faces; an id stands more than once where it is another change in another model.
pub fn all() -> &'static [Mistake] {
    static ALL: LazyLock<Vec<Mistake>> = LazyLock::new(|| {
        // The files are part of the program; a test reads them.
        let files = TEXTS.iter().filter_map(|text| toml::from_str::<File>(text).ok());
        files.flat_map(|file| file.mistake).chain(faces::mistakes()).collect()
    });
    &ALL
}

/// Returns the mistakes that can be made in a model.
pub fn for_model(model: Model) -> impl Iterator<Item = &'static Mistake> {
    all().iter().filter(move |mistake| mistake.models.contains(&model.with_mistakes_of()))
}

/// The first of that id.
pub fn find(id: &str) -> Option<&'static Mistake> {
    all().iter().find(|mistake| mistake.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_files_can_be_read() {
        let files = TEXTS.map(|text| toml::from_str::<File>(text).unwrap().mistake);
        assert!(files[0].len() > 90, "{}", files[0].len());
        assert!(files.iter().all(|file| file.len() > 20));
        assert_eq!([files.concat(), faces::mistakes()].concat(), all());
    }

    #[test]
    fn ids_are_kebab_case_and_stand_once_a_model() {
        let mut seen = BTreeSet::new();
        for mistake in all() {
            let word =
                |word: &str| !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit());
            assert!(mistake.id.split('-').all(word), "{}", mistake.id);
            for model in &mistake.models {
                assert!(seen.insert((mistake.id.clone(), *model)), "{} stands twice for {model:?}", mistake.id);
            }
        }
    }

    #[test]
    fn everything_that_is_wrong_says_how_to_mend_it() {
        for mistake in all().iter().filter(|mistake| !mistake.harmless) {
            for text in [&mistake.looks_like, &mistake.fix, &mistake.lecture_section] {
                assert!(!text.is_empty(), "{}", mistake.id);
            }
            for other in &mistake.looks_the_same_as {
                assert!(find(other).is_some(), "{}: {other}", mistake.id);
            }
        }
    }
}
