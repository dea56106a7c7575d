//! How much of a verdict is shown: from right or wrong alone up to the change that makes a program right.

use crate::check::WRONG_VALUE;
use crate::comparison::Evidence;
use crate::verdict::{Outcome, Verdict};
use gonio_language::{Language, text_in, tr};
use serde::{Deserialize, Serialize};

/// How much of a verdict is shown. Each level shows everything that the levels before it show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feedback {
    /// The outcome, the test scenes that are right, the compiler's messages and the roles of variables.
    Verdict,
    /// Also the mistakes by name, their symptoms and their sections of the lecture, and the wrong terms and properties.
    Name,
    /// Also the place of each mistake, the quoted line, and in words what belongs there; and warnings.
    #[default]
    Line,
    /// Also the change that makes the program right.
    Fix,
}

/// The id of the name at [`Feedback::Name`] of a mistake that no entry of the catalogue names: its own name says what belongs there.
const UNLISTED: &str = "check-a-value-is-wrong-in-a";

impl Feedback {
    /// All levels, each showing more than the one before.
    pub const ALL: [Feedback; 4] = [Feedback::Verdict, Feedback::Name, Feedback::Line, Feedback::Fix];

    /// The word for an option.
    pub fn word(self) -> &'static str {
        match self {
            Feedback::Verdict => "verdict",
            Feedback::Name => "name",
            Feedback::Line => "line",
            Feedback::Fix => "fix",
        }
    }

    /// Reduces a verdict to what this level shows.
    #[must_use]
    pub fn reduce(self, mut verdict: Verdict) -> Verdict {
        if self < Feedback::Fix {
            verdict.proposed_fix.clear();
        }
        if self < Feedback::Line {
            hide_places(&mut verdict);
        }
        if self < Feedback::Name {
            hide_names(&mut verdict);
        }
        verdict
    }

    /// Reduces pictures to what this level shows: those that mistakes predict tell how many were found.
    #[must_use]
    pub fn reduce_pictures(self, evidence: Evidence) -> Evidence {
        let predicted = evidence.predicted.filter(|_| self >= Feedback::Name);
        Evidence { predicted, ..evidence }
    }
}

/// Whether a warning, in any language, is about files that were not read.
fn is_of_ignored_file(warning: &str) -> bool {
    let begins = |language| text_in(language, "check-submission-ignored").is_some_and(|word| warning.starts_with(word));
    Language::ALL.into_iter().any(begins)
}

fn hide_places(verdict: &mut Verdict) {
    // Other warnings name lines, and some say what to write there.
    verdict.warnings.retain(|warning| is_of_ignored_file(warning));
    for found in &mut verdict.mistakes {
        (found.file, found.line, found.quoted) = (None, None, None);
        found.fix.clear();
        if found.id == WRONG_VALUE {
            found.name = tr!(UNLISTED).to_owned();
            found.looks_like.clear();
        }
    }
    if !verdict.mistakes.is_empty() {
        verdict.summary = verdict.mistake_names();
    }
}

fn hide_names(verdict: &mut Verdict) {
    // The summary of another outcome says what the checker lacks, what it assumes, or repeats the compiler.
    let is_about_mistakes = verdict.verdict == Outcome::Wrong || !verdict.mistakes.is_empty();
    verdict.mistakes.clear();
    verdict.peculiarities.clear();
    verdict.terms.clear();
    verdict.properties.clear();
    // A scene with one term alone tells which term is wrong.
    verdict.scenes.retain(|scene| !scene.scene.ends_with(" alone"));
    if is_about_mistakes {
        let (right, all) = (verdict.scenes.iter().filter(|scene| scene.right).count(), verdict.scenes.len());
        verdict.summary = match all {
            0 => tr!("check-the-answer-is-not-right").to_owned(),
            all => tr!("check-of-test-scenes-are-right", right = right, all = all),
        };
    }
}
