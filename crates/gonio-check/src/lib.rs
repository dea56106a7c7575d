//! Checks students' shaders: draws a submission in test scenes, finds the mistake that explains its pictures, and locates
//! that mistake in the source.
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod cause;
mod check;
pub mod comparison;
pub mod compile;
pub mod dataflow;
pub mod driver_log;
pub mod feedback;
pub mod mistakes;
pub mod panorama;
pub mod picture_judge;
pub mod proposed_fix;
pub mod roles;
pub mod source;
pub mod source_problems;
pub mod submission;
pub mod testbench;
pub mod user_shaders;
pub mod verdict;
pub mod words;

pub use check::{CheckOptions, ShaderExercise, WRONG_VALUE, check, check_without_fix, start_threads, with_edits};
pub use comparison::ShaderChecker;
