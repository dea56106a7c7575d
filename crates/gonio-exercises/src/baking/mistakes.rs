//! The catalogue of the exercise's mistakes.

use gonio_check::mistakes::Mistake;
use serde::Deserialize;
use std::sync::LazyLock;

#[derive(Deserialize)]
struct File {
    mistake: Vec<Mistake>,
}

const TEXT: &str = include_str!("../../../../exercises/ex13-baking/mistakes.toml");

/// All mistakes that can be recognised in a baked model.
pub fn all() -> &'static [Mistake] {
    static ALL: LazyLock<Vec<Mistake>> =
        // The file is embedded in the program, and a test reads it.
        LazyLock::new(|| toml::from_str::<File>(TEXT).map_or_else(|_| Vec::new(), |file| file.mistake));
    &ALL
}

/// Finds a mistake by its id.
pub fn find(id: &str) -> Option<&'static Mistake> {
    all().iter().find(|mistake| mistake.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mistake_has_a_symptom_and_a_fix_and_an_id_of_its_own() {
        let read = toml::from_str::<File>(TEXT).unwrap_or_else(|error| panic!("{error}")).mistake;
        assert_eq!(read, all());
        for (index, mistake) in read.iter().enumerate() {
            assert!(
                ![&mistake.name, &mistake.looks_like, &mistake.fix].iter().any(|text| text.is_empty()),
                "{}",
                mistake.id
            );
            assert!(!read[..index].iter().any(|other| other.id == mistake.id), "{}", mistake.id);
            assert!(gonio_check::mistakes::find(&mistake.id).is_none(), "{}", mistake.id);
            let [english, french] = gonio_language::Language::ALL.map(|language| mistake.texts_in(language));
            assert_ne!(english.name, french.name, "{}", mistake.id);
            assert!(!french.looks_like.is_empty() && !french.fix.is_empty(), "{}", mistake.id);
            assert!(english.looks_like != french.looks_like && english.fix != french.fix, "{}", mistake.id);
        }
    }
}
