//! What each stretch of a source is, for whoever shows it in colours.

use crate::lex::{self, TokenKind};
use crate::types::words;
use crate::{Version, builtins};

/// What a stretch of a source is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// A comment.
    Comment,
    /// A line for the preprocessor, without its comments.
    Directive,
    /// `if`, `uniform`, `highp`: a word of the language.
    Keyword,
    /// `vec3`, `void`: a type of the language.
    Type,
    /// A function of the language.
    Function,
    /// `gl_Position`: a variable of the language.
    Variable,
    /// A number, `true` or `false`.
    Number,
    /// A name of the shader's own.
    Name,
    /// An operator or a bracket.
    Mark,
    /// A character that GLSL has no use for.
    Stray,
}

/// A stretch of a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Classified {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// What it is.
    pub class: Class,
}

/// The stretches of a source in their order, without the blanks between them. Any text gives some, the empty one none. What
/// is a word of the language in any version counts as one.
#[must_use]
pub fn classify(source: &str) -> Vec<Classified> {
    let mut found = Vec::new();
    let mut at = 0;
    let mut in_directive = false;
    for token in lex::lex(source, &mut Vec::new()) {
        comments(source, at, token.start as usize, &mut found);
        at = token.end as usize;
        if token.kind == TokenKind::End {
            break;
        }
        if token.first_on_line {
            in_directive = &*token.text == "#";
        }
        let class = if in_directive { Class::Directive } else { class_of(&token.text, token.kind) };
        found.push(Classified { start: token.start, end: token.end, class });
    }
    comments(source, at, source.len(), &mut found);
    found
}

fn class_of(text: &str, kind: TokenKind) -> Class {
    const NEWEST: Version = Version { number: 460, ..Version::NONE };
    match kind {
        TokenKind::Number => Class::Number,
        TokenKind::Mark => Class::Mark,
        TokenKind::Stray | TokenKind::End => Class::Stray,
        TokenKind::Name if matches!(text, "true" | "false") => Class::Number,
        TokenKind::Name if text == "void" || words::is_type(text, NEWEST) => Class::Type,
        TokenKind::Name if words::is_qualifier(text, NEWEST) || words::is_statement(text, NEWEST) => Class::Keyword,
        TokenKind::Name if text == "precision" => Class::Keyword,
        TokenKind::Name if builtins::is_name(text) => Class::Function,
        // Nobody else may call anything so.
        TokenKind::Name if text.starts_with("gl_") => Class::Variable,
        TokenKind::Name => Class::Name,
    }
}

/// What is no blank between two tokens is a comment, or a backslash at a line's end.
fn comments(source: &str, from: usize, to: usize, found: &mut Vec<Classified>) {
    let Some(gap) = source.get(from..to) else { return };
    let kept = gap.trim();
    let start = from + (gap.len() - gap.trim_start().len());
    if !kept.is_empty() && kept != "\\" && kept != "\u{feff}" {
        found.push(Classified { start: start as u32, end: (start + kept.len()) as u32, class: Class::Comment });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(source: &str) -> Vec<(&str, Class)> {
        classify(source).into_iter().map(|c| (&source[c.start as usize..c.end as usize], c.class)).collect()
    }

    #[test]
    fn every_word_is_what_it_is() {
        let source =
            "#version 330 core // old\n/* a\nb */ in vec3 normal;\nvoid main() { gl_Position = max(1.5, x); é true }";
        use Class::*;
        assert_eq!(
            words(source),
            [
                ("#", Directive),
                ("version", Directive),
                ("330", Directive),
                ("core", Directive),
                ("// old\n/* a\nb */", Comment),
                ("in", Keyword),
                ("vec3", Type),
                ("normal", Name),
                (";", Mark),
                ("void", Type),
                ("main", Name),
                ("(", Mark),
                (")", Mark),
                ("{", Mark),
                ("gl_Position", Variable),
                ("=", Mark),
                ("max", Function),
                ("(", Mark),
                ("1.5", Number),
                (",", Mark),
                ("x", Name),
                (")", Mark),
                (";", Mark),
                ("é", Stray),
                ("true", Number),
                ("}", Mark),
            ]
        );
    }

    #[test]
    fn stretches_follow_each_other_whatever_the_text_is() {
        for source in ["", "//", "/*", "# \\\n define", "\u{feff}in", "\\", "a\\\nb", "\"a\" é /* é */ // é", "1.0.0e+"]
        {
            let mut end = 0;
            for part in classify(source) {
                assert!(part.start >= end && part.start < part.end, "{source:?}: {part:?}");
                assert!(source.get(part.start as usize..part.end as usize).is_some(), "{source:?}: {part:?}");
                end = part.end;
            }
        }
    }
}
