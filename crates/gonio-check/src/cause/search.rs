//! The search for causes: expressions that, with another value, make the whole picture right.

use super::naming::ProvenCause;
use super::observed::{Observed, Observer};
use super::program::Change;
use super::repair::{Relation, Repair};
use super::target::{Agreement, RightPicture, Seen};
use super::values::Values;
use gonio_glsl::Stage;
use gonio_interpreter::PointValues;

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
const MOST_RUNS: usize = 2_000;
/// Most statements of a search, all points together.
const MOST_STATEMENTS: u64 = 12_000_000;
/// Most runs for the second of two causes.
const MOST_RUNS_OF_SECOND: usize = 400;

impl Found {
    /// Ranks results of several methods: 0 is best.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self {
            Found::Right(_) | Found::Endless => 0,
            Found::Causes(groups) => {
                let is_sound = |group: &Vec<ProvenCause>| group.first().is_some_and(ProvenCause::is_sound);
                let unsound = groups.iter().filter(|group| !is_sound(group)).count();
                (groups.len() - 1) + 2 * unsound
            }
            Found::Nothing => usize::MAX,
        }
    }
}

/// A search in one program with one right answer.
pub(crate) struct Search<'a> {
    pub(super) at: Observer<'a>,
    target: &'a RightPicture,
    runs: usize,
    statements: u64,
}

impl<'a> Search<'a> {
    /// Creates a search.
    #[must_use]
    pub fn new(at: Observer<'a>, target: &'a RightPicture) -> Self {
        Search { at, target, runs: 0, statements: 0 }
    }

    /// The number of runs of single scenes so far.
    #[must_use]
    pub fn runs(&self) -> usize {
        self.runs
    }

    /// The picture in some scenes with changes; `None` if a run does not end.
    fn see(&mut self, changes: &[Change], scenes: std::ops::Range<usize>) -> Option<Seen> {
        let runner = self.at.runner;
        let mut colour = Values::absent(3, runner.points(Stage::Fragment));
        let mut clip = Values::absent(4, runner.points(Stage::Vertex));
        for scene in scenes {
            self.runs += 1;
            let result = runner.run(scene, changes, [&[], &[]]);
            self.statements += result.vertex.statements + result.fragment.statements;
            if result.vertex.ended.is_some() || result.fragment.ended.is_some() {
                return None;
            }
            let first = runner.first_point(Stage::Vertex, scene);
            if let Some(position) = result.vertex.output(&runner.program.vertex, "gl_Position") {
                copy(position, 4, result.vertex.points, first, &mut clip);
            }
            let first = runner.first_point(Stage::Fragment, scene);
            if let Some(output) = runner.colour_output() {
                copy(&result.fragment.outputs[output], 3, result.fragment.points, first, &mut colour);
            }
            for (point, _) in result.fragment.discarded.iter().enumerate().filter(|(_, is)| **is) {
                colour.numbers[(first + point) * 3..][..3].fill(f32::NAN);
            }
        }
        Some(Seen { colour, clip })
    }

    fn judge(&mut self, changes: &[Change]) -> Option<Agreement> {
        let first = self.see(changes, 0..1)?;
        // Open strengths fit one scene more easily than all, so this only excludes.
        self.target.agrees(&first)?;
        let all = self.see(changes, 0..self.at.runner.samples.len())?;
        self.target.agrees(&all)
    }

    /// Whether the picture is right; `None` if a run does not end.
    pub fn is_right(&mut self) -> Option<Option<Agreement>> {
        let seen = self.see(&[], 0..self.at.runner.samples.len())?;
        Some(self.target.agrees(&seen))
    }

