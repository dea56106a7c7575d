//! For each mistake, the expression that makes it.

mod ambient;
mod analysis;
mod attenuation;
mod camera;
mod constants;
mod diffuse;
mod environment;
mod panorama;
mod places;
mod specular;
mod vectors;

#[cfg(test)]
mod tests;

pub use analysis::{Analysis, Place};
pub use constants::{ConstantSun, SourceConstants};

use crate::dataflow::{Id, Op, Reading};
use crate::mistakes::ModelSolution;

/// The evidence in the source for a mistake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Answer {
    /// Here it stands, or should stand what is missing; from 0 to 1 how far the source shows it.
    At(Id, f32),
    /// The source has it right.
    Not,
    /// Nothing can be told.
    Silent,
}

use Answer::{At, Not, Silent};

impl Answer {
    fn at_or(found: Option<Id>, support: f32, otherwise: Answer) -> Self {
        found.map_or(otherwise, |id| At(id, support))
    }

    fn or(self, other: impl FnOnce() -> Answer) -> Self {
        if let At(..) = self { self } else { other() }
    }
}

/// Returns the evidence in the source for a mistake of the catalogue.
pub(super) fn answer(reading: &Reading, id: &str, model: ModelSolution) -> Answer {
    if model.is_of_places() {
        return camera::answer(reading, id);
    }
    if model == ModelSolution::Panorama {
        return panorama::answer(reading, id);
    }
    let found = vectors::normal_answer(reading, id)
        .or_else(|| places::answer(reading, id, model))
        .or_else(|| vectors::direction_answer(reading, id, model))
        .or_else(|| diffuse::answer(reading, id))
        .or_else(|| specular::answer(reading, id))
        .or_else(|| ambient::answer(reading, id))
        .or_else(|| attenuation::answer(reading, id));
    found.or_else(|| environment::answer(reading, id, model)).unwrap_or(Silent)
}

impl Reading {
    /// The variable that holds a direction, or itself; a sign in front of it is not at fault.
    fn spot(&self, mut id: Id) -> Id {
        while let Op::Neg(inner) = self.graph.op(id) {
            id = *inner;
        }
        id
    }

    /// The deepest sum, product or quotient for which that holds of its two sides, in either order.
    fn deepest(&self, ops: &[gonio_glsl::ast::BinaryOp], is: impl Fn(Id, Id) -> bool) -> Option<Id> {
        self.tree.iter().copied().find(|id| match self.graph.op(*id) {
            Op::Binary(op, a, b) if ops.contains(op) => is(*a, *b) || is(*b, *a),
            _ => false,
        })
    }
}

/// A power of a cosine that may be negative, with the clamp around the power instead of within.
pub(super) fn power_under_maximum(reading: &Reading) -> Option<Id> {
    let At(..) = specular::not_clamped(reading) else { return None };
    reading.powers().into_iter().map(|(power, ..)| power).find(|power| {
        let mut around = reading.around(*power).into_iter();
        around.any(|id| matches!(reading.graph.op(id), Op::Call(name, _) if name == "max" || name == "clamp"))
    })
}
