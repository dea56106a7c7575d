//! A rough mirror of Beckmann microfacets.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `f0` | reflectance at normal incidence, linear RGB | `[0, 1]` | 0.8 |
//! | `alpha` | RMS slope | `[0.01, 1]` | 0.3 |
//! | `correlated` | height-correlated shadowing; off: the product of both directions' | switch | on |
//!
//! `f = a / pi + F D G / (4 <N.L> <N.V>)`.
//!
//! *Source*: D and G_1: B. Walter et al., *Microfacet Models for Refraction through Rough Surfaces*, EGSR 2007, eq. (25)
//! and (27). Correlation: E. Heitz, *Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs*, JCGT 3(2),
//! 2014, eq. (99). F: C. Schlick 1994.
//! *Sampling*: half vectors with the density `D N.H`, mirrored.
//! *Limits*: G_1 is an approximation with a relative error below 0.35 %; light that bounces between facets is lost.

use super::BsdfModel;
use super::facets::{FacetBrdf, Facets, beckmann_distribution, beckmann_g1, smith};
use crate::parameter::Parameter;
use crate::sampling::{gaussian_half, gaussian_half_density};
use gonio_light::DVec3;

/// Cook-Torrance with Beckmann's distribution and Smith's shadowing.
pub static BECKMANN: BsdfModel = BsdfModel {
    name: "beckmann",
    title: "Cook-Torrance with Beckmann's distribution and Smith's shadowing",
    formula: "f = a / pi + F D G / (4 <N.L> <N.V>), D = exp(-tan^2(N,H) / alpha^2) / (pi alpha^2 cos^4(N,H))",
    source: "B. Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, eq. (25), (27); \
             E. Heitz, JCGT 3(2), 2014, eq. (99)",
    remark: "Light that bounces between facets is lost. The diffuse part a is added without coupling.",
    parameters: &[
        super::A,
        Parameter::color("f0", 0.8, "reflectance at normal incidence"),
        Parameter::number("alpha", [0.01, 1.0], 0.3, "RMS slope, a smaller one is glossier"),
        Parameter::switch("correlated", true, "height-correlated shadowing"),
    ],
    glsl: Some(
        "\
float shadowing(float cosine, float sine2)
{
    float x = cosine / (alpha * sqrt(max(sine2, 1e-30)));
    return x < 1.6 ? (3.535 * x + 2.181 * x * x) / (1.0 + 2.276 * x + 2.577 * x * x) : 1.0;
}

vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL <= 0.0 || cosV <= 0.0) return vec3(0.0);
    vec3 H = normalize(L + V);
    vec3 h = vec3(dot(X, H), dot(Y, H), dot(N, H));
    float cos2 = h.z * h.z;
    float D = exp(-dot(h.xy, h.xy) / (cos2 * alpha * alpha)) / (3.14159265358979 * alpha * alpha * cos2 * cos2);
    float first = shadowing(cosL, dot(L, X) * dot(L, X) + dot(L, Y) * dot(L, Y));
    float second = shadowing(cosV, dot(V, X) * dot(V, X) + dot(V, Y) * dot(V, Y));
    float G = correlated ? 1.0 / (1.0 / first + 1.0 / second - 1.0) : first * second;
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - min(dot(V, H), 1.0), 5.0);
    return a / 3.14159265358979 + F * (D * G / (4.0 * cosL * cosV));
}
",
    ),
    build: |values| {
        Box::new(FacetBrdf {
            diffuse: values.color("a"),
            f0: values.color("f0"),
            factor: 1.0,
            facets: BeckmannFacets { alpha: values.number("alpha"), correlated: values.is_on("correlated") },
        })
    },
};

struct BeckmannFacets {
    alpha: f64,
    correlated: bool,
}

impl Facets for BeckmannFacets {
    fn distribution(&self, h: DVec3) -> f64 {
        beckmann_distribution(h, self.alpha)
    }
    fn shadowing(&self, wi: DVec3, wo: DVec3, _: DVec3) -> f64 {
        smith(beckmann_g1(wi.z, self.alpha), beckmann_g1(wo.z, self.alpha), self.correlated)
    }
    fn sample_half(&self, _: DVec3, u: [f64; 2]) -> DVec3 {
        gaussian_half(self.alpha, self.alpha, u)
    }
    fn half_density(&self, h: DVec3, _: DVec3) -> f64 {
        gaussian_half_density(h, self.alpha, self.alpha)
    }
}
