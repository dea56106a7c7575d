//! Stokes vectors and Mueller matrices.
//!
//! A Stokes vector `(I, Q, U, V)` refers to a basis across the light's direction `k`: an axis `x`, and `y = k x x`. `Q` is
//! the light along `x` less that along `y`, `U` the same for axes turned by 45 degrees, `V` the circular part.
//!
//! *Sources*: G. G. Stokes, *On the Composition and Resolution of Streams of Polarized Light from different Sources*, 1852;
//! E. Collett, *Field Guide to Polarization*, SPIE 2005.

use crate::complex::{Complex, boundary_amplitudes};
use glam::{DMat4, DVec3, DVec4, Vec4Swizzles};

/// Unpolarised light of intensity 1.
pub const UNPOLARISED: DVec4 = DVec4::X;

/// Light of intensity 1, of which the share `degree` is linearly polarised along `x`.
pub fn polarised(degree: f64) -> DVec4 {
    DVec4::new(1.0, degree, 0.0, 0.0)
}

/// The share of light that is polarised, 0 to 1.
pub fn degree_of_polarisation(stokes: DVec4) -> f64 {
    if stokes.x > 0.0 { stokes.yzw().length() / stokes.x } else { 0.0 }
}

/// A matrix by its rows.
fn rows(rows: [[f64; 4]; 4]) -> DMat4 {
    DMat4::from_cols_array_2d(&rows).transpose()
}

/// The same light in a basis turned by `angle` about its direction, counterclockwise as the light's target sees it.
pub fn rotation(angle_rad: f64) -> DMat4 {
    let (sin, cos) = (2.0 * angle_rad).sin_cos();
    rows([[1.0, 0.0, 0.0, 0.0], [0.0, cos, sin, 0.0], [0.0, -sin, cos, 0.0], [0.0, 0.0, 0.0, 1.0]])
}

/// From the basis with axis `from` to that with axis `to`, both unit vectors across the direction `k`.
pub fn change_of_basis(k: DVec3, from: DVec3, to: DVec3) -> DMat4 {
    rotation(from.cross(to).dot(k).atan2(from.dot(to)))
}

