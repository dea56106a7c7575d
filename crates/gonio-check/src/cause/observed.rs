//! The values of all expressions of a program, and what they are.

use super::model::{Model, Quantity, STAGES, Space, TELLING, observe};
use super::program::{Change, Runner};
use super::values::Values;
use gonio_glsl::Stage;
use gonio_interpreter::{ExprId, InputRate};
use std::collections::BTreeMap;

/// An expression of the student's program with its values at all points.
#[derive(Clone, Debug)]
pub struct Observed {
    /// Its stage.
    pub stage: Stage,
    /// Its number.
    pub expr: ExprId,
    /// Its evaluation, if there are several.
    pub occurrence: Option<u32>,
    /// Its values.
    pub values: Values,
    /// The right quantity that it is, by its index in the model.
    pub is: Option<usize>,
    /// Whether it is computed from a value that is recognised as wrong.
    pub has_wrong_input: bool,
    /// Whether it reads a variable that is no right quantity.
    pub reads_wrong: bool,
}

/// Observes a program and compares its values with the quantities of one method.
#[derive(Clone, Copy)]
pub(crate) struct Observer<'a> {
    /// The program.
    pub runner: &'a Runner<'a>,
    /// The quantities.
    pub model: &'a Model,
}

/// Names of quantities that have a space.
pub(super) fn has_space(name: &str) -> bool {
    const PLACED: [&str; 12] = [
        "N",
        "world_normal",
        "v_normal",
        "L",
        "to_light",
        "V",
        "to_eye",
        "R",
        "I",
        "from_eye",
        "world_position",
        "light_pos",
    ];
    PLACED.contains(&name) || name == "u_view_pos"
}

/// Names of the diffuse term.
pub(super) const DIFFUSE_NAMES: [&str; 2] = ["cos_theta", "diffuse"];
/// Names of the specular term.
pub(super) const SPECULAR_NAMES: [&str; 2] = ["spec", "specular"];
/// The terms of the light equation, with and without their strengths.
pub(super) const TERMS: [&str; 5] = ["ambient", "diffuse", "specular", "cos_theta", "spec"];
/// Quantities that contain a strength, which may be a constant of the program.
pub(super) const SCALED: [&str; 7] = ["diffuse", "specular", "ambient", "attenuated", "lit", "colour", "FragColor"];

/// Whether an expression assigns; its value is that of its right side.
fn is_assignment(text: &str) -> bool {
    let after = text.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || "_.[] \t".contains(c));
    let after = after.strip_prefix(['+', '-', '*', '/']).unwrap_or(after);
    after.starts_with('=') && !after.starts_with("==")
}

pub(super) fn is_single_token((first, last): (u32, u32)) -> bool {
    first == last
}

