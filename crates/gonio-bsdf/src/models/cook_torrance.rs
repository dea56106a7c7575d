//! The model of Cook and Torrance in the form of their paper.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `f0` | reflectance at normal incidence, linear RGB | `[0, 1]` | 0.8 |
//! | `m` | RMS slope | `[0.02, 1]` | 0.3 |
//! | `normalised` | the factor 1/4 of later literature | switch | off |
//!
//! `f = a / pi + F D G / (pi <N.L> <N.V>)`, `D = exp(-tan^2 / m^2) / (m^2 cos^4)`,
//! `G = min(1, 2 N.H N.V / V.H, 2 N.H N.L / V.H)`. *Normalised*: `F D G / (4 <N.L> <N.V>)` with `D / pi`, which is a quarter.
//!
//! *Source*: R. L. Cook and K. E. Torrance, *A Reflectance Model for Computer Graphics*, ACM TOG 1(1), 1982. The factor:
//! B. Walter et al. 2007, section 4.2, with the Jacobian of the half vector. F is Schlick's here, the paper has Fresnel's.
//! *Sampling*: half vectors with the density `D N.H`, mirrored.
//! *Limits*: the paper's factor reflects up to four times as much light as arrives.

use super::BsdfModel;
use super::facets::{FacetBrdf, Facets, beckmann_distribution};
use crate::parameter::Parameter;
use crate::sampling::{gaussian_half, gaussian_half_density};
use gonio_light::DVec3;

/// The paper's form.
pub static COOK_TORRANCE: BsdfModel = BsdfModel {
    name: "cook-torrance",
    title: "Cook-Torrance with Beckmann's distribution and V-shaped grooves",
    formula: "f = a / pi + F D G / (pi <N.L> <N.V>), D = exp(-tan^2(N,H) / m^2) / (m^2 cos^4(N,H))",
    source: "R. L. Cook, K. E. Torrance, A Reflectance Model for Computer Graphics, ACM TOG 1(1), 1982",
    remark: "The paper's factor 1/pi makes the mirror four times too bright; normalised=on has the factor 1/4 and D over pi \
             of later literature. F is Schlick's approximation.",
    parameters: &[
        super::A,
        Parameter::color("f0", 0.8, "reflectance at normal incidence"),
        Parameter::number("m", [0.02, 1.0], 0.3, "RMS slope, a smaller one is glossier"),
        Parameter::switch("normalised", false, "the factor 1/4 of later literature"),
    ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL <= 0.0 || cosV <= 0.0) return vec3(0.0);
    vec3 H = normalize(L + V);
    float cosH = dot(N, H), VdotH = dot(V, H);
    float sin2 = dot(X, H) * dot(X, H) + dot(Y, H) * dot(Y, H);
    float cos2 = cosH * cosH;
    float D = exp(-sin2 / (cos2 * m * m)) / (m * m * cos2 * cos2);
    float G = min(1.0, 2.0 * cosH * min(cosL, cosV) / VdotH);
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - min(VdotH, 1.0), 5.0);
    float factor = normalised ? 4.0 : 1.0;
    return a / 3.14159265358979 + F * (D * G / (3.14159265358979 * factor * cosL * cosV));
}
",
    ),
    build: |values| {
        Box::new(FacetBrdf {
            diffuse: values.color("a"),
            f0: values.color("f0"),
            factor: if values.is_on("normalised") { 1.0 } else { 4.0 },
            facets: Grooves { m: values.number("m") },
        })
    },
};

struct Grooves {
    m: f64,
}

impl Facets for Grooves {
    fn distribution(&self, h: DVec3) -> f64 {
        beckmann_distribution(h, self.m)
    }
    fn shadowing(&self, wi: DVec3, wo: DVec3, h: DVec3) -> f64 {
        (2.0 * h.z * wi.z.min(wo.z) / wo.dot(h)).min(1.0)
    }
    fn sample_half(&self, _: DVec3, u: [f64; 2]) -> DVec3 {
        gaussian_half(self.m, self.m, u)
    }
    fn half_density(&self, h: DVec3, _: DVec3) -> f64 {
        gaussian_half_density(h, self.m, self.m)
    }
}
