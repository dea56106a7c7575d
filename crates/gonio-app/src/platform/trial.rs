//! A trial of a student's shaders: they are compiled and drawn once where a crash, an endless loop or too much memory harms
//! nobody. Only shaders that pass are given to the window's own OpenGL.

use super::{CheckResult, Pending};
use gonio_check::verdict::{Outcome, Verdict};

/// The result of a trial.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TrialOutcome {
    /// The shaders were compiled and drawn, or the compiler refused them: the window may do the same.
    Harmless,
    /// They crashed the trial, or took too much time or memory. One sentence for the student.
    Refused(String),
    /// The trial could not be made; one sentence says why. Nothing is known of the shaders.
    Unavailable(String),
}

/// A trial by a complete check, for platforms that have no processes.
pub struct ByCheck(Box<dyn Pending<CheckResult>>);

impl ByCheck {
    /// Waits for this check.
    pub fn new(checking: Box<dyn Pending<CheckResult>>) -> Self {
        ByCheck(checking)
    }
}

impl Pending<TrialOutcome> for ByCheck {
    fn poll(&mut self) -> Option<TrialOutcome> {
        let why = match self.0.poll()? {
            Ok(Verdict { verdict: Outcome::Correct | Outcome::Wrong | Outcome::DoesNotCompile, .. }) => {
                return Some(TrialOutcome::Harmless);
            }
            Ok(verdict) => verdict.summary,
            Err(why) => why,
        };
        Some(TrialOutcome::Refused(format!("This shader is not drawn because it may never finish: {why}")))
    }
}
