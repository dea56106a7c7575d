//! The values of all expressions of a program, and what they are.

pub(super) use super::answer::has_space;
use super::model::{Model, Quantity, STAGES, Space, TELLING, observe};
use super::program::{Change, Runner};
use super::samples::interpolated;
use super::values::Values;
use gonio_glsl::Stage;
use gonio_interpreter::ExprId;
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
    /// Whether it assigns; its value is the new one.
    pub is_assignment: bool,
    /// Where the value of a name or of a call was computed, by its index.
    pub defined_at: Option<usize>,
    /// Steps from right values: 0 for right values and inputs, 1 if it is computed from such, and so on.
    pub depth: u32,
}

impl Observed {
    /// Whether it is a right value or an input.
    #[must_use]
    pub fn is_given(&self) -> bool {
        self.depth == 0
    }
}

/// How often a function is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Evaluations {
    /// Twice, as for two lights.
    Several,
    /// More often.
    Many,
}

/// Observes a program and compares its values with the quantities of one method.
#[derive(Clone, Copy)]
pub(crate) struct Observer<'a> {
    /// The program.
    pub runner: &'a Runner<'a>,
    /// The quantities.
    pub model: &'a Model,
}

/// Names of the diffuse term.
pub(super) const DIFFUSE_NAMES: [&str; 3] = ["cos_theta", "diffuse", "diffuse_light"];
/// Names of the specular term.
pub(super) const SPECULAR_NAMES: [&str; 3] = ["spec", "specular", "specular_light"];
/// The terms of the light equation, with and without their strengths.
pub(super) const TERMS: [&str; 5] = ["ambient", "diffuse", "specular", "cos_theta", "spec"];
/// Quantities that contain a strength, which may be a constant of the program.
pub(super) const SCALED: [&str; 9] =
    ["diffuse", "specular", "ambient", "diffuse_light", "specular_light", "attenuated", "lit", "colour", "FragColor"];
/// Sums of terms.
pub(super) const SUMS: [&str; 4] = ["attenuated", "lit", "colour", "FragColor"];

/// Whether an expression assigns; its value is that of its right side.
pub(super) fn is_assignment(text: &str) -> bool {
    assignment(text).is_some()
}

/// The variable that an expression assigns to, and whether by an operator such as `+=`.
pub(super) fn assignment(text: &str) -> Option<(&str, bool)> {
    let after = text.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || "_.[] \t".contains(c));
    let variable = text[..text.len() - after.len()].trim();
    let equals = after.strip_prefix(['+', '-', '*', '/']).unwrap_or(after);
    (equals.starts_with('=') && !equals.starts_with("==")).then_some((variable, equals.len() < after.len()))
}

/// Whether an expression only reads a variable, or a member of one.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || "_.[]".contains(c))
}

/// Whether an expression is a number or a vector of numbers, or sets a variable to one: `colour = vec4(0.0, 0.0, 0.0, 1.0)`.
pub(super) fn is_of_numbers(text: &str) -> bool {
    let value = assignment(text).and_then(|_| text.split_once('=')).map_or(text, |(_, value)| value);
    let value = ["vec2", "vec3", "vec4", "float"].iter().fold(value.to_owned(), |text, word| text.replace(word, ""));
    let is_of_number = |c: char| c.is_ascii_digit() || " .,+-*/()fF".contains(c);
    value.contains(|c: char| c.is_ascii_digit()) && value.chars().all(is_of_number)
}

