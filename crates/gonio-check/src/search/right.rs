//! The right answer that a verdict holds a program against: scenes and terms are compared with the same one.

use super::conclusion::NAMED_FROM;
use super::ranking::{Found, Search};
use crate::mistakes::Hypothesis;

/// The model's number among the search's, and what of it is peculiar.
///
/// Where a mistake explains the program, it is the program without that mistake. The right answer that is nearest would not
/// do: nothing is nearer to a program without its highlight than one whose normals are so short that none shows, and then
/// the diffuse term is the one that differs.
pub(super) fn answer(search: &Search<'_>, found: &Found<'_>) -> (usize, Hypothesis) {
    let nearest = (found.nearest_right.model, found.nearest_right.hypothesis.clone());
    let is_named = |explained: f64, is_same: bool| is_same || explained >= NAMED_FROM;
    let Some(best) = found.ranking.first().filter(|best| is_named(best.explained, best.residual.is_same())) else {
        return nearest;
    };
    let kind = search.entries[best.model].model;
    let is_right = search.entries[best.model].is_right;
    // Also in a way that only wrong answers take, where nothing shows that it is wrong.
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
