//! The search for causes: expressions that, with another value, make the whole picture right.

use super::explanation::Explanation;
use super::influence::{Influence, Trial};
use super::model::Model;
use super::naming::ProvenCause;
use super::observed::{DEEPEST, Observed, Observer, is_name};
use super::program::{Change, Runner};
use super::repair::{Make, Relation, Repair};
use super::right_change::RightChange;
use super::target::{Agreement, RightPicture, Seen};
use super::values::Values;
use crate::comparison::Lights;
use crate::mistakes::Mistake;
use gonio_glsl::Stage;
use gonio_interpreter::PointValues;
use gonio_threads::prelude::*;
use gonio_threads::{HAS_THREADS, current_num_threads};
use std::collections::BTreeMap;
use std::ops::Range;

/// The result of a search.
#[derive(Clone, Debug)]
pub enum Found {
    /// The picture is right.
    Right(Agreement),
    /// Causes that together explain everything wrong; alternatives of a single cause, the best first.
    Causes(Vec<Vec<ProvenCause>>),
    /// Nothing repairs the picture.
    Nothing,
    /// A loop never ends.
    Endless,
}

/// Most runs of a search.
const MOST_RUNS: usize = 1_500;
/// Most statements of a search for each run, all points together.
const MOST_STATEMENTS: u64 = 10_000;
/// Most runs for two causes, besides those for one.
const MOST_RUNS_OF_PAIR: usize = 3_000;
/// Most runs for the second of two causes.
const MOST_RUNS_OF_SECOND: usize = 800;
/// Most values that are tried as the first of two causes.
const MOST_FIRSTS: usize = 16;
/// Most pictures with a first cause repaired that are explained by mistakes.
const MOST_EXPLAINED: usize = 6;
/// The quantity that is the position on the screen.
const POSITION: &str = "gl_Position";
/// Most repairs of the position on the screen that are tried, and that are kept.
const MOST_OF_POSITION: usize = 12;
const MOST_FIRST_POSITIONS: usize = 2;
/// Most repairs whose gain is measured.
const MOST_MEASURED: usize = 240;
/// The largest depth that counts against a result that does not say where the errors are.
const MOST_UNROOTED: usize = 8;
/// Repairs that are tried in parallel.
const TRIED_AT_ONCE: usize = 8;

