//! Explains a wrong picture: the mistakes of the catalogue with which a model solution computes the same colours and
//! positions at every place of every test scene.

use super::answer::{OWN_AMBIENT, Uncoloured};
use super::budget::Budget;
use super::model::{AnswerMethod, Space};
use super::prediction::{AllHypotheses, ModelSolutions, Planes, Predicted, Predictor, Sum};
use super::samples::SceneSamples;
use super::shown::Shown;
use super::target::{Fit, Highlight, Seen, is_in_place, planes};
use super::values::Values;
use crate::comparison::{Lights, Parameterisation};
use crate::mistakes::{Hypothesis, Mistake, ModelSolution, TERMS, term_of};
use crate::testbench::TestScene;
use glam::Vec3;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::rc::Rc;

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

/// A model solution that may explain a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightingMethod {
    /// The model solution.
    pub model: ModelSolution,
    /// The space in which it computes the light.
    pub space: Space,
}

/// What a program may assume.
pub(crate) struct Explainer<'a> {
    /// The model solutions.
    pub solutions: &'a ModelSolutions,
    /// The methods, the likeliest first.
    pub methods: &'a [LightingMethod],
    /// The quantities that the program computes, compared with a method.
    pub shown: &'a dyn Fn(LightingMethod) -> Result<Rc<Shown>, String>,
    /// Whether a peculiarity of right answers may be that of the program.
    pub is_likely: &'a dyn Fn(&str) -> bool,
    /// The parameterisation of the program.
    pub parameterisation: &'a Parameterisation,
    /// The terms that are required.
    pub required: [bool; 3],
    /// The test scenes, and the points with the inputs of the program.
    pub scenes: &'a [(TestScene, SceneSamples)],
    /// Single mistakes that may still be predicted, with all roles together.
    pub budget: &'a Budget,
    /// Pairs that may still be predicted at few places. Each set of roles has its own: those with wrong roles would leave
    /// none for the right ones.
    pub pairs_left: Cell<usize>,
    /// Pairs that may still be predicted at all places.
    pub whole_left: Cell<usize>,
}

/// Places that exclude most pairs.
fn quick(model: ModelSolution) -> usize {
    if model == ModelSolution::Gouraud { 4 } else { 8 }
}

/// Places in the telling test scene that exclude most hypotheses: each has three vertices of its own.
fn coarse(model: ModelSolution) -> usize {
    if model == ModelSolution::Gouraud { 12 } else { 32 }
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

/// Places of all hypotheses that are predicted together.
const TOGETHER: usize = 2_048;
/// Most runs of pairs at few places.
pub(super) const MOST_PAIRS: usize = 120_000;
/// Most pairs that are predicted at all places.
pub(super) const MOST_WHOLE: usize = 240;
/// Most single mistakes that resemble a picture at few places.
const MOST_LIKE_ONE: usize = 40;
/// Brightness that no 8-bit picture shows.
const DARKEST: f32 = 0.002;
/// Brightness that pictures may have limited to 1.
const WHITE: f32 = 0.999;
/// With more mistakes that explain a picture equally well, none is named.
const MOST_ALTERNATIVES: usize = 4;
/// Most sets of peculiarities with which pairs are tried.
const MOST_SETS_OF_PAIRS: usize = 8;

/// The peculiarity of a highlight by the half vector.
const HALF_VECTOR: &str = "specular-half-vector";

/// The result of single mistakes.
pub(crate) enum Singly {
    /// The mistakes, alternatives of each other; none if too many explain the picture.
    Explained(Vec<Explanation>),
    /// The model solutions that were tried, each with its sets of peculiarities, the likeliest first.
    Unexplained(Vec<(Candidate, Vec<Hypothesis>)>),
}

/// Whether no place has a brightness that an eye would see.
pub(super) fn is_black(seen: &Seen) -> bool {
    seen.colour.numbers.iter().all(|x| x.is_nan() || x.abs() < DARKEST)
}

/// Whether all places have the same colour on the screen, as in the branch for another kind of object.
pub(super) fn is_flat(seen: &Seen) -> bool {
    planes(&seen.colour).iter().all(|plane| {
        let finite = || plane.iter().filter(|x| x.is_finite()).map(|x| x.clamp(0.0, 1.0));
        let (least, most) = (finite().fold(f32::INFINITY, f32::min), finite().fold(f32::NEG_INFINITY, f32::max));
        most - least <= 0.01 * most.abs().max(0.1)
    })
}

/// The explanations of the fewest mistakes and peculiarities; none if there are too many.
fn simplest(mut found: Vec<Explanation>) -> Vec<Explanation> {
    let size = |explanation: &Explanation| (explanation.mistakes.len(), explanation.peculiarities);
    let least = found.iter().map(size).min();
    found.retain(|explanation| Some(size(explanation)) == least);
    // Too many mistakes explain a black picture.
    let first = |explanation: &Explanation| explanation.mistakes.first().map(|mistake| mistake.id.as_str());
    let distinct: BTreeSet<&str> = found.iter().filter_map(first).collect();
    if distinct.len() > MOST_ALTERNATIVES { Vec::new() } else { found }
}

/// Single mistakes that are tried one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Which {
    /// Those whose own wrong values the program has, and no right values instead.
    Suspects,
    /// Others that no right value contradicts.
    Allowed,
    /// All others: the right value may be computed and not used.
    Others,
}

