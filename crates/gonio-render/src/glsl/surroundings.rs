//! The environment in programs: reflections, refractions, its light, and the sky.

use super::{BRDF, ENVIRONMENT_LIGHT, FRESNEL, FUNCTION_LIGHT, OPTICS, SceneKey, bit, define};
use super::{MapSet, Reflectance};
use crate::shader_text::shader_text;
use gonio_gl::Dialect;
use gonio_light::Specular;

const SURROUNDINGS: &str = shader_text!("../../shaders/surroundings.glsl");
const SIGHT: &str = shader_text!("../../shaders/sight.glsl");
const ENVIRONMENT_LIGHTING: &str = shader_text!("../../shaders/environment_lighting.glsl");
const FUNCTION_LIGHTING: &str = shader_text!("../../shaders/function_lighting.glsl");
const BODY: &str = shader_text!("../../shaders/body.glsl");
const SKY_VERT: &str = shader_text!("../../shaders/sky.vert");
const SKY_FRAG: &str = shader_text!("../../shaders/sky.frag");

/// The optics of a surface that looks the environment up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SurfaceOptics {
    /// None: the surface neither mirrors nor refracts.
    Nothing,
    /// The direction of reflection.
    Mirror,
    /// Reflection, and refraction at one surface.
    Glass,
    /// Reflection, and refraction through the object's body.
    Body,
}

/// The part of the environment that a program shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SurroundingsKey {
    /// The optics of the material.
    pub sight: SurfaceOptics,
    /// Mip levels are chosen by how fast directions change from pixel to pixel. Ignored without optics.
    pub mipmapped: bool,
    /// Whether the environment lights the surface.
    pub lights: bool,
}

impl SurroundingsKey {
    /// No part of the environment.
    pub const NONE: SurroundingsKey =
        SurroundingsKey { sight: SurfaceOptics::Nothing, mipmapped: false, lights: false };

    /// Every key that shows something.
    pub fn all() -> Vec<SurroundingsKey> {
        let mut keys = Vec::new();
        for sight in [SurfaceOptics::Nothing, SurfaceOptics::Mirror, SurfaceOptics::Glass, SurfaceOptics::Body] {
            for lights in [false, true] {
                keys.extend([false, true].map(|mipmapped| SurroundingsKey { sight, mipmapped, lights }));
            }
        }
        keys.retain(|key| *key != SurroundingsKey::NONE && !(key.sight == SurfaceOptics::Nothing && key.mipmapped));
        keys
    }

    pub(super) fn defines(self) -> String {
        let mut text = String::new();
        for (name, on) in [
            ("SURROUNDINGS", self != SurroundingsKey::NONE),
            ("SIGHT", self.sight != SurfaceOptics::Nothing),
            ("GLASS", matches!(self.sight, SurfaceOptics::Glass | SurfaceOptics::Body)),
            ("BODY", self.sight == SurfaceOptics::Body),
            ("MIPMAPPED", self.mipmapped),
            ("ENVIRONMENT_LIGHT", self.lights),
        ] {
            define(&mut text, name, bit(on));
        }
        text
    }

    /// The functions that a fragment shader needs before `main`. A vertex-lit one also needs the functions that other fragment
    /// shaders contain anyway. `material_brdf` is the text of the material's own BRDF, if it has one.
    pub(super) fn functions(self, vertex_lit: bool, material_brdf: Option<&str>) -> String {
        if self == SurroundingsKey::NONE {
            return String::new();
        }
        let missing = if vertex_lit { [FRESNEL, BRDF].concat() } else { String::new() };
        let mut text = [&missing, OPTICS, ENVIRONMENT_LIGHT, SURROUNDINGS].concat();
        if self.sight == SurfaceOptics::Body {
            text += BODY;
        }
        if self.sight != SurfaceOptics::Nothing {
            text += SIGHT;
        }
        match material_brdf.filter(|_| self.lights) {
            Some(function) => {
                text += if vertex_lit { function } else { "" };
                text += FUNCTION_LIGHT;
                text += FUNCTION_LIGHTING;
            }
            None if self.lights => text += ENVIRONMENT_LIGHTING,
            None => {}
        }
        text
    }

    pub(super) fn name(self) -> String {
        let sight = match self.sight {
            SurfaceOptics::Nothing => "",
            SurfaceOptics::Mirror => " mirror",
            SurfaceOptics::Glass => " glass",
            SurfaceOptics::Body => " body",
        };
        let mipmapped = if self.mipmapped { " mipmapped" } else { "" };
        format!("{sight}{mipmapped}{}", if self.lights { " environment-light" } else { "" })
    }
}

/// Adds every environment to a key without one, for keys that share code with it: the normal and its sides, the specular colour
/// and the exponent of the material. One reflectance and one kind of loops represent all.
pub(super) fn added_to(key: SceneKey) -> Vec<SceneKey> {
    let meets = key.reflectance == Reflectance::Lab(Specular::BlinnPhong)
        && match key.maps {
            MapSet::None => !key.two_sided,
            MapSet::Diffuse => false,
            MapSet::All => key.two_sided,
        };
    let all = if meets { SurroundingsKey::all() } else { Vec::new() };
    all.into_iter().map(|surroundings| SceneKey { surroundings, ..key }).collect()
}

/// Vertex and fragment shader of the sky.
pub fn sky_sources(dialect: Dialect) -> [String; 2] {
    [[dialect.header(), SKY_VERT].concat(), [dialect.header(), SKY_FRAG].concat()]
}
