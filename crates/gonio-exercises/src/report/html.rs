//! The HTML frame of pages, icons, and prose.

use super::picture::base64;
use super::sha256::sha256;
use super::text::{escaped, escaped_line, line};
use gonio_check::verdict::Outcome;
use gonio_language::Language;
use std::fmt::Write as _;

/// Maximum number of shown items of a list whose length depends on a student's file.
pub const MOST_SHOWN: usize = 40;

/// What a page looks like and does, beside its content.
#[derive(Clone, Copy)]
pub struct PageKind {
    /// Style beside that of all pages.
    pub style: &'static str,
    /// The script that the page runs, if any.
    pub script: Option<&'static str>,
}

/// A whole page. `title` is plain text, `body` HTML. The page loads nothing, and runs nothing but the script of its kind; its
/// content security policy forbids everything else.
pub fn document(title: &str, kind: PageKind, body: &str) -> String {
    let style = include_str!("style.css");
    let policy = kind
        .script
        .map_or_else(String::new, |script| format!("; script-src 'sha256-{}'", base64(&sha256(script.as_bytes()))));
    let script = kind.script.map_or_else(String::new, |script| format!("<script>{script}</script>\n"));
    format!(
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; \
         img-src data:{policy}\">\n\
         <title>{}</title>\n<style>\n{style}{}</style>\n</head>\n<body>\n<main>\n{body}</main>\n{script}</body>\n</html>\n",
        Language::current().code(),
        escaped_line(title),
        kind.style
    )
}

/// An icon beside a word with the same meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// A tick.
    Right,
    /// A cross.
    Wrong,
    /// An exclamation mark in a triangle.
    Broken,
    /// A question mark.
    Unsure,
    /// A dash.
    None,
}

impl Icon {
    /// The icon of an outcome.
    pub fn for_outcome(outcome: Outcome) -> Icon {
        match outcome {
            Outcome::Correct => Icon::Right,
            Outcome::Wrong => Icon::Wrong,
            Outcome::DoesNotCompile => Icon::Broken,
            Outcome::Unsure => Icon::Unsure,
        }
    }

    /// The icon as SVG, in the colour of the surrounding text.
    pub fn svg(self) -> String {
        let path = match self {
            Icon::Right => "<circle cx='10' cy='10' r='9'/><path class='k' d='M5.8 10.4l2.9 2.9 5.6-6.4'/>",
            Icon::Wrong => "<circle cx='10' cy='10' r='9'/><path class='k' d='M6.7 6.7l6.6 6.6M13.3 6.7l-6.6 6.6'/>",
            Icon::Broken => "<path d='M10 1.6L19 18H1z'/><path class='k' d='M10 7.4v4.8M10 15v.1'/>",
            Icon::Unsure => {
                "<circle cx='10' cy='10' r='9'/>\
                 <path class='k' d='M7.3 7.6a2.7 2.7 0 1 1 4 2.4c-.9.5-1.3 1-1.3 2M10 14.9v.1'/>"
            }
            Icon::None => "<circle class='o' cx='10' cy='10' r='8'/><path class='d' d='M6.5 10h7'/>",
        };
        format!("<svg class='icon' viewBox='0 0 20 20' aria-hidden='true' focusable='false'>{path}</svg>")
    }
}

/// A text of gonio as HTML, with `code` marked up.
pub fn prose(text: &str) -> String {
    let mut prose = String::new();
    for (index, part) in line(text).split('`').enumerate() {
        let part = escaped(part);
        match index % 2 {
            0 => prose.push_str(&part),
            _ => {
                let _ = write!(prose, "<code>{part}</code>");
            }
        }
    }
    prose
}

/// The text with a capital letter at its start.
pub fn capital(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or_else(String::new, |first| first.to_uppercase().chain(characters).collect())
}

/// A phrase as a sentence, with a capital letter and a full stop.
pub fn sentence(text: &str) -> String {
    let text = capital(&line(text));
    let end = if text.is_empty() || text.ends_with(['.', '!', '?', '…', ':', ')']) { "" } else { "." };
    format!("{}{end}", prose(&text))
}

/// The first items of a list, and the number of the others.
pub fn shown<T>(all: &[T], each: impl Fn(&T) -> String, more: impl Fn(usize) -> String) -> String {
    let mut shown: String = all.iter().take(MOST_SHOWN).map(each).collect();
    if all.len() > MOST_SHOWN {
        shown.push_str(&more(all.len() - MOST_SHOWN));
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_within_prose_is_marked() {
        assert_eq!(prose("use `mat3(itM) * n`, not <M>"), "use <code>mat3(itM) * n</code>, not &lt;M&gt;");
        assert_eq!(sentence("the normal is wrong"), "The normal is wrong.");
        assert_eq!(sentence("why?"), "Why?");
        assert_eq!(sentence(""), "");
    }
}
