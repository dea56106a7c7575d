//! Parses tokens into the syntax tree.

mod declarations;
mod expressions;
mod items;
mod statements;

use crate::ast::Unit;
use crate::lex::{Token, TokenKind};
use crate::limits::MOST_NESTED;
use crate::{Limit, Problem, Span, TokenRange, Version, lex};
use std::collections::HashSet;

/// Most syntax errors before parsing stops.
const MOST_PROBLEMS: usize = 50;

/// A syntax error that has been reported.
pub(crate) struct Stop;
pub(crate) type Parse<T> = Result<T, Stop>;

pub(crate) struct Parser<'p> {
    tokens: &'p [Token],
    at: usize,
    version: Version,
    problems: &'p mut Vec<Problem>,
    /// Names of the structs so far.
    structs: HashSet<String>,
    nested: usize,
    /// The position of the last error: one position, one error.
    reported_at: Option<usize>,
    reported: usize,
    has_given_up: bool,
}

/// Parses a whole shader; invalid parts are reported and left out.
pub(crate) fn unit(tokens: &[Token], version: Version, problems: &mut Vec<Problem>) -> Unit {
    let mut parser = Parser {
        tokens,
        at: 0,
        version,
        problems,
        structs: HashSet::new(),
        nested: 0,
        reported_at: None,
        reported: 0,
        has_given_up: false,
    };
    parser.unit()
}

