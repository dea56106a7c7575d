//! Which statements and expressions of a shader a listing watches.

use super::pair::SteppedStage;
use gonio_glsl::ast::Function;
use gonio_glsl::walk::{Visitor, walk_unit};
use gonio_glsl::{Expr, ExprKind, Span, Statement, StatementKind};
use gonio_interpreter::{ExprId, StatementId};
use std::collections::HashSet;
use std::ops::Range;

/// The parts of the syntax tree that a listing needs.
pub(super) struct Syntax {
    /// The conditions of `if` and `?:`, and the statement around each.
    pub conditions: Vec<(ExprId, StatementId)>,
    /// The values of `return`, and their statements.
    pub returns: Vec<(ExprId, StatementId)>,
    /// Loops and their spans.
    pub loops: Vec<(StatementId, Span)>,
    /// Statements that are recorded when they are executed.
    pub recorded: HashSet<StatementId>,
    pub discards: HashSet<StatementId>,
    /// The headers of functions.
    pub headers: Vec<Span>,
    /// The bytes of their bodies.
    bodies: Vec<Range<u32>>,
}

impl Syntax {
    pub fn new(stage: &SteppedStage) -> Self {
        let syntax = Self {
            conditions: Vec::new(),
            returns: Vec::new(),
            loops: Vec::new(),
            recorded: HashSet::new(),
            discards: HashSet::new(),
            headers: Vec::new(),
            bodies: Vec::new(),
        };
        let mut collector = Collector { stage, syntax, statement: None };
        walk_unit(&stage.parsed.unit, &mut collector);
        collector.syntax
    }

    /// Whether a declaration is outside of all functions.
    pub fn is_global(&self, declaration: Span) -> bool {
        let headers = self.headers.iter().map(|header| header.start..header.end);
        !headers.chain(self.bodies.iter().cloned()).any(|function| function.contains(&declaration.start))
    }
}

struct Collector<'a> {
    stage: &'a SteppedStage,
    syntax: Syntax,
    statement: Option<StatementId>,
}

impl Collector<'_> {
    fn condition(&mut self, expr: &Expr) {
        if let (Some(expr), Some(statement)) = (self.stage.compiled.source.id(expr), self.statement) {
            self.syntax.conditions.push((expr, statement));
        }
    }
}

impl Visitor for Collector<'_> {
    fn function(&mut self, function: &Function) -> bool {
        self.statement = None;
        self.syntax.headers.push(function.span);
        let body = function.body.as_deref().unwrap_or_default();
        if let (Some(first), Some(last)) = (body.first(), body.last()) {
            self.syntax.bodies.push(first.span.start..last.span.end);
        }
        true
    }

    fn statement(&mut self, statement: &Statement) -> bool {
        let Some(id) = self.stage.compiled.source.statement_id(statement) else { return true };
        match &statement.kind {
            StatementKind::Block(_) | StatementKind::Empty | StatementKind::Case(_) => return true,
            StatementKind::For { .. } | StatementKind::While { .. } | StatementKind::DoWhile { .. } => {
                self.syntax.loops.push((id, statement.span));
            }
            StatementKind::Return(Some(value)) => {
                self.syntax.returns.extend(self.stage.compiled.source.id(value).map(|value| (value, id)));
            }
            StatementKind::Discard => {
                self.syntax.discards.insert(id);
            }
            _ => {}
        }
        self.syntax.recorded.insert(id);
        self.statement = Some(id);
        if let StatementKind::If { condition, .. } = &statement.kind {
            self.condition(condition);
        }
        true
    }

    fn expression(&mut self, expr: &Expr) -> bool {
        if let ExprKind::Ternary { condition, .. } = &expr.kind {
            self.condition(condition);
        }
        true
    }
}
