//! Explains a wrong picture: the mistakes of the catalogue with which a model solution computes the same colours and
//! positions at every place of every test scene.

use super::answer::LightingMethod;
use super::budget::Budget;
use super::candidate::{Candidate, Which, WrongOfPair};
use super::explanation::{Explanation, simplest};
use super::few_places::{AtFew, coarse, few, is_black, is_white, quick};
use super::prediction::{Predictor, Sum};
use super::samples::SceneSamples;
use super::shown::Shown;
use super::solutions::ModelSolutions;
use super::target::{Seen, is_in_place};
use crate::comparison::{Lights, Parameterisation};
use crate::mistakes::Hypothesis;
use crate::testbench::TestScene;
use gonio_threads::prelude::*;
use std::cell::Cell;
use std::sync::Arc;

/// What a program may assume.
pub(crate) struct Explainer<'a> {
    /// The model solutions.
    pub solutions: &'a ModelSolutions,
    /// The methods, the likeliest first.
    pub methods: &'a [LightingMethod],
    /// The quantities that the program computes, compared with a method.
    pub shown: &'a dyn Fn(LightingMethod) -> Result<Arc<Shown>, String>,
    /// Whether a peculiarity of right answers may be that of the program.
    pub is_likely: &'a dyn Fn(&str) -> bool,
    /// The parameterisation of the program.
    pub parameterisation: &'a Parameterisation,
    /// The terms that are required.
    pub required: [bool; 3],
    /// The mistake that the program makes in any case, as its text shows.
    pub certain: Option<&'static str>,
    /// The test scenes, and the points with the inputs of the program.
    pub scenes: &'a [(TestScene, SceneSamples)],
    /// Single mistakes that may still be predicted, with all roles together.
    pub budget: &'a Budget,
    /// Pairs that may still be predicted at few places. Each set of roles has its own: those with wrong roles would leave
    /// none for the right ones.
    pub pairs_left: Cell<usize>,
    /// Pairs of the same number of suspects that may still be predicted at all places.
    pub whole_left: Cell<usize>,
}

/// Most runs of pairs at few places.
pub(super) const MOST_PAIRS: usize = 120_000;
/// Most pairs of the same number of suspects that are predicted at all places.
pub(super) const MOST_WHOLE: usize = 240;
/// Most single mistakes that resemble a picture at few places.
const MOST_LIKE_ONE: usize = 40;
/// Most pairs with one set of peculiarities that are predicted at more places, once few places have excluded the others.
const MOST_COARSE: usize = 500;
/// How many of two mistakes have their own wrong values in the program, and with how many model solutions and sets of
/// peculiarities such pairs are tried. The first are few, and the likeliest.
const SUSPECTS_OF_PAIRS: [(usize, usize, usize); 3] = [(2, usize::MAX, usize::MAX), (1, usize::MAX, 8), (0, 1, 2)];

/// The order in which single mistakes are tried.
const WHICH: [Which; 3] = [Which::Suspects, Which::Allowed, Which::Others];

/// A model solution that was tried, with its sets of peculiarities, the likeliest first.
pub(super) type TriedModel = (Candidate, Vec<Hypothesis>);

/// The result of single mistakes.
pub(crate) enum Singly {
    /// The mistakes, alternatives of each other; none if too many explain the picture.
    Explained(Vec<Explanation>),
    /// The model solutions that were tried.
    Unexplained(Vec<TriedModel>),
}

