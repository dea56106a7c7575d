//! Disney's principled BRDF of 2012.
//!
//! | parameter | is | range | default |
//! |---|---|---|---|
//! | `baseColor` | colour of the surface, linear RGB | `[0, 1]` | 0.5 |
//! | `metallic` | from a dielectric (0) to a metal (1) | `[0, 1]` | 0 |
//! | `subsurface` | from the diffuse model to an approximation of subsurface scattering | `[0, 1]` | 0 |
//! | `specular` | reflectance at normal incidence, 1 is 0.08 | `[0, 1]` | 0.5 |
//! | `roughness` | perceptual roughness, its square is the width of the slopes | `[0, 1]` | 0.5 |
//! | `specularTint` | specular light takes the hue of `baseColor` | `[0, 1]` | 0 |
//! | `anisotropic` | elongation of the highlight | `[0, 1]` | 0 |
//! | `sheen`, `sheenTint` | light at grazing angles, as of cloth, and its hue | `[0, 1]` | 0, 0.5 |
//! | `clearcoat`, `clearcoatGloss` | a second lobe and its gloss | `[0, 1]` | 0, 1 |
//!
//! *Source*: B. Burley, *Physically-Based Shading at Disney*, SIGGRAPH 2012 course, section 5, with the shadowing of the
//! implementation that Disney released with it: Smith's for the anisotropic widths themselves, where the text of 2012 has
//! `(0.5 + roughness / 2)^2`. `baseColor` is linear here; the released implementation raises it to the power 2.2.
//! *Sampling*: the cosine, GTR2 and GTR1 in fixed shares.
//! *Limits*: the diffuse part is not reduced by the specular one, so some values reflect more light than arrives.

use super::BsdfModel;
use crate::bsdf::{Bsdf, BsdfSample, both_above, weighted};
use crate::parameter::{Parameter, ParameterValues};
use crate::sampling::{cosine_density, cosine_hemisphere, direction_of_cosine, reflect_at, reflected_density};
use gonio_light::DVec3;
use gonio_light::vector::half_vector;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// The principled BRDF.
pub static DISNEY: BsdfModel = BsdfModel {
    name: "disney",
    title: "Disney 2012: the principled BRDF",
    formula: "f = (1 - metallic) (baseColor / pi mix(Fd, ss, subsurface) + Fsheen) + Gs Fs Ds + clearcoat / 4 Gr Fr Dr",
    source: "B. Burley, Physically-Based Shading at Disney, SIGGRAPH 2012 course, section 5; shadowing as in the released \
             implementation",
    remark: "Made for artists: some values reflect more light than arrives, most of all with sheen or clearcoat.",
    parameters: &[
        Parameter::color("baseColor", 0.5, "colour of the surface"),
        Parameter::number("metallic", [0.0, 1.0], 0.0, "from a dielectric to a metal"),
        Parameter::number("subsurface", [0.0, 1.0], 0.0, "share of the subsurface approximation"),
        Parameter::number("specular", [0.0, 1.0], 0.5, "reflectance at normal incidence, 1 is 0.08"),
        Parameter::number("roughness", [0.0, 1.0], 0.5, "perceptual roughness"),
        Parameter::number("specularTint", [0.0, 1.0], 0.0, "hue of specular light"),
        Parameter::number("anisotropic", [0.0, 1.0], 0.0, "elongation of the highlight"),
        Parameter::number("sheen", [0.0, 1.0], 0.0, "light at grazing angles"),
        Parameter::number("sheenTint", [0.0, 1.0], 0.5, "hue of the sheen"),
        Parameter::number("clearcoat", [0.0, 1.0], 0.0, "strength of the second lobe"),
        Parameter::number("clearcoatGloss", [0.0, 1.0], 1.0, "gloss of the second lobe"),
    ],
    glsl: Some(GLSL),
    build: |values| Box::new(Disney::new(values)),
};

const GLSL: &str = "\
const float PI = 3.14159265358979;

float weight(float u)
{
    return pow(clamp(1.0 - u, 0.0, 1.0), 5.0);
}

