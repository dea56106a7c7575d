//! Evaluates constant expressions.

use crate::ast::{BinaryOp, Expr, ExprKind, Literal, UnaryOp};
use crate::{Scalar, Type};

/// Components of a scalar, vector or matrix (columns first); booleans are 0 and 1.
pub type Components = Vec<f64>;

/// Returns the components of an expression if they are known. `named` returns those of constants. Types must be filled
/// in.
pub fn evaluate(expr: &Expr, named: &dyn Fn(&str) -> Option<Components>) -> Option<Components> {
    match &expr.kind {
        ExprKind::Literal(literal) => Some(vec![match literal {
            Literal::Int(value) => *value as f64,
            Literal::UInt(value) => f64::from(*value),
            Literal::Float(value) | Literal::Double(value) => *value,
            Literal::Bool(value) => f64::from(u8::from(*value)),
        }]),
        ExprKind::Name(name) => named(name),
        ExprKind::Unary { op, operand } => {
            let value = evaluate(operand, named)?;
            match op {
                UnaryOp::Plus => Some(value),
                UnaryOp::Minus => Some(value.iter().map(|v| -v).collect()),
                UnaryOp::Not => Some(value.iter().map(|v| f64::from(u8::from(*v == 0.0))).collect()),
                _ => None,
            }
        }
        ExprKind::Binary { op, left, right } => {
            let is_integer = matches!(expr.ty.as_ref()?.scalar()?, Scalar::Int | Scalar::UInt);
            // Matrices are not multiplied component by component.
            if *op == BinaryOp::Multiply && [left, right].iter().any(|e| matches!(e.ty, Some(Type::Matrix { .. }))) {
                return None;
            }
            combine(*op, &evaluate(left, named)?, &evaluate(right, named)?, is_integer)
        }
        ExprKind::Call(call) if call.is_constructor && call.sizes.is_empty() => {
            let mut parts = Vec::new();
            for arg in &call.args {
                parts.extend(evaluate(arg, named)?);
            }
            construct(expr.ty.as_ref()?, call.args.first()?.ty.as_ref()?, parts)
        }
        ExprKind::Length(base) => match base.ty.as_ref()? {
            Type::Array(_, count) => Some(vec![f64::from((*count)?)]),
            Type::Vector(_, size) => Some(vec![f64::from(*size)]),
            Type::Matrix { columns, .. } => Some(vec![f64::from(*columns)]),
            _ => None,
        },
        _ => None,
    }
}

fn combine(op: BinaryOp, left: &[f64], right: &[f64], is_integer: bool) -> Option<Components> {
    let count = left.len().max(right.len());
    if count == 0 || [left.len(), right.len()].iter().any(|n| *n != 1 && *n != count) {
        return None;
    }
    (0..count)
        .map(|i| {
            let (a, b) = (left[i % left.len()], right[i % right.len()]);
            match op {
                BinaryOp::Add => Some(a + b),
                BinaryOp::Subtract => Some(a - b),
                BinaryOp::Multiply => Some(a * b),
                BinaryOp::Divide if is_integer && b == 0.0 => None,
                BinaryOp::Divide if is_integer => Some((a / b).trunc()),
                BinaryOp::Divide => Some(a / b),
                BinaryOp::Remainder if b != 0.0 => Some(a % b),
                BinaryOp::ShiftLeft if is_integer && (0.0..32.0).contains(&b) => Some(a * b.exp2()),
                BinaryOp::ShiftRight if is_integer && (0.0..32.0).contains(&b) => Some((a / b.exp2()).floor()),
                BinaryOp::BitAnd if is_integer => Some((a as i64 & b as i64) as f64),
                BinaryOp::BitOr if is_integer => Some((a as i64 | b as i64) as f64),
                BinaryOp::BitXor if is_integer => Some((a as i64 ^ b as i64) as f64),
                _ => None,
            }
        })
        .collect()
}

fn construct(ty: &Type, first: &Type, parts: Components) -> Option<Components> {
    let count = ty.components()? as usize;
    let mut parts = match ty {
        // One number fills the diagonal of a matrix.
        Type::Matrix { rows, .. } if parts.len() == 1 => {
            let rows = usize::from(*rows);
            (0..count).map(|i| if i / rows == i % rows { parts[0] } else { 0.0 }).collect()
        }
        Type::Matrix { .. } if matches!(first, Type::Matrix { .. }) && first != ty => return None,
        _ if parts.len() == 1 => vec![parts[0]; count],
        _ => parts,
    };
    if parts.len() < count {
        return None;
    }
    parts.truncate(count);
    match ty.scalar()? {
        Scalar::Int | Scalar::UInt => parts.iter_mut().for_each(|p| *p = p.trunc()),
        Scalar::Bool => parts.iter_mut().for_each(|p| *p = f64::from(u8::from(*p != 0.0))),
        _ => {}
    }
    Some(parts)
}
