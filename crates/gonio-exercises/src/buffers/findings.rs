//! The findings about a student's buffer.

use super::vertex::Vertex;
use gonio_check::verdict::Outcome;
use serde::Serialize;

/// All that is said of a buffer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferFindings {
    /// In a word.
    pub verdict: Outcome,
    /// Mistakes that together explain the difference; empty where none of the known ones does.
    pub mistakes: Vec<BufferMistake>,
    /// Other explanations that fit exactly as well on this model, each as the ids of its mistakes.
    pub alternatives: Vec<Vec<&'static str>>,
    /// Peculiarities that are no mistakes, a sentence each.
    pub warnings: Vec<String>,
    /// The difference, where there is one.
    pub example: Option<Example>,
    /// The shares of the buffer that are right.
    pub shares: Shares,
}

/// A mistake in a buffer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferMistake {
    /// Stable, in kebab-case: one of [`super::names`].
    pub id: &'static str,
    /// The title.
    pub name: &'static str,
    /// What the program does, and the consequence.
    pub explanation: &'static str,
    /// The change that fixes it.
    pub how_to_fix: &'static str,
    /// The share of the difference that it explains, together with the other mistakes named: 1 for all.
    pub share_explained: f64,
    /// A triangle that shows it.
    pub example: Option<Example>,
}

/// A triangle as the student has it and as it should be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Example {
    /// The vertices' first row in the buffer, from 1; none where the triangle is missing.
    pub row: Option<u64>,
    /// As in the buffer.
    pub given: Option<[Vertex; 3]>,
    /// As it should be; none where none of the model's triangles belongs to it.
    pub expected: Option<[Vertex; 3]>,
    /// The line of the model with the face, from 1.
    pub line: Option<u64>,
    /// That line.
    pub line_text: String,
}

/// How much of a buffer is right, as triangles in both by the triangles of the larger one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Shares {
    /// Triangles of the model.
    pub triangles_expected: u64,
    /// Triangles of the buffer.
    pub triangles_given: u64,
    /// Everything compared.
    pub all: f64,
    /// Positions alone.
    pub positions: f64,
    /// Texture coordinates alone; none where the model or the buffer has none.
    pub tex_coords: Option<f64>,
    /// Normals alone; none where the model or the buffer has none.
    pub normals: Option<f64>,
}
