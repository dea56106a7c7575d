//! The exercise to open the window with.

use crate::files::ExerciseFile;

/// An exercise to open, with a student's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Start {
    /// The id of the exercise: `ex04`.
    pub exercise: String,
    /// The student's files; if empty, the original ones.
    pub files: Vec<ExerciseFile>,
}
