//! Processes directives.

use super::{Conditional, Directive, Macro, Preprocessor};
use crate::lex::{Token, TokenKind};
use crate::{Limit, Problem, Severity, Span, Version};
use std::sync::Arc;

const KNOWN_VERSIONS: [u32; 16] = [100, 110, 120, 130, 140, 150, 300, 310, 320, 330, 400, 410, 420, 430, 440, 450];

impl Preprocessor<'_> {
    pub(super) fn directive(&mut self) {
        let line = self.take_line();
        let (Some(first), Some(last)) = (line.first(), line.last()) else { return };
        let span = first.span.to(last.span);
        let word = line.get(1).map_or("", |t| &*t.text).to_string();
        let rest = line.get(2..).unwrap_or(&[]).to_vec();
        let is_conditional = matches!(&*word, "if" | "ifdef" | "ifndef" | "elif" | "else" | "endif");
        if is_conditional {
            self.conditional(&word, &rest, span);
        } else if !self.is_active() {
            self.remember_inactive(&line);
            return;
        }
        self.directives.push(Directive { word: word.clone(), span });
        match &*word {
            "define" => self.define(&rest, span),
            "undef" => {
                if let Some(name) = rest.first() {
                    self.macros.remove(&name.text);
                }
            }
            "version" => self.version(&rest, span),
            "error" => {
                let text = words(&rest);
                self.problems.push(Problem::error(span, "error-directive", format!("#error {text}")));
            }
            "include" => {
                let message = "GLSL has no `#include`";
                let help = "paste the text of that file here";
                self.problems.push(Problem::error(span, "include", message).with_help(help));
            }
            "" | "extension" | "pragma" | "line" => {}
            _ if is_conditional => {}
            _ => {
                let message = format!("unknown directive `#{word}`");
                self.problems.push(Problem::error(span, "unknown-directive", message));
            }
        }
    }

    fn define(&mut self, rest: &[Token], span: Span) {
        let Some(name) = rest.first().filter(|t| t.kind == TokenKind::Name) else {
            let message = "expected a name after `#define`";
            self.problems.push(Problem::error(span, "define", message));
            return;
        };
        if name.text.starts_with("GL_") || &*name.text == "defined" {
            let message = format!("a macro cannot be called `{}`: names with `GL_` are reserved", name.text);
            self.problems.push(Problem::error(name.span, "reserved-name", message));
        } else if name.text.contains("__") {
            let message = format!("names with two underscores, such as `{}`, are reserved", name.text);
            self.problems.push(Problem::strict(name.span, "reserved-name", message));
        }
        let mut body = &rest[1..];
        let mut parameters = None;
        if body.first().is_some_and(|t| t.is("(") && !t.space_before) {
            let Some(close) = body.iter().position(|t| t.is(")")) else {
                let message = format!("the parameter list of the macro `{}` is never closed", name.text);
                self.problems.push(Problem::error(name.span, "define", message));
                return;
            };
            let names =
                body[1..close].iter().filter(|t| t.kind == TokenKind::Name).map(|t| Arc::clone(&t.text)).collect();
            parameters = Some(names);
            body = &body[close + 1..];
        }
        for token in body.iter().filter(|t| t.kind == TokenKind::Name) {
            self.macro_words.push((token.text.to_string(), token.start, token.end));
        }
        self.all_macros.push(name.text.to_string());
        let found = Macro { parameters, body: body.to_vec() };
        self.macros.insert(Arc::clone(&name.text), Arc::new(found));
    }

    fn version(&mut self, rest: &[Token], span: Span) {
        if self.version.is_some() {
            self.problems.push(Problem::error(span, "version", "there is more than one `#version` line"));
            return;
        }
        let number: Option<u32> = rest.first().and_then(|t| t.text.parse().ok());
        let profile = rest.get(1).map_or("", |t| &*t.text);
        let Some(number) = number.filter(|n| KNOWN_VERSIONS.contains(n) || *n == 460) else {
            let message = format!("unknown GLSL version `{}`", words(rest));
            let problem = Problem::error(span, "version", message).with_help("write `#version 330 core`");
            self.problems.push(problem);
            return;
        };
        let es = number == 100 || profile == "es";
        if matches!(number, 300 | 310 | 320) != es && number != 100 {
            let message = format!("unknown version `#version {}`", words(rest));
            let help =
                if es { "the versions of OpenGL ES are 100, 300 es and 310 es" } else { "write `es` after the number" };
            self.problems.push(Problem::error(span, "version", message).with_help(help));
        }
        if !self.out.is_empty() || self.directives.len() > 1 {
            let message = "`#version` must be the first line of the shader";
            self.problems.push(Problem::new(Severity::Strict, span, "version-not-first", message));
        }
        let compatibility = profile == "compatibility";
        self.version = Some(Version { number, es, line: span.line, compatibility });
    }

    fn conditional(&mut self, word: &str, rest: &[Token], span: Span) {
        if word.starts_with("if") {
            let is_active = self.is_active() && self.is_true(word, rest, span);
            // In a branch that is not compiled no nested branch is.
            let is_taken = is_active || !self.is_active();
            self.conditionals.push(Conditional { span, is_active, is_taken, has_else: false });
            return;
        }
        let Some(mut open) = self.conditionals.pop() else {
            self.problems.push(Problem::error(span, "stray-directive", format!("`#{word}` without `#if`")));
            return;
        };
        if word == "endif" {
            return;
        }
        if open.has_else {
            self.problems.push(Problem::error(span, "stray-directive", format!("`#{word}` after `#else`")));
        }
        open.has_else |= word == "else";
        open.is_active = !open.is_taken && (word == "else" || self.is_true("if", rest, span));
        open.is_taken |= open.is_active;
        self.conditionals.push(open);
    }

    fn is_true(&mut self, word: &str, rest: &[Token], span: Span) -> bool {
        match word {
            "ifdef" | "ifndef" => {
                let Some(name) = rest.first() else {
                    let message = format!("expected a name after `#{word}`");
                    self.problems.push(Problem::error(span, "condition", message));
                    return false;
                };
                self.is_defined(name) == (word == "ifdef")
            }
            _ => self.evaluate(rest, span),
        }
    }

    pub(super) fn is_defined(&self, name: &Token) -> bool {
        let version = self.version.unwrap_or(Version::NONE);
        match &*name.text {
            "GL_ES" | "GL_FRAGMENT_PRECISION_HIGH" => version.es,
            "GL_core_profile" => version.number >= 150 && !version.es,
            "__LINE__" | "__FILE__" | "__VERSION__" => true,
            _ => self.macros.contains_key(&name.text),
        }
    }
}

