//! Where a program makes the mistakes that explain its picture, if no repair proves a place: at the first expression that
//! has the wrong values of the mistake. Where it computes the light, if only the stage or a missing term is wrong.

use super::explanation::{Explanation, strengthen};
use super::model::Space;
use super::naming::is_of_no_term;
use super::observed::{SCALED, assignment, is_assignment, is_name, is_of_numbers};
use super::program::{Program, Runner};
use super::recording::{Recorded, STAGES, TELLING, observe};
use super::samples::SceneSamples;
use super::solutions::ModelSolutions;
use crate::comparison::Lights;
use crate::mistakes::{Hypotheses, Hypothesis, Mistake, ModelSolution, term_of};
use crate::roles::is_about;
use gonio_glsl::{Span, Stage};
use gonio_interpreter::{ExprId, SourceExpression};
use std::collections::BTreeSet;

/// The sum of all light, and what is put out of it.
const OUTPUTS: [&str; 4] = ["lit", "colour", "v_col", "FragColor"];

/// The sum of all terms, without the object's colour.
const SUM: &str = "lit";

/// What is computed from whole terms.
const OF_TERMS: [&str; 5] = ["diffuse_light", "specular_light", "lit", "colour", "FragColor"];

/// Mistakes with the half vector, which no variable of the model solutions holds.
const OF_HALF_VECTOR: [&str; 2] = ["half-vector-not-normalised", "half-vector-of-unequal-vectors"];

/// The mistake of putting out black where the light is behind the surface.
const WHERE_UNLIT: &str = "ambient-missing-where-unlit";

/// The attenuation.
const ATTENUATION: &str = "attenuation";

/// The position on the screen.
const POSITION: &str = "gl_Position";

/// A mistake with the place where the program makes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MistakePlace {
    /// The mistake.
    pub mistake: &'static Mistake,
    /// The stage.
    pub stage: Stage,
    /// The expression in its text.
    pub span: Span,
    /// Whether the expression has the value that the mistake assigns, and not one that is computed from it.
    pub is_direct: bool,
    /// Whether the expression computes the value or sets a variable to it, and does not only read it.
    pub is_computed: bool,
    /// Whether a variable is set to the value of another one.
    pub is_copy: bool,
    /// Whether the value is a right one of another quantity, or the opposite of one.
    pub is_given: bool,
    /// Whether the mistake is made in the sum of all terms, and in no other.
    pub is_sum: bool,
    /// Whether it is the place whatever is proven: the half vector, from which the value of the mistake is computed, a part of the
    /// attenuation's divisor, the sum that lacks the attenuation, or the vertex shader's vector that should not be interpolated.
    pub is_decisive: bool,
}

/// The wrong values of one of the mistakes of a hypothesis.
struct WrongValues {
    mistake: &'static Mistake,
    /// The variables that it assigns.
    variables: BTreeSet<String>,
}

/// The mistakes of a hypothesis with the lines that each of them changes.
fn mistakes_of(all: &Hypotheses, hypothesis: &Hypothesis) -> Vec<WrongValues> {
    let of_one = |index: &usize| {
        let is_part = |one: &&Hypothesis| {
            one.mistakes == [*index] && one.choices.iter().all(|(line, way)| hypothesis.choices.get(line) == Some(way))
        };
        let single = all.singles.iter().find(is_part)?;
        let mistake = all.mistakes[*index];
        let variables = single.choices.keys().map(|line| all.variables[*line].clone()).collect();
        (!mistake.harmless).then_some(WrongValues { mistake, variables })
    };
    hypothesis.mistakes.iter().filter_map(of_one).collect()
}

/// The values that a model solution assigns, with a hypothesis.
fn assigned(
    solutions: &ModelSolutions,
    (model, hypothesis): (ModelSolution, &Hypothesis),
    samples: &[SceneSamples],
    exponent: f32,
) -> Result<Vec<(String, Recorded)>, String> {
    let texts = solutions.hypotheses(model).written(hypothesis);
    let program = solutions.program(&texts, exponent)?;
    let runner = Runner::new(&program.program, samples);
    let exprs = program.exprs();
    let seen = observe(&runner, &[], 0..samples.len(), [&exprs[0], &exprs[1]]);
    let named = |seen: Recorded| Some((program.variable(seen.stage, seen.expr)?.to_owned(), seen));
    Ok(seen.into_iter().filter_map(named).collect())
}

