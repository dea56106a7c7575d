//! The search for causes: expressions that, with another value, make the whole picture right.

mod firsts;
mod pair;

use super::explanation::Explanation;
use super::found::Found;
use super::influence::Influence;
use super::observed::{DEEPEST, Evaluations, Observed, Observer, is_name};
use super::program::Change;
use super::proven_cause::ProvenCause;
use super::repair::{Asked, Make, Relation, Repair};
use super::right_change::RightChange;
use super::seeing::see;
use super::target::Seen;
use super::trial::{Trial, Trials};
use crate::comparison::Lights;
use crate::mistakes::Mistake;
use gonio_glsl::Stage;
use gonio_threads::HAS_THREADS;
use gonio_threads::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// Most runs of a search.
const MOST_RUNS: usize = 1_500;
/// Most statements of a search for each run, all points together.
const MOST_STATEMENTS: u64 = 10_000;
/// Repairs that are tried in parallel.
const TRIED_AT_ONCE: usize = 8;

/// The repairs that are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tried {
    /// Those of mistakes that explain the picture.
    Known,
    /// All, from right values on.
    All,
}

/// A search in one program with one right answer.
pub(crate) struct Search<'a> {
    pub(super) at: Observer<'a>,
    trials: Trials<'a>,
    /// The mistakes that explain the picture, alternatives of each other.
    explanations: &'a [Explanation],
    /// The lights of the picture.
    lights: Lights,
    /// The scene that shows the influence of a value best: a black one shows none.
    telling: usize,
    runs: usize,
    statements: u64,
}

impl<'a> Search<'a> {
    /// Creates a search.
    #[must_use]
    pub fn new(at: Observer<'a>, trials: Trials<'a>, explanations: &'a [Explanation], lights: Lights) -> Self {
        Search { at, trials, explanations, lights, telling: most_telling(at), runs: 0, statements: 0 }
    }

    /// Repairs worth trying, by cost. Where a second light is off, its evaluations are not repaired: what is wrong shows in
    /// those of the first.
    fn repairs(&self, observed: &[Observed], asked: Asked) -> Vec<Repair> {
        let mut all = self.at.repairs(observed, asked);
        // One wrong value is no mistake in a function that computes many.
        let helpers = self.at.helpers(observed);
        all.retain(|repair| {
            let of = self.at.function(&observed[repair.of]).and_then(|name| helpers.get(name));
            match of {
                Some(Evaluations::Many) => false,
                Some(Evaluations::Several) => !matches!(repair.relation, Relation::Summand | Relation::Factor),
                None => true,
            }
        });
        if self.lights == Lights::First {
            let mut recognised = BTreeMap::<u32, usize>::new();
            for seen in observed.iter().filter(|seen| !seen.is_assignment) {
                if let Some(occurrence) = seen.occurrence {
                    *recognised.entry(occurrence).or_default() += usize::from(seen.is.is_some());
                }
            }
            let most = recognised.values().copied().max().unwrap_or(0);
            let is_of_first = |occurrence: u32| recognised.get(&occurrence).is_some_and(|count| *count == most);
            all.retain(|repair| observed[repair.of].occurrence.is_none_or(is_of_first));
        }
        all
    }

    /// Ward's model has more quantities, each of which may stand at each place.
    fn most_runs(&self) -> usize {
        if self.at.model.method.model.has_roughness() { 3 * MOST_RUNS } else { MOST_RUNS }
    }

    /// Whether more statements were executed than a search is worth.
    fn is_dear(&self) -> bool {
        self.statements > MOST_STATEMENTS * self.most_runs() as u64
    }

