//! Splits a source into tokens, each with its position, removing comments and line continuations.

use std::collections::HashMap;
use std::rc::Rc;

use crate::limits::MOST_RAW_TOKENS;
use crate::{Limit, Problem, Span};

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
    pub text: Rc<str>,
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
    texts: HashMap<&'a str, Rc<str>>,
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
            if mark.bytes().enumerate().all(|(ahead, wanted)| self.peek_at(ahead) == wanted) {
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

    fn text(&mut self, start: usize) -> Rc<str> {
        let slice = self.source.get(start..self.at).unwrap_or("");
        if slice.contains('\\') && slice.len() > 1 {
            return slice.chars().filter(|c| !matches!(c, '\\' | '\n' | '\r')).collect::<String>().into();
        }
        self.texts.entry(slice).or_insert_with(|| slice.into()).clone()
    }
}
