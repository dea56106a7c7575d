//! The exercises: their texts, checkers for every kind of answer, previews, and reports on verdicts.
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod baking;
pub mod buffers;
mod check;
pub mod class;
mod content_hash;
mod cubemap;
pub mod exercise;
mod folder;
pub mod gl_program;
pub mod points;
pub mod preview;
pub mod report;
pub mod score;
pub mod step;

pub use check::{Checker, GOAL, check};
pub use content_hash::content_hash;
pub use folder::exercise_of_folder;
