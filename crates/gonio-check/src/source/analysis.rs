//! Analyses the source of a pair of shaders: the constants written in it, the roles of matrices by their use, and the
//! lines of mistakes with a panorama.

use super::constants::{self, SourceConstants};
use super::{Answer, panorama, power_under_maximum};
use crate::dataflow::{Id, Op, Reading, Shader};
use crate::roles::{self, Declared, NamesFile, Role};
use gonio_glsl::ast::BinaryOp;
use gonio_glsl::{Span, Stage};
use gonio_language::tr;

/// An expression in the student's source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The shader.
    pub stage: Stage,
    /// The position in the shader.
    pub span: Span,
}

/// The analysis of a pair of shaders.
pub struct Analysis {
    pub(super) reading: Reading,
}

impl Analysis {
    /// Analyses a pair. `names` assigns roles to names that are otherwise unclear.
    #[must_use]
    pub fn new(vertex: &Shader, fragment: &Shader, names: &NamesFile) -> Self {
        Analysis { reading: Reading::new(vertex, fragment, names) }
    }

    /// Analyses a pair, and adds to the names the roles that only their use tells: of matrices by the position, of an exponent by
    /// the power.
    #[must_use]
    pub fn with_roles_by_use(vertex: &Shader, fragment: &Shader, names: &mut NamesFile) -> Self {
        let source = Analysis::new(vertex, fragment, names);
        let leaves = [vertex, fragment].into_iter().flat_map(|shader| gonio_glsl::leaves(&shader.checked.interface));
        let declared: Vec<Declared> =
            leaves.map(|leaf| Declared::uniform(leaf.name.clone(), leaf.ty.written())).collect();
        // The exercises' own V has no projection.
        let has_projection = declared.iter().any(|declared| declared.name == "V")
            || roles::bind(&declared, names).bound.iter().any(|bound| bound.role.projects());
        let mut by_use = matrices_by_use(&source.reading, has_projection);
        by_use.extend(exponent_by_use(&source.reading));
        if by_use.is_empty() {
            return source;
        }
        names.by_use.extend(by_use);
        Analysis::new(vertex, fragment, names)
    }

    /// Returns constants in the source that could be uniforms, if they flow into the colour.
    #[must_use]
    pub fn constants(&self) -> SourceConstants {
        constants::constants(&self.reading)
    }

    /// Returns the expression that makes a mistake with a panorama or with faces. `None` if the source does not show it.
    #[must_use]
    pub fn line(&self, id: &str) -> Option<Place> {
        match panorama::answer(&self.reading, id) {
            Answer::At(node, _) => self.place(node),
            Answer::Not | Answer::Silent => None,
        }
    }

    /// Returns the support of the source for a mistake with a panorama or with faces: 1 if the very expression is there,
    /// 0 if the expression is right, 0.5 if the source does not decide.
    #[must_use]
    pub fn support(&self, id: &str) -> f32 {
        match panorama::answer(&self.reading, id) {
            Answer::At(_, support) => support,
            Answer::Not => 0.0,
            Answer::Silent => 0.5,
        }
    }

    /// Returns the mistakes that no picture shows: id, place, and a sentence for the student.
    #[must_use]
    pub fn in_source_only(&self) -> Vec<(&'static str, Place, String)> {
        let found = power_under_maximum(&self.reading).and_then(|node| self.place(node));
        let sentence = tr!("check-pow-of-a-negative-number-is");
        found.map(|place| ("specular-power-of-negative", place, sentence.to_owned())).into_iter().collect()
    }

    /// Whether the result of the lookup at this position flows into the colour.
    #[must_use]
    pub fn puts_out_lookup(&self, name: Span) -> bool {
        let graph = &self.reading.graph;
        self.reading.lookups().into_iter().any(|(call, _)| {
            let node = graph.node(call);
            node.stage == Stage::Fragment && node.span.start <= name.start && name.end <= node.span.end
        })
    }

    /// Finds a lookup of a panorama whose u jumps from one edge to the other, by a function that selects the mipmap
    /// by derivatives: harmless as long as there are no mipmaps.
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
        let sentence = tr!("check-with-mipmaps-a-seam-would-appear");
        Some((self.place(call)?, sentence.to_owned()))
    }

    fn place(&self, node: Id) -> Option<Place> {
        let node = self.reading.graph.node(node);
        (node.span.line > 0).then_some(Place { stage: node.stage, span: node.span })
    }
}

/// The exponent of the highlight, if its name says that it is a strength.
fn exponent_by_use(reading: &Reading) -> Option<(String, Role)> {
    let exponents = reading.powers().into_iter().filter_map(|(_, _, exponent)| {
        match reading.graph.op(reading.graph.core(exponent)) {
            Op::Input { name, role } => Some((name, *role)),
            _ => None,
        }
    });
    let exponents: Vec<(&String, Option<Role>)> = exponents.collect();
    let has_own = exponents.iter().any(|(_, role)| *role == Some(Role::Shininess));
    let misnamed = exponents.into_iter().find(|(_, role)| role.is_some_and(|role| role.scales(2)));
    misnamed.filter(|_| !has_own).map(|(name, _)| (name.clone(), Role::Shininess))
}

/// Returns the roles that matrices with unclear names must have. Empty if all names are clear, or if the position is
/// not a product. Without an input for the projection, the view matrix contains it.
fn matrices_by_use(reading: &Reading, has_projection: bool) -> Vec<(String, Role)> {
    let Some(position) = reading.position else { return Vec::new() };
    let mut factors = Vec::new();
    if !product(reading, position, &mut factors, 0) || factors.iter().all(|(_, role)| role.is_some()) && has_projection
    {
        return Vec::new();
    }
    let known: Vec<Option<Role>> = factors.iter().map(|(_, role)| *role).collect();
    let others_project = known.iter().skip(1).flatten().any(|role| role.projects());
    let meant: &[Role] = match known[..] {
        _ if others_project => return Vec::new(),
        [None] => &[Role::ModelViewProjection],
        // `view * world_position`: without a projection, V contains it.
        [Some(Role::View)] if !has_projection => &[Role::ViewProjection],
        [Some(Role::View), Some(Role::Model)] if !has_projection => &[Role::ViewProjection, Role::Model],
        [Some(Role::Projection), None] => &[Role::Projection, Role::ModelView],
        // `camera * transform`: without a projection, the first factor contains it.
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

/// Collects the uniforms of a product from left to right, without the vector at its end. Returns whether the node is
/// such a product.
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
