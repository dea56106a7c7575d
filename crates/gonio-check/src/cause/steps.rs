//! Recognises toon shading: diffuse light in steps is a choice, as long as each step is one of the right cosine.

use super::diagnosing::Diagnosing;
use super::methods::methods;
use super::model::{Mistakes, Model, Space};
use super::target::Seen;
use crate::comparison::Second;
use crate::mistakes::ModelSolution;
use gonio_glsl::Stage;
use std::collections::BTreeSet;

/// Most steps; a ramp of 8-bit colours has more.
const MOST_STEPS: usize = 8;
/// Fewest steps in some scene: lit or not lit is no shading.
const FEWEST_STEPS: usize = 3;
/// Fewest places of a step.
const FEWEST_PLACES: usize = 3;
/// Places that are of no step, where rounding decides, and steps that these split.
const MOST_STRAYS: usize = 2;

/// A colour in steps that no eye tells apart.
fn rounded(colour: &[f32]) -> [i64; 3] {
    let level = |x: f32| if x.is_finite() { (x.clamp(-1e3, 1e3) * 1e3).round() as i64 } else { i64::MAX };
    [0, 1, 2].map(|channel| level(colour[channel]))
}

/// The number of steps of colours as a function of the cosine; `None` if they are no such function.
fn steps(cosines: &[f32], colours: &[f32]) -> Option<usize> {
    let colour = |at: usize| rounded(&colours[at * 3..][..3]);
    let mut order: Vec<usize> = (0..cosines.len()).filter(|at| cosines[*at].is_finite()).collect();
    order.sort_by(|a, b| cosines[*a].total_cmp(&cosines[*b]));
    let runs: Vec<([i64; 3], usize)> =
        order.chunk_by(|a, b| colour(*a) == colour(*b)).map(|run| (colour(run[0]), run.len())).collect();
    // A slope has as many colours as places.
    let (steps, strays): (Vec<_>, Vec<_>) = runs.into_iter().partition(|(_, places)| *places >= FEWEST_PLACES);
    let distinct: BTreeSet<[i64; 3]> = steps.iter().map(|(colour, _)| *colour).collect();
    let stray: usize = strays.iter().map(|(_, places)| places).sum();
    let is_split = steps.len() >= distinct.len() + MOST_STRAYS;
    (!distinct.is_empty() && distinct.len() <= MOST_STEPS && !is_split && stray <= MOST_STRAYS)
        .then_some(distinct.len())
}

impl Diagnosing<'_> {
    /// Whether a program whose task is diffuse light alone draws steps of the right cosine in every scene.
    pub(super) fn has_steps(&self, seen: &Seen) -> Result<bool, String> {
        let is_diffuse = self.task.required == [false, true, false] && self.task.model == ModelSolution::Phong;
        if !is_diffuse || self.parameterisation.second != Second::None {
            return Ok(false);
        }
        let samples = self.samples();
        let Some(first) = samples.first() else { return Ok(false) };
        let in_first: BTreeSet<[i64; 3]> =
            seen.colour.numbers.chunks_exact(3).take(first.places.len()).map(rounded).collect();
        if in_first.len() > MOST_STEPS {
            return Ok(false);
        }
        for method in methods(self.task).into_iter().filter(|method| method.model == self.task.model) {
            let model = Model::new(self.solutions, method, Space::World, &samples, 1.0, Mistakes::These(&[]))?;
            let Some(cosines) = model.right("dot(N, L)", Stage::Fragment, false) else { continue };
            let mut first = 0;
            let of_scenes = samples.iter().map(|samples| {
                let places = first..first + samples.places.len();
                first = places.end;
                steps(&cosines.numbers[places.clone()], &seen.colour.numbers[places.start * 3..places.end * 3])
            });
            let most = of_scenes.collect::<Option<Vec<usize>>>().and_then(|all| all.into_iter().max());
            if most.is_some_and(|most| most >= FEWEST_STEPS) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_functions_of_the_cosine() {
        let cosines: Vec<f32> = (0..60).map(|at| at as f32 / 60.0).collect();
        let grey = |f: &dyn Fn(f32) -> f32| -> Vec<f32> { cosines.iter().flat_map(|x| [f(*x); 3]).collect() };
        // One place where the cosine is 0 is no step.
        assert_eq!(steps(&cosines, &grey(&|x| (x * 4.0).ceil() / 4.0)), Some(4));
        assert_eq!(steps(&cosines, &grey(&|_| 0.5)), Some(1));
        assert_eq!(steps(&cosines, &grey(&|x| x)), None);
        // A dark picture with a few lit places.
        assert_eq!(steps(&cosines, &grey(&|x| (x - 0.93).max(0.0))), None);
        // Steps of something else.
        assert_eq!(steps(&cosines, &grey(&|x| (x * 20.0).floor() % 2.0)), None);
    }
}
