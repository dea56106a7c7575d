//! Parses top-level constructs.

use super::{Parse, Parser};
use crate::ast::{Function, InterfaceBlock, Item, Param, Qualifier, Qualify, TypeName, Unit};
use crate::lex::TokenKind;
use crate::{Problem, TokenRange, lex};

impl Parser<'_> {
    pub(super) fn unit(&mut self) -> Unit {
        let mut items = Vec::new();
        while !self.is_end() {
            let before = self.at;
            match self.item() {
                Ok(item) => items.push(item),
                Err(_) => self.recover_item(),
            }
            if self.at == before {
                self.advance();
            }
        }
        Unit { items }
    }

    /// Skips to the end of an invalid construct: after a `;`, or after the `}` of a body.
    fn recover_item(&mut self) {
        self.nested = 0;
        let mut depth = 0_usize;
        while !self.is_end() {
            if self.is("{") {
                depth += 1;
            } else if self.is("}") {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    self.advance();
                    self.take(";");
                    return;
                }
            } else if self.is(";") && depth == 0 {
                self.advance();
                return;
            } else if depth == 0 && self.token().first_on_line && self.starts_function() {
                return;
            }
            self.advance();
        }
    }

    /// Whether a function begins here: `type name (`.
    pub(super) fn starts_function(&self) -> bool {
        let token = self.token();
        (self.is_type_name(token) || token.is("void")) && self.ahead(1).kind == TokenKind::Name && self.ahead(2).is("(")
    }

    fn item(&mut self) -> Parse<Item> {
        let first = self.here();
        let token = self.token();
        if self.take(";") {
            return Ok(Item::Empty(token.span));
        }
        if self.is("}") {
            self.report(Problem::error(
                token.span,
                "stray-bracket",
                "unexpected `}`: this one, or one before it, closes nothing",
            ));
            self.advance();
            return self.item_or_end(first);
        }
        if self.is("precision") {
            return Ok(Item::Precision(self.precision()?));
        }
        if token.kind == TokenKind::Stray {
            return self.stray();
        }
        let qualifiers = self.qualifiers()?;
        if !qualifiers.is_empty() {
            if self.take(";") {
                return Ok(self.qualify(first, qualifiers, Vec::new()));
            }
            let is_bare = self.token().kind == TokenKind::Name
                && !self.starts_type()
                && (self.ahead(1).is(";") || self.ahead(1).is(","));
            if is_bare && qualifiers.iter().any(|q| matches!(&*q.word, "invariant" | "precise")) {
                return self.names_to_qualify(first, qualifiers);
            }
            if self.token().kind == TokenKind::Name && self.ahead(1).is("{") && !self.is("struct") {
                return self.block(first, qualifiers);
            }
        }
        if self.is_statement_outside() && qualifiers.is_empty() {
            let message = "statement outside of a function";
            return self.fail(token.span, "outside-function", message);
        }
        let ty = self.type_name()?;
        if self.token().kind == TokenKind::Name && self.ahead(1).is("(") {
            return self.function(first, qualifiers, ty);
        }
        Ok(Item::Declaration(self.declarators(first, qualifiers, ty)?))
    }

    fn item_or_end(&mut self, first: TokenRange) -> Parse<Item> {
        if self.is_end() { Ok(Item::Empty(self.span_of(first))) } else { self.item() }
    }

    /// Whether a statement is here: `x = 1;`, `if (..)`, `main();`.
    fn is_statement_outside(&self) -> bool {
        let (token, next) = (self.token(), self.ahead(1));
        if token.kind != TokenKind::Name {
            return matches!(&*token.text, "++" | "--" | "{");
        }
        let controls = ["if", "for", "while", "do", "return", "break", "continue", "discard", "else", "switch"];
        controls.contains(&&*token.text)
            || (next.kind == TokenKind::Mark
                && !lex::is_type(&token.text, self.version)
                && !matches!(&*next.text, "[" | ";" | "{" | "}" | ")"))
    }

    fn qualify(&self, first: TokenRange, qualifiers: Vec<Qualifier>, names: Vec<(String, crate::Span)>) -> Item {
        let tokens = self.since(first);
        Item::Qualify(Qualify { qualifiers, names, span: self.span_of(tokens), tokens })
    }

    fn names_to_qualify(&mut self, first: TokenRange, qualifiers: Vec<Qualifier>) -> Parse<Item> {
        let mut names = Vec::new();
        loop {
            let (name, place) = self.name("a variable")?;
            names.push((name, self.span_of(place)));
            if !self.take(",") {
                break;
            }
        }
        self.semicolon("line")?;
        Ok(self.qualify(first, qualifiers, names))
    }

    fn block(&mut self, first: TokenRange, qualifiers: Vec<Qualifier>) -> Parse<Item> {
        let (name, name_tokens) = self.name("a block")?;
        let members = self.members("block")?;
        let close = TokenRange { first: self.at.saturating_sub(1) as u32, last: self.at.saturating_sub(1) as u32 };
        let instance = if self.token().kind == TokenKind::Name && (self.ahead(1).is(";") || self.ahead(1).is("[")) {
            Some(self.declarator()?)
        } else {
            None
        };
        self.semicolon("block")?;
        let tokens = self.since(first);
        let (name_span, span) = (self.span_of(name_tokens), self.span_of(tokens));
        Ok(Item::Block(InterfaceBlock {
            qualifiers,
            name,
            name_span,
            name_tokens,
            members,
            instance,
            span,
            tokens,
            close,
        }))
    }

    fn function(&mut self, first: TokenRange, qualifiers: Vec<Qualifier>, returns: TypeName) -> Parse<Item> {
        // A precision may precede the return type; nothing else matters there.
        drop(qualifiers);
        let (name, name_tokens) = self.name("a function")?;
        let params = self.params()?;
        let name_span = self.span_of(name_tokens);
        let mut open = self.here();
        let body = if self.is("{") {
            Some(self.body(&name)?)
        } else {
            if !self.is(";") && self.is_end() || self.starts_function() {
                open = TokenRange { first: open.first.saturating_sub(1), last: open.last.saturating_sub(1) };
            }
            self.semicolon("function's head, or its `{`")?;
            None
        };
        if !self.tokens[open.first as usize].is("{") && body.is_some() {
            open = name_tokens;
        }
        let tokens = self.since(first);
        let span = self.span_of(tokens);
        Ok(Item::Function(Function { name, name_span, name_tokens, returns, params, body, span, tokens, open }))
    }

    fn params(&mut self) -> Parse<Vec<Param>> {
        let open = self.here();
        self.advance();
        let mut params = Vec::new();
        if self.is("void") && self.ahead(1).is(")") {
            self.advance();
        }
        if self.take(")") {
            return Ok(params);
        }
        loop {
            let qualifiers = self.qualifiers()?;
            let ty = self.type_name()?;
            let (mut name, mut tokens) = (String::new(), ty.tokens);
            if self.token().kind == TokenKind::Name {
                (name, tokens) = self.name("a parameter")?;
            }
            let sizes = self.sizes()?;
            params.push(Param { qualifiers, ty, name, span: self.span_of(tokens), tokens, sizes });
            if !self.take(",") {
                break;
            }
        }
        self.close(")", open)?;
        Ok(params)
    }
}
