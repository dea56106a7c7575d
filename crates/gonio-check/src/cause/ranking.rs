//! Which of several proven causes of one mistake is the likeliest: where the student has to change the program.

use super::observed::is_name;
use super::proven_cause::ProvenCause;
use super::repair::{Make, Relation};
use super::symptoms::Symptoms;
use gonio_glsl::{Span, Stage};
use gonio_interpreter::ExprId;

/// What all causes together tell about each of them.
pub(super) struct Ranking<'a> {
    symptoms: &'a Symptoms<'a>,
    /// Wrong values that are the mistake's own.
    wrong: Vec<(Stage, Span)>,
    /// Wrong values from which a right one may be computed, which makes it another quantity: with their functions.
    first: Vec<(Stage, ExprId, Span, Option<&'a str>)>,
    /// Quantities, by their indices in the model, by which terms are multiplied where all are added up.
    factors: Vec<(Stage, usize)>,
    /// Expressions that compute a right value of another quantity: they are wrong, and not what the value is copied from.
    computed: Vec<(Stage, ExprId, usize)>,
}

impl<'a> Ranking<'a> {
    /// Compares causes with each other.
    pub fn new(symptoms: &'a Symptoms<'a>, all: &[ProvenCause]) -> Self {
        let Symptoms { at, observed, .. } = *symptoms;
        let explained = || all.iter().filter(|cause| !cause.is_given && cause.is_explained);
        let wrong = explained().filter(|cause| cause.distance == 0).map(|cause| (cause.stage, cause.span)).collect();
        let first = explained()
            .filter(|cause| cause.depth == 1 && cause.relation < Relation::Clamp)
            .map(|cause| (cause.stage, cause.expr, cause.span, symptoms.function(&observed[cause.repair.of])));
        let factors = explained().filter(|cause| cause.distance <= 1).flat_map(|cause| {
            let of_factor = move |q: &usize| {
                observed.iter().any(|other| {
                    let is_inside = at.is_within(other, &observed[cause.repair.of]);
                    is_inside
                        && is_name(at.text(other))
                        && other.is == Some(*q)
                        && at.model.quantities[*q].stage == cause.stage
                })
            };
            (0..at.model.quantities.len()).filter(of_factor).map(|q| (cause.stage, q))
        });
        let computed = all.iter().filter(|cause| cause.is_given && cause.is_sound() && !cause.is_read());
        let computed = computed.map(|cause| (cause.stage, cause.expr, cause.repair.of)).collect();
        Ranking { symptoms, wrong, first: first.collect(), factors: factors.collect(), computed }
    }

    /// Whether a term lacks a factor that the others get where all are added up: it is missing there.
    fn is_factor_of_later(&self, cause: &ProvenCause) -> bool {
        let quantities = &self.symptoms.at.model.quantities;
        match cause.make {
            Make::Times(q) => self.factors.contains(&(cause.stage, q)),
            // The same as another quantity.
            Make::Quantity(q) => {
                let (own, right) = (&self.symptoms.observed[cause.repair.of].values, &quantities[q].values);
                let mut factors = self.factors.iter().filter(|(stage, _)| *stage == cause.stage);
                factors.any(|(_, factor)| own.is_factor_of(&quantities[*factor].values, right))
            }
            _ => false,
        }
    }

    /// A key by which the likeliest cause comes first.
    pub fn rank(&self, cause: &ProvenCause) -> impl Ord + use<> {
        let Symptoms { at, observed, .. } = *self.symptoms;
        let (program, seen) = (at.runner.program, &observed[cause.repair.of]);
        let is_within = |(stage, span): &(Stage, Span)| {
            *stage == cause.stage && span.start <= cause.span.start && cause.span.end <= span.end
        };
        let name = (cause.mistakes.is_empty(), cause.distance.min(2), cause.relation);
        // A part of an expression that is the mistake itself, or a number within a formula.
        let is_number = cause.text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let is_part = cause.distance > 0 && self.wrong.iter().any(is_within)
            || self.is_factor_of_later(cause)
            || is_number && !program.is_set_in_vector_or_alone(cause.stage, cause.expr);
        let of = self.symptoms.function(seen);
        let is_after = self.first.iter().any(|(stage, expr, span, function)| {
            (*stage, function) == (cause.stage, &of) && *expr < cause.expr && !is_within(&(*stage, *span))
        });
        let is_of_length = cause.relation == Relation::Length && program.is_whole_value(cause.stage, cause.expr);
        let is_copied_later = cause.is_read()
            && cause.is_given
            && self.computed.iter().any(|(stage, expr, of)| {
                (*stage, *expr > cause.expr) == (cause.stage, true) && observed[*of].values.is_same(&seen.values)
            });
        let unlikely = (cause.is_right_elsewhere && !is_of_length || is_copied_later, cause.is_computed_elsewhere);
        // A product with 1 has the value of an input, and is none.
        let is_product = seen.values.is_constant() && !is_name(&cause.text) && !is_number;
        let right = cause.repair.quantity().map(|q| &at.model.quantities[q]);
        let is_exchanged = cause.relation == Relation::Other && at.is_exchange(seen, right);
        let lacks_colour = cause.relation == Relation::Factor && at.is_set_to_term(seen);
        let is_use = !is_of_length
            && !lacks_colour
            && !is_product
            && !is_exchanged
            && !self.symptoms.is_copied(seen)
            && cause.is_given
            && (cause.distance > 0 || is_after || self.wrong.iter().any(is_within));
        let is_in_function = of != Some("main");
        let place = (cause.stage, cause.expr);
        (!cause.is_explained, is_part, unlikely, is_use, cause.depth, name, is_in_function, place)
    }
}
