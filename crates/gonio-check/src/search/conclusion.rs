//! Derives the verdict from the result of the search.

use super::compare::Comparison;
use super::parameterisation::Parameterisation;
use super::ranking::{Found, Search, SearchEntry, Tried};
use super::task::Task;
use crate::mistakes::Hypothesis;
use crate::roles::Bindings;
use crate::testbench::{Atlas, Testbench};
use crate::verdict::{
    BoundVariable, FoundMistake, Outcome, Peculiarity, RunnerUp, SceneVerdict, TermState, TermVerdict, Verdict,
};

/// The highest score of a wrong answer, however many scenes are right.
const MOST_FOR_WRONG: f64 = 0.9;
/// Least share of a runner-up that is reported.
const RUNNER_UP_FROM: f64 = 0.25;
/// Least share of the difference that a named mistake explains, if some of the difference remains.
const NAMED_FROM: f64 = 0.985;
/// A named mistake explains more than the next best one, by this share.
const CLEARER_BY: f64 = 0.01;

/// Returns the variables and their roles for the verdict.
pub fn bound(bindings: &Bindings) -> Vec<BoundVariable> {
    let known = bindings.bound.iter().map(|b| (&b.declared, Some(b.role.to_string())));
    let unknown = bindings.unknown.iter().map(|declared| (declared, None));
    known
        .chain(unknown)
        .map(|(declared, role)| BoundVariable {
            name: declared.name.clone(),
            glsl_type: declared.glsl_type.clone(),
            role,
        })
        .collect()
}

/// Returns the uniforms with values from `names.toml`.
pub fn fixed(bindings: &Bindings) -> Vec<(String, Vec<f32>)> {
    bindings.fixed.iter().map(|fixed| (fixed.declared.name.clone(), fixed.values.clone())).collect()
}

/// Finds a mistake of the catalogue, or a structural one, by its id.
pub fn mistake(id: &str, share: f64) -> Option<FoundMistake> {
    if let Some(known) = crate::mistakes::find(id) {
        return Some(FoundMistake { lab_does_it: known.lab_does_it, ..FoundMistake::from_catalogue(known, share) });
    }
    crate::mistakes::structural()
        .into_iter()
        .find(|known| known.id == id)
        .map(|known| FoundMistake::from_catalogue(&known, share))
}

/// Returns the verdict without the bound variables.
pub fn verdict(
    task: &Task,
    search: &Search<'_>,
    found: &Found<'_>,
    comparison: &Comparison,
    unused_terms: [bool; 3],
) -> Verdict {
    let (testbench, seen) = (search.testbench, search.seen);
    let mut verdict = Verdict::new(task.exercise, Outcome::Wrong, "");
    verdict.scenes = scenes(testbench, comparison);
    let Some(best) = found.ranking.first() else { return verdict };
    let entry = search.entries.get(best.model);
    let right = verdict.scenes.iter().filter(|scene| scene.right).count();
    verdict.score = (right as f64 / verdict.scenes.len().max(1) as f64).min(MOST_FOR_WRONG);
    let undefined = undefined_pixels(seen);
    if undefined > 0 {
        verdict.warnings.push(format!(
            "{undefined} pixels are NaN or infinite: look for a division by 0, or a square root or power of a negative number"
        ));
    }
    let next = found.ranking.iter().skip(1).find(|tried| !tried.wrong().is_empty());
    let names_well = best.residual.is_same()
        || (best.explained >= NAMED_FROM && next.is_none_or(|next| best.explained - next.explained >= CLEARER_BY));
    let words: Vec<String> = entry.and_then(|entry| entry.word).map(str::to_owned).into_iter().collect();
    let missing = missing_terms(task, best, unused_terms);
    let is_right = best.residual.is_same() && words.is_empty() && best.wrong().is_empty();
    if is_right && missing.is_empty() {
        verdict.verdict = Outcome::Correct;
        verdict.score = 1.0;
        verdict.peculiarities = peculiarities(task, best, entry);
        verdict.summary = match verdict.peculiarities.is_empty() {
            true => "right in every scene".to_owned(),
            false => "right in every scene, by another method".to_owned(),
        };
        return verdict;
    }
    // No name would explain the difference, so the verdict only lists the scenes that differ.
    if !names_well {
        let wrong: Vec<&str> = verdict.scenes.iter().filter(|s| !s.right).map(|s| s.scene.as_str()).collect();
        verdict.summary =
            format!("no known mistake explains the difference from the reference in: {}", wrong.join(", "));
        if !best.wrong().is_empty() && best.explained >= RUNNER_UP_FROM {
            let ids = best.wrong().into_iter().map(str::to_owned).collect();
            verdict.runner_up = Some(RunnerUp { ids, share_explained: best.explained });
        }
        return verdict;
    }
    let share = if best.residual.is_same() { 1.0 } else { best.explained };
    let ids: Vec<String> =
        words.into_iter().chain(best.wrong().into_iter().map(str::to_owned)).chain(missing).collect();
    verdict.mistakes = ids.iter().filter_map(|id| mistake(id, share)).collect();
    verdict.peculiarities = peculiarities(task, best, entry);
    for mistake in &mut verdict.mistakes {
        mistake.or = crate::mistakes::find(&mistake.id).map_or(Vec::new(), |known| known.looks_the_same_as.clone());
    }
    let count = verdict.mistakes.len();
    for mistake in verdict.mistakes.iter_mut().filter(|_| best.wrong().len() == count) {
        for other in alternatives(found, best, &mistake.id) {
            if !mistake.or.contains(&other) {
                mistake.or.push(other);
            }
        }
    }
    let not_the_same =
        |tried: &&Tried<'_>| !tried.wrong().is_empty() && tried.wrong() != best.wrong() && !tried.residual.is_same();
    let next = found.ranking.iter().find(not_the_same).filter(|tried| tried.explained >= RUNNER_UP_FROM);
    verdict.runner_up = next.map(|tried| RunnerUp {
        ids: tried.wrong().into_iter().map(str::to_owned).collect(),
        share_explained: tried.explained,
    });
    verdict.summary = verdict.mistake_names();
    verdict
}