/// A mistake that may be one of two.
struct WrongOfPair<'a> {
    hypothesis: &'a Hypothesis,
    /// Whether it changes positions on the screen.
    moves: bool,
    /// Whether the program has its own wrong value.
    is_suspect: bool,
}

/// A model solution with predictions at few and at all places.
pub(crate) struct Candidate {
    method: LightingMethod,
    shown: Rc<Shown>,
    coarse: AtFew,
    fine: Predictor,
}

/// Predictions at few places of the telling test scene.
struct AtFew {
    predictor: Predictor,
    seen: Planes,
    clip: Values,
}

impl AtFew {
    fn new(
        of: &Explainer<'_>,
        all: &Rc<AllHypotheses>,
        (space, lights): (Space, Lights),
        seen: &Seen,
        count: usize,
    ) -> Result<Self, String> {
        let whole = planes(&seen.colour);
        // A mistake with the second light shows where it shines.
        let is_told = |scene: &TestScene| lights != Lights::WrongInSecond || scene.other.is_some();
        let (scene, places) = telling(of.scenes, is_told, &whole, count).ok_or("no test scene")?;
        let first: usize = of.scenes[..scene].iter().map(|(_, samples)| samples.places.len()).sum();
        let first_vertex: usize = of.scenes[..scene].iter().map(|(_, samples)| samples.vertices()).sum();
        let (raw, samples) = &of.scenes[scene];
        let (some, vertices) = samples.some(&places);
        let clip = vertices.iter().flat_map(|vertex| seen.clip.at(first_vertex + vertex)).copied().collect();
        Ok(AtFew {
            seen: whole.map(|plane| places.iter().map(|place| plane[first + place]).collect()),
            clip: Values::new(4, clip),
            predictor: Predictor::new(all.clone(), lights, of.parameterisation, space, [(raw.clone(), some)]),
        })
    }

    /// The cost of one hypothesis: the places at which it is predicted, once for each light and open strength.
    fn cost(&self) -> usize {
        (1 + self.predictor.open().len()) * self.predictor.lights.each().len() * self.predictor.places(0)
    }

    /// For each hypothesis, the share of these places that it draws otherwise, and whether it may be right.
    fn resemble(&self, hypotheses: &[&Hypothesis]) -> Vec<(f32, bool)> {
        let mut found = vec![(1.0_f32, false); hypotheses.len()];
        for sum in [Sum::Terms, Sum::Whole] {
            let have: Vec<usize> =
                (0..hypotheses.len()).filter(|at| self.predictor.sums(hypotheses[*at]).contains(&sum)).collect();
            for chunk in have.chunks((TOGETHER / self.predictor.places(0).max(1)).max(1)) {
                let chosen: Vec<&Hypothesis> = chunk.iter().map(|at| hypotheses[*at]).collect();
                for (at, predicted) in chunk.iter().zip(self.predictor.predict_each(0, &chosen, sum)) {
                    let scenes = [&predicted];
                    let fit = Fit::new(&self.seen, self.predictor.places(0), &scenes);
                    let may_be = fit.is_right_at_few() && is_in_place(&self.clip, &scenes);
                    let known = &mut found[*at];
                    *known = (known.0.min(fit.share), known.1 || may_be);
                }
            }
        }
        found
    }
}

