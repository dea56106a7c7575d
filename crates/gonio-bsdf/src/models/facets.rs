//! Microfacet BRDFs: `f = a / pi + F D G / (4 <N.L> <N.V>)`, with any distribution and shadowing.

use crate::bsdf::{Bsdf, BsdfSample, both_above, mean, weighted};
use crate::sampling::{cosine_or_half, cosine_or_half_density};
use gonio_light::DVec3;
use gonio_light::optics::schlick;
use gonio_light::vector::half_vector;
use std::f64::consts::FRAC_1_PI;

/// A distribution of microfacets with its shadowing and its sampling.
pub trait Facets: Send + Sync {
    /// `D(h)` in 1/sr.
    fn distribution(&self, h: DVec3) -> f64;
    /// `G(wi, wo, h)`, in `[0, 1]`.
    fn shadowing(&self, wi: DVec3, wo: DVec3, h: DVec3) -> f64;
    /// Draws a facet that `wo` sees, above the horizon.
    fn sample_half(&self, wo: DVec3, u: [f64; 2]) -> DVec3;
    /// The density of [`Facets::sample_half`].
    fn half_density(&self, h: DVec3, wo: DVec3) -> f64;
}

/// Beckmann's `D` in 1/sr. Source: B. Walter et al. 2007, eq. (25).
pub fn beckmann_distribution(h: DVec3, alpha: f64) -> f64 {
    if h.z > 0.0 {
        let (cos2, a2) = (h.z * h.z, alpha * alpha);
        (-(h.x * h.x + h.y * h.y) / (cos2 * a2)).exp() * FRAC_1_PI / (a2 * cos2 * cos2)
    } else {
        0.0
    }
}

/// Smith's `G_1` for Beckmann's distribution, by the rational approximation with a relative error below 0.35 %. Source:
/// B. Walter et al. 2007, eq. (27).
pub fn beckmann_g1(cos: f64, alpha: f64) -> f64 {
    if cos <= 0.0 {
        return 0.0;
    }
    let a = cos / (alpha * (1.0 - cos * cos).max(1e-300).sqrt());
    if a < 1.6 { (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a) } else { 1.0 }
}

/// Smith's `G_1` for GGX. Source: B. Walter et al. 2007, eq. (34).
pub fn ggx_g1(cos: f64, alpha: f64) -> f64 {
    if cos <= 0.0 {
        return 0.0;
    }
    let a2 = alpha * alpha;
    2.0 * cos / (cos + (a2 + (1.0 - a2) * cos * cos).sqrt())
}

/// `G` of two directions from their `G_1`. *Correlated* by the height of the facet: `1 / (1 + Lambda_i + Lambda_o)` with
/// `Lambda = 1 / G_1 - 1` (E. Heitz, JCGT 3(2), 2014, eq. 99); otherwise their product (Walter et al. 2007, eq. 23).
pub fn smith(first: f64, second: f64, correlated: bool) -> f64 {
    if first <= 0.0 || second <= 0.0 {
        0.0
    } else if correlated {
        1.0 / (1.0 / first + 1.0 / second - 1.0)
    } else {
        first * second
    }
}

/// A diffuse part and a rough mirror.
pub struct FacetBrdf<T> {
    pub diffuse: DVec3,
    pub f0: DVec3,
    /// Multiplies the mirror; 1 but for the paper of Cook and Torrance.
    pub factor: f64,
    pub facets: T,
}

impl<T: Facets> FacetBrdf<T> {
    fn diffuse_share(&self) -> f64 {
        let (d, s) = (mean(self.diffuse), 0.05 + 0.95 * mean(self.f0));
        d / (d + s)
    }
}

impl<T: Facets> Bsdf for FacetBrdf<T> {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if !both_above(wi, wo) {
            return DVec3::ZERO;
        }
        let h = half_vector(wi, wo, DVec3::Z);
        let fresnel = self.f0.map(|f0| schlick(wo.dot(h), f0));
        let mirror = self.facets.distribution(h) * self.facets.shadowing(wi, wo, h) / (4.0 * wi.z * wo.z);
        self.diffuse * FRAC_1_PI + fresnel * (mirror * self.factor)
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !both_above(wi, wo) {
            return 0.0;
        }
        let h = half_vector(wi, wo, DVec3::Z);
        cosine_or_half_density(self.diffuse_share(), wi, wo.dot(h), self.facets.half_density(h, wo))
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        weighted(self, cosine_or_half(self.diffuse_share(), wo, u, |u| self.facets.sample_half(wo, u))?, wo)
    }
}
