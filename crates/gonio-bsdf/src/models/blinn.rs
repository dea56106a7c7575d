//! Blinn's lobe: a power of the cosine between normal and half vector.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `b` | colour of the lobe, linear RGB | `[0, 1]` | 0.5 |
//! | `c` | exponent | `[1, 1000]` | 32 |
//!
//! `f = a / pi + b <N.H>^c`; *normalised*: the lobe times `(c + 2)(c + 4) / (8 pi (2^(-c/2) + c))`, see
//! [`gonio_light::brdf::blinn`].
//!
//! *Source*: J. F. Blinn, *Models of Light Reflection for Computer Synthesized Pictures*, SIGGRAPH 1977: the distribution
//! `D_1`. *The print*: `b cos^c b <wi|wo>` has the angle between the wrong vectors and a second `b`, see [`BLINN_PRINTED`].
//! *Sampling*: half vectors with the density `(c + 1) / (2 pi) cos^c`, mirrored.
//! *Limits*: no Fresnel factor, no shadowing.

use super::printed::PrintedFormula;
use super::{A, B, BsdfModel, EXPONENT, local_point};
use crate::bsdf::{Bsdf, DiffuseAndLobe, Lobe};
use crate::parameter::ParameterValues;
use crate::sampling::{power_cosine, power_cosine_density, reflect_at, reflected_density};
use gonio_light::DVec3;
use gonio_light::brdf::blinn;
use gonio_light::vector::half_vector;

/// The function with the lines after its lobe.
macro_rules! glsl {
    ($result:literal) => {
        concat!(
            "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    float cosine = dot(N, normalize(L + V));
    float lobe = cosine > 0.0 ? pow(min(cosine, 1.0), c) : 0.0;
",
            $result,
            "}\n"
        )
    };
}

/// The paper's distribution as a lobe.
pub static BLINN: BsdfModel = BsdfModel {
    name: "blinn",
    title: "Blinn: a cosine power of the half vector, not normalised",
    formula: "f = a / pi + b <N.H>^c",
    source: "J. F. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977, D_1",
    remark: "Without its factor the lobe reflects less the larger c is, and for a small c and b = 1 more light than arrives.",
    parameters: &[A, B, EXPONENT],
    glsl: Some(glsl!(
        "\
    return a / 3.14159265358979 + b * lobe;
"
    )),
    build: |values| build(values, false),
};

/// With the factor that makes the lobe's albedo at normal view 1.
pub static BLINN_NORMALISED: BsdfModel = BsdfModel {
    name: "blinn-normalised",
    title: "Blinn, normalised: the lobe reflects b at normal incidence",
    formula: "f = a / pi + b (c + 2)(c + 4) / (8 pi (2^(-c/2) + c)) <N.H>^c",
    source: "F. Giesen, Derivation of Phong and Blinn-Phong normalization factors, 2009",
    remark: "The albedo is a + b at normal incidence and falls towards the horizon. a + b <= 1 conserves energy.",
    parameters: &[A, B, EXPONENT],
    glsl: Some(glsl!(
        "\
    float factor = (c + 2.0) * (c + 4.0) / (25.1327412287183 * (exp2(-0.5 * c) + c));
    return a / 3.14159265358979 + b * (factor * lobe);
"
    )),
    build: |values| build(values, true),
};

/// The formula exactly as Appendix 6 prints it.
pub static BLINN_PRINTED: BsdfModel = BsdfModel {
    name: "blinn-printed",
    title: "Blinn as Appendix 6 prints it: the normal is missing",
    formula: "f = a / pi + b cos^c (b <wi|wo>)",
    source: "Appendix 6",
    remark: "The normal does not occur: the surface looks the same however it is turned. The angle should be the one between \
             n and the half vector of wi and wo; the second b is a slip, and scales the angle by the colour.",
    parameters: &[A, B, EXPONENT],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    return a / 3.14159265358979 + b * pow(cos(b * dot(L, V)), vec3(c));
}
",
    ),
    build: |values| {
        let c = values.number("c");
        let term = move |b: f64, wi: DVec3, wo: DVec3| b * (b * wi.dot(wo)).cos().powf(c);
        Box::new(PrintedFormula { a: values.color("a"), b: values.color("b"), is_isotropic: true, term })
    },
};

fn build(values: &ParameterValues, normalised: bool) -> Box<dyn Bsdf> {
    let lobe = BlinnLobe { c: values.number("c"), normalised };
    Box::new(DiffuseAndLobe::new(values.color("a"), values.color("b"), lobe))
}

struct BlinnLobe {
    c: f64,
    normalised: bool,
}

impl Lobe for BlinnLobe {
    fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        blinn::lobe(&local_point(wo), wi, self.c, self.normalised)
    }
    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        let h = half_vector(wi, wo, DVec3::Z);
        reflected_density(power_cosine_density(h.z, self.c), wo.dot(h))
    }
    fn sample(&self, wo: DVec3, u: [f64; 2]) -> Option<DVec3> {
        reflect_at(power_cosine(DVec3::Z, self.c, u), wo)
    }
}
