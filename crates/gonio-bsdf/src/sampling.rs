//! Directions from numbers in `[0, 1)`, and their densities in 1/sr.

use gonio_light::DVec3;
use gonio_light::vector::{any_orthonormal_vector, reflection};
use std::f64::consts::{FRAC_1_PI, TAU};

/// The direction with polar angle `theta` and azimuth `phi` in radians.
pub fn direction(theta: f64, phi: f64) -> DVec3 {
    let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
    DVec3::new(sin * cos_phi, sin * sin_phi, cos)
}

/// The direction with the cosine `cos` of the polar angle and the azimuth `phi`.
pub fn direction_of_cosine(cos: f64, phi: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (sin_phi, cos_phi) = phi.sin_cos();
    DVec3::new(sin * cos_phi, sin * sin_phi, cos)
}

/// A direction of the upper hemisphere with the density `cos theta / pi`.
pub fn cosine_hemisphere(u: [f64; 2]) -> DVec3 {
    direction_of_cosine((1.0 - u[0]).sqrt(), TAU * u[1])
}

/// The density of [`cosine_hemisphere`].
pub fn cosine_density(w: DVec3) -> f64 {
    w.z.max(0.0) * FRAC_1_PI
}

/// A direction about the unit vector `axis` with the density `(c + 1) / (2 pi) cos^c`.
pub fn power_cosine(axis: DVec3, c: f64, u: [f64; 2]) -> DVec3 {
    let local = direction_of_cosine((1.0 - u[0]).powf(1.0 / (c + 1.0)), TAU * u[1]);
    let tangent = any_orthonormal_vector(axis);
    (local.x * tangent + local.y * axis.cross(tangent) + local.z * axis).normalize()
}

/// The density of [`power_cosine`] at an angle with this cosine.
pub fn power_cosine_density(cos: f64, c: f64) -> f64 {
    if cos > 0.0 { (c + 1.0) / TAU * cos.min(1.0).powf(c) } else { 0.0 }
}

/// `wo` mirrored at a facet with the unit normal `h`; `None` if the facet is seen from behind.
pub fn reflect_at(h: DVec3, wo: DVec3) -> Option<DVec3> {
    (h.dot(wo) > 0.0).then(|| reflection(h, wo))
}

/// The density of `wi` where `h` has the density `density_of_half` and `wo` is mirrored at it: `p(h) / (4 wo.h)`.
pub fn reflected_density(density_of_half: f64, wo_dot_h: f64) -> f64 {
    if wo_dot_h > 0.0 { density_of_half / (4.0 * wo_dot_h) } else { 0.0 }
}

/// Draws `wi` by the cosine with the probability `share`, otherwise `wo` mirrored at a half vector that `sample_half` draws.
pub fn cosine_or_half(
    share: f64,
    wo: DVec3,
    u: [f64; 3],
    sample_half: impl FnOnce([f64; 2]) -> DVec3,
) -> Option<DVec3> {
    if wo.z <= 0.0 {
        None
    } else if u[2] < share {
        Some(cosine_hemisphere([u[0], u[1]]))
    } else {
        reflect_at(sample_half([u[0], u[1]]), wo)
    }
}

/// The density of [`cosine_or_half`] above the horizon, where the half vector has the density `density_of_half`.
pub fn cosine_or_half_density(share: f64, wi: DVec3, wo_dot_h: f64, density_of_half: f64) -> f64 {
    share * cosine_density(wi) + (1.0 - share) * reflected_density(density_of_half, wo_dot_h)
}

/// A half vector whose slope is Gaussian, with the density `exp(-(x/ax)^2 - (y/ay)^2) / (pi ax ay cos^3)` where `x` and
/// `y` are its slopes. Source: G. J. Ward 1992, eq. (6) and (7).
pub fn gaussian_half(ax: f64, ay: f64, u: [f64; 2]) -> DVec3 {
    let radius = (-(1.0 - u[0]).ln()).sqrt();
    let (sin, cos) = (TAU * u[1]).sin_cos();
    DVec3::new(ax * radius * cos, ay * radius * sin, 1.0).normalize()
}

/// The density of [`gaussian_half`].
pub fn gaussian_half_density(h: DVec3, ax: f64, ay: f64) -> f64 {
    if h.z > 0.0 {
        let (x, y) = (h.x / (h.z * ax), h.y / (h.z * ay));
        (-(x * x + y * y)).exp() * FRAC_1_PI / (ax * ay * h.z.powi(3))
    } else {
        0.0
    }
}

/// Numbers in `[0, 1)` from a counter and a seed, the same everywhere.
///
/// Source: G. L. Steele, D. Lea, C. H. Flood, *Fast Splittable Pseudorandom Number Generators*, OOPSLA 2014 (SplitMix64).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SplitMix(u64);

impl SplitMix {
    /// Starts a sequence.
    pub fn new(seed: u64) -> Self {
        SplitMix(seed)
    }

    /// The next number, with 53 random bits.
    pub fn next_number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Three numbers.
    pub fn next_three(&mut self) -> [f64; 3] {
        [self.next_number(), self.next_number(), self.next_number()]
    }

    /// A number with the standard normal distribution. Source: G. E. P. Box and M. E. Muller 1958.
    pub fn next_normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.next_number()).ln()).sqrt();
        radius * (TAU * self.next_number()).cos()
    }
}
