//! Checks a model whose materials were baked into one picture.
//!
//! | module | question |
//! |---|---|
//! | [`original`] | which colour does the exercise's own model have at a point of its surface? |
//! | `answer` | which model, which pictures and which texture paths did the student hand in? |
//! | `matching` | which triangle of the original is each triangle of the answer? |
//! | `layout` | which texels belong to the surface, and to which part of it? |
//! | `expected` | which colours does the right picture for the student's own layout have? |
//! | `picture` | the student's picture, and what it would be without a mistake |
//! | `colors` | with which mistakes is the picture the right one? |
//! | `light` | is it the right one times light, or after a curve, or another quantity? |
//! | `seams` | does a lookup at the border of a chart read the background or another chart? |
//! | `materials` | do all materials show the picture, by a path that works elsewhere? |
//! | `findings` | all answers together |
//! | `verdict` | the findings in words |
//!
//! The layout is the student's own, so no layout is wrong by itself: gonio bakes the right picture for it and compares. A
//! mistake is named if undoing it makes the picture right.

mod answer;
mod colors;
mod expected;
mod findings;
mod layout;
mod light;
mod matching;
mod materials;
mod mistakes;
pub mod original;
mod picture;
mod seams;
mod verdict;

pub use answer::{is_model, is_part, same_part};
pub use mistakes::all as mistakes;
pub use original::Original;
pub use verdict::check;