/// The largest depth.
pub(super) const DEEPEST: u32 = 48;

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

    /// How many values of the program are right quantities, in the first scene.
    #[must_use]
    pub fn recognised(&self, changes: &[Change]) -> usize {
        let observed = self.observe(changes, 0..1);
        let is_right =
            |seen: &&Observed| !seen.values.is_constant() && self.recognise(seen.stage, &seen.values).is_some();
        observed.iter().filter(is_right).count()
    }

    /// Observes all expressions in some scenes.
    #[must_use]
    pub fn observe(&self, changes: &[Change], scenes: std::ops::Range<usize>) -> Vec<Observed> {
        let exprs = STAGES.map(|stage| self.runner.program.numbers(stage));
        let found = observe(self.runner, changes, scenes, [&exprs[0], &exprs[1]]);
        let mut counts = BTreeMap::<(Stage, ExprId), usize>::new();
        found.iter().for_each(|seen| *counts.entry((seen.stage, seen.expr)).or_default() += 1);
        let observed = found.into_iter().map(|seen| {
            let occurrence = (counts[&(seen.stage, seen.expr)] > 1).then_some(seen.occurrence);
            let is_assignment = is_assignment(self.runner.program.text(seen.stage, seen.expr));
            Observed {
                stage: seen.stage,
                expr: seen.expr,
                occurrence,
                values: seen.values,
                is: None,
                is_assignment,
                defined_at: None,
                depth: 0,
            }
        });
        observed.collect()
    }

    /// Recognises the right quantities among the values, and counts how far the others are from them.
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
        let tokens: Vec<(u32, u32)> = observed.iter().map(|seen| self.tokens(seen)).collect();
        let is_given: Vec<bool> = (observed.iter())
            .map(|seen| !seen.is_assignment && (right(seen) || self.is_input(seen) || self.is_literal(seen)))
            .collect();
        let is_read: Vec<bool> = observed.iter().map(|seen| is_name(self.text(seen))).collect();
        let calls: Vec<Option<String>> = observed.iter().map(|seen| self.called(seen)).collect();
        // Where the value of a name or of a call was computed.
        let definition = |at: usize, observed: &[Observed]| -> Option<usize> {
            let seen = &observed[at];
            let computed = |of: &usize| !is_read[*of] && *of != at;
            if let Some(function) = &calls[at] {
                return (0..observed.len()).filter(computed).find(|of| {
                    let other = &observed[*of];
                    let source = &self.runner.program.stage(other.stage).source.expressions[other.expr.0 as usize];
                    other.stage == seen.stage
                        && source.function.as_ref() == Some(function)
                        && other.values.is_same(&seen.values)
                });
            }
            let here = (0..observed.len()).filter(computed).filter(|of| {
                let other = &observed[*of];
                other.stage == seen.stage
                    && tokens[*of].1 < tokens[at].0
                    && other.values.covers(&seen.values)
                    && other.values.is_same(&seen.values)
            });
            let argument = || {
                (0..observed.len()).filter(computed).find(|of| {
                    let other = &observed[*of];
                    other.stage == seen.stage && other.values.covers(&seen.values) && other.values.is_same(&seen.values)
                })
            };
            let varying = || {
                (0..observed.len()).filter(computed).find(|of| {
                    let other = &observed[*of];
                    other.stage == Stage::Vertex
                        && seen.stage == Stage::Fragment
                        && other.values.size == seen.values.size
                        && interpolated(&other.values, self.runner.samples).is_same(&seen.values)
                })
            };
            // Assigned in a branch, where the other has another value.
            let in_branch = || {
                (0..observed.len()).filter(computed).rfind(|of| {
                    let other = &observed[*of];
                    other.stage == seen.stage
                        && tokens[*of].1 < tokens[at].0
                        && !other.values.is_constant()
                        && other.values.is_same(&seen.values)
                })
            };
            here.last().or_else(argument).or_else(varying).or_else(in_branch)
        };
        let reads: Vec<Option<usize>> = (0..observed.len())
            .map(|at| {
                // A constant may be a right one by chance.
                let is_set = || observed[at].values.is_constant() && !self.is_input(&observed[at]);
                let is_defined = (is_read[at] || calls[at].is_some()) && (!is_given[at] || is_set());
                is_defined.then(|| definition(at, observed)).flatten()
            })
            .collect();
        for (seen, of) in observed.iter_mut().zip(&reads) {
            seen.defined_at = *of;
        }
        let is_inside = |inner: usize, outer: usize| {
            observed[inner].stage == observed[outer].stage
                && tokens[inner].0 >= tokens[outer].0
                && tokens[inner].1 <= tokens[outer].1
                && tokens[inner] != tokens[outer]
        };
        // The parts of a right value may be anything.
        let parts: Vec<Vec<usize>> = (0..observed.len())
            .map(|at| {
                let inside = || (0..observed.len()).filter(|inner| !is_given[at] && is_inside(*inner, at));
                let right: Vec<usize> = inside().filter(|inner| right(&observed[*inner])).collect();
                inside().filter(|inner| !right.iter().any(|outer| is_inside(*inner, *outer))).collect()
            })
            .collect();
        // A matrix, a column of a given one, or a vector with a fourth component, is a step on the way to a quantity.
        let is_column = |seen: &Observed| {
            let is_of_index = |c: char| c.is_ascii_alphanumeric() || "[]. ".contains(c);
            self.text(seen).split_once('[').is_some_and(|(matrix, index)| {
                self.runner.program.is_input(seen.stage, matrix.trim()) && index.chars().all(is_of_index)
            })
        };
        let is_step: Vec<bool> = (observed.iter().zip(&reads))
            .map(|(seen, reads)| (![1, 3].contains(&seen.values.size) || is_column(seen)) && reads.is_none())
            .collect();
        for _ in 0..DEEPEST {
            let mut is_changed = false;
            for at in (0..observed.len()).filter(|at| !is_given[*at]) {
                let depth = match reads[at] {
                    Some(of) => observed[of].depth + 1,
                    None => {
                        let whole = parts[at].iter().filter(|part| !is_step[**part]);
                        1 + whole.map(|part| observed[*part].depth).max().unwrap_or(0)
                    }
                };
                let depth = depth.min(DEEPEST);
                is_changed |= observed[at].depth != depth;
                observed[at].depth = depth;
            }
            if !is_changed {
                break;
            }
        }
    }

    /// The student's function that an expression calls.
    fn called(&self, seen: &Observed) -> Option<String> {
        let text = self.text(seen);
        let name: String = text.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
        let is_call = text[name.len()..].trim_start().starts_with('(') && text.ends_with(')');
        let expressions = &self.runner.program.stage(seen.stage).source.expressions;
        let is_own = || expressions.iter().any(|expression| expression.function.as_deref() == Some(name.as_str()));
        (is_call && is_own()).then_some(name)
    }

    /// The student's function that an expression is in.
    pub(super) fn function(&self, seen: &Observed) -> Option<&str> {
        let source = &self.runner.program.stage(seen.stage).source.expressions[seen.expr.0 as usize];
        source.function.as_deref()
    }

    /// Functions that read no input and are evaluated more than once, such as a square or a length.
    pub(super) fn helpers(&self, observed: &[Observed]) -> BTreeMap<&str, Evaluations> {
        let mut found = BTreeMap::new();
        for seen in observed {
            let (Some(name), Some(occurrence @ 1..)) = (self.function(seen), seen.occurrence) else { continue };
            let evaluations = if occurrence > 1 { Evaluations::Many } else { Evaluations::Several };
            let known = found.entry(name).or_insert(evaluations);
            *known = evaluations.max(*known);
        }
        for reading in observed.iter().filter(|seen| self.is_input(seen)) {
            if let Some(name) = self.function(reading) {
                found.remove(name);
            }
        }
        found
    }

    /// The text of an expression.
    pub(super) fn text(&self, seen: &Observed) -> &str {
        self.runner.program.text(seen.stage, seen.expr)
    }

    pub(super) fn tokens(&self, seen: &Observed) -> (u32, u32) {
        let tokens = self.runner.program.stage(seen.stage).source.expressions[seen.expr.0 as usize].tokens;
        (tokens.first, tokens.last)
    }

    /// Whether an expression is another one or a part of it.
    pub(super) fn is_within(&self, inner: &Observed, outer: &Observed) -> bool {
        let ((start, end), (first, last)) = (self.tokens(inner), self.tokens(outer));
        inner.stage == outer.stage && start >= first && end <= last
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

    /// Whether it is a number, or computed from numbers alone: `1.0 / 2.2`.
    pub(super) fn is_literal(&self, seen: &Observed) -> bool {
        let text = self.text(seen);
        let is_formula = || {
            let is_of_number = |c: char| c.is_ascii_digit() || " .+-*/()fF".contains(c);
            text.starts_with(|c: char| c.is_ascii_digit() || "-.(".contains(c)) && text.chars().all(is_of_number)
        };
        is_formula()
            || text.starts_with(|c: char| c.is_ascii_digit() || c == '.') && text.parse::<f32>().is_ok()
            || text.strip_suffix(['f', 'F']).is_some_and(|number| number.parse::<f32>().is_ok())
    }

    /// Whether it is a written zero, from which sums start: `vec3(0.0)`.
    pub(super) fn is_zero(&self, seen: &Observed) -> bool {
        let is_of_zero = |c: char| "vec234 0.,()fF".contains(c);
        seen.values.numbers.iter().all(|x| *x == 0.0 || x.is_nan()) && self.text(seen).chars().all(is_of_zero)
    }

    /// Whether it reads an attribute or a uniform, which are never wrong themselves.
    pub(super) fn is_input(&self, seen: &Observed) -> bool {
        self.runner.program.is_input(seen.stage, self.text(seen))
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
