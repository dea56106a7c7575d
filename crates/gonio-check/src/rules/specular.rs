//! Mistakes with the highlight.

use super::{Answer, At, Not, Silent, diffuse};
use crate::dataflow::terms::{AMBIENT, DIFFUSE, SPECULAR, SPECULAR_STRENGTH};
use crate::dataflow::vector::{Incoming, Vector, VectorKind};
use crate::dataflow::{Id, Op, Reading};
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp;

pub(super) fn answer(reading: &Reading, id: &str) -> Option<Answer> {
    let is = |id: Id, is: &dyn Fn(Vector) -> bool| reading.vector(id).is_some_and(is);
    Some(match id {
        "specular-reflect-sign" => reflect_sign(reading),
        "specular-not-clamped" | "specular-power-of-negative" => not_clamped(reading),
        "specular-absolute" => around(reading, "abs"),
        "specular-without-power" => without_power(reading),
        "specular-multiplied-by-exponent" => multiplied(reading),
        "specular-exponent-wrong" => exponent(reading),
        "specular-with-normal" => dots(reading, |a, b| is(a, &|v| v.is_normal()) && is(b, &|v| v.is_eye())),
        "specular-with-light" => dots(reading, |a, b| is(a, &|v| v.is_light()) && is(b, &|v| v.is_eye())),
        "specular-without-eye" => dots(reading, |a, b| {
            let from_light = |v: Vector| v.kind == VectorKind::Reflected(Incoming::Light);
            let no_eye = |v: Vector| v.is_normal() || v.is_light();
            (is(a, &from_light) || is(a, &|v| v.is_normal())) && is(b, &no_eye)
        }),
        "half-vector-not-normalised" => half(reading, |vector| !vector.is_unit),
        "half-vector-of-unequal-vectors" => half(reading, |vector| {
            let (a, b) = match reading.sides(vector.at, BinaryOp::Add) {
                Some(sides) => sides,
                None => return false,
            };
            !(is(a, &|v| v.is_unit) && is(b, &|v| v.is_unit))
        }),
        "specular-missing" => {
            if reading.sum().iter().any(|product| product.bits & SPECULAR != 0) {
                return Some(Not);
            }
            Answer::at_or(reading.dark("spec").or_else(|| reading.meeting()), 0.9, Silent)
        }
        "specular-strength-missing" => {
            let bare = |bits| bits & SPECULAR != 0 && bits & SPECULAR_STRENGTH == 0;
            let product = reading.sum().iter().find(|product| bare(product.bits));
            let power = product.and_then(|p| p.factors.iter().find(|id| reading.bits(**id) & SPECULAR != 0));
            let term =
                reading.named("specular", |id| bare(reading.bits(id)) && reading.bits(id) & (DIFFUSE | AMBIENT) == 0);
            Answer::at_or(power.copied().map(|power| term.unwrap_or(power)), 0.8, known(reading))
        }
        "specular-not-attenuated" => diffuse::unattenuated(reading, SPECULAR),
        "specular-from-other-light" => other_light(reading),
        _ => return None,
    })
}

fn known(reading: &Reading) -> Answer {
    if reading.specular_dots().is_empty() { Silent } else { Not }
}

/// Whether the reflected direction and the one that it is compared with are both negated.
pub(super) fn signs_cancel(reading: &Reading) -> bool {
    reading.specular_dots().into_iter().any(|(_, a, b)| {
        [(a, b), (b, a)].into_iter().any(|(one, other)| match (reading.vector(one), reading.vector(other)) {
            (Some(r), Some(v)) => matches!(r.kind, VectorKind::Reflected(_)) && r.sign > 0.0 && v.sign < 0.0,
            _ => false,
        })
    })
}

fn reflect_sign(reading: &Reading) -> Answer {
    if signs_cancel(reading) {
        return Not;
    }
    let reflected: Vec<Vector> = reading
        .specular_dots()
        .into_iter()
        .flat_map(|(_, a, b)| [a, b])
        .filter_map(|id| reading.vector(id))
        .filter(|vector| matches!(vector.kind, VectorKind::Reflected(Incoming::Light | Incoming::Eye)))
        .collect();
    // The opposite of a reversed light direction is right.
    let is_reversed = reading
        .diffuse_dots()
        .into_iter()
        .flat_map(|(_, a, b)| [a, b])
        .any(|id| reading.vector(id).is_some_and(|v| matches!(v.kind, VectorKind::ToLight(..)) && v.sign < 0.0));
    let wrong = if is_reversed && !reading.signs_cancel() { -1.0 } else { 1.0 };
    match reflected.iter().find(|vector| vector.sign == wrong) {
        Some(vector) => At(vector.at, 1.0),
        None if reflected.is_empty() => Silent,
        None => Not,
    }
}

/// Finds a power whose base may be negative.
pub(super) fn not_clamped(reading: &Reading) -> Answer {
    for (_, base, _) in reading.powers() {
        let base = reading.graph.plain(base);
        match reading.graph.op(base) {
            Op::Call(name, _) if name == "abs" => return At(base, 1.0),
            Op::Call(name, _) if name == "dot" && !reading.is_tested(SPECULAR) => return At(base, 1.0),
            Op::Neg(_) if !reading.is_tested(SPECULAR) => return At(base, 1.0),
            _ => {}
        }
    }
    match reading.specular_dots().iter().find(|(dot, ..)| !diffuse::is_clamped(reading, *dot)) {
        Some((dot, ..)) => At(*dot, 0.8),
        None => known(reading),
    }
}

