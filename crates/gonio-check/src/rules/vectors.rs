//! Mistakes with the normal, and with the directions to the light and to the eye.

use super::{Answer, At, Not, Silent, specular};
use crate::dataflow::vector::{By, Incoming, Space, Vector, VectorKind};
use crate::dataflow::{Id, Op, Reading};
use crate::mistakes::ModelSolution;

pub(super) fn normal_answer(reading: &Reading, id: &str) -> Option<Answer> {
    Some(match id {
        "normal-by-model-matrix" => by(reading, |by| match by {
            By::Model => Some(1.0),
            By::View { by_model: true } => Some(if reading.is_in_view() { 1.0 } else { 0.9 }),
            _ => None,
        }),
        "normal-by-model-view" => {
            if reading.is_in_view() {
                return Some(by(reading, |by| (by == By::View { by_model: true }).then_some(0.4)));
            }
            by(reading, |by| matches!(by, By::View { .. }).then_some(1.0))
        }
        "normal-by-whole-matrix" => by(reading, |by| (by == By::Whole).then_some(1.0)),
        "normal-translated" => by(reading, |by| (by == By::Translated).then_some(1.0)),
        "normal-not-transformed" => by(reading, |by| (by == By::Nothing).then_some(1.0)),
        "normal-is-position" => slots(reading, |vector, _| match vector.kind {
            VectorKind::Point(_) => Some((vector.at, 1.0)),
            _ => None,
        }),
        "normal-reversed" if reading.signs_cancel() => Not,
        "normal-reversed" => slots(reading, |vector, _| {
            (vector.is_normal() && vector.sign < 0.0).then(|| (vector.turned_at.unwrap_or(vector.at), 1.0))
        }),
        "normal-not-normalised-in-vertex" => slots(reading, |vector, slot| {
            (vector.is_normal() && !vector.is_unit && !vector.is_between).then_some((slot, 1.0))
        }),
        "normal-not-renormalised" => slots(reading, |vector, slot| {
            (vector.is_normal() && vector.is_between).then(|| (interpolated(reading, slot), 1.0))
        }),
        "normal-kept-unnormalised" => Silent,
        _ => return None,
    })
}

fn by(reading: &Reading, support_of: impl Fn(By) -> Option<f32>) -> Answer {
    slots(reading, |vector, _| match vector.kind {
        VectorKind::Normal(by) => support_of(by).map(|support| (vector.at, support)),
        _ => None,
    })
}

/// Returns the first node used as a normal that satisfies the condition.
fn slots(reading: &Reading, place_of: impl Fn(Vector, Id) -> Option<(Id, f32)>) -> Answer {
    let mut slots = reading.normals();
    if slots.is_empty() {
        // The normal may only be output.
        slots = reading.lookups().into_iter().map(|(_, id)| id).collect();
        slots.extend(reading.tree.iter().rev());
        slots.retain(|id| reading.vector(*id).is_some_and(|v| v.is_normal()));
        slots.truncate(1);
    }
    let known: Vec<(Vector, Id)> = slots.iter().filter_map(|id| Some((reading.vector(*id)?, *id))).collect();
    match known.iter().find_map(|(vector, id)| place_of(*vector, *id)) {
        Some((id, support)) => At(id, support),
        None if known.is_empty() => Silent,
        None => Not,
    }
}

/// Returns the node that reads the varying.
fn interpolated(reading: &Reading, mut id: Id) -> Id {
    loop {
        id = match reading.graph.op(id) {
            Op::Copy(inner, _) | Op::Swizzle(inner, _) | Op::Neg(inner) => *inner,
            Op::Construct(parts) => match parts.first() {
                Some(first) => *first,
                None => return id,
            },
            _ => return id,
        }
    }
}

