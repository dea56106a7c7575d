//! Rusinkiewicz's coordinates of two directions: half and difference vector.
//!
//! `theta_h` is the angle between the normal and the half vector, `theta_d` the one between the half vector and the
//! directions, `phi_d` the azimuth of `wi` about the half vector. Source: S. M. Rusinkiewicz, *A New Change of Variables for
//! Efficient BRDF Representation*, EGWR 1998.

use crate::sampling::direction;
use gonio_light::DVec3;
use gonio_light::vector::{half_vector, reflection};
use std::f64::consts::PI;

/// The coordinates of an isotropic function, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfAngles {
    /// In `[0, pi / 2]`.
    pub theta_h: f64,
    /// In `[0, pi / 2]`.
    pub theta_d: f64,
    /// In `[0, pi)`: `phi_d + pi` exchanges `wi` and `wo`, which a reciprocal function does not notice.
    pub phi_d: f64,
}

impl HalfAngles {
    /// The coordinates of two directions above the horizon.
    pub fn of(wi: DVec3, wo: DVec3) -> Self {
        let h = half_vector(wi, wo, DVec3::Z);
        let across = h.x.hypot(h.y);
        let theta_h = across.atan2(h.z);
        let (cos_phi, sin_phi) = if across > 1e-12 { (h.x / across, h.y / across) } else { (1.0, 0.0) };
        // wi turned by -phi_h about the normal, then by -theta_h about the bitangent.
        let turned = DVec3::new(wi.x * cos_phi + wi.y * sin_phi, wi.y * cos_phi - wi.x * sin_phi, wi.z);
        let d = DVec3::new(turned.x * h.z - turned.z * across, turned.y, turned.x * across + turned.z * h.z);
        let phi = d.y.atan2(d.x);
        HalfAngles { theta_h, theta_d: d.x.hypot(d.y).atan2(d.z), phi_d: if phi < 0.0 { phi + PI } else { phi } }
    }

    /// Two directions with these coordinates and their half vector in the plane of normal and tangent.
    pub fn directions(self) -> (DVec3, DVec3) {
        let h = direction(self.theta_h, 0.0);
        let d = direction(self.theta_d, self.phi_d);
        let wi = DVec3::new(d.x * h.z + d.z * h.x, d.y, d.z * h.z - d.x * h.x);
        (wi, reflection(h, wi))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_round_trip() {
        for theta_h in [0.1, 0.5, 0.9] {
            for theta_d in [0.1, 0.4, 0.6] {
                for phi_d in [0.0, 0.7, 1.6, 3.0] {
                    let angles = HalfAngles { theta_h, theta_d, phi_d };
                    let (wi, wo) = angles.directions();
                    // Exchanged directions have the opposite azimuth, which is the same modulo pi.
                    for found in [(wi, wo), (turn(wi), turn(wo)), (wo, wi)] {
                        let found = HalfAngles::of(found.0, found.1);
                        let turn = (found.phi_d - phi_d).abs();
                        let error = (found.theta_h - theta_h).abs() + (found.theta_d - theta_d).abs();
                        assert!(error + turn.min(PI - turn) < 1e-9, "{angles:?} {found:?}");
                    }
                }
            }
        }
    }

    /// Turned about the normal: the same isotropic coordinates.
    fn turn(w: DVec3) -> DVec3 {
        DVec3::new(0.6 * w.x - 0.8 * w.y, 0.8 * w.x + 0.6 * w.y, w.z)
    }
}
