//! The languages that gonio speaks, and its texts in them.
//!
//! Texts are in `locales/LANGUAGE/*.ftl`, in the format of [Project Fluent](https://projectfluent.org). Code names them by
//! their ids with [`tr!`]; a text that a language lacks is in English. The language is one per process, set once by whoever
//! starts it (an option, the system, the browser) or changed by its user: texts are for people, and a process has one
//! reader. Files for programs, such as JSON, have ids and keys that no language changes.

mod argument;
mod catalogue;
mod language;

pub use argument::Argument;
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

#[doc(hidden)]
pub use catalogue::formatted;
#[doc(hidden)]
pub use fluent_bundle::FluentArgs;

/// A text in the current language: `tr!("id")` is a `&'static str`, `tr!("id", count = 3, name = "N")` a `String` with
/// arguments. Numbers select plurals; format those that need digits or a sign before they are given.
#[macro_export]
macro_rules! tr {
    ($id:expr $(,)?) => { $crate::text($id) };
    ($id:expr, $($name:ident = $value:expr),+ $(,)?) => {{
        let mut arguments = $crate::FluentArgs::new();
        $(arguments.set(stringify!($name), $crate::Argument::argument(&$value).into_owned());)+
        $crate::formatted($crate::Language::current(), $id, &arguments)
    }};
}
