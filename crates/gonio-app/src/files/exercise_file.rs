//! A file of an exercise: the student's own, or one to start from.

use std::path::PathBuf;

/// A file of an exercise, with its path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExerciseFile {
    /// The name in the exercise.
    pub name: String,
    /// The path on disk; `None` for a file in memory.
    pub path: Option<PathBuf>,
    /// Its content.
    pub bytes: Vec<u8>,
}
