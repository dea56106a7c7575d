//! Draws a conclusion from several sets of roles that the inputs of a program may have.

use super::budget::Budget;
use super::diagnosing::Diagnosing;
use super::explain::{Singly, TriedModel};
use super::few_places::{is_black, is_flat};
use super::found::Found;
use super::methods::methods;
use super::target::{Agreement, Seen};
use super::{Diagnosis, DiagnosisDepth};
use gonio_threads::current_num_threads;
use gonio_threads::prelude::*;

/// What is tried with one set of roles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Attempt {
    /// Whether the program is right, and what is wrong otherwise.
    Whole,
    /// Whether it is right, or one mistake explains it.
    Single,
    /// Only whether it is right.
    Right,
    /// Only whether it is right with the direction of the sun turned round.
    Turned,
    /// Only whether it is right with a white material.
    White,
}

impl Attempt {
    /// Whether only right programs count.
    pub fn is_of_right(self) -> bool {
        matches!(self, Attempt::Right | Attempt::Turned | Attempt::White)
    }
}

/// The diagnosis with the first roles with which the program is right, or else with the first of some by which it is
/// explained.
pub(super) fn first_conclusion<'a>(
    all: impl Iterator<Item = (Diagnosing<'a>, Attempt)>,
    depth: DiagnosisDepth,
) -> Result<Diagnosis, String> {
    let (mut wrong, mut others) = (Vec::new(), Vec::new());
    let mut with_unused_terms = None;
    for (one, attempt) in all {
        let likely = one.may_be_right()?;
        if likely.is_empty() && attempt.is_of_right() {
            continue;
        }
        let Some(seen) = one.picture() else {
            // With another setting of a switch, a loop may not end.
            if attempt != Attempt::Whole {
                continue;
            }
            return Ok(one.diagnosis(Found::Endless, methods(one.task)[0]));
        };
        // Light differs from place to place. With open strengths, a picture without it is like any other, and a white one
        // like any that is too bright. With a white material, right pictures are white too.
        let has_shades = one.task.model.is_lit() && attempt != Attempt::White;
        let is_unlit = has_shades && (is_black(&seen) || is_flat(&seen));
        if is_unlit && attempt.is_of_right() {
            continue;
        }
        let right = if is_unlit { None } else { one.right(&seen, &likely)? };
        match right {
            // A switch may be off that turns the term on.
            Some(right) if right.unused_terms.contains(&true) => {
                with_unused_terms.get_or_insert(right);
                continue;
            }
            Some(right) => return Ok(right),
            None if attempt == Attempt::Whole && one.has_steps(&seen)? => {
                let right = Found::Right(Agreement { highlight: None, strengths: [None; 3] });
                return Ok(Diagnosis { has_steps: true, ..one.diagnosis(right, methods(one.task)[0]) });
            }
            None if one.task.model.is_lit() && attempt != Attempt::White => {
                if let Some(right) = right_without_limits(&one)? {
                    return Ok(Diagnosis { limits_colours: true, ..right });
                }
            }
            None => {}
        }
        match attempt {
            Attempt::Whole => wrong.push((one, seen)),
            Attempt::Single => others.push((one, seen)),
            Attempt::Right | Attempt::Turned | Attempt::White => {}
        }
    }
    if let Some(right) = with_unused_terms {
        return Ok(right);
    }
    if let (DiagnosisDepth::Right, Some((first, _))) = (depth, wrong.first()) {
        return Ok(first.diagnosis(Found::Nothing, methods(first.task)[0]));
    }
    let unknown = |one: &Diagnosing<'_>| one.program.bindings.unknown.len();
    let fewest = wrong.iter().map(|(one, _)| unknown(one)).min();
    // Without a light, which has no role, every picture is flat, and explained by a mistake that takes the light away.
    let may_be_flat = |one: &Diagnosing<'_>| fewest.is_none_or(|fewest| unknown(one) <= fewest);
    wrong.retain(|(one, seen)| may_be_flat(one) || !one.task.model.is_lit() || !is_black(seen) && !is_flat(seen));
    let budget = Budget::default();
    let mut unexplained = Vec::new();
    for (one, seen) in &wrong {
        match one.explaining(&one.scenes, &budget, |explainer| explainer.singly(seen))? {
            Singly::Explained(explanations) => return one.wrong(explanations),
            Singly::Unexplained(tried) => unexplained.push(tried),
        }
    }
    // A mistake may hide the space of the normals and of the light. With fewer known roles, most terms are black.
    others.retain(|(one, _)| fewest.is_none_or(|fewest| unknown(one) <= fewest));
    let left = budget.left();
    let singly = in_batches(&others, |(one, seen)| {
        let budget = Budget::part(left, others.len());
        one.explaining(&one.scenes, &budget, |explainer| explainer.singly(seen))
    });
    for (at, singly) in singly.enumerate() {
        match singly? {
            Singly::Explained(found) if !found.is_empty() => return others[at].0.wrong(found),
            Singly::Explained(_) => unexplained.push(Vec::new()),
            Singly::Unexplained(tried) => unexplained.push(tried),
        }
    }
    let all: Vec<_> = wrong.iter().chain(&others).zip(&unexplained).collect();
    let by_pairs = |((one, seen), tried): &(&(Diagnosing<'_>, Seen), &Vec<TriedModel>)| {
        one.explaining(&one.scenes, &Budget::default(), |explainer| explainer.by_pairs(tried, seen))
    };
    // The first alone: it is often the one.
    let (first, rest) = all.split_at(all.len().min(1));
    for (at, explanations) in in_batches(first, by_pairs).chain(in_batches(rest, by_pairs)).enumerate() {
        let explanations = explanations?;
        if !explanations.is_empty() {
            return all[at].0.0.wrong(explanations);
        }
    }
    let Some((first, _)) = wrong.first() else { return Err("no program".to_owned()) };
    first.wrong(Vec::new())
}

/// The diagnosis of a program that is right but for the limits that its vertex shader sets to colours.
fn right_without_limits(one: &Diagnosing<'_>) -> Result<Option<Diagnosis>, String> {
    let Some(seen) = one.without_limits().filter(|seen| !is_black(seen) && !is_flat(seen)) else { return Ok(None) };
    let lights = one.parameterisation.right_lights();
    let all = methods(one.task).into_iter().filter(|method| method.model.is_per_vertex());
    let likely: Vec<_> = all.flat_map(|method| lights.iter().map(move |lights| (method, *lights))).collect();
    one.right(&seen, &likely)
}

/// The results for all items in order, computed on all cores as far as they are asked for.
fn in_batches<T: Sync, R: Send>(items: &[T], of_one: impl Fn(&T) -> R + Sync) -> impl Iterator<Item = R> {
    items.chunks(current_num_threads()).flat_map(move |batch| batch.par_iter().map(&of_one).collect::<Vec<R>>())
}
