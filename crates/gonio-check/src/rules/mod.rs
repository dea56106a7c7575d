//! Finds the expression that makes a mistake.

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
    /// The expression, or the place where something is missing; with the support of the source, 0 to 1.
    At(Id, f32),
    /// The source is right in this respect.
    Not,
    /// The source does not decide.
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
    /// Returns the variable that holds a direction, or the expression, without a sign before it.
    fn spot(&self, mut id: Id) -> Id {
        while let Op::Neg(inner) = self.graph.op(id) {
            id = *inner;
        }
        id
    }

    /// Returns the deepest sum, product or quotient whose operands satisfy the condition in either order.
    fn deepest(&self, ops: &[gonio_glsl::ast::BinaryOp], is: impl Fn(Id, Id) -> bool) -> Option<Id> {
        self.tree.iter().copied().find(|id| match self.graph.op(*id) {
            Op::Binary(op, a, b) if ops.contains(op) => is(*a, *b) || is(*b, *a),
            _ => false,
        })
    }
}

/// Returns a power of a cosine that may be negative, with the clamp around the power instead of inside.
pub(super) fn power_under_maximum(reading: &Reading) -> Option<Id> {
    let At(..) = specular::not_clamped(reading) else { return None };
    reading.powers().into_iter().map(|(power, ..)| power).find(|power| {
        let mut around = reading.around(*power).into_iter();
        around.any(|id| matches!(reading.graph.op(id), Op::Call(name, _) if name == "max" || name == "clamp"))
    })
}
