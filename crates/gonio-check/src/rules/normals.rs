//! Mistakes with the normal.

use super::{Answer, At, Not, Silent};
use crate::dataflow::vector::{By, Vector, VectorKind};
use crate::dataflow::{Id, Op, Reading};

pub(super) fn answer(reading: &Reading, id: &str) -> Option<Answer> {
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

fn by(reading: &Reading, wanted: impl Fn(By) -> Option<f32>) -> Answer {
    slots(reading, |vector, _| match vector.kind {
        VectorKind::Normal(by) => wanted(by).map(|support| (vector.at, support)),
        _ => None,
    })
}

/// Of all that stands where a normal belongs, the first that is meant.
fn slots(reading: &Reading, wanted: impl Fn(Vector, Id) -> Option<(Id, f32)>) -> Answer {
    let mut slots = reading.normals();
    if slots.is_empty() {
        // Perhaps it is only put out.
        slots = reading.lookups().into_iter().map(|(_, id)| id).collect();
        slots.extend(reading.tree.iter().rev());
        slots.retain(|id| reading.vector(*id).is_some_and(|v| v.is_normal()));
        slots.truncate(1);
    }
    let known: Vec<(Vector, Id)> = slots.iter().filter_map(|id| Some((reading.vector(*id)?, *id))).collect();
    match known.iter().find_map(|(vector, id)| wanted(*vector, *id)) {
        Some((id, support)) => At(id, support),
        None if known.is_empty() => Silent,
        None => Not,
    }
}

/// Where the varying is read.
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
