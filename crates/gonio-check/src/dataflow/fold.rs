//! Values that are known without running the shader.

use super::graph::{Graph, Id, Op, component};
use gonio_glsl::ast::BinaryOp;
use gonio_glsl::{Components, Scalar, Type};

/// The value of a node about to be made.
pub(crate) fn number(graph: &Graph, op: &Op, ty: Option<&Type>) -> Option<Components> {
    let of = |id: &Id| graph.number(*id);
    match op {
        Op::Number(number) => Some(number.clone()),
        // A switch that the exercise does not know is off: `if (useNormalMap)`.
        Op::Input { role: None, .. } if ty == Some(&Type::Scalar(Scalar::Bool)) => Some(vec![0.0]),
        Op::Copy(a, _) | Op::Interpolated(a) => of(a).cloned(),
        Op::Neg(a) => Some(of(a)?.iter().map(|x| -x).collect()),
        Op::Binary(op, a, b) => {
            let is_matrix = |id: &Id| graph.node(*id).is_matrix;
            if *op == BinaryOp::Multiply && (is_matrix(a) || is_matrix(b)) {
                return None;
            }
            let is_integer = graph.node(*a).is_integer && graph.node(*b).is_integer;
            binary(*op, of(a)?, of(b)?, is_integer)
        }
        Op::Construct(parts) => construct(graph, parts, ty?),
        Op::Swizzle(a, letters) => {
            let number = of(a)?;
            letters.chars().map(|letter| number.get(component(letter)?).copied()).collect()
        }
        Op::Index(a, Some(index)) if !graph.node(*a).is_matrix => Some(vec![*of(a)?.get(*index)?]),
        Op::Select(_, a, b) => of(a).filter(|a| of(b) == Some(a)).cloned(),
        Op::Write(base, letters, value) => {
            let (mut number, value) = (of(base)?.clone(), of(value)?);
            for (i, letter) in letters.chars().enumerate() {
                *number.get_mut(component(letter)?)? = *value.get(i.min(value.len() - 1))?;
            }
            Some(number)
        }
        Op::Call(name, parts) => call(name, &parts.iter().map(of).collect::<Option<Vec<_>>>()?),
        _ => None,
    }
}

fn each(a: &[f64], b: &[f64], of: impl Fn(f64, f64) -> f64) -> Option<Components> {
    let count = a.len().max(b.len());
    if a.is_empty() || b.is_empty() || [a.len(), b.len()].iter().any(|n| *n != 1 && *n != count) {
        return None;
    }
    Some((0..count).map(|i| of(a[i % a.len()], b[i % b.len()])).collect())
}

fn binary(op: BinaryOp, a: &[f64], b: &[f64], is_integer: bool) -> Option<Components> {
    let truth = |value: bool| Some(vec![f64::from(u8::from(value))]);
    match op {
        BinaryOp::Add => each(a, b, |a, b| a + b),
        BinaryOp::Subtract => each(a, b, |a, b| a - b),
        BinaryOp::Multiply => each(a, b, |a, b| a * b),
        BinaryOp::Divide if is_integer && b.contains(&0.0) => None,
        BinaryOp::Divide if is_integer => each(a, b, |a, b| (a / b).trunc()),
        BinaryOp::Divide => each(a, b, |a, b| a / b),
        BinaryOp::Remainder if !b.contains(&0.0) => each(a, b, |a, b| a % b),
        BinaryOp::Equal => truth(a == b),
        BinaryOp::NotEqual => truth(a != b),
        _ => {
            let (a, b) = (*a.first()?, *b.first()?);
            match op {
                BinaryOp::Less => truth(a < b),
                BinaryOp::Greater => truth(a > b),
                BinaryOp::LessEqual => truth(a <= b),
                BinaryOp::GreaterEqual => truth(a >= b),
                BinaryOp::And => truth(a != 0.0 && b != 0.0),
                BinaryOp::Or => truth(a != 0.0 || b != 0.0),
                _ => None,
            }
        }
    }
}

fn construct(graph: &Graph, parts: &[Id], ty: &Type) -> Option<Components> {
    let mut values = Components::new();
    for part in parts {
        values.extend(graph.number(*part)?);
    }
    let count = ty.components()? as usize;
    if let Type::Matrix { rows, .. } = ty {
        let rows = usize::from(*rows);
        let diagonal = |i: usize| if i.is_multiple_of(rows + 1) { values[0] } else { 0.0 };
        return match values.len() {
            1 => Some((0..count).map(diagonal).collect()),
            given => (given == count).then_some(values),
        };
    }
    if values.len() == 1 {
        values = vec![values[0]; count];
    }
    (values.len() >= count).then(|| values[..count].to_vec())
}

fn call(name: &str, parts: &[&Components]) -> Option<Components> {
    let one = |of: fn(f64) -> f64| Some(parts.first()?.iter().map(|x| of(*x)).collect());
    let two = |of: fn(f64, f64) -> f64| each(parts.first()?, parts.get(1)?, of);
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    match name {
        "abs" => one(f64::abs),
        "sign" => one(|x| if x == 0.0 { 0.0 } else { x.signum() }),
        "floor" => one(f64::floor),
        "ceil" => one(f64::ceil),
        "sqrt" => one(f64::sqrt),
        "inversesqrt" => one(|x| 1.0 / x.sqrt()),
        "exp" => one(f64::exp),
        "exp2" => one(f64::exp2),
        "log" => one(f64::ln),
        "log2" => one(f64::log2),
        "radians" => one(f64::to_radians),
        "degrees" => one(f64::to_degrees),
        "sin" => one(f64::sin),
        "cos" => one(f64::cos),
        "tan" => one(f64::tan),
        "pow" => two(f64::powf),
        "min" => two(f64::min),
        "max" => two(f64::max),
        "clamp" => each(&each(parts.first()?, parts.get(1)?, f64::max)?, parts.get(2)?, f64::min),
        "length" => Some(vec![length(parts.first()?)]),
        "normalize" => {
            let length = length(parts.first()?);
            Some(parts.first()?.iter().map(|x| x / length).collect())
        }
        "dot" => Some(vec![parts.first()?.iter().zip(parts.get(1)?.iter()).map(|(a, b)| a * b).sum()]),
        _ => None,
    }
}
