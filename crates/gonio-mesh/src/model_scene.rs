//! What a model file may hold besides a model: pictures, lights, cameras.

use serde::Serialize;

/// A picture inside the model's file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EmbeddedImage {
    /// For messages: its name in the file, or its number.
    pub name: String,
    /// PNG, JPEG or another picture file's bytes, not yet looked at.
    pub bytes: Vec<u8>,
}

/// A light of the file, in the model's space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelLight {
    /// Its name in the file.
    pub name: String,
    /// Where it shines.
    pub kind: ModelLightKind,
    /// Of points and spots.
    pub position: [f64; 3],
    /// Of directional lights and spots: the way the light travels, of unit length.
    pub direction: [f64; 3],
    /// Linear RGB, not negative.
    pub color: [f32; 3],
    /// In the file's own unit (glTF: lux of directional lights, candela of others), not negative.
    pub intensity: f32,
    /// `k_c`, `k_l`, `k_q` of 1 / (k_c + k_l d + k_q d^2), d in the model's unit. Directional lights ignore it.
    pub attenuation: [f32; 3],
}

/// Where a light shines.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModelLightKind {
    /// From everywhere.
    Ambient,
    /// Parallel rays.
    Directional,
    /// In all directions.
    Point,
    /// Within a cone: half angles, radians, `0 <= inner <= outer <= pi / 2`.
    Spot {
        /// Where the light begins to fade.
        inner_angle_rad: f32,
        /// Where it ends.
        outer_angle_rad: f32,
    },
}

/// A camera of the file, in the model's space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelCamera {
    /// Its name in the file.
    pub name: String,
    /// The eye.
    pub position: [f64; 3],
    /// Where it looks, of unit length.
    pub direction: [f64; 3],
    /// Of unit length, at right angles to `direction`.
    pub up: [f64; 3],
    /// Vertical opening angle, radians; `None` of parallel projections.
    pub fov_y_rad: Option<f64>,
    /// Distances of the clip planes, where the file says.
    pub clip: [Option<f64>; 2],
}
