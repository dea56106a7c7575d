//! Decides whether a picture is right: whether its colours are those of the light equation, with strengths that are
//! inputs or any constants, and its positions those of the camera.

pub use super::answer::Highlight;
use super::answer::{AnswerMethod, Uncoloured, hypothesis_of, peculiarities};
use super::prediction::{Planes, Predicted, Predictor, Sum};
use super::values::Values;
use crate::comparison::weighted_strengths;
use crate::mistakes::Hypothesis;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::OnceLock;

/// The difference of colours that no eye and no 8-bit picture shows.
const TOLERANCE: f32 = 0.003;
/// The same in parts of a bright colour.
const RELATIVE_TOLERANCE: f32 = 0.004;
/// The share of points that may differ: silhouettes, where rounding decides.
const MOST_DIFFERENT: f32 = 0.008;
/// The same at few places: one of 15.
const MOST_DIFFERENT_AT_FEW: f32 = 0.07;
/// Scenes that are compared before all are.
const FIRST_SCENES: usize = 3;
/// Brightness of ambient light with which all is white, whatever the other terms.
const WHITE: f64 = 0.999;
/// Brightness with which a picture is black, whatever the strengths.
const DARKEST: f32 = 1e-3;
/// A term with a smaller strength is missing.
const FAINTEST: f64 = 2e-3;

/// The right colours for one choice of the highlight, in each scene.
struct Variant {
    highlight: Highlight,
    hypothesis: Hypothesis,
    scenes: Vec<OnceLock<Predicted>>,
}

/// The right picture.
pub(crate) struct RightPicture {
    predictor: Predictor,
    required: [bool; 3],
    is_lit: bool,
    variants: Vec<Variant>,
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
    /// The statements that were executed, all points together.
    pub statements: u64,
}

/// The channels of a colour, apart.
pub(super) fn planes(colour: &Values) -> Planes {
    std::array::from_fn(|channel| colour.numbers.iter().skip(channel).step_by(3).copied().collect())
}

impl RightPicture {
    /// Creates the right picture of a method.
    #[must_use]
    pub fn new(predictor: Predictor, method: AnswerMethod, required: [bool; 3]) -> Self {
        let mut chosen: Vec<(Highlight, Hypothesis)> = Vec::new();
        let all = &predictor.all.hypotheses;
        for uncoloured in Uncoloured::all(predictor.has_own_ambient).iter().copied() {
            for (gated, weighted) in [(false, false), (true, false), (false, true)] {
                let highlight = Highlight { gated, weighted, uncoloured };
                let is_plain = highlight == Highlight::default();
                if (is_plain || method.model.is_lit())
                    && let Some(hypothesis) = hypothesis_of(all, &peculiarities(method, highlight))
                {
                    chosen.push((highlight, hypothesis));
                }
            }
        }
        if !method.model.is_lit() {
            // Peculiarities of lookups are no choices of a method.
            let plain = chosen.clone();
            let is_harmless = |single: &&Hypothesis| single.mistakes.iter().all(|m| all.mistakes[*m].harmless);
            for single in all.singles.iter().filter(is_harmless) {
                chosen.extend(plain.iter().filter_map(|(highlight, set)| Some((*highlight, set.and(single)?))));
            }
        }
        let variants = chosen.into_iter().map(|(highlight, hypothesis)| {
            let scenes = (0..predictor.scenes()).map(|_| OnceLock::new()).collect();
            Variant { highlight, hypothesis, scenes }
        });
        let variants = variants.collect();
        let is_lit = method.model.is_lit();
        RightPicture { predictor, required, is_lit, variants }
    }

    /// The predictions of a variant in the first scenes.
    fn scenes<'a>(&'a self, variant: &'a Variant, count: usize) -> Vec<&'a Predicted> {
        let scene = |scene: usize| {
            variant.scenes[scene].get_or_init(|| self.predictor.predict(scene, &variant.hypothesis, Sum::Terms))
        };
        (0..count).map(scene).collect()
    }

    /// Whether a picture of all scenes, at few places, may be right.
    #[must_use]
    pub fn may_agree(&self, seen: &Seen) -> bool {
        let count = self.predictor.scenes();
        let places = (0..count).map(|scene| self.predictor.places(scene)).sum();
        let colours = SeenColours::new(planes(&seen.colour));
        self.variants.iter().any(|variant| {
            let scenes = self.scenes(variant, count);
            is_in_place(&seen.clip, &scenes) && Fit::new(&colours, places, &scenes).is_right_at_few()
        })
    }