/// The numbers or vectors that a model solution computes, by the count of their components, with a hypothesis.
fn of_size(
    size: usize,
    solutions: &ModelSolutions,
    (model, hypothesis): (ModelSolution, &Hypothesis),
    samples: &[SceneSamples],
    exponent: f32,
) -> Result<Vec<Recorded>, String> {
    let texts = solutions.hypotheses(model).written(hypothesis);
    let solution = solutions.program(&texts, exponent)?;
    let exprs = STAGES.map(|stage| solution.program.numbers(stage));
    let mut seen = observe(&Runner::new(&solution.program, samples), &[], 0..samples.len(), [&exprs[0], &exprs[1]]);
    seen.retain(|seen| seen.values.size == size);
    Ok(seen)
}

/// The expression that computes the last unit vector that only the model solution with the mistake has, the first of these two.
fn new_vector<'a>(
    program: &Program,
    observed: &'a [Recorded],
    [wrong, right]: [Result<Vec<Recorded>, String>; 2],
) -> Result<Option<&'a Recorded>, String> {
    let (wrong, right) = (wrong?, right?);
    let is_new = |one: &&Recorded| {
        let is_it = |other: &Recorded| other.stage == one.stage && other.values.is_same(&one.values);
        one.values.unit().is_same(&one.values) && !right.iter().any(is_it)
    };
    let Some(last) = wrong.iter().filter(is_new).max_by_key(|one| one.order) else { return Ok(None) };
    let is_it = |seen: &&Recorded| {
        let is_read = is_name(program.text(seen.stage, seen.expr));
        seen.stage == last.stage && !is_read && seen.values.is_same(&last.values)
    };
    let is_set = |seen: &&Recorded| program.is_whole_value(seen.stage, seen.expr);
    let all = || observed.iter().filter(is_it);
    Ok(all().filter(is_set).min_by_key(|seen| seen.order).or_else(|| all().min_by_key(|seen| seen.order)))
}

/// The first expression that computes a number that only the model solution with the mistake has, the first of these two.
fn new_number<'a>(
    program: &Program,
    observed: &'a [Recorded],
    [wrong, right]: [Result<Vec<Recorded>, String>; 2],
) -> Result<Option<&'a Recorded>, String> {
    let (wrong, right) = (wrong?, right?);
    let is_in = |all: &[Recorded], one: &Recorded| {
        all.iter().any(|other| other.stage == one.stage && other.values.is_same(&one.values))
    };
    let is_it = |seen: &&Recorded| {
        let is_read = is_name(program.text(seen.stage, seen.expr));
        !is_read && !seen.values.is_constant() && is_in(&wrong, seen) && !is_in(&right, seen)
    };
    Ok(observed.iter().filter(is_it).min_by_key(|seen| (seen.stage, seen.order)))
}

