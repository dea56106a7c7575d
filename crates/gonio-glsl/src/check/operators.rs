//! Checks operators: operand types and result types (GLSL 4.60, section 5.9).

use super::Checker;
use crate::ast::{BinaryOp, Expr, UnaryOp};
use crate::{Problem, Scalar, Span, Type};

impl Checker<'_> {
    #[inline(never)]
    pub(super) fn unary(&mut self, op: UnaryOp, operand: &mut Expr, span: Span) -> Option<Type> {
        let is_step = matches!(
            op,
            UnaryOp::PreIncrement | UnaryOp::PreDecrement | UnaryOp::PostIncrement | UnaryOp::PostDecrement
        );
        let ty = if is_step { self.target(operand, false)? } else { self.expression(operand)? };
        let is_right = match op {
            UnaryOp::Not => ty == Type::BOOL,
            UnaryOp::Complement => matches!(ty.scalar(), Some(Scalar::Int | Scalar::UInt)),
            _ => ty.scalar().is_some_and(|s| s != Scalar::Bool),
        };
        if is_right {
            return Some(ty);
        }
        let (expected, mark) = match op {
            UnaryOp::Not => ("a `bool`", "!"),
            UnaryOp::Complement => ("an `int`", "~"),
            UnaryOp::Plus => ("a number", "+"),
            UnaryOp::Minus => ("a number", "-"),
            UnaryOp::PreIncrement | UnaryOp::PostIncrement => ("a number", "++"),
            UnaryOp::PreDecrement | UnaryOp::PostDecrement => ("a number", "--"),
        };
        self.error(span, "wrong-type", format!("`{mark}` needs {expected}, found `{ty}`"));
        None
    }

    /// Returns the type of `left op right`, whose own types are known.
    #[inline(never)]
    pub(super) fn binary(&mut self, op: BinaryOp, left: &Expr, right: &Expr, span: Span) -> Option<Type> {
        let (Some(a), Some(b)) = (left.ty.clone(), right.ty.clone()) else {
            return self.known_anyway(op);
        };
        let found = match op {
            BinaryOp::Add | BinaryOp::Subtract | BinaryOp::Multiply | BinaryOp::Divide => {
                self.arithmetic(op, left, right)
            }
            BinaryOp::Remainder | BinaryOp::BitAnd | BinaryOp::BitOr | BinaryOp::BitXor => self.integer(left, right),
            BinaryOp::ShiftLeft | BinaryOp::ShiftRight => {
                let is_integer = |t: &Type| {
                    matches!(t, Type::Scalar(Scalar::Int | Scalar::UInt) | Type::Vector(Scalar::Int | Scalar::UInt, _))
                };
                (is_integer(&a) && is_integer(&b)).then(|| a.clone())
            }
            BinaryOp::Less | BinaryOp::Greater | BinaryOp::LessEqual | BinaryOp::GreaterEqual => {
                let are_numbers = [&a, &b].iter().all(|t| matches!(t, Type::Scalar(s) if *s != Scalar::Bool));
                are_numbers.then(|| self.unify(left, right)).flatten().map(|_| Type::BOOL)
            }
            BinaryOp::Equal | BinaryOp::NotEqual => self.unify(left, right).map(|_| Type::BOOL),
            BinaryOp::And | BinaryOp::Or | BinaryOp::Xor => (a == Type::BOOL && b == Type::BOOL).then_some(Type::BOOL),
        };
        if found.is_none() {
            self.problems.push(refusal(op, &a, &b, span));
            return self.known_anyway(op);
        }
        found
    }

    fn known_anyway(&self, op: BinaryOp) -> Option<Type> {
        let is_test = matches!(
            op,
            BinaryOp::Less
                | BinaryOp::Greater
                | BinaryOp::LessEqual
                | BinaryOp::GreaterEqual
                | BinaryOp::Equal
                | BinaryOp::NotEqual
                | BinaryOp::And
                | BinaryOp::Or
                | BinaryOp::Xor
        );
        is_test.then_some(Type::BOOL)
    }

    /// Converts both sides to one type.
    fn unify(&mut self, left: &Expr, right: &Expr) -> Option<Type> {
        let (a, b) = (left.ty.as_ref()?, right.ty.as_ref()?);
        if a.becomes(b) {
            self.convert(left, Some(&b.clone()), "this");
            Some(b.clone())
        } else if b.becomes(a) {
            self.convert(right, Some(&a.clone()), "this");
            Some(a.clone())
        } else {
            None
        }
    }

    /// Converts the components of both sides to one type, keeping their shapes.
    fn same_scalar(&mut self, left: &Expr, right: &Expr) -> Option<Scalar> {
        let (a, b) = (left.ty.clone()?, right.ty.clone()?);
        let (s, t) = (a.scalar()?, b.scalar()?);
        if s == Scalar::Bool || t == Scalar::Bool {
            return None;
        }
        let scalar = s.max(t);
        self.convert(left, Some(&a.with_scalar(scalar)), "this");
        self.convert(right, Some(&b.with_scalar(scalar)), "this");
        Some(scalar)
    }

    fn integer(&mut self, left: &Expr, right: &Expr) -> Option<Type> {
        let (a, b) = (left.ty.clone()?, right.ty.clone()?);
        let is_integer = |t: &Type| matches!(t.scalar(), Some(Scalar::Int | Scalar::UInt));
        if !is_integer(&a) || !is_integer(&b) {
            return None;
        }
        let shape = shape_of(BinaryOp::Add, &a, &b)?;
        Some(shape.with_scalar(self.same_scalar(left, right)?))
    }

    fn arithmetic(&mut self, op: BinaryOp, left: &Expr, right: &Expr) -> Option<Type> {
        let shape = shape_of(op, left.ty.as_ref()?, right.ty.as_ref()?)?;
        let is_matrix = [left, right].iter().any(|e| matches!(e.ty, Some(Type::Matrix { .. })));
        let is_bool = [left, right].iter().any(|e| e.ty.as_ref().and_then(Type::scalar) == Some(Scalar::Bool));
        if is_matrix && is_bool {
            return None;
        }
        Some(shape.with_scalar(self.same_scalar(left, right)?))
    }
}