float smith(float cosine, float x, float y, float ax, float ay)
{
    return 1.0 / (cosine + sqrt(x * x * ax * ax + y * y * ay * ay + cosine * cosine));
}

vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)
{
    float cosL = dot(N, L), cosV = dot(N, V);
    if (cosL <= 0.0 || cosV <= 0.0) return vec3(0.0);
    vec3 H = normalize(L + V);
    vec3 h = vec3(dot(X, H), dot(Y, H), dot(N, H));
    float LdotH = dot(L, H);
    float luminance = dot(baseColor, vec3(0.3, 0.6, 0.1));
    vec3 tint = luminance > 0.0 ? baseColor / luminance : vec3(1.0);
    vec3 spec0 = mix(specular * 0.08 * mix(vec3(1.0), tint, specularTint), baseColor, metallic);
    float wL = weight(cosL), wV = weight(cosV), wH = weight(LdotH);
    float fd90 = 0.5 + 2.0 * LdotH * LdotH * roughness;
    float fd = mix(1.0, fd90, wL) * mix(1.0, fd90, wV);
    float fss90 = LdotH * LdotH * roughness;
    float fss = mix(1.0, fss90, wL) * mix(1.0, fss90, wV);
    float ss = 1.25 * (fss * (1.0 / (cosL + cosV) - 0.5) + 0.5);
    float aspect = sqrt(1.0 - 0.9 * anisotropic);
    float ax = max(0.001, roughness * roughness / aspect), ay = max(0.001, roughness * roughness * aspect);
    float s = h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay) + h.z * h.z;
    float Ds = 1.0 / (PI * ax * ay * s * s);
    vec3 Fs = mix(spec0, vec3(1.0), wH);
    float Gs = smith(cosL, dot(L, X), dot(L, Y), ax, ay) * smith(cosV, dot(V, X), dot(V, Y), ax, ay);
    vec3 Fsheen = wH * sheen * mix(vec3(1.0), tint, sheenTint);
    float width = mix(0.1, 0.001, clearcoatGloss);
    float Dr = (width * width - 1.0) / (PI * log(width * width) * (width * width * h.z * h.z + dot(h.xy, h.xy)));
    float Gr = 1.0 / (cosL + sqrt(0.0625 + 0.9375 * cosL * cosL)) / (cosV + sqrt(0.0625 + 0.9375 * cosV * cosV));
    return (1.0 - metallic) * (baseColor / PI * mix(fd, ss, subsurface) + Fsheen) + Gs * Ds * Fs
        + 0.25 * clearcoat * Gr * mix(0.04, 1.0, wH) * Dr;
}
";

struct Disney {
    base: DVec3,
    spec0: DVec3,
    sheen: DVec3,
    metallic: f64,
    subsurface: f64,
    roughness: f64,
    ax: f64,
    ay: f64,
    clearcoat: f64,
    coat_width: f64,
    /// The shares of samples of the cosine and of GTR2; GTR1 has the rest.
    shares: [f64; 2],
}

