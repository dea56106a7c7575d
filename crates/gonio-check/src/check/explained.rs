//! The mistakes that explain a picture, at the lines where the program makes them.

use super::by_values::{Judging, placed, unlisted};
use crate::cause::explanation::Explanation;
use crate::cause::place::MistakePlace;
use crate::cause::proven_cause::ProvenCause;
use crate::cause::repair::Relation;
use crate::cause::{Diagnosis, is_absent};
use crate::mistakes::{Mistake, term_of};
use crate::verdict::FoundMistake;
use gonio_glsl::{Span, Stage};
use std::cmp::Reverse;

/// The mistake of terms that are computed and not added, which looks like one of them that is missing.
pub(super) const NOT_PUT_OUT: &str = "terms-not-put-out";

/// The explanation of a picture by mistakes, with what the values say about them.
#[derive(Clone, Copy)]
struct Explained<'a> {
    diagnosis: &'a Diagnosis,
    /// The likeliest explanation.
    first: &'a Explanation,
    /// Whether the light equation is a long formula.
    is_long: bool,
    /// The terms that the exercise asks for.
    required: [bool; 3],
}

impl Judging<'_> {
    /// The mistakes that explain the picture, at the lines of their causes.
    pub(super) fn explained(&self, diagnosis: &Diagnosis, groups: &[Vec<ProvenCause>]) -> Vec<FoundMistake> {
        let Some(first) = diagnosis.explanations.first() else { return Vec::new() };
        // A term that a mistake takes away is not missing besides.
        let is_explained = |missing: &FoundMistake| {
            let term = term_of(&missing.id);
            term.is_some() && first.mistakes.iter().any(|mistake| mistake.whole || term_of(&mistake.id) == term)
        };
        let mut found = self.beside_right_values(diagnosis);
        found.retain(|missing| !is_explained(missing));
        // A term that another vector brings back is not missing.
        if let ([mistake], [group]) = (first.mistakes.as_slice(), groups)
            && mistake.id.ends_with("-missing")
            && let Some(vector) = group.iter().find(|cause| cause.is_first_vector() && cause.mistakes.is_empty())
        {
            found.push(unlisted(vector, self.submission));
            return found;
        }
        let task = self.values.task;
        let explained = Explained { diagnosis, first, is_long: task.model.has_roughness(), required: task.required };
        let mut causes: Vec<&[ProvenCause]> =
            groups.iter().map(Vec::as_slice).filter(|group| !group.is_empty()).collect();
        for at in 0..first.mistakes.len() {
            let alternatives = explained.alternatives(at);
            let of_cause = |cause: &ProvenCause| -> Vec<&'static Mistake> {
                let shown = cause.mistakes.iter().take(1 + cause.equals).copied();
                shown.filter(|mistake| alternatives.iter().any(|other| other.id == mistake.id)).collect()
            };
            let group = causes.iter().position(|group| !of_cause(&group[0]).is_empty()).map(|at| causes.remove(at));
            // The alternative that the program itself shows, if it shows one.
            let mut shown = explained.by_values(group.map(|group| of_cause(&group[0])).unwrap_or_default());
            shown.extend(explained.by_values(alternatives.clone()));
            let Some((mistake, others)) = shown.split_first() else { continue };
            let mut or: Vec<String> = Vec::new();
            for other in others.iter().filter(|other| other.id != mistake.id) {
                if !or.contains(&other.id) {
                    or.push(other.id.clone());
                }
            }
            let new =
                FoundMistake { or, lab_does_it: mistake.lab_does_it, ..FoundMistake::from_catalogue(mistake, 1.0) };
            found.push(match explained.place(mistake, group, &causes) {
                Some(at) => placed(new, at, self.submission),
                None => new,
            });
        }
        found
    }
}

