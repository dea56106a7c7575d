//! The divisor of the light by powers of the distance.

use crate::dataflow::terms::{AMBIENT, ATTENUATION, DIFFUSE, SPECULAR, is_cosine_by_lengths};
use crate::dataflow::{Id, Op, Reading};
use gonio_glsl::ast::BinaryOp::Divide;

/// A summand of the divisor: a constant times a power of the distance.
pub(super) struct Part {
    /// The power of the distance.
    pub degree: f64,
    /// The constant, if it is a number in the source.
    pub number: Option<f64>,
}

/// Returns the summands of the first divisor that contains a distance.
pub(super) fn falloff(reading: &Reading) -> Option<Vec<Part>> {
    let divided = reading.tree.iter().find_map(|id| {
        let by = match reading.graph.op(*id) {
            Op::Binary(Divide, a, by) if is_cosine_by_lengths(&reading.graph, *a, *by).is_some() => return None,
            Op::Binary(Divide, _, by) => *by,
            // `pow(.., -1.0)`
            Op::Call(name, parts) if name == "pow" && parts.len() == 2 => {
                reading.graph.scalar(parts[1]).filter(|n| *n == -1.0).map(|_| parts[0])?
            }
            _ => return None,
        };
        let bits = reading.bits(by);
        (bits & ATTENUATION != 0 && bits & (DIFFUSE | SPECULAR | AMBIENT) == 0).then_some(by)
    })?;
    let mut parts = Vec::new();
    for product in reading.products(divided) {
        let mut part = Part { degree: 0.0, number: Some(1.0) };
        for factor in &product.factors {
            let plain = reading.graph.plain(*factor);
            if let Some(number) = reading.graph.scalar(plain) {
                part.number = part.number.map(|n| n * number);
            } else if let Some(degree) = degree(reading, plain) {
                part.degree += degree;
            } else {
                part.number = None;
            }
        }
        parts.push(part);
    }
    Some(parts)
}

/// Returns the power of the distance.
fn degree(reading: &Reading, id: Id) -> Option<f64> {
    match reading.graph.op(id) {
        Op::Call(name, parts) => match (name.as_str(), &parts[..]) {
            ("length" | "distance", _) => Some(1.0),
            ("sqrt", [of]) => Some(0.5 * degree(reading, reading.graph.plain(*of))?),
            ("dot", [a, b]) if reading.graph.is_same(*a, *b) => Some(2.0),
            ("pow", [of, power]) => Some(degree(reading, reading.graph.plain(*of))? * reading.graph.scalar(*power)?),
            ("max" | "min", [of, _]) => degree(reading, reading.graph.plain(*of)),
            _ => None,
        },
        _ => None,
    }
}
