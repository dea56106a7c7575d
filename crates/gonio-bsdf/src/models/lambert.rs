//! Lambert's BRDF: the same radiance in every direction.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | albedo, linear RGB | `[0, 1]` | 0.5 |
//!
//! `f = a / pi`. *Source*: J. H. Lambert, *Photometria*, 1760. Appendix 6 prints the same formula.
//! *Sampling*: the cosine, exactly. *Limits*: no highlight, no dependence on the view.

use super::BsdfModel;
use crate::bsdf::{Bsdf, DiffuseAndLobe, Lobe};
use crate::parameter::{Parameter, ParameterValues};
use gonio_light::DVec3;

/// `a / pi`
pub static LAMBERT: BsdfModel = BsdfModel {
    name: "lambert",
    title: "Lambert: the same radiance in every direction",
    formula: "f = a / pi",
    source: "J. H. Lambert, Photometria, 1760; Appendix 6",
    remark: "Appendix 6 prints the same formula. No highlight.",
    parameters: &[Parameter::color("a", 0.5, "albedo")],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    return a / 3.14159265358979;
}
",
    ),
    build,
};

fn build(values: &ParameterValues) -> Box<dyn Bsdf> {
    Box::new(DiffuseAndLobe::new(values.color("a"), DVec3::ZERO, NoLobe))
}

struct NoLobe;

impl Lobe for NoLobe {
    fn value(&self, _: DVec3, _: DVec3) -> f64 {
        0.0
    }
    fn density(&self, _: DVec3, _: DVec3) -> f64 {
        0.0
    }
    fn sample(&self, _: DVec3, _: [f64; 2]) -> Option<DVec3> {
        None
    }
}
