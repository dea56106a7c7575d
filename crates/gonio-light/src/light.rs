//! Light sources: what reaches a point, from where, and how much weaker.

use crate::color::{capped, unit_interval};
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
        // Horner's form and a finite d: a coefficient of 0 stays 0 however far the light is, where
        // 0 * d^2 would be 0 * infinity.
        let d = d.min(f64::MAX);
        let denominator = self.constant + d * (self.linear + self.quadratic * d);
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
    /// The kind, with position and direction.
    pub kind: LightKind,
    /// `L_i`: linear RGB, each >= 0. Lab convention: a colour. Physical: intensity in W/sr (point,
    /// spot), irradiance perpendicular to the rays in W/m^2 (directional).
    pub color: DVec3,
    /// Applies to points and spots only.
    pub attenuation: Attenuation,
}

/// The light from one source at one point.
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
    /// The light that reaches `position` (world space), or `None` for an ambient light.
    ///
    /// A light at the very point (or a directional light whose direction is degenerate) has no
    /// direction: `fallback` (a unit vector, the normal) stands in.
    pub fn incident(&self, position: DVec3, fallback: DVec3) -> Option<Incident> {
        let from = |light_position: DVec3| {
            let to_light = light_position - position;
            // Two points at opposite ends of f64's range: too far to say how far, but not a
            // directional light.
            let distance = vector::safe_length(to_light).min(f64::MAX);
            (vector::unit_or(to_light, fallback), distance, self.attenuation.at(distance))
        };
        match self.kind {
            LightKind::Ambient => None,
            LightKind::Directional { direction } => {
                let direction = vector::unit_or(-direction, fallback);
                Some(Incident { direction, distance: f64::INFINITY, attenuation: 1.0, spot: 1.0 })
            }
            LightKind::Point { position } => {
                let (direction, distance, attenuation) = from(position);
                Some(Incident { direction, distance, attenuation, spot: 1.0 })
            }
            LightKind::Spot { position, axis, inner_rad, outer_rad } => {
                let (direction, distance, attenuation) = from(position);
                let along_axis = -direction.dot(vector::unit_or(axis, DVec3::ZERO));
                let spot = smoothstep_or_step(outer_rad.cos(), inner_rad.cos(), along_axis);
                Some(Incident { direction, distance, attenuation, spot })
            }
        }
    }
}

/// The scene's ambient colour: the sum of its ambient lights. Never attenuated, never shadowed.
pub fn ambient_color(lights: &[Light]) -> DVec3 {
    capped(lights.iter().filter(|l| l.kind == LightKind::Ambient).map(|l| l.color).sum())
}

/// GLSL's `smoothstep`; where the edges are equal or in the wrong order, a step at `edge0` (GLSL leaves
/// that undefined). The step is 1 at `x = edge0`.
pub fn smoothstep_or_step(edge0: f64, edge1: f64, x: f64) -> f64 {
    let width = edge1 - edge0;
    if width > 0.0 {
        let t = unit_interval((x - edge0) / width);
        t * t * (3.0 - 2.0 * t)
    } else if x < edge0 {
        0.0
    } else {
        1.0
    }
}
