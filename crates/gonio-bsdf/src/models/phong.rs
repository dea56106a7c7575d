//! Phong's lobe: a power of the cosine about the mirror direction.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `b` | colour of the lobe, linear RGB | `[0, 1]` | 0.5 |
//! | `c` | exponent | `[1, 1000]` | 32 |
//!
//! `f = a / pi + b <R.V>^c`; *normalised*: the lobe times `(c + 2) / (2 pi)`, see [`gonio_light::brdf::phong`].
//!
//! *Source*: B. T. Phong, *Illumination for Computer Generated Pictures*, CACM 18(6), 1975, in the reciprocal form of
//! E. P. Lafortune and Y. D. Willems, report CW 197, K. U. Leuven, 1994.
//! *The print*: `b cos^c (2<wi|n><wo|n> - <wi|wo>)` takes the cosine of a number that is a cosine already, see
//! [`PHONG_PRINTED`].
//! *Sampling*: `(c + 1) / (2 pi) cos^c` about the mirror direction; directions below the horizon are lost.
//! *Limits*: no Fresnel factor; dark at grazing views, where half of the lobe is below the horizon.

use super::printed::PrintedFormula;
use super::{A, B, BsdfModel, EXPONENT, local_point};
use crate::bsdf::{Bsdf, DiffuseAndLobe, Lobe};
use crate::parameter::ParameterValues;
use crate::sampling::{power_cosine, power_cosine_density};
use gonio_light::DVec3;
use gonio_light::brdf::phong;
use gonio_light::vector::reflection;

/// The function with the lines after its lobe.
macro_rules! glsl {
    ($result:literal) => {
        concat!(
            "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    float cosine = dot(2.0 * dot(N, L) * N - L, V);
    float lobe = cosine > 0.0 ? pow(min(cosine, 1.0), c) : 0.0;
",
            $result,
            "}\n"
        )
    };
}

/// The paper's form.
pub static PHONG: BsdfModel = BsdfModel {
    name: "phong",
    title: "Phong: a cosine power about the mirror direction, not normalised",
    formula: "f = a / pi + b <R.V>^c",
    source: "B. T. Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975",
    remark: "Without the factor (c + 2) / (2 pi) the lobe reflects less the larger c is, and for c = 1 and b = 1 more light \
             than arrives. No Fresnel factor.",
    parameters: &[A, B, EXPONENT],
    glsl: Some(glsl!(
        "\
    return a / 3.14159265358979 + b * lobe;
"
    )),
    build: |values| build(values, false),
};

/// With the factor that makes the lobe's albedo at normal view 1.
pub static PHONG_NORMALISED: BsdfModel = BsdfModel {
    name: "phong-normalised",
    title: "Phong, normalised: the lobe reflects at most b",
    formula: "f = a / pi + b (c + 2) / (2 pi) <R.V>^c",
    source: "E. P. Lafortune, Y. D. Willems, Using the Modified Phong Reflectance Model for Physically Based Rendering, \
             report CW 197, K. U. Leuven, 1994",
    remark: "The albedo is a + b at normal incidence and falls towards the horizon. a + b <= 1 conserves energy.",
    parameters: &[A, B, EXPONENT],
    glsl: Some(glsl!(
        "\
    return a / 3.14159265358979 + b * ((c + 2.0) / 6.28318530717959 * lobe);
"
    )),
    build: |values| build(values, true),
};

/// The formula exactly as Appendix 6 prints it.
pub static PHONG_PRINTED: BsdfModel = BsdfModel {
    name: "phong-printed",
    title: "Phong as Appendix 6 prints it: bright where Phong is dark",
    formula: "f = a / pi + b cos^c (2 <wi|n><wo|n> - <wi|wo>)",
    source: "Appendix 6",
    remark: "2 <wi|n><wo|n> - <wi|wo> is the cosine R.V already. Its cosine is largest where R.V = 0, at right angles to the \
             mirror direction, and falls to cos(1)^c in the mirror direction itself: the highlight becomes a hole. The paper \
             has (R.V)^c, held at 0 where R.V is negative.",
    parameters: &[A, B, EXPONENT],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    float argument = 2.0 * dot(N, L) * dot(N, V) - dot(L, V);
    return a / 3.14159265358979 + b * pow(cos(argument), c);
}
",
    ),
    build: |values| {
        let c = values.number("c");
        let term = move |b: f64, wi: DVec3, wo: DVec3| b * (2.0 * wi.z * wo.z - wi.dot(wo)).cos().powf(c);
        Box::new(PrintedFormula { a: values.color("a"), b: values.color("b"), is_isotropic: true, term })
    },
};

fn build(values: &ParameterValues, normalised: bool) -> Box<dyn Bsdf> {
    let lobe = PhongLobe { c: values.number("c"), normalised };
    Box::new(DiffuseAndLobe::new(values.color("a"), values.color("b"), lobe))
}

struct PhongLobe {
    c: f64,
    normalised: bool,
}

impl Lobe for PhongLobe {
    fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        phong::lobe(&local_point(wo), wi, self.c, self.normalised)
    }
    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        power_cosine_density(reflection(DVec3::Z, wo).dot(wi), self.c)
    }
    fn sample(&self, wo: DVec3, u: [f64; 2]) -> Option<DVec3> {
        Some(power_cosine(reflection(DVec3::Z, wo), self.c, u))
    }
}
