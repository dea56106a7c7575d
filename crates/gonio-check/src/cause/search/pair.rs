//! The search for two causes of a wrong picture.

use super::{Search, Tried};
use crate::cause::explanation::Explanation;
use crate::cause::found::Found;
use crate::cause::model::Model;
use crate::cause::observed::{Observed, Observer};
use crate::cause::program::Change;
use crate::cause::proven_cause::ProvenCause;
use crate::cause::repair::Repair;
use crate::cause::target::Seen;
use crate::cause::values::Values;
use crate::mistakes::Mistake;
use gonio_threads::current_num_threads;
use gonio_threads::prelude::*;

/// Most runs for two causes, besides those for one.
const MOST_RUNS_OF_PAIR: usize = 1_600;
/// Most runs for the second of two causes.
const MOST_RUNS_OF_SECOND: usize = 800;
/// Most values that are tried as the first of two causes.
const MOST_FIRSTS: usize = 16;
/// Most pictures with a first cause repaired that are explained by mistakes.
const MOST_EXPLAINED: usize = 6;

impl Search<'_> {
    /// Two causes: the first one is a wrong value that is recognised. With an explanation, its mistakes are both.
    ///
    /// What is beside a first one is searched on all cores, as in [`Search::proven`].
    pub(super) fn pair(&mut self, observed: &[Observed], explaining: &[&'static Mistake]) -> Option<Found> {
        let is_explained = !explaining.is_empty();
        let mut firsts = if is_explained { self.known(observed) } else { self.likely_firsts(observed) };
        firsts.truncate(MOST_FIRSTS);
        let end = self.runs + MOST_RUNS_OF_PAIR;
        let mut best: Option<Found> = None;
        // The likeliest alone: it is often the one.
        let (likeliest, others) = firsts.split_at(firsts.len().min(1));
        for batch in std::iter::once(likeliest).chain(others.chunks(current_num_threads())) {
            let beside = |first: &Repair| {
                let mut search = Search { runs: 0, statements: 0, ..*self };
                (search.beside(first, observed, explaining), search.runs, search.statements)
            };
            let all: Vec<(Option<Found>, usize, u64)> = batch.par_iter().map(beside).collect();
            for (found, runs, statements) in all {
                if self.runs > end || self.is_dear() {
                    return best;
                }
                self.runs += runs;
                self.statements += statements;
                let Some(found) = found else { continue };
                let is_of_two = matches!(&found, Found::Causes(groups) if groups.len() == 2);
                if is_of_two && (!is_explained || found.rank() == 1) {
                    return Some(found);
                }
                best.get_or_insert(found);
            }
        }
        best
    }

    /// A first cause with the best one beside it: one cause at two places, or two.
    fn beside(&mut self, first: &Repair, observed: &[Observed], explaining: &[&'static Mistake]) -> Option<Found> {
        let is_explained = !explaining.is_empty();
        let base = vec![first.change(observed, self.at.model)?];
        let mut again = self.at.observe(&base, 0..self.at.runner.samples.len());
        self.at.interpret(&mut again);
        let tried = if is_explained { Tried::Known } else { Tried::All };
        let mut seconds = self.causes(&base, &again, explaining, tried, (MOST_RUNS_OF_SECOND, MOST_RUNS_OF_SECOND));
        // A sum of wrong terms is not where the second one is.
        let depth = |causes: &[ProvenCause]| causes.iter().map(|cause| cause.depth).min().unwrap_or(u32::MAX);
        if is_explained
            && seconds.iter().all(|second| second.distance > 0)
            && let Some(found) = self.at_each_read(&base, &again, explaining)
            && depth(&found) < depth(&seconds)
        {
            seconds = found;
        }
        let second = seconds.first().filter(|second| second.is_explained == is_explained)?;
        let mut both = vec![second.repair.change(&again, self.at.model)?];
        // What is read at several places is repaired at each.
        for right in second.right.iter().skip(1) {
            both.extend(right.change(self.at.runner, self.at.model, &base));
        }
        // A value in place of a whole expression needs no other within it.
        let (inner, outer) = (&observed[first.of], &again[second.repair.of]);
        if self.at.is_within(inner, outer) && self.is_right(&both) {
            return None;
        }
        let firsts = self.at.causes(&both, observed, std::slice::from_ref(first), explaining);
        let name = |group: &[ProvenCause]| Some(group.first()?.mistakes.first()?.id.clone());
        // Beside the second, the first is at the best of its places too.
        let firsts = match name(&firsts) != name(&seconds) {
            true => self.at_best_place(&both, firsts, explaining),
            false => firsts,
        };
        let is_same = match (firsts.first(), seconds.first()) {
            (Some(a), Some(b)) => name(&firsts) == name(&seconds) && (a.is_sound() || a.is_same_value(b)),
            _ => false,
        };
        match (is_same, is_explained) {
            (false, _) => Some(Found::Causes(vec![firsts, seconds])),
            // The picture shows two mistakes.
            (true, true) => None,
            // One mistake at two places.
            (true, false) => {
                let mut merged = firsts;
                merged[0].also.push((seconds[0].stage, seconds[0].expr));
                merged[0].right.extend(seconds[0].right.iter().cloned());
                Some(Found::Causes(vec![merged]))
            }
        }
    }

    /// The places of a named mistake beside another change, the best first; those that are known if there are no others.
    fn at_best_place(
        &mut self,
        base: &[Change],
        known: Vec<ProvenCause>,
        explaining: &[&'static Mistake],
    ) -> Vec<ProvenCause> {
        if !known.first().is_some_and(ProvenCause::is_sound) {
            return known;
        }
        let mut observed = self.at.observe(base, 0..self.at.runner.samples.len());
        self.at.interpret(&mut observed);
        let end = self.runs + MOST_RUNS_OF_SECOND;
        let found = self.causes(base, &observed, explaining, Tried::Known, (MOST_RUNS_OF_SECOND, end));
        let name = |causes: &[ProvenCause]| causes.first().and_then(|cause| cause.mistakes.first()).map(|m| &m.id);
        if name(&found) == name(&known) { found } else { known }
    }

    /// The causes beside a first one with which the mistakes that `explain` finds explain the picture.
    ///
    /// `in_model` gives the quantities of those mistakes.
    ///
    /// # Errors
    /// Those of the functions.
    pub(in crate::cause) fn beside_one(
        &mut self,
        explain: &dyn Fn(&Seen) -> Result<Vec<Explanation>, String>,
        in_model: &dyn Fn(&[Explanation]) -> Result<Model, String>,
    ) -> Result<Found, String> {
        let all = 0..self.at.runner.samples.len();
        let mut observed = self.at.observe(&[], all.clone());
        self.at.interpret(&mut observed);
        let mut tried: Vec<Values> = Vec::new();
        for first in self.likely_firsts(&observed) {
            if tried.len() >= MOST_EXPLAINED {
                break;
            }
            let Some(change) = first.change(&observed, self.at.model) else { continue };
            let base = vec![change];
            let Some(seen) = self.see(&base, all.clone()) else { continue };
            if tried.iter().any(|known| known.is_same(&seen.colour)) {
                continue;
            }
            tried.push(seen.colour.clone());
            let explanations = explain(&seen)?;
            let explaining: Vec<&'static Mistake> =
                explanations.iter().filter_map(|explanation| explanation.mistakes.first().copied()).collect();
            if explaining.is_empty() {
                continue;
            }
            let model = in_model(&explanations)?;
            let at = Observer { runner: self.at.runner, model: &model };
            let mut beside = Search::new(at, self.trials, &explanations, self.lights);
            let mut again = at.observe(&base, all.clone());
            at.interpret(&mut again);
            let budget = (MOST_RUNS_OF_SECOND, MOST_RUNS_OF_SECOND);
            let seconds = beside.causes(&base, &again, &explaining, Tried::Known, budget);
            self.runs += beside.runs;
            let Some(both) = seconds.first().and_then(|second| second.repair.change(&again, &model)) else { continue };
            let firsts = self.at.causes(std::slice::from_ref(&both), &observed, std::slice::from_ref(&first), &[]);
            if !firsts.is_empty() {
                let firsts = self.at_best_place(std::slice::from_ref(&both), firsts, &[]);
                return Ok(Found::Causes(vec![firsts, seconds]));
            }
        }
        Ok(Found::Nothing)
    }
}
