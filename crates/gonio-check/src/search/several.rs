//! Several mistakes at once: pairs by their pictures; three and more among those that the source shows, because pictures
//! alone cannot find them among a hundred.

use super::compare::Comparison;
use super::on_cpu::ComparisonDetail;
use super::ranking::{Difference, KEPT, Search, Support, Tried};
use crate::mistakes::Hypothesis;
use gonio_gl::GlError;

/// Most single mistakes that are combined with a second one.
const FIRSTS: usize = 14;
/// Least support by the source for a suspect.
const SUSPECTED_FROM: f32 = 0.9;
/// Most suspects. With more, the source is too different from the exercise's.
const MOST_SUSPECTS: usize = 12;
/// Most mistakes at once; no picture distinguishes more.
const MOST_AT_ONCE: usize = 6;
/// Least share of the remaining residual that an added mistake must explain.
const WORTH: f64 = 0.02;

impl<'a> Search<'a> {
    /// Tries pairs: for each of the best single mistakes, the one that explains most of its residual.
    pub(super) fn pairs(&self, difference: &Difference, singles: &[Tried<'a>]) -> Result<Vec<Tried<'a>>, GlError> {
        if self.models.iter().all(|model| model.hypotheses.model.is_of_places()) {
            return self.all_pairs(difference);
        }
        let mut firsts: Vec<&Tried<'a>> = Vec::new();
        let mut by_share: Vec<&Tried<'a>> = singles.iter().collect();
        by_share.sort_by(|a, b| b.best_share(&difference.full).total_cmp(&a.best_share(&difference.full)));
        // Those that explain most of the whole difference, and those that explain most of some test scene.
        for tried in singles.iter().take(4 * FIRSTS).zip(by_share).flat_map(|(a, b)| [a, b]) {
            // The variants of a mistake count separately, but not its peculiarities.
            let alone = self.without_peculiarities(tried);
            let known = firsts.iter().any(|o| o.model == tried.model && self.without_peculiarities(o) == alone);
            if !known && firsts.len() < FIRSTS {
                firsts.push(tried);
            }
        }
        let mut pairs = Vec::new();
        let mut seconds: Vec<Option<Vec<Hypothesis>>> = vec![None; self.models.len()];
        for first in firsts {
            let seconds = match &mut seconds[first.model] {
                Some(known) => &*known,
                unknown => &*unknown.insert(self.distinct(first.model, difference)?),
            };
            let alone = self.without_peculiarities(first);
            let mut best: Option<Tried<'a>> = None;
            let mut both: Vec<Hypothesis> = Vec::new();
            for second in seconds {
                // A peculiarity may be on the line of the second mistake, or be mistaken for it.
                for one in [&first.hypothesis, &alone] {
                    both.extend(one.and(second).filter(|way| !both.contains(way)));
                }
            }
            for mut tried in self.best_of(first.model, both, difference)? {
                // The residual of the first may be small compared with what it explains.
                let of_the_rest = first.residual.explained_by(&tried.residual);
                tried.explained = tried.explained.min(0.5 + 0.5 * of_the_rest).max(tried.explained * of_the_rest);
                if best.as_ref().is_none_or(|best| tried.order(best).is_lt()) {
                    best = Some(tried.clone());
                }
                if tried.residual.is_same() {
                    pairs.push(tried);
                }
            }
            let Some(best) = best else { continue };
            let again = self.pair_with_peculiarities(&best, difference)?;
            let is_named = best.residual.is_same();
            pairs.push(best);
            pairs.extend(again);
            if is_named {
                break;
            }
        }
        Ok(pairs)
    }

    /// Replaces each mistake of a pair without a residual by any other one. If the residual is as small, no picture
    /// distinguishes the two, and the verdict says so.
    pub(super) fn replacements(&self, pair: &Tried<'a>, difference: &Difference) -> Result<Vec<Tried<'a>>, GlError> {
        let model = pair.model;
        // This would take too long if the driver drew each.
        if self.comparers.get(model).and_then(Option::as_ref).is_none() {
            return Ok(Vec::new());
        }
        let is_part = |h: &&Hypothesis| {
            let is_chosen = |(line, way): (_, _)| pair.hypothesis.choices.get(line) == Some(way);
            h.mistakes.iter().all(|m| pair.hypothesis.mistakes.contains(m)) && h.choices.iter().all(is_chosen)
        };
        let peculiar = |h: &&Hypothesis| {
            let mistakes = &self.models[model].hypotheses.mistakes;
            is_part(h) && h.mistakes.iter().all(|&m| mistakes[m].harmless)
        };
        let set = self.models[model].hypotheses.singles.iter().filter(peculiar);
        let set = set.fold(Hypothesis::default(), |all, one| all.and(one).unwrap_or(all));
        let mut same = Vec::new();
        for part in self.wrong(model).filter(is_part) {
            let Some(first) = part.and(&set) else { continue };
            for other in self.wrong(model).filter(|h| !is_part(h) && h.mistakes != part.mistakes) {
                let Some(both) = first.and(other) else { continue };
                if self.attempt_in(model, both.clone(), difference, ComparisonDetail::Coarse)?.residual.is_same() {
                    let tried = self.attempt(model, both, difference)?;
                    same.extend(Some(tried).filter(|tried| tried.residual.is_same()));
                }
            }
        }
        Ok(same)
    }

    /// Tries all pairs of mistakes of the first model solution: if things are drawn elsewhere, a picture with one of
    /// two mistakes is no nearer to the picture with both.
    fn all_pairs(&self, difference: &Difference) -> Result<Vec<Tried<'a>>, GlError> {
        let singles: Vec<&Hypothesis> = self.wrong(0).collect();
        let later = |at: usize| singles.iter().skip(at + 1);
        let both = singles.iter().enumerate().flat_map(|(at, one)| {
            later(at).filter(|other| other.mistakes != one.mistakes).filter_map(|other| one.and(other))
        });
        // Rank them in one test scene.
        let first = difference.full.first(1);
        let at_a_glance = |both: Hypothesis| {
            let tried = self.drawn(0, both, 1)?;
            Ok(Tried { explained: first.explained_by(&tried.residual), ..tried })
        };
        let mut tried = both.map(at_a_glance).collect::<Result<Vec<Tried<'a>>, GlError>>()?;
        tried.sort_by(|a, b| a.order(b));
        tried.into_iter().take(KEPT).map(|tried| self.attempt(0, tried.hypothesis, difference)).collect()
    }

    fn pair_with_peculiarities(&self, pair: &Tried<'a>, difference: &Difference) -> Result<Vec<Tried<'a>>, GlError> {
        let mut again = Vec::new();
        if pair.residual.is_same() || pair.explained < 0.5 {
            return Ok(again);
        }
        for set in self.peculiar(pair.model).into_iter().skip(1) {
            if let Some(both) = pair.hypothesis.and(&set) {
                again.push(self.attempt(pair.model, both, difference)?);
            }
        }
        Ok(again)
    }

    /// Returns the single mistakes that show in this exercise, each picture once.
    fn distinct(&self, model: usize, difference: &Difference) -> Result<Vec<Hypothesis>, GlError> {
        // With fitted strengths, bad hypotheses all end without the term: their pictures are equal although the
        // mistakes are not.
        if self.model_inputs[model].must_find() {
            return Ok(self.wrong(model).cloned().collect());
        }
        let picture = |comparison: &Comparison| -> Vec<i64> {
            comparison.squares.iter().map(|square| (square * 1e7).round() as i64).collect()
        };
        // A mistake with the residual of the plain model solution does not show.
        let mut known = std::collections::BTreeSet::from([picture(&difference.coarse)]);
        let wrong = self.wrong(model).cloned();
        let tried: Vec<_> =
            wrong.map(|h| self.attempt_in(model, h, difference, ComparisonDetail::Coarse)).collect::<Result<_, _>>()?;
        Ok(tried.into_iter().filter(|t| known.insert(picture(&t.residual))).map(|t| t.hypothesis).collect())
    }

    /// Adds the mistakes that the source shows to each base, one by one, each time the one that explains most of the
    /// residual.
    pub(super) fn guided(
        &self,
        bases: &[(usize, Hypothesis)],
        difference: &Difference,
        support: Support<'_>,
    ) -> Result<Vec<Tried<'a>>, GlError> {
        let mut found: Vec<Tried<'a>> = Vec::new();
        for (model, base) in bases {
            let suspects: Vec<&Hypothesis> = self
                .wrong(*model)
                .filter(|one| self.ids(*model, one).all(|id| support(id, *model) >= SUSPECTED_FROM))
                .collect();
            if suspects.len() < 2 || suspects.len() > 3 * MOST_SUSPECTS {
                continue;
            }
            let mut best = self.attempt(*model, base.clone(), difference)?;
            for _ in 0..MOST_AT_ONCE {
                let with_one = suspects.iter().filter_map(|one| best.hypothesis.and(one)).collect();
                let Some(next) = self.best_of(*model, with_one, difference)?.into_iter().reduce(better) else { break };
                if best.residual.explained_by(&next.residual) < WORTH {
                    break;
                }
                best = next;
                if best.residual.is_same() {
                    break;
                }
            }
            let with_habits = self.pair_with_peculiarities(&best, difference)?;
            found.push(best);
            found.extend(with_habits);
            if found.iter().any(|tried| tried.residual.is_same()) {
                break;
            }
        }
        Ok(found)
    }

    fn ids(&self, model: usize, one: &Hypothesis) -> impl Iterator<Item = &'a str> {
        let mistakes = &self.models[model].hypotheses.mistakes;
        one.mistakes.iter().map(|&index| mistakes[index].id.as_str()).collect::<Vec<_>>().into_iter()
    }
}

fn better<'a>(one: Tried<'a>, other: Tried<'a>) -> Tried<'a> {
    if other.explained > one.explained { other } else { one }
}
