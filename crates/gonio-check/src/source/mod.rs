//! What the source of a pair shows and its values do not: constants that could be inputs, roles of matrices by their use,
//! and the lines of mistakes with the faces of a cubemap, which are judged by pictures.

mod analysis;
mod constants;
mod falloff;
mod panorama;

#[cfg(test)]
mod tests;

pub use analysis::{Analysis, Place};
pub use constants::{ConstantSun, SourceConstants};

use crate::dataflow::terms::SPECULAR;
use crate::dataflow::{Id, Op, Reading};

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

/// Returns a power of a cosine that may be negative, with the clamp around the power instead of inside.
pub(super) fn power_under_maximum(reading: &Reading) -> Option<Id> {
    let graph = &reading.graph;
    let may_be_negative = |base: Id| match graph.op(graph.plain(base)) {
        Op::Neg(_) => true,
        Op::Call(name, _) => name == "dot",
        _ => false,
    };
    let is_clamp = |id: Id| matches!(graph.op(id), Op::Call(name, _) if name == "max" || name == "clamp");
    let powers = reading.powers().into_iter();
    powers
        .filter(|(_, base, _)| may_be_negative(*base) && !reading.is_tested(SPECULAR))
        .map(|(power, ..)| power)
        .find(|power| reading.around(*power).into_iter().any(is_clamp))
}
