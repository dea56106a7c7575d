//! Requests to the exercise view: commands, which widgets and keys push and which are applied after the frame is laid out,
//! and the exercise to start.

use crate::files::ExerciseFile;
use gonio_language::Language;

/// A command of the exercise view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExerciseCommand {
    /// Start the exercise with this id.
    Begin(String),
    /// Show the list of exercises.
    List,
    /// Return to the scene.
    Leave,
    /// Check what is in the editor.
    Check,
    /// Stop the check.
    StopChecking,
    /// Choose files to open.
    Open,
    /// Put back the previous files.
    PutBack,
    /// Start over with the original files.
    BeginAgain,
    /// Download the original files.
    StartFiles,
    /// Save the changed files.
    Save,
    /// Save the files in memory to this folder.
    SaveInto(String),
    /// Opens the search in the text.
    Find,
    /// Undo in the current file.
    Undo,
    /// Redo in the current file.
    Redo,
    /// Load the version on disk of the file with this index.
    TakeOther(usize),
    /// Save the editor's version of the file with this index over that on disk.
    KeepMine(usize),
    /// Apply the last verdict's proposed fix.
    ApplyFix,
    /// Discard the restored drafts.
    DiscardRestored,
    /// Keep the restored drafts, and dismiss the note.
    KeepRestored,
    /// Switches between the light and the dark theme.
    Theme,
    /// Shows all texts in this language.
    SetLanguage(Language),
}

/// An exercise to open, with a student's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Start {
    /// The id of the exercise: `ex04`.
    pub exercise: String,
    /// The student's files; if empty, the original ones.
    pub files: Vec<ExerciseFile>,
}
