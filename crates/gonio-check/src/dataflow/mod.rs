//! Where in the student's source a mistake stands, and which numbers are written there: by following every value of the
//! parsed program from the outputs back to attributes and uniforms.
//!
//! The pair is run on symbols (`run`, `eval`), which gives a graph of all values (`graph`). Of each node it is found what
//! matrix (`matrix`), what vector (`vector`) and which terms of the light equation (`terms`) it is. A rule for each
//! mistake (`rules`) names the node at fault. Whatever the source is, this returns: loops, calls and depth are limited, and
//! beyond them nothing is known.

pub(crate) mod camera;
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

/// A stage of the student's, parsed and with its names and types known.
#[derive(Clone, Copy, Debug)]
pub struct Shader<'a> {
    /// As it was read.
    pub parsed: &'a Parsed,
    /// Names and types.
    pub checked: &'a Checked,
}
