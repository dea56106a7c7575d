//! The texts of the mistakes that a GL program can have. Ids never change: programs read them in results.

use gonio_language::tr;

/// A mistake and its texts in the current language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlProgramMistakeName {
    /// Its id.
    pub id: &'static str,
    /// The ids of its texts: its name, the rule of OpenGL behind it, its symptom, its fix.
    texts: [&'static str; 4],
}

impl GlProgramMistakeName {
    /// The mistake in half a sentence.
    #[must_use]
    pub fn name(&self) -> &'static str {
        tr!(self.texts[0])
    }

    /// The rule of OpenGL behind it.
    #[must_use]
    pub fn explanation(&self) -> &'static str {
        tr!(self.texts[1])
    }

    /// The symptom in the picture.
    #[must_use]
    pub fn looks_like(&self) -> &'static str {
        tr!(self.texts[2])
    }

    /// How to fix it.
    #[must_use]
    pub fn fix(&self) -> &'static str {
        tr!(self.texts[3])
    }
}

macro_rules! mistakes {
    ($($id:literal),+ $(,)?) => {
        const NAMES: &[GlProgramMistakeName] = &[$(GlProgramMistakeName {
            id: $id,
            texts: [
                concat!("check-gl-", $id),
                concat!("check-gl-", $id, ".explanation"),
                concat!("check-gl-", $id, ".looks-like"),
                concat!("check-gl-", $id, ".fix"),
            ],
        }),+];
    };
}

/// All mistakes that a check can name.
pub fn names() -> &'static [GlProgramMistakeName] {
    NAMES
}

/// A mistake by its id.
pub fn name_of(id: &str) -> Option<&'static GlProgramMistakeName> {
    NAMES.iter().find(|name| name.id == id)
}

mistakes! {
    // Samplers and units
    "texture-name-as-unit",
    "unbound-unit",
    "active-texture-after-bind",
    "active-texture-number",
    "sampler-never-set",
    "uniform-before-use-program",
    "uniform-after-draw",
    "uniform-name-wrong",
    "uniform-type-wrong",
    // Textures
    "mipmaps-missing",
    "filter-never-set",
    "mipmaps-before-image",
    "mipmaps-misplaced",
    "filter-refused",
    "wrong-target",
    "texture-not-bound",
    "texture-bound-late",
    "texture-unbound",
    "other-texture-bound",
    "texture-deleted",
    "internal-format-wrong",
    "image-level-wrong",
    "image-missing",
    "image-wrong",
    "level-range-wrong",
    // Vertices
    "stride-wrong",
    "offset-wrong",
    "attribute-size-wrong",
    "attribute-type-wrong",
    "attribute-not-enabled",
    "attribute-disabled",
    "attribute-not-described",
    "attribute-name-wrong",
    "vertex-array-missing",
    "vertex-array-not-bound",
    "vertex-array-bound-late",
    "vertex-array-unbound",
    "other-vertex-array",
    "vertex-array-deleted",
    "buffer-not-bound",
    "buffer-bound-late",
    "buffer-unbound",
    "buffer-target-wrong",
    "buffer-empty",
    "buffer-deleted",
    "other-data",
    "data-changed",
    "index-type-wrong",
    "index-offset-wrong",
    "indices-from-one",
    "indices-changed",
    "index-buffer-not-bound",
    // Programs, draws, and the picture
    "program-not-used",
    "program-switched-off",
    "program-number-wrong",
    "draw-missing",
    "draw-count-wrong",
    "draw-first-wrong",
    "draw-mode-wrong",
    "draw-too-early",
    "viewport-wrong",
    "clear-missing",
    "clear-after-draw",
    "clear-color-late",
    "clear-color-wrong",
    "culled",
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const SUSPECTS: [&str; 3] = [
        include_str!("suspects/picture.rs"),
        include_str!("suspects/textures.rs"),
        include_str!("suspects/vertices.rs"),
    ];
    const TESTS: [&str; 1] = [include_str!("tests/broken.rs")];

    #[test]
    fn each_id_is_unique_and_has_all_texts() {
        let ids: BTreeSet<_> = names().iter().map(|name| name.id).collect();
        assert_eq!(ids.len(), names().len(), "no id occurs twice");
        assert!(ids.len() >= 55, "{}", ids.len());
        for name in names() {
            assert!(name.id.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", name.id);
            for words in [name.name(), name.explanation(), name.looks_like(), name.fix()] {
                assert!(words.len() > 4 && !words.ends_with(' '), "{}: `{words}`", name.id);
            }
            assert!(!name.name().ends_with('.') && name.explanation().ends_with('.'), "{}", name.id);
        }
        assert_eq!(name_of("wrong-target").map(|name| name.id), Some("wrong-target"));
        assert_eq!(name_of("Wrong-Target"), None);
    }

    #[test]
    fn each_id_is_suspected_somewhere_and_named_in_a_test() {
        let is_in = |texts: &[&str], id: &str| texts.iter().any(|text| text.contains(&format!("\"{id}\"")));
        let not_in =
            |texts: &[&str]| names().iter().map(|name| name.id).filter(|id| !is_in(texts, id)).collect::<Vec<_>>();
        assert_eq!(not_in(&SUSPECTS), [""; 0], "never suspected");
        assert_eq!(not_in(&TESTS), [""; 0], "in no test");
        // Kebab-case words in the suspects are ids, of mistakes or of texts.
        let words = SUSPECTS.iter().flat_map(|text| text.split('"'));
        let is_id = |word: &&str| {
            word.contains('-')
                && !word.starts_with("check-")
                && word.chars().all(|c| c.is_ascii_lowercase() || c == '-')
        };
        let used: BTreeSet<&str> = words.filter(is_id).collect();
        assert!(used.len() >= 55);
        for id in used {
            assert!(name_of(id).is_some(), "{id} has no texts");
        }
    }
}
