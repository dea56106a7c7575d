//! Compares a picture with predictions at a few places, which exclude most hypotheses.

use super::answer::Space;
use super::prediction::{Planes, Predicted, Predictor, Sum};
use super::samples::SceneSamples;
use super::target::{Fit, Seen, SeenColours, is_in_place, planes};
use super::values::Values;
use crate::comparison::{Lights, Parameterisation};
use crate::mistakes::{Hypothesis, ModelSolution};
use crate::testbench::TestScene;
use gonio_threads::prelude::*;

/// Places of all hypotheses that are predicted together.
const TOGETHER: usize = 16_384;
/// Fewest hypotheses that a thread of its own is worth.
const FEWEST_TOGETHER: usize = 64;
/// Brightness that no 8-bit picture shows.
pub(super) const DARKEST: f32 = 0.002;
/// Brightness that pictures may have limited to 1.
const WHITE: f32 = 0.999;
/// Places that exclude most pairs, if `open` strengths are fitted.
pub(super) fn quick(model: ModelSolution, open: usize) -> usize {
    let places = 3 + 2 * open;
    places.min(if model.is_per_vertex() { 4 } else { 8 })
}

/// Places that exclude most single mistakes.
pub(super) fn few(model: ModelSolution) -> usize {
    if model.is_per_vertex() { 6 } else { 8 }
}

/// Places in the telling test scene that exclude most hypotheses: each has three vertices of its own.
pub(super) fn coarse(model: ModelSolution) -> usize {
    if model.is_per_vertex() { 12 } else { 32 }
}

/// Of the test scenes that may tell, the one whose seen colours differ most, and places there: half of them evenly spread, half the brightest.
fn telling(
    scenes: &[(TestScene, SceneSamples)],
    is_told: impl Fn(&TestScene) -> bool,
    seen: &Planes,
    count: usize,
) -> Option<(usize, Vec<usize>)> {
    // White is any brightness from 1 on.
    let brightness = |point: usize| -> f32 {
        let sum: f32 = seen.iter().map(|plane| plane[point].clamp(0.0, 1.0)).sum();
        if sum.is_finite() { sum } else { 0.0 }
    };
    let mut first = 0;
    let mut best: Option<(f32, usize, usize)> = None;
    for (scene, (raw, samples)) in scenes.iter().enumerate() {
        let all = || first..first + samples.places.len();
        let mean = all().map(brightness).sum::<f32>() / samples.places.len().max(1) as f32;
        let lit = all().filter(|point| brightness(*point) > 0.02).count();
        let spread = all().map(|point| (brightness(point) - mean).abs().min(1.0)).sum::<f32>();
        let score = spread * (lit as f32).sqrt();
        if is_told(raw) && best.is_none_or(|(known, ..)| score > known * 1.05) {
            best = Some((score, scene, first));
        }
        first += samples.places.len();
    }
    let (_, scene, first) = best?;
    let all = scenes[scene].1.places.len();
    let mut places: Vec<usize> = (0..all.min(count / 2)).collect();
    let mut brightest: Vec<usize> = (places.len()..all).collect();
    let shades = |point: &usize| seen.iter().any(|plane| plane[first + point] < WHITE);
    brightest.sort_by(|a, b| {
        let bright = brightness(first + b).total_cmp(&brightness(first + a));
        shades(b).cmp(&shades(a)).then(bright)
    });
    places.extend(brightest.iter().take(count - places.len()));
    Some((scene, places))
}

/// Predictions at few places of the telling test scene.
pub(super) struct AtFew {
    /// Predictions at these places.
    pub predictor: Predictor,
    seen: SeenColours,
    /// The positions on the screen that are seen.
    pub clip: Values,
}

