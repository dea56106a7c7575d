//! Light of an environment on a surface whose BRDF is any function: a sum over a few directions, each looked up in smaller
//! copies of the environment.
//!
//! ```text
//! L = sum over i of  f(L_i, V) <N.L_i> E(L_i, w_i) w_i        w_i = 1 / (n_lobe p_lobe(L_i) + n_cos <N.L_i> / pi)
//! ```
//!
//! `n_lobe` directions follow a lobe whose shape is measured once per BRDF, `n_cos` the cosine; each counts as if it were drawn
//! from both together. `E(L, w)` is the mean of the environment over about the solid angle `w`, so a small bright light is
//! neither missed nor seen as dots.
//!
//! *Sources*: J. Krivanek and M. Colbert, *Real-time Shading with Filtered Importance Sampling*, EGSR 2008 (lookups in mip levels
//! by the density of samples). E. Veach and L. J. Guibas, *Optimally Combining Sampling Techniques for Monte Carlo Rendering*,
//! SIGGRAPH 1995 (the weights). J. Dupuy and A. Benyoub, *Sampling Visible GGX Normals with Spherical Caps*, HPG 2023.
//! *Limits*: light is averaged over squares of texels where the lobe has other shapes, and the directions do not see what blocks
//! the environment. All directions are in the local frame: tangent +X, bitangent +Y, normal +Z.

use crate::vector::{any_orthonormal_vector, half_vector, reflection};
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, TAU};

/// The golden section, by which the azimuths of neighbouring directions differ: they form a spiral whose turns are as far apart
/// as its points.
pub const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;

/// The smallest cosine between view and normal. Interpolated normals turn away from the view near outlines.
pub const LEAST_VIEW_COSINE: f64 = 0.02;

/// Levels that are added to the one whose texels are as large as the solid angle of a direction: texels of equal area would leave
/// gaps, because solid angles are not squares.
pub const LEVELS_BEYOND: f64 = 0.5;

/// See [`FunctionLobe::is_wide`]: lobes of this slope are 6 degrees wide to either side.
const LEAST_WIDE_SLOPE: f64 = 0.05;

/// The directions that a BRDF reflects light from, as a density to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FunctionLobe {
    /// The GGX slopes of half vectors along tangent and bitangent, positive. About a leaning axis both are equal.
    pub alpha: [f64; 2],
    /// `None`: `L` is the view mirrored at the facets that it sees. Otherwise a round lobe about `(-k V_x, -k V_y, V_z)`: the
    /// mirror direction for `k = 1`, the normal for 0, back to the view for -1.
    pub lean: Option<f64>,
    /// The number of directions that follow the lobe.
    pub lobe_count: u32,
    /// The number of directions that follow the cosine.
    pub cosine_count: u32,
}

/// A point of a spiral in the unit square, for an index below `count`.
pub fn spiral_point(index: u32, count: u32) -> [f64; 2] {
    [(f64::from(index) + 0.5) / f64::from(count.max(1)), (f64::from(index) * GOLDEN_SECTION).fract()]
}

/// The view, turned upwards to the cosine [`LEAST_VIEW_COSINE`] where it lies lower.
pub fn raised_view(v: DVec3) -> DVec3 {
    if v.z >= LEAST_VIEW_COSINE {
        return v;
    }
    let across = v.x.hypot(v.y);
    let (x, y) = if across > 1e-6 { (v.x / across, v.y / across) } else { (1.0, 0.0) };
    let sin = (1.0 - LEAST_VIEW_COSINE * LEAST_VIEW_COSINE).sqrt();
    DVec3::new(sin * x, sin * y, LEAST_VIEW_COSINE)
}

