//! The languages that gonio speaks, and its texts in them.
//!
//! Texts are in `locales/LANGUAGE/*.ftl`, in the format of [Project Fluent](https://projectfluent.org). Code names them by
//! their ids with [`tr!`]; a text that a language lacks is in English. The language is one per process, set once by whoever
//! starts it (an option, the system, the browser) or changed by its user: texts are for people, and a process has one
//! reader. Files for programs, such as JSON, have ids and keys that no language changes.
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod catalogue;
mod language;

pub use language::Language;

/// Returns the text of an id in the current language, or the id itself if no language has it. `ID.NAME` is an attribute.
#[must_use]
pub fn text(id: &'static str) -> &'static str {
    catalogue::text(Language::current(), id)
}

/// Returns the text of an id in a language, if that language has it itself.
#[must_use]
pub fn text_in(language: Language, id: &str) -> Option<&'static str> {
    catalogue::own_text(language, id)
}

/// Returns a name or a description in the current language: that of a choice, a term or a quantity, which other crates have in
/// English. One without a text is its own translation. Languages other than English have them in `names.ftl`.
#[must_use]
pub fn name(english: &str) -> &str {
    match Language::current() {
        // A window asks for hundreds of names in each frame, and they are in English already.
        Language::English => english,
        language => catalogue::own_text(language, &name_id(english)).unwrap_or(english),
    }
}

/// Returns the id of a name: `name-` and its first [`MOST_WORDS`] words in kebab case.
#[must_use]
pub fn name_id(english: &str) -> String {
    let words = english.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.take(MOST_WORDS).fold("name".to_owned(), |id, word| id + "-" + &word.to_lowercase())
}

/// Largest number of words in the id of a name.
pub const MOST_WORDS: usize = 8;

#[doc(hidden)]
pub use catalogue::formatted;
#[doc(hidden)]
pub use fluent_bundle::FluentArgs;

/// A text in the current language: `tr!("id")` is a `&'static str`, `tr!("id", count = 3, name = "N")` a `String` with
/// arguments, each as it displays itself. In a text, `NUMBER($count)` selects a plural.
#[macro_export]
macro_rules! tr {
    ($id:expr $(,)?) => { $crate::text($id) };
    ($id:expr, $($name:ident = $value:expr),+ $(,)?) => {{
        let mut arguments = $crate::FluentArgs::new();
        $(arguments.set(stringify!($name), ::std::string::ToString::to_string(&$value));)+
        $crate::formatted($crate::Language::current(), $id, &arguments)
    }};
}
