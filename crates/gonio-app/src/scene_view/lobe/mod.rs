//! The lobe at the pinned pixel: the light that the surface sends in each direction, of the light that contributes most there.
//!
//! It stands on the surface, and in an inset it is seen from the side: the eye looks along V, so that only there V is an arrow
//! and the value towards the eye a length. Panes with other BRDFs show their lobes at the same point.

mod paint;

pub use paint::{inset, on_surface};

use crate::session::Selection;
use crate::session::probing::Probing;
use gonio_light::vector::{any_orthonormal_vector, unit_or};
use gonio_light::{DVec3, Equation, Light, LightTerms, ShadingPoint, Surface};
use gonio_plot::lobe::polar_angles;
use gonio_scene::Frame;
use std::f64::consts::PI;

/// Even steps of the polar angle and of the azimuth; closer ones are added about R.
const STEPS: [u32; 2] = [18, 36];
/// Directions this close to the horizon, in radians, are left out.
const HORIZON: f64 = 2e-3;

/// The light that a point sends in each direction, of one light.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceLobe {
    /// The point; world space. Its `view` is V.
    pub point: ShadingPoint,
    /// L and R; unit vectors in world space.
    pub light: DVec3,
    pub mirror: DVec3,
    /// Unit vectors above the surface, in world space: `rows` times `columns`.
    pub directions: Vec<DVec3>,
    /// Rows of equal polar angle, and columns of equal azimuth.
    pub rows: usize,
    pub columns: usize,
    /// The light in each direction as a share of the largest, in `[0, 1]`.
    pub shares: Vec<f64>,
    /// The largest light of all directions, mean of the channels.
    pub largest: f64,
    /// The light towards the eye, mean of the channels.
    pub to_eye: f64,
}

impl SurfaceLobe {
    /// The lobe of one light's diffuse and specular term; `visibility` is the share of the light that reaches the point.
    /// `None` for an ambient light, or if nothing is reflected.
    pub fn new(
        equation: &Equation,
        light: &Light,
        visibility: f64,
        point: &ShadingPoint,
        surface: &Surface,
    ) -> Option<Self> {
        let terms = |view: DVec3| equation.light_terms(0, light, &ShadingPoint { view, ..*point }, surface);
        let sent = |view: DVec3| terms(view).map_or(0.0, |terms| visibility * mean(terms.diffuse + terms.specular));
        let LightTerms { l, r, .. } = terms(point.view)?;
        let n = point.normal;
        let across = unit_or(r - n * n.dot(r), any_orthonormal_vector(n));
        let aside = n.cross(across);
        let last = 0.5 * PI - HORIZON;
        let thetas = polar_angles(0.0, last, STEPS[0], n.dot(r).clamp(-1.0, 1.0).acos().min(last));
        let phis = polar_angles(-PI, PI, STEPS[1], 0.0);
        let direction = |theta: f64, phi: f64| {
            let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
            cos * n + sin * (cos_phi * across + sin_phi * aside)
        };
        let directions: Vec<DVec3> =
            thetas.iter().flat_map(|theta| phis.iter().map(|phi| direction(*theta, *phi))).collect();
        let values: Vec<f64> = directions.iter().map(|direction| sent(*direction)).collect();
        let to_eye = sent(point.view);
        let largest = values.iter().copied().filter(|value| value.is_finite()).fold(to_eye, f64::max);
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        let shares = values.into_iter().map(|value| if value.is_finite() { (value / largest).max(0.0) } else { 0.0 });
        Some(SurfaceLobe {
            point: *point,
            light: l,
            mirror: r,
            shares: shares.collect(),
            directions,
            rows: thetas.len(),
            columns: phis.len(),
            largest,
            to_eye,
        })
    }

    /// The light towards the eye as a share of the largest, in `[0, 1]`.
    pub fn eye_share(&self) -> f64 {
        (self.to_eye / self.largest).clamp(0.0, 1.0)
    }
}

fn mean(color: DVec3) -> f64 {
    (color.x + color.y + color.z) / 3.0
}

