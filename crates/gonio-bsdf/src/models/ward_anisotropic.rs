//! Ward's anisotropic Gaussian lobe.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `a` | diffuse albedo, linear RGB | `[0, 1]` | 0 |
//! | `b` | colour of the lobe, linear RGB | `[0, 1]` | 0.5 |
//! | `cx`, `cy` | RMS slopes along the tangent and the bitangent | `[0.01, 1]` | 0.1, 0.3 |
//!
//! `f = a / pi + b / (4 pi cx cy sqrt(<N.L><N.V>)) exp(-((H.X / cx)^2 + (H.Y / cy)^2) / (N.H)^2)`; equal slopes make it
//! [`super::ward`].
//!
//! *Source*: G. J. Ward, *Measuring and Modeling Anisotropic Reflection*, SIGGRAPH 1992, eq. (5).
//! *Sampling*: half vectors with Gaussian slopes (eq. 6 and 7), mirrored. *Limits*: as the isotropic form.

use super::{A, B, BsdfModel};
use crate::bsdf::{DiffuseAndLobe, Lobe};
use crate::parameter::Parameter;
use crate::sampling::{gaussian_half, gaussian_half_density, reflect_at, reflected_density};
use gonio_light::DVec3;
use gonio_light::brdf::{LOBE_CAP, ward::GRAZING_COSINE};
use gonio_light::vector::half_vector;
use std::f64::consts::PI;

/// The paper's form.
pub static WARD_ANISOTROPIC: BsdfModel = BsdfModel {
    name: "ward-anisotropic",
    title: "Ward: a Gaussian of slopes, of two widths",
    formula: "f = a / pi + b / (4 pi cx cy sqrt(<N.L><N.V>)) exp(-((H.X / cx)^2 + (H.Y / cy)^2) / (N.H)^2)",
    source: "G. J. Ward, Measuring and Modeling Anisotropic Reflection, SIGGRAPH 1992, eq. (5)",
    remark: "The highlight is long across the direction of the larger slope. Towards the horizon the albedo has no bound.",
    parameters: &[
        A,
        B,
        Parameter::number("cx", [0.01, 1.0], 0.1, "RMS slope along the tangent"),
        Parameter::number("cy", [0.01, 1.0], 0.3, "RMS slope along the bitangent"),
    ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    if (dot(N, L) <= 0.0 || dot(N, V) <= 0.0) return vec3(0.0);
    float cosL = max(dot(N, L), 1e-6);
    float cosV = max(dot(N, V), 1e-6);
    vec3 sum = L + V;
    vec2 slope = vec2(dot(X, sum) / cx, dot(Y, sum) / cy) / (cosL + cosV);
    float lobe = exp(-dot(slope, slope)) / (12.5663706143592 * cx * cy * sqrt(cosL * cosV));
    return a / 3.14159265358979 + b * min(lobe, 1e6);
}
",
    ),
    build: |values| {
        let lobe = WardAnisotropicLobe { cx: values.number("cx"), cy: values.number("cy") };
        Box::new(DiffuseAndLobe::new(values.color("a"), values.color("b"), lobe))
    },
};

struct WardAnisotropicLobe {
    cx: f64,
    cy: f64,
}

impl Lobe for WardAnisotropicLobe {
    fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (cos_l, cos_v) = (wi.z.max(GRAZING_COSINE), wo.z.max(GRAZING_COSINE));
        let along = cos_l + cos_v;
        let (x, y) = ((wi.x + wo.x) / (self.cx * along), (wi.y + wo.y) / (self.cy * along));
        let gauss = (-(x * x + y * y)).exp();
        (gauss / (4.0 * PI * self.cx * self.cy * (cos_l * cos_v).sqrt())).min(LOBE_CAP)
    }
    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        let h = half_vector(wi, wo, DVec3::Z);
        reflected_density(gaussian_half_density(h, self.cx, self.cy), wo.dot(h))
    }
    fn sample(&self, wo: DVec3, u: [f64; 2]) -> Option<DVec3> {
        reflect_at(gaussian_half(self.cx, self.cy, u), wo)
    }
    fn is_isotropic(&self) -> bool {
        self.cx == self.cy
    }
}
