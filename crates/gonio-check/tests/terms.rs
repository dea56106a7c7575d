//! Terms, scenes, mistakes and the summary of a verdict never contradict one another.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_check::mistakes::{Hypotheses, TERMS, term_of};
use gonio_check::search::TASKS;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, TermState, Verdict};
use gonio_check::{CheckOptions, ShaderChecker, ShaderExercise};
use gonio_gl::HeadlessContext;
use submissions::submissions;

/// What contradicts itself in a verdict, in words.
fn contradictions(verdict: &Verdict) -> Vec<String> {
    let mut found = Vec::new();
    let state = |term: &str| verdict.terms.iter().find(|known| known.term == term).map(|known| known.state);
    let blamed: Vec<Option<&str>> = verdict.mistakes.iter().map(|mistake| term_of(&mistake.id)).collect();
    for (mistake, term) in verdict.mistakes.iter().zip(&blamed) {
        if term.is_some_and(|term| state(term) == Some(TermState::Right)) {
            found.push(format!("{} is named, and its term is right", mistake.id));
        }
    }
    let is_explained = verdict.mistakes.iter().all(|mistake| mistake.share_explained >= 1.0);
    if !blamed.is_empty() && is_explained && blamed.iter().all(Option::is_some) {
        let others = TERMS.into_iter().filter(|term| !blamed.contains(&Some(term)));
        let wrong = others.filter(|term| state(term) == Some(TermState::Wrong));
        found.extend(wrong.map(|term| format!("nothing is named of {term}, which is wrong")));
    }
    let is_correct = verdict.verdict == Outcome::Correct;
    let fails = verdict.terms.iter().any(|term| term.state == TermState::Wrong);
    if is_correct && (fails || verdict.scenes.iter().any(|scene| !scene.right) || !verdict.mistakes.is_empty()) {
        found.push("it is correct, and something is wrong".to_owned());
    }
    if !is_correct && verdict.summary.contains("right in every scene") {
        found.push("it is wrong, and right in every scene".to_owned());
    }
    if !is_correct && verdict.mistakes.iter().any(|m| m.share_explained > 0.0) && verdict.scenes.iter().all(|s| s.right)
    {
        found.push("a mistake is named, and all scenes are right".to_owned());
    }
    found
}

#[test]
fn no_mistake_of_the_bank_contradicts_the_terms() {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let mut checker = ShaderChecker::new(context.gl());
    let (mut checked, mut separable, mut named) = (0, 0, 0);
    let mut wrong = Vec::new();
    for task in TASKS.iter().filter(|task| task.model.is_lit()) {
        let hypotheses = Hypotheses::for_model(task.model);
        let mut seen = std::collections::BTreeSet::new();
        for single in hypotheses.singles.iter().filter(|single| seen.insert(single.mistakes.clone())) {
            let [vertex, fragment] = hypotheses.written(single);
            let files = vec![SourceFile::new("a.vert", vertex), SourceFile::new("a.frag", fragment)];
            let exercise = ShaderExercise::new(task.exercise);
            let (verdict, _) = gonio_check::check(&mut checker, &exercise, files, &CheckOptions::default()).unwrap();
            checked += 1;
            separable += usize::from(verdict.terms.iter().any(|term| term.state != TermState::NotSeparable));
            named += usize::from(!verdict.mistakes.is_empty());
            let id = &hypotheses.mistakes[single.mistakes[0]].id;
            wrong.extend(contradictions(&verdict).into_iter().map(|what| format!("{} {id}: {what}", task.exercise)));
        }
    }
    assert!(checked > 300 && separable > 200 && named > 200, "{checked} {separable} {named}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_submission_contradicts_itself() {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let mut checker = ShaderChecker::new(context.gl());
    let is_lit = |exercise: &str| TASKS.iter().any(|task| task.exercise == exercise && task.model.is_lit());
    let all = submissions("wrong").into_iter().filter(|s| is_lit(&s.exercise) && !s.name.contains("broken"));
    let (mut checked, mut wrong) = (0, Vec::new());
    // Every second one, and all of which a term is a part.
    let chosen = |(index, name): (usize, &str)| index % 2 == 0 || TERMS.iter().any(|term| name.contains(term));
    for (_, submission) in all.enumerate().filter(|(index, s)| chosen((*index, &s.name))) {
        let verdict = submission.check(&mut checker);
        checked += 1;
        wrong.extend(contradictions(&verdict).into_iter().map(|what| format!("{}: {what}", submission.name)));
    }
    assert!(checked > 100, "{checked}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
