//! The values of a scene that a person left out.
//!
//! Loading, the window's controls and the schema of scene files all take them from here. Defaults of keys that every
//! scene file has in full (`picture`, `background`, ...) are the `Default` of their types in [`crate::scene_file`].

use crate::color_value::Color;
use gonio_light::Convention;

/// The up direction.
pub const UP: [f64; 3] = [0.0, 1.0, 0.0];
/// Yaw of a camera that has only a pitch, degrees: along -Z.
pub const YAW: f64 = -90.0;
/// Pitch of a camera that has only a yaw, degrees: level.
pub const PITCH: f64 = 0.0;
/// Full vertical field of view, degrees: about that of a portrait lens.
pub const FOV_Y: f64 = 40.0;
/// Distance of the near plane of a scene without objects, world units.
pub const NEAR: f64 = 0.1;
/// Distance of the far plane of a scene without objects, world units.
pub const FAR: f64 = 100.0;

/// The colour of a light.
pub const LIGHT_COLOR: Color = Color::grey(1.0);
/// The factor of a light's colour.
pub const LIGHT_INTENSITY: f64 = 1.0;
/// The radius of a point light or a spot, world units.
pub const LIGHT_RADIUS: f64 = 0.0;
/// Width and height of a rectangle, world units.
pub const LIGHT_SIZE: [f64; 2] = [1.0, 1.0];
/// `k_c`, `k_l` and `k_q` of a point light or a spot: no attenuation.
pub const ATTENUATION: [f64; 3] = [1.0, 0.0, 0.0];
/// Half angle of a spot's fully lit cone, degrees.
pub const INNER_ANGLE: f64 = 20.0;
/// Half angle at which a spot ends, degrees.
pub const OUTER_ANGLE: f64 = 30.0;
/// The axis that a light circles about.
pub const MOTION_AXIS: [f64; 3] = [0.0, 1.0, 0.0];

/// Whether the specular term is weighted by the cosine: the lab's equation lacks this factor.
pub fn cosine_weighted(convention: Convention) -> bool {
    convention == Convention::Physical
}

/// Whether objects cast shadows: the light equation has none, the rendering equation does.
pub fn shadows(convention: Convention) -> bool {
    convention == Convention::Physical
}
