//! The parts of a verdict that pictures and roles give.

use super::compare::Comparison;
use super::parameterisation::Parameterisation;
use super::predict::Strengths;
use super::task::Task;
use crate::mistakes::Mistake;
use crate::roles::Bindings;
use crate::testbench::{Atlas, Testbench};
use crate::verdict::{BoundVariable, FoundMistake, Peculiarity, SceneVerdict, TermState, TermVerdict, Verdict};
use gonio_language::tr;

/// The highest score of a wrong answer, however many scenes are right.
pub(crate) const MOST_FOR_WRONG: f64 = 0.9;
/// Returns the variables and their roles for the verdict.
pub fn bound(bindings: &Bindings) -> Vec<BoundVariable> {
    // The last component of a vector that is 1, as usual, says nothing.
    let known = bindings.bound.iter().filter(|bound| !bindings.is_usual_last(bound));
    let known = known.map(|b| (&b.declared, Some(b.role.to_string())));
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
    let known = crate::mistakes::find(id)?;
    Some(FoundMistake { lab_does_it: known.lab_does_it, ..FoundMistake::from_catalogue(known, share) })
}

/// Warns of pixels without a number.
pub(crate) fn warn_of_undefined(verdict: &mut Verdict, seen: &Atlas) {
    let is_undefined = |p: &&[f32; 4]| Atlas::is_drawn(p) && p.iter().take(3).any(|c| !c.is_finite());
    let undefined = seen.pixels.iter().filter(is_undefined).count();
    if undefined > 0 {
        verdict.warnings.push(tr!("check-pixels-are-nan-or-infinite-look", undefined = undefined));
    }
}

/// The peculiarities of a right answer: the harmless ones of the catalogue, the other stage, and terms that the exercise
/// does not ask for.
pub(crate) fn peculiarities_of(
    task: &Task,
    mistakes: &[&Mistake],
    strengths: Strengths,
    is_other_model: bool,
) -> Vec<Peculiarity> {
    let harmless = mistakes.iter().filter(|m| m.harmless);
    let peculiarity = |m: &&Mistake| Peculiarity { id: m.id.clone(), name: m.texts().name.into_owned() };
    let mut all: Vec<Peculiarity> = harmless.map(peculiarity).collect();
    if is_other_model {
        let name = tr!("check-the-light-is-computed-for-each").to_owned();
        all.push(Peculiarity { id: "light-per-vertex".to_owned(), name });
    }
    // Terms of later exercises are not wrong; diffuse light beside a highlight is usual.
    const AHEAD: [(usize, &str, &str); 2] =
        [(0, "ambient-added", "check-ambient-added"), (2, "specular-added", "check-highlight-added")];
    for (term, id, name) in AHEAD {
        let is_there = strengths[term].is_some_and(|strength| strength.iter().any(|s| *s > 1e-2));
        if is_there && !task.required[term] {
            all.push(Peculiarity { id: id.to_owned(), name: tr!(name).to_owned() });
        }
    }
    all
}

/// Returns the verdicts on test scenes; `comparison` compares with the right answer.
pub(crate) fn scenes(testbench: &Testbench, comparison: &Comparison) -> Vec<SceneVerdict> {
    testbench
        .test_scenes()
        .iter()
        .take(comparison.beyond.len())
        .enumerate()
        .map(|(index, test_scene)| SceneVerdict {
            scene: test_scene.name.clone(),
            shows: test_scene.shows().into(),
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