impl Candidate {
    fn new(of: &Explainer<'_>, method: LightingMethod, lights: Lights, seen: &Seen) -> Result<Self, String> {
        let LightingMethod { model, space } = method;
        let all = of.solutions.get(model)?;
        let fine = of.scenes.iter().cloned();
        Ok(Candidate {
            coarse: AtFew::new(of, &all, (space, lights), seen, coarse(model))?,
            fine: Predictor::new(all, lights, of.parameterisation, space, fine),
            shown: (of.shown)(method)?,
            method,
        })
    }

    /// Whether a hypothesis draws every scene at all places; returns the fitted strengths.
    fn draws(&self, seen: &Seen, hypothesis: &Hypothesis, required: [bool; 3]) -> Option<Strengths> {
        let whole = planes(&seen.colour);
        // A mistake in a term may take its light away.
        let all = &self.fine.all.hypotheses.mistakes;
        let is_of =
            |term: usize| hypothesis.mistakes.iter().any(|mistake| term_of(&all[*mistake].id) == Some(TERMS[term]));
        let required: [bool; 3] = std::array::from_fn(|term| required[term] && !is_of(term));
        self.fine.sums(hypothesis).iter().find_map(|sum| {
            let mut all: Vec<Predicted> = Vec::new();
            let mut count = 0;
            for scene in 0..self.fine.scenes() {
                all.push(self.fine.predict(scene, hypothesis, *sum));
                count += self.fine.places(scene);
                let scenes: Vec<&Predicted> = all.iter().collect();
                let fit = Fit::new(&whole, count, &scenes);
                let is_last = scene + 1 == self.fine.scenes();
                let may_be = if is_last { fit.is_right(required) } else { fit.is_right_at_few() };
                if !may_be || is_last && !is_in_place(&seen.clip, &scenes) {
                    return None;
                }
                if is_last {
                    return Some(fit.strengths);
                }
            }
            None
        })
    }

    /// The peculiarities of right answers that may be combined: each set as a hypothesis, small sets first.
    fn peculiarities(&self, is_likely: &dyn Fn(&str) -> bool) -> Vec<Hypothesis> {
        let all = &self.fine.all.hypotheses;
        let is_peculiar = |single: &&Hypothesis| {
            single.mistakes.iter().all(|mistake| {
                let mistake = all.mistakes[*mistake];
                mistake.harmless
                    && is_likely(&mistake.id)
                    && (mistake.id != HALF_VECTOR || self.shown.half_vector() != Some(false))
            })
        };
        let mut sets = vec![Hypothesis::default()];
        for single in all.singles.iter().filter(is_peculiar) {
            let more: Vec<Hypothesis> = sets.iter().filter_map(|set| set.and(single)).collect();
            sets.extend(more);
        }
        if self.shown.half_vector() == Some(true) {
            let has_it = |set: &Hypothesis| set.mistakes.iter().any(|mistake| all.mistakes[*mistake].id == HALF_VECTOR);
            sets.retain(has_it);
        }
        sets.sort_by_key(|set| set.mistakes.len());
        sets
    }