fn mix(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

/// Schlick's weight `(1 - u)^5`.
fn weight(u: f64) -> f64 {
    (1.0 - u).clamp(0.0, 1.0).powi(5)
}

/// Smith's `G_1 / (2 cos)` for anisotropic GGX.
fn smith(w: DVec3, ax: f64, ay: f64) -> f64 {
    1.0 / (w.z + ((w.x * ax).powi(2) + (w.y * ay).powi(2) + w.z * w.z).sqrt())
}

impl Disney {
    fn new(values: &ParameterValues) -> Self {
        let base = values.color("baseColor");
        let [metallic, roughness] = ["metallic", "roughness"].map(|name| values.number(name));
        let luminance = base.dot(DVec3::new(0.3, 0.6, 0.1));
        let tint = if luminance > 0.0 { base / luminance } else { DVec3::ONE };
        let tinted = |share: f64| DVec3::ONE.lerp(tint, share);
        let aspect = (1.0 - 0.9 * values.number("anisotropic")).sqrt();
        let clearcoat = values.number("clearcoat");
        let spec0 = (values.number("specular") * 0.08 * tinted(values.number("specularTint"))).lerp(base, metallic);
        let [diffuse, specular, coat] = [(1.0 - metallic) * 0.5, 0.4, 0.1 * clearcoat];
        let sum = diffuse + specular + coat;
        Disney {
            base,
            spec0,
            sheen: values.number("sheen") * tinted(values.number("sheenTint")),
            metallic,
            subsurface: values.number("subsurface"),
            roughness,
            ax: (roughness * roughness / aspect).max(0.001),
            ay: (roughness * roughness * aspect).max(0.001),
            clearcoat,
            coat_width: mix(0.1, 0.001, values.number("clearcoatGloss")),
            shares: [diffuse / sum, specular / sum],
        }
    }

    fn gtr2(&self, h: DVec3) -> f64 {
        let s = (h.x / self.ax).powi(2) + (h.y / self.ay).powi(2) + h.z * h.z;
        FRAC_1_PI / (self.ax * self.ay * s * s)
    }

    fn gtr1(&self, h: DVec3) -> f64 {
        let a2 = self.coat_width * self.coat_width;
        (a2 - 1.0) / (PI * a2.ln() * (a2 * h.z * h.z + h.x * h.x + h.y * h.y))
    }

    fn sample_gtr2(&self, u: [f64; 2]) -> DVec3 {
        let radius = (u[0] / (1.0 - u[0])).sqrt();
        let (sin, cos) = (TAU * u[1]).sin_cos();
        DVec3::new(radius * self.ax * cos, radius * self.ay * sin, 1.0).normalize()
    }

    fn sample_gtr1(&self, u: [f64; 2]) -> DVec3 {
        let a2 = self.coat_width * self.coat_width;
        let cos2 = (1.0 - a2.powf(1.0 - u[0])) / (1.0 - a2);
        direction_of_cosine(cos2.max(0.0).sqrt(), TAU * u[1])
    }
}

impl Bsdf for Disney {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if !both_above(wi, wo) {
            return DVec3::ZERO;
        }
        let h = half_vector(wi, wo, DVec3::Z);
        let cos_lh = wi.dot(h);
        let [light, view, half] = [wi.z, wo.z, cos_lh].map(weight);
        let fd90 = 0.5 + 2.0 * cos_lh * cos_lh * self.roughness;
        let fd = mix(1.0, fd90, light) * mix(1.0, fd90, view);
        let fss90 = cos_lh * cos_lh * self.roughness;
        let fss = mix(1.0, fss90, light) * mix(1.0, fss90, view);
        let ss = 1.25 * (fss * (1.0 / (wi.z + wo.z) - 0.5) + 0.5);
        let diffuse = self.base * (FRAC_1_PI * mix(fd, ss, self.subsurface)) + self.sheen * half;
        let mirror = self.gtr2(h) * smith(wi, self.ax, self.ay) * smith(wo, self.ax, self.ay);
        let coat = self.gtr1(h) * smith(wi, 0.25, 0.25) * smith(wo, 0.25, 0.25) * mix(0.04, 1.0, half);
        (1.0 - self.metallic) * diffuse
            + self.spec0.lerp(DVec3::ONE, half) * mirror
            + DVec3::splat(0.25 * self.clearcoat * coat)
    }

    fn density(&self, wi: DVec3, wo: DVec3) -> f64 {
        if !both_above(wi, wo) {
            return 0.0;
        }
        let h = half_vector(wi, wo, DVec3::Z);
        let [diffuse, specular] = self.shares;
        let half = specular * self.gtr2(h) * h.z + (1.0 - diffuse - specular) * self.gtr1(h) * h.z;
        diffuse * cosine_density(wi) + reflected_density(half, wo.dot(h))
    }

    fn sample(&self, wo: DVec3, u: [f64; 3]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let [diffuse, specular] = self.shares;
        let pair = [u[0], u[1]];
        let wi = if u[2] < diffuse {
            cosine_hemisphere(pair)
        } else if u[2] < diffuse + specular {
            reflect_at(self.sample_gtr2(pair), wo)?
        } else {
            reflect_at(self.sample_gtr1(pair), wo)?
        };
        weighted(self, wi, wo)
    }

    fn is_isotropic(&self) -> bool {
        self.ax == self.ay
    }
}