fn around(reading: &Reading, name: &str) -> Answer {
    for (dot, ..) in reading.specular_dots() {
        let mut around = reading.around(dot).into_iter();
        if let Some(id) = around.find(|id| matches!(reading.graph.op(*id), Op::Call(called, _) if called == name)) {
            return At(id, 1.0);
        }
    }
    known(reading)
}

fn dots(reading: &Reading, is_match: impl Fn(Id, Id) -> bool) -> Answer {
    let found = reading.specular_dots().into_iter().find(|(_, a, b)| is_match(*a, *b) || is_match(*b, *a));
    Answer::at_or(found.map(|(dot, ..)| dot), 1.0, known(reading))
}

/// Whether a node is multiplied by itself, which is a power too.
fn is_squared(reading: &Reading, id: Id) -> bool {
    let plain = |id: Id| reading.graph.plain(id);
    let around: Vec<Id> = std::iter::once(id).chain(reading.around(id)).map(plain).collect();
    reading.tree.iter().any(|id| match reading.sides(*id, BinaryOp::Multiply) {
        Some((a, b)) => plain(a) == plain(b) && around.contains(&plain(a)),
        None => false,
    })
}

fn without_power(reading: &Reading) -> Answer {
    let dots = reading.specular_dots();
    let Some((dot, ..)) = dots.iter().find(|(dot, ..)| !reading.is_in_power(*dot) && !is_squared(reading, *dot)) else {
        return known(reading);
    };
    // A variable with only another name was meant to hold the power.
    let is_alias = |id: &Id| match reading.graph.op(*id) {
        Op::Copy(inner, _) => matches!(reading.graph.op(*inner), Op::Copy(..)),
        _ => false,
    };
    if let Some(alias) = reading.around(*dot).into_iter().find(is_alias) {
        return At(alias, 0.9);
    }
    // The power belongs in the line of the clamp.
    let is_clamp = |id: &Id| matches!(reading.graph.op(*id), Op::Call(name, _) if name == "max" || name == "clamp");
    At(reading.around(*dot).into_iter().rfind(is_clamp).unwrap_or(*dot), 0.9)
}

fn multiplied(reading: &Reading) -> Answer {
    let is_exponent = |id: Id| {
        let id = reading.graph.plain(id);
        reading.role(id) == Some(Role::Shininess) || reading.graph.scalar(id).is_some_and(|n| n > 4.0)
    };
    let found = reading
        .deepest(&[BinaryOp::Multiply], |a, b| {
            let is_logarithm = ["log", "log2"].iter().any(|name| reading.graph.call(b, name).is_some());
            is_exponent(a) && reading.bits(b) & SPECULAR != 0 && !is_logarithm
        })
        .filter(|_| reading.powers().is_empty());
    Answer::at_or(found, 1.0, known(reading))
}

fn exponent(reading: &Reading) -> Answer {
    let powers = reading.powers();
    let support = |id: Id| {
        let id = reading.graph.plain(id);
        match (reading.role(id), reading.graph.scalar(id)) {
            (Some(Role::Shininess), _) => 0.0,
            (_, Some(number)) if (number - 32.0).abs() < 1e-3 => 0.1,
            (_, Some(_)) => 1.0,
            _ => 0.9,
        }
    };
    let mut ranked: Vec<(Id, f32)> = powers.iter().map(|(id, _, exponent)| (*id, support(*exponent))).collect();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    match ranked.first() {
        Some((_, 0.0)) => Not,
        Some((id, support)) => At(*id, *support),
        None => Silent,
    }
}

fn half(reading: &Reading, is_match: impl Fn(Vector) -> bool) -> Answer {
    let halves: Vec<Vector> = reading
        .specular_dots()
        .into_iter()
        .flat_map(|(_, a, b)| [a, b])
        .filter_map(|id| reading.vector(id))
        .filter(|vector| vector.kind == VectorKind::Half)
        .collect();
    match halves.iter().find(|vector| is_match(**vector)) {
        Some(vector) => At(vector.at, 1.0),
        None if halves.is_empty() => known(reading),
        None => Not,
    }
}

/// Finds a direction to a light that the highlight uses but the diffuse term does not.
fn other_light(reading: &Reading) -> Answer {
    let lights = |id: Id| match reading.vector(id).map(|v| (v.kind, v.at)) {
        Some((VectorKind::ToLight(light, _), at)) => Some((light, at)),
        _ => None,
    };
    let diffuse: Vec<Option<u32>> = reading
        .diffuse_dots()
        .into_iter()
        .flat_map(|(_, a, b)| [a, b])
        .filter_map(lights)
        .map(|(light, _)| light)
        .collect();
    let specular: Vec<(Option<u32>, Id)> =
        reading.reflections(Incoming::Light).into_iter().filter_map(lights).collect();
    if diffuse.is_empty() || specular.is_empty() {
        return Silent;
    }
    let is_left_out = diffuse.iter().any(|light| specular.iter().all(|(of, _)| of != light));
    // If the terms of two lights use the same direction, the later one was copied.
    let again = |at: &usize| specular[..*at].iter().any(|(light, _)| *light == specular[*at].0);
    let copied = || (0..specular.len()).filter(again).find(|_| is_left_out).and_then(|at| specular.get(at));
    let found = specular.iter().find(|(light, _)| !diffuse.contains(light)).or_else(copied);
    Answer::at_or(found.map(|(_, at)| *at), 1.0, Not)
}
