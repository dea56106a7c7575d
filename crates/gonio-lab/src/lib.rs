//! The laboratory: exercises, students' own files as they are, and a checker that names the mistake.
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod bank;
pub mod buffers;
pub mod check;
pub mod class;
mod content_hash;
pub mod exercise;
mod faces;
pub mod formats;
pub mod host;
pub mod live;
pub mod locate;
mod looked_up;
pub mod messages;
pub mod names;
mod nearest;
mod other;
mod other_programs;
pub mod score;
pub mod stage;
mod student;
pub mod submission;
mod terms;
pub mod twin;
mod unexplained;
pub mod verdict;

pub use content_hash::content_hash;
pub use student::{CheckOptions, GOAL, check};