fn undefined_pixels(seen: &Atlas) -> usize {
    seen.pixels.iter().filter(|p| Atlas::is_drawn(p) && p.iter().take(3).any(|c| !c.is_finite())).count()
}

fn peculiarities(task: &Task, best: &Tried<'_>, entry: Option<&SearchEntry>) -> Vec<Peculiarity> {
    let harmless = best.mistakes.iter().filter(|m| m.harmless);
    let mut all: Vec<Peculiarity> = harmless.map(|m| Peculiarity { id: m.id.clone(), name: m.name.clone() }).collect();
    if entry.is_some_and(|entry| entry.is_right && entry.model != task.model) {
        let name = "The light is computed for each vertex (Gouraud shading)".to_owned();
        all.push(Peculiarity { id: "light-per-vertex".to_owned(), name });
    }
    // Terms of later exercises are not wrong; diffuse light beside a highlight is usual.
    const AHEAD: [(usize, &str, &str); 2] = [
        (0, "ambient-added", "Ambient light is added, which the exercise does not ask for"),
        (2, "specular-added", "A highlight is added, which the exercise does not ask for"),
    ];
    for (term, id, name) in AHEAD {
        let is_there = best.strengths[term].is_some_and(|strength| strength.iter().any(|s| *s > 1e-2));
        if is_there && !task.required[term] {
            all.push(Peculiarity { id: id.to_owned(), name: name.to_owned() });
        }
    }
    all
}

/// Returns the terms without strength that the exercise asks for or the source computes but never uses.
fn missing_terms(task: &Task, best: &Tried<'_>, unused_terms: [bool; 3]) -> Vec<String> {
    const WORDS: [&str; 3] = ["ambient-missing", "diffuse-missing", "specular-missing"];
    let absent = |strength: &Option<[f64; 3]>| strength.is_some_and(|s| s.iter().all(|s| *s < 1e-3));
    // Ambient light in the place of diffuse light is diffuse light without its cosine.
    let flat = !task.required[0] && best.strengths[0].is_some_and(|s| s.iter().any(|s| *s > 1e-2));
    let word = |term: usize| if term == 1 && flat { "diffuse-without-cosine" } else { WORDS[term] };
    (0..3)
        .filter(|&term| absent(&best.strengths[term]))
        .filter(|&term| task.required[term] || unused_terms[term])
        .map(|term| word(term).to_owned())
        .filter(|word| !best.wrong().contains(&word.as_str()))
        .collect()
}

