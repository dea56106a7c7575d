//! Parses qualifiers, types, structs and variables.

use super::{Parse, Parser};
use crate::ast::{Declaration, Declarator, LayoutEntry, Precision, Qualifier, StructDefinition, TypeName};
use crate::lex::TokenKind;
use crate::{TokenRange, lex};

impl Parser<'_> {
    #[inline(never)]
    pub(super) fn qualifiers(&mut self) -> Parse<Vec<Qualifier>> {
        let mut list = Vec::new();
        while self.token().kind == TokenKind::Name
            && lex::is_qualifier(&self.token().text, self.version)
            && !self.is_used_as_name(self.token())
        {
            let first = self.here();
            let word = self.token().text.to_string();
            self.advance();
            let mut layout = Vec::new();
            if self.is("(") && (word == "layout" || word == "subroutine") {
                layout = self.layout()?;
            }
            let tokens = self.since(first);
            list.push(Qualifier { word, layout, span: self.span_of(tokens), tokens });
        }
        Ok(list)
    }

    #[inline(never)]
    fn layout(&mut self) -> Parse<Vec<LayoutEntry>> {
        let open = self.here();
        self.advance();
        let mut entries = Vec::new();
        while !self.is(")") {
            let first = self.here();
            if self.token().kind != TokenKind::Name {
                let message = format!("expected a layout qualifier such as `location = 0`, found {}", self.found());
                return self.fail(self.token().span, "layout", message);
            }
            let name = self.token().text.to_string();
            self.advance();
            let value = if self.take("=") { Some(*self.assignment()?) } else { None };
            entries.push(LayoutEntry { name, value, tokens: self.since(first) });
            if !self.take(",") {
                break;
            }
        }
        self.close(")", open)?;
        Ok(entries)
    }

    /// Parses a type with its array sizes.
    #[inline(never)]
    pub(super) fn type_name(&mut self) -> Parse<TypeName> {
        let first = self.here();
        if self.is("struct") {
            let definition = self.structure()?;
            let sizes = self.sizes()?;
            let (name, span, tokens) = (definition.name.clone(), definition.span, definition.tokens);
            return Ok(TypeName { name, span, tokens, sizes, definition: Some(Box::new(definition)) });
        }
        let token = self.token();
        if token.kind == TokenKind::Stray {
            return self.stray();
        }
        if token.kind != TokenKind::Name || lex::is_statement(&token.text, self.version) {
            let message = format!("expected a type such as `vec3`, found {}", self.found());
            return self.fail(token.span, "missing-type", message);
        }
        self.advance();
        let sizes = self.sizes()?;
        Ok(TypeName { name: token.text.to_string(), span: token.span, tokens: first, sizes, definition: None })
    }

    #[inline(never)]
    fn structure(&mut self) -> Parse<StructDefinition> {
        let first = self.here();
        self.advance();
        let (mut name, mut tokens) = (String::new(), first);
        if !self.is("{") {
            (name, tokens) = self.name("a struct")?;
            self.structs.insert(name.clone());
        }
        self.enter()?;
        let members = self.members("struct");
        self.leave();
        let members = members?;
        let span = self.span_of(tokens);
        Ok(StructDefinition { name, span, tokens, members })
    }

    /// Parses `{ vec3 a; float b; }`.
    pub(super) fn members(&mut self, of: &str) -> Parse<Vec<Declaration>> {
        let open = self.here();
        if !self.take("{") {
            let message = format!("expected `{{` after the name of this {of}");
            return self.fail(self.behind(), "missing-bracket", message);
        }
        let mut members = Vec::new();
        while !self.is("}") && !self.is_end() {
            if self.take(";") {
                continue;
            }
            members.push(self.declaration()?);
        }
        self.close("}", open)?;
        Ok(members)
    }

    /// Parses qualifiers, type, names and `;`.
    #[inline(never)]
    pub(super) fn declaration(&mut self) -> Parse<Declaration> {
        let first = self.here();
        let qualifiers = self.qualifiers()?;
        let ty = self.type_name()?;
        self.declarators(first, qualifiers, ty)
    }

    /// Parses names and `;` after a type.
    #[inline(never)]
    pub(super) fn declarators(
        &mut self,
        first: TokenRange,
        qualifiers: Vec<Qualifier>,
        ty: TypeName,
    ) -> Parse<Declaration> {
        let mut declarators = Vec::new();
        let is_definition = ty.definition.is_some();
        if !(self.is(";") || (is_definition && self.starts_new_line())) {
            loop {
                declarators.push(self.declarator()?);
                if !self.take(",") {
                    break;
                }
            }
        }
        let after = if is_definition && declarators.is_empty() { "struct" } else { "declaration" };
        self.semicolon(after)?;
        let tokens = self.since(first);
        Ok(Declaration { qualifiers, ty, declarators, span: self.span_of(tokens), tokens })
    }

    fn starts_new_line(&self) -> bool {
        self.token().span.line > self.before().span.line
    }

    #[inline(never)]
    pub(super) fn declarator(&mut self) -> Parse<Declarator> {
        let (name, tokens) = self.name("a variable")?;
        let sizes = self.sizes()?;
        let equals = self.here();
        let initialiser = if self.take("=") { Some(*self.assignment()?) } else { None };
        Ok(Declarator { name, span: self.span_of(tokens), tokens, sizes, equals, initialiser })
    }

    /// Parses `precision mediump float;`.
    pub(super) fn precision(&mut self) -> Parse<Precision> {
        let first = self.here();
        self.advance();
        let precision = self.token().text.to_string();
        if !matches!(&*precision, "highp" | "mediump" | "lowp") {
            let message = format!("expected `highp`, `mediump` or `lowp` after `precision`, found {}", self.found());
            return self.fail(self.token().span, "precision", message);
        }
        self.advance();
        let ty = self.type_name()?;
        self.semicolon("line")?;
        let tokens = self.since(first);
        Ok(Precision { precision, ty, span: self.span_of(tokens), tokens })
    }
}