/// An ideal linear polariser whose axis is turned by `angle` from `x`.
pub fn polariser(angle_rad: f64) -> DMat4 {
    let along_x = rows([[0.5, 0.5, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [0.0; 4], [0.0; 4]]);
    rotation(-angle_rad) * along_x * rotation(angle_rad)
}

/// The effect of the amplitudes `s` (along `x`) and `p` (along `y`), and a factor of the flux.
fn of_amplitudes(s: Complex, p: Complex, factor: f64) -> DMat4 {
    let (sum, difference) = (0.5 * (s.square() + p.square()), 0.5 * (s.square() - p.square()));
    let cross = s * p.conjugate();
    factor
        * rows([
            [sum, difference, 0.0, 0.0],
            [difference, sum, 0.0, 0.0],
            [0.0, 0.0, cross.re, cross.im],
            [0.0, 0.0, -cross.im, cross.re],
        ])
}

/// Reflection and transmission of flux by a smooth boundary from index `n_i` to `n_t`, in bases with `x` across the plane of
/// incidence. `cos_i`: the cosine of the angle of incidence.
pub fn boundary(cos_i: f64, n_i: f64, n_t: f64) -> [DMat4; 2] {
    let cos_i = cos_i.clamp(1e-9, 1.0);
    let waves = boundary_amplitudes(Complex::real(n_i), Complex::real(cos_i), Complex::real(n_t));
    let ([r_s, r_p], [t_s, t_p]) = (waves.reflected, waves.transmitted);
    // Flux across the boundary: Born and Wolf, section 1.5.3. The real part is 0 where reflection is total.
    let factor = n_t * waves.cos_t.re / (n_i * cos_i);
    [of_amplitudes(r_s, r_p, 1.0), of_amplitudes(t_s, t_p, factor)]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use gonio_light::optics::{brewster_angle_rad, polarised_dielectric};
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    /// Issue 21: Fresnel's R_s and R_p at 20 angles to 1e-6, from both sides; nothing is lost.
    #[test]
    fn boundaries_reflect_as_fresnel_found() {
        for (n_i, n_t) in [(1.0, 1.333), (1.333, 1.0), (1.0, 2.4)] {
            for index in 0..20 {
                let cos = (0.5 + 4.5 * f64::from(index)).to_radians().cos();
                let [reflection, transmission] = boundary(cos, n_i, n_t);
                let expected = polarised_dielectric(cos, n_i / n_t);
                for (q, expected) in [1.0, -1.0].into_iter().zip(expected) {
                    let light = polarised(q);
                    assert!(((reflection * light).x - expected).abs() < 1e-6, "{n_i} {n_t} {index} {q}");
                    assert!(((transmission * light).x - (1.0 - expected)).abs() < 1e-6, "{n_i} {n_t} {index} {q}");
                }
            }
        }
    }

    #[test]
    fn malus_law_holds_at_every_angle() {
        for (axis, angle) in (0..24).flat_map(|a| (0..24).map(move |b| (f64::from(a) * 0.2, f64::from(b) * 0.3))) {
            let light = polariser(axis) * UNPOLARISED;
            assert!((light.x - 0.5).abs() < 1e-12 && (degree_of_polarisation(light) - 1.0).abs() < 1e-12);
            let passed = (polariser(angle) * light).x;
            assert!((passed - 0.5 * (angle - axis).cos().powi(2)).abs() < 1e-12, "{axis} {angle}");
        }
    }

    #[test]
    fn polarisation_is_complete_at_brewsters_angle_only() {
        let at = |angle: f64| degree_of_polarisation(boundary(angle.cos(), 1.0, 1.333)[0] * UNPOLARISED);
        let brewster = brewster_angle_rad(1.0 / 1.333);
        assert!((at(brewster) - 1.0).abs() < 1e-9);
        assert!(at(brewster - 0.05) < 0.995 && at(brewster + 0.05) < 0.995 && at(0.01) < 0.01);
    }

    /// Total reflection keeps all light and turns linear polarisation into elliptical: Fresnel's rhomb of two reflections at
    /// 54.6 degrees in glass of 1.51 makes it circular.
    #[test]
    fn fresnels_rhomb_makes_circular_light() {
        let once = boundary(54.623_f64.to_radians().cos(), 1.51, 1.0)[0];
        let light = once * once * (rotation(FRAC_PI_4) * polarised(1.0));
        assert!((light.x - 1.0).abs() < 1e-9 && light.w.abs() > 0.9999, "{light}");
    }

    #[test]
    fn bases_turn_with_the_light() {
        let (k, x) = (DVec3::Z, DVec3::X);
        let turned = change_of_basis(k, x, DVec3::Y) * polarised(1.0);
        assert!((turned - polarised(-1.0)).length() < 1e-12);
        let round = change_of_basis(k, DVec3::Y, x) * change_of_basis(k, x, DVec3::Y);
        assert!((round * DVec4::new(1.0, 0.2, 0.3, 0.4) - DVec4::new(1.0, 0.2, 0.3, 0.4)).length() < 1e-12);
        assert!((rotation(FRAC_PI_2) * polarised(1.0) - polarised(-1.0)).length() < 1e-12);
    }

    /// Light of a panel that glass and then water reflect, with planes of incidence turned by an angle against each other.
    fn crossed(turn_rad: f64) -> DVec4 {
        let (sin, cos) = 70.0_f64.to_radians().sin_cos();
        let mirrored = |direction: DVec3, normal: DVec3| direction - 2.0 * direction.dot(normal) * normal;
        // From the camera to the water, the glass and the panel.
        let (sight, water) = (DVec3::new(sin, 0.0, -cos), DVec3::Z);
        let to_glass = mirrored(sight, water);
        let side = sight.cross(water).normalize();
        let tilt = turn_rad.cos() * side.cross(to_glass) + turn_rad.sin() * side;
        let glass = -cos * to_glass + sin * tilt;
        // And back.
        let from_glass = -to_glass;
        let light = boundary(cos, 1.0, 1.5)[0] * UNPOLARISED;
        let (across_glass, across_water) = (from_glass.cross(glass).normalize(), from_glass.cross(water).normalize());
        boundary(cos, 1.0, 1.333)[0] * (change_of_basis(from_glass, across_glass, across_water) * light)
    }

    /// Issue 21: Mitsuba's polarised path tracer has the same light within 3 standard errors.
    #[test]
    fn two_reflections_are_those_of_mitsuba() {
        let reference = include_str!("../../../tests/mitsuba/reference.txt");
        let mut count = 0;
        for line in reference.lines().filter_map(|line| line.strip_prefix("crossed ")) {
            let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
            let &[turn, light, light_error, linear, linear_error] = numbers.as_slice() else { panic!("{line}") };
            let stokes = crossed(turn.to_radians());
            assert!((stokes.x - light).abs() < 3.0 * light_error, "{turn}: {stokes} {light}");
            let found = stokes.y.hypot(stokes.z);
            assert!((found - linear).abs() < 3.0 * linear_error, "{turn}: {stokes} {linear}");
            count += 1;
        }
        assert_eq!(count, 5);
    }
}
