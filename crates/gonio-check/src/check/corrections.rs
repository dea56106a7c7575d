//! Corrections of a verdict: blank pictures, and the terms that a mistake concerns.

use crate::comparison::{Evidence, PIXEL_TOLERANCE};
use crate::mistakes::term_of;
use crate::testbench::Atlas;
use crate::verdict::{Outcome, TermState, Verdict};
use gonio_language::tr;

/// A picture that does not distinguish mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Blank {
    Nothing,
    Black,
    NoNumber,
    Flat,
}

impl Blank {
    fn recognise(seen: &Atlas, test_scenes: usize) -> Option<Blank> {
        let pixels = || (0..test_scenes).flat_map(|tile| seen.tile(tile)).filter(|pixel| Atlas::is_drawn(pixel));
        let all = |is: &dyn Fn(f32) -> bool| pixels().all(|pixel| pixel.iter().take(3).all(|channel| is(*channel)));
        if pixels().next().is_none() {
            Some(Blank::Nothing)
        } else if all(&|channel| channel.abs() <= PIXEL_TOLERANCE) {
            Some(Blank::Black)
        } else if all(&f32::is_nan) {
            Some(Blank::NoNumber)
        } else {
            (0..test_scenes).all(|tile| is_flat(seen.tile(tile))).then_some(Blank::Flat)
        }
    }

    fn sentence(self) -> &'static str {
        match self {
            Blank::Nothing => tr!("check-nothing-is-drawn-check-the-value"),
            Blank::Black => {
                tr!("check-the-picture-is-black-in-every")
            }
            Blank::NoNumber => {
                tr!("check-every-pixel-is-nan-in-every")
            }
            Blank::Flat => {
                tr!("check-the-picture-has-a-single-colour")
            }
        }
    }
}

fn is_flat(tile: &[[f32; 4]]) -> bool {
    let mut drawn = tile.iter().filter(|pixel| Atlas::is_drawn(pixel));
    let Some(first) = drawn.next() else { return true };
    drawn.all(|pixel| pixel.iter().zip(first).take(3).all(|(a, b)| (a - b).abs() <= PIXEL_TOLERANCE))
}

/// Says what is blank about a picture that no mistake explains: too many would.
pub(super) fn explain_blank(verdict: &mut Verdict, evidence: &Evidence) {
    if let Some(blank) = Blank::recognise(&evidence.seen, evidence.scenes.len()) {
        verdict.peculiarities.clear();
        verdict.summary = blank.sentence().to_owned();
    }
}

/// Makes the verdicts on single terms agree with the mistakes, which the summary names too.
///
/// Terms are tested alone in a few scenes, with a tolerance for outlines, and by strengths that a mistake may mix up.
/// So a mistake with one term makes that term wrong. If such mistakes explain everything, the other terms are right;
/// if the program is right, all are.
pub(super) fn agree_terms(verdict: &mut Verdict) {
    let blamed: Vec<Option<&str>> = verdict.mistakes.iter().map(|mistake| term_of(&mistake.id)).collect();
    let is_explained = verdict.mistakes.iter().all(|mistake| mistake.share_explained >= 1.0);
    let is_only_blame = !blamed.is_empty() && blamed.iter().all(Option::is_some) && is_explained;
    let is_correct = verdict.verdict == Outcome::Correct;
    for term in verdict.terms.iter_mut().filter(|term| term.state != TermState::NotSeparable) {
        if blamed.contains(&Some(&*term.term)) {
            term.state = TermState::Wrong;
        } else if is_correct || is_only_blame {
            term.state = TermState::Right;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::{FoundMistake, TermVerdict};
    use TermState::{NotSeparable, Right, Wrong};

    fn agreed(outcome: Outcome, states: [TermState; 3], mistakes: &[(&str, f64)]) -> [TermState; 3] {
        let mut verdict = Verdict::new("ex07", outcome, "");
        let terms = crate::mistakes::TERMS.into_iter().zip(states);
        verdict.terms = terms.map(|(term, state)| TermVerdict { term: term.into(), state }).collect();
        verdict.mistakes = mistakes.iter().map(|(id, share)| FoundMistake::new(*id, *id, *share)).collect();
        agree_terms(&mut verdict);
        [0, 1, 2].map(|index| verdict.terms[index].state)
    }

    #[test]
    fn a_mistake_with_a_term_makes_only_that_term_wrong() {
        let wrong = Outcome::Wrong;
        assert_eq!(agreed(wrong, [Right, Wrong, Right], &[("specular-missing", 1.0)]), [Right, Right, Wrong]);
        // A term that no mistake explains keeps the state that the pictures show.
        assert_eq!(agreed(wrong, [Right, Wrong, Right], &[("specular-missing", 0.97)]), [Right, Wrong, Wrong]);
        let both = [("specular-missing", 1.0), ("normal-reversed", 1.0)];
        assert_eq!(agreed(wrong, [Right, Wrong, Right], &both), [Right, Wrong, Wrong]);
        assert_eq!(agreed(wrong, [NotSeparable; 3], &both), [NotSeparable; 3]);
        assert_eq!(agreed(wrong, [Right, Wrong, Wrong], &[]), [Right, Wrong, Wrong]);
        assert_eq!(agreed(Outcome::Correct, [Right, Wrong, NotSeparable], &[]), [Right, Right, NotSeparable]);
    }

    #[test]
    fn ids_name_the_term() {
        assert_eq!(term_of("specular-missing"), Some("specular"));
        assert_eq!(term_of("normal-reversed"), None);
        assert_eq!(term_of("ambient"), None);
    }
}
