//! Decides whether a picture is right: whether its colours are those of the light equation, with strengths that are
//! inputs or any constants, and its positions those of the camera.

use super::model::Model;
use super::samples::{SceneSamples, interpolated};
use super::values::Values;
use crate::mistakes::ModelSolution;
use crate::search::{Parameterisation, Task, strengths};
use gonio_glsl::Stage;

/// The difference of colours that no eye and no 8-bit picture shows.
const TOLERANCE: f32 = 0.003;
/// The same in parts of a bright colour.
const RELATIVE_TOLERANCE: f32 = 0.004;
/// The share of points that may differ: silhouettes, where rounding decides.
const MOST_DIFFERENT: f32 = 0.008;
/// A term with a smaller strength is missing.
const FAINTEST: f64 = 2e-3;

/// What an answer may choose about its highlight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Highlight {
    /// 0 where the light is behind the surface, instead of everywhere where R.V is positive.
    pub gated: bool,
    /// Multiplied by the cosine, as in the rendering equation.
    pub weighted: bool,
    /// In the light's colour instead of the material's.
    pub white: bool,
}

/// A term of the right colour.
#[derive(Clone, Debug)]
struct Term {
    /// Red, green and blue at all places.
    planes: [Vec<f32>; 3],
    /// Whether the strength is a constant of the program and must be fitted.
    is_open: bool,
    is_required: bool,
}

/// The right colours for one choice of the highlight.
#[derive(Clone, Debug)]
struct Variant {
    highlight: Highlight,
    terms: Vec<Term>,
}

/// The right picture.
pub struct RightPicture {
    variants: Vec<Variant>,
    clip: Option<Values>,
}

/// A picture that is right.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// The choice of its highlight.
    pub highlight: Option<Highlight>,
    /// The strengths of ambient, diffuse and specular light in red, green and blue, where they are constants of the
    /// program.
    pub strengths: [Option<[f64; 3]>; 3],
}

/// The seen picture: colours at the places and positions at the vertices.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Red, green and blue at each place.
    pub colour: Values,
    /// `gl_Position` at each vertex.
    pub clip: Values,
}

fn product(factors: &[&Values]) -> Option<Values> {
    let first = factors.first()?;
    Some(first.map(3, |point, _, to| {
        to.fill(1.0);
        for factor in factors {
            let numbers = factor.at(point);
            to.iter_mut().enumerate().for_each(|(c, to)| *to *= numbers[c.min(numbers.len() - 1)]);
        }
    }))
}

/// The channels of a colour, apart.
fn planes(colour: &Values) -> [Vec<f32>; 3] {
    std::array::from_fn(|channel| colour.numbers.iter().skip(channel).step_by(3).copied().collect())
}

impl RightPicture {
    /// Creates the right picture of a method.
    #[must_use]
    pub fn new(
        model: &Model,
        task: &Task,
        parameterisation: &Parameterisation,
        samples: &[SceneSamples],
    ) -> Option<Self> {
        let clip = model.right("gl_Position", Stage::Vertex, false).cloned();
        if !model.method.model.is_lit() {
            let colour = model.right("found", Stage::Fragment, false)?.clone();
            let terms = vec![Term { planes: planes(&colour), is_open: false, is_required: true }];
            let highlight = Highlight { gated: false, weighted: false, white: false };
            return Some(RightPicture { variants: vec![Variant { highlight, terms }], clip });
        }
        let stage = if model.method.model == ModelSolution::Gouraud { Stage::Vertex } else { Stage::Fragment };
        let of = |name: &str| model.right(name, stage, false);
        let [material, attenuation, cosine, spec] =
            [of("materialColour")?, of("attenuation")?, of("cos_theta")?, of("spec")?];
        let (normal, to_light) = (of("N")?, of("L")?);
        let strength = |term: usize| {
            let names = ["light.ambient_strength", "light.diffuse_strength", "light.specular_strength"];
            let is_free = parameterisation.to_find[term] && !parameterisation.given[term];
            (!is_free).then(|| of(names[term])).flatten()
        };
        let term = |index: usize, factors: &[&Values]| {
            let all: Vec<&Values> = factors.iter().copied().chain(strength(index)).collect();
            let basis = product(&all)?;
            let basis = if stage == Stage::Vertex { interpolated(&basis, samples) } else { basis };
            let is_open = parameterisation.to_find[index];
            Some(Term { planes: planes(&basis), is_open, is_required: task.required[index] })
        };
        let gate = cosine.map(1, |point, _, to| {
            let dot: f32 = normal.at(point).iter().zip(to_light.at(point)).map(|(a, b)| a * b).sum();
            to[0] = f32::from(u8::from(dot > 0.0));
        });
        let mut variants = Vec::new();
        for white in [false, true] {
            for (gated, weighted) in [(false, false), (true, false), (false, true)] {
                let mut of_highlight = vec![spec, attenuation];
                of_highlight.extend(gated.then_some(&gate));
                of_highlight.extend(weighted.then_some(cosine));
                of_highlight.extend((!white).then_some(material));
                let terms =
                    vec![term(0, &[material])?, term(1, &[material, attenuation, cosine])?, term(2, &of_highlight)?];
                variants.push(Variant { highlight: Highlight { gated, weighted, white }, terms });
            }
        }
        Some(RightPicture { variants, clip })
    }

