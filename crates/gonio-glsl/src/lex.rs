//! Splits a source into tokens, each with its position, removing comments and line continuations; lists the words that
//! each version reserves; and checks the tokens against the limits before anything is parsed.

use crate::limits::{MOST_COMPONENTS, MOST_NAME_BYTES, MOST_NESTED, MOST_RAW_TOKENS};
use crate::{Limit, Problem, Span, Version};
use std::collections::HashMap;
use std::sync::Arc;

/// The kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TokenKind {
    /// A name or a keyword.
    Name,
    /// A number, perhaps malformed.
    Number,
    /// An operator or a bracket.
    Mark,
    /// A character that GLSL does not allow.
    Stray,
    /// The end of the file.
    End,
}

/// One token.
#[derive(Debug, Clone)]
pub(crate) struct Token {
    pub kind: TokenKind,
    pub text: Arc<str>,
    /// The position for messages: for a token from a macro, the use of the macro.
    pub span: Span,
    /// The start of the text itself.
    pub start: u32,
    pub end: u32,
    /// 0 in the file, otherwise the number of the macro's use.
    pub region: u32,
    pub first_on_line: bool,
    pub space_before: bool,
    /// A macro's own name within its expansion, which is not replaced again.
    pub frozen: bool,
}

impl Token {
    pub fn is(&self, text: &str) -> bool {
        &*self.text == text && matches!(self.kind, TokenKind::Mark | TokenKind::Name)
    }
}

struct Lexer<'a> {
    source: &'a str,
    bytes: &'a [u8],
    at: usize,
    line: u32,
    column: u32,
    /// Whether a line has ended since the last token, except in continued lines and comments.
    line_ended: bool,
    texts: HashMap<&'a str, Arc<str>>,
}

/// Returns all tokens of a source, the last being [`TokenKind::End`].
pub(crate) fn lex(source: &str, problems: &mut Vec<Problem>) -> Vec<Token> {
    let mut lexer =
        Lexer { source, bytes: source.as_bytes(), at: 0, line: 1, column: 1, line_ended: true, texts: HashMap::new() };
    // Windows editors write a byte order mark, which has no width.
    if source.starts_with('\u{feff}') {
        lexer.at = '\u{feff}'.len_utf8();
    }
    let mut tokens = Vec::new();
    loop {
        let space_before = lexer.skip_blank(problems);
        let first_on_line = std::mem::take(&mut lexer.line_ended);
        let place = (lexer.at, lexer.line, lexer.column);
        let kind = lexer.token();
        let span = Span { start: place.0 as u32, end: lexer.at as u32, line: place.1, column: place.2 };
        if kind != TokenKind::End && tokens.len() >= MOST_RAW_TOKENS {
            problems.push(Problem::beyond(span, Limit::Tokens));
            lexer.at = lexer.bytes.len();
            continue;
        }
        let text = lexer.text(place.0);
        let (start, end) = (span.start, span.end);
        let token = Token { kind, text, span, start, end, region: 0, first_on_line, space_before, frozen: false };
        tokens.push(token);
        if kind == TokenKind::End {
            return tokens;
        }
    }
}

const MARKS: [&str; 24] = [
    "<<=", ">>=", "++", "--", "<=", ">=", "==", "!=", "&&", "||", "^^", "<<", ">>", "+=", "-=", "*=", "/=", "%=", "&=",
    "|=", "^=", "##", "::", "->",
];

impl<'a> Lexer<'a> {
    /// Returns the byte here, after line continuations; 0 at the end.
    fn peek(&mut self) -> u8 {
        while let Some(length) = self.continuation(self.at) {
            self.at += length;
            self.line += 1;
            self.column = 1;
        }
        self.byte(self.at)
    }

    fn byte(&self, at: usize) -> u8 {
        self.bytes.get(at).copied().unwrap_or(0)
    }

    /// Returns the length of a backslash with its newline at this position.
    fn continuation(&self, at: usize) -> Option<usize> {
        if self.byte(at) != b'\\' {
            return None;
        }
        match (self.byte(at + 1), self.byte(at + 2)) {
            (b'\r', b'\n') => Some(3),
            (b'\n' | b'\r', _) => Some(2),
            _ => None,
        }
    }

    /// Returns the byte `ahead` of this one, after line continuations.
    fn peek_at(&self, ahead: usize) -> u8 {
        let mut at = self.at;
        for step in 0..=ahead {
            while let Some(length) = self.continuation(at) {
                at += length;
            }
            if step < ahead {
                at += 1;
            }
        }
        self.byte(at)
    }

    fn at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    /// Moves past one character.
    fn advance(&mut self) {
        let byte = self.peek();
        if self.at_end() {
            return;
        }
        match byte {
            b'\n' => self.new_line(1),
            b'\r' if self.byte(self.at + 1) == b'\n' => self.new_line(2),
            b'\r' => self.new_line(1),
            byte => {
                self.at += match byte {
                    0..0x80 => 1,
                    0xe0..0xf0 => 3,
                    0xf0.. => 4,
                    _ => 2,
                };
                self.at = self.at.min(self.bytes.len());
                self.column += 1;
            }
        }
    }