    /// Whether the colours and whether the positions of one scene are wrong, whatever the strengths. `places` and `vertices`
    /// are the points of the scene.
    #[must_use]
    pub fn wrong_in(&self, scene: usize, seen: &Seen, places: Range<usize>, vertices: Range<usize>) -> [bool; 2] {
        let colours = SeenColours::new(planes(&seen.colour).map(|plane| plane[places.clone()].to_vec()));
        let clip = Values::new(4, seen.clip.numbers[vertices.start * 4..vertices.end * 4].to_vec());
        let mut wrong = [true; 2];
        for variant in &self.variants {
            let right =
                variant.scenes[scene].get_or_init(|| self.predictor.predict(scene, &variant.hypothesis, Sum::Terms));
            wrong[0] &= !Fit::new(&colours, places.len(), &[right]).is_right_at_few();
            wrong[1] &= !is_in_place(&clip, &[right]);
        }
        wrong
    }

    /// Whether a picture is right, at the points that it has. The first variant that fits counts.
    #[must_use]
    pub fn agrees(&self, seen: &Seen) -> Option<Agreement> {
        let places = seen.colour.present.iter().take_while(|present| **present).count();
        let mut count = 0;
        let mut sum = 0;
        while sum < places && count < self.predictor.scenes() {
            sum += self.predictor.places(count);
            count += 1;
        }
        let colours = SeenColours::new(planes(&seen.colour));
        let first = self.variants.first()?;
        if !is_in_place(&seen.clip, &self.scenes(first, count)) {
            return None;
        }
        let places_of_first = (0..FIRST_SCENES.min(count)).map(|scene| self.predictor.places(scene)).sum();
        self.variants.iter().find_map(|variant| {
            // Most variants differ in the first scenes.
            if count > FIRST_SCENES
                && !Fit::new(&colours, places_of_first, &self.scenes(variant, FIRST_SCENES)).is_right_at_few()
            {
                return None;
            }
            let fit = Fit::new(&colours, sum, &self.scenes(variant, count));
            // A strength of the testbench may be too large for some materials.
            let is_overexposed = fit.is_white && self.predictor.is_ambient_written;
            (!is_overexposed && !fit.is_blind && fit.is_right(self.required))
                .then(|| Agreement { highlight: self.is_lit.then_some(variant.highlight), strengths: fit.strengths })
        })
    }
}

/// Whether the positions on the screen are as predicted.
pub(super) fn is_in_place(clip: &Values, scenes: &[&Predicted]) -> bool {
    let right = scenes.iter().flat_map(|scene| scene.clip.iter());
    let (mut all, mut different) = (0_usize, 0_usize);
    for (point, right) in right.enumerate().filter(|(point, _)| clip.present[*point]) {
        all += 1;
        different += usize::from(!on_screen(clip.at(point), right));
    }
    different as f32 <= MOST_DIFFERENT * all as f32
}

/// Whether a position appears at the same place on the screen as another one, or is behind the camera too.
pub(super) fn on_screen(seen: &[f32], right: &[f32]) -> bool {
    const NEAREST: f32 = 1e-3;
    let is_near = |axis: usize| (seen[axis] / seen[3] - right[axis] / right[3]).abs() < 2e-3;
    match right[3] > NEAREST {
        true => seen[3] > 0.0 && is_near(0) && is_near(1),
        false => seen[3] <= 10.0 * NEAREST,
    }
}

/// Colours with the open strengths that bring them nearest to the seen ones.
pub(super) struct Fit {
    /// The strengths of ambient, diffuse and specular light; `None` where they are not open or not shown.
    pub strengths: [Option<[f64; 3]>; 3],
    /// The common factor, if only that is open, is negative or 0.
    is_dark: bool,
    /// Whether ambient light alone makes everything white.
    pub is_white: bool,
    /// Whether there are open strengths and every colour is limited to white: these may be anything.
    is_blind: bool,
    /// The share of places whose colour differs.
    pub share: f32,
}

/// Seen colours, with what all fits to them need.
pub(super) struct SeenColours {
    planes: Planes,
    /// The weight of each value: errors are in parts of large ones.
    weights: [Vec<f64>; 3],
    /// Whether red, green and blue are the same.
    is_grey: bool,
}

impl SeenColours {
    pub fn new(planes: Planes) -> Self {
        // A value of 1 may have been limited to it.
        let weight = |s: &f32| if *s == 1.0 { 0.0 } else { (0.05 + f64::from(s.abs())).powi(-2) };
        let weights = planes.each_ref().map(|plane| plane.iter().map(weight).collect());
        let is_grey = is_grey(&planes);
        SeenColours { planes, weights, is_grey }
    }

    fn root_mean_square(&self, count: usize) -> f32 {
        let (mut sum, mut counted) = (0.0_f64, 0_u32);
        for x in self.planes.iter().flat_map(|plane| &plane[..count]).filter(|x| x.is_finite()) {
            sum += f64::from(*x) * f64::from(*x);
            counted += 1;
        }
        (sum / f64::from(counted.max(1))).sqrt() as f32
    }
}

