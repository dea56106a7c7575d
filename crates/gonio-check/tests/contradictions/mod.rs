//! What one part of a verdict says against another.

use gonio_check::mistakes::{TERMS, term_of};
use gonio_check::verdict::{Outcome, TermState, Verdict};

/// Returns the contradictions in a verdict.
pub fn contradictions(verdict: &Verdict) -> Vec<String> {
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
