//! Mistakes with the ambient term, the material's colour, and the sum.

use super::{Answer, At, Not, Silent};
use crate::dataflow::terms::{ALBEDO, AMBIENT, ATTENUATION, DIFFUSE, SPECULAR};
use crate::dataflow::vector::VectorKind;
use crate::dataflow::{Id, Op, Reading};
use gonio_glsl::Stage;
use gonio_glsl::ast::BinaryOp::{Add, Divide, Multiply};

const LIT: u16 = DIFFUSE | SPECULAR;

pub(super) fn answer(reading: &Reading, id: &str) -> Option<Answer> {
    let has = |id: Id, bits: u16| reading.bits(id) & bits != 0;
    let has_ambient = |id: Id| reading.products(id).iter().any(|p| p.bits & AMBIENT != 0);
    let is_there = |bits: u16| reading.sum().iter().any(|product| product.bits & bits != 0);
    let known = if is_there(AMBIENT) { Not } else { Silent };
    Some(match id {
        "ambient-missing" => {
            if is_there(AMBIENT) {
                return Some(Not);
            }
            Answer::at_or(reading.dark("amb").or_else(|| reading.meeting()), 0.9, Silent)
        }
        "ambient-attenuated" => {
            let found = reading.deepest(&[Multiply, Divide], |a, b| {
                has_ambient(a) && has(b, ATTENUATION) && !has(b, LIT | AMBIENT) && !has(a, ATTENUATION)
            });
            let loose = || reading.deepest(&[Multiply, Divide], |a, b| has_ambient(a) && has(b, ATTENUATION));
            Answer::at_or(found.or_else(loose), 1.0, known)
        }
        "terms-not-put-out" => {
            let terms = reading.sum().iter().fold(0, |all, product| all | product.bits) & (LIT | AMBIENT);
            match reading.put_out() {
                Some(id) if terms & LIT == 0 && reading.computes_unused(LIT) => At(id, 1.0),
                Some(id) if terms == DIFFUSE => At(id, 0.9),
                Some(_) => Not,
                None => Silent,
            }
        }
        "ambient-in-cone" => in_cone(reading),
        "ambient-twice" => twice(reading),
        "ambient-times-diffuse" => {
            let found = reading.deepest(&[Multiply], |a, b| has_ambient(a) && has(b, DIFFUSE) && !has(b, AMBIENT));
            Answer::at_or(found, 1.0, known)
        }
        "ambient-as-maximum" => {
            let found = reading.calls("max").find(|(_, parts)| {
                parts.iter().any(|part| has(*part, AMBIENT)) && parts.iter().any(|part| has(*part, LIT))
            });
            Answer::at_or(found.map(|(id, _)| id), 1.0, known)
        }
        "ambient-not-coloured" => {
            let bare = |p: &&crate::dataflow::terms::Product| p.bits & AMBIENT != 0 && p.albedo == 0;
            let product = reading.sum().iter().find(bare);
            let product = product.and_then(|p| p.factors.first()).copied();
            let is_bare = |id: Id| reading.products(id).iter().any(|p| bare(&p));
            let sum = reading.deepest(&[Add], |a, b| is_bare(a) && has(b, ALBEDO));
            Answer::at_or(product.map(|product| sum.unwrap_or(product)), 0.9, known)
        }
        "ambient-strength-missing" => Answer::at_or(reading.meeting().filter(|_| !is_there(AMBIENT)), 0.7, known),
        "terms-multiplied" => {
            // A highlight that is multiplied by the cosine or gated by it is not a mistake beside a diffuse term.
            if reading.sum().iter().any(|p| p.bits & LIT == DIFFUSE && p.bits & AMBIENT == 0) {
                return Some(Not);
            }
            let term = |id: Id| reading.bits(id) & (LIT | AMBIENT);
            let found = reading
                .deepest(&[Multiply], |a, b| has(a, SPECULAR) && has(b, DIFFUSE) && term(a) != term(b))
                .or_else(|| reading.deepest(&[Multiply], |a, b| term(a) & !term(b) != 0 && term(b) & !term(a) != 0));
            Answer::at_or(found, 1.0, Not)
        }
        "albedo-squared" => {
            let squared = |id: Id, times: u8| reading.products(id).iter().any(|p| p.albedo >= times);
            let found = reading
                .deepest(&[Multiply], |a, b| has(a, ALBEDO) && has(b, ALBEDO) && (squared(a, 1) && squared(b, 1)));
            Answer::at_or(found, 1.0, Not)
        }
        "albedo-missing" => albedo_missing(reading),
        "albedo-added" => {
            let bare = |id: Id| reading.products(id).iter().any(|p| p.bits == ALBEDO);
            let found = reading.deepest(&[Add], |a, b| bare(a) && has(b, LIT | AMBIENT));
            Answer::at_or(found, 1.0, Not)
        }
        "gamma-applied" => {
            let is_colour = |parts: &[Id]| {
                parts.first().is_some_and(|base| reading.bits(*base) & LIT != 0 && reading.graph.node(*base).width >= 3)
            };
            let found = ["pow", "sqrt"]
                .iter()
                .find_map(|name| reading.calls(name).find(|(_, parts)| is_colour(parts)))
                .map(|(id, _)| id);
            Answer::at_or(found, 1.0, Not)
        }
        "output-normal" => {
            let is_normal = |id: &Id| reading.vector(*id).is_some_and(|v| v.is_normal());
            let is_lit = is_there(LIT);
            let found = reading.tree.iter().copied().rfind(is_normal).filter(|_| !is_lit);
            match (found, reading.put_out()) {
                // The line that outputs it.
                (Some(_), Some(id)) => At(id, 1.0),
                _ => Not,
            }
        }
        "output-constant" => match reading.put_out() {
            Some(id) if !is_there(LIT | AMBIENT) => At(id, 0.9),
            Some(_) => Not,
            None => Silent,
        },
        "gouraud-instead-of-phong" => per(reading, Stage::Vertex),
        "phong-instead-of-gouraud" => per(reading, Stage::Fragment),
        _ => return None,
    })
}

