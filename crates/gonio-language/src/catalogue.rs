//! Texts by id.

use crate::Language;
use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};
use std::collections::HashMap;
use std::sync::{LazyLock, OnceLock};

/// The files of `locales`, which every language has.
macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        /// Their names.
        #[cfg(test)]
        pub const NAMES: &[&str] = &[$($name),+];

        /// The texts of a language's files.
        pub const fn files(language: Language) -> &'static [&'static str] {
            match language {
                Language::English => &[$(include_str!(concat!("../locales/en/", $name, ".ftl"))),+],
                Language::French => &[$(include_str!(concat!("../locales/fr/", $name, ".ftl"))),+],
            }
        }
    };
}

files!(
    "bench",
    "check",
    "editor",
    "environment",
    "exercises",
    "file",
    "language",
    "names",
    "reports",
    "scene",
    "terminal",
    "window"
);

/// The messages of a language by their ids. A program shows few of them, so each is parsed when it is first used.
struct Catalogue {
    language: Language,
    messages: HashMap<&'static str, Message>,
}

/// A message with its attributes.
struct Message {
    /// Its lines in its file.
    source: &'static str,
    parsed: OnceLock<ParsedMessage>,
}

/// A message that is ready to be shown.
struct ParsedMessage {
    /// It alone: no message refers to another one.
    bundle: FluentBundle<FluentResource>,
    /// The texts without arguments, by their ids: a window shows hundreds of them in each frame.
    plain: Vec<(String, String)>,
}

static ENGLISH: LazyLock<Catalogue> = LazyLock::new(|| Catalogue::new(Language::English));
static FRENCH: LazyLock<Catalogue> = LazyLock::new(|| Catalogue::new(Language::French));

impl Catalogue {
    fn of(language: Language) -> &'static Self {
        match language {
            Language::English => &ENGLISH,
            Language::French => &FRENCH,
        }
    }

    fn new(language: Language) -> Self {
        let messages = files(language).iter().flat_map(|file| messages(file));
        let messages = messages.map(|(id, source)| (id, Message { source, parsed: OnceLock::new() })).collect();
        Catalogue { language, messages }
    }

    /// The message of an id, which may be that of an attribute.
    fn message(&self, id: &str) -> Option<&ParsedMessage> {
        let of_message = id.split_once('.').map_or(id, |(message, _)| message);
        let message = self.messages.get(of_message)?;
        Some(message.parsed.get_or_init(|| ParsedMessage::new(self.language, message.source)))
    }
}

impl ParsedMessage {
    fn new(language: Language, source: &str) -> Self {
        let tag = language.code().parse().unwrap_or_default();
        let mut bundle = FluentBundle::new_concurrent(vec![tag]);
        // The marks that isolate an argument from a text of the other direction would be copied along with code, and no
        // language here is written from right to left.
        bundle.set_use_isolating(false);
        let number = bundle.add_function("NUMBER", |positional, _| number(positional));
        debug_assert!(number.is_ok(), "the function is defined once");
        // A test parses every file; what can be read of a damaged message is used.
        let resource = FluentResource::try_new(source.to_owned()).unwrap_or_else(|(resource, _)| resource);
        bundle.add_resource_overriding(resource);
        let plain = ids(source).into_iter();
        let plain = plain.filter_map(|id| formatted_by(&bundle, &id, None).map(|text| (id, text))).collect();
        ParsedMessage { bundle, plain }
    }
}

/// The messages of a file: their ids and lines.
fn messages(file: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let mut rest = file;
    std::iter::from_fn(move || {
        let start = line_starts(rest).find(|at| rest[*at..].starts_with(|c: char| c.is_ascii_alphabetic()))?;
        let message = &rest[start..];
        let is_after = |at: &usize| *at > 0 && !message[*at..].starts_with([' ', '\n', '\r', '}']);
        let end = line_starts(message).find(is_after).unwrap_or(message.len());
        rest = &message[end..];
        let (id, _) = message.split_once('=')?;
        Some((id.trim_end(), &message[..end]))
    })
}

/// The positions at which the lines of a text start.
fn line_starts(text: &str) -> impl Iterator<Item = usize> {
    let after = text.match_indices('\n').map(|(at, _)| at + 1).filter(|at| *at < text.len());
    std::iter::once(0).filter(|_| !text.is_empty()).chain(after)
}

/// Reads an argument as a number, which selects a plural. Arguments are strings, as Rust displays them.
fn number<'a>(positional: &[FluentValue<'a>]) -> FluentValue<'a> {
    match positional.first() {
        Some(FluentValue::String(text)) => text.parse().map_or(FluentValue::Error, FluentValue::Number),
        Some(other) => other.clone(),
        None => FluentValue::Error,
    }
}

/// The ids of the texts in a file or message: those of messages, and `ID.NAME` of attributes.
pub fn ids(file: &str) -> Vec<String> {
    let mut message = String::new();
    let mut ids = Vec::new();
    for line in file.lines() {
        let name = |line: &str| line.split_once('=').map(|(name, _)| name.trim().to_owned());
        if let Some(attribute) = line.strip_prefix(' ').and_then(|line| line.trim_start().strip_prefix('.')) {
            ids.extend(name(attribute).map(|name| format!("{message}.{name}")));
        } else if line.starts_with(|c: char| c.is_ascii_alphabetic()) {
            message = name(line).unwrap_or_default();
            ids.push(message.clone());
        }
    }
    ids
}

/// The text of an id with arguments; `None` if there is none, or if it needs other arguments.
fn formatted_by(bundle: &FluentBundle<FluentResource>, id: &str, arguments: Option<&FluentArgs<'_>>) -> Option<String> {
    let (message, attribute) = id.split_once('.').map_or((id, None), |(message, name)| (message, Some(name)));
    let message = bundle.get_message(message)?;
    let pattern = match attribute {
        Some(name) => message.get_attribute(name)?.value(),
        None => message.value()?,
    };
    let mut errors = Vec::new();
    let text = bundle.format_pattern(pattern, arguments, &mut errors).into_owned();
    errors.is_empty().then_some(text)
}

/// The text of an id, in English if the language lacks it. An unknown id is its own text; `cargo xtask house` finds it.
pub fn text(language: Language, id: &'static str) -> &'static str {
    own_text(language, id).or_else(|| own_text(Language::English, id)).unwrap_or(id)
}

/// The text of an id in this language alone.
pub fn own_text(language: Language, id: &str) -> Option<&'static str> {
    let message = Catalogue::of(language).message(id)?;
    message.plain.iter().find(|(known, _)| known == id).map(|(_, text)| text.as_str())
}

/// The text of an id with arguments, in English if the language lacks it.
#[must_use]
pub fn formatted(language: Language, id: &str, arguments: &FluentArgs<'_>) -> String {
    [language, Language::English]
        .into_iter()
        .find_map(|language| formatted_by(&Catalogue::of(language).message(id)?.bundle, id, Some(arguments)))
        .unwrap_or_else(|| id.to_owned())
}

#[cfg(test)]
mod tests;
