//! Languages.

use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU8, Ordering};

/// A language with texts in `locales`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u8)]
pub enum Language {
    /// The language of the sources.
    #[default]
    English,
    /// French.
    French,
}

static CURRENT: AtomicU8 = AtomicU8::new(Language::English as u8);

impl Language {
    /// All of them.
    pub const ALL: [Language; 2] = [Language::English, Language::French];

    /// The current language of this process: English, unless [`Language::make_current`] was called.
    #[must_use]
    pub fn current() -> Language {
        let current = CURRENT.load(Ordering::Relaxed);
        Self::ALL.into_iter().find(|language| *language as u8 == current).unwrap_or_default()
    }

    /// Makes it the language of this process.
    pub fn make_current(self) {
        CURRENT.store(self as u8, Ordering::Relaxed);
    }

    /// Its code in ISO 639-1: `fr`. It names the folder in `locales`.
    #[must_use]
    pub const fn code(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::French => "fr",
        }
    }

    /// Its own name: `français`.
    #[must_use]
    pub fn own_name(self) -> &'static str {
        crate::text_in(self, "language-name").unwrap_or_else(|| self.code())
    }

    /// Returns the language of a tag as BCP 47 and POSIX write them (`fr`, `fr-CA`, `fr_FR.UTF-8`), if it is known.
    #[must_use]
    pub fn from_tag(tag: &str) -> Option<Language> {
        let code = tag.split(['-', '_', '.', '@']).next().unwrap_or_default();
        if matches!(code, "C" | "POSIX") {
            return Some(Language::English);
        }
        Self::ALL.into_iter().find(|language| language.code().eq_ignore_ascii_case(code))
    }

    /// Returns the first known language of a list of tags in order of preference, or English.
    pub fn preferred<'a>(tags: impl IntoIterator<Item = &'a str>) -> Language {
        tags.into_iter().find_map(Language::from_tag).unwrap_or_default()
    }

    /// Returns the language that the user has chosen in the system. `LC_ALL`, `LC_MESSAGES` and `LANG` precede it.
    #[cfg(not(target_arch = "wasm32"))]
    #[must_use]
    pub fn of_system() -> Language {
        let tags: Vec<String> = sys_locale::get_locales().collect();
        Language::preferred(tags.iter().map(String::as_str))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_name_languages() {
        for (tag, language) in [
            ("fr", Some(Language::French)),
            ("FR", Some(Language::French)),
            ("fr-CA", Some(Language::French)),
            ("fr_FR.UTF-8", Some(Language::French)),
            ("fr@euro", Some(Language::French)),
            ("en-GB", Some(Language::English)),
            ("C.UTF-8", Some(Language::English)),
            ("de", None),
            ("frr", None),
            ("", None),
        ] {
            assert_eq!(Language::from_tag(tag), language, "{tag}");
        }
    }

    #[test]
    fn the_first_known_language_is_preferred() {
        assert_eq!(Language::preferred(["de-CH", "fr-CH", "en"]), Language::French);
        assert_eq!(Language::preferred(["zh", "ja"]), Language::English);
    }
}
