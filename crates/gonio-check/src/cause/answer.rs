//! The methods of right answers: their model solution, their choices, and the space in which they compute the light.

use crate::mistakes::{Hypotheses, Hypothesis, ModelSolution};

/// The space of a vector or position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Space {
    /// World space, or no space at all.
    #[default]
    World,
    /// The camera's.
    View,
}

/// A model solution that may explain a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightingMethod {
    /// The model solution.
    pub model: ModelSolution,
    /// The space in which it computes the light.
    pub space: Space,
}

/// The method of a right answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AnswerMethod {
    /// The model solution.
    pub model: ModelSolution,
    /// Whether only the fragment shader normalises the normal.
    pub normal_kept: bool,
    /// Whether the highlight is that of the half vector.
    pub half_vector: bool,
    /// The other choices of the highlight and of the colours.
    pub highlight: Highlight,
}

/// The terms that are not multiplied by the material's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Uncoloured {
    /// All terms have the material's colour.
    #[default]
    None,
    /// The highlight has the light's colour.
    Specular,
    /// The ambient light has a colour of its own.
    Ambient,
    /// Only the diffuse term has the material's colour.
    AmbientAndSpecular,
}

impl Uncoloured {
    /// All of them, or those in which the ambient term has the material's colour.
    pub const fn all(has_own_ambient: bool) -> &'static [Self] {
        match has_own_ambient {
            true => &[Self::None, Self::Specular, Self::Ambient, Self::AmbientAndSpecular],
            false => &[Self::None, Self::Specular],
        }
    }
}

/// What an answer may choose about its highlight, and about the colours of its terms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Highlight {
    /// 0 where the light is behind the surface, instead of everywhere where R.V is positive.
    pub gated: bool,
    /// Multiplied by the cosine, as in the rendering equation.
    pub weighted: bool,
    /// The terms without the material's colour.
    pub uncoloured: Uncoloured,
}

impl AnswerMethod {
    /// The usual answer in a model solution.
    #[must_use]
    pub fn new(model: ModelSolution) -> Self {
        AnswerMethod { model, normal_kept: false, half_vector: false, highlight: Highlight::default() }
    }

    /// Its choices as lines of the model solution; `None` if they exclude each other.
    pub(crate) fn choices(self, all: &Hypotheses) -> Option<Hypothesis> {
        hypothesis_of(all, &peculiarities(self, self.highlight))
    }
}

/// The peculiarities of answers whose ambient light has a colour of its own: with a highlight in the material's colour, and
/// with one in the light's.
pub(super) const OWN_AMBIENT: [&str; 2] = ["ambient-own-colour", "only-diffuse-coloured"];

/// The harmless peculiarities of a method of a right answer.
pub(crate) fn peculiarities(method: AnswerMethod, highlight: Highlight) -> [(&'static str, bool); 7] {
    [
        ("normal-kept-unnormalised", method.normal_kept),
        ("specular-half-vector", method.half_vector),
        ("specular-gated", highlight.gated),
        ("specular-cosine-weighted", highlight.weighted),
        ("specular-not-coloured", highlight.uncoloured == Uncoloured::Specular),
        (OWN_AMBIENT[0], highlight.uncoloured == Uncoloured::Ambient),
        (OWN_AMBIENT[1], highlight.uncoloured == Uncoloured::AmbientAndSpecular),
    ]
}

/// The hypothesis of those peculiarities that are chosen; `None` if they exclude each other.
pub(super) fn hypothesis_of(all: &Hypotheses, chosen: &[(&str, bool)]) -> Option<Hypothesis> {
    let mut hypothesis = Hypothesis::default();
    for (id, _) in chosen.iter().filter(|(_, is_chosen)| *is_chosen) {
        let is_it = |single: &&Hypothesis| single.mistakes.iter().any(|mistake| all.mistakes[*mistake].id == *id);
        hypothesis = hypothesis.and(all.singles.iter().find(is_it)?)?;
    }
    Some(hypothesis)
}

/// Vectors that are the same in another space after a rotation.
pub(super) const DIRECTIONS: [&str; 20] = [
    "N",
    "world_normal",
    "v_normal",
    "L",
    "to_light",
    "V",
    "to_eye",
    "R",
    "I",
    "from_eye",
    "v_from_eye",
    "looked_up",
    "H",
    "up",
    "-L",
    "L + V",
    "dot(N, L) * N",
    "2.0 * dot(N, L) * N",
    "dot(N, I) * N",
    "2.0 * dot(N, I) * N",
];
/// Positions that a model solution computes.
pub(super) const POSITIONS: [&str; 1] = ["world_position"];
/// Positions that a program is given.
const GIVEN_POSITIONS: [&str; 2] = ["light_pos", "u_view_pos"];

/// Whether a quantity is a direction or a position, whose values depend on its space.
pub(super) fn has_space(name: &str) -> bool {
    DIRECTIONS.contains(&name) || POSITIONS.contains(&name) || GIVEN_POSITIONS.contains(&name)
}