impl AtFew {
    /// Predictions at `count` places, by the model solution and for the lights of `whole`, in its space.
    pub fn new(
        scenes: &[(TestScene, SceneSamples)],
        parameterisation: &Parameterisation,
        (whole, space): (&Predictor, Space),
        seen: &Seen,
        count: usize,
    ) -> Result<Self, String> {
        let colours = planes(&seen.colour);
        // A mistake with the second light shows where it shines.
        let is_told = |scene: &TestScene| whole.lights != Lights::WrongInSecond || scene.other.is_some();
        let (scene, places) = telling(scenes, is_told, &colours, count).ok_or("no test scene")?;
        let first: usize = scenes[..scene].iter().map(|(_, samples)| samples.places.len()).sum();
        let first_vertex: usize = scenes[..scene].iter().map(|(_, samples)| samples.vertices()).sum();
        let (raw, samples) = &scenes[scene];
        let (some, vertices) = samples.some(&places);
        let clip = vertices.iter().flat_map(|vertex| seen.clip.at(first_vertex + vertex)).copied().collect();
        let scene = [(raw.clone(), some)];
        Ok(AtFew {
            seen: SeenColours::new(colours.map(|plane| places.iter().map(|place| plane[first + place]).collect())),
            clip: Values::new(4, clip),
            predictor: Predictor::new(whole.all.clone(), whole.lights, parameterisation, space, scene),
        })
    }

    /// The cost of one hypothesis: the places at which it is predicted, once for each light and open strength.
    pub fn cost(&self) -> usize {
        (1 + self.predictor.open().len()) * self.predictor.lights.each().len() * self.predictor.places(0)
    }

    /// For each hypothesis, the share of these places that it draws otherwise, and whether it may be right.
    pub fn resemble(&self, hypotheses: &[&Hypothesis]) -> Vec<(f32, bool)> {
        let mut found = vec![(1.0_f32, false); hypotheses.len()];
        // Several threads share what is predicted together.
        let together = TOGETHER / self.predictor.places(0).max(1) / gonio_threads::current_num_threads();
        for sum in [Sum::Terms, Sum::Whole] {
            let have: Vec<usize> =
                (0..hypotheses.len()).filter(|at| self.predictor.sums(hypotheses[*at]).contains(&sum)).collect();
            let fitted = |chunk: &[usize]| -> Vec<(f32, bool)> {
                let chosen: Vec<&Hypothesis> = chunk.iter().map(|at| hypotheses[*at]).collect();
                let predicted = self.predictor.predict_each(0, &chosen, sum);
                predicted.iter().map(|predicted| self.fitted(predicted)).collect()
            };
            let size = together.min(have.len().div_ceil(gonio_threads::current_num_threads())).max(FEWEST_TOGETHER);
            let all: Vec<Vec<(f32, bool)>> = have.par_chunks(size).map(fitted).collect();
            for (at, (share, may_be)) in have.iter().zip(all.into_iter().flatten()) {
                let known = &mut found[*at];
                *known = (known.0.min(share), known.1 || may_be);
            }
        }
        found
    }

    /// The share of places that a prediction draws otherwise, and whether it may be right.
    fn fitted(&self, predicted: &Predicted) -> (f32, bool) {
        let scenes = [predicted];
        let fit = Fit::new(&self.seen, self.predictor.places(0), &scenes);
        (fit.share, fit.is_right_at_few() && is_in_place(&self.clip, &scenes))
    }
}

/// Whether no place has a brightness that an eye would see.
pub(super) fn is_black(seen: &Seen) -> bool {
    seen.colour.numbers.iter().all(|x| x.is_nan() || x.abs() < DARKEST)
}

/// Whether every place is as bright as a screen can show.
pub(super) fn is_white(seen: &Seen) -> bool {
    let mut finite = seen.colour.numbers.iter().filter(|x| x.is_finite()).peekable();
    finite.peek().is_some() && finite.all(|x| *x >= WHITE)
}

/// Whether all places have the same colour on the screen, as in the branch for another kind of object.
pub(super) fn is_flat(seen: &Seen) -> bool {
    planes(&seen.colour).iter().all(|plane| {
        let finite = || plane.iter().filter(|x| x.is_finite()).map(|x| x.clamp(0.0, 1.0));
        let (least, most) = (finite().fold(f32::INFINITY, f32::min), finite().fold(f32::NEG_INFINITY, f32::max));
        most - least <= 0.01 * most.abs().max(0.1)
    })
}