/// The first place of each mistake of an explanation, as far as the program shows one. What is missing for `certain` is missing in
/// the sum.
///
/// # Errors
/// The interpreter cannot run a model solution; a test ensures that it can.
pub(super) fn places(
    program: &Program,
    samples: &[SceneSamples],
    solutions: &ModelSolutions,
    explanation: &Explanation,
    (exponent, certain): (f32, Option<&str>),
) -> Result<Vec<MistakePlace>, String> {
    let given = &samples[..samples.len().min(TELLING)];
    let samples: Vec<SceneSamples> = given.iter().map(|samples| as_explained(samples, explanation)).collect();
    let model = explanation.method.model;
    let all = solutions.hypotheses(model);
    // With the light in view space, positions on the screen still come from M, V and P.
    let with_camera = |hypothesis: &Hypothesis| {
        let mut found = assigned(solutions, (model, hypothesis), &samples, exponent)?;
        if explanation.space == Space::View {
            let in_world = assigned(solutions, (model, hypothesis), given, exponent)?;
            found.retain(|(name, _)| name != POSITION);
            found.extend(in_world.into_iter().filter(|(name, _)| name == POSITION));
        }
        Ok::<_, String>(found)
    };
    let wrong = with_camera(&explanation.hypothesis)?;
    let exprs = STAGES.map(|stage| program.numbers(stage));
    let observed = observe(&Runner::new(program, given), &[], 0..given.len(), [&exprs[0], &exprs[1]]);
    let mut found: Vec<MistakePlace> = of_lights(program, explanation, &wrong, &observed).into_iter().collect();
    for WrongValues { mistake, variables } in mistakes_of(&all, &explanation.hypothesis) {
        // What would be right but for this mistake.
        let mut others = explanation.hypothesis.clone();
        others.choices.retain(|line, _| !variables.contains(&all.variables[*line]));
        let right = with_camera(&others)?;
        let is_right = |(name, seen): &(String, Recorded)| {
            let is_it = |(known, of): &&(String, Recorded)| known == name && of.stage == seen.stage;
            right.iter().find(is_it).is_some_and(|(_, of)| of.values.is_same(&seen.values))
        };
        let mut changed: Vec<&(String, Recorded)> = wrong.iter().filter(|one| !is_right(one)).collect();
        changed.sort_by_key(|(_, one)| (one.stage, one.order));
        let (direct, after): (Vec<_>, Vec<_>) = changed.into_iter().partition(|(name, _)| variables.contains(name));
        let first =
            |of: &[&(String, Recorded)]| of.iter().find_map(|(name, one)| first_with(program, &observed, name, one));
        // What is put out may be a right vector, which is computed earlier.
        let is_put_out = variables.iter().any(|name| OUTPUTS.contains(&name.as_str()));
        let all = || direct.iter().chain(&after).map(|(name, one)| (name.as_str(), one));
        // A term that is put out alone, or not attenuated, is right before.
        let is_right_elsewhere = direct.iter().any(|(name, of)| {
            let is_it = |(_, other): &(String, Recorded)| {
                other.stage == of.stage && other.values.factor_of(&of.values).is_some()
            };
            OF_TERMS.contains(&name.as_str()) && right.iter().any(is_it)
        });
        let is_sum = variables.contains(SUM) && !is_right_elsewhere;
        let put_out = is_put_out.then(|| output_with(program, &observed, all(), is_right_elsewhere)).flatten();
        let sum_without = (explanation.mistakes.len() > 1 && certain == Some(mistake.id.as_str()))
            .then(|| output_with(program, &observed, all(), true))
            .flatten();
        let constant = || {
            let of = |all: &[&(String, Recorded)]| {
                all.iter().find_map(|(_, one)| first_constant(program, &observed, one, &mistake.id))
            };
            of(&direct).or_else(|| of(&after)).map(|seen| (seen, true))
        };
        let of_direct = || first(&direct).map(|seen| (seen, true)).or_else(constant);
        let of_after = || first(&after).map(|seen| (seen, false));
        let both = |size: usize| {
            [&explanation.hypothesis, &others]
                .map(|hypothesis| of_size(size, solutions, (model, hypothesis), &samples, exponent))
        };
        let vector = match OF_HALF_VECTOR.contains(&mistake.id.as_str()) {
            true => new_vector(program, &observed, both(3))?,
            false => None,
        };
        // The sum of the divisor may be made in several lines.
        let part = match variables.len() == 1 && variables.contains(ATTENUATION) {
            true => new_number(program, &observed, both(1))?,
            false => None,
        };
        // A vector that is computed in the vertex shader, and then interpolated.
        let interpolated = || {
            let of_stage = |stage| direct.iter().filter(move |(_, one)| one.stage == stage);
            of_stage(Stage::Fragment).next()?;
            of_stage(Stage::Vertex).find_map(|(name, one)| first_with(program, &observed, name, one))
        };
        let branch = (mistake.id == WHERE_UNLIT).then(|| written_in_branch(program, &observed)).flatten();
        let decisive = vector.or(sum_without).or(branch).or(interpolated());
        let mut is_decisive = decisive.is_some();
        let place = decisive.or(put_out).map(|seen| (seen, true)).or_else(|| match is_right_elsewhere {
            true => of_after().or_else(of_direct),
            false => of_direct().or_else(of_after),
        });
        if let Some((mut seen, is_direct)) = place {
            let order = |seen: &Recorded| (seen.stage, seen.order);
            if let Some(part) = part.filter(|part| order(part) < order(seen)) {
                (seen, is_decisive) = (part, true);
            }
            let is_given = !seen.values.is_constant()
                && right.iter().any(|(_, of)| {
                    of.stage == seen.stage
                        && (of.values.is_same(&seen.values) || of.values.is_scaled(&seen.values, -1.0))
                });
            let of_term = || named_after_term(program, &observed, seen, &mistake.id);
            let seen = match is_given {
                true => last_copy(program, &observed, seen).or_else(of_term).unwrap_or(seen),
                false => seen,
            };
            let seen = caller_of_helper(program, &observed, seen).unwrap_or(seen);
            found.push(MistakePlace { is_sum, is_given, is_decisive, ..place_at(program, mistake, seen, is_direct) });
        }
    }
    Ok(found)
}