    fn new_line(&mut self, bytes: usize) {
        self.at += bytes;
        self.line += 1;
        self.column = 1;
    }

    /// Skips blanks and comments; returns whether there were any.
    fn skip_blank(&mut self, problems: &mut Vec<Problem>) -> bool {
        let before = self.at;
        loop {
            match (self.peek(), self.peek_at(1)) {
                (b'\n' | b'\r', _) => {
                    self.line_ended = true;
                    self.advance();
                }
                (b' ' | b'\t' | 0x0b | 0x0c, _) => self.advance(),
                (0xc2, 0xa0) => self.advance(),
                (b'/', b'/') => {
                    while !self.at_end() && !matches!(self.peek(), b'\n' | b'\r') {
                        self.advance();
                    }
                }
                (b'/', b'*') => {
                    let open =
                        Span { start: self.at as u32, end: self.at as u32 + 2, line: self.line, column: self.column };
                    self.advance();
                    self.advance();
                    while !self.at_end() && (self.peek(), self.peek_at(1)) != (b'*', b'/') {
                        self.advance();
                    }
                    if self.at_end() {
                        let message = "this comment is never closed: expected `*/`";
                        problems.push(Problem::error(open, "unclosed-comment", message));
                    }
                    self.advance();
                    self.advance();
                }
                _ => return self.at > before,
            }
        }
    }

    fn token(&mut self) -> TokenKind {
        let byte = self.peek();
        if self.at_end() {
            return TokenKind::End;
        }
        if byte == b'_' || byte.is_ascii_alphabetic() {
            self.word();
            return TokenKind::Name;
        }
        if byte.is_ascii_digit() || (byte == b'.' && self.peek_at(1).is_ascii_digit()) {
            self.number();
            return TokenKind::Number;
        }
        for mark in MARKS {
            if mark.bytes().enumerate().all(|(ahead, expected)| self.peek_at(ahead) == expected) {
                for _ in 0..mark.len() {
                    self.advance();
                }
                return TokenKind::Mark;
            }
        }
        self.advance();
        if b"+-*/%<>=!~&|^?:;,.()[]{}#".contains(&byte) { TokenKind::Mark } else { TokenKind::Stray }
    }

    fn word(&mut self) {
        while matches!(self.peek(), b'_' | b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9') {
            self.advance();
        }
    }

    /// Reads digits, fraction, exponent and suffix. Invalid letters are included, so that `2pi` is one malformed
    /// number, but not after a bare point, because `1.xx` may be a swizzle.
    fn number(&mut self) {
        if self.peek() == b'0' && matches!(self.peek_at(1), b'x' | b'X') {
            return self.word();
        }
        self.digits();
        let mut bare_point = false;
        if self.peek() == b'.' {
            self.advance();
            bare_point = !self.peek().is_ascii_digit();
            self.digits();
        }
        if matches!(self.peek(), b'e' | b'E') {
            let sign = usize::from(matches!(self.peek_at(1), b'+' | b'-'));
            if self.peek_at(1 + sign).is_ascii_digit() {
                for _ in 0..=sign {
                    self.advance();
                }
                self.digits();
                bare_point = false;
            }
        }
        if !bare_point || matches!(self.peek(), b'f' | b'F' | b'l' | b'L') {
            self.word();
        }
    }

    fn digits(&mut self) {
        while self.peek().is_ascii_digit() {
            self.advance();
        }
    }

    fn text(&mut self, start: usize) -> Arc<str> {
        let slice = self.source.get(start..self.at).unwrap_or("");
        if slice.contains('\\') && slice.len() > 1 {
            return slice.chars().filter(|c| !matches!(c, '\\' | '\n' | '\r')).collect::<String>().into();
        }
        self.texts.entry(slice).or_insert_with(|| slice.into()).clone()
    }
}

/// Keywords of statements in every version.
const STATEMENTS: &str =
    " if else for while do return break continue discard struct const in out inout uniform true false ";

/// Qualifiers, with the first versions (desktop, ES) that have them; 0 is never.
const QUALIFIERS: [(&str, u32, u32); 30] = [
    ("const", 110, 100),
    ("in", 110, 100),
    ("out", 110, 100),
    ("inout", 110, 100),
    ("uniform", 110, 100),
    ("attribute", 110, 100),
    ("varying", 110, 100),
    ("invariant", 120, 100),
    ("centroid", 120, 300),
    ("flat", 130, 300),
    ("smooth", 130, 300),
    ("noperspective", 130, 0),
    ("highp", 110, 100),
    ("mediump", 110, 100),
    ("lowp", 110, 100),
    ("layout", 110, 100),
    ("patch", 400, 320),
    ("sample", 400, 320),
    ("precise", 400, 320),
    ("buffer", 430, 310),
    ("shared", 430, 310),
    ("coherent", 420, 310),
    ("volatile", 420, 310),
    ("restrict", 420, 310),
    ("readonly", 420, 310),
    ("writeonly", 420, 310),
    ("subroutine", 400, 0),
    ("superp", 0, 0),
    ("packed", 0, 0),
    ("row_major", 0, 0),
];