impl<'a> Explained<'a> {
    /// The mistakes that explain the picture as well as each other, by the number of the mistake in an explanation: those
    /// that need the fewest terms for which the exercise does not ask.
    fn alternatives(&self, at: usize) -> Vec<&'static Mistake> {
        let optional = |explanation: &Explanation| {
            let terms = explanation.strengths.iter().zip(self.required);
            terms.filter(|(strength, required)| !required && strength.is_some() && !is_absent(**strength)).count()
        };
        // A picture without any light needs none of them.
        let is_whole = |explanation: &Explanation| explanation.mistakes.iter().any(|mistake| mistake.whole);
        let all = &self.diagnosis.explanations;
        let fewest = all.iter().filter(|explanation| !is_whole(explanation)).map(optional).min();
        let best = all.iter().filter(|one| is_whole(one) || Some(optional(one)) == fewest);
        best.filter_map(|explanation| explanation.mistakes.get(at).copied()).collect()
    }

    /// Mistakes in the order in which the values show them: pictures do not tell some apart, but the wrong values may.
    fn by_values(&self, mut all: Vec<&'static Mistake>) -> Vec<&'static Mistake> {
        all.sort_by_key(|mistake| {
            let has_value = self.place_of(mistake).is_some_and(|place| place.is_direct);
            // What is computed earlier tells more than what is put out in the end.
            (mistake.id == NOT_PUT_OUT, !has_value, mistake.whole)
        });
        // An expression around that of another mistake has the value that counts: `abs(dot(N, L))`.
        if let [first, others @ ..] = all.as_slice()
            && let Some(outer) = others.iter().position(|other| self.is_around(other, first))
        {
            all.swap(0, outer + 1);
        }
        all
    }

    /// Where the values show a mistake.
    fn place_of(&self, mistake: &Mistake) -> Option<&'a MistakePlace> {
        let mut places = self.diagnosis.places.iter().filter(|place| place.mistake.id == mistake.id);
        match self.is_long {
            true => places.max_by_key(|place| (place.is_direct, Reverse(place.span.start))),
            false => places.next(),
        }
    }

    /// Whether the wrong value of a mistake is computed around that of another.
    fn is_around(&self, outer: &Mistake, inner: &Mistake) -> bool {
        let direct = |mistake| self.place_of(mistake).filter(|place| place.is_direct);
        let (Some(outer), Some(inner)) = (direct(outer), direct(inner)) else { return false };
        let (around, within) = (outer.span, inner.span);
        // Of two with the same value, the one that always has it.
        let is_as_telling = around != within || outer.mistake.change.len() < inner.mistake.change.len();
        outer.stage == inner.stage && around.start <= within.start && within.end <= around.end && is_as_telling
    }

    /// Where to say that a mistake is made: at its proven cause, or where the values show it. `others` are the causes that belong
    /// to no mistake.
    fn place(
        &self,
        mistake: &Mistake,
        group: Option<&[ProvenCause]>,
        others: &[&[ProvenCause]],
    ) -> Option<(Stage, Span)> {
        let is_single = self.first.mistakes.len() == 1;
        // A single cause is proven, whatever it is called.
        let only = others.first().and_then(|group| group.first()).filter(|_| is_single && others.len() == 1);
        let of_place = |place: &MistakePlace| (place.stage, place.span);
        let place = self.place_of(mistake);
        // The first that shows this mistake and no other one better.
        let is_of_mistake = |cause: &&ProvenCause| cause.mistakes.first().is_some_and(|first| first.id == mistake.id);
        let cause = group.and_then(|group| group.iter().find(is_of_mistake).or(group.first()));
        if let Some(place) = place.filter(|place| place.is_decisive) {
            return Some(of_place(place));
        }
        // An input stands where a variable's name asks for another one.
        if let Some(exchanged) = group.and_then(|group| group.iter().find(|cause| cause.is_against_name)) {
            return Some(exchanged.place());
        }
        if let Some(cause) = cause.filter(|cause| is_single && cause.is_input_for_input()) {
            return Some(cause.place());
        }
        if let (Some(spoilt), true) = (group.and_then(|group| group.iter().find_map(|c| c.spoilt_at)), is_single) {
            return Some(spoilt);
        }
        // A value that is right where it is computed is wrong where another variable is set to it.
        if let (Some(group), Some(place)) = (group, place) {
            let is_proven = group.iter().any(|cause| cause.stage == place.stage && cause.span == place.span);
            let is_copy = |cause: &&ProvenCause| {
                cause.stage == place.stage
                    && cause.distance == 0
                    && cause.is_read()
                    && cause.is_whole
                    && is_of_mistake(cause)
            };
            if let (false, Some(copy)) = (is_proven, group.iter().find(is_copy)) {
                return Some(copy.place());
            }
        }
        match (cause, place) {
            (Some(cause), Some(place)) if place.is_direct && self.is_at_place(cause, place) => Some(of_place(place)),
            // A right term is used wrongly where the sum is.
            (Some(cause), Some(place))
                if is_single && cause.is_right_term() && cause.distance > 0 && !place.is_direct =>
            {
                Some(of_place(place))
            }
            (Some(cause), _) => Some(cause.place()),
            (None, Some(place)) if !place.is_given || place.is_copy => Some(of_place(place)),
            (None, place) => only.map(ProvenCause::place).or(place.map(of_place)),
        }
    }

    /// Whether a mistake with a proven cause is made where the values show it. In a long formula, and beside another mistake, the
    /// proof is often a value that is computed from the mistake's own wrong value, or the only use of a variable that is set to
    /// it. Where the sum is wrong, it may be one of its terms.
    fn is_at_place(&self, cause: &ProvenCause, place: &MistakePlace) -> bool {
        // A vector that lacks its length, and a right term that lacks a factor, lack them where they are set.
        if (cause.is_given || cause.is_whole) && matches!(cause.relation, Relation::Length | Relation::Factor) {
            return false;
        }
        if self.first.mistakes.len() == 1 {
            let is_nearer = !place.is_given || cause.is_of_sum() || cause.is_read();
            return (self.is_long || place.is_sum || place.is_computed && is_nearer) && cause.distance > 0;
        }
        let is_same_stage = cause.stage == place.stage;
        // A variable or a varying is wrong where it is set.
        let is_read = is_same_stage && cause.is_only_read
            || place.is_copy && cause.is_given && (is_same_stage || place.stage == Stage::Vertex);
        // A sum lacks a factor of a right term.
        let is_sum_of_right = cause.distance == 1 && place.is_given;
        place.is_computed && (cause.distance > 0 && !is_sum_of_right || is_read)
    }
}
