//! Three mistakes and more at once: pictures alone cannot find them among a hundred, but the source says where to look.

use super::ranking::{Difference, Search, Support, Tried};
use crate::mistakes::Hypothesis;
use gonio_gl::GlError;

/// From this support by the source on a mistake is a suspect.
const SUSPECTED_FROM: f32 = 0.9;
/// More suspects than this are no help: the source is of another kind than the exercise's.
const MOST_SUSPECTS: usize = 12;
/// More mistakes than this at once are not told apart by any picture.
const MOST_AT_ONCE: usize = 6;
/// A mistake that explains less than this of what the others leave over is not added.
const WORTH: f64 = 0.02;

impl<'a> Search<'a> {
    /// From each base, the mistakes that the source shows: added one by one, each time the one that explains most of what is
    /// left over.
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
