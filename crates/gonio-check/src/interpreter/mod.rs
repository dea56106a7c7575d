//! The lit models on the CPU: the same text that the driver compiles, worked out over many points at once.
//!
//! A software driver takes milliseconds for a hypothesis, most of them for starting and reading back, and it works out every
//! way of every line whether it is chosen or not. Here only what a hypothesis changes is worked out again, so that
//! thousands can be held against a picture in the time of one check. Which pixels there are, and of which triangle, the
//! driver tells once (`stage::surface`); and what a verdict names is drawn by the driver in the end.

mod plan;
mod run;
mod value;

pub use plan::{EvaluationPlan, ModelUniform};
pub use run::{Fragments, InputSet, Points, Run};
pub use value::Value;