/// Finds an ambient term that the cone of a spot light affects.
fn in_cone(reading: &Reading) -> Answer {
    let of_cones = reading.of_cones();
    let of_cone = |id: Id| of_cones.get(id.0 as usize).copied().unwrap_or(false);
    let has_ambient = |id: Id| reading.products(id).iter().any(|p| p.bits & AMBIENT != 0);
    if !reading.lit.iter().any(|id| of_cone(*id)) {
        return Silent;
    }
    let cut = reading.deepest(&[Multiply], |a, b| {
        has_ambient(a) && reading.bits(b) & (LIT | AMBIENT) == 0 && !of_cone(a) && of_cone(b)
    });
    let chosen = || {
        reading.tree.iter().copied().find(|id| match reading.graph.op(*id) {
            Op::Select(test, a, b) => of_cone(*test) && has_ambient(*a) != has_ambient(*b),
            _ => false,
        })
    };
    Answer::at_or(cut.or_else(chosen), 1.0, Not)
}

fn twice(reading: &Reading) -> Answer {
    let of_ambient = |id: Id| {
        let products = reading.products(id).iter().filter(|p| p.bits & AMBIENT != 0 && p.bits & LIT == 0);
        let factors = products.flat_map(|p| p.factors.iter().copied());
        factors.filter(|id| reading.bits(*id) & AMBIENT != 0).collect::<Vec<Id>>()
    };
    if reading.colour.is_none_or(|colour| of_ambient(colour).is_empty()) {
        return Silent;
    }
    // Each light has its own ambient term.
    let is_shared = |a: Id, b: Id| {
        let of_b = of_ambient(b);
        of_ambient(a).iter().any(|one| of_b.iter().any(|other| reading.graph.is_same(*one, *other)))
    };
    let found = reading.deepest(&[Add], is_shared);
    let doubled = || {
        reading.deepest(&[Multiply], |a, b| {
            !of_ambient(a).is_empty() && reading.graph.scalar(b).is_some_and(|n| (n - 2.0).abs() < 1e-6)
        })
    };
    Answer::at_or(found.or_else(doubled), 0.9, Not)
}

fn albedo_missing(reading: &Reading) -> Answer {
    let products = reading.sum();
    if products.iter().any(|p| p.albedo > 0) {
        // Among several terms, the one without the factor.
        let bare = products.iter().find(|p| p.albedo == 0 && p.bits & (LIT | AMBIENT) != 0);
        let Some(product) = bare else { return Not };
        let factor = product.factors.iter().find(|id| reading.bits(**id) & (LIT | AMBIENT) != 0);
        return Answer::at_or(factor.copied(), 0.7, Silent);
    }
    match reading.put_out() {
        Some(id) if !products.is_empty() => At(id, 0.9),
        _ => Silent,
    }
}

/// Locates the lighting computation in a stage: for vertices the line that passes it on, for fragments that of the
/// cosine.
fn per(reading: &Reading, stage: Stage) -> Answer {
    let dots = reading.diffuse_dots();
    let Some((dot, ..)) = dots.iter().find(|(dot, ..)| reading.graph.node(*dot).stage == stage) else {
        return if dots.is_empty() { Silent } else { Not };
    };
    if stage == Stage::Fragment {
        return At(*dot, 1.0);
    }
    let handed_on = reading.tree.iter().find_map(|id| match reading.graph.op(*id) {
        Op::Interpolated(inner) if reading.bits(*inner) & LIT != 0 => Some(*inner),
        _ => None,
    });
    At(handed_on.unwrap_or(*dot), 1.0)
}

/// Whether the output is a vector of this kind, unchanged.
pub(super) fn puts_out(reading: &Reading, kind: impl Fn(VectorKind) -> bool) -> bool {
    reading.shade().and_then(|id| reading.vector(id)).is_some_and(|vector| kind(vector.kind))
}
