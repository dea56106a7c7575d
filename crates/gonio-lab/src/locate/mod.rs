//! Where in the student's source a mistake stands, and which numbers are written there: by following every value of the
//! parsed program from the outputs back to attributes and uniforms.
//!
//! The pair is run on symbols (`run`, `eval`), which gives a graph of all values (`graph`). Of each node it is found what
//! matrix (`matrix`), what vector (`vector`) and which terms of the light equation (`terms`) it is. A rule for each
//! mistake (`rules`) names the node at fault. Whatever the source is, this returns: loops, calls and depth are limited, and
//! beyond them nothing is known.

mod by_use;
mod camera;
mod choice;
mod eval;
mod fold;
mod graph;
mod matrix;
mod reading;
mod rules;
mod run;
mod terms;
mod vector;
mod written;

#[cfg(test)]
mod tests;

use crate::bank::Model;
use crate::check::Written;
use crate::names::{NamesFile, Role};
use gonio_glsl::{Checked, Parsed, Span, Stage};
use reading::Reading;
use rules::Answer;

/// A stage of the student's, parsed and with its names and types known.
#[derive(Clone, Copy, Debug)]
pub struct Shader<'a> {
    /// As it was read.
    pub parsed: &'a Parsed,
    /// What the names mean.
    pub checked: &'a Checked,
}

/// An expression of the student's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// In which shader.
    pub stage: Stage,
    /// Where.
    pub span: Span,
    /// From 0 to 1, how far the source shows the mistake there.
    pub confidence: f32,
}

/// A pair of shaders that has been read; all questions can be asked of it.
pub struct Source {
    reading: Reading,
}

impl Source {
    /// Reads a pair. `names` says what names mean where nothing else tells.
    #[must_use]
    pub fn read(vertex: &Shader, fragment: &Shader, names: &NamesFile) -> Self {
        Source { reading: Reading::of(vertex, fragment, names) }
    }

    /// As [`written`].
    #[must_use]
    pub fn written(&self) -> Written {
        written::written(&self.reading)
    }

    /// Whether V is cut down to its rotation somewhere, used or not.
    #[must_use]
    pub fn turns_only(&self) -> bool {
        let graph = &self.reading.graph;
        let is_view = |id: graph::Id| self.reading.role(graph.core(id)) == Some(Role::View);
        graph.ids().any(|id| match graph.op(id) {
            graph::Op::Construct(parts) => graph.node(id).is_matrix && parts.len() == 1 && is_view(parts[0]),
            _ => false,
        })
    }

    /// Matrices whose names say nothing, and what they must be for the position to be what it is.
    #[must_use]
    pub fn matrices_by_use(&self) -> Vec<(String, Role)> {
        by_use::matrices(&self.reading)
    }

    /// As [`line()`].
    #[must_use]
    pub fn line(&self, id: &str, model: Model) -> Option<Place> {
        match rules::answer(&self.reading, id, model) {
            Answer::At(node, confidence) => self.place(node, confidence),
            Answer::Not | Answer::Silent => None,
        }
    }

    /// As [`looks_like`].
    #[must_use]
    pub fn looks_like(&self, id: &str, model: Model) -> f32 {
        match rules::answer(&self.reading, id, model) {
            Answer::At(_, support) => support,
            Answer::Not => 0.0,
            Answer::Silent => 0.5,
        }
    }

    /// As [`in_source_only`].
    #[must_use]
    pub fn in_source_only(&self) -> Vec<(&'static str, Place, String)> {
        let found = rules::power_under_maximum(&self.reading).and_then(|node| self.place(node, 1.0));
        let sentence = "`pow` of a negative number is undefined: the `max` belongs inside, \
                        `pow(max(dot(R, V), 0.0), shininess)`";
        found.map(|place| ("specular-power-of-negative", place, sentence.to_owned())).into_iter().collect()
    }

    /// Whether the function that is called at that place looks something up that flows into the colour.
    #[must_use]
    pub fn puts_out_lookup(&self, name: Span) -> bool {
        let graph = &self.reading.graph;
        self.reading.lookups().into_iter().any(|(call, _)| {
            let node = graph.node(call);
            node.stage == Stage::Fragment && node.span.start <= name.start && name.end <= node.span.end
        })
    }

    /// Where a panorama is looked up at an angle that jumps from one edge to the other, by a function that chooses its
    /// mipmap by how fast that changes: harmless as long as there are no mipmaps.
    #[must_use]
    pub fn seam_by_mipmaps(&self) -> Option<(Place, String)> {
        let graph = &self.reading.graph;
        let jumps = |place: graph::Id| {
            let parts = graph.reachable(&[place], |_| true);
            parts.iter().any(|id| matches!(graph.op(*id), graph::Op::Call(name, _) if name == "atan"))
        };
        let by_itself = |call: graph::Id| matches!(graph.op(call), graph::Op::Call(name, _) if matches!(name.as_str(), "texture" | "texture2D"));
        let (call, _) = self.reading.lookups().into_iter().find(|(call, at)| by_itself(*call) && jumps(*at))?;
        let sentence = "with mipmaps there would be a line behind you, where u jumps from 1 to 0; \
                        `textureLod(panorama, place, 0.0)` never shows it";
        Some((self.place(call, 1.0)?, sentence.to_owned()))
    }

    fn place(&self, node: graph::Id, confidence: f32) -> Option<Place> {
        let node = self.reading.graph.node(node);
        (node.span.line > 0).then_some(Place { stage: node.stage, span: node.span, confidence })
    }
}

/// Constants that stand in the source where a uniform could be, as far as they flow into the colour.
#[must_use]
pub fn written(vertex: &Shader, fragment: &Shader) -> Written {
    Source::read(vertex, fragment, &NamesFile::default()).written()
}

/// The place in the source that looks like that mistake of the bank, or where what it leaves out belongs. None where
/// that cannot be told.
#[must_use]
pub fn line(id: &str, vertex: &Shader, fragment: &Shader, model: Model) -> Option<Place> {
    Source::read(vertex, fragment, &NamesFile::default()).line(id, model)
}

/// How far the source supports that this mistake is made: 1 if the very expression is there, 0 if it is there and right,
/// 0.5 if nothing can be told.
#[must_use]
pub fn looks_like(id: &str, vertex: &Shader, fragment: &Shader, model: Model) -> f32 {
    Source::read(vertex, fragment, &NamesFile::default()).looks_like(id, model)
}

/// What is wrong without any picture showing it: id, place, and a sentence for the student.
#[must_use]
pub fn in_source_only(vertex: &Shader, fragment: &Shader) -> Vec<(&'static str, Place, String)> {
    Source::read(vertex, fragment, &NamesFile::default()).in_source_only()
}
