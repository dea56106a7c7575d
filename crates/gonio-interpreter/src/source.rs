//! The expressions and statements of a shader by number, with their positions.

use gonio_glsl::ast::Function;
use gonio_glsl::walk::{Visitor, walk_unit};
use gonio_glsl::{Expr, Parsed, Span, Statement, TokenRange, Type};
use std::collections::HashMap;

/// The number of an expression in [`SourceMap::expressions`], in source order, outer ones first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprId(pub u32);

/// The number of a statement in [`SourceMap::statements`], in source order, outer ones first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StatementId(pub u32);

/// An expression of the source.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceExpression {
    /// Its position.
    pub span: Span,
    /// Its tokens, which identify it in the syntax tree.
    pub tokens: TokenRange,
    /// Its type before implicit conversions; `None` if unknown.
    pub ty: Option<Type>,
    /// The function around it; `None` outside of functions.
    pub function: Option<String>,
}

/// A statement of the source.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceStatement {
    /// Its position.
    pub span: Span,
    /// Its tokens.
    pub tokens: TokenRange,
    /// The function around it.
    pub function: String,
}

/// All expressions and statements of a shader.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SourceMap {
    /// By [`ExprId`].
    pub expressions: Vec<SourceExpression>,
    /// By [`StatementId`].
    pub statements: Vec<SourceStatement>,
    by_tokens: HashMap<(u32, u32), ExprId>,
    statements_by_tokens: HashMap<(u32, u32), StatementId>,
}

impl SourceMap {
    /// Numbers the expressions and statements of a checked shader.
    #[must_use]
    pub fn new(parsed: &Parsed) -> Self {
        let mut collector = Collector { map: Self::default(), function: None, end: 0 };
        walk_unit(&parsed.unit, &mut collector);
        collector.map
    }

    /// Returns an expression of the syntax tree.
    #[must_use]
    pub fn id(&self, expr: &Expr) -> Option<ExprId> {
        self.by_tokens.get(&(expr.tokens.first, expr.tokens.last)).copied()
    }

    /// Returns a statement of the syntax tree.
    #[must_use]
    pub fn statement_id(&self, statement: &Statement) -> Option<StatementId> {
        self.statements_by_tokens.get(&(statement.tokens.first, statement.tokens.last)).copied()
    }

    /// Returns an expression by its number.
    #[must_use]
    pub fn expression(&self, id: ExprId) -> Option<&SourceExpression> {
        self.expressions.get(id.0 as usize)
    }

    /// Returns the smallest expression that contains a byte of the source.
    #[must_use]
    pub fn at_byte(&self, byte: u32) -> Option<ExprId> {
        let around = self.expressions.iter().enumerate().filter(|(_, e)| (e.span.start..e.span.end).contains(&byte));
        around.min_by_key(|(_, e)| e.span.end - e.span.start).map(|(index, _)| ExprId(index as u32))
    }
}

struct Collector {
    map: SourceMap,
    function: Option<String>,
    /// The last token of the current function.
    end: u32,
}

impl Collector {
    fn function_at(&self, tokens: TokenRange) -> Option<String> {
        self.function.clone().filter(|_| tokens.first <= self.end)
    }
}

impl Visitor for Collector {
    fn function(&mut self, function: &Function) -> bool {
        self.function = Some(function.name.clone());
        self.end = function.tokens.last;
        true
    }

    fn statement(&mut self, statement: &Statement) -> bool {
        let id = StatementId(self.map.statements.len() as u32);
        let key = (statement.tokens.first, statement.tokens.last);
        self.map.statements_by_tokens.entry(key).or_insert(id);
        self.map.statements.push(SourceStatement {
            span: statement.span,
            tokens: statement.tokens,
            function: self.function_at(statement.tokens).unwrap_or_default(),
        });
        true
    }

    fn expression(&mut self, expr: &Expr) -> bool {
        let id = ExprId(self.map.expressions.len() as u32);
        self.map.by_tokens.entry((expr.tokens.first, expr.tokens.last)).or_insert(id);
        self.map.expressions.push(SourceExpression {
            span: expr.span,
            tokens: expr.tokens,
            ty: expr.ty.clone(),
            function: self.function_at(expr.tokens),
        });
        true
    }
}
