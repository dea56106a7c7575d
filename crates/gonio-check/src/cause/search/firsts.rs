//! The repairs that may be the first of two.

use super::Search;
use crate::cause::observed::{Observed, Observer};
use crate::cause::program::Runner;
use crate::cause::repair::{Asked, Make, Repair};
use crate::cause::target::Seen;
use gonio_glsl::Stage;

/// The quantity that is the position on the screen.
const POSITION: &str = "gl_Position";
/// Most repairs of the position on the screen that are tried, and that are kept.
const MOST_OF_POSITION: usize = 12;
const MOST_FIRST_POSITIONS: usize = 2;
/// Most repairs whose gain is measured.
const MOST_MEASURED: usize = 240;

impl Search<'_> {
    /// Repairs that may be the first of two. Positions on the screen are apart from the light: where both are wrong, those
    /// that put everything in its place come first.
    pub(super) fn likely_firsts(&mut self, observed: &[Observed]) -> Vec<Repair> {
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
            search.trials.target.wrong_in(scene, seen, places, vertices)
        };
        let Some(before) = self.see(&[], self.telling..self.telling + 1) else { return Vec::new() };
        if wrong(self, &before, self.telling) != [true; 2] {
            return Vec::new();
        }
        let mut repairs = self.repairs(observed, Asked::All);
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
        let repairs = self.repairs(observed, Asked::All);
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
}
