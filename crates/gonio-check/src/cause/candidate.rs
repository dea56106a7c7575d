//! A model solution that may explain a picture, with the mistakes that may be made in it.

use super::answer::{AnswerMethod, Highlight, LightingMethod, OWN_AMBIENT, Uncoloured};
use super::explanation::{Explanation, Strengths};
use super::few_places::{AtFew, DARKEST};
use super::prediction::{Predicted, Predictor, Sum};
use super::shown::Shown;
use super::target::{Fit, Seen, SeenColours, is_in_place, planes};
use super::values::Values;
use crate::mistakes::{Hypothesis, Mistake, TERMS};
use std::sync::Arc;

/// The peculiarity of a highlight by the half vector.
const HALF_VECTOR: &str = "specular-half-vector";

/// Single mistakes that are tried one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    /// Those whose own wrong values the program has, and no right values instead.
    Suspects,
    /// Others that no right value contradicts.
    Allowed,
    /// All others: the right value may be computed and not used.
    Others,
}

/// A mistake that may be one of two.
pub(super) struct WrongOfPair<'a> {
    pub hypothesis: &'a Hypothesis,
    /// Whether it changes positions on the screen.
    pub moves: bool,
    /// Whether the program has its own wrong value.
    pub is_suspect: bool,
}

/// A model solution with predictions at few, at more and at all places.
pub(crate) struct Candidate {
    pub(super) method: LightingMethod,
    pub(super) shown: Arc<Shown>,
    pub(super) few: AtFew,
    pub(super) coarse: AtFew,
    pub(super) fine: Predictor,
}

impl Candidate {
    /// Whether a hypothesis draws every scene at all places; returns the fitted strengths.
    fn draws(&self, seen: &Seen, hypothesis: &Hypothesis, required: [bool; 3]) -> Option<Strengths> {
        let whole = SeenColours::new(planes(&seen.colour));
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
    pub(super) fn peculiarities(&self, is_likely: &dyn Fn(&str) -> bool) -> Vec<Hypothesis> {
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
            // Its sum may be there without a half vector: that is a mistake.
            if sets.iter().any(has_it) {
                sets.retain(has_it);
            }
        }
        sets.sort_by_key(|set| set.mistakes.len());
        sets
    }

    /// The explanation by a hypothesis, if it draws what is seen.
    pub(super) fn explanation(&self, seen: &Seen, hypothesis: &Hypothesis, required: [bool; 3]) -> Option<Explanation> {
        self.draws(seen, hypothesis, required).map(|strengths| self.explained(hypothesis, strengths))
    }

    /// Whether a hypothesis draws every scene at the places on the screen that are seen, in whatever colours.
    pub(super) fn is_in_place(&self, seen: &Seen, hypothesis: &Hypothesis) -> bool {
        let predict = |scene| self.fine.predict(scene, hypothesis, Sum::Terms);
        let all: Vec<Predicted> = (0..self.fine.scenes()).map(predict).collect();
        is_in_place(&seen.clip, &all.iter().collect::<Vec<_>>())
    }

    /// Whether a hypothesis takes all light of the required terms away, whatever their strengths.
    pub(super) fn is_black(&self, hypothesis: &Hypothesis, required: [bool; 3]) -> bool {
        (0..self.fine.scenes()).all(|scene| {
            let predicted = self.fine.predict(scene, hypothesis, Sum::Terms);
            let is_required = |term: &Option<usize>| term.is_none_or(|term| required[term]);
            let open = predicted.open.iter().filter(|(term, _)| is_required(term)).map(|(_, planes)| planes);
            open.chain([&predicted.known]).flatten().flatten().all(|x| x.is_nan() || *x < DARKEST)
        })
    }

    /// Whether the required terms alone make every place as bright as a screen can show, where their open strengths are 1:
    /// others that do so are strengths that nobody writes.
    pub(super) fn is_white(&self, hypothesis: &Hypothesis, required: [bool; 3]) -> bool {
        const WHITE: f32 = 0.999;
        (0..self.fine.scenes()).all(|scene| {
            let predicted = self.fine.predict(scene, hypothesis, Sum::Terms);
            let is_required = |term: Option<usize>| term.is_none_or(|term| required[term]);
            let open = || predicted.open.iter().filter(|(term, _)| is_required(*term)).map(|(_, planes)| planes);
            predicted.known.iter().enumerate().all(|(channel, known)| {
                let sum = |(place, known): (usize, &f32)| known + open().map(|one| one[channel][place]).sum::<f32>();
                known.iter().enumerate().map(sum).all(|sum| !sum.is_finite() || sum >= WHITE)
            })
        })
    }

    /// The explanation by a hypothesis that draws what is seen.
    pub(super) fn explained(&self, hypothesis: &Hypothesis, strengths: Strengths) -> Explanation {
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
        Explanation {
            method,
            strengths,
            lights: self.fine.lights,
            space: self.method.space,
            mistakes,
            hypothesis: hypothesis.clone(),
            peculiarities: harmless.len(),
        }
    }

    /// Whether the ambient light has a colour of its own in a set of peculiarities.
    pub(super) fn has_own_ambient(&self, set: &Hypothesis) -> bool {
        let all = &self.fine.all.hypotheses;
        set.mistakes.iter().any(|mistake| OWN_AMBIENT.contains(&all.mistakes[*mistake].id.as_str()))
    }

    /// The mistakes that may be one of two.
    pub(super) fn wrong_of_pairs(&self) -> Vec<WrongOfPair<'_>> {
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

    /// Whether the program has the own wrong value of a single mistake, which no input has, and no right value instead.
    pub(super) fn is_evident(&self, single: &Hypothesis) -> bool {
        let all = &self.fine.all.hypotheses;
        self.allows(single) && single.mistakes.iter().any(|mistake| self.shown.is_evident(all.mistakes[*mistake]))
    }

    /// How likely a single mistake is.
    pub(super) fn which(&self, single: &Hypothesis) -> Which {
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
    pub(super) fn wrong(&self) -> impl Iterator<Item = &Hypothesis> {
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
