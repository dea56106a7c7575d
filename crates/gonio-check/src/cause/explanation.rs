//! Explanations of a picture by mistakes of the catalogue.

use super::answer::{AnswerMethod, Space};
use crate::comparison::Lights;
use crate::mistakes::{Hypothesis, Mistake};
use crate::testbench::TestScene;
use glam::Vec3;
use std::collections::BTreeSet;

/// Mistakes that explain a picture.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The method of a right answer in which they are made.
    pub method: AnswerMethod,
    /// The strengths of ambient, diffuse and specular light in red, green and blue, where they are constants of the
    /// program and shown.
    pub strengths: Strengths,
    /// The lights to which they apply.
    pub lights: Lights,
    /// The space in which the light is computed.
    pub space: Space,
    /// The changed lines, peculiarities included.
    pub hypothesis: Hypothesis,
    /// The mistakes.
    pub mistakes: Vec<&'static Mistake>,
    /// How many peculiarities it assumes.
    pub peculiarities: usize,
}

/// The fitted strengths of ambient, diffuse and specular light in red, green and blue.
pub type Strengths = [Option<[f64; 3]>; 3];

/// Whether a fitted strength is that of a term that is not there.
pub(crate) fn is_absent(strength: Option<[f64; 3]>) -> bool {
    strength.is_some_and(|strength| strength.iter().all(|channel| *channel < 1e-3))
}

/// Whether a fitted strength is that of a term that is there.
pub(crate) fn is_present(strength: Option<[f64; 3]>) -> bool {
    strength.is_some() && !is_absent(strength)
}

/// Gives a scene the strengths that are constants of the program, and the colour that these have in common.
pub(super) fn strengthen(strengths: &Strengths, scene: &mut TestScene) {
    let brightest = |strength: &[f64; 3]| strength.iter().copied().fold(0.0, f64::max);
    let light = &mut scene.light;
    let terms = [&mut light.ambient, &mut light.diffuse, &mut light.specular];
    let mut colour: Option<[f64; 3]> = None;
    for (term, strength) in terms.into_iter().zip(strengths) {
        if let Some(strength) = strength {
            let most = brightest(strength);
            *term = most as f32;
            if most > 1e-3 {
                colour.get_or_insert(strength.map(|channel| channel / most));
            }
        }
    }
    let is_coloured = colour.is_some_and(|colour| colour.iter().any(|channel| (channel - 1.0).abs() > 1e-3));
    if let Some(colour) = colour.filter(|_| is_coloured && scene.material == Vec3::ONE) {
        scene.material = Vec3::from_array(colour.map(|channel| channel as f32));
    }
}

/// With more mistakes that explain a picture equally well, none is named.
const MOST_ALTERNATIVES: usize = 4;
/// The explanations of the fewest mistakes and peculiarities; none if there are too many.
pub(super) fn simplest(mut found: Vec<Explanation>) -> Vec<Explanation> {
    let size = |explanation: &Explanation| (explanation.mistakes.len(), explanation.peculiarities);
    let least = found.iter().map(size).min();
    found.retain(|explanation| Some(size(explanation)) == least);
    // What alternatives have in common is the same mistake in each.
    if let Some((first, others)) = found.split_first_mut() {
        for other in others {
            for (at, mistake) in first.mistakes.iter().enumerate() {
                if let Some(there) = other.mistakes.iter().position(|one| one.id == mistake.id) {
                    other.mistakes.swap(at, there);
                }
            }
        }
    }
    // Too many mistakes explain a black picture.
    let first = |explanation: &Explanation| explanation.mistakes.first().map(|mistake| mistake.id.as_str());
    let distinct: BTreeSet<&str> = found.iter().filter_map(first).collect();
    if distinct.len() > MOST_ALTERNATIVES { Vec::new() } else { found }
}
