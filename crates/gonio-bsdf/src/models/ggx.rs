//! A rough mirror of GGX microfacets.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `f0` | reflectance at normal incidence, linear RGB | `[0, 1]` | 0.8 |
//! | `alpha` | width of the distribution of slopes | `[0.01, 1]` | 0.3 |
//! | `correlated` | height-correlated shadowing; off: the product of both directions' | switch | on |
//!
//! `f = a / pi + F D G / (4 <N.L> <N.V>)`, `D = alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2)`, see [`gonio_light::microfacet`].
//!
//! *Source*: D: B. Walter et al., *Microfacet Models for Refraction through Rough Surfaces*, EGSR 2007, eq. (33). G:
//! E. Heitz, JCGT 3(2), 2014, eq. (99). F: C. Schlick 1994.
//! *Sampling*: visible normals, E. Heitz, JCGT 7(4), 2018. *Limits*: light that bounces between facets is lost.

use super::BsdfModel;
use super::facets::{FacetBrdf, Facets, ggx_g1, smith};
use crate::parameter::Parameter;
use gonio_light::DVec3;
use gonio_light::microfacet::{distribution, visible_facet};

/// Cook-Torrance with GGX and height-correlated shadowing.
pub static GGX: BsdfModel = BsdfModel {
    name: "ggx",
    title: "Cook-Torrance with GGX and Smith's shadowing",
    formula: "f = a / pi + F D G / (4 <N.L> <N.V>), D = alpha^2 / (pi (cos^2(N,H) (alpha^2 - 1) + 1)^2)",
    source: "B. Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, eq. (33); E. Heitz, \
             JCGT 3(2), 2014, eq. (99)",
    remark: "Light that bounces between facets is lost: at alpha = 1 about half. The diffuse part a is added without coupling.",
    parameters: &[
        super::A,
        Parameter::color("f0", 0.8, "reflectance at normal incidence"),
        Parameter::number("alpha", [0.01, 1.0], 0.3, "width of the slopes, a smaller one is glossier"),
        Parameter::switch("correlated", true, "height-correlated shadowing"),
    ],
    glsl: Some(
        "\
float shadowing(float cosine)
{
    return 2.0 * cosine / (cosine + sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine));
}

vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL <= 0.0 || cosV <= 0.0) return vec3(0.0);
    vec3 H = normalize(L + V);
    vec3 h = vec3(dot(X, H), dot(Y, H), dot(N, H));
    float spread = h.z * h.z * alpha * alpha + dot(h.xy, h.xy);
    float D = alpha * alpha / (3.14159265358979 * spread * spread);
    float first = shadowing(cosL), second = shadowing(cosV);
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
            facets: GgxFacets { alpha: values.number("alpha"), correlated: values.is_on("correlated") },
        })
    },
};

struct GgxFacets {
    alpha: f64,
    correlated: bool,
}

impl Facets for GgxFacets {
    fn distribution(&self, h: DVec3) -> f64 {
        distribution(h.z, self.alpha)
    }
    fn shadowing(&self, wi: DVec3, wo: DVec3, _: DVec3) -> f64 {
        smith(ggx_g1(wi.z, self.alpha), ggx_g1(wo.z, self.alpha), self.correlated)
    }
    fn sample_half(&self, wo: DVec3, u: [f64; 2]) -> DVec3 {
        visible_facet(wo, self.alpha, u[0], u[1])
    }
    fn half_density(&self, h: DVec3, wo: DVec3) -> f64 {
        ggx_g1(wo.z, self.alpha) * wo.dot(h).max(0.0) * distribution(h.z, self.alpha) / wo.z
    }
}