impl FunctionLobe {
    /// A direction of the lobe for the view `v` (above the horizon) from two numbers in `[0, 1)`; it may lie below the horizon.
    pub fn direction(&self, v: DVec3, u: [f64; 2]) -> DVec3 {
        let [ax, ay] = self.alpha;
        let seen = if self.lean.is_some() { DVec3::Z } else { v };
        let stretched = DVec3::new(ax * seen.x, ay * seen.y, seen.z).normalize();
        // A point on the cap of the unit sphere that the view sees mirrored at the upper hemisphere.
        let z = (1.0 - u[0]) * (1.0 + stretched.z) - stretched.z;
        let sin = (1.0 - z * z).max(0.0).sqrt();
        let (sin_phi, cos_phi) = (TAU * u[1]).sin_cos();
        let h = DVec3::new(sin * cos_phi, sin * sin_phi, z) + stretched;
        let h = DVec3::new(ax * h.x, ay * h.y, h.z).normalize();
        let l = reflection(h, seen);
        match self.axis(v) {
            None => l,
            Some(axis) => {
                let tangent = any_orthonormal_vector(axis);
                l.x * tangent + l.y * axis.cross(tangent) + l.z * axis
            }
        }
    }

    /// The density of [`Self::direction`] in 1/sr.
    pub fn density(&self, v: DVec3, l: DVec3) -> f64 {
        let [ax, ay] = self.alpha;
        let (h, seen) = match self.axis(v) {
            None => (half_vector(l, v, DVec3::Z), v),
            Some(axis) => {
                let tangent = any_orthonormal_vector(axis);
                let h = half_vector(l, axis, tangent);
                (DVec3::new(h.dot(tangent), h.dot(axis.cross(tangent)), h.dot(axis)), DVec3::Z)
            }
        };
        // No facet faces down.
        if h.z <= 0.0 {
            return 0.0;
        }
        let slopes = (h.x / ax).powi(2) + (h.y / ay).powi(2) + h.z * h.z;
        let stretched = DVec3::new(ax * seen.x, ay * seen.y, seen.z).length();
        FRAC_1_PI / (ax * ay * slopes * slopes) / (2.0 * (seen.z + stretched))
    }

    /// The middle of a round lobe.
    fn axis(&self, v: DVec3) -> Option<DVec3> {
        self.lean.map(|lean| DVec3::new(-lean * v.x, -lean * v.y, v.z).normalize())
    }

    /// Number of directions.
    pub fn count(&self) -> u32 {
        self.lobe_count + self.cosine_count
    }

    /// Whether the lobe is much wider than a sun or a lamp, which then counts as a point.
    pub fn is_wide(&self) -> bool {
        self.lobe_count == 0 || self.alpha[0].min(self.alpha[1]) >= LEAST_WIDE_SLOPE
    }

    /// The directions above the horizon for the view `v`, each with its solid angle `w`.
    pub fn directions(&self, v: DVec3) -> Vec<(DVec3, f64)> {
        let by_lobe = (0..self.lobe_count).map(|i| self.direction(v, spiral_point(i, self.lobe_count)));
        let by_cosine = (0..self.cosine_count).map(|i| cosine_direction(spiral_point(i, self.cosine_count)));
        let solid_angle = |l: DVec3| {
            let density = f64::from(self.lobe_count) * self.density(v, l);
            1.0 / (density + f64::from(self.cosine_count) * l.z * FRAC_1_PI)
        };
        by_lobe.chain(by_cosine).filter(|l| l.z > 0.0).map(|l| (l, solid_angle(l))).collect()
    }
}

/// A direction of the upper hemisphere with the density `cos theta / pi`.
pub fn cosine_direction(u: [f64; 2]) -> DVec3 {
    let (sin_phi, cos_phi) = (TAU * u[1]).sin_cos();
    let sin = u[0].sqrt();
    DVec3::new(sin * cos_phi, sin * sin_phi, (1.0 - u[0]).sqrt())
}

