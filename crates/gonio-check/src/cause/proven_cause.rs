//! A proven cause: an expression, with the right value and the names of what is wrong.

use super::model::INPUTS;
use super::observed::{SUMS, has_space, is_name};
use super::repair::{Make, Relation, Repair};
use super::right_change::RightChange;
use crate::mistakes::Mistake;
use gonio_glsl::{Span, Stage};
use gonio_interpreter::ExprId;
use gonio_language::tr;

/// A proven cause.
#[derive(Clone, Debug)]
pub struct ProvenCause {
    /// The stage.
    pub stage: Stage,
    /// The expression.
    pub expr: ExprId,
    /// Its position.
    pub span: Span,
    /// Its text.
    pub text: String,
    /// Its evaluation, if there are several.
    pub occurrence: Option<u32>,
    /// How the right value is made.
    pub make: Make,
    /// The expression that is missing in a sum.
    pub added: Option<ExprId>,
    /// What it should be: "should be the unit normal".
    pub should: String,
    /// What it is, if that is a quantity of the equation.
    pub is: Option<String>,
    /// How many further mistakes its pair of quantities shows as well as the first one.
    pub equals: usize,
    /// The relation of both.
    pub relation: Relation,
    /// The repair.
    pub(crate) repair: Repair,
    /// Steps from right values: 1 if it is computed from right values and inputs.
    pub depth: u32,
    /// Whether its value is a right one, of another quantity.
    pub is_right_elsewhere: bool,
    /// Whether its mistakes explain the picture.
    pub is_explained: bool,
    /// Whether its value is a right one: it is used wrongly.
    pub is_given: bool,
    /// Whether it is the result of a function that computes the wrong value, or the name of a wrong value.
    pub is_computed_elsewhere: bool,
    /// Whether it is the only place that reads a variable.
    pub is_only_read: bool,
    /// Whether it is all that a variable is set to.
    pub is_whole: bool,
    /// Whether it is an input, and the variable that is computed from it is named after the right one.
    pub is_against_name: bool,
    /// The assignment that spoils a right value of the variable that it reads: `ambient *= attenuation`.
    pub spoilt_at: Option<(Stage, Span)>,
    /// The assignment that computes the wrong value of the variable that it reads: `sum *= attenuation`.
    pub set_at: Option<(Stage, Span)>,
    /// Its right values at any points, and those of other places of the same mistake.
    pub right: Vec<RightChange>,
    /// Another mistake in the same expression.
    pub with: Option<&'static Mistake>,
    /// Other places of the same mistake.
    pub also: Vec<(Stage, ExprId)>,
    /// How directly the first mistake is shown: 0 by this expression itself.
    pub distance: u32,
    /// The cost of the repair.
    pub cost: f32,
    /// The mistakes of the catalogue that assign its wrong value to the same quantity, the most direct one first.
    pub mistakes: Vec<&'static Mistake>,
}

impl ProvenCause {
    /// What it is, as a sentence; empty if that is unknown.
    #[must_use]
    pub fn is_in_words(&self) -> String {
        self.is.as_ref().map(|is| tr!("check-here-it-is", quantity = is)).unwrap_or_default()
    }

    /// Whether it has a name.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        !self.mistakes.is_empty()
    }

    /// Whether it is the sum of all light, which every mistake makes wrong.
    #[must_use]
    pub fn is_of_sum(&self) -> bool {
        SUMS.contains(&self.repair.should.as_str())
    }

    /// Where the error is.
    #[must_use]
    pub fn place(&self) -> (Stage, Span) {
        self.spoilt_at.or(self.set_at).unwrap_or((self.stage, self.span))
    }

    /// Whether it only reads a variable, or a member of one.
    #[must_use]
    pub fn is_read(&self) -> bool {
        is_name(&self.text)
    }

    /// Whether it is a position or a direction that is computed from right values.
    #[must_use]
    pub fn is_first_vector(&self) -> bool {
        self.depth == 1 && has_space(&self.repair.should)
    }

    /// Whether an input stands where another one belongs.
    #[must_use]
    pub fn is_input_for_input(&self) -> bool {
        self.is_given && self.is_read() && INPUTS.iter().any(|(name, ..)| *name == self.repair.should)
    }

    /// Whether it computes a right term, of which another one is needed.
    #[must_use]
    pub fn is_right_term(&self) -> bool {
        self.is_given && !is_name(&self.text) && !has_space(&self.repair.should)
    }

    /// Whether it is the same value, written again.
    #[must_use]
    pub fn is_same_value(&self, other: &Self) -> bool {
        (self.stage, &self.text, &self.should) == (other.stage, &other.text, &other.should)
    }

    /// Whether the error is in this expression: it has a name, or it is computed from right values alone.
    #[must_use]
    pub fn is_root(&self) -> bool {
        self.is_sound() || self.depth <= 1
    }
}
