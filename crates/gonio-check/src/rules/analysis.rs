//! Analyses the source of a pair of shaders: the mistakes that it makes and where, and the constants written in it.

use super::constants::{self, SourceConstants};
use super::{Answer, answer, power_under_maximum};
use crate::dataflow::{Id, Op, Reading, Shader};
use crate::mistakes::ModelSolution;
use crate::roles::{NamesFile, Role};
use gonio_glsl::ast::BinaryOp;
use gonio_glsl::{Span, Stage};

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
pub struct Analysis {
    pub(super) reading: Reading,
}

impl Analysis {
    /// Reads a pair. `names` says what names mean where nothing else tells.
    #[must_use]
    pub fn new(vertex: &Shader, fragment: &Shader, names: &NamesFile) -> Self {
        Analysis { reading: Reading::new(vertex, fragment, names) }
    }

    /// Constants in the source where a uniform could be, as far as they flow into the colour.
    #[must_use]
    pub fn constants(&self) -> SourceConstants {
        constants::constants(&self.reading)
    }

    /// Whether V is cut down to its rotation somewhere, used or not.
    #[must_use]
    pub fn turns_only(&self) -> bool {
        let graph = &self.reading.graph;
        let is_view = |id: Id| self.reading.role(graph.core(id)) == Some(Role::View);
        graph.ids().any(|id| match graph.op(id) {
            Op::Construct(parts) => graph.node(id).is_matrix && parts.len() == 1 && is_view(parts[0]),
            _ => false,
        })
    }

    /// Matrices whose names say nothing, and what they must be for the position to be what it is.
    #[must_use]
    pub fn matrices_by_use(&self) -> Vec<(String, Role)> {
        matrices_by_use(&self.reading)
    }

    /// The place in the source that looks like a mistake of the catalogue, or where what is missing belongs. `None` where the
    /// source does not tell.
    #[must_use]
    pub fn line(&self, id: &str, model: ModelSolution) -> Option<Place> {
        match answer(&self.reading, id, model) {
            Answer::At(node, confidence) => self.place(node, confidence),
            Answer::Not | Answer::Silent => None,
        }
    }

    /// How far the source supports a mistake: 1 if the very expression is there, 0 if it is there and right, 0.5 if the source
    /// does not tell.
    #[must_use]
    pub fn support(&self, id: &str, model: ModelSolution) -> f32 {
        match answer(&self.reading, id, model) {
            Answer::At(_, support) => support,
            Answer::Not => 0.0,
            Answer::Silent => 0.5,
        }
    }

    /// Mistakes that no picture shows: id, place, and a sentence for the student.
    #[must_use]
    pub fn in_source_only(&self) -> Vec<(&'static str, Place, String)> {
        let found = power_under_maximum(&self.reading).and_then(|node| self.place(node, 1.0));
        let sentence = "`pow` of a negative number is undefined: move `max` inside, \
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
        let jumps = |place: Id| {
            let parts = graph.reachable(&[place], |_| true);
            parts.iter().any(|id| matches!(graph.op(*id), Op::Call(name, _) if name == "atan"))
        };
        let by_itself =
            |call: Id| matches!(graph.op(call), Op::Call(name, _) if matches!(name.as_str(), "texture" | "texture2D"));
        let (call, _) = self.reading.lookups().into_iter().find(|(call, at)| by_itself(*call) && jumps(*at))?;
        let sentence = "with mipmaps a seam would appear behind the camera, where u jumps from 1 to 0; \
                        `textureLod(panorama, place, 0.0)` avoids it";
        Some((self.place(call, 1.0)?, sentence.to_owned()))
    }

    fn place(&self, node: Id, confidence: f32) -> Option<Place> {
        let node = self.reading.graph.node(node);
        (node.span.line > 0).then_some(Place { stage: node.stage, span: node.span, confidence })
    }
}

/// The names of uniforms and what they must be. Empty where names say it all, or where the position is no plain product.
fn matrices_by_use(reading: &Reading) -> Vec<(String, Role)> {
    let Some(position) = reading.position else { return Vec::new() };
    let mut factors = Vec::new();
    if !product(reading, position, &mut factors, 0) || factors.iter().all(|(_, role)| role.is_some()) {
        return Vec::new();
    }
    let known: Vec<Option<Role>> = factors.iter().map(|(_, role)| *role).collect();
    let projects = |role: &Role| matches!(role, Role::Projection | Role::ViewProjection | Role::ModelViewProjection);
    let others_project = known[1..].iter().flatten().any(projects);
    let meant: &[Role] = match known[..] {
        _ if others_project => return Vec::new(),
        [None] => &[Role::ModelViewProjection],
        [Some(Role::Projection), None] => &[Role::Projection, Role::ModelView],
        // `camera * transform`: with nothing to project with, it is in the first.
        [None | Some(Role::View | Role::ViewProjection), None] | [None, Some(Role::Model)] => {
            &[Role::ViewProjection, Role::Model]
        }
        [None, Some(Role::ModelView)] => &[Role::Projection, Role::ModelView],
        [_, _, _] => &[Role::Projection, Role::View, Role::Model],
        _ => return Vec::new(),
    };
    let contradicts = |((_, known), meant): (&(String, Option<Role>), &Role)| {
        known.is_some_and(|known| known != *meant && !(known == Role::View && *meant == Role::ViewProjection))
    };
    if factors.iter().zip(meant).any(contradicts) {
        return Vec::new();
    }
    let changed =
        |((name, known), meant): ((String, Option<Role>), &Role)| (known != Some(*meant)).then_some((name, *meant));
    factors.into_iter().zip(meant).filter_map(changed).collect()
}

/// The uniforms of a product from left to right, without the vector at its end; whether it is one.
fn product(reading: &Reading, id: Id, factors: &mut Vec<(String, Option<Role>)>, depth: usize) -> bool {
    let graph = &reading.graph;
    if depth > 16 || factors.len() > 3 {
        return false;
    }
    match graph.op(graph.core(id)) {
        Op::Input { name, role } if graph.node(graph.core(id)).is_matrix => {
            factors.push((name.clone(), *role));
            true
        }
        Op::Input { .. } => true,
        Op::Binary(BinaryOp::Multiply, a, b) => {
            graph.node(*a).is_matrix
                && product(reading, *a, factors, depth + 1)
                && product(reading, *b, factors, depth + 1)
        }
        // `vec4(position, 1.0)`
        Op::Construct(_) => !graph.node(graph.core(id)).is_matrix,
        _ => false,
    }
}
