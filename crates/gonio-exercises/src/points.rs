//! Points for answers, as a teacher states them.

use gonio_check::verdict::{AwardedPoints, Outcome, TermState, Verdict};
use std::collections::BTreeMap;

/// The points of an exercise.
///
/// A right answer has all points; one that does not compile, or that could not be judged, has none. From a wrong one, two
/// deductions are computed, and the larger one counts, so that nothing is counted twice:
///
/// - for the mistakes: the points of each mistake that was named, or [`PointScheme::other_mistake`] for one without points of its own;
/// - for the terms: the points of each term that is wrong.
///
/// If neither applies, a wrong answer has the share of points that its verdict has: that of the right test scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct PointScheme {
    /// Points of a right answer; positive.
    pub total: f64,
    /// Points of each term: `ambient`, `diffuse`, `specular`.
    pub terms: BTreeMap<String, f64>,
    /// Points that each mistake costs, by its id.
    pub mistakes: BTreeMap<String, f64>,
    /// Points that any other mistake costs.
    pub other_mistake: Option<f64>,
}

impl PointScheme {
    /// Points for right answers alone, and the share of right test scenes for others.
    #[must_use]
    pub fn of_total(total: f64) -> Self {
        PointScheme { total, terms: BTreeMap::new(), mistakes: BTreeMap::new(), other_mistake: None }
    }

    /// The points of a whole verdict, before any part of it is hidden.
    #[must_use]
    pub fn award(&self, verdict: &Verdict) -> AwardedPoints {
        let earned = match verdict.verdict {
            Outcome::Correct => self.total,
            Outcome::DoesNotCompile | Outcome::Unsure => 0.0,
            Outcome::Wrong => self.of_wrong(verdict).clamp(0.0, self.total),
        };
        AwardedPoints { earned: (earned * 100.0).round() / 100.0, most: self.total }
    }

    fn of_wrong(&self, verdict: &Verdict) -> f64 {
        let mistakes = verdict.mistakes.iter().filter_map(|found| {
            let own = std::iter::once(&found.id).chain(&found.or).find_map(|id| self.mistakes.get(id));
            own.copied().or(self.other_mistake)
        });
        let terms = verdict.terms.iter().filter(|term| term.state == TermState::Wrong);
        let terms = terms.filter_map(|term| self.terms.get(term.term.as_ref()).copied());
        let (mistakes, terms): (Vec<f64>, Vec<f64>) = (mistakes.collect(), terms.collect());
        if mistakes.is_empty() && terms.is_empty() {
            return verdict.score * self.total;
        }
        self.total - mistakes.iter().sum::<f64>().max(terms.iter().sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_check::verdict::{FoundMistake, TermVerdict};

    fn scheme() -> PointScheme {
        PointScheme {
            terms: [("diffuse".to_owned(), 8.0), ("specular".to_owned(), 6.0)].into(),
            mistakes: [("normal-by-model-matrix".to_owned(), 3.0)].into(),
            other_mistake: Some(5.0),
            ..PointScheme::of_total(20.0)
        }
    }

    fn wrong(mistakes: &[&str], terms: &[&'static str]) -> Verdict {
        let mut verdict = Verdict::new("blinn", Outcome::Wrong, "");
        verdict.score = 0.25;
        verdict.mistakes = mistakes.iter().map(|id| FoundMistake::new(*id, *id, 1.0)).collect();
        let term = |term: &&'static str| TermVerdict { term: (*term).into(), state: TermState::Wrong };
        verdict.terms = terms.iter().map(term).collect();
        verdict
    }

    fn earned(verdict: &Verdict) -> f64 {
        scheme().award(verdict).earned
    }

    #[test]
    fn the_larger_deduction_counts() {
        assert_eq!(earned(&wrong(&["normal-by-model-matrix"], &[])), 17.0);
        assert_eq!(earned(&wrong(&["normal-by-model-matrix"], &["diffuse"])), 12.0);
        assert_eq!(earned(&wrong(&["normal-by-model-matrix", "skewed"], &["specular"])), 12.0);
        assert_eq!(earned(&wrong(&[], &["diffuse", "specular", "ambient"])), 6.0);
    }

    #[test]
    fn a_mistake_has_the_points_of_one_that_no_picture_tells_from_it() {
        let mut verdict = wrong(&["skewed"], &[]);
        verdict.mistakes[0].or = vec!["normal-by-model-matrix".to_owned()];
        assert_eq!(earned(&verdict), 17.0);
    }

    #[test]
    fn points_are_neither_negative_nor_given_for_what_was_not_judged() {
        assert_eq!(earned(&wrong(&["a", "b", "c", "d", "e"], &[])), 0.0);
        assert_eq!(earned(&wrong(&[], &[])), 5.0, "the share of right test scenes");
        assert_eq!(earned(&Verdict::new("blinn", Outcome::Unsure, "")), 0.0);
        assert_eq!(earned(&Verdict::new("blinn", Outcome::DoesNotCompile, "")), 0.0);
        assert_eq!(earned(&Verdict::new("blinn", Outcome::Correct, "")), 20.0);
    }
}