    /// The explanation by a hypothesis, if it draws what is seen.
    fn explanation(&self, seen: &Seen, hypothesis: &Hypothesis, required: [bool; 3]) -> Option<Explanation> {
        let strengths = self.draws(seen, hypothesis, required)?;
        let mistakes = hypothesis.mistakes.iter().map(|mistake| self.fine.all.hypotheses.mistakes[*mistake]);
        let (harmless, mut mistakes): (Vec<_>, Vec<_>) = mistakes.partition(|mistake| mistake.harmless);
        // A light that is used in place of the other one is not missing besides.
        let all = &self.fine.all.hypotheses;
        let is_of_other = |line: &usize| {
            all.text_of(&all.variables[*line], hypothesis).is_some_and(|text| text.contains("other_light_pos"))
        };
        if !hypothesis.choices.keys().any(is_of_other) {
            mistakes.extend(self.fine.lights.mistake().and_then(crate::mistakes::find));
        }
        let has = |id: &str| harmless.iter().any(|mistake| mistake.id == id);
        let method = AnswerMethod {
            model: self.method.model,
            normal_kept: has("normal-kept-unnormalised"),
            half_vector: has("specular-half-vector"),
            highlight: Highlight {
                gated: has("specular-gated"),
                weighted: has("specular-cosine-weighted"),
                uncoloured: match () {
                    () if has("specular-not-coloured") => Uncoloured::Specular,
                    () if has(OWN_AMBIENT[0]) => Uncoloured::Ambient,
                    () if has(OWN_AMBIENT[1]) => Uncoloured::AmbientAndSpecular,
                    () => Uncoloured::None,
                },
            },
        };
        Some(Explanation {
            method,
            strengths,
            lights: self.fine.lights,
            space: self.method.space,
            mistakes,
            hypothesis: hypothesis.clone(),
            peculiarities: harmless.len(),
        })
    }
}

