//! Live previews of a pair of shaders in the exercise's scene, while the shaders are being written. Their variables get values
//! by their roles. Previews are only for looking at; verdicts come from the checker ([`gonio_check::check`]).

mod files;
mod pair;
mod renderer;
mod scene;

pub use files::{FileUse, SortedFiles, is_answer, is_complete, is_replaced, sort_files};
pub use pair::{CompiledPair, Note, NoteKind, SubmittedPair};
pub(crate) use renderer::held;
pub use renderer::{PreviewRenderer, VariableValue};
pub use scene::{Eye, PreviewObject, PreviewScene, PreviewShape, scenes, test_scenes};

use crate::exercise::{Exercise, ExerciseKind};
use gonio_check::submission::SourceFile;
use gonio_language::tr;

/// Whether the answer is a pair of shaders that can be drawn in a preview scene.
pub fn is_drawn(exercise: &Exercise) -> bool {
    exercise.kind == ExerciseKind::Shaders && answer(exercise).is_ok()
}

/// The exercise's right answer.
///
/// # Errors
/// The exercise hides its reference, or has none that is a pair of shaders.
pub fn reference(exercise: &Exercise) -> Result<SubmittedPair, String> {
    let files = exercise.reference_files()?;
    SubmittedPair::gather(exercise, files.map(|(name, text)| SourceFile::new(name, text)).collect())
}

fn answer(exercise: &Exercise) -> Result<SubmittedPair, String> {
    let files = exercise.answer_files().map(|(name, text)| SourceFile::new(name, text)).collect();
    SubmittedPair::gather(exercise, files)
}

/// The pair that draws the sky behind reflecting and refracting objects.
pub fn sky() -> Result<SubmittedPair, String> {
    let exercise = crate::exercise::find("ex08").ok_or(tr!("check-preview-the-exercise-about-skyboxes-is-missing"))?;
    answer(exercise)
}