pub(super) fn direction_answer(reading: &Reading, id: &str, model: ModelSolution) -> Option<Answer> {
    let light = |is_match: &dyn Fn(Vector) -> bool| first(reading, &reading.lights(), is_match);
    let eye = |is_match: &dyn Fn(Vector) -> bool| first(reading, &eyes(reading, model), is_match);
    Some(match id {
        "light-direction-reversed" if reading.signs_cancel() => Not,
        "light-direction-reversed" => {
            let turned = reading.diffuse_dots().into_iter().find_map(|(dot, ..)| reading.turned_after(dot));
            match reversed(reading, &diffuse_lights(reading)) {
                Not => Answer::at_or(turned, 0.9, Not),
                answer => answer,
            }
        }
        "light-direction-not-normalised" => light(&|v| matches!(v.kind, VectorKind::ToLight(..)) && !v.is_unit),
        "light-direction-minus-normal" => light(&|v| v.kind == VectorKind::LightMinusNormal),
        "light-position-as-direction" => light(&|v| matches!(v.kind, VectorKind::Light(Some(_))))
            .or(|| match light(&|v| v.kind == VectorKind::Light(None)) {
                // A constant position may be meant as a direction.
                At(id, _) => At(id, 0.9),
                answer => answer,
            })
            .or(|| constant_light(reading)),
        "view-direction-reversed" => {
            let eyes: Vec<Id> = eyes(reading, model).into_iter().filter(|id| in_highlight(reading, *id)).collect();
            if specular::signs_cancel(reading) { Not } else { reversed(reading, &eyes) }
        }
        "view-position-as-direction" => eye(&|v| v.kind == VectorKind::Eye),
        "view-direction-not-normalised" => eye(&|v| matches!(v.kind, VectorKind::ToEye(_)) && !v.is_unit),
        "view-position-at-origin" => match eye(&|v| matches!(v.kind, VectorKind::Point(space) if space != Space::View))
        {
            At(id, support) => At(source(reading, id), support),
            answer => answer,
        },
        "view-direction-is-front" => eye(&|v| matches!(v.kind, VectorKind::Front | VectorKind::Constant)),
        _ => return None,
    })
}

fn eyes(reading: &Reading, model: ModelSolution) -> Vec<Id> {
    let mut found = reading.eyes();
    if !model.is_lit() || found.is_empty() {
        found.extend(reading.reflections(Incoming::Other));
    }
    found
}

/// Returns the first variable that a direction was assigned to, before it was normalised and assigned to others.
fn source(reading: &Reading, slot: Id) -> Id {
    let (mut id, mut best) = (slot, slot);
    loop {
        id = match reading.graph.op(id) {
            Op::Copy(inner, _) => {
                best = id;
                *inner
            }
            Op::Call(name, parts) if name == "normalize" && !parts.is_empty() => parts[0],
            _ => return best,
        };
    }
}

fn diffuse_lights(reading: &Reading) -> Vec<Id> {
    reading.diffuse_dots().into_iter().flat_map(|(_, a, b)| [a, b]).collect()
}

fn in_highlight(reading: &Reading, id: Id) -> bool {
    reading.specular_dots().iter().any(|(_, a, b)| *a == id || *b == id)
}

fn first(reading: &Reading, slots: &[Id], is_match: &dyn Fn(Vector) -> bool) -> Answer {
    let known: Vec<(Id, Vector)> = slots.iter().filter_map(|id| Some((*id, reading.vector(*id)?))).collect();
    match known.iter().find(|(_, vector)| is_match(*vector)) {
        Some((id, _)) => At(reading.spot(*id), 1.0),
        None if known.is_empty() => Silent,
        None => Not,
    }
}

/// Finds a direction to the light or the eye that is negated, or a difference in the wrong order.
fn reversed(reading: &Reading, slots: &[Id]) -> Answer {
    let towards: Vec<Vector> = slots
        .iter()
        .filter_map(|id| reading.vector(*id))
        .filter(|vector| matches!(vector.kind, VectorKind::ToLight(..) | VectorKind::ToEye(_) | VectorKind::Light(_)))
        .collect();
    match towards.iter().find(|vector| vector.sign < 0.0) {
        Some(vector) => At(vector.turned_at.unwrap_or(vector.at), 1.0),
        None if towards.is_empty() => Silent,
        None => Not,
    }
}

/// Finds a constant direction in a dot product with the normal, which is used as the light's.
fn constant_light(reading: &Reading) -> Answer {
    for (_, a, b) in reading.diffuse_dots() {
        for (one, other) in [(a, b), (b, a)] {
            let is = |id: Id, is: &dyn Fn(Vector) -> bool| reading.vector(id).is_some_and(is);
            if is(one, &|v| v.kind == VectorKind::Constant) && is(other, &|v| v.is_normal()) {
                return At(one, 0.9);
            }
        }
    }
    if reading.lights().is_empty() { Silent } else { Not }
}
