//! Contents of a model file besides geometry: images, lights, cameras.

use serde::Serialize;

/// An image inside the model's file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EmbeddedImage {
    /// Its name in the file, or its number, for messages.
    pub name: String,
    /// The bytes of a PNG, JPEG or other image file, not decoded.
    pub bytes: Vec<u8>,
}

/// A light in the file, in the model's space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelLight {
    /// Its name in the file.
    pub name: String,
    /// Its kind.
    pub kind: ModelLightKind,
    /// The position of a point light or spot.
    pub position: [f64; 3],
    /// The direction in which a directional light or spot shines, of unit length.
    pub direction: [f64; 3],
    /// Linear RGB, not negative.
    pub color: [f32; 3],
    /// The intensity in the file's own unit (glTF: lux for directional lights, candela for others), not negative.
    pub intensity: f32,
    /// `k_c`, `k_l`, `k_q` of 1 / (k_c + k_l d + k_q d^2), d in the model's unit. Directional lights ignore it.
    pub attenuation: [f32; 3],
}

/// The kind of a light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModelLightKind {
    /// Light from everywhere.
    Ambient,
    /// Parallel rays.
    Directional,
    /// Light in all directions.
    Point,
    /// Light within a cone, with half angles in radians: `0 <= inner <= outer <= pi / 2`.
    Spot {
        /// The angle at which the light begins to fall off.
        inner_angle_rad: f32,
        /// The angle at which it ends.
        outer_angle_rad: f32,
    },
}

/// A camera in the file, in the model's space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelCamera {
    /// Its name in the file.
    pub name: String,
    /// The position of the eye.
    pub position: [f64; 3],
    /// The viewing direction, of unit length.
    pub direction: [f64; 3],
    /// The up direction, of unit length and orthogonal to `direction`.
    pub up: [f64; 3],
    /// Vertical field of view in radians; `None` for orthographic cameras.
    pub fov_y_rad: Option<f64>,
    /// Distances of the near and far clip planes, if the file has them.
    pub clip: [Option<f64>; 2],
}
