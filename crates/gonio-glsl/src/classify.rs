//! Classifies the tokens of a source for syntax highlighting.

use crate::lex::{self, TokenKind};
use crate::{Version, builtins};

/// The class of a range of a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// A comment.
    Comment,
    /// A preprocessor directive, without its comments.
    Directive,
    /// A keyword: `if`, `uniform`, `highp`.
    Keyword,
    /// A built-in type: `vec3`, `void`.
    Type,
    /// A built-in function.
    Function,
    /// A built-in variable: `gl_Position`.
    Variable,
    /// A number, `true` or `false`.
    Number,
    /// A name declared by the shader.
    Name,
    /// An operator or a bracket.
    Mark,
    /// A character that GLSL does not allow.
    Stray,
}

/// A classified range of a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Classified {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Its class.
    pub class: Class,
}

/// Returns the classified ranges of a source in order, without the blanks between them, for any text. Words that are
/// keywords in some version are classified as such.
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
        TokenKind::Name if text == "void" || lex::is_type(text, NEWEST) => Class::Type,
        TokenKind::Name if lex::is_qualifier(text, NEWEST) || lex::is_statement(text, NEWEST) => Class::Keyword,
        TokenKind::Name if text == "precision" => Class::Keyword,
        TokenKind::Name if builtins::is_name(text) => Class::Function,
        // Nothing else may have such a name.
        TokenKind::Name if text.starts_with("gl_") => Class::Variable,
        TokenKind::Name => Class::Name,
    }
}

/// Finds comments, and backslashes at line ends, in the text between two tokens.
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
