//! Checks statements: scopes, conditions, returned values.

use super::{Access, Checker, SymbolKind};
use crate::ast::{Condition, Expr, ExprKind, Literal, Statement, StatementKind};
use crate::limits::MOST_CASES;
use crate::{Limit, Problem, Span, Stage, Type};
use std::collections::HashMap;

impl Checker<'_> {
    pub(super) fn statement(&mut self, statement: &mut Statement, returns: Option<&Type>) {
        match &mut statement.kind {
            StatementKind::Declaration(declaration) => self.declaration(declaration, SymbolKind::Local),
            StatementKind::Expression(expr) => {
                self.expression(expr);
            }
            StatementKind::If { condition, then, otherwise } => {
                self.condition(condition, "the condition of an `if`");
                self.in_scope(then, returns);
                if let Some(otherwise) = otherwise {
                    self.in_scope(otherwise, returns);
                }
            }
            StatementKind::For { initial, condition, step, body } => {
                self.push_scope();
                if let Some(initial) = initial {
                    self.statement(initial, returns);
                }
                self.enter_loop();
                self.count_loop(statement.span);
                if let Some(condition) = condition {
                    self.loop_condition(condition);
                }
                self.statement_or_block(body, returns);
                if let Some(step) = step {
                    self.expression(step);
                }
                self.loops.pop();
                self.loop_depth -= 1;
                self.pop_scope();
            }
            StatementKind::While { condition, body } => {
                self.push_scope();
                self.enter_loop();
                self.count_loop(statement.span);
                self.loop_condition(condition);
                self.statement_or_block(body, returns);
                self.loops.pop();
                self.loop_depth -= 1;
                self.pop_scope();
            }
            StatementKind::DoWhile { body, condition } => {
                self.enter_loop();
                self.count_loop(statement.span);
                self.in_scope(body, returns);
                self.condition(condition, "the condition of a loop");
                self.loops.pop();
                self.loop_depth -= 1;
            }
            StatementKind::Switch { value, body } => {
                let found = self.expression(value);
                if found.is_some_and(|t| t != Type::INT && t != Type::UINT) {
                    self.error(value.span, "switch-type", "the value of a `switch` must be an `int`");
                }
                if body.iter().filter(|s| matches!(s.kind, StatementKind::Case(_))).count() > MOST_CASES {
                    self.beyond(value.span, Limit::Cases);
                }
                self.push_scope();
                // In a switch, as in a loop, source order is not execution order.
                self.enter_loop();
                for statement in body {
                    self.statement(statement, returns);
                }
                self.loops.pop();
                self.pop_scope();
            }
            StatementKind::Case(value) => {
                if let Some(value) = value {
                    self.expression(value);
                }
            }
            StatementKind::Return(value) => self.returned(value.as_mut(), returns, statement.span),
            StatementKind::Block(list) => {
                self.push_scope();
                for statement in list {
                    self.statement(statement, returns);
                }
                self.pop_scope();
            }
            StatementKind::Discard => {
                if self.stage == Stage::Vertex {
                    self.error(statement.span, "discard-in-vertex", "only a fragment shader can `discard`");
                }
            }
            StatementKind::Break | StatementKind::Continue => {
                if self.loops.is_empty() {
                    let message = "`break` or `continue` outside of a loop";
                    self.error(statement.span, "outside-loop", message);
                }
            }
            StatementKind::Precision(_) | StatementKind::Empty => {}
        }
    }

    fn enter_loop(&mut self) {
        self.loop_count += 1;
        self.loops.push(self.loop_count);
    }

    /// Checks a branch, which is a scope of its own with or without `{}`.
    fn in_scope(&mut self, statement: &mut Statement, returns: Option<&Type>) {
        self.push_scope();
        self.statement_or_block(statement, returns);
        self.pop_scope();
    }

    /// Checks a loop's body, which shares the scope of its head.
    fn statement_or_block(&mut self, statement: &mut Statement, returns: Option<&Type>) {
        self.push_scope();
        self.statement(statement, returns);
        self.pop_scope();
    }

    fn condition(&mut self, condition: &mut Expr, subject: &str) {
        let found = self.expression(condition);
        if let Some(found) = found.filter(|t| *t != Type::BOOL) {
            let message = format!("{subject} must be a `bool`, found `{found}`");
            let mut problem = Problem::error(condition.span, "condition-type", message);
            if matches!(condition.kind, crate::ExprKind::Assign { op: None, .. }) {
                problem = problem.with_help("`==` compares, `=` assigns");
            }
            self.problems.push(problem);
        }
    }

    fn loop_condition(&mut self, condition: &mut Condition) {
        match condition {
            Condition::Expr(expr) => self.condition(expr, "the condition of a loop"),
            Condition::Declaration(declaration) => self.declaration(declaration, SymbolKind::Local),
        }
    }

    fn returned(&mut self, value: Option<&mut Expr>, returns: Option<&Type>, span: Span) {
        match (value, returns) {
            (Some(value), Some(Type::Void)) => {
                let found = self.expression(value);
                if found != Some(Type::Void) {
                    self.error(value.span, "return-type", "this function returns `void` and cannot return a value");
                }
            }
            (Some(value), returns) => {
                self.expression(value);
                self.convert(value, returns, "the returned value");
            }
            (None, Some(returns)) if *returns != Type::Void => {
                self.error(span, "return-type", format!("this function must return `{returns}`"));
            }
            (None, _) => {}
        }
    }
}

/// Whether control flow never reaches the end of these statements.
pub(super) fn always_leaves(list: &[Statement]) -> bool {
    list.iter().any(leaves)
}

fn leaves(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::Return(_) | StatementKind::Discard => true,
        StatementKind::Block(list) => always_leaves(list),
        StatementKind::If { then, otherwise: Some(otherwise), .. } => leaves(then) && leaves(otherwise),
        // `while (true)` ends only by a return, or by a break, which is rare enough to ignore.
        StatementKind::While { condition, .. } => {
            matches!(&**condition, crate::ast::Condition::Expr(e) if is_true(e))
        }
        StatementKind::For { condition: None, .. } => true,
        StatementKind::DoWhile { body, .. } => leaves(body),
        // If the default returns, the switch is assumed to be complete.
        StatementKind::Switch { body, .. } => {
            let default = body.iter().position(|s| matches!(s.kind, StatementKind::Case(None)));
            default.is_some_and(|at| always_leaves(&body[at..]))
        }
        _ => false,
    }
}

fn is_true(expr: &Expr) -> bool {
    matches!(expr.kind, ExprKind::Literal(Literal::Bool(true)))
}

impl Checker<'_> {
    /// Reports local variables whose first use reads them. An assignment in a branch, or in an earlier iteration of a
    /// loop, is assumed to have been executed.
    pub(super) fn report_unset(&mut self) {
        let mut of: HashMap<usize, Vec<&Access>> = HashMap::new();
        for access in &self.accesses {
            of.entry(access.symbol).or_default().push(access);
        }
        let mut found = Vec::new();
        for (symbol, accesses) in of {
            let known = &self.symbols[symbol];
            let Some(first) = accesses.first() else { continue };
            if known.has_initialiser || first.is_write {
                continue;
            }
            // The loop around the read that is within the variable's own scope.
            let around = first.loops.get(known.loops);
            let is_written_there = |a: &&&Access| a.is_write && a.loops.get(known.loops) == around;
            if around.is_some() && accesses.iter().any(|a| is_written_there(&a)) {
                continue;
            }
            found.push((first.span, known.name.clone()));
        }
        for (span, name) in found {
            self.strict(span, "unset", format!("`{name}` is used before it is assigned a value"));
        }
    }
}
