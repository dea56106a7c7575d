//! The exercise to open the window with.

use crate::files::ExerciseFile;

/// What the laboratory is opened with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Start {
    /// The exercise's word: `ex04`.
    pub exercise: String,
    /// The student's files; where there are none, those to start from.
    pub files: Vec<ExerciseFile>,
}