fn words(tokens: &[Token]) -> String {
    tokens.iter().map(|t| &*t.text).collect::<Vec<_>>().join(" ")
}

/// Most levels of parentheses and signs.
const MOST_NESTED: usize = 128;

impl Preprocessor<'_> {
    /// Whether the expression is not zero.
    pub(super) fn evaluate(&mut self, tokens: &[Token], span: Span) -> bool {
        let tokens = self.without_defined(tokens);
        let tokens = self.expand_all(tokens);
        let mut reader = Reader { tokens: &tokens, at: 0, nested: 0, is_too_deep: false };
        let value = reader.binary(0).filter(|_| reader.at == tokens.len());
        if reader.is_too_deep {
            self.give_up(span, Limit::Nested);
        } else if value.is_none() {
            let message = "this condition cannot be evaluated";
            self.problems.push(Problem::error(span, "condition", message));
        }
        value.is_some_and(|v| v != 0)
    }

    /// Evaluates `defined NAME` and `defined(NAME)` before macros are replaced.
    fn without_defined(&self, tokens: &[Token]) -> Vec<Token> {
        let mut out = Vec::new();
        let mut at = 0;
        while let Some(token) = tokens.get(at) {
            at += 1;
            if !token.is("defined") {
                out.push(token.clone());
                continue;
            }
            let in_brackets = tokens.get(at).is_some_and(|t| t.is("("));
            at += usize::from(in_brackets);
            let Some(name) = tokens.get(at) else { break };
            at += 1 + usize::from(in_brackets);
            let text = if self.is_defined(name) { "1" } else { "0" };
            out.push(Token { kind: TokenKind::Number, text: text.into(), ..name.clone() });
        }
        out
    }
}

struct Reader<'t> {
    tokens: &'t [Token],
    at: usize,
    nested: usize,
    is_too_deep: bool,
}

fn rank(mark: &str) -> Option<u8> {
    Some(match mark {
        "||" => 1,
        "&&" => 2,
        "|" => 3,
        "^" => 4,
        "&" => 5,
        "==" | "!=" => 6,
        "<" | ">" | "<=" | ">=" => 7,
        "<<" | ">>" => 8,
        "+" | "-" => 9,
        "*" | "/" | "%" => 10,
        _ => return None,
    })
}

impl Reader<'_> {
    fn binary(&mut self, least: u8) -> Option<i64> {
        let mut left = self.unary()?;
        while let Some(token) = self.tokens.get(self.at) {
            let Some(found) = rank(&token.text).filter(|r| *r > least) else { break };
            self.at += 1;
            let right = self.binary(found)?;
            left = match &*token.text {
                "||" => i64::from(left != 0 || right != 0),
                "&&" => i64::from(left != 0 && right != 0),
                "|" => left | right,
                "^" => left ^ right,
                "&" => left & right,
                "==" => i64::from(left == right),
                "!=" => i64::from(left != right),
                "<" => i64::from(left < right),
                ">" => i64::from(left > right),
                "<=" => i64::from(left <= right),
                ">=" => i64::from(left >= right),
                "<<" => left.wrapping_shl(right as u32),
                ">>" => left.wrapping_shr(right as u32),
                "+" => left.wrapping_add(right),
                "-" => left.wrapping_sub(right),
                "*" => left.wrapping_mul(right),
                "/" => left.checked_div(right)?,
                _ => left.checked_rem(right)?,
            };
        }
        Some(left)
    }

    fn unary(&mut self) -> Option<i64> {
        let token = self.tokens.get(self.at)?;
        self.at += 1;
        self.nested += 1;
        if self.nested > MOST_NESTED {
            self.is_too_deep = true;
            return None;
        }
        let value = match &*token.text {
            "!" => i64::from(self.unary()? == 0),
            "-" => self.unary()?.wrapping_neg(),
            "+" => self.unary()?,
            "~" => !self.unary()?,
            "(" => {
                let value = self.binary(0)?;
                self.tokens.get(self.at).filter(|t| t.is(")"))?;
                self.at += 1;
                value
            }
            // A name that is not a macro counts as zero.
            _ if token.kind == TokenKind::Name => 0,
            text if token.kind == TokenKind::Number => number(text)?,
            _ => return None,
        };
        self.nested -= 1;
        Some(value)
    }
}

fn number(text: &str) -> Option<i64> {
    let text = text.trim_end_matches(['u', 'U']);
    if let Some(hex) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        return i64::from_str_radix(hex, 16).ok();
    }
    text.parse().ok()
}
