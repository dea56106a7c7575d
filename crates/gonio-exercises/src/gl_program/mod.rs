//! Host programs: OpenGL calls as a short text, read, really carried out, and judged.
//!
//! [`HostProgram::parse`] reads one, `gonio_render::gl_program::run` carries it out, and [`check()`] says what is wrong with it.

mod check;
mod compare;
mod files;
mod messages;
mod names;
mod program;
mod reader;
mod signature;
mod suspects;
mod verdict;
mod warnings;

pub use check::{check, check_bytes, check_program, reference};
pub use compare::SIDE;
pub use files::{exercise_files, for_context};
pub use gonio_render::gl_program::{
    Call, CallError, GlProgramFailure, GlProgramFiles, GlProgramImage, GlProgramOptions, GlProgramRun, Step, run,
};
pub use names::{HostMistakeName, name_of, names};
pub use program::{HostError, HostProgram, MOST_CALLS, MOST_DATA_BYTES, MOST_ERRORS, MOST_TEXT_BYTES};
pub use verdict::{HostMistake, HostOutcome, HostVerdict, HostWarning};

#[cfg(test)]
mod tests;
