//! Whether a value has an influence on what is wrong in the picture: others need no repair.

use super::program::{Change, Runner};
use super::repair::Repair;
use super::seeing::see;
use super::target::{RightPicture, Seen};
use super::trial::Trial;
use gonio_glsl::Stage;
use gonio_threads::prelude::*;

/// Whether values have an influence on all that is wrong in the picture: the colours, or the positions, or both.
pub(super) struct Influence<'b> {
    base: &'b [Change],
    telling: usize,
    before: Seen,
    is_colour_wrong: bool,
    is_clip_wrong: bool,
    /// For each observed value, whether it has, once tried.
    known: Vec<Option<Trial>>,
    is_counted: Vec<bool>,
}

impl<'b> Influence<'b> {
    /// The influence of `count` values beside changes. `before` is the picture of the telling scene with these.
    pub fn new(
        runner: &Runner<'_>,
        target: &RightPicture,
        base: &'b [Change],
        (telling, before): (usize, Seen),
        count: usize,
    ) -> Self {
        let points = |stage| runner.first_point(stage, telling)..runner.first_point(stage, telling + 1);
        let [is_colour_wrong, is_clip_wrong] =
            target.wrong_in(telling, &before, points(Stage::Fragment), points(Stage::Vertex));
        let (known, is_counted) = (vec![None; count], vec![false; count]);
        Influence { base, telling, before, is_colour_wrong, is_clip_wrong, known, is_counted }
    }

    /// Tries the values of repairs that were not tried before.
    pub fn try_all(&mut self, runner: &Runner<'_>, repairs: &[(&Repair, Option<Change>)]) {
        let mut new: Vec<(usize, &Change)> = Vec::new();
        for (repair, change) in repairs {
            let Some(change) = change else { continue };
            if self.known[repair.of].is_none() && new.iter().all(|(of, _)| *of != repair.of) {
                new.push((repair.of, change));
            }
        }
        let trials: Vec<(usize, Trial)> =
            new.par_iter().map(|(of, change)| (*of, self.trial(runner, (*change).clone()))).collect();
        for (of, trial) in trials {
            self.known[of] = Some(trial);
        }
    }

    fn trial(&self, runner: &Runner<'_>, mut noise: Change) -> Trial {
        noise.values = noise.values.map(noise.values.size, |p, _, b| b.fill(p as f32 * 0.37 + 1.5));
        let mut changes = self.base.to_vec();
        changes.push(noise);
        let after = see(runner, &changes, self.telling..self.telling + 1);
        let statements = after.as_ref().map_or(0, |after| after.statements);
        // A repair changes all that is wrong.
        let is_positive = after.is_none_or(|after| {
            let changes_colour = !after.colour.is_same(&self.before.colour);
            let changes_clip = !after.clip.is_same(&self.before.clip);
            match (self.is_colour_wrong, self.is_clip_wrong) {
                (true, true) => changes_colour && changes_clip,
                (true, false) => changes_colour,
                (false, true) => changes_clip,
                (false, false) => changes_colour || changes_clip,
            }
        });
        Trial { is_positive, runs: 1, statements }
    }

    /// Whether a value that was tried has an influence.
    pub fn is_in_picture(&self, of: usize) -> bool {
        self.known[of].is_some_and(|trial| trial.is_positive)
    }

    /// The trial of a value, the first time that it is asked for.
    pub fn first_trial(&mut self, of: usize) -> Option<Trial> {
        if std::mem::replace(&mut self.is_counted[of], true) { None } else { self.known[of] }
    }
}
