//! Parses expressions by operator precedence.

use super::{Parse, Parser};
use crate::ast::{BinaryOp, Call, Expr, ExprKind, Literal, UnaryOp};
use crate::lex::TokenKind;
use crate::limits::{MOST_ARRAY_SIZES, MOST_NESTED};
use crate::{Limit, Problem, TokenRange, Type, lex};

const ASSIGNMENTS: [&str; 11] = ["=", "+=", "-=", "*=", "/=", "%=", "<<=", ">>=", "&=", "^=", "|="];

fn height_of(kind: &ExprKind) -> u16 {
    let of = |list: &[Expr]| list.iter().map(|e| e.height).max().unwrap_or(0);
    let below = match kind {
        ExprKind::Literal(_) | ExprKind::Name(_) => return 1,
        ExprKind::Call(call) => of(&call.args),
        ExprKind::Field { base, .. } | ExprKind::Length(base) => base.height,
        ExprKind::Index { base, index } => base.height.max(index.height),
        ExprKind::Unary { operand, .. } => operand.height,
        ExprKind::Binary { left, right, .. } => left.height.max(right.height),
        ExprKind::Ternary { condition, then, otherwise } => condition.height.max(then.height).max(otherwise.height),
        ExprKind::Assign { target, value, .. } => target.height.max(value.height),
        ExprKind::Sequence(list) | ExprKind::List(list) => of(list),
    };
    below.saturating_add(1)
}

