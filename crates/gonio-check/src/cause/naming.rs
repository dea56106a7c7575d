//! Names for proven repairs: the mistakes of the catalogue that assign the same wrong quantity to the same variable.

use super::model::{Quantity, TELLING};
use super::observed::{Observed, Observer, SCALED, SUMS, TERMS, assignment, is_name, is_of_numbers};
use super::program::Change;
use super::proven_cause::ProvenCause;
use super::ranking::Ranking;
use super::repair::{Make, Relation, Repair};
use super::right_change::RightChange;
use super::symptoms::Symptoms;
use super::words;
use crate::mistakes::{Mistake, ModelSolution};
use crate::roles::is_about;
use gonio_glsl::{Span, Stage};

/// Most proven repairs that are named.
const MOST_NAMED: usize = 40;
/// Most of them for one expression.
const MOST_OF_ONE: usize = 2;

/// Whether a right term is to be replaced by a sum: the sum is wrong, not the term.
fn is_term_for_sum(at: &Observer<'_>, seen: &Observed, repair: &Repair) -> bool {
    let name = |index: usize| at.model.quantities[index].name.as_str();
    let is_sum = |index: usize| SUMS.contains(&name(index));
    // In the object's colour, a term has three numbers.
    let is_coloured = || {
        let of_term = |q: &&Quantity| q.stage == seen.stage && q.mistake.is_none() && TERMS.contains(&q.name.as_str());
        let Some(colour) = at.model.right("materialColour", seen.stage, false) else { return false };
        let coloured = |term: &Quantity| {
            term.values.map(3, |point, from, to| {
                to.iter_mut().zip(colour.at(point)).for_each(|(to, channel)| *to = from[0] * channel);
            })
        };
        at.model.quantities.iter().filter(of_term).any(|term| seen.values.factor_of(&coloured(term)).is_some())
    };
    let is_term = seen.is.is_some_and(|is| TERMS.contains(&name(is))) || is_coloured();
    let named = at.runner.program.named(seen.stage, seen.expr);
    is_term && repair.quantity().is_some_and(is_sum) && !(named.is_some_and(is_of_no_term) && at.reads_a_term(seen))
}

/// Whether a name says nothing about a single term.
pub(super) fn is_of_no_term(name: &str) -> bool {
    !["ambient", "diffuse", "specular"].iter().any(|term| is_about(name, term))
}

