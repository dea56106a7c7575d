//! Oren and Nayar's rough diffuse surface.
//!
//! | parameter | is | unit | range | default |
//! |---|---|---|---|---|
//! | `a` | albedo of the facets, linear RGB | | `[0, 1]` | 0.5 |
//! | `sigma` | standard deviation of the facets' slope angles | degrees | `[0, 90]` | 20 |
//!
//! `f = a / pi (A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta))`, `A = 1 - 0.5 s^2 / (s^2 + 0.33)`,
//! `B = 0.45 s^2 / (s^2 + 0.09)`, `s` = `sigma` in radians, `alpha` the larger and `beta` the smaller polar angle.
//!
//! *Source*: M. Oren and S. K. Nayar, *Generalization of Lambert's Reflectance Model*, SIGGRAPH 1994, eq. (30), the
//! qualitative model. *Sampling*: the cosine. *Limits*: no interreflection between facets; `sigma = 0` is Lambert's.

use super::BsdfModel;
use crate::bsdf::{Bsdf, BsdfSample, both_above, weighted};
use crate::parameter::Parameter;
use crate::sampling::{cosine_density, cosine_hemisphere};
use gonio_light::DVec3;
use std::f64::consts::FRAC_1_PI;

/// The qualitative model.
pub static OREN_NAYAR: BsdfModel = BsdfModel {
    name: "oren-nayar",
    title: "Oren-Nayar: a rough diffuse surface",
    formula: "f = a / pi (A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta)), A = 1 - 0.5 s^2 / (s^2 + 0.33), \
              B = 0.45 s^2 / (s^2 + 0.09)",
    source: "M. Oren, S. K. Nayar, Generalization of Lambert's Reflectance Model, SIGGRAPH 1994, eq. (30)",
    remark: "The qualitative model, without interreflection between facets. sigma = 0 is Lambert's model.",
    parameters: &[
        Parameter::color("a", 0.5, "albedo of the facets"),
        Parameter::number("sigma", [0.0, 90.0], 20.0, "standard deviation of the slope angle").in_unit("degrees"),
    ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL <= 0.0 || cosV <= 0.0) return vec3(0.0);
    float s = radians(sigma);
    float A = 1.0 - 0.5 * s * s / (s * s + 0.33);
    float B = 0.45 * s * s / (s * s + 0.09);
    float across = dot(X, L) * dot(X, V) + dot(Y, L) * dot(Y, V);
    return a / 3.14159265358979 * (A + B * max(across, 0.0) / max(cosL, cosV));
}
",
    ),
    build: |values| {
        let s2 = values.number("sigma").to_radians().powi(2);
        let (constant, rough) = (1.0 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09));
        Box::new(OrenNayar { albedo: values.color("a"), constant, rough })
    },
};

struct OrenNayar {
    albedo: DVec3,
    constant: f64,
    rough: f64,
}

impl Bsdf for OrenNayar {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if !both_above(wi, wo) {
            return DVec3::ZERO;
        }
        // cos(phi_i - phi_o) sin(theta_i) sin(theta_o); the tangent divides by the cosine of the smaller angle.
        let across = (wi.x * wo.x + wi.y * wo.y).max(0.0);
        self.albedo * (FRAC_1_PI * (self.constant + self.rough * across / wi.z.max(wo.z)))
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if both_above(wi, wo) { cosine_density(wi) } else { 0.0 }
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        weighted(self, cosine_hemisphere([u[0], u[1]]), wo)
    }
}