impl Found {
    /// Ranks results of several methods: 0 is best.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self {
            Found::Right(_) | Found::Endless => 0,
            Found::Causes(groups) => {
                let is_sound = |group: &Vec<ProvenCause>| group.first().is_some_and(ProvenCause::is_sound);
                let unsound = groups.iter().filter(|group| !is_sound(group)).count();
                // Two errors are more likely than one in a value that is computed from wrong ones.
                let errors = (groups.len() - 1) + 2 * unsound;
                if self.is_rooted() { errors } else { errors + self.deepest_first().clamp(2, MOST_UNROOTED) + 2 }
            }
            Found::Nothing => usize::MAX,
        }
    }

    /// How far the earliest cause is from the program's inputs.
    fn depth(&self) -> u32 {
        match self {
            Found::Causes(groups) => groups.iter().flatten().map(|cause| cause.depth).min().unwrap_or(u32::MAX),
            _ => u32::MAX,
        }
    }

    /// How far the best cause that is farthest from the program's inputs is from them: a whole formula is far.
    fn deepest_first(&self) -> usize {
        match self {
            Found::Causes(groups) => {
                groups.iter().filter_map(|group| group.first()).map(|cause| cause.depth as usize).max().unwrap_or(0)
            }
            _ => 0,
        }
    }

    /// How far the best causes are from the program's inputs.
    pub(super) fn depth_of_firsts(&self) -> u32 {
        match self {
            Found::Causes(groups) => groups.iter().filter_map(|group| group.first()).map(|cause| cause.depth).sum(),
            _ => u32::MAX,
        }
    }

    /// Whether each error is a wrong value of the mistake itself, and not one computed from it.
    pub(super) fn is_at_mistakes(&self) -> bool {
        match self {
            Found::Right(_) | Found::Endless => true,
            Found::Causes(groups) => groups.iter().all(|group| group.iter().any(|cause| cause.distance == 0)),
            Found::Nothing => false,
        }
    }

    /// Whether it says where the errors are.
    pub(super) fn is_rooted(&self) -> bool {
        match self {
            Found::Right(_) | Found::Endless => true,
            Found::Causes(groups) => groups.iter().all(|group| group.first().is_some_and(ProvenCause::is_root)),
            Found::Nothing => false,
        }
    }
}

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
    target: &'a RightPicture,
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
    pub fn new(at: Observer<'a>, target: &'a RightPicture, explanations: &'a [Explanation], lights: Lights) -> Self {
        Search { at, target, explanations, lights, telling: most_telling(at), runs: 0, statements: 0 }
    }

    /// All repairs worth trying, by cost. Where a second light is off, its evaluations are not repaired: what is wrong shows in
    /// those of the first.
    fn repairs(&self, observed: &[Observed]) -> Vec<Repair> {
        let mut all = self.at.repairs(observed);
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
        let trial = Trial::of_picture(self.at.runner, self.target, changes);
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
        let repairs = self.repairs(observed);
        // A gamma curve is one repair at each colour, whatever else the colours are.
        let (mut known, others): (Vec<Repair>, Vec<Repair>) =
            repairs.into_iter().partition(|repair| repair.relation == Relation::Known || repair.make == Make::Linear);
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

    /// Two causes: the first one is a wrong value that is recognised. With an explanation, its mistakes are both.
    ///
    /// What is beside a first one is searched on all cores, as in [`Search::proven`].
    fn pair(&mut self, observed: &[Observed], explaining: &[&'static Mistake]) -> Option<Found> {
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
    pub(super) fn beside_one(
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
            let mut beside = Search::new(at, self.target, &explanations, self.lights);
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

    /// The repairs of wrong values of mistakes, the earliest first.
    fn known(&self, observed: &[Observed]) -> Vec<Repair> {
        let mut known = self.repairs(observed);
        known.retain(|repair| repair.relation == Relation::Known);
        known.sort_by_key(|repair| observed[repair.of].depth);
        known
    }

    /// Repairs that may be the first of two. Positions on the screen are apart from the light: where both are wrong, those
    /// that put everything in its place come first.
    fn likely_firsts(&mut self, observed: &[Observed]) -> Vec<Repair> {
        let mut firsts = self.of_position(observed);
        firsts.extend(self.gainful(observed));
        firsts
    }

    /// The repairs of the position on the screen with which everything is in its place, if not all is and the colours are
    /// wrong too.
    fn of_position(&mut self, observed: &[Observed]) -> Vec<Repair> {
        let scenes = self.at.runner.samples.len();
        let points = |at: Observer<'_>, stage, scene| {
            at.runner.first_point(stage, scene)..at.runner.first_point(stage, scene + 1)
        };
        let wrong = |search: &Self, seen: &Seen, scene: usize| {
            let [places, vertices] = [Stage::Fragment, Stage::Vertex].map(|stage| points(search.at, stage, scene));
            search.target.wrong_in(scene, seen, places, vertices)
        };
        let Some(before) = self.see(&[], self.telling..self.telling + 1) else { return Vec::new() };
        if wrong(self, &before, self.telling) != [true; 2] {
            return Vec::new();
        }
        let mut repairs = self.repairs(observed);
        repairs.retain(|repair| repair.quantity().is_some_and(|q| self.at.model.quantities[q].name == POSITION));
        repairs.sort_by_key(|repair| observed[repair.of].depth);
        let mut found = Vec::new();
        for repair in repairs.into_iter().take(MOST_OF_POSITION) {
            let Some(change) = repair.change(observed, self.at.model) else { continue };
            let Some(seen) = self.see(&[change], 0..scenes) else { continue };
            if (0..scenes).all(|scene| !wrong(self, &seen, scene)[1]) {
                found.push(repair);
                if found.len() == MOST_FIRST_POSITIONS {
                    break;
                }
            }
        }
        found
    }

    /// Repairs of values that are computed from right ones, those first with which most other values become right.
    fn gainful(&mut self, observed: &[Observed]) -> Vec<Repair> {
        // The first scene tells enough.
        let first = &self.at.runner.samples[..1];
        let model = self.at.model.in_first_scene(first);
        let at_first = Observer { runner: &Runner::new(self.at.runner.program, first), model: &model };
        let before = at_first.recognised(&[]);
        let repairs = self.repairs(observed);
        // A product or a sum with another value is rarely one that others are computed from.
        let is_other_value = |repair: &Repair| matches!(repair.make, Make::Quantity(_) | Make::Negative | Make::Unit);
        let firsts = repairs.into_iter().filter(|repair| observed[repair.of].depth == 1 && is_other_value(repair));
        let mut gains: Vec<(usize, Repair)> = Vec::new();
        for repair in firsts.take(MOST_MEASURED) {
            let Some(change) = repair.change(observed, self.at.model) else { continue };
            self.runs += 1;
            let gain = at_first.recognised(&[change]).saturating_sub(before);
            if gain > 0 {
                gains.push((gain, repair));
            }
        }
        gains.sort_by_key(|(gain, _)| std::cmp::Reverse(*gain));
        gains.into_iter().map(|(_, repair)| repair).collect()
    }

    /// The repairs that make the picture right, until a number of runs.
    ///
    /// Repairs are tried on all cores, some of them in vain; their results count as if each had waited for the one before.
    fn proven(&mut self, base: &[Change], observed: &[Observed], repairs: &[Repair], end: usize) -> Vec<Repair> {
        let mut proven = Vec::new();
        let telling = self.telling;
        let Some(before) = self.see(base, telling..telling + 1) else { return proven };
        let mut influence = Influence::new(self.at.runner, self.target, base, (telling, before), observed.len());
        let mut dearest = f32::INFINITY;
        for batch in repairs.chunks(if HAS_THREADS { TRIED_AT_ONCE } else { 1 }) {
            let cheap = batch.iter().take_while(|repair| repair.cost <= dearest);
            let change = |repair| Repair::change(repair, observed, self.at.model);
            let changes: Vec<(&Repair, Option<Change>)> = cheap.map(|repair| (repair, change(repair))).collect();
            influence.try_all(self.at.runner, &changes);
            let (runner, target) = (self.at.runner, self.target);
            let trial = |(repair, change): &(&Repair, Option<Change>)| {
                let change = change.clone().filter(|_| influence.is_in_picture(repair.of))?;
                let mut changes = base.to_vec();
                changes.push(change);
                Some(Trial::of_picture(runner, target, &changes))
            };
            let trials: Vec<Option<Trial>> = changes.par_iter().map(trial).collect();
            for ((repair, change), trial) in changes.iter().zip(&trials) {
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

/// The picture in some scenes with changes; `None` if a run does not end.
pub(super) fn see(runner: &Runner<'_>, changes: &[Change], scenes: Range<usize>) -> Option<Seen> {
    let colour = Values::absent(3, runner.points(Stage::Fragment));
    let clip = Values::absent(4, runner.points(Stage::Vertex));
    let mut seen = Seen { colour, clip, statements: 0 };
    for scene in scenes {
        let result = runner.run(scene, changes, [&[], &[]]);
        seen.statements += result.vertex.statements + result.fragment.statements;
        if result.vertex.ended.is_some() || result.fragment.ended.is_some() {
            return None;
        }
        let first = runner.first_point(Stage::Vertex, scene);
        if let Some(position) = result.vertex.output(&runner.program.vertex, "gl_Position") {
            copy(position, 4, result.vertex.points, first, &mut seen.clip);
        }
        let first = runner.first_point(Stage::Fragment, scene);
        if let Some(output) = runner.program.colour_output() {
            copy(&result.fragment.outputs[output], 3, result.fragment.points, first, &mut seen.colour);
        }
        for (point, _) in result.fragment.discarded.iter().enumerate().filter(|(_, is)| **is) {
            seen.colour.numbers[(first + point) * 3..][..3].fill(f32::NAN);
        }
    }
    Some(seen)
}

fn copy(from: &PointValues, size: usize, points: usize, first: usize, to: &mut Values) {
    for point in 0..points {
        to.present[first + point] = true;
        for component in 0..size {
            to.numbers[(first + point) * size + component] = from.float(component, point);
        }
    }
}
