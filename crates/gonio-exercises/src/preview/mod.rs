//! A pair of shaders as it runs in a window: read while it is being written, its variables given what they mean, drawn in
//! the exercise's scene. What it draws is for the eye; verdicts are the checker's ([`gonio_check::search()`]).

mod files;
mod pair;
mod renderer;
mod scene;

pub use files::{Handed, Use, handed, is_answer, is_complete, makes_way};
pub use pair::{Note, NoteKind, Pair, Source};
pub use renderer::{Given, LiveStage};
pub use scene::{Body, Eye, Part, Scene, scenes};

use crate::exercise::{Exercise, Kind};
use gonio_check::submission::SourceFile;

/// Whether the answer is a pair of shaders that can be drawn in a scene of ours.
pub fn is_drawn(exercise: &Exercise) -> bool {
    exercise.kind == Kind::Shaders && reference(exercise).is_ok()
}

/// The exercise's right answer. An error is one sentence.
pub fn reference(exercise: &Exercise) -> Result<Source, String> {
    let files = exercise.reference_files().map(|(name, text)| SourceFile::new(name, text)).collect();
    Source::gather(exercise, files)
}

/// The pair that draws the sky behind what mirrors it.
pub fn sky() -> Result<Source, String> {
    let exercise = crate::exercise::find("ex08").ok_or("there is no exercise of the sky")?;
    reference(exercise)
}