impl<'p> Parser<'p> {
    fn token(&self) -> &'p Token {
        self.ahead(0)
    }

    /// Returns the token `count` positions ahead; the end token repeats.
    fn ahead(&self, count: usize) -> &'p Token {
        &self.tokens[(self.at + count).min(self.tokens.len() - 1)]
    }

    fn before(&self) -> &'p Token {
        &self.tokens[self.at.saturating_sub(1)]
    }

    fn advance(&mut self) {
        if self.at + 1 < self.tokens.len() {
            self.at += 1;
        }
    }

    fn is(&self, text: &str) -> bool {
        self.token().is(text)
    }

    fn is_end(&self) -> bool {
        self.token().kind == TokenKind::End
    }

    /// Takes the token if it has this text.
    fn take(&mut self, text: &str) -> bool {
        let found = self.is(text);
        if found {
            self.advance();
        }
        found
    }

    /// Returns the position of the current token.
    fn here(&self) -> TokenRange {
        TokenRange { first: self.at as u32, last: self.at as u32 }
    }

    /// Returns the range from a token to the last one taken.
    fn since(&self, first: TokenRange) -> TokenRange {
        TokenRange { first: first.first, last: (self.at.saturating_sub(1) as u32).max(first.first) }
    }

    fn span_of(&self, range: TokenRange) -> Span {
        let last = self.tokens.len() - 1;
        self.tokens[(range.first as usize).min(last)].span.to(self.tokens[(range.last as usize).min(last)].span)
    }

    /// Returns the position just after the last token, for a missing token.
    fn behind(&self) -> Span {
        let span = self.before().span;
        let width =
            if self.before().region == 0 { self.before().text.chars().count() as u32 } else { span.end - span.start };
        Span { start: span.end, end: span.end, line: span.line, column: span.column + width }
    }

    #[cold]
    #[inline(never)]
    fn fail<T>(&mut self, span: Span, code: &'static str, message: impl Into<String>) -> Parse<T> {
        self.report(Problem::error(span, code, message));
        Err(Stop)
    }

    #[cold]
    #[inline(never)]
    fn report(&mut self, problem: Problem) {
        if self.reported_at == Some(self.at) || self.has_given_up {
            return;
        }
        self.reported_at = Some(self.at);
        self.reported += 1;
        self.problems.push(problem);
        if self.reported >= MOST_PROBLEMS {
            let span = self.token().span;
            self.problems.push(Problem::beyond(span, Limit::SyntaxErrors));
            self.has_given_up = true;
            self.at = self.tokens.len() - 1;
        }
    }

    /// Describes the current token for messages.
    fn found(&self) -> String {
        let token = self.token();
        match token.kind {
            TokenKind::End => "the end of the file".into(),
            TokenKind::Stray => format!("the character `{}`", token.text.escape_debug()),
            _ => format!("`{}`", token.text),
        }
    }

    /// Takes a closing bracket.
    #[inline(never)]
    fn close(&mut self, mark: &str, open: TokenRange) -> Parse<()> {
        if self.take(mark) {
            return Ok(());
        }
        let opened = self.span_of(open);
        let open_mark = self.tokens[open.first as usize].text.clone();
        let line = self.behind().line;
        let message = if opened.line == line {
            format!("expected `{mark}`, found {}", self.found())
        } else {
            format!("expected `{mark}` to close the `{open_mark}` of line {}, found {}", opened.line, self.found())
        };
        self.fail(self.behind(), "missing-bracket", message)
    }

    /// Takes the `;` after a construct. If it is missing at the end of a line, reports that and continues.
    #[inline(never)]
    fn semicolon(&mut self, after: &str) -> Parse<()> {
        if self.take(";") {
            return Ok(());
        }
        let (next, before) = (self.token(), self.before());
        if matches!(&*next.text, ")" | "]") && next.kind == TokenKind::Mark {
            let message = format!("unexpected `{}`: it closes nothing", next.text);
            return self.fail(next.span, "stray-bracket", message);
        }
        if next.kind == TokenKind::Stray {
            return self.stray();
        }
        if next.span.line == before.span.line && next.kind != TokenKind::End && !next.is("}") {
            let message = format!("expected an operator or `;` before {}", self.found());
            return self.fail(next.span, "missing-semicolon", message);
        }
        self.report(Problem::error(self.behind(), "missing-semicolon", format!("expected `;` after this {after}")));
        Ok(())
    }

    fn stray<T>(&mut self) -> Parse<T> {
        let message = format!("unexpected character `{}`", self.token().text.escape_debug());
        self.fail(self.token().span, "stray-character", message)
    }

    /// Takes a name that is not a keyword.
    #[inline(never)]
    fn name(&mut self, of: &str) -> Parse<(String, TokenRange)> {
        let token = self.token();
        if token.kind == TokenKind::Stray {
            return self.stray();
        }
        if token.kind != TokenKind::Name {
            let message = format!("expected the name of {of}, found {}", self.found());
            return self.fail(token.span, "missing-name", message);
        }
        if lex::is_reserved(&token.text, self.version) {
            let message = format!("`{}` is a reserved word and cannot be the name of {of}", token.text);
            // The tree is as good as with any other name.
            self.report(Problem::error(token.span, "reserved-word", message));
            if lex::is_statement(&token.text, self.version) {
                return Err(Stop);
            }
        }
        let place = self.here();
        self.advance();
        Ok((token.text.to_string(), place))
    }

    /// Enters a deeper level; reports one too many.
    fn enter(&mut self) -> Parse<()> {
        self.nested += 1;
        if self.nested > MOST_NESTED {
            return self.fail_beyond(Limit::Nested);
        }
        Ok(())
    }

    fn leave(&mut self) {
        self.nested -= 1;
    }

    /// Stops parsing because a limit is exceeded here.
    #[cold]
    #[inline(never)]
    fn fail_beyond<T>(&mut self, limit: Limit) -> Parse<T> {
        if !self.has_given_up {
            self.problems.push(Problem::beyond(self.token().span, limit));
        }
        self.has_given_up = true;
        self.at = self.tokens.len() - 1;
        Err(Stop)
    }

    fn is_type_name(&self, token: &Token) -> bool {
        token.kind == TokenKind::Name
            && (lex::is_type(&token.text, self.version) || self.structs.contains(&*token.text))
    }

    /// Whether a declaration begins here: a qualifier, a type, or two names in a row.
    fn is_declaration(&self) -> bool {
        let token = self.token();
        if token.kind != TokenKind::Name || (lex::is_statement(&token.text, self.version) && !self.is_prefix(token)) {
            return false;
        }
        if self.is_prefix(token) {
            return true;
        }
        let next = self.ahead(1);
        if next.kind == TokenKind::Name {
            // For `a`, and `b = ..` on the next line, a `;` is missing unless `a` is a type.
            return self.is_type_name(token) || next.span.line == token.span.line;
        }
        if next.is("[") {
            return self.behind_brackets(1).kind == TokenKind::Name && self.is_type_name(token);
        }
        lex::is_type(&token.text, self.version) && !next.is("(") && !next.is(".")
    }

    fn is_prefix(&self, token: &Token) -> bool {
        token.is("struct") || lex::is_qualifier(&token.text, self.version) && !self.is_used_as_name(token)
    }

    /// Whether a word that is a qualifier is used as a name: `sample = 1.0`.
    fn is_used_as_name(&self, token: &Token) -> bool {
        let next = self.ahead(1);
        matches!(&*token.text, "sample" | "patch" | "buffer" | "shared" | "smooth" | "flat" | "precise")
            && next.kind == TokenKind::Mark
    }

    /// Returns the token after `[..][..]`, where the first bracket is `ahead` positions ahead.
    fn behind_brackets(&self, mut ahead: usize) -> &'p Token {
        let mut depth = 0_usize;
        // An array's size is short; searching further would make invalid files slow.
        for _ in 0..100 {
            let token = self.ahead(ahead);
            if token.is("[") {
                depth += 1;
            } else if token.is("]") {
                depth = depth.saturating_sub(1);
                if depth == 0 && !self.ahead(ahead + 1).is("[") {
                    return self.ahead(ahead + 1);
                }
            } else if token.kind == TokenKind::End || token.is(";") {
                return token;
            }
            ahead += 1;
        }
        self.ahead(ahead)
    }
}
