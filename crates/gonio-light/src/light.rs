//! Light sources: what reaches a point, from where, and how much weaker.

use crate::color::smoothstep;
use crate::vector;
use glam::DVec3;

/// `att = 1 / (constant + linear d + quadratic d^2)`, `d` in world units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attenuation {
    /// `k_c`, no unit, >= 0.
    pub constant: f64,
    /// `k_l`, 1 / world unit, >= 0.
    pub linear: f64,
    /// `k_q`, 1 / world unit squared, >= 0.
    pub quadratic: f64,
}

impl Attenuation {
    /// No attenuation: 1 at every distance.
    pub const NONE: Attenuation = Attenuation { constant: 1.0, linear: 0.0, quadratic: 0.0 };
    /// The inverse square law: `L_i` is then a radiant intensity in W/sr.
    pub const INVERSE_SQUARE: Attenuation = Attenuation { constant: 0.0, linear: 0.0, quadratic: 1.0 };
    /// Attenuation never exceeds this, so that a light at distance 0 with `k_c = 0` makes neither
    /// infinity nor NaN. (1e6: a point light 1 mm away where the unit is a metre.)
    pub const CAP: f64 = 1e6;

    /// The factor at distance `d` >= 0, in `[0, CAP]`.
    pub fn at(&self, d: f64) -> f64 {
        let denominator = self.constant + self.linear * d + self.quadratic * d * d;
        // Written so that 0, negative and NaN denominators all give the cap.
        if denominator > 1.0 / Self::CAP { 1.0 / denominator } else { Self::CAP }
    }
}

/// The kinds of light source of Appendix 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Reaches every point equally from everywhere: it adds to `A`, not to the sum.
    Ambient,
    /// Parallel rays. No position, no attenuation.
    Directional {
        /// Unit vector along which the light travels, in world space (from the light to the scene).
        direction: DVec3,
    },
    /// Radiates equally in all directions.
    Point {
        /// In world space.
        position: DVec3,
    },
    /// A point light behind a cone.
    Spot {
        /// In world space.
        position: DVec3,
        /// Unit vector along the cone's axis, away from the light, in world space.
        axis: DVec3,
        /// Half angle of the fully lit cone, radians, in `[0, outer_rad]`.
        inner_rad: f64,
        /// Half angle at which the light ends, radians, in `[inner_rad, pi/2]`.
        outer_rad: f64,
    },
}

/// One light of the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// What kind, and where.
    pub kind: LightKind,
    /// `L_i`: linear RGB, each >= 0. Lab convention: a colour. Physical: intensity in W/sr (point,
    /// spot), irradiance perpendicular to the rays in W/m^2 (directional).
    pub color: DVec3,
    /// Applies to points and spots only.
    pub attenuation: Attenuation,
}

/// What one light sends to one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incident {
    /// `L`: unit vector from the point to the light, in world space.
    pub direction: DVec3,
    /// `d` in world units; infinite for directional lights.
    pub distance: f64,
    /// `att_i`, in `[0, Attenuation::CAP]`; 1 for directional lights.
    pub attenuation: f64,
    /// `spot_i` in `[0, 1]`; 1 for all other kinds.
    pub spot: f64,
}

impl Light {
    /// What reaches `position` (world space), or `None` for an ambient light.
    ///
    /// A light at the very point has no direction: `fallback` (a unit vector, the normal) stands in.
    pub fn incident(&self, position: DVec3, fallback: DVec3) -> Option<Incident> {
        let from = |light_position: DVec3| {
            let to_light = light_position - position;
            let distance = to_light.length();
            (vector::unit(to_light).unwrap_or(fallback), distance, self.attenuation.at(distance))
        };
        match self.kind {
            LightKind::Ambient => None,
            LightKind::Directional { direction } => {
                Some(Incident { direction: -direction, distance: f64::INFINITY, attenuation: 1.0, spot: 1.0 })
            }
            LightKind::Point { position } => {
                let (direction, distance, attenuation) = from(position);
                Some(Incident { direction, distance, attenuation, spot: 1.0 })
            }
            LightKind::Spot { position, axis, inner_rad, outer_rad } => {
                let (direction, distance, attenuation) = from(position);
                let spot = smoothstep(outer_rad.cos(), inner_rad.cos(), -direction.dot(axis));
                Some(Incident { direction, distance, attenuation, spot })
            }
        }
    }
}

/// The scene's ambient colour: the sum of its ambient lights. Never attenuated, never shadowed.
pub fn ambient_color(lights: &[Light]) -> DVec3 {
    lights.iter().filter(|l| l.kind == LightKind::Ambient).map(|l| l.color).sum()
}
