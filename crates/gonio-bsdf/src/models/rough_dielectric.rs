//! A rough boundary between air and a dielectric: a BRDF above and below the surface, and a BTDF between them.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `alpha` | width of the distribution of slopes (GGX) | `[0.01, 1]` | 0.3 |
//! | `ior` | index of refraction below the surface; above it is 1 | `[1.01, 3]` | 1.5 |
//!
//! ```text
//! f_r = F D G / (4 |wi.n| |wo.n|)
//! f_t = |wi.h| |wo.h| / (|wi.n| |wo.n|)  n_o^2 (1 - F) D G / (n_i (wi.h) + n_o (wo.h))^2
//! ```
//!
//! with `h` the half vector of reflection, or `-(n_i wi + n_o wo)` at unit length.
//!
//! *Source*: B. Walter, S. R. Marschner, H. Li, K. E. Torrance, *Microfacet Models for Refraction through Rough Surfaces*,
//! EGSR 2007, eq. (20), (21), (33), (34), with the product of both `G_1` (eq. 23).
//! *Sampling*: visible normals (E. Heitz, JCGT 7(4), 2018), reflected with the share `F`.
//! *Limits*: light that bounces between facets is lost; no absorption, no dispersion.

use super::BsdfModel;
use super::facets::ggx_g1;
use crate::bsdf::{Bsdf, BsdfSample, weighted};
use crate::parameter::Parameter;
use gonio_light::DVec3;
use gonio_light::microfacet::{distribution, visible_facet};
use gonio_light::optics::dielectric;
use gonio_light::vector::{reflection, refraction, unit};

/// Walter's BSDF.
pub static ROUGH_DIELECTRIC: BsdfModel = BsdfModel {
    name: "rough-dielectric",
    title: "Rough dielectric: GGX reflection and refraction",
    formula: "f_r = F D G / (4 |wi.n| |wo.n|); f_t = |wi.h| |wo.h| / (|wi.n| |wo.n|) n_o^2 (1 - F) D G / (n_i wi.h + n_o wo.h)^2",
    source: "B. Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, eq. (20), (21), (33), (34)",
    remark: "Light that bounces between facets is lost. Radiance changes with the square of the index on refraction: \
             f / n_o^2 is symmetric.",
    parameters: &[
        Parameter::number("alpha", [0.01, 1.0], 0.3, "width of the slopes, a smaller one is glossier"),
        Parameter::number("ior", [1.01, 3.0], 1.5, "index of refraction below the surface"),
    ],
    glsl: Some(
        "\
float shadowing(float cosine)
{
    return 2.0 * cosine / (cosine + sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine));
}

float fresnel(float cosine, float c, float eta)
{
    float s = (eta * cosine - c) / (eta * cosine + c);
    float p = (cosine - eta * c) / (cosine + eta * c);
    return 0.5 * (s * s + p * p);
}

vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL == 0.0 || cosV == 0.0) return vec3(0.0);
    float nL = cosL > 0.0 ? 1.0 : ior, nV = cosV > 0.0 ? 1.0 : ior;
    bool isReflection = cosL * cosV > 0.0;
    vec3 H = isReflection ? normalize(L + V) : normalize(nL * L + nV * V);
    if (dot(N, H) < 0.0) H = -H;
    float LdotH = dot(L, H), VdotH = dot(V, H);
    if (LdotH * cosL <= 0.0 || VdotH * cosV <= 0.0) return vec3(0.0);
    vec3 h = vec3(dot(X, H), dot(Y, H), dot(N, H));
    float spread = h.z * h.z * alpha * alpha + dot(h.xy, h.xy);
    float D = alpha * alpha / (3.14159265358979 * spread * spread);
    float G = shadowing(abs(cosL)) * shadowing(abs(cosV));
    float cosine = min(abs(VdotH), 1.0);
    float eta = nV / (cosV > 0.0 ? ior : 1.0);
    float cos2 = 1.0 - eta * eta * (1.0 - cosine * cosine);
    float F = isReflection && cos2 < 0.0 ? 1.0 : fresnel(cosine, isReflection ? sqrt(cos2) : abs(LdotH), eta);
    if (isReflection) return vec3(F * D * G / (4.0 * abs(cosL * cosV)));
    float sum = nL * LdotH + nV * VdotH;
    return vec3(abs(LdotH * VdotH / (cosL * cosV)) * nV * nV * (1.0 - F) * D * G / (sum * sum));
}
",
    ),
    build: |values| Box::new(RoughDielectric { alpha: values.number("alpha"), ior: values.number("ior") }),
};

