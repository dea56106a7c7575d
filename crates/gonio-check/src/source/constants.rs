//! Finds constants in the source that could be uniforms.

use super::falloff::falloff;
use crate::dataflow::terms::{DIFFUSE, SPECULAR};
use crate::dataflow::vector::{By, VectorKind};
use crate::dataflow::{Id, Op, Reading};
use glam::Vec3;
use gonio_glsl::ast::BinaryOp;

/// Constants in the student's source that could be uniforms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SourceConstants {
    /// The position of the light, in world space.
    pub light_position: Option<Vec3>,
    /// The position of another light that is a constant, if the light is an input.
    pub other_light: Option<Vec3>,
    /// The exponent of the highlight.
    pub shininess: Option<f32>,
    /// kc, kl and kq of the attenuation.
    pub attenuation: [Option<f32>; 3],
    /// The index of refraction against air.
    pub refraction_index: Option<f32>,
    /// If the light is an input direction: whether it is used as the direction towards the light.
    pub points_to_light: Option<bool>,
    /// A constant direction towards the light that no name calls a position.
    pub sun: Option<ConstantSun>,
}

/// A constant unit vector towards the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantSun {
    /// The direction, in world space or view space.
    pub to_light: Vec3,
    /// Whether it is in view space, so that the light rotates with the camera.
    pub in_view: bool,
}

/// Returns the constants that flow into the colour.
pub(super) fn constants(reading: &Reading) -> SourceConstants {
    let sun = sun(reading);
    SourceConstants {
        // A direction is not a position.
        light_position: light_position(reading).filter(|_| sun.is_none()),
        other_light: other_light(reading),
        shininess: shininess(reading),
        attenuation: attenuation(reading),
        refraction_index: refraction_index(reading),
        points_to_light: points_to_light(reading),
        sun,
    }
}

fn vec3(reading: &Reading, id: Id) -> Option<Vec3> {
    match reading.graph.number(id)?[..] {
        [x, y, z] | [x, y, z, _] => Some(Vec3::new(x as f32, y as f32, z as f32)).filter(|v| v.is_finite()),
        _ => None,
    }
}

/// Returns the first constant position from which a direction to the light is computed.
fn light_position(reading: &Reading) -> Option<Vec3> {
    let lights = reading.lights();
    for light in &lights {
        let Some(vector) = reading.vector(*light) else { continue };
        let found = match (vector.kind, reading.graph.op(vector.at)) {
            (VectorKind::ToLight(None, _) | VectorKind::LightMinusNormal, Op::Binary(_, a, b)) => {
                vec3(reading, *a).or_else(|| vec3(reading, *b))
            }
            (VectorKind::Light(None), _) => vec3(reading, vector.at),
            _ => None,
        };
        // The first one, that of the diffuse term, counts.
        if found.is_some() || matches!(vector.kind, VectorKind::ToLight(Some(_), _) | VectorKind::Light(Some(_))) {
            return found;
        }
    }
    if !lights.is_empty() {
        return None;
    }
    // A constant direction in a dot product with the normal.
    reading.diffuse_dots().iter().flat_map(|(_, a, b)| [*a, *b]).find_map(|id| {
        let vector = reading.vector(id).filter(|v| v.kind == VectorKind::Constant)?;
        vec3(reading, vector.at)
    })
}

/// Returns a constant position of a light, if the positions of other lights are inputs.
fn other_light(reading: &Reading) -> Option<Vec3> {
    let lights = reading.lights();
    let kinds = || lights.iter().filter_map(|light| reading.vector(*light));
    if !kinds().any(|vector| matches!(vector.kind, VectorKind::ToLight(Some(_), _))) {
        return None;
    }
    kinds().find_map(|vector| match (vector.kind, reading.graph.op(vector.at)) {
        (VectorKind::ToLight(None, _), Op::Binary(_, a, b)) => vec3(reading, *a).or_else(|| vec3(reading, *b)),
        _ => None,
    })
}

/// Returns whether an input direction is used unchanged or negated. The first use, that of the diffuse term, counts.
fn points_to_light(reading: &Reading) -> Option<bool> {
    let vectors = reading.lights().into_iter().filter_map(|light| reading.vector(light));
    vectors.filter(|vector| vector.kind == VectorKind::LightDirection).map(|vector| vector.sign > 0.0).next()
}

/// Returns a constant direction in a dot product with the normal, if no name calls it a position.
fn sun(reading: &Reading) -> Option<ConstantSun> {
    let of_dots = reading.diffuse_dots().into_iter().flat_map(|(_, a, b)| [a, b]);
    let slots: Vec<Id> = reading.lights().into_iter().chain(of_dots).collect();
    let (slot, vector) = slots.into_iter().find_map(|slot| {
        let vector = reading.vector(slot)?;
        matches!(vector.kind, VectorKind::Constant | VectorKind::Light(None) | VectorKind::LightDirection)
            .then_some((slot, vector))
    })?;
    let is_place = |name: &str| name.to_lowercase().contains("pos");
    if names(reading, slot).into_iter().any(is_place) {
        return None;
    }
    let towards = vec3(reading, vector.at)? * vector.sign as f32;
    let normals: Vec<_> = reading.normals().into_iter().filter_map(|id| reading.vector(id)).collect();
    let in_view = !normals.is_empty() && normals.iter().all(|v| matches!(v.kind, VectorKind::Normal(By::View { .. })));
    Some(ConstantSun { to_light: towards.try_normalize()?, in_view })
}

