//! Evaluates the expression of an `#if`.

use super::Preprocessor;
use crate::lex::{Token, TokenKind};
use crate::{Limit, Problem, Span};

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
