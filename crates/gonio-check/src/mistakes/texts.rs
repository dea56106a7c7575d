//! The catalogue's texts in other languages than English.

use super::{Mistake, ModelSolution, faces::FACES};
use gonio_language::Language;
use serde::Deserialize;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// What students read about a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MistakeTexts<'a> {
    /// The mistake in half a sentence.
    pub name: Cow<'a, str>,
    /// The symptom in the picture; empty for harmless peculiarities.
    pub looks_like: Cow<'a, str>,
    /// How to fix it; empty for harmless peculiarities.
    pub fix: Cow<'a, str>,
}

impl Mistake {
    /// Returns its texts in the current language, or in English where that language has none.
    pub fn texts(&self) -> MistakeTexts<'_> {
        self.texts_in(Language::current())
    }

    /// Returns its texts in a language, or in English if that language has none.
    pub fn texts_in(&self, language: Language) -> MistakeTexts<'_> {
        let own = match language {
            Language::English => None,
            Language::French => FRENCH.get(pattern_id(&self.id).as_ref()),
        };
        match own {
            Some(entry) => entry.of(self.models.first()).about(&self.id),
            None => MistakeTexts {
                name: Cow::Borrowed(&self.name),
                looks_like: Cow::Borrowed(&self.looks_like),
                fix: Cow::Borrowed(&self.fix),
            },
        }
    }
}

const FRENCH_TEXT: &str = include_str!("../../../../exercises/mistakes.fr.toml");

// The file is embedded in the program, and a test reads it.
static FRENCH: LazyLock<BTreeMap<String, Entry>> = LazyLock::new(|| toml::from_str(FRENCH_TEXT).unwrap_or_default());

/// The texts of an id.
#[derive(Deserialize)]
struct Entry {
    #[serde(flatten)]
    texts: OwnTexts,
    /// Those of a model solution that differ.
    #[serde(flatten)]
    by_model: BTreeMap<ModelSolution, OwnTexts>,
}

#[derive(Deserialize)]
struct OwnTexts {
    name: String,
    #[serde(default)]
    looks_like: String,
    #[serde(default)]
    fix: String,
}

impl Entry {
    fn of(&self, model: Option<&ModelSolution>) -> &OwnTexts {
        model.and_then(|model| self.by_model.get(model)).unwrap_or(&self.texts)
    }
}

impl OwnTexts {
    /// The texts of a mistake with this id, with the names of its faces.
    fn about(&self, id: &str) -> MistakeTexts<'_> {
        let names: Vec<&str> = id.split('-').filter_map(face).collect();
        let filled = |text| match names.as_slice() {
            [] => Cow::Borrowed(text),
            [face, others @ ..] => {
                let text = str::replace(text, "{face}", face);
                Cow::Owned(others.first().map_or(text.clone(), |other| text.replace("{other}", other)))
            }
        };
        MistakeTexts { name: filled(&self.name), looks_like: filled(&self.looks_like), fix: filled(&self.fix) }
    }
}

/// The name of a face, by the word in an id.
fn face(word: &str) -> Option<&'static str> {
    FACES.iter().find(|(known, _)| *known == word).map(|(_, name)| *name)
}

/// The id without words for faces: `face-posx-mirrored` and its five like have one text.
fn pattern_id(id: &str) -> Cow<'_, str> {
    match id.split('-').any(|word| face(word).is_some()) {
        true => id.split('-').filter(|word| face(word).is_none()).collect::<Vec<_>>().join("-").into(),
        false => Cow::Borrowed(id),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mistakes::{all, structural};
    use std::collections::BTreeSet;

    fn catalogue() -> Vec<Mistake> {
        [all(), structural()].concat()
    }

    /// The pieces of code in a text.
    fn code(text: &str) -> BTreeSet<&str> {
        text.split('`').skip(1).step_by(2).collect()
    }

    #[test]
    fn every_mistake_has_french_texts_with_the_same_code() {
        let read: BTreeMap<String, Entry> = toml::from_str(FRENCH_TEXT).unwrap_or_else(|error| panic!("{error}"));
        assert!(read.len() > 200, "{}", read.len());
        for mistake in catalogue() {
            assert!(read.contains_key(pattern_id(&mistake.id).as_ref()), "{}", mistake.id);
            let [english, french] = Language::ALL.map(|language| mistake.texts_in(language));
            assert_ne!(english.name, french.name, "{}", mistake.id);
            for (english, french) in
                [(english.name, french.name), (english.looks_like, french.looks_like), (english.fix, french.fix)]
            {
                assert_eq!(english.is_empty(), french.is_empty(), "{}: {english}", mistake.id);
                assert_eq!(code(&english), code(&french), "{}", mistake.id);
                assert!(!french.contains('{'), "{}: {french}", mistake.id);
            }
        }
    }

    #[test]
    fn entries_of_one_id_differ_in_french_as_in_english() {
        let all = catalogue();
        let mut compared = 0;
        for (index, one) in all.iter().enumerate() {
            for other in all.iter().skip(index + 1).filter(|other| other.id == one.id) {
                let same = |language| one.texts_in(language) == other.texts_in(language);
                assert_eq!(same(Language::English), same(Language::French), "{} {:?}", one.id, other.models);
                compared += 1;
            }
        }
        assert!(compared > 10, "{compared}");
    }

    #[test]
    fn no_french_text_belongs_to_no_mistake() {
        let known: BTreeSet<String> = catalogue().iter().map(|mistake| pattern_id(&mistake.id).into_owned()).collect();
        // Those of baked models are tested in gonio-exercises.
        let others: Vec<&String> = FRENCH.keys().filter(|id| !known.contains(*id)).collect();
        assert!(others.len() < 35, "{others:?}");
        for (id, entry) in FRENCH.iter() {
            for model in entry.by_model.keys() {
                let is_of = |m: &Mistake| pattern_id(&m.id) == id.as_str() && m.models.first() == Some(model);
                assert!(catalogue().iter().any(is_of), "{id}.{model:?}");
            }
        }
    }

    #[test]
    fn faces_have_their_names_in_french() {
        let name = |id| crate::mistakes::find(id).map(|mistake| mistake.texts_in(Language::French).name);
        let (turned, swapped) = (name("face-posy-turned-left"), name("faces-posz-negz-swapped"));
        assert_eq!(turned.as_deref(), Some("La face +Y est tournée de 90 degrés vers la gauche"));
        assert_eq!(swapped.as_deref(), Some("Les faces +Z et -Z sont échangées"));
    }

    #[test]
    fn french_signs_have_a_no_break_space_before_them() {
        let lines = FRENCH_TEXT.lines().filter(|line| !line.starts_with(['#', '[']));
        for line in lines {
            let prose: String = line.split('`').step_by(2).collect();
            for sign in [" : ", " ;", " !", " ?", "« "] {
                assert!(!prose.contains(sign), "{line}");
            }
        }
    }
}
