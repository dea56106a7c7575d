//! A BSDF: its value for two directions, and directions drawn in proportion to it.

use crate::sampling::{cosine_density, cosine_hemisphere};
use gonio_light::DVec3;

/// A direction drawn by [`Bsdf::sample`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// The direction to the light, a unit vector in the local frame.
    pub wi: DVec3,
    /// `f |cos theta_i|` divided by the density: the estimate of the integral of `f |cos theta_i|` over all `wi`.
    pub weight: DVec3,
    /// Whether only this one direction scatters light, as in a mirror; [`Bsdf::evaluate`] is 0 there.
    pub is_mirror: bool,
}

/// A bidirectional scattering distribution function.
///
/// All directions are unit vectors in the local frame, normal along +Z, and point away from the surface.
pub trait Bsdf: Send + Sync {
    /// `f(wi, wo)` in 1/sr, per channel: the radiance towards `wo` for each unit of irradiance from `wi`. Functions of the
    /// reflection are 0 where either direction is at or below the horizon.
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3;

    /// [`Bsdf::evaluate`] for many pairs `(wi, wo)`. Functions that run in the interpreter are much faster so.
    fn evaluate_all(&self, pairs: &[(DVec3, DVec3)]) -> Vec<DVec3> {
        pairs.iter().map(|(wi, wo)| self.evaluate(*wi, *wo)).collect()
    }

    /// The density in 1/sr with which [`Bsdf::sample`] draws `wi` for a viewer at `wo`. Its integral over the sphere is at
    /// most 1; the rest is the probability that `sample` draws nothing. By default that of the cosine above the horizon.
    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if both_above(wi, wo) { cosine_density(wi) } else { 0.0 }
    }

    /// Draws a direction to the light for a viewer at `wo`, from three numbers in `[0, 1)`. `None` if the direction falls
    /// below the horizon: it counts as a sample of weight 0. By default in proportion to the cosine.
    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        weighted(self, cosine_hemisphere([u[0], u[1]]), wo)
    }

    /// Whether the samples follow the shape of the function, and not only the cosine. Functions with the default sampling
    /// say no.
    fn samples_follow_function(&self) -> bool {
        true
    }

    /// Whether light passes through the surface, so that `f` is not 0 for directions on opposite sides.
    fn transmits(&self) -> bool {
        false
    }

    /// Whether `f` depends on the two azimuths only through their difference.
    fn is_isotropic(&self) -> bool {
        true
    }

    /// The index of refraction on the side of the surface that `w` points to. `f(wi, wo) / index(wo)^2` is symmetric for
    /// functions that transmit: radiance changes with the square of the index (E. Veach, *Robust Monte Carlo Methods for
    /// Light Transport Simulation*, 1997, section 5.2).
    fn index(&self, _w: DVec3) -> f64 {
        1.0
    }
}

/// Whether both directions lie above the horizon.
pub fn both_above(wi: DVec3, wo: DVec3) -> bool {
    wi.z > 0.0 && wo.z > 0.0
}

/// A specular lobe that is multiplied by a colour: its value, and its own exact sampling.
pub(crate) trait Lobe: Send + Sync {
    /// The value in 1/sr for the colour 1. Called above the horizon only.
    fn value(&self, wi: DVec3, wo: DVec3) -> f64;
    /// The density of [`Lobe::sample`] in 1/sr.
    fn density(&self, wi: DVec3, wo: DVec3) -> f64;
    /// Draws `wi`, which may lie below the horizon.
    fn sample(&self, wo: DVec3, u: [f64; 2]) -> Option<DVec3>;
    fn is_isotropic(&self) -> bool {
        true
    }
}

/// `a / pi + b lobe` above the horizon: the form of Appendix 6.
pub(crate) struct DiffuseAndLobe<L> {
    diffuse: DVec3,
    specular: DVec3,
    /// The share of samples that follow the diffuse part.
    diffuse_share: f64,
    lobe: L,
}

impl<L: Lobe> DiffuseAndLobe<L> {
    pub fn new(diffuse: DVec3, specular: DVec3, lobe: L) -> Self {
        let (d, s) = (mean(diffuse), mean(specular));
        let diffuse_share = if d + s > 0.0 { d / (d + s) } else { 1.0 };
        DiffuseAndLobe { diffuse, specular, diffuse_share, lobe }
    }
}

/// The mean of the channels.
pub(crate) fn mean(color: DVec3) -> f64 {
    (color.x + color.y + color.z) / 3.0
}

impl<L: Lobe> Bsdf for DiffuseAndLobe<L> {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if both_above(wi, wo) {
            self.diffuse * std::f64::consts::FRAC_1_PI + self.specular * self.lobe.value(wi, wo)
        } else {
            DVec3::ZERO
        }
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !both_above(wi, wo) {
            return 0.0;
        }
        let diffuse = self.diffuse_share * cosine_density(wi);
        // A lobe with no samples may have an infinite density.
        if self.diffuse_share < 1.0 {
            diffuse + (1.0 - self.diffuse_share) * self.lobe.density(wi, wo)
        } else {
            diffuse
        }
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let wi = if u[2] < self.diffuse_share {
            cosine_hemisphere([u[0], u[1]])
        } else {
            self.lobe.sample(wo, [u[0], u[1]])?
        };
        weighted(self, wi, wo)
    }

    fn is_isotropic(&self) -> bool {
        self.lobe.is_isotropic()
    }
}

/// A sample of a direction, weighted by value and density; `None` where the density is not positive.
pub(crate) fn weighted<B: Bsdf + ?Sized>(bsdf: &B, wi: DVec3, wo: DVec3) -> Option<BsdfSample> {
    let density = bsdf.density(wi, wo);
    (density > 0.0).then(|| BsdfSample { wi, weight: bsdf.evaluate(wi, wo) * (wi.z.abs() / density), is_mirror: false })
}
