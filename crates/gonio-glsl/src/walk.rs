//! Visits all nodes of the tree in source order.

use crate::ast::{
    Condition, Declaration, Expr, ExprKind, Function, Item, Param, Statement, StatementKind, TypeName, Unit,
};

/// Called at each node. Returning false skips its children.
#[allow(unused_variables)]
pub trait Visitor {
    /// Visits a function definition or prototype.
    fn function(&mut self, function: &Function) -> bool {
        true
    }
    /// Visits a function's parameter.
    fn param(&mut self, param: &Param) {}
    /// Visits variables: global, local, or members.
    fn declaration(&mut self, declaration: &Declaration) -> bool {
        true
    }
    /// Visits a statement.
    fn statement(&mut self, statement: &Statement) -> bool {
        true
    }
    /// Visits an expression before its parts.
    fn expression(&mut self, expr: &Expr) -> bool {
        true
    }
    /// Visits an expression after its parts.
    fn leave_expression(&mut self, expr: &Expr) {}
}

/// Visits a whole shader.
pub fn walk_unit(unit: &Unit, visitor: &mut impl Visitor) {
    for item in &unit.items {
        match item {
            Item::Function(function) => {
                if !visitor.function(function) {
                    continue;
                }
                for param in &function.params {
                    visitor.param(param);
                    sizes(&param.sizes, visitor);
                }
                for statement in function.body.iter().flatten() {
                    walk_statement(statement, visitor);
                }
            }
            Item::Declaration(declaration) => walk_declaration(declaration, visitor),
            Item::Block(block) => {
                for member in &block.members {
                    walk_declaration(member, visitor);
                }
            }
            Item::Precision(_) | Item::Qualify(_) | Item::Empty(_) => {}
        }
    }
}

fn sizes(list: &[Option<Expr>], visitor: &mut impl Visitor) {
    for size in list.iter().flatten() {
        walk_expression(size, visitor);
    }
}

fn walk_type(ty: &TypeName, visitor: &mut impl Visitor) {
    sizes(&ty.sizes, visitor);
    for member in ty.definition.iter().flat_map(|d| &d.members) {
        walk_declaration(member, visitor);
    }
}

/// Visits variables with their initialisers.
pub fn walk_declaration(declaration: &Declaration, visitor: &mut impl Visitor) {
    if !visitor.declaration(declaration) {
        return;
    }
    walk_type(&declaration.ty, visitor);
    for declarator in &declaration.declarators {
        sizes(&declarator.sizes, visitor);
        if let Some(initialiser) = &declarator.initialiser {
            walk_expression(initialiser, visitor);
        }
    }
}

/// Visits a statement and its contents.
pub fn walk_statement(statement: &Statement, visitor: &mut impl Visitor) {
    if !visitor.statement(statement) {
        return;
    }
    let condition = |condition: &Condition, visitor: &mut _| match condition {
        Condition::Expr(expr) => walk_expression(expr, visitor),
        Condition::Declaration(declaration) => walk_declaration(declaration, visitor),
    };
    match &statement.kind {
        StatementKind::Declaration(declaration) => walk_declaration(declaration, visitor),
        StatementKind::Expression(expr) => walk_expression(expr, visitor),
        StatementKind::If { condition, then, otherwise } => {
            walk_expression(condition, visitor);
            walk_statement(then, visitor);
            if let Some(otherwise) = otherwise {
                walk_statement(otherwise, visitor);
            }
        }
        StatementKind::For { initial, condition: test, step, body } => {
            if let Some(initial) = initial {
                walk_statement(initial, visitor);
            }
            if let Some(test) = test {
                condition(test, visitor);
            }
            if let Some(step) = step {
                walk_expression(step, visitor);
            }
            walk_statement(body, visitor);
        }
        StatementKind::While { condition: test, body } => {
            condition(test, visitor);
            walk_statement(body, visitor);
        }
        StatementKind::DoWhile { body, condition } => {
            walk_statement(body, visitor);
            walk_expression(condition, visitor);
        }
        StatementKind::Switch { value, body } => {
            walk_expression(value, visitor);
            for statement in body {
                walk_statement(statement, visitor);
            }
        }
        StatementKind::Case(value) | StatementKind::Return(value) => {
            if let Some(value) = value {
                walk_expression(value, visitor);
            }
        }
        StatementKind::Block(list) => {
            for statement in list {
                walk_statement(statement, visitor);
            }
        }
        StatementKind::Break
        | StatementKind::Continue
        | StatementKind::Discard
        | StatementKind::Precision(_)
        | StatementKind::Empty => {}
    }
}

/// Returns the parts of an expression, from left to right.
#[must_use]
pub fn parts(expr: &Expr) -> Vec<&Expr> {
    match &expr.kind {
        ExprKind::Literal(_) | ExprKind::Name(_) => Vec::new(),
        ExprKind::Call(call) => call.sizes.iter().flatten().chain(&call.args).collect(),
        ExprKind::Field { base, .. } | ExprKind::Length(base) => vec![base],
        ExprKind::Index { base, index } => vec![base, index],
        ExprKind::Unary { operand, .. } => vec![operand],
        ExprKind::Binary { left, right, .. } => vec![left, right],
        ExprKind::Ternary { condition, then, otherwise } => vec![condition, then, otherwise],
        ExprKind::Assign { target, value, .. } => vec![target, value],
        ExprKind::Sequence(list) | ExprKind::List(list) => list.iter().collect(),
    }
}

/// Visits an expression and its parts.
pub fn walk_expression(expr: &Expr, visitor: &mut impl Visitor) {
    if !visitor.expression(expr) {
        return;
    }
    for part in parts(expr) {
        walk_expression(part, visitor);
    }
    visitor.leave_expression(expr);
}