/// Returns the variables that a vector was assigned to.
fn names(reading: &Reading, mut id: Id) -> Vec<&str> {
    let mut names = Vec::new();
    loop {
        id = match reading.graph.op(id) {
            Op::Copy(inner, name) => {
                names.push(name.as_str());
                *inner
            }
            Op::Interpolated(inner) | Op::Neg(inner) | Op::Swizzle(inner, _) => *inner,
            Op::Construct(parts) | Op::Call(_, parts) if !parts.is_empty() => parts[0],
            _ => return names,
        };
    }
}

/// Returns the exponent of a cosine, in any form: `pow`, `exp2(log2(x) * c)`, or repeated multiplication.
fn shininess(reading: &Reading) -> Option<f32> {
    let is_highlight = |id: Id| reading.bits(id) & (DIFFUSE | SPECULAR) == SPECULAR;
    let mut best: Option<f64> = None;
    let mut exponents: Vec<Option<(Id, f64)>> = vec![None; reading.graph.len()];
    for id in &reading.tree {
        let of = |id: Id| exponents[id.0 as usize].unwrap_or((reading.graph.core(id), 1.0));
        let found = match reading.graph.op(*id) {
            Op::Copy(inner, _) | Op::Interpolated(inner) => exponents[inner.0 as usize],
            Op::Call(name, parts) => match (name.as_str(), &parts[..]) {
                ("pow", [base, _]) if is_rest(reading, *base) => None,
                ("pow", [base, exponent]) => reading.graph.scalar(*exponent).map(|n| (of(*base).0, of(*base).1 * n)),
                ("exp2" | "exp", [of_log]) => logarithm(reading, *of_log, if name == "exp2" { "log2" } else { "log" }),
                _ => None,
            },
            Op::Binary(BinaryOp::Multiply, a, b) if is_highlight(*a) && is_highlight(*b) => {
                let (a, b) = (of(*a), of(*b));
                (a.0 == b.0).then_some((a.0, a.1 + b.1))
            }
            _ => None,
        };
        // Neither the square of a half Lambert term nor a partial product.
        let found = found.filter(|(_, exponent)| exponent.is_finite() && *exponent > 0.0);
        let found = found.filter(|(base, _)| is_highlight(*id) || is_highlight(*base));
        exponents[id.0 as usize] = found;
        // Not the gamma curve of a colour.
        if let Some((base, exponent)) = found
            && reading.graph.node(base).width <= 1
        {
            best = best.filter(|best| *best >= exponent).or(Some(exponent));
        }
    }
    best.map(|exponent| exponent as f32)
}

/// Whether a node is `1.0 - cosine`, the Fresnel term at an edge, which is not a highlight.
fn is_rest(reading: &Reading, base: Id) -> bool {
    let core = reading.graph.core(base);
    reading.sides(core, BinaryOp::Subtract).is_some_and(|(one, _)| reading.graph.number(one).is_some())
}

fn logarithm(reading: &Reading, id: Id, log: &str) -> Option<(Id, f64)> {
    let (a, b) = reading.sides(reading.graph.plain(id), BinaryOp::Multiply)?;
    [(a, b), (b, a)].into_iter().find_map(|(log_side, number)| {
        let base = *reading.graph.call(log_side, log)?.first()?;
        Some((reading.graph.core(base), reading.graph.scalar(number)?))
    })
}

fn attenuation(reading: &Reading) -> [Option<f32>; 3] {
    let mut found = [None; 3];
    if let Some(parts) = falloff(reading) {
        for part in &parts {
            let Some(place) = [0.0, 1.0, 2.0].iter().position(|degree| *degree == part.degree) else { continue };
            if let Some(number) = part.number.filter(|n| n.is_finite()) {
                found[place] = Some(found[place].unwrap_or(0.0) + number as f32);
            }
        }
        // A plain 1 / d^2 has no constants that could be uniforms.
        if parts.len() < 2 {
            return [None; 3];
        }
    }
    found
}

/// Returns the index of refraction against air: the inverse of a ratio below 1.
fn refraction_index(reading: &Reading) -> Option<f32> {
    let ratio = reading.lit.iter().find_map(|id| match reading.graph.op(*id) {
        Op::Call(name, parts) if name == "refract" => reading.graph.scalar(*parts.get(2)?),
        _ => None,
    })?;
    let index = if ratio < 1.0 { 1.0 / ratio } else { ratio };
    (index.is_finite() && index > 1.0 && ratio > 0.0).then_some(index as f32)
}
