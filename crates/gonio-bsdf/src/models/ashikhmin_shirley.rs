//! Ashikhmin and Shirley's anisotropic Phong model.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `rd` | diffuse reflectance, linear RGB | `[0, 1]` | 0.3 |
//! | `rs` | specular reflectance at normal incidence, linear RGB | `[0, 1]` | 0.2 |
//! | `nu`, `nv` | exponents along the tangent and the bitangent | `[1, 10000]` | 100, 100 |
//!
//! ```text
//! f = sqrt((nu + 1)(nv + 1)) / (8 pi) <N.H>^((nu (H.X)^2 + nv (H.Y)^2) / (1 - (N.H)^2)) F(V.H) / (V.H max(N.L, N.V))
//!   + 28 rd (1 - rs) / (23 pi) (1 - (1 - N.L / 2)^5) (1 - (1 - N.V / 2)^5)
//! ```
//!
//! *Source*: M. Ashikhmin and P. Shirley, *An Anisotropic Phong BRDF Model*, JGT 5(2), 2000, eq. (4) to (9).
//! *Sampling*: half vectors by quadrants (eq. 6 and 7), mirrored. *Limits*: no shadowing.

use super::BsdfModel;
use crate::bsdf::{Bsdf, BsdfSample, both_above, mean, weighted};
use crate::parameter::Parameter;
use crate::sampling::{cosine_or_half, cosine_or_half_density, direction_of_cosine};
use gonio_light::DVec3;
use gonio_light::optics::schlick;
use gonio_light::vector::half_vector;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The paper's model.
pub static ASHIKHMIN_SHIRLEY: BsdfModel = BsdfModel {
    name: "ashikhmin-shirley",
    title: "Ashikhmin-Shirley: an anisotropic Phong lobe with a coupled diffuse part",
    formula: "f = sqrt((nu+1)(nv+1)) / (8 pi) <N.H>^((nu (H.X)^2 + nv (H.Y)^2) / (1 - (N.H)^2)) F(V.H) / (V.H max(N.L, N.V)) \
              + 28 rd (1 - rs) / (23 pi) (1 - (1 - N.L/2)^5) (1 - (1 - N.V/2)^5)",
    source: "M. Ashikhmin, P. Shirley, An Anisotropic Phong BRDF Model, JGT 5(2), 2000, eq. (4) to (9)",
    remark: "F is Schlick's approximation with rs. Diffuse light decreases as specular light increases, so energy is conserved.",
    parameters: &[
        Parameter::color("rd", 0.3, "diffuse reflectance"),
        Parameter::color("rs", 0.2, "specular reflectance at normal incidence"),
        Parameter::number("nu", [1.0, 10_000.0], 100.0, "exponent along the tangent"),
        Parameter::number("nv", [1.0, 10_000.0], 100.0, "exponent along the bitangent"),
    ],
    glsl: Some(
        "\
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL <= 0.0 || cosV <= 0.0) return vec3(0.0);
    vec3 H = normalize(L + V);
    vec3 h = vec3(dot(X, H), dot(Y, H), dot(N, H));
    float sin2 = dot(h.xy, h.xy);
    float exponent = sin2 > 0.0 ? (nu * h.x * h.x + nv * h.y * h.y) / sin2 : nu;
    float VdotH = dot(V, H);
    vec3 F = rs + (1.0 - rs) * pow(1.0 - min(VdotH, 1.0), 5.0);
    float lobe = sqrt((nu + 1.0) * (nv + 1.0)) / 25.1327412287183 * exp(0.5 * exponent * log(max(1.0 - sin2, 1e-37)));
    vec3 diffuse = 28.0 / 72.2566310325652 * rd * (1.0 - rs) * (1.0 - pow(1.0 - 0.5 * cosL, 5.0)) * (1.0 - pow(1.0 - 0.5 * cosV, 5.0));
    return diffuse + F * (lobe / (VdotH * max(cosL, cosV)));
}
",
    ),
    build: |values| {
        Box::new(AshikhminShirley {
            rd: values.color("rd"),
            rs: values.color("rs"),
            nu: values.number("nu"),
            nv: values.number("nv"),
        })
    },
};

struct AshikhminShirley {
    rd: DVec3,
    rs: DVec3,
    nu: f64,
    nv: f64,
}

impl AshikhminShirley {
    fn diffuse_share(&self) -> f64 {
        let (d, s) = (mean(self.rd * (DVec3::ONE - self.rs)), 0.05 + 0.95 * mean(self.rs));
        d / (d + s)
    }

    /// The density of half vectors, eq. (6).
    fn half_density(&self, h: DVec3) -> f64 {
        if h.z <= 0.0 {
            return 0.0;
        }
        let sin2 = h.x * h.x + h.y * h.y;
        let exponent = if sin2 > 0.0 { (self.nu * h.x * h.x + self.nv * h.y * h.y) / sin2 } else { self.nu };
        ((self.nu + 1.0) * (self.nv + 1.0)).sqrt() / TAU * h.z.min(1.0).powf(exponent)
    }

    /// Draws a half vector, eq. (7) and (8).
    fn sample_half(&self, u: [f64; 2]) -> DVec3 {
        let quadrant = (4.0 * u[0]).floor();
        let within = 4.0 * u[0] - quadrant;
        // Quadrants are mirror images: 1 and 3 run backwards, so that the azimuth is continuous.
        let is_mirrored = quadrant % 2.0 == 1.0;
        let share = if is_mirrored { 1.0 - within } else { within };
        let angle = (((self.nu + 1.0) / (self.nv + 1.0)).sqrt() * (FRAC_PI_2 * share).tan()).atan();
        let phi = match quadrant as u32 {
            0 => angle,
            1 => PI - angle,
            2 => PI + angle,
            _ => TAU - angle,
        };
        let exponent = self.nu * phi.cos().powi(2) + self.nv * phi.sin().powi(2);
        direction_of_cosine((1.0 - u[1]).powf(1.0 / (exponent + 1.0)), phi)
    }
}

impl Bsdf for AshikhminShirley {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if !both_above(wi, wo) {
            return DVec3::ZERO;
        }
        let h = half_vector(wi, wo, DVec3::Z);
        let cos_vh = wo.dot(h);
        let fresnel = self.rs.map(|rs| schlick(cos_vh, rs));
        let lobe = self.half_density(h) / (4.0 * cos_vh * wi.z.max(wo.z));
        let faded = |cos: f64| 1.0 - (1.0 - 0.5 * cos).powi(5);
        let diffuse = self.rd * (DVec3::ONE - self.rs) * (28.0 / (23.0 * PI) * faded(wi.z) * faded(wo.z));
        diffuse + fresnel * lobe
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !both_above(wi, wo) {
            return 0.0;
        }
        let h = half_vector(wi, wo, DVec3::Z);
        cosine_or_half_density(self.diffuse_share(), wi, wo.dot(h), self.half_density(h))
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        weighted(self, cosine_or_half(self.diffuse_share(), wo, u, |u| self.sample_half(u))?, wo)
    }

    fn is_isotropic(&self) -> bool {
        self.nu == self.nv
    }
}