/// Where a program computes the sum of all light of a model solution with a hypothesis: in the stage where the model
/// computes the light, and in any.
///
/// # Errors
/// The interpreter cannot run a model solution; a test ensures that it can.
pub(super) fn of_light(
    program: &Program,
    samples: &[SceneSamples],
    solutions: &ModelSolutions,
    (model, hypothesis, exponent): (ModelSolution, &Hypothesis, f32),
) -> Result<[Option<(Stage, Span)>; 2], String> {
    let given = &samples[..samples.len().min(TELLING)];
    let put_out = assigned(solutions, (model, hypothesis), given, exponent)?;
    let exprs = STAGES.map(|stage| program.numbers(stage));
    let observed = observe(&Runner::new(program, given), &[], 0..given.len(), [&exprs[0], &exprs[1]]);
    let of_model = if model.is_per_vertex() { Stage::Vertex } else { Stage::Fragment };
    let last = |is_asked: &dyn Fn(Stage) -> bool| {
        let asked = put_out.iter().filter(|(_, of)| is_asked(of.stage)).map(|(name, of)| (name.as_str(), of));
        output_with(program, &observed, asked, true).map(|seen| (seen.stage, expression(program, seen).span))
    };
    Ok([last(&|stage| stage == of_model), last(&|_| true)])
}

/// Where a program adds up the light of several lights: the last assignment of a sum that lacks a light, or that has only
/// one. `wrong` are the values of the model solution with the mistakes, `observed` those of the program.
fn of_lights(
    program: &Program,
    explanation: &Explanation,
    wrong: &[(String, Recorded)],
    observed: &[Recorded],
) -> Option<MistakePlace> {
    let id = explanation.lights.mistake()?;
    let mistake = explanation.mistakes.iter().find(|mistake| mistake.id == id)?;
    let sums: Vec<&(String, Recorded)> =
        wrong.iter().filter(|(name, _)| ["lit", "colour"].contains(&name.as_str())).collect();
    let is_it = |seen: &&Recorded| sums.iter().any(|(name, of)| has(seen, name, of));
    let text = |seen: &&Recorded| program.text(seen.stage, seen.expr);
    let set = observed.iter().filter(|seen| is_assignment(text(seen))).filter(is_it);
    let others = observed.iter().filter(|seen| !is_name(text(seen))).filter(is_it);
    // The light of a function is added where the function is called.
    let calls = others.clone().filter(|seen| program.is_call(seen.stage, seen.expr));
    let by_order = |seen: &&Recorded| seen.order;
    // In a loop over the lights, what is set again is lost.
    let is_set_again =
        |seen: &&Recorded| seen.occurrence > 0 && assignment(text(seen)).is_some_and(|(_, by_operator)| !by_operator);
    if let (true, Some(last)) =
        (explanation.lights.is_last(), observed.iter().filter(is_set_again).max_by_key(by_order))
    {
        return Some(place_at(program, mistake, last, true));
    }
    let found = set.max_by_key(by_order).or_else(|| calls.max_by_key(by_order)).or_else(|| others.min_by_key(by_order));
    found.map(|seen| place_at(program, mistake, seen, true))
}

fn place_at(program: &Program, mistake: &'static Mistake, seen: &Recorded, is_direct: bool) -> MistakePlace {
    let is_read = is_name(program.text(seen.stage, seen.expr));
    let is_whole = program.is_whole_value(seen.stage, seen.expr);
    MistakePlace {
        mistake,
        stage: seen.stage,
        span: expression(program, seen).span,
        is_direct,
        is_computed: !is_read || is_whole,
        is_copy: is_read && is_whole,
        is_given: false,
        is_sum: false,
        is_decisive: false,
    }
}