impl Observer<'_> {
    /// Whether an expression is computed from a variable that a term was put into.
    fn reads_a_term(&self, seen: &Observed) -> bool {
        let program = self.runner.program;
        let (first, last) = self.tokens(seen);
        let expressions = &program.stage(seen.stage).source.expressions;
        program.numbers(seen.stage).into_iter().any(|expr| {
            let tokens = expressions[expr.0 as usize].tokens;
            let text = program.text(seen.stage, expr);
            tokens.first >= first && tokens.last <= last && is_name(text) && !is_of_no_term(text)
        })
    }

    /// Whether an expression is the only one that reads a variable.
    fn is_only_read(&self, seen: &Observed) -> bool {
        let (program, name) = (self.runner.program, self.text(seen));
        let all = program.numbers(seen.stage).into_iter();
        is_name(name) && all.filter(|expr| program.text(seen.stage, *expr) == name).count() == 1
    }

    /// The assignment by which a variable gets a wrong value, `x *= y`, if an expression reads that variable; with whether it
    /// had the right value before.
    fn compound_assignment(&self, observed: &[Observed], seen: &Observed, repair: &Repair) -> Option<(Span, bool)> {
        let (program, name) = (self.runner.program, self.text(seen));
        let right = &self.model.quantities[repair.quantity()?].values;
        let of_variable = || observed.iter().filter(|other| other.stage == seen.stage && other.expr < seen.expr);
        let is_compound = |other: &&Observed| {
            assignment(self.text(other)) == Some((name, true)) && other.values.is_same(&seen.values)
        };
        let had_right = |other: &Observed| {
            program.variable_set_to(other.stage, other.expr) == Some(name) && other.values.is_same(right)
        };
        let last = of_variable().filter(is_compound).max_by_key(|other| other.expr).filter(|_| is_name(name))?;
        let span = program.stage(seen.stage).source.expressions[last.expr.0 as usize].span;
        Some((span, of_variable().any(had_right)))
    }

    /// Whether an input stands where another one of its kind belongs, in what a variable is set to that is named after the
    /// other one.
    fn is_against_name(&self, observed: &[Observed], seen: &Observed, repair: &Repair) -> bool {
        let Some(right) = repair.quantity().map(|q| &self.model.quantities[q]) else { return false };
        let (meaning, other) = match right.name.as_str() {
            "u_view_pos" => ("view", "light"),
            "light_pos" => ("light", "view"),
            _ => return false,
        };
        let program = self.runner.program;
        let around = observed.iter().filter(|other| other.stage == seen.stage && self.is_within(seen, other));
        let mut names = around.filter_map(|around| program.variable_set_to(around.stage, around.expr));
        self.is_exchange(seen, Some(right)) && names.any(|name| is_about(name, meaning) && !is_about(name, other))
    }

    /// Names and orders proven repairs.
    /// Mistakes that explain the picture come first.
    pub(super) fn causes(
        &self,
        base: &[Change],
        observed: &[Observed],
        proven: &[Repair],
        explaining: &[&'static Mistake],
    ) -> Vec<ProvenCause> {
        let few = 0..self.runner.samples.len().min(TELLING);
        let before = self.observe(base, few.clone());
        let mut all = Vec::new();
        let symptoms = Symptoms { at: *self, observed, proven };
        let count_before = |at: usize| proven[..at].iter().filter(|other| other.of == proven[at].of).count();
        let named = (0..proven.len()).filter(|at| count_before(*at) < MOST_OF_ONE).take(MOST_NAMED);
        for repair in named.map(|at| proven[at].clone()) {
            let seen = &observed[repair.of];
            let mut changes = base.to_vec();
            changes.extend(repair.change(observed, self.model));
            let after = self.observe(&changes, few.clone());
            let mut names = self.names(&before, &after, seen);
            if names.is_empty() {
                names.extend(self.of_family(&before, &after, seen).and_then(crate::mistakes::find).map(|m| (4, m)));
            }
            let is_attenuation = repair.quantity().is_some_and(|q| self.model.quantities[q].name == "attenuation");
            if names.is_empty() && is_attenuation {
                names.extend(crate::mistakes::find("attenuation-other-formula").map(|mistake| (4, mistake)));
            }
            // A right exponent has another value.
            let is_exponent = repair.quantity().is_some_and(|q| self.model.quantities[q].name == "shininess");
            if names.is_empty() && is_exponent && !symptoms.is_symptom(seen, &repair) {
                names.extend(crate::mistakes::find("specular-exponent-wrong").map(|mistake| (4, mistake)));
            }
            let explains = |mistake: &Mistake| explaining.iter().any(|known| known.id == mistake.id);
            if names.is_empty() {
                let all = self.of_form(observed, seen, &repair);
                let chosen = all.iter().copied().find(|mistake| explains(mistake));
                names.extend(chosen.or(all.first().copied()).map(|mistake| (4, mistake)));
            }
            let is_explained = names.iter().any(|(_, mistake)| explains(mistake));
            if is_explained {
                names.retain(|(_, mistake)| explains(mistake));
            }
            let is = (self.model.quantities.iter())
                .filter(|q| q.stage == seen.stage && q.values.is_same(&seen.values))
                .max_by_key(|q| (q.mistake.is_none(), q.is_direct))
                .filter(|q| q.mistake.is_none())
                .map(words::quantity);
            let source = &self.runner.program.stage(seen.stage).source.expressions[seen.expr.0 as usize];
            let added = match repair.make {
                Make::Plus(other) => self.text(&observed[other]),
                _ => "",
            };
            let should = words::should_be(&repair, &self.model.quantities, added);
            let with = self.unnormalised(&repair, seen, proven);
            let is_right_elsewhere = is_term_for_sum(self, seen, &repair);
            let right = vec![RightChange::new(&repair, observed, self.model)];
            // A vector that is the last to be set without its length is where that belongs.
            let is_whole = self.runner.program.is_whole_value(seen.stage, seen.expr);
            let is_only_read = self.is_only_read(seen) && !is_whole;
            let compound = self.compound_assignment(observed, seen, &repair);
            let spoilt_at = compound.filter(|(_, had_right)| *had_right).map(|(span, _)| (seen.stage, span));
            let set_at = compound.filter(|_| repair.relation == Relation::Known).map(|(span, _)| (seen.stage, span));
            let is_against_name = self.is_against_name(observed, seen, &repair);
            let Repair { relation, make, cost, .. } = repair;
            let least = names.first().map_or(0, |(distance, _)| *distance);
            all.push(ProvenCause {
                stage: seen.stage,
                expr: seen.expr,
                span: source.span,
                text: self.text(seen).to_owned(),
                occurrence: seen.occurrence,
                make,
                added: if let Make::Plus(other) = make { Some(observed[other].expr) } else { None },
                right,
                equals: names.iter().skip(1).filter(|(distance, _)| *distance == least).count(),
                should,
                is,
                relation,
                depth: seen.depth,
                is_explained,
                is_computed_elsewhere: symptoms.is_symptom(seen, &repair),
                is_given: seen.is_given(),
                is_only_read,
                is_whole,
                spoilt_at,
                set_at,
                is_against_name,
                is_right_elsewhere,
                repair,
                also: Vec::new(),
                with,
                distance: names.first().map_or(u32::MAX, |(distance, _)| *distance),
                cost,
                mistakes: names.into_iter().map(|(_, mistake)| mistake).collect(),
            });
        }
        let ranking = Ranking::new(&symptoms, &all);
        all.sort_by_cached_key(|cause| ranking.rank(cause));
        all
    }

    /// The mistake with a parameter whose wrong values some expression has: a floor under the cosine, another exponent,
    /// light spread over both sides.
    fn of_family(&self, before: &[Observed], after: &[Observed], at: &Observed) -> Option<&'static str> {
        let right = |name: &str, stage: Stage| self.model.right(name, stage, false);
        before.iter().find_map(|old| {
            let is_it =
                |new: &&Observed| (new.stage, new.expr, new.occurrence) == (old.stage, old.expr, old.occurrence);
            let new = after.iter().find(is_it)?;
            if old.values.size != 1 || old.stage != at.stage || new.values.is_same(&old.values) {
                return None;
            }
            let least = old.values.numbers.iter().copied().filter(|x| x.is_finite()).fold(f32::INFINITY, f32::min);
            if let (Some(cosine), Some(dot)) = (right("cos_theta", old.stage), right("dot(N, L)", old.stage)) {
                let is_cosine = new.values.is_same(cosine);
                let floor = dot.map(1, |_, a, b| b[0] = a[0].max(least));
                if is_cosine && least > 1e-3 && old.values.is_same(&floor) {
                    return Some("diffuse-floor");
                }
                if is_cosine && old.values.is_affine_of(dot) {
                    return Some("diffuse-half-lambert");
                }
            }
            if let (Some(spec), Some(cosine)) = (right("spec", old.stage), right("cos_phi", old.stage))
                && new.values.is_same(spec)
                && old.values.is_power_of(cosine)
            {
                return Some("specular-exponent-wrong");
            }
            None
        })
    }

    /// The second mistake of a wrong normal that is not normalised either.
    fn unnormalised(&self, repair: &Repair, seen: &Observed, proven: &[Repair]) -> Option<&'static Mistake> {
        let is_unit = |is: usize| self.model.quantities[is].name == "N";
        let is_raw = self.model.quantities.iter().any(|q| {
            q.stage == seen.stage
                && q.name == "world_normal"
                && q.mistake.is_some()
                && q.is_direct
                && q.values.is_same(&seen.values)
                && !q.values.is_same(&q.values.unit())
        });
        let id = match (seen.stage, self.model.method.model) {
            (Stage::Vertex, ModelSolution::Gouraud | ModelSolution::WardPerVertex) => "normal-not-normalised-in-vertex",
            (Stage::Fragment, _) => "normal-not-renormalised",
            _ => return None,
        };
        let is_repaired_raw = proven.iter().any(|other| {
            let name = other.quantity().map(|is| self.model.quantities[is].name.as_str());
            other.of == repair.of && matches!(name, Some("world_normal" | "v_normal"))
        });
        (!is_repaired_raw && repair.quantity().is_some_and(is_unit) && is_raw)
            .then(|| crate::mistakes::find(id))
            .flatten()
    }

    /// The mistakes whose pair of quantities some expression has: the wrong one before the repair, the right one after
    /// it; with 0 if it is the expression itself and the mistake assigns to this quantity.
    fn names(&self, before: &[Observed], after: &[Observed], at: &Observed) -> Vec<(u32, &'static Mistake)> {
        let mut found: Vec<(u32, &'static Mistake)> = Vec::new();
        for old in before {
            let Some(new) = (after.iter())
                .find(|new| new.stage == old.stage && new.expr == old.expr && new.occurrence == old.occurrence)
            else {
                continue;
            };
            if new.values.is_same(&old.values) {
                continue;
            }
            // Where a branch puts out a number, a quantity may have this value by chance.
            let is_number = is_of_numbers(self.text(old));
            for wrong in self.model.quantities.iter().filter(|q| q.stage == old.stage) {
                let Some(mistake) = wrong.mistake.filter(|_| !is_number || wrong.values.is_constant()) else {
                    continue;
                };
                let factor = match SCALED.contains(&wrong.name.as_str()) {
                    true => old.values.factor_of(&wrong.values),
                    false => wrong.values.is_same(&old.values).then_some(1.0),
                };
                let Some(factor) = factor else { continue };
                let is_right = self.model.quantities.iter().any(|q| {
                    q.stage == old.stage
                        && q.mistake.is_none()
                        && (q.name == wrong.name && q.interpolated == wrong.interpolated
                            || wrong.name == "world_normal"
                                && wrong.is_direct
                                && ["N", "v_normal"].contains(&q.name.as_str()))
                        && q.space == wrong.space
                        && new.values.is_scaled(&q.values, factor)
                });
                if is_right {
                    let is_here = old.stage == at.stage && old.expr == at.expr;
                    let here = if is_here { 0 } else { 2 + old.expr.0.abs_diff(at.expr.0) };
                    found.push((here * 2 + u32::from(!wrong.is_direct), mistake));
                }
            }
        }
        found.sort_by_key(|(distance, _)| *distance);
        let mut names: Vec<(u32, &'static Mistake)> = Vec::new();
        for (distance, mistake) in found {
            if !names.iter().any(|(_, known)| known.id == mistake.id) {
                names.push((distance, mistake));
            }
        }
        names
    }
}
