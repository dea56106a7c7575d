//! GL programs: OpenGL calls as a short text, which is read, executed and checked.
//!
//! [`GlProgram::parse`] reads one, `gonio_render::gl_program::run` executes it, and [`check()`] finds its mistakes.

mod check;
mod compare;
mod findings;
mod names;
mod program;
mod signature;
mod suspects;

pub use check::{IMAGE_FOLDER, IMAGES, check, check_bytes, check_program, exercise_files, for_context, reference};
pub use compare::SIDE;
pub use findings::{GlProgramFindings, GlProgramMistake, GlProgramWarning};
pub use gonio_render::gl_program::{
    CallError, GlCall, GlProgramFailure, GlProgramFiles, GlProgramImage, GlProgramOptions, GlProgramRun, Step, run,
};
pub use names::{GlProgramMistakeName, name_of, names};
pub use program::{GlProgram, GlProgramError, MOST_CALLS, MOST_DATA_BYTES, MOST_ERRORS, MOST_TEXT_BYTES};

#[cfg(test)]
mod tests;
