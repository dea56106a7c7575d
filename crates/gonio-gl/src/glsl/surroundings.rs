//! What programs know of the environment: which part of it they show, and the sky behind everything.

use super::{Dialect, FRESNEL, OPTICS, SceneKey, bit, define};
use super::{MapSet, Reflectance};
use gonio_light::Specular;

const SURROUNDINGS: &str = include_str!("../../shaders/surroundings.glsl");
const SKY_VERT: &str = include_str!("../../shaders/sky.vert");
const SKY_FRAG: &str = include_str!("../../shaders/sky.frag");

/// What mirrors and glass want looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sight {
    /// Nothing: the surface is neither.
    Nothing,
    /// The direction of reflection.
    Mirror,
    /// The directions of refraction too, at one surface.
    Glass,
}

/// What a program shows of the environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SurroundingsKey {
    /// By the material's optics.
    pub sight: Sight,
    /// Mip levels are chosen by how fast directions change from pixel to pixel.
    pub mipmapped: bool,
}

impl SurroundingsKey {
    /// Nothing of it.
    pub const NONE: SurroundingsKey = SurroundingsKey { sight: Sight::Nothing, mipmapped: false };

    /// Every key that shows something.
    pub fn all() -> Vec<SurroundingsKey> {
        let sights = [Sight::Mirror, Sight::Glass];
        sights
            .into_iter()
            .flat_map(|sight| [false, true].map(|mipmapped| SurroundingsKey { sight, mipmapped }))
            .collect()
    }

    pub(super) fn defines(self) -> String {
        let mut text = String::new();
        // Programs without an environment stay what they were.
        define(&mut text, "SIGHT", bit(self.sight != Sight::Nothing));
        if self != SurroundingsKey::NONE {
            define(&mut text, "GLASS", bit(self.sight == Sight::Glass));
            define(&mut text, "MIPMAPPED", bit(self.mipmapped));
        }
        text
    }

    /// What its fragment shader needs before `main`. Where the light comes from the vertices, it lacks the functions that
    /// others have in any case.
    pub(super) fn functions(self, vertex_lit: bool) -> String {
        if self == SurroundingsKey::NONE {
            return String::new();
        }
        let missing = if vertex_lit { FRESNEL } else { "" };
        [missing, OPTICS, SURROUNDINGS].concat()
    }

    pub(super) fn name(self) -> String {
        let sight = match self.sight {
            Sight::Nothing => "",
            Sight::Mirror => " mirror",
            Sight::Glass => " glass",
        };
        format!("{sight}{}", if self.mipmapped { " mipmapped" } else { "" })
    }
}

/// A key without environment with every environment, where that is worth a program.
pub(super) fn with_surroundings(key: SceneKey) -> Vec<SceneKey> {
    if key.reflectance != Reflectance::Lab(Specular::BlinnPhong) || key.maps == MapSet::Diffuse {
        return Vec::new();
    }
    SurroundingsKey::all().into_iter().map(|surroundings| SceneKey { surroundings, ..key }).collect()
}

/// Vertex and fragment shader of the sky.
pub fn sky_sources(dialect: Dialect) -> [String; 2] {
    [[dialect.header(), SKY_VERT].concat(), [dialect.header(), SKY_FRAG].concat()]
}
