//! Names for proven repairs: the mistakes of the catalogue that assign the same wrong quantity to the same variable.

use super::model::{INPUTS, Quantity, TELLING};
use super::observed::{Observed, Observer, SCALED, SUMS, TERMS, has_space, is_name};
use super::program::Change;
use super::repair::{Make, Relation, Repair};
use super::right_change::RightChange;
use super::words;
use crate::mistakes::{Mistake, ModelSolution};
use crate::roles::{is_about, is_of_reflection};
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
        let function = |seen: &Observed| {
            self.runner.program.stage(seen.stage).source.expressions[seen.expr.0 as usize].function.as_deref()
        };
        // The result of a student's function is wrong where the function computes it.
        let is_call_of_another = |seen: &Observed| {
            proven.iter().map(|repair| &observed[repair.of]).any(|other| {
                let of = function(other).unwrap_or("main");
                let arguments = self.text(seen).strip_prefix(of).map(str::trim_start);
                other.stage == seen.stage
                    && arguments.is_some_and(|text| text.starts_with('('))
                    && other.values.is_same(&seen.values)
            })
        };
        // A factor that a right result lacks is missing at the call.
        let lacks_factor = |seen: &Observed, repair: &Repair| {
            let is_factor = |q: usize| {
                INPUTS.iter().any(|(name, ..)| {
                    let factor = self.model.right(name, seen.stage, false);
                    factor.is_some_and(|factor| seen.values.is_factor_of(factor, &self.model.quantities[q].values))
                })
            };
            seen.is_given() && (repair.relation == Relation::Factor || repair.quantity().is_some_and(is_factor))
        };
        // A vector that should have length 1 may have any length until the last variable is set to it.
        let is_of_length = |seen: &Observed, repair: &Repair| match repair.make {
            Make::Unit => true,
            Make::Quantity(q) => {
                let right = &self.model.quantities[q].values;
                seen.values.is_parallel(right, 1.0) && right.unit().is_same(right)
            }
            _ => false,
        };
        let set_last = |seen: &Observed, repair: &Repair| {
            if !is_of_length(seen, repair) {
                return None;
            }
            let is_it = |other: &&Observed| {
                other.stage == seen.stage
                    && self.runner.program.is_whole_value(other.stage, other.expr)
                    && other.values.is_same(&seen.values)
            };
            let all = proven.iter().map(|repair| &observed[repair.of]).filter(is_it);
            all.max_by_key(|other| self.tokens(other)).map(|last| last.expr)
        };
        // A right value that a variable of another meaning is set to: of two opposite vectors, the name tells the meaning.
        let is_copied = |seen: &Observed| {
            let (program, text) = (self.runner.program, self.text(seen));
            let Some(variable) = program.variable_set_to(seen.stage, seen.expr) else { return false };
            let is_opposite =
                text.strip_prefix('-').is_some_and(|text| is_name(text.trim_start())) && is_of_reflection(variable);
            let is_read = |repair: &Repair| {
                let other = &observed[repair.of];
                let is_other = self.text(other) != text && is_name(self.text(other));
                other.stage == seen.stage && is_other && other.values.is_same(&seen.values)
            };
            (is_name(text) || is_opposite) && proven.iter().any(is_read)
        };
        // A varying is wrong where the vertex shader computes it.
        let is_of_vertex = |seen: &Observed, repair: &Repair| {
            let of = |repair: &Repair| repair.quantity().map(|q| &self.model.quantities[q]);
            let Some(varying) = of(repair).filter(|q| seen.stage == Stage::Fragment && q.interpolated) else {
                return false;
            };
            let in_vertex = proven.iter().filter(|other| observed[other.of].stage == Stage::Vertex);
            is_name(self.text(seen)) && in_vertex.filter_map(of).any(|q| q.name == varying.name)
        };
        // Whether an argument is the same value, and as wrong.
        let is_passed = |seen: &Observed| {
            let Some(of) = function(seen) else { return false };
            let is_call = |call: &&Observed| {
                call.stage == seen.stage
                    && self.text(call).strip_prefix(of).is_some_and(|text| text.trim_start().starts_with('('))
            };
            observed.iter().filter(is_call).any(|call| {
                proven.iter().map(|repair| &observed[repair.of]).any(|other| {
                    self.is_within(other, call) && is_name(self.text(other)) && other.values.is_same(&seen.values)
                })
            })
        };
        // A wrong name is wrong where its value is computed; a right value of another kind where it is used.
        let is_elsewhere = |seen: &Observed, repair: &Repair| {
            if is_of_vertex(seen, repair) {
                return true;
            }
            if let Some(last) = set_last(seen, repair) {
                return seen.expr != last;
            }
            // A constant is wrong where it is computed.
            let is_constant = seen.values.is_constant() && !self.is_input(seen);
            if is_constant && !is_name(self.text(seen)) {
                return false;
            }
            let of_constant = is_constant && seen.defined_at.is_some();
            let is_name = is_name(self.text(seen));
            let is_of_kind = repair.quantity().is_none_or(|q| {
                let right = &self.model.quantities[q].values;
                let is_vector = seen.values.is_parallel(right, 1.0) || seen.values.is_parallel(right, -1.0);
                // A matrix is missing where the position on the screen is computed.
                let is_position = self.model.quantities[q].name == "gl_Position";
                is_vector || is_position || seen.values.is_clamped(right) || right.is_power_of(&seen.values)
            });
            // A value of the right kind is passed to a function where the function is called.
            if is_name && is_of_kind && is_passed(seen) {
                return true;
            }
            let is_use = seen.is_given() && !is_of_kind && !of_constant;
            if is_use && is_copied(seen) {
                return false;
            }
            is_use != is_name
                && proven.iter().map(|repair| &observed[repair.of]).any(|other| {
                    other.expr != seen.expr
                        && self::is_name(self.text(other)) != is_name
                        && (other.stage == seen.stage && other.values.is_same(&seen.values)
                            || is_name && seen.defined_at.is_some_and(|at| observed[at].expr == other.expr))
                })
        };
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
            let is_only_read = self.is_only_read(seen) && !self.runner.program.is_whole_value(seen.stage, seen.expr);
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
                is_computed_elsewhere: is_call_of_another(seen) && !lacks_factor(seen, &repair)
                    || is_elsewhere(seen, &repair),
                is_given: seen.is_given(),
                is_only_read,
                is_right_elsewhere,
                repair,
                also: Vec::new(),
                with,
                distance: names.first().map_or(u32::MAX, |(distance, _)| *distance),
                cost,
                mistakes: names.into_iter().map(|(_, mistake)| mistake).collect(),
            });
        }
        let in_main = |cause: &ProvenCause| {
            let source = &self.runner.program.stage(cause.stage).source.expressions[cause.expr.0 as usize];
            source.function.as_deref() == Some("main")
        };
        // A right value that is part of a wrong one.
        let wrong: Vec<(Stage, Span)> = (all.iter())
            .filter(|cause| !cause.is_given && cause.is_explained && cause.distance == 0)
            .map(|cause| (cause.stage, cause.span))
            .collect();
        // A right value that is computed from a wrong one, which makes it another quantity.
        let earlier: Vec<(Stage, ExprId, Span, Option<&str>)> = (all.iter())
            .filter(|cause| {
                !cause.is_given && cause.is_explained && cause.depth == 1 && cause.relation < Relation::Clamp
            })
            .map(|cause| (cause.stage, cause.expr, cause.span, function(&observed[cause.repair.of])))
            .collect();
        // A factor is missing where the other terms get it.
        let with_factor: Vec<(Stage, usize)> = (all.iter())
            .filter(|cause| !cause.is_given && cause.is_explained && cause.distance <= 1)
            .flat_map(|cause| {
                let of_factor = |q: &usize| {
                    let quantity = &self.model.quantities[*q];
                    observed.iter().any(|other| {
                        let is_inside = self.is_within(other, &observed[cause.repair.of]);
                        is_inside && is_name(self.text(other)) && other.is == Some(*q) && quantity.stage == cause.stage
                    })
                };
                (0..self.model.quantities.len()).filter(of_factor).map(|q| (cause.stage, q)).collect::<Vec<_>>()
            })
            .collect();
        let is_factor_of_later = |cause: &ProvenCause| match cause.make {
            Make::Times(q) => with_factor.contains(&(cause.stage, q)),
            // The same as another quantity.
            Make::Quantity(q) => {
                let (own, right) = (&observed[cause.repair.of].values, &self.model.quantities[q].values);
                let mut factors = with_factor.iter().filter(|(stage, _)| *stage == cause.stage);
                factors.any(|(_, factor)| own.is_factor_of(&self.model.quantities[*factor].values, right))
            }
            _ => false,
        };
        let rank = |cause: &ProvenCause| {
            let is_within = |(stage, span): &(Stage, Span)| {
                *stage == cause.stage && span.start <= cause.span.start && cause.span.end <= span.end
            };
            let unlikely = (cause.is_right_elsewhere, cause.is_computed_elsewhere);
            let name = (cause.mistakes.is_empty(), cause.distance.min(2), cause.relation);
            // A part of an expression that is the mistake itself, or a number within a formula.
            let is_number = cause.text.starts_with(|c: char| c.is_ascii_digit() || c == '.');
            let is_part = cause.distance > 0 && wrong.iter().any(is_within)
                || is_factor_of_later(cause)
                || is_number && !self.runner.program.is_set_in_vector_or_alone(cause.stage, cause.expr);
            let of = function(&observed[cause.repair.of]);
            let is_after = earlier.iter().any(|(at, expr, span, function)| {
                (*at, function) == (cause.stage, &of) && *expr < cause.expr && !is_within(&(*at, *span))
            });
            let is_of_length =
                cause.relation == Relation::Length && self.runner.program.is_whole_value(cause.stage, cause.expr);
            // A product with 1 has the value of an input, and is none.
            let is_product = observed[cause.repair.of].values.is_constant() && !is_name(&cause.text) && !is_number;
            let right = cause.repair.quantity().map(|q| &self.model.quantities[q]);
            let is_exchanged = cause.relation == Relation::Other && self.is_exchange(&observed[cause.repair.of], right);
            let lacks_colour = cause.relation == Relation::Factor && self.is_set_to_term(&observed[cause.repair.of]);
            let is_use = !is_of_length
                && !lacks_colour
                && !is_product
                && !is_exchanged
                && !is_copied(&observed[cause.repair.of])
                && cause.is_given
                && (cause.distance > 0 || is_after || wrong.iter().any(is_within));
            (
                !cause.is_explained,
                is_part,
                unlikely,
                is_use,
                cause.depth,
                name,
                !in_main(cause),
                cause.stage,
                cause.expr,
            )
        };
        all.sort_by_key(rank);
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
            for wrong in self.model.quantities.iter().filter(|q| q.stage == old.stage) {
                let Some(mistake) = wrong.mistake else { continue };
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
