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
        /// The position, world space.
        position: DVec3,
    },
    /// A point light behind a cone.
    Spot {
        /// The position, world space.
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
    /// direction: `fallback` (a unit vector, the normal) replaces it.
    pub fn incident(&self, position: DVec3, fallback: DVec3) -> Option<Incident> {
        let from = |light_position: DVec3| {
            let to_light = light_position - position;
            // Two points at opposite ends of f64's range: too far for their distance to be represented, but not a
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Asserts that two numbers differ by at most `tolerance`, absolutely or relative to the larger.
    #[track_caller]
    fn assert_close(a: f64, b: f64, tolerance: f64) {
        let scale = a.abs().max(b.abs()).max(1.0);
        assert!((a - b).abs() <= tolerance * scale, "{a} and {b} differ by {:e}", (a - b).abs());
    }

    fn light(kind: LightKind, attenuation: Attenuation) -> Light {
        Light { kind, color: DVec3::ONE, attenuation }
    }

    #[test]
    fn attenuation_of_the_labs_light() {
        let lab = Attenuation { constant: 1.0, linear: 0.14, quadratic: 0.07 };
        assert_close(lab.at(0.0), 1.0, 1e-15);
        assert_close(lab.at(2.0), 1.0 / 1.56, 1e-15);
        assert_close(lab.at(10.0), 1.0 / 9.4, 1e-15);
        assert_eq!(Attenuation::NONE.at(1e200), 1.0);
    }

    #[test]
    fn inverse_square_at_three_distances() {
        for d in [1.0, 2.0, 4.0] {
            let incident = light(LightKind::Point { position: DVec3::Y * d }, Attenuation::INVERSE_SQUARE)
                .incident(DVec3::ZERO, DVec3::Y)
                .unwrap();
            assert_close(incident.attenuation, 1.0 / (d * d), 1e-15);
            assert_eq!((incident.distance, incident.direction), (d, DVec3::Y));
        }
    }

    #[test]
    fn attenuation_is_capped_and_never_nan() {
        let extremes = [0.0, 1e-320, 1e-12, 1.0, 1e12, 1e160, 1e300, f64::MAX, f64::INFINITY];
        for d in extremes {
            for constant in extremes {
                for linear in [0.0, 1.0, 1e300] {
                    for quadratic in [0.0, 1.0, 1e300] {
                        let factor = Attenuation { constant, linear, quadratic }.at(d);
                        assert!(
                            (0.0..=Attenuation::CAP).contains(&factor),
                            "{constant} {linear} {quadratic} {d}: {factor}"
                        );
                    }
                }
            }
        }
        assert_eq!(Attenuation::INVERSE_SQUARE.at(0.0), Attenuation::CAP);
        assert_eq!(Attenuation::INVERSE_SQUARE.at(1e-3), Attenuation::CAP);
        assert_eq!(Attenuation::INVERSE_SQUARE.at(f64::INFINITY), 0.0);
        assert_eq!(Attenuation { constant: 0.0, linear: 0.0, quadratic: 0.0 }.at(1.0), Attenuation::CAP);
        assert_eq!(Attenuation { constant: -1.0, linear: 0.0, quadratic: 0.0 }.at(1.0), Attenuation::CAP);
    }

    #[test]
    fn a_light_at_the_point_shines_along_the_normal() {
        let point = light(LightKind::Point { position: DVec3::ONE }, Attenuation::INVERSE_SQUARE);
        let incident = point.incident(DVec3::ONE, DVec3::X).unwrap();
        assert_eq!((incident.direction, incident.distance, incident.attenuation), (DVec3::X, 0.0, Attenuation::CAP));
    }

    #[test]
    fn a_light_beyond_the_range_of_f64_is_far_away_and_not_directional() {
        let point = light(LightKind::Point { position: DVec3::X * f64::MAX }, Attenuation::INVERSE_SQUARE);
        let incident = point.incident(DVec3::NEG_X * f64::MAX, DVec3::Y).unwrap();
        assert_eq!((incident.distance, incident.attenuation), (f64::MAX, 0.0));
    }

    #[test]
    fn directional_light_comes_against_its_direction_unattenuated() {
        let sun = light(LightKind::Directional { direction: DVec3::new(0.0, -2.0, 0.0) }, Attenuation::INVERSE_SQUARE);
        let incident = sun.incident(DVec3::splat(1e9), DVec3::X).unwrap();
        assert_eq!((incident.direction, incident.attenuation, incident.spot), (DVec3::Y, 1.0, 1.0));
        assert!(incident.distance.is_infinite());
        let none = light(LightKind::Directional { direction: DVec3::ZERO }, Attenuation::NONE);
        assert_eq!(none.incident(DVec3::ZERO, DVec3::X).unwrap().direction, DVec3::X);
    }

    #[test]
    fn ambient_light_comes_from_nowhere() {
        assert_eq!(light(LightKind::Ambient, Attenuation::NONE).incident(DVec3::ZERO, DVec3::Y), None);
    }

    #[test]
    fn a_spot_is_full_inside_and_ends_at_its_outer_angle() {
        let (inner_rad, outer_rad) = (20f64.to_radians(), 30f64.to_radians());
        let spot_at = |degrees: f64| {
            let angle = degrees.to_radians();
            let kind = LightKind::Spot { position: DVec3::Y, axis: DVec3::NEG_Y, inner_rad, outer_rad };
            // On the plane y = 0, at `degrees` off the axis.
            light(kind, Attenuation::NONE).incident(DVec3::X * angle.tan(), DVec3::Y).unwrap().spot
        };
        assert_eq!((spot_at(0.0), spot_at(19.9), spot_at(30.1), spot_at(80.0)), (1.0, 1.0, 0.0, 0.0));
        // Halfway between the *cosines* it is 1/2 by smoothstep's symmetry.
        let halfway = (0.5 * (inner_rad.cos() + outer_rad.cos())).acos().to_degrees();
        assert_close(spot_at(halfway), 0.5, 1e-12);
        let mut last = 1.0;
        for step in 0..=200 {
            let value = spot_at(15.0 + 0.1 * f64::from(step));
            assert!(value <= last && (0.0..=1.0).contains(&value));
            last = value;
        }
    }

    #[test]
    fn a_spot_with_a_hard_edge_is_a_step() {
        let angle = 30f64.to_radians();
        let at = |degrees: f64, axis| {
            let kind = LightKind::Spot { position: DVec3::Y, axis, inner_rad: angle, outer_rad: angle };
            light(kind, Attenuation::NONE).incident(DVec3::X * degrees.to_radians().tan(), DVec3::Y).unwrap().spot
        };
        assert_eq!((at(29.99, DVec3::NEG_Y), at(30.01, DVec3::NEG_Y)), (1.0, 0.0));
        // An axis of another length is the same axis.
        assert_eq!((at(29.99, DVec3::NEG_Y * 5.0), at(30.01, DVec3::NEG_Y * 5.0)), (1.0, 0.0));
        assert_eq!(at(0.0, DVec3::ZERO), 0.0);
    }

    #[test]
    fn smoothstep_known_values() {
        assert_eq!(smoothstep_or_step(0.0, 1.0, 0.5), 0.5);
        assert_eq!(smoothstep_or_step(0.0, 1.0, 0.25), 0.15625);
        assert_eq!(smoothstep_or_step(2.0, 4.0, 1.0), 0.0);
        assert_eq!(smoothstep_or_step(2.0, 4.0, 5.0), 1.0);
        assert_eq!((smoothstep_or_step(1.0, 1.0, 0.999), smoothstep_or_step(1.0, 1.0, 1.0)), (0.0, 1.0));
        assert_eq!((smoothstep_or_step(2.0, 1.0, 1.5), smoothstep_or_step(2.0, 1.0, 2.0)), (0.0, 1.0));
    }
}