/// Words that are reserved in every version without having a meaning (GLSL 4.60 and GLSL ES 3.00, sections 3.6 and
/// 3.7).
const RESERVED: &str = " asm class union enum typedef template this goto inline noinline volatile public static extern \
external interface long short half fixed unsigned superp input output hvec2 hvec3 hvec4 fvec2 fvec3 fvec4 \
sampler3DRect sizeof cast namespace using ";

/// Further reserved words, with the first versions (desktop, ES).
const RESERVED_FROM: [(&str, u32, u32); 22] = [
    ("common", 130, 300),
    ("partition", 130, 300),
    ("active", 130, 300),
    ("filter", 130, 300),
    ("resource", 420, 300),
    ("double", 110, 100),
    ("switch", 110, 100),
    ("case", 130, 300),
    ("default", 110, 100),
    ("uint", 130, 300),
    ("attribute", 110, 100),
    ("varying", 110, 100),
    ("coherent", 420, 300),
    ("restrict", 420, 300),
    ("readonly", 420, 300),
    ("writeonly", 420, 300),
    ("noperspective", 130, 300),
    ("patch", 400, 300),
    ("sample", 400, 300),
    ("subroutine", 400, 300),
    ("atomic_uint", 420, 300),
    ("precision", 130, 100),
];

fn listed(list: &str, word: &str) -> bool {
    !word.is_empty() && list.split_ascii_whitespace().any(|w| w == word)
}

/// Whether the word is a qualifier in this version.
pub(crate) fn is_qualifier(word: &str, version: Version) -> bool {
    QUALIFIERS.iter().any(|(w, desktop, es)| *w == word && version.is_at_least(*desktop, *es))
}

/// Whether the word is a keyword of statements, which can never be a name.
pub(crate) fn is_statement(word: &str, version: Version) -> bool {
    listed(STATEMENTS, word) || (matches!(word, "switch" | "case" | "default") && version.is_at_least(130, 300))
}

/// Whether the word is a built-in type in this version.
pub(crate) fn is_type(word: &str, version: Version) -> bool {
    match word {
        "uint" | "uvec2" | "uvec3" | "uvec4" => version.is_at_least(130, 300),
        "double" => version.is_at_least(400, 0),
        _ if word.starts_with("dvec") || word.starts_with("dmat") => version.is_at_least(400, 0),
        _ => crate::Type::named(word).is_some(),
    }
}

/// Whether the word cannot be the name of a variable, function or struct in this version.
pub(crate) fn is_reserved(word: &str, version: Version) -> bool {
    is_statement(word, version)
        || is_qualifier(word, version)
        || is_type(word, version)
        || listed(RESERVED, word)
        || RESERVED_FROM.iter().any(|(w, desktop, es)| *w == word && version.is_at_least(*desktop, *es))
}

/// Checks the tokens against the limits wherever they are: a shader that cannot be parsed goes to the driver too. Where
/// one is exceeded, only the end token is left.
pub(crate) fn check_limits(tokens: &mut Vec<Token>, most: usize, problems: &mut Vec<Problem>) {
    let Some((limit, span)) = exceeded(tokens, most) else { return };
    refuse(tokens, problems, limit, span);
}

/// Reports that a limit is exceeded, and leaves only the end token.
pub(crate) fn refuse(tokens: &mut Vec<Token>, problems: &mut Vec<Problem>, limit: Limit, span: Span) {
    if !problems.iter().any(|problem| problem.limit.is_some()) {
        problems.push(Problem::beyond(span, limit));
    }
    tokens.drain(..tokens.len().saturating_sub(1));
}

fn exceeded(tokens: &[Token], most: usize) -> Option<(Limit, Span)> {
    if let Some(token) = tokens.get(most) {
        return Some((Limit::Tokens, token.span));
    }
    let mut depth = 0_usize;
    for (index, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Name if token.text.len() > MOST_NAME_BYTES => return Some((Limit::Name, token.span)),
            TokenKind::Mark => match &*token.text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.saturating_sub(1),
                _ => {}
            },
            TokenKind::Number if index > 0 && tokens[index - 1].is("[") => {
                let digits = token.text.trim_end_matches(['u', 'U']);
                let is_sizeable = tokens.get(index + 1).is_some_and(|next| next.is("]"));
                let is_number = digits.bytes().all(|digit| digit.is_ascii_digit());
                let is_large = digits.parse::<u64>().map_or(is_number, |number| number > MOST_COMPONENTS);
                if is_sizeable && is_large {
                    return Some((Limit::Components, token.span));
                }
            }
            _ => {}
        }
        if depth > MOST_NESTED {
            return Some((Limit::Nested, token.span));
        }
    }
    None
}