    /// Runs the search.
    pub fn run(&mut self) -> Found {
        let Some(seen) = self.see(&[], 0..self.at.runner.samples.len()) else { return Found::Endless };
        if let Some(agreement) = self.target.agrees(&seen) {
            return Found::Right(agreement);
        }
        let all = 0..self.at.runner.samples.len();
        let mut observed = self.at.observe(&[], all.clone());
        self.at.interpret(&mut observed);
        let repairs = self.at.repairs(&observed);
        let proven = self.proven(&[], &observed, &repairs, MOST_RUNS / 2);
        let single = self.at.causes(&[], &observed, &proven);
        if single.first().is_some_and(|best| best.is_sound()) {
            return Found::Causes(vec![single]);
        }
        // Two causes: the first one is a wrong value that is recognised.
        let mut tried = 0;
        for first in repairs.iter().filter(|repair| repair.relation < Relation::Clamp) {
            if tried == 8 || self.runs > MOST_RUNS {
                break;
            }
            if observed[first.of].has_wrong_input {
                continue;
            }
            tried += 1;
            let Some(change) = first.change(&observed, self.at.model) else { continue };
            let base = vec![change];
            let mut again = self.at.observe(&base, all.clone());
            self.at.interpret(&mut again);
            let mut further = self.at.repairs(&again);
            further.retain(|repair| !again[repair.of].has_wrong_input && repair.cost < 8.0);
            let proven = self.proven(&base, &again, &further, MOST_RUNS_OF_SECOND);
            let Some(best) = proven.first().cloned() else { continue };
            let seconds = self.at.causes(&base, &again, &proven);
            if seconds.first().is_none_or(|second| second.has_wrong_input) {
                continue;
            }
            let Some(both) = best.change(&again, self.at.model) else { continue };
            let firsts = self.at.causes(&[both], &observed, std::slice::from_ref(first));
            let name =
                |group: &[ProvenCause]| group.first().and_then(|cause| cause.mistakes.first()).map(|m| m.id.clone());
            if name(&firsts).is_some() && name(&firsts) == name(&seconds) {
                let mut merged = firsts;
                merged[0].also.push((seconds[0].stage, seconds[0].expr));
                merged[0].right.extend(seconds[0].right.iter().cloned());
                return Found::Causes(vec![merged]);
            }
            if !single.is_empty() && [&firsts, &seconds].iter().any(|group| group[0].mistakes.is_empty()) {
                continue;
            }
            return Found::Causes(vec![firsts, seconds]);
        }
        if single.is_empty() { Found::Nothing } else { Found::Causes(vec![single]) }
    }

    /// The repairs that make the picture right, the cheapest first.
    fn proven(&mut self, base: &[Change], observed: &[Observed], repairs: &[Repair], most: usize) -> Vec<Repair> {
        let mut influential: Vec<Option<bool>> = vec![None; observed.len()];
        let mut proven = Vec::new();
        let Some(before) = self.see(base, 0..1) else { return proven };
        let end = (self.runs + most).min(MOST_RUNS);
        let mut dearest = f32::INFINITY;
        for repair in repairs {
            if self.runs > end || self.statements > MOST_STATEMENTS || repair.cost > dearest {
                break;
            }
            let Some(change) = repair.change(observed, self.at.model) else { continue };
            if influential[repair.of].is_none() {
                let mut noise = change.clone();
                noise.values = noise.values.map(noise.values.size, |p, _, b| b.fill(p as f32 * 0.37 + 1.5));
                let mut changes = base.to_vec();
                changes.push(noise);
                let after = self.see(&changes, 0..1);
                let is_changed = after
                    .is_none_or(|after| !after.colour.is_same(&before.colour) || !after.clip.is_same(&before.clip));
                influential[repair.of] = Some(is_changed);
            }
            if influential[repair.of] != Some(true) {
                continue;
            }
            let mut changes = base.to_vec();
            changes.push(change);
            if self.judge(&changes).is_some() {
                if !observed[repair.of].has_wrong_input {
                    dearest = dearest.min(repair.cost + 2.5);
                }
                proven.push(repair.clone());
            }
        }
        proven
    }
}

fn copy(from: &PointValues, size: usize, points: usize, first: usize, to: &mut Values) {
    for point in 0..points {
        to.present[first + point] = true;
        for component in 0..size {
            to.numbers[(first + point) * size + component] = from.float(component, point);
        }
    }
}