/// Points of a scene as the model solution of an explanation sees them.
fn as_explained(samples: &SceneSamples, explanation: &Explanation) -> SceneSamples {
    let mut samples = samples.clone();
    if let (true, Some(other)) =
        (explanation.lights.is_last() || explanation.lights == Lights::WrongInSecond, samples.scene.other)
    {
        samples.scene.light = other;
    }
    strengthen(&explanation.strengths, &mut samples.scene);
    if explanation.space == Space::View {
        samples.scene = samples.scene.in_view_space();
    }
    samples
}

fn expression<'a>(program: &'a Program, seen: &Recorded) -> &'a SourceExpression {
    &program.stage(seen.stage).source.expressions[seen.expr.0 as usize]
}

/// Whether an expression has the values of a variable. A constant tells nothing.
fn has(seen: &Recorded, name: &str, of: &Recorded) -> bool {
    let is_same = match SCALED.contains(&name) {
        true => seen.values.factor_of(&of.values).is_some(),
        false => seen.values.is_same(&of.values),
    };
    seen.stage == of.stage && !seen.values.is_constant() && is_same
}

/// The first expression that gets the values of a variable when the program runs. Of multiples, the last one that is
/// computed: those before it lack a factor.
fn first_with<'a>(program: &Program, observed: &'a [Recorded], name: &str, of: &Recorded) -> Option<&'a Recorded> {
    let all: Vec<&Recorded> = observed.iter().filter(|seen| has(seen, name, of)).collect();
    let same = all.iter().copied().filter(|seen| seen.values.is_same(&of.values));
    let computed = all.iter().copied().filter(|seen| !is_name(program.text(seen.stage, seen.expr)));
    let last = || computed.max_by_key(|seen| seen.order).or_else(|| all.iter().copied().min_by_key(|seen| seen.order));
    // To read a variable is no mistake, to set another one to it may be.
    let is_read = |seen: &Recorded| {
        is_name(program.text(seen.stage, seen.expr)) && !program.is_whole_value(seen.stage, seen.expr)
    };
    same.min_by_key(|seen| (is_read(seen), seen.order)).or_else(last)
}

/// The last variable that is set to another one with these values.
fn last_copy<'a>(program: &Program, observed: &'a [Recorded], of: &Recorded) -> Option<&'a Recorded> {
    let is_copy = |seen: &&Recorded| {
        is_name(program.text(seen.stage, seen.expr)) && program.is_whole_value(seen.stage, seen.expr)
    };
    let is_same = |seen: &&Recorded| seen.stage == of.stage && seen.values.is_same(&of.values);
    observed.iter().filter(is_copy).filter(is_same).max_by_key(|seen| seen.order)
}

/// The call with the value of an expression in a function that computes values from its arguments alone, and is called often: the
/// function is right, and one of its calls wrong.
fn caller_of_helper<'a>(program: &Program, observed: &'a [Recorded], of: &Recorded) -> Option<&'a Recorded> {
    const OFTEN: usize = 3;
    let function = |stage: Stage, expr: ExprId| {
        let source = &program.stage(stage).source.expressions[expr.0 as usize];
        source.function.as_deref().filter(|name| *name != "main")
    };
    let name = function(of.stage, of.expr)?;
    let is_evaluated_often =
        observed.iter().filter(|seen| (seen.stage, seen.expr) == (of.stage, of.expr)).count() >= OFTEN;
    let mut within = program.numbers(of.stage).into_iter().filter(|expr| function(of.stage, *expr) == Some(name));
    if !is_evaluated_often || within.any(|expr| program.is_input(of.stage, program.text(of.stage, expr))) {
        return None;
    }
    let is_caller = |seen: &&Recorded| {
        seen.stage == of.stage
            && function(seen.stage, seen.expr) != Some(name)
            && program.is_call(seen.stage, seen.expr)
            && seen.values.is_same(&of.values)
    };
    observed.iter().filter(is_caller).min_by_key(|seen| seen.order)
}