    /// The number of runs of single scenes so far.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.runs
    }

    fn is_right(&mut self, changes: &[Change]) -> bool {
        let trial = self.trials.of(changes);
        self.count(&trial)
    }

    fn see(&mut self, changes: &[Change], scenes: Range<usize>) -> Option<Seen> {
        let (seen, runs) = (see(self.at.runner, changes, scenes.clone()), scenes.len());
        self.runs += runs;
        self.statements += seen.as_ref().map_or(0, |seen| seen.statements);
        seen
    }

    /// Counts the work of a trial, and returns its result.
    fn count(&mut self, trial: &Trial) -> bool {
        self.runs += trial.runs;
        self.statements += trial.statements;
        trial.is_positive
    }

    /// Runs the search with some repairs.
    pub(super) fn run(&mut self, tried: Tried) -> Found {
        let all = 0..self.at.runner.samples.len();
        let mut observed = self.at.observe(&[], all);
        self.at.interpret(&mut observed);
        let explaining = |at: usize| -> Vec<&'static Mistake> {
            self.explanations.iter().filter_map(|explanation| explanation.mistakes.get(at).copied()).collect()
        };
        let is_pair = self.explanations.first().is_some_and(|explanation| explanation.mistakes.len() > 1);
        if is_pair {
            let mistakes: Vec<&'static Mistake> = explaining(0).into_iter().chain(explaining(1)).collect();
            return self.pair(&observed, &mistakes).unwrap_or(Found::Nothing);
        }
        let most = self.most_runs();
        let single = self.causes(&[], &observed, &explaining(0), tried, (most, most));
        let single = if single.is_empty() { Found::Nothing } else { Found::Causes(vec![single]) };
        // A sum of wrong terms is not where the mistake is.
        if tried == Tried::Known
            && !single.is_at_mistakes()
            && let Some(found) =
                self.at_each_read(&[], &observed, &explaining(0)).map(|found| Found::Causes(vec![found]))
            && found.depth() < single.depth()
        {
            return found;
        }
        if single.is_rooted() || tried == Tried::Known {
            return single;
        }
        if let Some(found) = self.at_each_evaluation(&observed) {
            return Found::Causes(vec![found]);
        }
        let pair = self.pair(&observed, &[]).filter(|pair| pair.rank() < single.rank());
        pair.unwrap_or(single)
    }

    /// The single causes beside other changes, the best first.
    fn causes(
        &mut self,
        base: &[Change],
        observed: &[Observed],
        explaining: &[&'static Mistake],
        tried: Tried,
        (most, end): (usize, usize),
    ) -> Vec<ProvenCause> {
        // A gamma curve is one repair at each colour, whatever else the colours are.
        let is_known = |repair: &Repair| repair.relation == Relation::Known || repair.make == Make::Linear;
        let asked = if tried == Tried::All { Asked::All } else { Asked::Known };
        let (mut known, mut others): (Vec<Repair>, Vec<Repair>) =
            self.repairs(observed, asked).into_iter().partition(is_known);
        // The earliest tell most, and the runs may not be enough for all.
        known.sort_by_key(|repair| observed[repair.of].depth);
        let end = (self.runs + most).min(end);
        let mut proven = self.proven(base, observed, &known, end);
        // Earlier expressions, from the inputs on. A variable may be set to a right vector where a unit one belongs.
        let at = self.at;
        let depth = |repair: &Repair| {
            let seen = &observed[repair.of];
            let is_set = || at.runner.program.is_whole_value(seen.stage, seen.expr);
            let is_misused = match repair.relation {
                Relation::Length => is_set(),
                Relation::Factor => at.is_set_to_term(seen),
                // The wrong input or number.
                Relation::Other => true,
                _ => false,
            };
            if seen.depth == 0 && is_misused { 1 } else { seen.depth }
        };
        let first = proven.iter().map(depth).min().unwrap_or(DEEPEST + 1);
        // A right value may be computed from a wrong one, which makes it another quantity.
        // Beside a known wrong value, only earlier ones may be the cause.
        if asked == Asked::Known && !proven.is_empty() {
            others = self.repairs(observed, Asked::All).into_iter().filter(|repair| !is_known(repair)).collect();
        }
        let depths = if tried == Tried::All || !proven.is_empty() { 1..first.max(2) } else { 0..0 };
        for at in depths {
            let here: Vec<Repair> = others.iter().filter(|repair| depth(repair) == at).cloned().collect();
            let found = self.proven(base, observed, &here, end);
            let is_found = !found.is_empty();
            proven.extend(found);
            if is_found {
                break;
            }
        }
        self.at.causes(base, observed, &proven, explaining)
    }

    /// A variable whose wrong value is read at several places, or several times at one: all reads together are the cause.
    fn at_each_read(
        &mut self,
        base: &[Change],
        observed: &[Observed],
        explaining: &[&'static Mistake],
    ) -> Option<Vec<ProvenCause>> {
        let known = self.known(observed);
        for (at, first) in known.iter().enumerate() {
            let text = self.at.text(&observed[first.of]);
            let is_same = |other: &&Repair| {
                let (a, b) = (&observed[first.of], &observed[other.of]);
                other.make == first.make && a.stage == b.stage && self.at.text(b) == text && a.values.is_same(&b.values)
            };
            if !is_name(text) || known[..at].iter().any(|other| is_same(&other)) {
                continue;
            }
            let all: Vec<&Repair> = known[at..].iter().filter(is_same).collect();
            let changes: Option<Vec<Change>> = all.iter().map(|one| one.change(observed, self.at.model)).collect();
            let Some(changes) = changes.filter(|changes| changes.len() > 1) else { continue };
            if !self.is_right(&[base, &changes].concat()) {
                continue;
            }
            let others = [base, &changes[1..]].concat();
            let mut found = self.at.causes(&others, observed, std::slice::from_ref(first), explaining);
            let Some(cause) = found.first_mut() else { continue };
            let others = all.iter().skip(1);
            cause.also.extend(others.clone().map(|other| (observed[other.of].stage, observed[other.of].expr)));
            cause.right.extend(others.map(|other| RightChange::new(other, observed, self.at.model)));
            return Some(found);
        }
        None
    }

    /// An expression of a function that is called several times, which has the wrong sign or length each time.
    fn at_each_evaluation(&mut self, observed: &[Observed]) -> Option<Vec<ProvenCause>> {
        let mut all = self.at.repairs(observed, Asked::All);
        all.retain(|repair| {
            let is_of_own_value = matches!(repair.make, Make::Negative | Make::Unit | Make::NotNegative);
            is_of_own_value && observed[repair.of].occurrence.is_some()
        });
        let place = |repair: &Repair| (observed[repair.of].stage, observed[repair.of].expr);
        for (at, first) in all.iter().enumerate() {
            let is_same = |other: &&Repair| place(other) == place(first) && other.make == first.make;
            if all[..at].iter().any(|other| is_same(&other)) {
                continue;
            }
            let each: Vec<&Repair> = all[at..].iter().filter(is_same).collect();
            let changes: Vec<Change> = each.iter().filter_map(|one| one.change(observed, self.at.model)).collect();
            if changes.len() < 2 || !self.is_right(&changes) {
                continue;
            }
            let mut found = self.at.causes(&changes[1..], observed, std::slice::from_ref(first), &[]);
            let cause = found.first_mut()?;
            cause.right.extend(each.iter().skip(1).map(|other| RightChange::new(other, observed, self.at.model)));
            return Some(found);
        }
        None
    }

    /// The repairs of wrong values of mistakes, the earliest first.
    fn known(&self, observed: &[Observed]) -> Vec<Repair> {
        let mut known = self.repairs(observed, Asked::Known);
        known.retain(|repair| repair.relation == Relation::Known);
        known.sort_by_key(|repair| observed[repair.of].depth);
        known
    }

    /// The repairs that make the picture right, until a number of runs.
    ///
    /// Repairs are tried on all cores, some of them in vain; their results count as if each had waited for the one before.
    fn proven(&mut self, base: &[Change], observed: &[Observed], repairs: &[Repair], end: usize) -> Vec<Repair> {
        let mut proven = Vec::new();
        let telling = self.telling;
        let Some(before) = self.see(base, telling..telling + 1) else { return proven };
        let mut influence = Influence::new(self.at.runner, self.trials.target, base, (telling, before), observed.len());
        let mut dearest = f32::INFINITY;
        for batch in repairs.chunks(if HAS_THREADS { TRIED_AT_ONCE } else { 1 }) {
            let cheap = batch.iter().take_while(|repair| repair.cost <= dearest);
            let change = |repair| Repair::change(repair, observed, self.at.model);
            let changes: Vec<(&Repair, Option<Change>)> = cheap.map(|repair| (repair, change(repair))).collect();
            influence.try_all(self.at.runner, &changes);
            let trials = self.trials;
            let trial = |(repair, change): &(&Repair, Option<Change>)| {
                let change = change.clone().filter(|_| influence.is_in_picture(repair.of))?;
                let mut changes = base.to_vec();
                changes.push(change);
                Some(trials.of(&changes))
            };
            let tried: Vec<Option<Trial>> = changes.par_iter().map(trial).collect();
            for ((repair, change), trial) in changes.iter().zip(&tried) {
                if self.runs > end || self.is_dear() || repair.cost > dearest {
                    return proven;
                }
                if change.is_some()
                    && let Some(noise) = influence.first_trial(repair.of)
                {
                    self.count(&noise);
                }
                if trial.as_ref().is_some_and(|trial| self.count(trial)) {
                    if repair.relation != Relation::Known {
                        dearest = dearest.min(repair.cost + 2.5);
                    }
                    proven.push((*repair).clone());
                }
            }
            if changes.len() < batch.len() {
                break;
            }
        }
        proven
    }
}

/// The scene in which the light of the right picture differs most from place to place.
fn most_telling(at: Observer<'_>) -> usize {
    let right = at.model.right("FragColor", Stage::Fragment, false);
    let spread = |scene: &usize| {
        let of = |scene| at.runner.first_point(Stage::Fragment, scene);
        let light = |point| right.map_or(0.0, |right| right.at(point)[1].clamp(0.0, 1.0));
        let all: Vec<f32> = (of(*scene)..of(scene + 1)).map(light).filter(|light| !light.is_nan()).collect();
        let mean = all.iter().sum::<f32>() / all.len().max(1) as f32;
        all.iter().map(|light| (light - mean).abs()).sum::<f32>()
    };
    (0..at.runner.samples.len()).rev().max_by(|a, b| spread(a).total_cmp(&spread(b))).unwrap_or(0)
}
