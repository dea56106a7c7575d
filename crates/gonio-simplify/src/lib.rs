//! The staircase from the rendering equation to the light equation.
//!
//! The lecture makes one simplification after the other until an integral over all directions, wavelengths and moments is a sum
//! that OpenGL computes. This crate makes the same steps in a scene: the formula with what is removed struck out, the picture,
//! what it differs in from the step before and from the truth, and what that costs or saves.
//!
//! | module | contents |
//! |---|---|
//! | [`formula`] | the equation after any set of simplifications |
//! | [`staircase`] | the pictures of all steps, and their times |
//! | [`comparison`] | differences with their noise, and the ambient light that loses least |
//! | [`report`] | all numbers, and one sentence for each step |
//! | [`page`] | the web page, and the pictures' files |
//!
//! No function here prints or opens a file.

pub mod comparison;
pub mod formula;
pub mod page;
pub mod report;
pub mod staircase;

pub use comparison::{AmbientFit, LargestDifference, PictureComparison};
pub use staircase::{EquationPicture, SimplifiedPicture, Staircase, StaircaseSettings, TracedPicture, build};
