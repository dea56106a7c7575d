//! Lights and motions as a scene file has them.

use crate::color_value::Color;
use crate::defaults;
use gonio_light::named_enum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

named_enum! {
    /// A kind of light source.
    pub enum LightSourceKind {
        /// Light from everywhere; adds to A.
        Ambient = "ambient",
        /// Parallel rays along `direction`.
        Directional = "directional",
        /// Light from `position` in all directions.
        Point = "point",
        /// Light from `position` within a cone about `direction`.
        Spot = "spot",
        /// A flat lamp at `position` that shines to the side of `direction`.
        Rectangle = "rectangle",
    }
    default Point;
    what "kind of light";
}

named_enum! {
    /// The motion of a light or an object.
    pub enum MotionKind {
        /// position + amplitude * sin(2 pi time / period)
        Oscillate = "oscillate",
        /// Around `center` about `axis`, starting at the position.
        Circle = "circle",
        /// Along `points`, linearly, one `period` for the whole path, closed.
        Path = "path",
    }
    default Oscillate;
    what "kind of motion";
}

impl LightSourceKind {
    /// Whether its lights have a position, and an attenuation with the distance from it.
    pub fn has_position(self) -> bool {
        matches!(self, LightSourceKind::Point | LightSourceKind::Spot | LightSourceKind::Rectangle)
    }

    /// Whether its lights have a direction.
    pub fn has_direction(self) -> bool {
        matches!(self, LightSourceKind::Directional | LightSourceKind::Spot | LightSourceKind::Rectangle)
    }

    /// Whether its lights may be spheres.
    pub fn has_radius(self) -> bool {
        matches!(self, LightSourceKind::Point | LightSourceKind::Spot)
    }
}

/// A light. Its kind determines its keys; a key of another kind is an error, and so is a missing one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LightSpec {
    /// Ambient, directional, point, spot or rectangle.
    pub kind: LightSourceKind,
    /// The name in reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Whether the light is on; it is by default. A light that is off keeps its number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub enabled: Option<bool>,
    /// The position of point lights and spots, and the centre of rectangles, world space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<[f64; 3]>,
    /// The direction in which directional lights, spots and rectangles shine. Need not have unit length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// The radius of the sphere that a point light or a spot is, world units. The light equation uses its centre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::LIGHT_RADIUS))]
    pub radius: Option<f64>,
    /// Width and height of a rectangle, world units; its width is horizontal. The light equation uses its centre, as a
    /// spot with angles of 0 and 90 degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::LIGHT_SIZE))]
    pub size: Option<[f64; 2]>,
    /// `L_i` is `color` times `intensity`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::LIGHT_COLOR))]
    pub color: Option<Color>,
    /// The spectrum in place of `color`: wavelengths in nm, rising, and relative power. The colour derived from it has
    /// luminance 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Vec<[f64; 2]>>,
    /// `L_i` is `color` times `intensity`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::LIGHT_INTENSITY))]
    pub intensity: Option<f64>,
    /// `k_c` of lights with a position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::ATTENUATION[0]))]
    pub constant: Option<f64>,
    /// `k_l` of lights with a position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::ATTENUATION[1]))]
    pub linear: Option<f64>,
    /// `k_q` of lights with a position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::ATTENUATION[2]))]
    pub quadratic: Option<f64>,
    /// Half angle of a spot's fully lit cone, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::INNER_ANGLE))]
    pub inner_angle: Option<f64>,
    /// Half angle at which a spot ends, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::OUTER_ANGLE))]
    pub outer_angle: Option<f64>,
    /// Its motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionSpec>,
}

/// The motion of a light or an object.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionSpec {
    /// Oscillate, circle or path.
    pub kind: MotionKind,
    /// Seconds, > 0.
    pub period: f64,
    /// The largest displacement of an oscillation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amplitude: Option<[f64; 3]>,
    /// The centre of a circle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// The axis of a circle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::MOTION_AXIS))]
    pub axis: Option<[f64; 3]>,
    /// The points of a path.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<[f64; 3]>>,
}