/// The lobe of the pinned pixel in a picture with this frame; `None` if nothing is pinned or the lobe is hidden.
pub fn at_pin(probing: &Probing, selection: Selection, frame: &Frame) -> Option<SurfaceLobe> {
    if probing.pinned.is_none() || !probing.shows_lobe {
        return None;
    }
    let probe = probing.reading()?.probe.as_ref()?;
    let leading = super::vectors::leading(probe, selection)?;
    let light = frame.lights.get(leading.light)?;
    let at = &probe.terms.point;
    let point = ShadingPoint { view: unit_or(frame.camera.position - at.position, at.view), ..*at };
    SurfaceLobe::new(&frame.equation, light, leading.visibility, &point, &probe.surface)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_light::brdf::{BrdfKind, BrdfSettings};
    use gonio_light::{Attenuation, LightKind, Specular};

    fn lobe_of(equation: &Equation, view: DVec3, shininess: f64) -> Option<SurfaceLobe> {
        let kind = LightKind::Directional { direction: DVec3::new(1.0, -1.0, 0.0).normalize() };
        let light = Light { kind, color: DVec3::ONE, attenuation: Attenuation::NONE };
        let point = ShadingPoint { position: DVec3::ZERO, normal: DVec3::Y, view, tangent: DVec3::X };
        let surface =
            Surface { diffuse: DVec3::splat(0.2), specular: DVec3::splat(0.5), shininess, ..Surface::default() };
        SurfaceLobe::new(equation, &light, 1.0, &point, &surface)
    }

    #[test]
    fn phongs_lobe_is_largest_along_r() {
        let equation = Equation { specular: Specular::Phong, ..Equation::default() };
        let r = DVec3::new(1.0, 1.0, 0.0).normalize();
        // The eye is in the mirror direction.
        let lobe = lobe_of(&equation, r, 50.0).unwrap();
        assert!((lobe.mirror - r).length() < 1e-9);
        // 0.2 cos 45° + 0.5.
        let expected = 0.2 * 0.5_f64.sqrt() + 0.5;
        assert!((lobe.largest - expected).abs() < 1e-9 && (lobe.eye_share() - 1.0).abs() < 1e-9, "{}", lobe.largest);
        let at_r = lobe.directions.iter().zip(&lobe.shares).filter(|(_, share)| **share > 0.999);
        assert!(at_r.clone().count() > 0 && at_r.clone().all(|(w, _)| w.dot(r) > 0.999));
        // Towards the light there is the diffuse term alone.
        let back = lobe_of(&equation, DVec3::new(-1.0, 1.0, 0.0).normalize(), 50.0).unwrap();
        assert!((back.to_eye - 0.2 * 0.5_f64.sqrt()).abs() < 1e-9, "{}", back.to_eye);
        assert!((back.largest - expected).abs() < 1e-6, "a lobe has a sample along R: {}", back.largest);
    }

    #[test]
    fn brdfs_have_lobes_of_their_own_and_all_values_are_shares() {
        let view = DVec3::new(0.4, 0.8, 0.3).normalize();
        let mut largest = Vec::new();
        for kind in [BrdfKind::Phong, BrdfKind::Blinn, BrdfKind::Ward] {
            let equation = Equation { brdf: Some(BrdfSettings::new(kind)), ..Equation::default() };
            let lobe = lobe_of(&equation, view, 30.0).unwrap();
            assert_eq!(lobe.shares.len(), lobe.rows * lobe.columns);
            assert!(lobe.shares.iter().all(|share| (0.0..=1.0).contains(share)));
            assert!(lobe.directions.iter().all(|w| w.y > 0.0 && (w.length() - 1.0).abs() < 1e-9));
            largest.push(lobe.to_eye);
        }
        assert!(largest[0] != largest[1] && largest[1] != largest[2], "{largest:?}");
    }

    #[test]
    fn a_black_surface_has_no_lobe() {
        let off = gonio_light::TermSwitches { diffuse: false, specular: false, ..Default::default() };
        assert!(lobe_of(&Equation { terms: off, ..Equation::default() }, DVec3::Y, 10.0).is_none());
    }
}