impl Explainer<'_> {
    /// Explains a picture by single mistakes. All explanations are of the fewest peculiarities.
    ///
    /// # Errors
    /// The interpreter cannot run gonio's own shaders; a test ensures that it can.
    pub fn singly(&self, seen: &Seen) -> Result<Singly, String> {
        // Too many mistakes explain a black picture.
        if is_black(seen) {
            return Ok(Singly::Unexplained(Vec::new()));
        }
        let mut found: Vec<Explanation> = Vec::new();
        let mut unexplained = Vec::new();
        for method in self.methods {
            for lights in self.parameterisation.right_lights() {
                unexplained.push(Candidate::new(self, *method, *lights, seen)?);
            }
        }
        // Right values exclude most mistakes, unless they are computed and not used.
        let mut sets_of: Vec<Vec<Hypothesis>> = Vec::new();
        for which in [Which::Suspects, Which::Allowed, Which::Others] {
            if found.is_empty() {
                let sets = unexplained.iter().map(|one| self.singles(one, which, seen, &mut found)).collect();
                if which == Which::Allowed {
                    sets_of = sets;
                }
            }
        }
        let unexplained: Vec<(Candidate, Vec<Hypothesis>)> = unexplained.into_iter().zip(sets_of).collect();
        for method in self.methods {
            if !found.is_empty() {
                break;
            }
            for lights in self.parameterisation.wrong_lights() {
                let candidate = Candidate::new(self, *method, *lights, seen)?;
                match lights.mistake().is_some() {
                    true => {
                        let sets = candidate.peculiarities(self.is_likely);
                        found.extend(sets.iter().find_map(|set| candidate.explanation(seen, set, self.required)));
                    }
                    false => {
                        for which in [Which::Suspects, Which::Allowed, Which::Others] {
                            if found.is_empty() {
                                self.singles(&candidate, which, seen, &mut found);
                            }
                        }
                    }
                }
            }
        }
        Ok(match found.is_empty() {
            true => Singly::Unexplained(unexplained),
            false => Singly::Explained(simplest(found)),
        })
    }

    /// Explains a picture by two mistakes.
    ///
    /// # Errors
    /// There is no test scene.
    pub fn by_pairs(
        &self,
        unexplained: &[(Candidate, Vec<Hypothesis>)],
        seen: &Seen,
    ) -> Result<Vec<Explanation>, String> {
        let mut found = Vec::new();
        // One of two mistakes shows its own wrong value, unless it is computed from the other's.
        for must_be_suspect in [true, false] {
            for (candidate, sets) in unexplained.iter().take(if must_be_suspect { usize::MAX } else { 1 }) {
                let quick = candidate.at_fewest(self, seen)?;
                let wrong = candidate.wrong_of_pairs();
                // An ambient light in its own colour is rare beside two mistakes, and doubles the sets.
                let usual = sets.iter().filter(|set| !candidate.has_own_ambient(set));
                for set in usual.take(if must_be_suspect { MOST_SETS_OF_PAIRS } else { 1 }) {
                    self.pairs((candidate, &quick, &wrong), set, seen, must_be_suspect, &mut found);
                }
            }
            if !found.is_empty() {
                break;
            }
        }
        // A mistake beside a light that is missing.
        for method in self.methods {
            for lights in
                self.parameterisation.wrong_lights().iter().copied().filter(|lights| lights.mistake().is_some())
            {
                let candidate = Candidate::new(self, *method, lights, seen)?;
                for which in [Which::Suspects, Which::Allowed] {
                    if found.is_empty() {
                        self.singles(&candidate, which, seen, &mut found);
                    }
                }
            }
        }
        Ok(simplest(found))
    }

    /// Adds the single mistakes that explain a picture. Returns the sets of peculiarities, those first that some mistake
    /// brings nearest to the picture.
    fn singles(
        &self,
        candidate: &Candidate,
        which: Which,
        seen: &Seen,
        found: &mut Vec<Explanation>,
    ) -> Vec<Hypothesis> {
        let mut sets = Vec::new();
        for set in candidate.peculiarities(self.is_likely) {
            if found.iter().any(|known| known.peculiarities < set.mistakes.len()) {
                break;
            }
            let here = candidate.wrong().filter(|single| candidate.which(single) == which);
            let both: Vec<Hypothesis> = here.filter_map(|single| set.and(single)).collect();
            let cost = both.len() * candidate.coarse.cost();
            if !self.budget.take(cost) {
                break;
            }
            let all: Vec<&Hypothesis> = both.iter().collect();
            let mut least = 1.0_f32;
            let resemblance = candidate.coarse.resemble(&all);
            // A picture that is dark at all these places resembles those of most mistakes.
            let is_telling = resemblance.iter().filter(|(_, may_be)| *may_be).count() <= MOST_LIKE_ONE;
            for (hypothesis, (share, may_be)) in both.iter().zip(resemblance) {
                least = least.min(share);
                if may_be && is_telling {
                    found.extend(candidate.explanation(seen, hypothesis, self.required));
                }
            }
            sets.push((least, set));
        }
        sets.sort_by(|a, b| a.0.total_cmp(&b.0));
        sets.into_iter().map(|(_, set)| set).collect()
    }

    /// Adds the pairs of mistakes that explain a picture.
    fn pairs(
        &self,
        (candidate, quick, wrong): (&Candidate, &AtFew, &[WrongOfPair<'_>]),
        set: &Hypothesis,
        seen: &Seen,
        must_be_suspect: bool,
        found: &mut Vec<Explanation>,
    ) {
        let right = candidate.coarse.predictor.predict(0, set, Sum::Terms);
        let is_moved = !is_in_place(&candidate.coarse.clip, &[&right]);
        let mut pairs = Vec::new();
        for (at, first) in wrong.iter().enumerate() {
            let Some(one) = set.and(first.hypothesis) else { continue };
            for second in &wrong[at + 1..] {
                let may_be = (first.moves || second.moves) == is_moved
                    && (!must_be_suspect || first.is_suspect || second.is_suspect);
                if may_be {
                    pairs.extend(one.and(second.hypothesis));
                }
            }
        }
        // Each open strength is one more run.
        let runs = 1 + self.parameterisation.to_find.iter().filter(|is_open| **is_open).count();
        let mut left: Vec<&Hypothesis> = pairs.iter().collect();
        for at in [quick, &candidate.coarse] {
            // More places cost more.
            let vertices = if candidate.method.model == ModelSolution::Gouraud { 3 } else { 1 };
            let cost = vertices * runs * at.predictor.places(0) / quick.predictor.places(0);
            left.truncate(self.pairs_left.get() / cost);
            self.pairs_left.set(self.pairs_left.get() - left.len() * cost);
            let found = at.resemble(&left);
            left = left.into_iter().zip(found).filter(|(_, (_, may_be))| *may_be).map(|(pair, _)| pair).collect();
        }
        for hypothesis in left.into_iter().take(self.whole_left.get()) {
            self.whole_left.set(self.whole_left.get() - 1);
            let Some(pair) = candidate.explanation(seen, hypothesis, self.required) else { continue };
            // One of them alone may have the same picture, because it takes away a whole term.
            let is_part =
                |one: &Hypothesis| one.choices.iter().all(|(line, way)| hypothesis.choices.get(line) == Some(way));
            let alone = wrong.iter().filter_map(|single| set.and(single.hypothesis)).filter(is_part);
            let alone: Vec<Explanation> =
                alone.filter_map(|single| candidate.explanation(seen, &single, [false; 3])).collect();
            if !alone.is_empty() {
                found.extend(alone);
                continue;
            }
            found.push(pair);
        }
    }
}

impl Candidate {
    /// Predictions at the places that exclude most pairs.
    fn at_fewest(&self, of: &Explainer<'_>, seen: &Seen) -> Result<AtFew, String> {
        let LightingMethod { model, space } = self.method;
        AtFew::new(of, &self.fine.all, (space, self.fine.lights), seen, quick(model))
    }

    /// Whether the ambient light has a colour of its own in a set of peculiarities.
    fn has_own_ambient(&self, set: &Hypothesis) -> bool {
        let all = &self.fine.all.hypotheses;
        set.mistakes.iter().any(|mistake| OWN_AMBIENT.contains(&all.mistakes[*mistake].id.as_str()))
    }

    /// The mistakes that may be one of two.
    fn wrong_of_pairs(&self) -> Vec<WrongOfPair<'_>> {
        let all = &self.fine.all.hypotheses;
        let right = self.coarse.predictor.predict(0, &Hypothesis::default(), Sum::Terms);
        let moves = |predicted: &Predicted| {
            !is_in_place(&Values::new(4, predicted.clip.iter().flatten().copied().collect()), &[&right])
        };
        let is_suspect =
            |single: &Hypothesis| single.mistakes.iter().any(|mistake| self.shown.is_suspect(all.mistakes[*mistake]));
        let here: Vec<&Hypothesis> = self.wrong().collect();
        let predicted = self.coarse.predictor.predict_each(0, &here, Sum::Terms);
        let all = here.into_iter().zip(&predicted);
        all.map(|(hypothesis, predicted)| WrongOfPair {
            hypothesis,
            moves: moves(predicted),
            is_suspect: is_suspect(hypothesis),
        })
        .collect()
    }

    /// How likely a single mistake is.
    fn which(&self, single: &Hypothesis) -> Which {
        let all = &self.fine.all.hypotheses;
        // What is missing has no value of its own.
        let is_shown = |mistake: &Mistake| mistake.id.ends_with("-missing") || self.shown.is_suspect(mistake);
        let is_suspect = || single.mistakes.iter().any(|mistake| is_shown(all.mistakes[*mistake]));
        match self.allows(single) {
            false => Which::Others,
            true if is_suspect() => Which::Suspects,
            true => Which::Allowed,
        }
    }

    /// Whether no right value of the program contradicts a mistake.
    fn allows(&self, single: &Hypothesis) -> bool {
        self.shown.allows(&self.fine.all.hypotheses, single)
    }

    /// The single mistakes.
    fn wrong(&self) -> impl Iterator<Item = &Hypothesis> {
        let all = &self.fine.all.hypotheses;
        // A strength that is fitted cannot be missing.
        let is_fitted =
            move |id: &str| self.fine.open().iter().any(|term| id == format!("{}-strength-missing", TERMS[*term]));
        let is_wrong = move |single: &&Hypothesis| {
            single
                .mistakes
                .iter()
                .all(|mistake| !all.mistakes[*mistake].harmless && !is_fitted(&all.mistakes[*mistake].id))
        };
        all.singles.iter().filter(is_wrong)
    }
}
