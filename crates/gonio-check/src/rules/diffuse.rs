//! Mistakes with the diffuse term.

use super::{Answer, At, Not, Silent};
use crate::dataflow::terms::{AMBIENT, ATTENUATION, DIFFUSE, DIFFUSE_STRENGTH, SPECULAR};
use crate::dataflow::{Id, Op, Reading};
use gonio_glsl::ast::BinaryOp;

pub(super) fn answer(reading: &Reading, id: &str) -> Option<Answer> {
    Some(match id {
        "diffuse-not-clamped" => match reading.diffuse_dots().iter().find(|(dot, ..)| !is_clamped(reading, *dot)) {
            Some((dot, ..)) => At(*dot, 1.0),
            None => known(reading),
        },
        "diffuse-absolute" => around(reading, |reading, id| reading.graph.call(id, "abs").is_some()),
        "diffuse-floor" => around(reading, has_floor),
        "diffuse-half-lambert" => around(reading, is_half_lambert),
        "diffuse-min-for-max" => around(reading, |reading, id| {
            let parts = reading.graph.call(id, "min");
            parts.is_some_and(|parts| parts.iter().any(|part| reading.graph.scalar(*part).is_some_and(|n| n <= 0.5)))
        }),
        "diffuse-without-cosine" => without_cosine(reading),
        "diffuse-per-component" => {
            let found = reading.deepest(&[BinaryOp::Multiply], |a, b| {
                let (a, b) = (reading.vector(a), reading.vector(b));
                a.is_some_and(|v| v.is_normal()) && b.is_some_and(|v| v.is_light())
            });
            Answer::at_or(found, 1.0, known(reading))
        }
        "diffuse-missing" => {
            if reading.sum().iter().any(|product| product.bits & DIFFUSE != 0) {
                return Some(Not);
            }
            Answer::at_or(reading.dark("diff").or_else(|| reading.meeting()), 0.9, Silent)
        }
        "diffuse-strength-missing" => {
            let bare = |bits| bits & DIFFUSE != 0 && bits & DIFFUSE_STRENGTH == 0;
            let product = reading.sum().iter().find(|product| bare(product.bits));
            let cosine = product.and_then(|p| p.factors.iter().find(|id| reading.bits(**id) & DIFFUSE != 0));
            let term =
                reading.named("diff", |id| bare(reading.bits(id)) && reading.bits(id) & (SPECULAR | AMBIENT) == 0);
            Answer::at_or(cosine.copied().map(|cosine| term.unwrap_or(cosine)), 0.8, known(reading))
        }
        "diffuse-not-attenuated" => unattenuated(reading, DIFFUSE),
        _ => return None,
    })
}

/// Returns the answer for a diffuse term that is right in this respect.
fn known(reading: &Reading) -> Answer {
    if reading.diffuse_dots().is_empty() { Silent } else { Not }
}

pub(super) fn is_clamped(reading: &Reading, dot: Id) -> bool {
    let bits = reading.bits(dot);
    reading.is_tested(if bits & DIFFUSE != 0 { DIFFUSE } else { DIFFUSE | SPECULAR })
        || reading.around(dot).iter().any(|id| match reading.graph.op(*id) {
            Op::Call(name, _) => matches!(name.as_str(), "max" | "clamp" | "abs" | "min" | "smoothstep" | "step"),
            Op::Select(..) => true,
            _ => is_half_lambert(reading, *id),
        })
}

/// Returns the innermost operation around a diffuse cosine that satisfies the condition.
fn around(reading: &Reading, is: impl Fn(&Reading, Id) -> bool) -> Answer {
    for (dot, ..) in reading.diffuse_dots() {
        let is_meant = |id: &Id| !matches!(reading.graph.op(*id), Op::Copy(..)) && is(reading, *id);
        if let Some(id) = reading.around(dot).into_iter().find(is_meant) {
            return At(id, 1.0);
        }
    }
    known(reading)
}

/// Whether a number is added to the cosine or a multiple of it.
fn is_half_lambert(reading: &Reading, id: Id) -> bool {
    let Some((a, b)) = reading.sides(id, BinaryOp::Add) else { return false };
    let is_number = |id: Id| reading.graph.scalar(id).is_some_and(|n| (0.3..=1.0).contains(&n));
    let is_cosine = |id: Id| {
        let id = reading.graph.plain(id);
        let is_dot = |id: Id| reading.graph.call(id, "dot").is_some();
        let scaled = reading.sides(id, BinaryOp::Multiply);
        is_dot(id) || scaled.is_some_and(|(a, b)| is_number(a) && is_dot(b) || is_number(b) && is_dot(a))
    };
    is_number(a) && is_cosine(b) || is_number(b) && is_cosine(a)
}

fn has_floor(reading: &Reading, id: Id) -> bool {
    let number = |id: &Id| reading.graph.scalar(*id).is_some_and(|n| n > 0.0 && n < 1.0);
    match reading.graph.op(id) {
        Op::Call(name, parts) if name == "max" => parts.iter().any(number),
        Op::Call(name, parts) if name == "clamp" => parts.get(1).is_some_and(number),
        Op::Select(_, a, b) => number(a) || number(b),
        _ => false,
    }
}

fn without_cosine(reading: &Reading) -> Answer {
    if !reading.dots(DIFFUSE).is_empty() && reading.sum().iter().any(|product| product.bits & DIFFUSE != 0) {
        return Not;
    }
    // A number in a variable with that name.
    let named = reading.tree.iter().copied().find(|id| match reading.graph.op(*id) {
        Op::Copy(inner, name) => {
            let name = name.to_lowercase();
            let is_cosine = ["diff", "lambert", "cos", "ndotl"].iter().any(|word| name.contains(word));
            is_cosine && reading.graph.number(*inner).is_some() && !name.contains("col") && !name.contains("str")
        }
        _ => false,
    });
    if let Some(id) = named {
        return At(id, 0.9);
    }
    Answer::at_or(reading.meeting(), 0.7, Silent)
}

/// Returns the sum that adds a term without a distance, if other terms have one.
pub(super) fn unattenuated(reading: &Reading, term: u16) -> Answer {
    let both = DIFFUSE | SPECULAR;
    let bits = || reading.sum().iter().map(|product| product.bits).filter(|bits| bits & AMBIENT == 0);
    let of_term: Vec<u16> = bits().filter(|bits| bits & both == term).collect();
    let has_others = bits().any(|bits| bits & both & !term != 0 && bits & ATTENUATION != 0);
    if of_term.is_empty() || !has_others {
        return Silent;
    }
    if of_term.iter().all(|bits| bits & ATTENUATION != 0) {
        return Not;
    }
    let found = reading.deepest(&[BinaryOp::Add], |a, _| {
        let products = reading.products(a);
        !products.is_empty() && products.iter().any(|p| p.bits & both == term && p.bits & ATTENUATION == 0)
    });
    Answer::at_or(found, 1.0, Silent)
}
