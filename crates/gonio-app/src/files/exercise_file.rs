//! A file of an exercise: the student's own, or one to start from.

use std::path::PathBuf;

/// A file as it was given, and where it lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExerciseFile {
    /// As it is called here.
    pub name: String,
    /// On the disk; nothing where it is in memory alone.
    pub path: Option<PathBuf>,
    /// What it holds.
    pub bytes: Vec<u8>,
}