/// Returns the mistakes that leave an equally small residual in the place of this one: no picture distinguishes them.
fn alternatives(found: &Found<'_>, best: &Tried<'_>, id: &str) -> Vec<String> {
    let others: Vec<&str> = best.wrong().into_iter().filter(|other| *other != id).collect();
    let same = |tried: &&Tried<'_>| {
        tried.residual.is_same() && tried.model == best.model && tried.wrong().len() == others.len() + 1
    };
    let mut names: Vec<String> = Vec::new();
    for tried in found.ranking.iter().filter(same) {
        let mut wrong = tried.wrong();
        for other in &others {
            if let Some(at) = wrong.iter().position(|word| word == other) {
                wrong.remove(at);
            }
        }
        if let [only] = wrong[..]
            && only != id
            && !names.iter().any(|known| known == only)
        {
            names.push(only.to_owned());
        }
    }
    names
}

/// Returns the verdicts on test scenes; `comparison` compares with the right answer.
fn scenes(testbench: &Testbench, comparison: &Comparison) -> Vec<SceneVerdict> {
    testbench
        .test_scenes()
        .iter()
        .take(comparison.beyond.len())
        .enumerate()
        .map(|(index, test_scene)| SceneVerdict {
            scene: test_scene.name.clone(),
            shows: test_scene.shows.into(),
            right: comparison.agrees(index),
            pixels_beyond: comparison.beyond.get(index).copied().unwrap_or(1.0),
            worst: comparison.worst.get(index).copied().unwrap_or(1.0),
        })
        .collect()
}

/// Returns the verdicts on terms by the test scenes with one term alone; `comparison` compares with the right
/// answer in all test scenes.
pub fn terms(
    testbench: &Testbench,
    parameterisation: &Parameterisation,
    comparison: Option<&Comparison>,
) -> Vec<TermVerdict> {
    crate::mistakes::TERMS
        .into_iter()
        .enumerate()
        .map(|(index, term)| {
            let is_alone = |name: &str| name.ends_with(&format!("{term} alone"));
            let mut alone = testbench.test_scenes().iter().enumerate().filter(|(_, s)| is_alone(&s.name));
            let state = match comparison.filter(|_| !parameterisation.to_find[index]) {
                None => TermState::NotSeparable,
                Some(comparison) if alone.all(|(test_scene, _)| comparison.agrees(test_scene)) => TermState::Right,
                Some(_) => TermState::Wrong,
            };
            TermVerdict { term: term.into(), state }
        })
        .collect()
}

/// Returns the right answer that a verdict compares a program with: the index of the model solution in the search,
/// and its peculiarities.
///
/// If a mistake explains the program, this is the program without that mistake, not the nearest right answer: to a
/// program without its highlight, the nearest one has normals so short that no highlight shows, and then the diffuse
/// term would differ.
pub(super) fn right_answer(search: &Search<'_>, found: &Found<'_>) -> (usize, Hypothesis) {
    let nearest = (found.nearest_right.model, found.nearest_right.hypothesis.clone());
    let is_named = |explained: f64, is_same: bool| is_same || explained >= NAMED_FROM;
    let Some(best) = found.ranking.first().filter(|best| is_named(best.explained, best.residual.is_same())) else {
        return nearest;
    };
    let kind = search.entries[best.model].model;
    let is_right = search.entries[best.model].is_right;
    // The same with a base that only wrong answers have, if nothing shows that it is wrong.
    if best.wrong().is_empty() && (is_right || search.entries[best.model].word.is_none()) {
        return (best.model, best.hypothesis.clone());
    }
    let right = match is_right {
        true => Some(best.model),
        false => search.entries.iter().position(|entry| entry.is_right && entry.model == kind),
    };
    let Some(right) = right else { return (0, Hypothesis::default()) };
    let hypotheses = &search.models[right].hypotheses;
    let is_part = |single: &&Hypothesis| {
        let [mistake] = single.mistakes[..] else { return false };
        let is_made = best.hypothesis.mistakes.contains(&mistake) && hypotheses.mistakes[mistake].harmless;
        is_made && single.choices.iter().all(|(line, way)| best.hypothesis.choices.get(line) == Some(way))
    };
    let parts = hypotheses.singles.iter().filter(is_part);
    (right, parts.fold(Hypothesis::default(), |all, part| all.and(part).unwrap_or(all)))
}