impl Explainer<'_> {
    fn candidate(&self, method: LightingMethod, lights: Lights, seen: &Seen) -> Result<Candidate, String> {
        let all = self.solutions.get(method.model)?;
        let fine = Predictor::new(all, lights, self.parameterisation, method.space, self.scenes.iter().cloned());
        let at = |count| AtFew::new(self.scenes, self.parameterisation, (&fine, method.space), seen, count);
        let (few, coarse) = (at(few(method.model))?, at(coarse(method.model))?);
        Ok(Candidate { method, shown: (self.shown)(method)?, few, coarse, fine })
    }

    /// Predictions at the places that exclude most pairs.
    fn at_fewest(&self, candidate: &Candidate, seen: &Seen) -> Result<AtFew, String> {
        let LightingMethod { model, space } = candidate.method;
        AtFew::new(
            self.scenes,
            self.parameterisation,
            (&candidate.fine, space),
            seen,
            quick(model, candidate.fine.open().len()),
        )
    }

    /// Explains a picture by single mistakes. All explanations are of the fewest peculiarities.
    ///
    /// # Errors
    /// The interpreter cannot run gonio's own shaders; a test ensures that it can.
    pub fn singly(&self, seen: &Seen) -> Result<Singly, String> {
        // Too many mistakes explain a black picture, and with open strengths a white one.
        if is_black(seen) || is_white(seen) {
            return self.by_evidence(seen);
        }
        let mut found: Vec<Explanation> = Vec::new();
        let mut unexplained = Vec::new();
        for method in self.methods {
            for lights in self.parameterisation.right_lights() {
                unexplained.push(self.candidate(*method, *lights, seen)?);
            }
        }
        // Right values exclude most mistakes, unless they are computed and not used.
        let mut sets_of: Vec<Vec<Hypothesis>> = Vec::new();
        for which in WHICH {
            if found.is_empty() {
                let sets = unexplained.iter().map(|one| self.singles(one, which, None, seen, &mut found)).collect();
                if which == Which::Allowed {
                    sets_of = sets;
                }
            }
        }
        let unexplained: Vec<TriedModel> = unexplained.into_iter().zip(sets_of).collect();
        for method in self.methods {
            if !found.is_empty() {
                break;
            }
            for lights in self.parameterisation.wrong_lights() {
                let candidate = self.candidate(*method, *lights, seen)?;
                match lights.mistake().is_some() {
                    true => {
                        let sets = candidate.peculiarities(self.is_likely);
                        found.extend(sets.iter().find_map(|set| candidate.explanation(seen, set, self.required)));
                    }
                    false => {
                        for which in WHICH {
                            if found.is_empty() {
                                self.singles(&candidate, which, None, seen, &mut found);
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

    /// Explains a black or white picture by single mistakes that make it so and whose own wrong values the program computes; a
    /// white one else by those whose own wrong values are constants.
    fn by_evidence(&self, seen: &Seen) -> Result<Singly, String> {
        let mut candidates = Vec::new();
        for method in self.methods {
            for lights in self.parameterisation.right_lights() {
                candidates.push(self.candidate(*method, *lights, seen)?);
            }
        }
        let mut found = self.making_blank(&candidates, seen, Candidate::is_evident);
        let is_drawn = || seen.colour.numbers.iter().all(|x| x.is_finite());
        if found.is_empty() && is_white(seen) && is_drawn() {
            found =
                self.making_blank(&candidates, seen, |candidate, single| candidate.which(single) == Which::Suspects);
        }
        let found = simplest(found);
        Ok(if found.is_empty() { Singly::Unexplained(Vec::new()) } else { Singly::Explained(found) })
    }

    /// The mistakes among some that make a picture black or white.
    fn making_blank(
        &self,
        candidates: &[Candidate],
        seen: &Seen,
        is_asked: impl Fn(&Candidate, &Hypothesis) -> bool,
    ) -> Vec<Explanation> {
        let is_white = is_white(seen);
        // A white picture does not tell how strong the light is.
        let required = self.required.map(|is_required| [if is_required { 1.0 } else { 0.0 }; 3]);
        let mut found = Vec::new();
        for candidate in candidates {
            let is_open = |term: usize| candidate.fine.open().contains(&term);
            let strengths = std::array::from_fn(|term| is_open(term).then_some(required[term]));
            let asked: Vec<&Hypothesis> = candidate.wrong().filter(|single| is_asked(candidate, single)).collect();
            for set in candidate.peculiarities(self.is_likely) {
                let makes_white = |both: &Hypothesis| {
                    candidate.is_white(both, self.required) && !candidate.is_white(&set, self.required)
                };
                let both = asked.iter().filter_map(|single| set.and(single));
                found.extend(both.filter_map(|both| {
                    match is_white {
                        true => (makes_white(&both) && candidate.is_in_place(seen, &both))
                            .then(|| candidate.explained(&both, strengths)),
                        false => {
                            candidate.is_black(&both, self.required).then(|| candidate.explained(&both, [None; 3]))
                        }
                    }
                }));
                if !found.is_empty() {
                    break;
                }
            }
        }
        found
    }

    /// Explains a picture by two mistakes, or by one or two beside the one that is certain.
    ///
    /// # Errors
    /// There is no test scene.
    pub fn by_pairs(&self, unexplained: &[TriedModel], seen: &Seen) -> Result<Vec<Explanation>, String> {
        let mut found = Vec::new();
        let certain: Vec<Option<Hypothesis>> = unexplained.iter().map(|(one, _)| self.certain_of(one)).collect();
        for which in WHICH {
            for ((candidate, _), certain) in unexplained.iter().zip(&certain) {
                if let (true, Some(certain)) = (found.is_empty(), certain) {
                    self.singles(candidate, which, Some(certain), seen, &mut found);
                }
            }
        }
        if !found.is_empty() {
            return Ok(simplest(found));
        }
        let beside_certain = |((_, sets), certain): (&TriedModel, &Option<Hypothesis>)| -> Vec<Hypothesis> {
            let Some(certain) = certain else { return sets.clone() };
            sets.iter().filter_map(|set| set.and(certain)).collect()
        };
        let sets: Vec<Vec<Hypothesis>> = unexplained.iter().zip(&certain).map(beside_certain).collect();
        let candidates: Vec<(&Candidate, &[Hypothesis], AtFew, Vec<WrongOfPair<'_>>)> = unexplained
            .iter()
            .zip(&sets)
            .map(|((one, _), sets)| Ok((one, sets.as_slice(), self.at_fewest(one, seen)?, one.wrong_of_pairs())))
            .collect::<Result<_, String>>()?;
        // Most mistakes show their own wrong values, unless these are computed from the other's.
        for (suspects, most_candidates, most_sets) in SUSPECTS_OF_PAIRS {
            // Beside what is found, only alternatives that are as simple.
            let fewest = found.iter().map(|explanation: &Explanation| explanation.peculiarities).min();
            if suspects == 0 && fewest.is_some() {
                break;
            }
            // Where few places tell little, the pairs of two suspects would leave none for the others.
            self.whole_left.set(MOST_WHOLE);
            let may_be = |set: &&Hypothesis| fewest.is_none_or(|fewest| set.mistakes.len() <= fewest);
            for (candidate, sets, quick, wrong) in candidates.iter().take(most_candidates) {
                // An ambient light in its own colour is rare beside two mistakes, and doubles the sets.
                let usual = sets.iter().filter(|set| !candidate.has_own_ambient(set));
                for set in usual.take(most_sets).filter(may_be) {
                    self.pairs((candidate, quick, wrong), set, seen, suspects, &mut found);
                }
            }
        }
        // A mistake beside a light that is missing.
        for method in self.methods {
            for lights in
                self.parameterisation.wrong_lights().iter().copied().filter(|lights| lights.mistake().is_some())
            {
                let candidate = self.candidate(*method, lights, seen)?;
                for which in [Which::Suspects, Which::Allowed] {
                    if found.is_empty() {
                        self.singles(&candidate, which, None, seen, &mut found);
                    }
                }
            }
        }
        Ok(simplest(found))
    }

    /// The mistake that is certain, in a model solution.
    fn certain_of(&self, candidate: &Candidate) -> Option<Hypothesis> {
        let all = &candidate.fine.all.hypotheses;
        let is_it = |single: &&Hypothesis| matches!(single.mistakes[..], [mistake] if Some(all.mistakes[mistake].id.as_str()) == self.certain);
        candidate.wrong().find(is_it).cloned()
    }

    /// Adds the single mistakes that explain a picture, beside another one if there is one for certain. Returns the sets of
    /// peculiarities, those first that some mistake brings nearest to the picture.
    fn singles(
        &self,
        candidate: &Candidate,
        which: Which,
        certain: Option<&Hypothesis>,
        seen: &Seen,
        found: &mut Vec<Explanation>,
    ) -> Vec<Hypothesis> {
        let mut sets = Vec::new();
        let here: Vec<&Hypothesis> = candidate.wrong().filter(|single| candidate.which(single) == which).collect();
        let mut all = candidate.peculiarities(self.is_likely);
        if let Some(certain) = certain {
            all = all.iter().filter_map(|set| set.and(certain)).collect();
        }
        // Sets of one size together: what they have in common is predicted once.
        for of_size in all.chunk_by(|a, b| a.mistakes.len() == b.mistakes.len()) {
            let size = of_size.first().map_or(0, |set| set.mistakes.len());
            if found.iter().any(|known| known.peculiarities < size) {
                break;
            }
            let mut tried: Vec<(usize, Hypothesis)> = Vec::new();
            let mut affordable = 0;
            for (at, set) in of_size.iter().enumerate() {
                let both: Vec<_> = here.iter().filter_map(|single| Some((at, set.and(single)?))).collect();
                if !self.budget.take(both.len() * candidate.few.cost()) {
                    break;
                }
                tried.extend(both);
                affordable = at + 1;
            }
            let both: Vec<&Hypothesis> = tried.iter().map(|(_, both)| both).collect();
            let mut least = vec![1.0_f32; affordable];
            let mut left: Vec<&(usize, Hypothesis)> = Vec::new();
            for (one, (share, may_be)) in tried.iter().zip(candidate.few.resemble(&both)) {
                least[one.0] = least[one.0].min(share);
                left.extend(may_be.then_some(one));
            }
            let both: Vec<&Hypothesis> = left.iter().map(|(_, both)| both).collect();
            let mut coarse: Vec<(f32, &(usize, Hypothesis))> = Vec::new();
            for (one, (share, may_be)) in left.into_iter().zip(candidate.coarse.resemble(&both)) {
                coarse.extend(may_be.then_some((share, one)));
            }
            for (at, set) in of_size.iter().enumerate().take(affordable) {
                let mut left: Vec<_> = coarse.iter().filter(|(_, (of, _))| *of == at).collect();
                // A picture that is dark at all these places resembles those of most mistakes.
                left.sort_by(|a, b| a.0.total_cmp(&b.0));
                let drawn = left.into_iter().take(MOST_LIKE_ONE).take_while(|_| self.budget.take_drawn());
                let drawn: Vec<&Hypothesis> = drawn.map(|(_, (_, one))| one).collect();
                found.extend(self.explanations(candidate, seen, &drawn).into_iter().flatten());
                sets.push((least[at], set.clone()));
            }
            if affordable < of_size.len() {
                break;
            }
        }
        sets.sort_by(|a, b| a.0.total_cmp(&b.0));
        sets.into_iter().map(|(_, set)| set).collect()
    }

    /// The explanation by each of several hypotheses, if it draws what is seen; computed on all cores.
    fn explanations(&self, candidate: &Candidate, seen: &Seen, all: &[&Hypothesis]) -> Vec<Option<Explanation>> {
        let required = self.required;
        all.par_iter().map(|one| candidate.explanation(seen, one, required)).collect()
    }

    /// Adds the pairs of mistakes that explain a picture.
    fn pairs(
        &self,
        (candidate, quick, wrong): (&Candidate, &AtFew, &[WrongOfPair<'_>]),
        set: &Hypothesis,
        seen: &Seen,
        suspects: usize,
        found: &mut Vec<Explanation>,
    ) {
        let right = candidate.coarse.predictor.predict(0, set, Sum::Terms);
        let is_moved = !is_in_place(&candidate.coarse.clip, &[&right]);
        let mut pairs = Vec::new();
        for (at, first) in wrong.iter().enumerate() {
            let Some(one) = set.and(first.hypothesis) else { continue };
            for second in &wrong[at + 1..] {
                let may_be = (first.moves || second.moves) == is_moved
                    && usize::from(first.is_suspect) + usize::from(second.is_suspect) == suspects;
                if may_be {
                    pairs.extend(one.and(second.hypothesis));
                }
            }
        }
        // Each open strength is one more run.
        let runs = 1 + self.parameterisation.to_find.iter().filter(|is_open| **is_open).count();
        let mut left: Vec<&Hypothesis> = pairs.iter().collect();
        // The few that are left deserve a second look, whatever is left for others.
        for (at, most) in [(quick, None), (&candidate.coarse, Some(MOST_COARSE))] {
            // More places cost more.
            let vertices = if candidate.method.model.is_per_vertex() { 3 } else { 1 };
            let cost = vertices * runs * at.predictor.places(0) / quick.predictor.places(0);
            left.truncate(most.unwrap_or(self.pairs_left.get() / cost));
            self.pairs_left.set(self.pairs_left.get().saturating_sub(left.len() * cost));
            let mut found: Vec<_> =
                left.iter().copied().zip(at.resemble(&left)).filter(|(_, (_, may_be))| *may_be).collect();
            // Those nearest to the picture first.
            found.sort_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
            left = found.into_iter().map(|(pair, _)| pair).collect();
        }
        left.truncate(self.whole_left.get());
        self.whole_left.set(self.whole_left.get() - left.len());
        for (hypothesis, explained) in left.iter().zip(self.explanations(candidate, seen, &left)) {
            let Some(pair) = explained else { continue };
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
