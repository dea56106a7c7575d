//! The list of terms says what the mistakes say.

use crate::mistakes::term_of;
use crate::verdict::{Outcome, TermState, Verdict};

/// Makes the terms that could be looked at alone agree with the verdict and its mistakes, which the summary names too.
///
/// Terms are looked at in a few scenes only, with a tolerance for outlines, and by strengths from outside, which a mistake
/// may mix up. So a mistake with one term makes that term wrong. Where such mistakes explain everything, the other terms are
/// right, and all are where the verdict is that the program is right.
pub(super) fn agree(verdict: &mut Verdict) {
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
        agree(&mut verdict);
        [0, 1, 2].map(|index| verdict.terms[index].state)
    }

    #[test]
    fn a_mistake_with_a_term_makes_it_wrong_and_no_other() {
        let wrong = Outcome::Wrong;
        assert_eq!(agreed(wrong, [Right, Wrong, Right], &[("specular-missing", 1.0)]), [Right, Right, Wrong]);
        // What is not explained stays what the pictures say.
        assert_eq!(agreed(wrong, [Right, Wrong, Right], &[("specular-missing", 0.97)]), [Right, Wrong, Wrong]);
        let both = [("specular-missing", 1.0), ("normal-reversed", 1.0)];
        assert_eq!(agreed(wrong, [Right, Wrong, Right], &both), [Right, Wrong, Wrong]);
        assert_eq!(agreed(wrong, [NotSeparable; 3], &both), [NotSeparable; 3]);
        assert_eq!(agreed(wrong, [Right, Wrong, Wrong], &[]), [Right, Wrong, Wrong]);
        assert_eq!(agreed(Outcome::Correct, [Right, Wrong, NotSeparable], &[]), [Right, Right, NotSeparable]);
    }

    #[test]
    fn ids_tell_the_term() {
        assert_eq!(term_of("specular-missing"), Some("specular"));
        assert_eq!(term_of("normal-reversed"), None);
        assert_eq!(term_of("ambient"), None);
    }
}
