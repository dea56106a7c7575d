//! A smooth boundary between air and a dielectric: a mirror and a window.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `ior` | index of refraction below the surface; above it is 1 | `[1, 3]` | 1.5 |
//!
//! Light from one direction leaves in two: mirrored with the share `F`, refracted with the share `1 - F`. The function is 0
//! for every other pair, so [`crate::Bsdf::evaluate`] is 0 everywhere and [`crate::Bsdf::sample`] draws the two directions.
//!
//! *Source*: Fresnel's equations, M. Born and E. Wolf, *Principles of Optics*, section 1.5.2; radiance changes with the
//! square of the index on refraction (E. Veach 1997, section 5.2). *Limits*: no absorption, no dispersion.

use super::BsdfModel;
use crate::bsdf::{Bsdf, BsdfSample};
use crate::parameter::Parameter;
use gonio_light::DVec3;
use gonio_light::optics::dielectric;
use gonio_light::vector::refraction;

/// The smooth boundary.
pub static DIELECTRIC: BsdfModel = BsdfModel {
    name: "dielectric",
    title: "Smooth dielectric: mirrored and refracted light",
    formula: "f = F delta(wi - R) / |cos| + (1 - F) (n_o / n_i)^2 delta(wi - T) / |cos|",
    source: "M. Born, E. Wolf, Principles of Optics, section 1.5.2",
    remark: "Light leaves in two directions only. No absorption.",
    parameters: &[Parameter::number("ior", [1.0, 3.0], 1.5, "index of refraction below the surface")],
    glsl: None,
    build: |values| Box::new(Dielectric { ior: values.number("ior") }),
};

struct Dielectric {
    ior: f64,
}

impl Bsdf for Dielectric {
    fn evaluate(&self, _: DVec3, _: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    fn density(&self, _: DVec3, _: DVec3) -> f64 {
        0.0
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        if wo.z == 0.0 {
            return None;
        }
        let normal = DVec3::new(0.0, 0.0, wo.z.signum());
        let eta = self.index(wo) / self.index(-wo);
        let mirrored = BsdfSample { wi: DVec3::new(-wo.x, -wo.y, wo.z), weight: DVec3::ONE, is_mirror: true };
        if u[2] < dielectric(wo.z.abs(), eta) {
            return Some(mirrored);
        }
        let Some(wi) = refraction(normal, wo, eta) else { return Some(mirrored) };
        Some(BsdfSample { wi, weight: DVec3::splat(eta * eta), is_mirror: true })
    }

    fn transmits(&self) -> bool {
        true
    }

    fn index(&self, w: DVec3) -> f64 {
        if w.z > 0.0 { 1.0 } else { self.ior }
    }
}
