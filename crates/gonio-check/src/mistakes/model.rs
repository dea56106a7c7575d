//! The models: right answers written so that each quantity has a line of its own, which the catalogue can change.

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
    /// A camera built from its position, Front and Up.
    Camera,
    /// The same without colours: what is drawn is how far everything is. Its mistakes are the camera's.
    Places,
    /// The faces of a cubemap, from a panorama.
    Panorama,
}

macro_rules! shader {
    ($name:literal) => {
        include_str!(concat!("../../../../exercises/models/", $name))
    };
}

impl Model {
    /// Every one that has mistakes of its own.
    pub const ALL: [Model; 7] = [
        Model::Phong,
        Model::Gouraud,
        Model::Reflection,
        Model::Refraction,
        Model::Skybox,
        Model::Camera,
        Model::Panorama,
    ];

    /// Vertex and fragment shader, `#version 330 core`.
    pub fn sources(self) -> [&'static str; 2] {
        match self {
            Model::Phong => [shader!("phong.vert"), shader!("phong.frag")],
            Model::Gouraud => [shader!("gouraud.vert"), shader!("gouraud.frag")],
            Model::Reflection => [shader!("mirror.vert"), shader!("reflection.frag")],
            Model::Refraction => [shader!("mirror.vert"), shader!("refraction.frag")],
            Model::Skybox => [shader!("skybox.vert"), shader!("skybox.frag")],
            Model::Camera => [shader!("camera.vert"), shader!("camera.frag")],
            Model::Places => [shader!("camera.vert"), shader!("places.frag")],
            Model::Panorama => [shader!("panorama.vert"), shader!("panorama.frag")],
        }
    }

    /// Whether it computes light from lights.
    pub fn is_lit(self) -> bool {
        matches!(self, Model::Phong | Model::Gouraud)
    }

    /// Whether it puts out what a cubemap gives in a direction.
    pub fn is_looked_up(self) -> bool {
        matches!(self, Model::Skybox | Model::Reflection | Model::Refraction)
    }

    /// The model whose mistakes apply to this one.
    pub fn with_mistakes_of(self) -> Model {
        match self {
            Model::Places => Model::Camera,
            other => other,
        }
    }

    /// Whether it is about where things are drawn: two mistakes then have a picture that neither of them hints at.
    pub fn is_of_places(self) -> bool {
        matches!(self, Model::Camera | Model::Places)
    }
}
