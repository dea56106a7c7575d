//! Evaluates the lit model solutions on the CPU, from the text that the driver compiles, over many points at once.
//!
//! A software driver takes milliseconds for a hypothesis, mostly to start and to read back, and it evaluates all
//! variants of each line. The interpreter evaluates only what a hypothesis changes, so that thousands of hypotheses
//! can be compared with a picture during one check. The driver determines once which triangle each pixel shows
//! (`testbench`), and it draws the hypothesis that a verdict names.

mod plan;
mod run;
mod value;

pub use plan::{EvaluationPlan, ModelUniform};
pub use run::{Fragments, InputSet, Points, Run};
pub use value::Value;