struct RoughDielectric {
    alpha: f64,
    ior: f64,
}

/// A facet between two directions.
struct Facet {
    /// Upwards.
    h: DVec3,
    fresnel: f64,
    is_reflection: bool,
    /// `n_i wi.h + n_o wo.h`
    sum: f64,
}

impl RoughDielectric {
    /// The facet that takes `wi` to `wo`, or `None` if both do not see the same side of it.
    fn facet(&self, wi: DVec3, wo: DVec3) -> Option<Facet> {
        let is_reflection = wi.z * wo.z > 0.0;
        let (n_i, n_o) = (self.index(wi), self.index(wo));
        let h = if is_reflection { unit(wi + wo)? } else { unit(n_i * wi + n_o * wo)? };
        let h = if h.z < 0.0 { -h } else { h };
        if wi.dot(h) * wi.z <= 0.0 || wo.dot(h) * wo.z <= 0.0 {
            return None;
        }
        let fresnel = dielectric(wo.dot(h).abs(), n_o / self.index(-wo));
        Some(Facet { h, fresnel, is_reflection, sum: n_i * wi.dot(h) + n_o * wo.dot(h) })
    }
}

impl Bsdf for RoughDielectric {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        let Some(facet) = self.facet(wi, wo) else { return DVec3::ZERO };
        let d = distribution(facet.h.z, self.alpha);
        let g = ggx_g1(wi.z.abs(), self.alpha) * ggx_g1(wo.z.abs(), self.alpha);
        let cosines = (wi.z * wo.z).abs();
        DVec3::splat(if facet.is_reflection {
            facet.fresnel * d * g / (4.0 * cosines)
        } else {
            let n_o = self.index(wo);
            let facing = (wi.dot(facet.h) * wo.dot(facet.h)).abs();
            facing / cosines * n_o * n_o * (1.0 - facet.fresnel) * d * g / facet.sum.powi(2)
        })
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        let Some(facet) = self.facet(wi, wo) else { return 0.0 };
        let wo_dot_h = wo.dot(facet.h).abs();
        let visible = ggx_g1(wo.z.abs(), self.alpha) * wo_dot_h * distribution(facet.h.z, self.alpha) / wo.z.abs();
        if facet.is_reflection {
            facet.fresnel * visible / (4.0 * wo_dot_h)
        } else {
            let n_i = self.index(wi);
            (1.0 - facet.fresnel) * visible * n_i * n_i * wi.dot(facet.h).abs() / facet.sum.powi(2)
        }
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        if wo.z == 0.0 {
            return None;
        }
        let side = wo.z.signum();
        let h = side * visible_facet(side * wo, self.alpha, u[0], u[1]);
        let cos = wo.dot(h);
        if cos <= 0.0 {
            return None;
        }
        let eta = self.index(wo) / self.index(-wo);
        let is_reflection = u[2] < dielectric(cos, eta);
        let wi = if is_reflection { reflection(h, wo) } else { refraction(h, wo, eta)? };
        // A tilted facet may mirror light below the surface, or refract it back above.
        if is_reflection == (wi.z * wo.z > 0.0) { weighted(self, wi, wo) } else { None }
    }

    fn transmits(&self) -> bool {
        true
    }

    fn index(&self, w: DVec3) -> f64 {
        if w.z > 0.0 { 1.0 } else { self.ior }
    }
}