/// The last expression with the same value that a variable is set to which is named after the term of a mistake.
fn named_after_term<'a>(program: &Program, observed: &'a [Recorded], of: &Recorded, id: &str) -> Option<&'a Recorded> {
    let term = term_of(id)?;
    let is_of_term = |seen: &&Recorded| {
        !is_name(program.text(seen.stage, seen.expr))
            && program.variable_set_to(seen.stage, seen.expr).is_some_and(|name| is_about(name, term))
    };
    let is_same = |seen: &&Recorded| seen.stage == of.stage && seen.values.is_same(&of.values);
    observed.iter().filter(is_of_term).filter(is_same).max_by_key(|seen| seen.order)
}

/// The number or vector of numbers that is put out at some points alone, or else where some points alone get ambient light.
fn written_in_branch<'a>(program: &Program, observed: &'a [Recorded]) -> Option<&'a Recorded> {
    let text = |seen: &Recorded| program.text(seen.stage, seen.expr);
    let is_in_branch = |seen: &&Recorded| {
        let present = &seen.values.present;
        seen.stage == Stage::Fragment && present.contains(&true) && present.contains(&false)
    };
    let is_number = |seen: &&Recorded| program.is_set_or_returned(seen.stage, seen.expr) && is_of_numbers(text(seen));
    let is_of_ambient = |seen: &&Recorded| is_assignment(text(seen)) && is_about(text(seen), "ambient");
    let all = || observed.iter().filter(is_in_branch);
    all().filter(is_number).max_by_key(|seen| seen.order).or_else(|| all().find(is_of_ambient))
}

/// The first expression that computes a constant, or the first number that a variable is set to. Many variables are 0 at first:
/// that is a mistake with a term only if the variable is named after it, and never set again.
fn first_constant<'a>(program: &Program, observed: &'a [Recorded], of: &Recorded, id: &str) -> Option<&'a Recorded> {
    let grey = of.values.grey();
    let is_zero = of.values.root_mean_square() == 0.0;
    let is_of_term = |seen: &Recorded| {
        let named = program.variable_set_to(seen.stage, seen.expr).zip(term_of(id));
        named.is_some_and(|(name, term)| {
            let all = program.numbers(seen.stage).into_iter();
            let is_set = |expr: &ExprId| program.variable_set_to(seen.stage, *expr) == Some(name);
            is_about(name, term) && all.filter(is_set).count() == 1
        })
    };
    let is_it = |seen: &&Recorded| {
        let text = program.text(seen.stage, seen.expr);
        let is_computed = text.contains('(') || program.is_set_or_returned(seen.stage, seen.expr) && !is_name(text);
        let is_same = || seen.values.is_same(&of.values) || grey.as_ref().is_some_and(|grey| seen.values.is_same(grey));
        seen.stage == of.stage
            && is_computed
            && seen.values.is_constant()
            && is_same()
            && (!is_zero || is_of_term(seen))
    };
    observed.iter().filter(is_it).min_by_key(|seen| seen.order)
}

/// The last expression that computes what is put out; the first if `is_last` is false. What a variable that is not a term is set
/// to comes before what only passes it on.
fn output_with<'a>(
    program: &Program,
    observed: &'a [Recorded],
    variables: impl Iterator<Item = (&'a str, &'a Recorded)>,
    is_last: bool,
) -> Option<&'a Recorded> {
    let outputs: Vec<(&str, &Recorded)> = variables.filter(|(name, _)| OUTPUTS.contains(name)).collect();
    // A function's value is computed in the function.
    let is_it = |seen: &&Recorded| {
        !is_name(program.text(seen.stage, seen.expr))
            && !program.is_call(seen.stage, seen.expr)
            && outputs.iter().any(|(name, of)| has(seen, name, of))
    };
    let all = observed.iter().filter(is_it);
    let is_of_sum = |seen: &&Recorded| {
        let named = program.named(seen.stage, seen.expr);
        named.is_some_and(|name| is_of_no_term(name) && !program.is_output(seen.stage, name))
    };
    match is_last {
        true => {
            let last = |seen: &&Recorded| (seen.stage, expression(program, seen).tokens.first);
            all.clone().filter(is_of_sum).max_by_key(last).or_else(|| all.max_by_key(last))
        }
        false => all.min_by_key(|seen| seen.order),
    }
}