    /// Whether a picture is right, at the points that it has. The first variant that fits counts.
    #[must_use]
    pub fn agrees(&self, seen: &Seen) -> Option<Agreement> {
        if !self.is_in_place(&seen.clip) {
            return None;
        }
        self.variants.iter().find_map(|variant| variant.agrees(&seen.colour))
    }

    /// Whether the positions on the screen are right.
    #[must_use]
    pub fn is_in_place(&self, clip: &Values) -> bool {
        let Some(right) = &self.clip else { return true };
        let (mut all, mut different) = (0_usize, 0_usize);
        for point in (0..right.points()).filter(|point| clip.present[*point]) {
            let (a, b) = (clip.at(point), right.at(point));
            if b[3] <= 1e-3 {
                continue;
            }
            all += 1;
            different += usize::from(!on_screen(a, b));
        }
        different as f32 <= MOST_DIFFERENT * all as f32
    }
}

/// Whether a position appears at the same place on the screen as another one before the camera.
pub(super) fn on_screen(seen: &[f32], right: &[f32]) -> bool {
    let is_near = |axis: usize| (seen[axis] / seen[3] - right[axis] / right[3]).abs() < 2e-3;
    right[3] <= 1e-3 || seen[3] > 0.0 && is_near(0) && is_near(1)
}

impl Variant {
    /// Fits the open strengths; returns them, and the share of points whose colour differs.
    fn fit(&self, colour: &Values) -> ([Option<[f64; 3]>; 3], f32) {
        // Scenes are drawn in their order.
        let count = colour.present.iter().take_while(|present| **present).count();
        let seen_planes = planes(colour);
        let mut wrong = vec![false; count];
        let mut found = [None; 3];
        // With open strengths, a dark picture is as good as a bright one.
        let is_open = self.terms.iter().any(|term| term.is_open);
        let scale = if is_open { (2.0 * colour.root_mean_square()).min(1.0) } else { 1.0 };
        for (channel, seen) in seen_planes.iter().enumerate() {
            let seen = &seen[..count];
            let mut known = vec![0.0_f32; count];
            for term in self.terms.iter().filter(|term| !term.is_open) {
                known.iter_mut().zip(&term.planes[channel]).for_each(|(sum, x)| *sum += x);
            }
            let open: Vec<(usize, Vec<f32>)> = (self.terms.iter().enumerate())
                .filter(|(_, term)| term.is_open)
                .map(|(index, term)| (index, term.planes[channel].iter().zip(&known).map(|(x, k)| x + k).collect()))
                .collect();
            let planes: Vec<&[f32]> = open.iter().map(|(_, plane)| plane.as_slice()).collect();
            let fitted = strengths(seen, &known, &planes);
            let mut right = known.clone();
            for ((index, plane), strength) in open.iter().zip(&fitted) {
                found[*index].get_or_insert([0.0; 3])[channel] = *strength;
                for (sum, (x, k)) in right.iter_mut().zip(plane.iter().zip(&known)) {
                    *sum += *strength as f32 * (x - k);
                }
            }
            for ((seen, right), wrong) in seen.iter().zip(&right).zip(&mut wrong) {
                let is_near = (seen - right).abs() <= TOLERANCE * scale + RELATIVE_TOLERANCE * right.abs()
                    || *seen >= 1.0 && *right >= 0.999;
                *wrong |= !is_near;
            }
        }
        let share = wrong.iter().filter(|wrong| **wrong).count() as f32 / wrong.len().max(1) as f32;
        (found, share)
    }

    fn agrees(&self, colour: &Values) -> Option<Agreement> {
        let (strengths, share) = self.fit(colour);
        let is_shown = |index: usize| {
            strengths.get(index).copied().flatten().is_none_or(|found| {
                let brightest = found.iter().copied().fold(f64::MIN, f64::max);
                let is_negative = found.iter().any(|s| *s < -FAINTEST);
                !is_negative && (!self.terms[index].is_required || brightest > FAINTEST)
            })
        };
        let is_right = share <= MOST_DIFFERENT && (0..self.terms.len()).all(is_shown);
        is_right.then_some(Agreement { highlight: (self.terms.len() == 3).then_some(self.highlight), strengths })
    }
}
