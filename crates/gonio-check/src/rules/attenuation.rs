//! Mistakes with the attenuation.

use super::{Answer, At, Not, Silent};
use crate::dataflow::terms::{AMBIENT, ATTENUATION, DIFFUSE, SPECULAR, is_cosine_by_lengths};
use crate::dataflow::vector::{Vector, VectorKind};
use crate::dataflow::{Id, Op, Reading};
use crate::roles::Role;
use gonio_glsl::ast::BinaryOp::{Add, Divide};

pub(super) fn answer(reading: &Reading, id: &str) -> Option<Answer> {
    let of_falloff = |is: &dyn Fn(&Falloff) -> bool| match falloff(reading) {
        Some(falloff) if is(&falloff) => At(falloff.at, 1.0),
        Some(_) => Not,
        None => Silent,
    };
    let is_bare = |falloff: &Falloff, degree: f64| matches!(&falloff.parts[..], [part] if part.degree == degree && part.role.is_none());
    Some(match id {
        "attenuation-missing" => missing(reading),
        "attenuation-without-constant" => of_falloff(&|f| f.parts.len() > 1 && !f.has(0.0)),
        "attenuation-without-linear" => of_falloff(&|f| f.parts.len() > 1 && !f.has(1.0) && f.has(2.0)),
        "attenuation-without-quadratic" => of_falloff(&|f| f.parts.len() > 1 && !f.has(2.0) && f.count(1.0) < 2),
        "attenuation-distance-not-squared" => of_falloff(&|f| !f.has(2.0) && f.count(1.0) >= 2),
        "attenuation-inverse-square" => of_falloff(&|f| is_bare(f, 2.0)),
        "attenuation-inverse-distance" => of_falloff(&|f| is_bare(f, 1.0)),
        "attenuation-swapped" => of_falloff(&|f| {
            f.parts.iter().any(|part| match part.role {
                Some(Role::AttenuationLinear(_)) => part.degree == 2.0,
                Some(Role::AttenuationQuadratic(_)) => part.degree == 1.0 && f.has(2.0),
                _ => false,
            })
        }),
        "attenuation-not-inverted" => not_inverted(reading),
        "attenuation-other-formula" => other_formula(reading),
        "attenuation-added" => {
            let is_part = |id: &Id| reading.bits(*id) & ATTENUATION != 0 || reading.graph.scalar(*id) == Some(1.0);
            let is_bare =
                |id: Id| reading.products(id).iter().any(|p| p.bits == ATTENUATION && p.factors.iter().all(is_part));
            let terms = DIFFUSE | SPECULAR | AMBIENT;
            let found = reading.deepest(&[Add], |a, b| is_bare(a) && reading.bits(b) & terms != 0);
            Answer::at_or(found, 1.0, if falloff(reading).is_some() { Not } else { Silent })
        }
        "attenuation-distance-of-direction" => distance(reading, |v| v.is_unit),
        "attenuation-with-view-distance" => distance(reading, |v| v.is_eye()),
        "attenuation-distance-from-origin" => {
            distance(reading, |v| matches!(v.kind, VectorKind::Light(_) | VectorKind::Point(_) | VectorKind::Constant))
        }
        "attenuation-plus-view-distance" => {
            let is_eye = |id: Id| {
                let id = reading.graph.plain(id);
                measured(reading, id).is_some_and(|v| v.is_eye())
            };
            let is_light = |id: Id| measured(reading, reading.graph.plain(id)).is_some_and(|v| v.is_light());
            Answer::at_or(reading.deepest(&[Add], |a, b| is_eye(a) && is_light(b)), 1.0, distances_known(reading))
        }
        _ => return None,
    })
}

/// Returns the vector whose length a node is, as the difference of both ends.
pub(super) fn measured(reading: &Reading, id: Id) -> Option<Vector> {
    match reading.graph.op(id) {
        Op::Call(name, parts) => match (name.as_str(), &parts[..]) {
            ("length", [of]) => reading.vector(*of),
            ("distance", [a, b]) => {
                let (one, other) = (reading.vector(*a)?, reading.vector(*b)?);
                let place = |v: Vector| if let VectorKind::Point(space) = v.kind { Some(space) } else { None };
                let (end, space) = match (place(one), place(other)) {
                    (None, Some(space)) => (one, space),
                    (Some(space), None) => (other, space),
                    _ => return None,
                };
                let kind = match end.kind {
                    VectorKind::Light(light) => VectorKind::ToLight(light, space),
                    VectorKind::Constant => VectorKind::ToLight(None, space),
                    VectorKind::Eye => VectorKind::ToEye(space),
                    _ => return None,
                };
                Some(Vector { kind, is_unit: false, at: id, ..end })
            }
            ("sqrt", [of]) => match reading.graph.call(*of, "dot") {
                Some([a, b]) if reading.graph.is_same(*a, *b) => reading.vector(*a),
                _ => None,
            },
            ("dot", [a, b]) if reading.graph.is_same(*a, *b) => reading.vector(*a),
            _ => None,
        },
        _ => None,
    }
}

