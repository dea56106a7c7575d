//! Lafortune's generalised cosine lobe.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `b` | colour of the lobe, linear RGB | `[0, 1]` | 0.5 |
//! | `k` | exponent | `[1, 1000]` | 32 |
//! | `ax`, `ay`, `az` | diagonal of the matrix `A` of Appendix 6 | `[-1.2, 1.2]` | 1, 1, -1 |
//!
//! `f = a / pi + b <-wi^T A wo>^k`; in the paper's letters `C = -A`. The default matrix makes it Phong's lobe.
//! *Normalised*: `A` divided by its largest magnitude, and the lobe times `(k + 2) / (2 pi)`, see
//! [`gonio_light::brdf::lafortune`].
//!
//! *Source*: E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg, *Non-Linear Approximation of Reflectance
//! Functions*, SIGGRAPH 1997, section 4. *The print*: the clamp at 0 is missing, see [`LAFORTUNE_PRINTED`].
//! *Sampling*: a cosine power about `-A wo`. *Limits*: one lobe; no Fresnel factor.

use super::printed::PrintedFormula;
use super::{A, B, BsdfModel, local_point};
use crate::bsdf::{Bsdf, DiffuseAndLobe, Lobe};
use crate::parameter::{Parameter, ParameterValues};
use crate::sampling::{power_cosine, power_cosine_density};
use gonio_light::DVec3;
use gonio_light::brdf::lafortune;
use gonio_light::vector::unit;

const K: Parameter = Parameter::number("k", [1.0, 1000.0], 32.0, "exponent, a larger one is glossier");
const AX: Parameter = Parameter::number("ax", [-1.2, 1.2], 1.0, "matrix along the tangent");
const AY: Parameter = Parameter::number("ay", [-1.2, 1.2], 1.0, "matrix along the bitangent");
const AZ: Parameter = Parameter::number("az", [-1.2, 1.2], -1.0, "matrix along the normal");

/// The paper's form.
pub static LAFORTUNE: BsdfModel = BsdfModel {
    name: "lafortune",
    title: "Lafortune: a cosine power about a transformed direction, not normalised",
    formula: "f = a / pi + b <-wi^T A wo>^k",
    source: "E. P. F. Lafortune et al., Non-Linear Approximation of Reflectance Functions, SIGGRAPH 1997, section 4",
    remark: "A = diag(1, 1, -1) is Phong's lobe, A = diag(-1, -1, -1) reflects back to the light. A matrix larger than 1 \
             reflects more light than arrives.",
    parameters: &[A, B, K, AX, AY, AZ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    vec3 l = vec3(dot(X, L), dot(Y, L), dot(N, L));
    vec3 v = vec3(dot(X, V), dot(Y, V), dot(N, V));
    float base = -dot(l, vec3(ax, ay, az) * v);
    float lobe = base > 0.0 ? min(pow(base, k), 1e6) : 0.0;
    return a / 3.14159265358979 + b * lobe;
}
",
    ),
    build: |values| build(values, false),
};

/// With the factor of a cosine lobe, and a matrix scaled to 1.
pub static LAFORTUNE_NORMALISED: BsdfModel = BsdfModel {
    name: "lafortune-normalised",
    title: "Lafortune, normalised: the lobe reflects at most b",
    formula: "f = a / pi + b (k + 2) / (2 pi) <-wi^T (A / max|A|) wo>^k",
    source: "E. P. F. Lafortune et al., SIGGRAPH 1997, section 4",
    remark: "The matrix gives the shape of the lobe only. a + b <= 1 conserves energy.",
    parameters: &[A, B, K, AX, AY, AZ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    vec3 l = vec3(dot(X, L), dot(Y, L), dot(N, L));
    vec3 v = vec3(dot(X, V), dot(Y, V), dot(N, V));
    float largest = max(abs(ax), max(abs(ay), abs(az)));
    if (largest < 1e-12) return a / 3.14159265358979;
    float base = -dot(l, vec3(ax, ay, az) / largest * v);
    float lobe = base > 0.0 ? pow(min(base, 1.0), k) : 0.0;
    return a / 3.14159265358979 + b * ((k + 2.0) / 6.28318530717959 * lobe);
}
",
    ),
    build: |values| build(values, true),
};

/// The formula exactly as Appendix 6 prints it.
pub static LAFORTUNE_PRINTED: BsdfModel = BsdfModel {
    name: "lafortune-printed",
    title: "Lafortune as Appendix 6 prints it: without the clamp at 0",
    formula: "f = a / pi + b (-wi^T A wo)^k",
    source: "Appendix 6, headed \"Lafourture\"",
    remark: "The clamp at 0 is missing: where -wi^T A wo is negative, an odd exponent makes the BRDF negative and an even one \
             adds a second lobe opposite to the first. Exponents are rounded to whole numbers here, because others have no \
             value there.",
    parameters: &[A, B, K, AX, AY, AZ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    vec3 l = vec3(dot(X, L), dot(Y, L), dot(N, L));
    vec3 v = vec3(dot(X, V), dot(Y, V), dot(N, V));
    float base = -dot(l, vec3(ax, ay, az) * v);
    float whole = floor(k + 0.5);
    float power = pow(abs(base), whole);
    if (base < 0.0 && mod(whole, 2.0) == 1.0) power = -power;
    return a / 3.14159265358979 + b * power;
}
",
    ),
    build: |values| {
        let (k, matrix) = ((values.number("k") + 0.5).floor() as i32, matrix(values));
        let term = move |b: f64, wi: DVec3, wo: DVec3| b * (-wi.dot(matrix * wo)).powi(k);
        let is_isotropic = matrix.x == matrix.y;
        Box::new(PrintedFormula { a: values.color("a"), b: values.color("b"), is_isotropic, term })
    },
};

fn matrix(values: &ParameterValues) -> DVec3 {
    DVec3::new(values.number("ax"), values.number("ay"), values.number("az"))
}

fn build(values: &ParameterValues, normalised: bool) -> Box<dyn Bsdf> {
    let lobe = LafortuneLobe { k: values.number("k"), matrix: matrix(values), normalised };
    Box::new(DiffuseAndLobe::new(values.color("a"), values.color("b"), lobe))
}

struct LafortuneLobe {
    k: f64,
    matrix: DVec3,
    normalised: bool,
}

impl Lobe for LafortuneLobe {
    fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        lafortune::lobe(&local_point(wo), wi, self.matrix, self.k, self.normalised)
    }
    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        unit(-self.matrix * wo).map_or(0.0, |axis| power_cosine_density(axis.dot(wi), self.k))
    }
    fn sample(&self, wo: DVec3, u: [f64; 2]) -> Option<DVec3> {
        unit(-self.matrix * wo).map(|axis| power_cosine(axis, self.k, u))
    }
    fn is_isotropic(&self) -> bool {
        self.matrix.x == self.matrix.y
    }
}
