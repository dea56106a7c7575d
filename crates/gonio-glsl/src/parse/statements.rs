//! Parses statements.

use super::{Parse, Parser};
use crate::ast::{Condition, Statement, StatementKind};
use crate::lex::TokenKind;
use crate::{Problem, TokenRange};

impl Parser<'_> {
    /// Parses the `{ .. }` of a function.
    pub(super) fn body(&mut self, name: &str) -> Parse<Vec<Statement>> {
        let open = self.here();
        self.advance();
        let (list, is_closed) = self.statements();
        if !is_closed {
            let line = self.span_of(open).line;
            let message = if self.is_end() {
                format!("the body of `{name}` (line {line}), or a block in it, is never closed: expected `}}`")
            } else {
                format!("expected `}}` before this function: the body of `{name}` (line {line}) is not closed")
            };
            self.report(Problem::error(self.token().span, "missing-bracket", message));
        }
        Ok(list)
    }

    /// Parses statements up to and including a `}`; also returns whether it was there.
    #[inline(never)]
    fn statements(&mut self) -> (Vec<Statement>, bool) {
        let mut list = Vec::new();
        loop {
            if self.take("}") {
                return (list, true);
            }
            // A function cannot contain a function: the `}` of this one is missing.
            if self.is_end() || self.is_function_with_body() {
                return (list, false);
            }
            let (before, nested) = (self.at, self.nested);
            match self.statement() {
                Ok(statement) => list.push(*statement),
                Err(_) => {
                    self.nested = nested;
                    self.recover_statement();
                }
            }
            if self.at == before {
                self.advance();
            }
        }
    }

    fn is_function_with_body(&self) -> bool {
        if !self.token().first_on_line || !self.starts_function() {
            return false;
        }
        // `vec3 f(..) {`; without the brace it may be anything.
        let mut depth = 0_usize;
        for ahead in 2..200 {
            let token = self.ahead(ahead);
            match &*token.text {
                "(" => depth += 1,
                ")" => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return self.ahead(ahead + 1).is("{");
                    }
                }
                ";" | "{" | "}" => return false,
                _ if token.kind == TokenKind::End => return false,
                _ => {}
            }
        }
        false
    }

    /// Skips to the next position where a statement may begin.
    fn recover_statement(&mut self) {
        let mut depth = 0_usize;
        while !self.is_end() {
            if self.is("{") {
                depth += 1;
            } else if self.is("}") {
                if depth == 0 {
                    return;
                }
                depth -= 1;
                if depth == 0 {
                    self.advance();
                    return;
                }
            } else if self.is(";") && depth == 0 {
                self.advance();
                return;
            } else if depth == 0 && self.is_function_with_body() {
                return;
            }
            self.advance();
        }
    }

    fn statement(&mut self) -> Parse<Box<Statement>> {
        self.enter()?;
        let first = self.here();
        let statement = self.statement_kind();
        self.leave();
        let mut statement = statement?;
        statement.tokens = self.since(first);
        statement.span = self.span_of(statement.tokens);
        Ok(statement)
    }

    #[inline(never)]
    fn statement_kind(&mut self) -> Parse<Box<Statement>> {
        let token = self.token();
        if token.kind == TokenKind::Mark && token.is("{") {
            return self.block_statement();
        }
        if token.kind == TokenKind::Name {
            match &*token.text {
                "if" => return self.branch(),
                "for" => return self.for_loop(),
                "while" => return self.while_loop(),
                "do" => return self.do_loop(),
                "switch" if self.ahead(1).is("(") => return self.switch(),
                "case" | "default" if self.version.is_at_least(130, 300) => return self.case(),
                _ => {}
            }
        }
        self.simple_statement()
    }

    #[inline(never)]
    fn block_statement(&mut self) -> Parse<Box<Statement>> {
        let open = self.token().span;
        self.advance();
        let (list, is_closed) = self.statements();
        if !is_closed {
            let message = format!("the `{{` of line {} is never closed: expected `}}`", open.line);
            self.report(Problem::error(open, "missing-bracket", message));
        }
        Ok(boxed(StatementKind::Block(list)))
    }

    /// Parses a statement that contains no other.
    #[inline(never)]
    fn simple_statement(&mut self) -> Parse<Box<Statement>> {
        let token = self.token();
        if self.take(";") {
            return Ok(boxed(StatementKind::Empty));
        }
        let word = if token.kind == TokenKind::Name { &*token.text } else { "" };
        match word {
            "return" => {
                self.advance();
                let is_bare = self.is(";") || self.is("}");
                let value = if is_bare { None } else { Some(*self.expression()?) };
                self.semicolon("return")?;
                return Ok(boxed(StatementKind::Return(value)));
            }
            "break" => return self.jump(StatementKind::Break),
            "continue" => return self.jump(StatementKind::Continue),
            "discard" => return self.jump(StatementKind::Discard),
            "precision" => return Ok(boxed(StatementKind::Precision(self.precision()?))),
            "else" => {
                let message = "`else` without an `if`: is there a `;` after `if (..)`, or an extra `}`?";
                return self.fail(token.span, "stray-else", message);
            }
            _ => {}
        }
        if self.is_declaration() {
            return Ok(boxed(StatementKind::Declaration(self.declaration()?)));
        }
        let value = self.expression()?;
        self.semicolon("statement")?;
        Ok(boxed(StatementKind::Expression(*value)))
    }

    fn jump(&mut self, kind: StatementKind) -> Parse<Box<Statement>> {
        self.advance();
        self.semicolon("statement")?;
        Ok(boxed(kind))
    }

    /// Takes the `(` of a condition.
    fn open(&mut self, of: &str) -> Parse<TokenRange> {
        let open = self.here();
        if self.take("(") {
            return Ok(open);
        }
        let message = format!("expected `(` after `{of}`");
        self.fail(self.behind(), "missing-bracket", message)
    }

    #[inline(never)]
    fn branch(&mut self) -> Parse<Box<Statement>> {
        self.advance();
        let open = self.open("if")?;
        let condition = self.expression()?;
        self.close(")", open)?;
        let then = self.statement()?;
        let otherwise = if self.take("else") { Some(self.statement()?) } else { None };
        Ok(boxed(StatementKind::If { condition: *condition, then, otherwise }))
    }

    #[inline(never)]
    fn condition(&mut self) -> Parse<Box<Condition>> {
        if !self.is_declaration() {
            return Ok(Box::new(Condition::Expr(*self.expression()?)));
        }
        let first = self.here();
        let qualifiers = self.qualifiers()?;
        let ty = self.type_name()?;
        let declarators = vec![self.declarator()?];
        let tokens = self.since(first);
        let span = self.span_of(tokens);
        Ok(Box::new(Condition::Declaration(crate::ast::Declaration { qualifiers, ty, declarators, span, tokens })))
    }

    #[inline(never)]
    fn for_loop(&mut self) -> Parse<Box<Statement>> {
        self.advance();
        let open = self.open("for")?;
        match self.for_head(open) {
            Ok((initial, condition, step)) => {
                let body = self.statement()?;
                Ok(boxed(StatementKind::For { initial, condition, step, body }))
            }
            Err(stop) => {
                if !self.skip_to_close(open) {
                    return Err(stop);
                }
                let body = self.statement()?;
                Ok(boxed(StatementKind::For { initial: None, condition: None, step: None, body }))
            }
        }
    }

    /// Skips to the `)` of `open` after an error in the head of a loop.
    fn skip_to_close(&mut self, open: TokenRange) -> bool {
        let mut depth = 0_usize;
        for at in open.first as usize..self.tokens.len() {
            let token = &self.tokens[at];
            if token.is("(") {
                depth += 1;
            } else if token.is(")") {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    self.at = at + 1;
                    return true;
                }
            } else if token.is("{") || token.is("}") {
                return false;
            }
        }
        false
    }

    #[allow(clippy::type_complexity)]
    #[inline(never)]
    fn for_head(
        &mut self,
        open: TokenRange,
    ) -> Parse<(Option<Box<Statement>>, Option<Box<Condition>>, Option<crate::Expr>)> {
        let initial = if self.take(";") { None } else { Some(Box::new(self.for_initial()?)) };
        let condition = if self.is(";") { None } else { Some(self.condition()?) };
        if !self.take(";") {
            let message = "expected the second `;` of `for (..; ..; ..)`";
            return self.fail(self.behind(), "missing-semicolon", message);
        }
        let step = if self.is(")") { None } else { Some(*self.expression()?) };
        self.close(")", open)?;
        Ok((initial, condition, step))
    }

    #[inline(never)]
    fn for_initial(&mut self) -> Parse<Statement> {
        let first = self.here();
        let kind = if self.is_declaration() {
            StatementKind::Declaration(self.declaration()?)
        } else {
            let value = *self.expression()?;
            if !self.take(";") {
                let message = "expected the first `;` of `for (..; ..; ..)`";
                return self.fail(self.behind(), "missing-semicolon", message);
            }
            StatementKind::Expression(value)
        };
        let tokens = self.since(first);
        Ok(Statement { kind, span: self.span_of(tokens), tokens })
    }

    #[inline(never)]
    fn while_loop(&mut self) -> Parse<Box<Statement>> {
        self.advance();
        let open = self.open("while")?;
        let condition = self.condition()?;
        self.close(")", open)?;
        let body = self.statement()?;
        Ok(boxed(StatementKind::While { condition, body }))
    }

    #[inline(never)]
    fn do_loop(&mut self) -> Parse<Box<Statement>> {
        self.advance();
        let body = self.statement()?;
        if !self.take("while") {
            return self.fail(self.behind(), "missing-while", "expected `while (..)` at the end of this `do` loop");
        }
        let open = self.open("while")?;
        let condition = *self.expression()?;
        self.close(")", open)?;
        self.semicolon("`do .. while (..)`")?;
        Ok(boxed(StatementKind::DoWhile { body, condition }))
    }

    #[inline(never)]
    fn switch(&mut self) -> Parse<Box<Statement>> {
        self.advance();
        let open = self.open("switch")?;
        let value = *self.expression()?;
        self.close(")", open)?;
        let brace = self.token().span;
        if !self.take("{") {
            return self.fail(self.behind(), "missing-bracket", "expected `{` after `switch (..)`");
        }
        let (body, is_closed) = self.statements();
        if !is_closed {
            let message = "the `{` of this `switch` is never closed";
            self.report(Problem::error(brace, "missing-bracket", message));
        }
        Ok(boxed(StatementKind::Switch { value, body }))
    }

    #[inline(never)]
    fn case(&mut self) -> Parse<Box<Statement>> {
        let is_default = self.is("default");
        self.advance();
        let value = if is_default { None } else { Some(*self.expression()?) };
        if !self.take(":") {
            return self.fail(self.behind(), "missing-colon", "expected `:` after this `case`");
        }
        Ok(boxed(StatementKind::Case(value)))
    }
}

/// Allocates a statement on the heap, where its size does not affect the deep recursion; its span is set later.
#[inline(never)]
fn boxed(kind: StatementKind) -> Box<Statement> {
    Box::new(Statement { kind, span: Default::default(), tokens: TokenRange::default() })
}
