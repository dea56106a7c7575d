//! Lafortune's model with two or three lobes, as the paper fits it to measured surfaces.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0.1 |
//! | `b1`, `b2`, `b3` | colours of the lobes, linear RGB | `[0, 1]` | 0.3 or less |
//! | `k1`, `k2`, `k3` | exponents | `[1, 1000]` | 10, 50, 200 |
//! | `z1`, `z2`, `z3` | the matrix along the normal; along both tangents it is 1 | `[-1.2, 0]` | -1 |
//!
//! `f = a / pi + sum b_i (k_i + 2) / (2 pi) <-wi^T (A_i / max|A_i|) wo>^k_i`, `A_i = diag(1, 1, z_i)`: the sum of normalised
//! lobes of [`super::lafortune`]. `z < -1` leans towards the normal, `z > -1` towards the horizon.
//!
//! *Source*: E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg, *Non-Linear Approximation of Reflectance
//! Functions*, SIGGRAPH 1997, sections 4 and 5. *Sampling*: each lobe in proportion to its colour.
//! *Limits*: isotropic, because measured tables are; no Fresnel factor.

use super::{BsdfModel, local_point};
use crate::bsdf::{Bsdf, BsdfSample, both_above, mean, weighted};
use crate::parameter::{Parameter, ParameterValues};
use crate::sampling::{cosine_density, cosine_hemisphere, power_cosine, power_cosine_density};
use gonio_light::DVec3;
use gonio_light::brdf::lafortune;
use gonio_light::vector::unit;
use std::f64::consts::FRAC_1_PI;

const A: Parameter = Parameter::color("a", 0.1, "diffuse albedo");

const fn colour(name: &'static str, default: f64) -> Parameter {
    Parameter::color(name, default, "colour of the lobe")
}

const fn exponent(name: &'static str, default: f64) -> Parameter {
    Parameter::number(name, [1.0, 1000.0], default, "exponent, a larger one is glossier")
}

const fn lean(name: &'static str) -> Parameter {
    Parameter::number(name, [-1.2, 0.0], -1.0, "matrix along the normal, -1 mirrors")
}

/// The function of one lobe in GLSL, and the beginning of `BRDF`.
macro_rules! glsl {
    ($sum:literal) => {
        concat!(
            "\
float lobe(vec3 l, vec3 v, float k, float z)
{
    float base = dot(l, vec3(-1.0, -1.0, -z) / max(1.0, -z) * v);
    return base > 0.0 ? (k + 2.0) / 6.28318530717959 * pow(min(base, 1.0), k) : 0.0;
}

vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    vec3 l = vec3(dot(X, L), dot(Y, L), dot(N, L));
    vec3 v = vec3(dot(X, V), dot(Y, V), dot(N, V));
    return a / 3.14159265358979 + ",
            $sum,
            ";
}
"
        )
    };
}

/// Two lobes.
pub static LAFORTUNE_2: BsdfModel = BsdfModel {
    name: "lafortune-2",
    title: "Lafortune with two lobes, normalised",
    formula: "f = a / pi + sum of 2 b_i (k_i + 2) / (2 pi) <-wi^T (A_i / max|A_i|) wo>^k_i, A_i = diag(1, 1, z_i)",
    source: "E. P. F. Lafortune et al., Non-Linear Approximation of Reflectance Functions, SIGGRAPH 1997, sections 4 and 5",
    remark: "Made to be fitted to measured surfaces. a + b1 + b2 <= 1 conserves energy.",
    parameters: &[
        A,
        colour("b1", 0.3),
        exponent("k1", 10.0),
        lean("z1"),
        colour("b2", 0.2),
        exponent("k2", 50.0),
        lean("z2"),
    ],
    glsl: Some(glsl!("b1 * lobe(l, v, k1, z1) + b2 * lobe(l, v, k2, z2)")),
    build: |values| build(values, &[["b1", "k1", "z1"], ["b2", "k2", "z2"]]),
};

/// Three lobes.
pub static LAFORTUNE_3: BsdfModel = BsdfModel {
    name: "lafortune-3",
    title: "Lafortune with three lobes, normalised",
    formula: "f = a / pi + sum of 3 b_i (k_i + 2) / (2 pi) <-wi^T (A_i / max|A_i|) wo>^k_i, A_i = diag(1, 1, z_i)",
    source: "E. P. F. Lafortune et al., Non-Linear Approximation of Reflectance Functions, SIGGRAPH 1997, sections 4 and 5",
    remark: "Made to be fitted to measured surfaces. a + b1 + b2 + b3 <= 1 conserves energy.",
    parameters: &[
        A,
        colour("b1", 0.3),
        exponent("k1", 10.0),
        lean("z1"),
        colour("b2", 0.2),
        exponent("k2", 50.0),
        lean("z2"),
        colour("b3", 0.1),
        exponent("k3", 200.0),
        lean("z3"),
    ],
    glsl: Some(glsl!("b1 * lobe(l, v, k1, z1) + b2 * lobe(l, v, k2, z2) + b3 * lobe(l, v, k3, z3)")),
    build: |values| build(values, &[["b1", "k1", "z1"], ["b2", "k2", "z2"], ["b3", "k3", "z3"]]),
};

fn build(values: &ParameterValues, names: &[[&str; 3]]) -> Box<dyn Bsdf> {
    let lobes = names.iter().map(|[b, k, z]| OneLobe {
        color: values.color(b),
        k: values.number(k),
        matrix: DVec3::new(1.0, 1.0, values.number(z)),
    });
    Box::new(LafortuneLobes { diffuse: values.color("a"), lobes: lobes.collect() })
}

struct OneLobe {
    color: DVec3,
    k: f64,
    matrix: DVec3,
}

impl OneLobe {
    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        unit(-self.matrix * wo).map_or(0.0, |axis| power_cosine_density(axis.dot(wi), self.k))
    }
}

struct LafortuneLobes {
    diffuse: DVec3,
    lobes: Vec<OneLobe>,
}

impl LafortuneLobes {
    /// The sum of the means of all colours, at least a little, so that shares of it exist.
    fn total(&self) -> f64 {
        (mean(self.diffuse) + self.lobes.iter().map(|lobe| mean(lobe.color)).sum::<f64>()).max(1e-9)
    }
}

impl Bsdf for LafortuneLobes {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if !both_above(wi, wo) {
            return DVec3::ZERO;
        }
        let point = local_point(wo);
        let value = |lobe: &OneLobe| lobe.color * lafortune::lobe(&point, wi, lobe.matrix, lobe.k, true);
        self.diffuse * FRAC_1_PI + self.lobes.iter().map(value).sum::<DVec3>()
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !both_above(wi, wo) {
            return 0.0;
        }
        let total = self.total();
        let lobes = self.lobes.iter().map(|lobe| mean(lobe.color) / total * lobe.density(wi, wo));
        mean(self.diffuse) / total * cosine_density(wi) + lobes.sum::<f64>()
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        let pair = [u[0], u[1]];
        let mut rest = u[2] * self.total() - mean(self.diffuse);
        if rest < 0.0 {
            return weighted(self, cosine_hemisphere(pair), wo);
        }
        for lobe in &self.lobes {
            rest -= mean(lobe.color);
            if rest < 0.0 {
                let axis = unit(-lobe.matrix * wo)?;
                return weighted(self, power_cosine(axis, lobe.k, pair), wo);
            }
        }
        // A black surface.
        None
    }
}