fn is_grey([red, green, blue]: &Planes) -> bool {
    red == green && red == blue
}

/// A channel of several scenes, one after the other.
fn joined<'a>(scenes: &[&'a Predicted], of: impl Fn(&'a Predicted) -> &'a [f32]) -> Cow<'a, [f32]> {
    match scenes {
        [one] => Cow::Borrowed(of(one)),
        several => Cow::Owned(several.iter().flat_map(|scene| of(scene)).copied().collect()),
    }
}

impl Fit {
    /// Fits predictions of the first scenes, `count` places together.
    pub fn new(seen: &SeenColours, count: usize, scenes: &[&Predicted]) -> Self {
        let mut wrong = vec![false; count];
        let mut found = Fit { strengths: [None; 3], is_dark: false, is_white: true, is_blind: false, share: 1.0 };
        let Some(first) = scenes.first() else { return found };
        let is_limited = |plane: &Vec<f32>| plane[..count].iter().all(|x| *x >= 1.0 || !x.is_finite());
        found.is_blind = !first.open.is_empty() && seen.planes.iter().all(is_limited);
        // With open strengths, a dark picture is as good as a bright one; a black one has no light.
        let scale = match first.open.is_empty() {
            true => 1.0,
            false => (2.0 * seen.root_mean_square(count)).clamp(DARKEST, 1.0),
        };
        let is_grey = seen.is_grey
            && scenes.iter().all(|scene| is_grey(&scene.known) && scene.open.iter().all(|(_, open)| is_grey(open)));
        for channel in 0..if is_grey { 1 } else { 3 } {
            let known = joined(scenes, |scene| &scene.known[channel]);
            let open: Vec<Cow<'_, [f32]>> = (0..first.open.len())
                .map(|term| joined(scenes, move |scene| scene.open[term].1[channel].as_slice()))
                .collect();
            let beyond: Vec<&[f32]> = open.iter().map(AsRef::as_ref).collect();
            let (weights, seen) = (&seen.weights[channel], &seen.planes[channel][..count]);
            let fitted = match beyond.is_empty() {
                true => Vec::new(),
                false => weighted_strengths(|place| weights[place], seen, &known, &beyond),
            };
            let ambient = first.open.iter().position(|(term, _)| *term == Some(0));
            found.is_white &= ambient.is_some_and(|at| {
                let mut bright = beyond[at].iter().filter(|x| x.is_finite()).map(|x| fitted[at] * f64::from(*x));
                bright.all(|bright| bright >= WHITE)
            });
            for ((term, _), strength) in first.open.iter().zip(&fitted) {
                match term {
                    Some(term) => {
                        let of_term = found.strengths[*term].get_or_insert([0.0; 3]);
                        if is_grey { of_term.fill(*strength) } else { of_term[channel] = *strength }
                    }
                    None => found.is_dark |= *strength <= 0.0,
                }
            }
            for (place, ((seen, known), wrong)) in seen.iter().zip(known.iter()).zip(&mut wrong).enumerate() {
                let right =
                    beyond.iter().zip(&fitted).fold(*known, |sum, (x, strength)| sum + *strength as f32 * x[place]);
                let is_near = (seen - right).abs() <= TOLERANCE * scale + RELATIVE_TOLERANCE * right.abs()
                    || *seen >= 1.0 && right >= 0.999
                    || !seen.is_finite() && !right.is_finite();
                *wrong |= !is_near;
            }
        }
        // The strength of a term that is not shown cannot be fitted.
        for (index, (term, _)) in first.open.iter().enumerate() {
            let is_shown = scenes.iter().flat_map(|scene| scene.open[index].1.iter().flatten()).any(|x| *x != 0.0);
            if let Some(term) = term.filter(|_| !is_shown) {
                found.strengths[term] = None;
            }
        }
        found.share = wrong.iter().filter(|wrong| **wrong).count() as f32 / count.max(1) as f32;
        found
    }

    /// Whether few places may be the same as those of a right picture: one of them may differ.
    pub fn is_right_at_few(&self) -> bool {
        // A term may be dark at all of them, and then its strength is any.
        self.share <= MOST_DIFFERENT_AT_FEW
    }

    /// Whether the colours are the same, no strength is negative, and the required terms are visible.
    pub fn is_right(&self, required: [bool; 3]) -> bool {
        let is_plausible = |(strength, is_required): (&Option<[f64; 3]>, bool)| {
            strength.is_none_or(|found| {
                let brightest = found.iter().copied().fold(f64::MIN, f64::max);
                found.iter().all(|s| *s >= -FAINTEST) && (!is_required || brightest > FAINTEST)
            })
        };
        self.share <= MOST_DIFFERENT && !self.is_dark && self.strengths.iter().zip(required).all(is_plausible)
    }
}