impl Parser<'_> {
    #[inline(never)]
    fn expr(&mut self, kind: ExprKind, tokens: TokenRange) -> Parse<Box<Expr>> {
        let height = height_of(&kind);
        if usize::from(height) > MOST_NESTED {
            return self.fail_beyond(Limit::Nested);
        }
        Ok(Box::new(Expr { kind, span: self.span_of(tokens), ty: None, tokens, height }))
    }

    /// Parses an expression including commas.
    pub(super) fn expression(&mut self) -> Parse<Box<Expr>> {
        let first = self.assignment()?;
        if !self.is(",") {
            return Ok(first);
        }
        let mut list = vec![*first];
        while self.take(",") {
            list.push(*self.assignment()?);
        }
        let tokens = list[0].tokens.to(list[list.len() - 1].tokens);
        self.expr(ExprKind::Sequence(list), tokens)
    }

    /// Parses an expression without commas.
    pub(super) fn assignment(&mut self) -> Parse<Box<Expr>> {
        self.enter()?;
        let result = self.assignment_within();
        self.leave();
        result
    }

    #[inline(never)]
    fn assignment_within(&mut self) -> Parse<Box<Expr>> {
        let left = self.binary(0)?;
        if self.is("?") {
            return self.ternary(left);
        }
        let mark = &self.token().text;
        if self.token().kind != TokenKind::Mark || !ASSIGNMENTS.contains(&&**mark) {
            return Ok(left);
        }
        let op = BinaryOp::from_mark(&mark[..mark.len() - 1]).map(|(op, _)| op);
        self.advance();
        let value = self.assignment()?;
        let tokens = left.tokens.to(value.tokens);
        self.expr(ExprKind::Assign { op, target: left, value }, tokens)
    }

    #[inline(never)]
    fn ternary(&mut self, condition: Box<Expr>) -> Parse<Box<Expr>> {
        self.advance();
        let then = self.expression()?;
        if !self.take(":") {
            let message = "expected `:` to go with this `?`";
            return self.fail(self.behind(), "missing-colon", message);
        }
        let otherwise = self.assignment()?;
        let tokens = condition.tokens.to(otherwise.tokens);
        self.expr(ExprKind::Ternary { condition, then, otherwise }, tokens)
    }

    #[inline(never)]
    fn binary(&mut self, least: u8) -> Parse<Box<Expr>> {
        let mut left = self.unary()?;
        loop {
            let token = self.token();
            let Some((op, rank)) = BinaryOp::from_mark(&token.text).filter(|(_, rank)| *rank > least) else { break };
            self.advance();
            let right = self.binary(rank)?;
            let tokens = left.tokens.to(right.tokens);
            left = self.expr(ExprKind::Binary { op, left, right }, tokens)?;
        }
        Ok(left)
    }

    #[inline(never)]
    fn unary(&mut self) -> Parse<Box<Expr>> {
        let token = self.token();
        let op = match &*token.text {
            _ if token.kind != TokenKind::Mark => return self.postfix(),
            "+" => UnaryOp::Plus,
            "-" => UnaryOp::Minus,
            "!" => UnaryOp::Not,
            "~" => UnaryOp::Complement,
            "++" => UnaryOp::PreIncrement,
            "--" => UnaryOp::PreDecrement,
            _ => return self.postfix(),
        };
        let first = self.here();
        self.advance();
        self.enter()?;
        let operand = self.unary();
        self.leave();
        let operand = operand?;
        let tokens = first.to(operand.tokens);
        self.expr(ExprKind::Unary { op, operand }, tokens)
    }

    #[inline(never)]
    fn postfix(&mut self) -> Parse<Box<Expr>> {
        let mut base = self.primary()?;
        loop {
            let first = base.tokens;
            let here = self.here();
            if self.take("[") {
                let index = self.expression()?;
                self.close("]", here)?;
                let kind = ExprKind::Index { base, index };
                base = self.expr(kind, self.since(first))?;
            } else if self.take(".") {
                base = self.field(base, first)?;
            } else if self.is("++") || self.is("--") {
                let op = if self.is("++") { UnaryOp::PostIncrement } else { UnaryOp::PostDecrement };
                self.advance();
                let kind = ExprKind::Unary { op, operand: base };
                base = self.expr(kind, self.since(first))?;
            } else if self.is("(") && !self.starts_line() {
                let message = "only the name of a function can be called";
                return self.fail(self.token().span, "not-a-function", message);
            } else {
                return Ok(base);
            }
        }
    }

    fn starts_line(&self) -> bool {
        self.token().span.line > self.before().span.line
    }

    #[inline(never)]
    fn field(&mut self, base: Box<Expr>, first: TokenRange) -> Parse<Box<Expr>> {
        let token = self.token();
        if token.kind != TokenKind::Name {
            let message =
                format!("expected a member or components such as `xyz` after the `.`, found {}", self.found());
            return self.fail(token.span, "missing-name", message);
        }
        let name_tokens = self.here();
        self.advance();
        if token.is("length") && self.is("(") && self.ahead(1).is(")") {
            self.advance();
            self.advance();
            return self.expr(ExprKind::Length(base), self.since(first));
        }
        let kind = ExprKind::Field { base, name: token.text.to_string(), name_span: token.span, name_tokens };
        self.expr(kind, self.since(first))
    }

    #[inline(never)]
    fn primary(&mut self) -> Parse<Box<Expr>> {
        let token = self.token();
        let first = self.here();
        match token.kind {
            TokenKind::Number => {
                self.advance();
                let literal = match number(&token.text) {
                    Ok(literal) => literal,
                    Err(reason) => {
                        let message = format!("`{}` is not a number: {reason}", token.text);
                        self.report(Problem::error(token.span, "bad-number", message));
                        Literal::Float(0.0)
                    }
                };
                self.expr(ExprKind::Literal(literal), first)
            }
            TokenKind::Name => self.word(),
            TokenKind::Stray => self.stray(),
            _ if token.is("(") => {
                self.advance();
                let mut inner = self.expression()?;
                self.close(")", first)?;
                inner.tokens = self.since(first);
                inner.span = self.span_of(inner.tokens);
                Ok(inner)
            }
            _ if token.is("{") => self.list(),
            _ => {
                let message = match token.kind {
                    TokenKind::End => "expected an expression, found the end of the file".to_string(),
                    _ => format!("expected an expression, found {}", self.found()),
                };
                let span = if self.starts_line() { self.behind() } else { token.span };
                self.fail(span, "missing-value", message)
            }
        }
    }

    /// Parses a variable, a call or a constructor.
    #[inline(never)]
    fn word(&mut self) -> Parse<Box<Expr>> {
        let token = self.token();
        let first = self.here();
        if matches!(&*token.text, "true" | "false") {
            self.advance();
            return self.expr(ExprKind::Literal(Literal::Bool(token.is("true"))), first);
        }
        if lex::is_statement(&token.text, self.version) {
            let message = format!("expected an expression, found `{}`", token.text);
            let span = if self.starts_line() { self.behind() } else { token.span };
            return self.fail(span, "missing-value", message);
        }
        let is_type = self.is_type_name(token);
        self.advance();
        let is_array = is_type && self.is("[") && self.behind_brackets(0).is("(");
        let sizes = if is_array { self.sizes()? } else { Vec::new() };
        if !self.is("(") {
            if is_type && lex::is_type(&token.text, self.version) {
                let message =
                    format!("`{}` is a type, not a value: write `{}(..)` to construct one", token.text, token.text);
                return self.fail(token.span, "type-as-value", message);
            }
            return self.expr(ExprKind::Name(token.text.to_string()), first);
        }
        let args = self.arguments()?;
        let call = Call {
            name: token.text.to_string(),
            name_span: token.span,
            name_tokens: first,
            sizes,
            args,
            is_constructor: is_type,
        };
        self.expr(ExprKind::Call(call), self.since(first))
    }

    #[inline(never)]
    fn arguments(&mut self) -> Parse<Vec<Expr>> {
        let open = self.here();
        self.advance();
        let mut args = Vec::new();
        // `f(void)` is an old way to write `f()`.
        if self.is("void") && self.ahead(1).is(")") {
            self.advance();
        }
        if self.take(")") {
            return Ok(args);
        }
        loop {
            args.push(*self.assignment()?);
            if !self.take(",") {
                break;
            }
        }
        self.close(")", open)?;
        Ok(args)
    }

    /// Parses `{1.0, 2.0}`.
    #[inline(never)]
    fn list(&mut self) -> Parse<Box<Expr>> {
        let open = self.here();
        self.advance();
        let mut list = Vec::new();
        while !self.is("}") {
            list.push(*self.assignment()?);
            if !self.take(",") {
                break;
            }
        }
        self.close("}", open)?;
        self.expr(ExprKind::List(list), self.since(open))
    }

    /// Parses array sizes, `[3][]`, after a type or a name.
    #[inline(never)]
    pub(super) fn sizes(&mut self) -> Parse<Vec<Option<Expr>>> {
        let mut sizes = Vec::new();
        loop {
            let open = self.here();
            if !self.take("[") {
                return Ok(sizes);
            }
            let size = if self.is("]") { None } else { Some(*self.expression()?) };
            self.close("]", open)?;
            sizes.push(size);
            if sizes.len() > MOST_ARRAY_SIZES {
                return self.fail_beyond(Limit::ArraySizes);
            }
        }
    }

    pub(super) fn starts_type(&self) -> bool {
        self.token().is("struct") || Type::named(&self.token().text).is_some() || self.is_type_name(self.token())
    }
}