/// The level of a cubemap with `size` texels an edge for a lookup in the unit direction `d`: its texels there cover the solid angle
/// `w` and [`LEVELS_BEYOND`]. Not negative.
///
/// A texel covers `(2 / size)^2 m^3`, where `m` is the largest component of `d`.
pub fn lookup_level(size: f64, d: DVec3, w: f64) -> f64 {
    let m = d.abs().max_element();
    (0.5 * (0.25 * w * size * size / (m * m * m)).log2() + LEVELS_BEYOND).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOBES: [FunctionLobe; 4] = [
        FunctionLobe { alpha: [0.3, 0.3], lean: None, lobe_count: 64, cosine_count: 0 },
        FunctionLobe { alpha: [0.5, 0.15], lean: None, lobe_count: 48, cosine_count: 16 },
        FunctionLobe { alpha: [0.4, 0.4], lean: Some(1.0), lobe_count: 32, cosine_count: 32 },
        FunctionLobe { alpha: [0.4, 0.4], lean: Some(-0.6), lobe_count: 32, cosine_count: 32 },
    ];

    fn views() -> impl Iterator<Item = DVec3> {
        [0.0, 0.6, 1.2].into_iter().flat_map(|theta: f64| {
            [0.0, 0.9, 2.5].map(|phi: f64| DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()))
        })
    }

    /// The mean of a function over directions of the lobe is its integral with the density.
    #[test]
    fn directions_have_their_density() {
        let functions: [fn(DVec3) -> f64; 3] = [|_| 1.0, |l| l.z * l.z, |l| (1.0 + l.x) * (1.5 - l.y)];
        for lobe in LOBES {
            for v in views() {
                let mut integrals = [0.0; 3];
                let (rows, columns) = (400, 800);
                for i in 0..rows * columns {
                    let z = 2.0 * (f64::from(i / columns) + 0.5) / f64::from(rows) - 1.0;
                    let (sin, cos) = (TAU * (f64::from(i % columns) + 0.5) / f64::from(columns)).sin_cos();
                    let across = (1.0 - z * z).sqrt();
                    let l = DVec3::new(across * cos, across * sin, z);
                    let share = lobe.density(v, l) * 2.0 * TAU / f64::from(rows * columns);
                    integrals.iter_mut().zip(functions).for_each(|(sum, f)| *sum += share * f(l));
                }
                let count = 4096;
                let mut means = [0.0; 3];
                for i in 0..count {
                    let l = lobe.direction(v, spiral_point(i, count));
                    assert!((l.length() - 1.0).abs() < 1e-9, "{l}");
                    means.iter_mut().zip(functions).for_each(|(sum, f)| *sum += f(l) / f64::from(count));
                }
                for (mean, integral) in means.into_iter().zip(integrals) {
                    // Both are sums over a few thousand points.
                    assert!((mean - integral).abs() < 4e-3, "{lobe:?} {v}: {mean}, {integral} by the density");
                }
            }
        }
    }

    /// White matte in light that is 1 everywhere reflects 1, however the directions are divided. Few directions of a lobe that
    /// does not fit the function err by some percent.
    #[test]
    fn solid_angles_cover_the_hemisphere() {
        for lobe in LOBES.into_iter().filter(|lobe| lobe.cosine_count > 0) {
            let lobe = FunctionLobe { lobe_count: 32 * lobe.lobe_count, cosine_count: 32 * lobe.cosine_count, ..lobe };
            for v in views() {
                let sum: f64 = lobe.directions(v).iter().map(|(l, w)| FRAC_1_PI * l.z * w).sum();
                assert!((sum - 1.0).abs() < 0.01, "{lobe:?} {v}: {sum}");
            }
        }
    }

    #[test]
    fn views_from_below_are_raised() {
        for v in [DVec3::NEG_Z, DVec3::new(0.6, 0.0, -0.8), DVec3::X] {
            let raised = raised_view(v);
            assert!((raised.length() - 1.0).abs() < 1e-12 && raised.z == LEAST_VIEW_COSINE, "{v}: {raised}");
        }
        assert_eq!(raised_view(DVec3::Z), DVec3::Z);
    }

    /// Along an axis a texel of a face of 4 x 4 covers a quarter of a unit squared.
    #[test]
    fn levels_follow_solid_angles() {
        let level = |w: f64| lookup_level(4.0, DVec3::X, w) - LEVELS_BEYOND;
        assert!((level(0.25)).abs() < 1e-12 && (level(1.0) - 1.0).abs() < 1e-12);
        assert_eq!(lookup_level(4.0, DVec3::X, 1e-9), 0.0);
        let corner = DVec3::ONE.normalize();
        assert!(lookup_level(64.0, corner, 0.1) > lookup_level(64.0, DVec3::Y, 0.1) + 1.0);
    }
}
