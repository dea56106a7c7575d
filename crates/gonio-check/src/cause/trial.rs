//! Tries whether a picture is right with changes: at few points first, because most changes leave it wrong everywhere.

use super::program::{Change, Runner};
use super::samples::SceneSamples;
use super::seeing::see;
use super::target::RightPicture;

/// Places in the first test scene that exclude most changes.
const FEW: usize = 24;

/// Few points of the first test scene.
pub(super) struct FewPoints {
    /// These points.
    pub samples: [SceneSamples; 1],
    /// For each stage, their numbers among the points of the whole scene.
    numbers: [Vec<usize>; 2],
}

impl FewPoints {
    /// The first places of a scene, with the vertices around them.
    pub fn new(whole: &SceneSamples) -> Self {
        let places: Vec<usize> = (0..FEW.min(whole.places.len())).collect();
        let (samples, vertices) = whole.some(&places);
        FewPoints { samples: [samples], numbers: [vertices, places] }
    }

    /// A change at these points. Those of the first scene come first.
    fn change(&self, change: &Change) -> Change {
        let values = change.values.some(&self.numbers[change.stage as usize]);
        Change { stage: change.stage, exprs: change.exprs.clone(), occurrence: change.occurrence, values }
    }
}

/// A program and its right picture, at few points and at all.
#[derive(Clone, Copy)]
pub(super) struct Trials<'a> {
    /// The program at all points.
    pub runner: &'a Runner<'a>,
    /// The right picture there.
    pub target: &'a RightPicture,
    /// The same at few points.
    pub at_few: (&'a FewPoints, &'a Runner<'a>, &'a RightPicture),
}

/// One attempt, and its work.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial {
    pub is_positive: bool,
    pub runs: usize,
    pub statements: u64,
}

impl Trials<'_> {
    /// Whether the picture is right with changes.
    pub fn of(&self, changes: &[Change]) -> Trial {
        let (points, runner, target) = self.at_few;
        let few: Vec<Change> = changes.iter().map(|change| points.change(change)).collect();
        let seen = see(runner, &few, 0..1);
        let statements = seen.as_ref().map_or(0, |seen| seen.statements);
        let may_agree = seen.is_some_and(|seen| target.may_agree(&seen));
        let mut trial = Trial { is_positive: may_agree, runs: 1, statements };
        // Open strengths fit one scene more easily than all, so the first only excludes.
        for scenes in [1, self.runner.samples.len()] {
            if !trial.is_positive {
                break;
            }
            trial.runs += scenes;
            let seen = see(self.runner, changes, 0..scenes);
            trial.statements += seen.as_ref().map_or(0, |seen| seen.statements);
            trial.is_positive = seen.is_some_and(|seen| self.target.agrees(&seen).is_some());
        }
        trial
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cause::values::Values;
    use crate::testbench::scene;
    use gonio_glsl::Stage;

    #[test]
    fn a_change_keeps_the_values_of_its_points() {
        let whole = SceneSamples::new(scene::lit().swap_remove(0));
        let few = FewPoints::new(&whole);
        let [samples] = &few.samples;
        assert_eq!(samples.places.len(), FEW);
        let change =
            |stage: Stage, values: Values| few.change(&Change { stage, exprs: vec![], occurrence: None, values });
        let at_vertices = change(Stage::Vertex, Values::new(3, whole.mesh.positions.clone()));
        assert_eq!(at_vertices.values.numbers, samples.mesh.positions);
        let weights =
            |samples: &SceneSamples| samples.places.iter().flat_map(|place| place.weights).collect::<Vec<f32>>();
        let at_places = change(Stage::Fragment, Values::new(3, weights(&whole)));
        assert_eq!(at_places.values.numbers, weights(samples));
    }
}
