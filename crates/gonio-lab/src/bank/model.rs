//! The models: right answers written so that each quantity has a line of its own, which the bank changes.

use serde::{Deserialize, Serialize};

/// A right answer that hypotheses are changes of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// The light equation per fragment.
    Phong,
    /// The light equation per vertex.
    Gouraud,
    /// A mirror.
    Reflection,
    /// Glass, through one surface.
    Refraction,
    /// The sky around everything.
    Skybox,
}

macro_rules! shader {
    ($name:literal) => {
        include_str!(concat!("../../../../exercises/models/", $name))
    };
}

impl Model {
    /// Every one.
    pub const ALL: [Model; 5] = [Model::Phong, Model::Gouraud, Model::Reflection, Model::Refraction, Model::Skybox];

    /// Vertex and fragment shader, `#version 330 core`.
    pub fn sources(self) -> [&'static str; 2] {
        match self {
            Model::Phong => [shader!("phong.vert"), shader!("phong.frag")],
            Model::Gouraud => [shader!("gouraud.vert"), shader!("gouraud.frag")],
            Model::Reflection => [shader!("mirror.vert"), shader!("reflection.frag")],
            Model::Refraction => [shader!("mirror.vert"), shader!("refraction.frag")],
            Model::Skybox => [shader!("skybox.vert"), shader!("skybox.frag")],
        }
    }

    /// Whether it computes light from lights.
    pub fn is_lit(self) -> bool {
        matches!(self, Model::Phong | Model::Gouraud)
    }
}
