//! Checks of control flow: missing returns, and variables that are read before they are assigned.

use std::collections::HashMap;

use super::{Access, Checker};
use crate::ast::{Expr, ExprKind, Literal, Statement, StatementKind};

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
