//! Follows each value of the parsed program from the outputs back to attributes and uniforms.
//!
//! The shaders are executed symbolically (`run`, `eval`), which gives a graph of all values (`graph`). Each node is
//! classified: which matrix (`matrix`), which vector (`vector`) and which terms of the light equation (`terms`) it is.
//! `source` reads constants and places from it. This returns for any source: loops, calls and depth are limited, and
//! values beyond the limits are unknown.

mod choice;
mod eval;
mod graph;
pub(crate) mod matrix;
mod reading;
mod run;
pub(crate) mod terms;
pub(crate) mod vector;

pub(crate) use graph::{Graph, Id, Op, component};
pub(crate) use reading::Reading;

use gonio_glsl::{Checked, Parsed};

/// A parsed and type-checked shader of a student.
#[derive(Clone, Copy, Debug)]
pub struct Shader<'a> {
    /// The syntax tree.
    pub parsed: &'a Parsed,
    /// Names and types.
    pub checked: &'a Checked,
}