/// Returns the shape of the result, regardless of the component type.
fn shape_of(op: BinaryOp, a: &Type, b: &Type) -> Option<Type> {
    match (a, b) {
        (Type::Scalar(_), Type::Scalar(_) | Type::Vector(..) | Type::Matrix { .. }) => Some(b.clone()),
        (Type::Vector(..) | Type::Matrix { .. }, Type::Scalar(_)) => Some(a.clone()),
        (Type::Vector(_, m), Type::Vector(_, n)) => (m == n).then(|| a.clone()),
        (Type::Matrix { scalar, columns, rows }, Type::Vector(_, n)) if op == BinaryOp::Multiply => {
            (columns == n).then(|| Type::scalar_or_vector(*scalar, *rows))
        }
        (Type::Vector(_, n), Type::Matrix { scalar, columns, rows }) if op == BinaryOp::Multiply => {
            (rows == n).then(|| Type::scalar_or_vector(*scalar, *columns))
        }
        (Type::Matrix { scalar, columns, rows }, Type::Matrix { columns: c, rows: r, .. }) => {
            if op == BinaryOp::Multiply {
                (columns == r).then_some(Type::Matrix { scalar: *scalar, columns: *c, rows: *rows })
            } else {
                (columns == c && rows == r).then(|| a.clone())
            }
        }
        _ => None,
    }
}

fn refusal(op: BinaryOp, a: &Type, b: &Type, span: Span) -> Problem {
    let is_float = |t: &Type| t.scalar() == Some(Scalar::Float);
    let message = match op {
        BinaryOp::Add => format!("cannot add `{a}` and `{b}`"),
        BinaryOp::Subtract => format!("cannot subtract `{b}` from `{a}`"),
        BinaryOp::Multiply => format!("cannot multiply `{a}` by `{b}`"),
        BinaryOp::Divide => format!("cannot divide `{a}` by `{b}`"),
        BinaryOp::Less
        | BinaryOp::Greater
        | BinaryOp::LessEqual
        | BinaryOp::GreaterEqual
        | BinaryOp::Equal
        | BinaryOp::NotEqual => {
            format!("cannot compare `{a}` with `{b}` using `{}`", op.mark())
        }
        BinaryOp::And | BinaryOp::Or | BinaryOp::Xor => {
            format!("`{}` needs a `bool` on both sides, found `{a}` and `{b}`", op.mark())
        }
        _ => format!("`{}` needs integers on both sides, found `{a}` and `{b}`", op.mark()),
    };
    let problem = Problem::error(span, "wrong-operands", message);
    let is_three_by_four = |t: &Type, u: &Type| {
        matches!(t, Type::Matrix { columns: 4, rows: 4, .. }) && matches!(u, Type::Vector(Scalar::Float, 3))
    };
    if op == BinaryOp::Remainder && is_float(a) {
        problem.with_help("use `mod(a, b)` for floats")
    } else if is_three_by_four(a, b) || is_three_by_four(b, a) {
        problem.with_help("write `vec4(.., 1.0)` for a position, `vec4(.., 0.0)` for a direction, or use `mat3(..)`")
    } else {
        problem
    }
}