fn distances(reading: &Reading) -> Vec<(Id, Vector)> {
    let is_meant = |id: &Id| Some((*id, measured(reading, *id)?)).filter(|(_, vector)| !vector.is_normal());
    reading.tree.iter().filter_map(is_meant).collect()
}

fn distances_known(reading: &Reading) -> Answer {
    if distances(reading).is_empty() { Silent } else { Not }
}

fn distance(reading: &Reading, is_match: impl Fn(Vector) -> bool) -> Answer {
    let found = distances(reading);
    match found.iter().find(|(_, vector)| is_match(*vector)) {
        Some((id, _)) => At(*id, 1.0),
        None => distances_known(reading),
    }
}

/// A summand of the divisor: a constant times a power of the distance.
pub(super) struct Part {
    /// The power of the distance.
    pub degree: f64,
    /// The role of the constant, if it is a uniform.
    pub role: Option<Role>,
    /// The constant, if it is a number in the source.
    pub number: Option<f64>,
}

/// The divisor of the light that depends on the distance.
pub(super) struct Falloff {
    pub at: Id,
    pub parts: Vec<Part>,
}

impl Falloff {
    fn count(&self, degree: f64) -> usize {
        self.parts.iter().filter(|part| part.degree == degree).count()
    }

    fn has(&self, degree: f64) -> bool {
        self.count(degree) > 0
    }
}

/// Returns the first quotient whose divisor contains a distance.
pub(super) fn falloff(reading: &Reading) -> Option<Falloff> {
    let (quotient, divided) = reading.tree.iter().find_map(|id| {
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
        (bits & ATTENUATION != 0 && bits & (DIFFUSE | SPECULAR | AMBIENT) == 0).then_some((*id, by))
    })?;
    // The sum, if it is one; the distance itself is not at fault.
    let sum = reading.graph.core(divided);
    let at = if matches!(reading.graph.op(sum), Op::Call(..)) { quotient } else { sum };
    Some(Falloff { at, parts: parts(reading, divided) })
}

fn parts(reading: &Reading, sum: Id) -> Vec<Part> {
    let mut parts = Vec::new();
    for product in reading.products(sum) {
        let mut part = Part { degree: 0.0, role: None, number: Some(1.0) };
        for factor in &product.factors {
            let plain = reading.graph.plain(*factor);
            if let Some(number) = reading.graph.scalar(plain) {
                part.number = part.number.map(|n| n * number);
            } else if let Some(degree) = degree(reading, plain) {
                part.degree += degree;
            } else {
                part.number = None;
                part.role = reading.role(plain).or(part.role);
            }
        }
        parts.push(part);
    }
    parts
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

fn is_attenuation(name: &str) -> bool {
    let name = name.to_lowercase();
    ["att", "falloff", "fade"].iter().any(|word| name.contains(word))
}

fn missing(reading: &Reading) -> Answer {
    let is_used = reading.sum().iter().any(|p| p.bits & ATTENUATION != 0 && p.bits & (DIFFUSE | SPECULAR) != 0);
    if is_used {
        return Not;
    }
    // A number is in the place of the distance.
    let named = reading.tree.iter().copied().find(|id| match reading.graph.op(*id) {
        Op::Copy(inner, name) => is_attenuation(name) && reading.graph.number(*inner).is_some(),
        _ => false,
    });
    match named {
        Some(id) => At(id, 1.0),
        None => Answer::at_or(reading.meeting(), 0.9, Silent),
    }
}

/// Finds light that decreases with distance without a division by the distance.
fn other_formula(reading: &Reading) -> Answer {
    let fades = |p: &crate::dataflow::terms::Product| p.bits & ATTENUATION != 0 && p.bits & (DIFFUSE | SPECULAR) != 0;
    if falloff(reading).is_some() || !reading.sum().iter().any(fades) {
        return Silent;
    }
    if let At(..) = not_inverted(reading) {
        return Not;
    }
    let is_factor = |bits: u16| bits & ATTENUATION != 0 && bits & (DIFFUSE | SPECULAR | AMBIENT) == 0;
    let found = reading.tree.iter().copied().rfind(|id| is_factor(reading.bits(*id)));
    Answer::at_or(found, 1.0, Silent)
}

/// Finds a polynomial of the distance that is multiplied instead of divided by.
fn not_inverted(reading: &Reading) -> Answer {
    if falloff(reading).is_some() {
        return Not;
    }
    let found =
        reading.tree.iter().copied().rfind(|id| reading.bits(*id) == ATTENUATION && reading.sides(*id, Add).is_some());
    Answer::at_or(found, 1.0, distances_known(reading))
}
