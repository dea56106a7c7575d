//! A pair of shaders as it runs in a window: read while it is being written, its variables given what they mean, drawn in
//! the exercise's scene. What it draws is for the eye; verdicts are the checker's ([`gonio_check::check`]).

mod files;
mod pair;
mod renderer;
mod scene;

pub use files::{FileUse, SortedFiles, is_answer, is_complete, is_replaced, sort_files};
pub use pair::{CompiledPair, Note, NoteKind, SubmittedPair};
pub use renderer::{PreviewRenderer, VariableValue};
pub use scene::{Eye, PreviewObject, PreviewScene, PreviewShape, scenes};

use crate::exercise::{Exercise, ExerciseKind};
use gonio_check::submission::SourceFile;

/// Whether the answer is a pair of shaders that can be drawn in a scene of ours.
pub fn is_drawn(exercise: &Exercise) -> bool {
    exercise.kind == ExerciseKind::Shaders && reference(exercise).is_ok()
}

/// The exercise's right answer. An error is one sentence.
pub fn reference(exercise: &Exercise) -> Result<SubmittedPair, String> {
    let files = exercise.reference_files().map(|(name, text)| SourceFile::new(name, text)).collect();
    SubmittedPair::gather(exercise, files)
}

/// The pair that draws the sky behind what mirrors it.
pub fn sky() -> Result<SubmittedPair, String> {
    let exercise = crate::exercise::find("ex08").ok_or("the exercise about skyboxes is missing")?;
    reference(exercise)
}