impl Observer<'_> {
    /// How many values of the program are quantities of this method and of no other.
    #[must_use]
    pub fn likeness(&self) -> usize {
        const TELLING_NAMES: [&str; 10] =
            ["v_normal", "dot(N, H)", "H", "L + V", "R", "dot(R, V)", "cos_theta", "cos_phi", "spec", "dot(N, L)"];
        let few = 0..self.runner.samples.len().min(TELLING);
        let observed = self.observe(&[], few);
        let is_here = |q: &&Quantity| {
            TELLING_NAMES.contains(&q.name.as_str())
                && q.interpolated == (q.name == "v_normal")
                && observed.iter().any(|seen| seen.stage == q.stage && seen.values.is_same(&q.values))
        };
        let half = ["dot(N, H)", "H", "L + V"];
        let reflected = ["R", "dot(R, V)"];
        let is_of_method =
            |name: &str| !(if self.model.method.half_vector { &reflected[..] } else { &half[..] }).contains(&name);
        self.model.quantities.iter().filter(is_here).filter(|q| is_of_method(&q.name)).count()
    }

    /// Observes all expressions in some scenes.
    #[must_use]
    pub fn observe(&self, changes: &[Change], scenes: std::ops::Range<usize>) -> Vec<Observed> {
        let exprs = STAGES.map(|stage| self.runner.program.numbers(stage));
        let mut found = observe(self.runner, changes, scenes, [&exprs[0], &exprs[1]]);
        found.retain(|seen| !is_assignment(self.runner.program.text(seen.stage, seen.expr)));
        let mut counts = BTreeMap::<(Stage, ExprId), usize>::new();
        found.iter().for_each(|seen| *counts.entry((seen.stage, seen.expr)).or_default() += 1);
        let observed = found.into_iter().map(|seen| {
            let occurrence = (counts[&(seen.stage, seen.expr)] > 1).then_some(seen.occurrence);
            Observed {
                stage: seen.stage,
                expr: seen.expr,
                occurrence,
                values: seen.values,
                is: None,
                has_wrong_input: false,
                reads_wrong: false,
            }
        });
        observed.collect()
    }

    /// Recognises the right quantities among the values, and marks expressions with a wrong input.
    pub(super) fn interpret(&self, observed: &mut [Observed]) {
        for seen in observed.iter_mut() {
            seen.is = self.recognise(seen.stage, &seen.values);
        }
        let space = self.space(observed);
        let right = |seen: &Observed| {
            seen.is.is_some_and(|is| {
                let quantity = &self.model.quantities[is];
                !has_space(&quantity.name) || quantity.space == space
            })
        };
        let is_wrong: Vec<bool> = (observed.iter())
            .map(|seen| !right(seen) && !self.is_input(seen) && self.is_recognised_wrong(seen))
            .collect();
        let tokens = |seen: &Observed| {
            let tokens = self.runner.program.stage(seen.stage).source.expressions[seen.expr.0 as usize].tokens;
            (tokens.first, tokens.last)
        };
        // A variable is wrong where it is computed, not where it is read.
        for seen in observed.iter_mut() {
            let (first, last) = tokens(seen);
            seen.has_wrong_input = first == last && !right(seen) && !self.is_input(seen) && !self.is_literal(seen);
        }
        for _ in 0..4 {
            // The value of a read variable is wrong for its readers only if it is recognised as such.
            let tainted: Vec<bool> = (0..observed.len())
                .map(|at| is_wrong[at] || observed[at].has_wrong_input && !is_single_token(tokens(&observed[at])))
                .collect();
            let mut is_changed = false;
            for at in 0..observed.len() {
                let seen = &observed[at];
                if seen.has_wrong_input || right(seen) {
                    continue;
                }
                let (first, last) = tokens(seen);
                let has_wrong_input = (0..observed.len()).any(|other| {
                    if other == at || !tainted[other] {
                        return false;
                    }
                    let input = &observed[other];
                    let within = tokens(input);
                    let is_within =
                        input.stage == seen.stage && within.0 >= first && within.1 <= last && within != (first, last);
                    // A name read here that has been computed elsewhere.
                    let is_read = first == last
                        && tokens(input).0 != tokens(input).1
                        && input.stage == seen.stage
                        && input.values.is_same(&seen.values);
                    is_within || is_read
                });
                if has_wrong_input {
                    observed[at].has_wrong_input = true;
                    is_changed = true;
                }
            }
            if !is_changed {
                break;
            }
        }
        let unknown: Vec<(Stage, u32)> = (observed.iter())
            .filter(|seen| seen.has_wrong_input && is_single_token(tokens(seen)))
            .map(|seen| (seen.stage, tokens(seen).0))
            .collect();
        for seen in observed.iter_mut() {
            let (first, last) = tokens(seen);
            seen.reads_wrong =
                first != last && unknown.iter().any(|(stage, at)| *stage == seen.stage && (first..=last).contains(at));
        }
    }

    /// The text of an expression.
    pub(super) fn text(&self, seen: &Observed) -> &str {
        self.runner.program.text(seen.stage, seen.expr)
    }

    pub(super) fn tokens(&self, seen: &Observed) -> (u32, u32) {
        let tokens = self.runner.program.stage(seen.stage).source.expressions[seen.expr.0 as usize].tokens;
        (tokens.first, tokens.last)
    }

    /// The terms of the equation that a value is, up to a constant factor, right or with a known mistake.
    pub(super) fn terms(&self, seen: &Observed) -> Vec<&str> {
        let of_term = |q: &&Quantity| {
            q.stage == seen.stage
                && (DIFFUSE_NAMES.contains(&q.name.as_str()) || SPECULAR_NAMES.contains(&q.name.as_str()))
        };
        let is_it = |q: &&Quantity| !seen.values.is_constant() && seen.values.factor_of(&q.values).is_some();
        self.model.quantities.iter().filter(of_term).filter(is_it).map(|q| q.name.as_str()).collect()
    }

    pub(super) fn is_literal(&self, seen: &Observed) -> bool {
        self.text(seen).starts_with(|c: char| c.is_ascii_digit() || c == '.')
    }

    /// Whether it reads an attribute or a uniform, which are never wrong themselves.
    pub(super) fn is_input(&self, seen: &Observed) -> bool {
        let (program, text) = (self.runner.program, self.text(seen));
        program
            .stage(seen.stage)
            .inputs
            .iter()
            .any(|input| input.name == text && (seen.stage == Stage::Vertex || input.rate == InputRate::Uniform))
    }

    /// Whether the values are those of a mistake, or a right quantity's with another sign or length or in another space.
    pub(super) fn is_recognised_wrong(&self, seen: &Observed) -> bool {
        seen.is.is_some()
            || self.model.quantities.iter().any(|q| {
                q.stage == seen.stage
                    && q.values.size == seen.values.size
                    && if q.mistake.is_some() {
                        q.is_direct && q.values.is_same(&seen.values)
                    } else {
                        seen.values.is_parallel(&q.values, -1.0)
                    }
            })
    }

    pub(super) fn recognise(&self, stage: Stage, values: &Values) -> Option<usize> {
        let is_it = |q: &Quantity| q.stage == stage && q.mistake.is_none() && q.values.is_same(values);
        self.model.quantities.iter().position(is_it)
    }

    /// The space in which most vectors are.
    pub(super) fn space(&self, observed: &[Observed]) -> Space {
        let count = |space: Space| {
            let of = |o: &&Observed| {
                o.is.is_some_and(|is| {
                    let quantity = &self.model.quantities[is];
                    quantity.space == space && has_space(&quantity.name)
                })
            };
            observed.iter().filter(of).count()
        };
        if count(Space::View) > count(Space::World) { Space::View } else { Space::World }
    }
}