/// Parses a number.
fn number(text: &str) -> Result<Literal, String> {
    let lower = text.to_ascii_lowercase();
    let is_hex = lower.starts_with("0x");
    if !is_hex && (lower.contains(['.', 'e']) || lower.ends_with('f')) {
        let (digits, is_double) = match lower.strip_suffix("lf") {
            Some(digits) => (digits, true),
            None => (lower.strip_suffix('f').unwrap_or(&lower), false),
        };
        let is_plain = digits.chars().all(|c| c.is_ascii_digit() || ".e+-".contains(c));
        let value: f64 = digits
            .parse()
            .ok()
            .filter(|_| is_plain)
            .ok_or("expected digits, one decimal point and an exponent such as `e-3`")?;
        return Ok(if is_double { Literal::Double(value) } else { Literal::Float(value) });
    }
    let (digits, is_unsigned) = match lower.strip_suffix('u') {
        Some(digits) => (digits, true),
        None => (&*lower, false),
    };
    let value = if let Some(hex) = digits.strip_prefix("0x") {
        i64::from_str_radix(hex, 16)
    } else if digits.len() > 1 && digits.starts_with('0') {
        i64::from_str_radix(digits, 8)
    } else {
        digits.parse()
    };
    let value = value.map_err(|_| "a number cannot contain letters; a product needs a `*`".to_string())?;
    match u32::try_from(value) {
        Ok(value) if is_unsigned => Ok(Literal::UInt(value)),
        Ok(_) => Ok(Literal::Int(value)),
        Err(_) => Err("it does not fit into 32 bits".into()),
    }
}
