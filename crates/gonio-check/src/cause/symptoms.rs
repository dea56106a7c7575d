//! Whether a proven repair is a symptom: its expression has a wrong value, but the error is at another place.

use super::model::INPUTS;
use super::observed::{Observed, Observer, is_name};
use super::repair::{Make, Relation, Repair};
use crate::roles::is_of_reflection;
use gonio_glsl::Stage;
use gonio_interpreter::ExprId;

/// All proven repairs of a program, which tell about each other.
#[derive(Clone, Copy)]
pub(super) struct Symptoms<'a> {
    pub at: Observer<'a>,
    pub observed: &'a [Observed],
    pub proven: &'a [Repair],
}

impl<'a> Symptoms<'a> {
    /// Whether the error is at another place.
    pub fn is_symptom(&self, seen: &Observed, repair: &Repair) -> bool {
        // A vector may have any length until it is set for the last time.
        let is_of_call = self.is_call_of_another(seen) && self.set_last(seen, repair) != Some(seen.expr);
        is_of_call && !self.lacks_factor(seen, repair) || self.is_elsewhere(seen, repair)
    }

    /// The function around an expression.
    pub fn function(&self, seen: &Observed) -> Option<&'a str> {
        let source = &self.at.runner.program.stage(seen.stage).source;
        source.expressions[seen.expr.0 as usize].function.as_deref()
    }

    /// A right value that a variable of another meaning is set to: of two opposite vectors, the name tells the meaning.
    pub fn is_copied(&self, seen: &Observed) -> bool {
        let (program, text) = (self.at.runner.program, self.at.text(seen));
        let Some(variable) = program.variable_set_to(seen.stage, seen.expr) else { return false };
        let is_opposite =
            text.strip_prefix('-').is_some_and(|text| is_name(text.trim_start())) && is_of_reflection(variable);
        let is_read = |other: &Observed| {
            let is_other = self.at.text(other) != text && is_name(self.at.text(other));
            other.stage == seen.stage && is_other && other.values.is_same(&seen.values)
        };
        (is_name(text) || is_opposite) && self.repaired().any(is_read)
    }

    /// The expressions of all proven repairs.
    fn repaired(&self) -> impl Iterator<Item = &'a Observed> {
        let observed = self.observed;
        self.proven.iter().map(move |repair| &observed[repair.of])
    }

    /// Whether an expression is a call of a function.
    fn is_call_of(&self, seen: &Observed, function: &str) -> bool {
        self.at.text(seen).strip_prefix(function).is_some_and(|text| text.trim_start().starts_with('('))
    }

    /// The result of a student's function is wrong where the function computes it.
    fn is_call_of_another(&self, seen: &Observed) -> bool {
        self.repaired().any(|other| {
            other.stage == seen.stage
                && self.is_call_of(seen, self.function(other).unwrap_or("main"))
                && other.values.is_same(&seen.values)
        })
    }

    /// A factor that a right result lacks is missing at the call.
    fn lacks_factor(&self, seen: &Observed, repair: &Repair) -> bool {
        let model = self.at.model;
        let is_factor = |q: usize| {
            INPUTS.iter().any(|(name, ..)| {
                let factor = model.right(name, seen.stage, false);
                factor.is_some_and(|factor| seen.values.is_factor_of(factor, &model.quantities[q].values))
            })
        };
        seen.is_given() && (repair.relation == Relation::Factor || repair.quantity().is_some_and(is_factor))
    }

    /// The last variable that is set to a vector which should have length 1: it may have any length until then.
    fn set_last(&self, seen: &Observed, repair: &Repair) -> Option<ExprId> {
        let is_of_length = match repair.make {
            Make::Unit => true,
            Make::Quantity(q) => {
                let right = &self.at.model.quantities[q].values;
                seen.values.is_parallel(right, 1.0) && right.unit().is_same(right)
            }
            _ => false,
        };
        let is_it = |other: &&Observed| {
            other.stage == seen.stage
                && self.at.runner.program.is_whole_value(other.stage, other.expr)
                && other.values.is_same(&seen.values)
        };
        let last = || self.repaired().filter(is_it).max_by_key(|other| self.at.tokens(other));
        is_of_length.then(last).flatten().map(|last| last.expr)
    }

    /// A varying is wrong where the vertex shader computes it.
    fn is_of_vertex(&self, seen: &Observed, repair: &Repair) -> bool {
        let of = |repair: &Repair| repair.quantity().map(|q| &self.at.model.quantities[q]);
        let Some(varying) = of(repair).filter(|q| seen.stage == Stage::Fragment && q.interpolated) else {
            return false;
        };
        let in_vertex = self.proven.iter().filter(|other| self.observed[other.of].stage == Stage::Vertex);
        is_name(self.at.text(seen)) && in_vertex.filter_map(of).any(|q| q.name == varying.name)
    }

    /// Whether an argument of a call is the same value, and as wrong.
    fn is_passed(&self, seen: &Observed) -> bool {
        let Some(of) = self.function(seen) else { return false };
        let calls = self.observed.iter().filter(|call| call.stage == seen.stage && self.is_call_of(call, of));
        let is_argument = |other: &Observed, call: &Observed| {
            self.at.is_within(other, call) && is_name(self.at.text(other)) && other.values.is_same(&seen.values)
        };
        calls.into_iter().any(|call| self.repaired().any(|other| is_argument(other, call)))
    }

    /// Whether a constant is computed from a wrong one that a variable or a function of the student has.
    fn is_of_constant_elsewhere(&self, seen: &Observed) -> bool {
        let functions = &self.at.runner.program.stage(seen.stage).source.expressions;
        let is_set_elsewhere = |other: &Observed| {
            let text = self.at.text(other);
            let is_called =
                || functions.iter().filter_map(|e| e.function.as_deref()).any(|f| self.is_call_of(other, f));
            !self.at.is_input(other) && (is_name(text) || is_called())
        };
        let is_part = |other: &Observed| other.expr != seen.expr && self.at.is_within(other, seen);
        self.repaired().any(|other| is_part(other) && other.values.is_constant() && is_set_elsewhere(other))
    }

    /// A wrong name is wrong where its value is computed; a right value of another kind where it is used.
    fn is_elsewhere(&self, seen: &Observed, repair: &Repair) -> bool {
        if self.is_of_vertex(seen, repair) {
            return true;
        }
        if let Some(last) = self.set_last(seen, repair) {
            return seen.expr != last;
        }
        let is_read = is_name(self.at.text(seen));
        // A constant is wrong where it is computed.
        let is_constant = seen.values.is_constant() && !self.at.is_input(seen);
        if is_constant && !is_read {
            return self.is_of_constant_elsewhere(seen);
        }
        let of_constant = is_constant && seen.defined_at.is_some();
        let is_of_kind = repair.quantity().is_none_or(|q| {
            let quantity = &self.at.model.quantities[q];
            let right = &quantity.values;
            let is_vector = seen.values.is_parallel(right, 1.0) || seen.values.is_parallel(right, -1.0);
            // A matrix is missing where the position on the screen is computed.
            let is_position = quantity.name == "gl_Position";
            is_vector || is_position || seen.values.is_clamped(right) || right.is_power_of(&seen.values)
        });
        // A value of the right kind is passed to a function where the function is called.
        if is_read && is_of_kind && self.is_passed(seen) {
            return true;
        }
        let is_use = seen.is_given() && !is_of_kind && !of_constant;
        if is_use && self.is_copied(seen) {
            return false;
        }
        let is_error = |other: &Observed| {
            let is_same = other.stage == seen.stage && other.values.is_same(&seen.values);
            let is_definition = || is_read && seen.defined_at.is_some_and(|at| self.observed[at].expr == other.expr);
            other.expr != seen.expr && is_name(self.at.text(other)) != is_read && (is_same || is_definition())
        };
        is_use != is_read && self.repaired().any(is_error)
    }
}
