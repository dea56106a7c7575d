//! The BRDFs of Appendix 6, `f` in 1/sr.
//!
//! Each has its own file: a table of its parameters, its source, where the seed's print differs from
//! that source, and its limits. All of them are `a / pi + b` times a specular lobe, with `a` the
//! surface's diffuse colour, `b` its specular colour, and the lobe's width from its shininess.
//!
//! The lobe is 0 where `N.L <= 0` or `N.V <= 0`, and always in `[0, LOBE_CAP]`. The diffuse part is
//! `a / pi` everywhere: the factor `<N.L>` of the equation removes it below the horizon.

pub mod blinn;
pub mod lafortune;
pub mod lambert;
pub mod phong;
pub mod ward;

use crate::shading_point::{ShadingPoint, Surface};
use glam::DVec3;

named_enum! {
    /// A BRDF of Appendix 6.
    pub enum BrdfKind {
        /// `a/pi`
        Lambert = "lambert",
        /// A generalised cosine lobe about a transformed direction (Lafortune et al. 1997).
        Lafortune = "lafortune",
        /// `a/pi + b <N.H>^c` (Blinn 1977)
        Blinn = "blinn",
        /// `a/pi + b <R.V>^c` (Phong 1975)
        Phong = "phong",
        /// Isotropic Gaussian microfacet lobe (Ward 1992)
        Ward = "ward",
    }
    default Lambert;
    what "BRDF";
}

/// No lobe is ever brighter than this (1/sr). Only Ward's at grazing angles and Lafortune's with a
/// matrix larger than 1 come near it; a normalised Phong lobe at [`SHININESS_MAX`] has 1.6e5.
pub const LOBE_CAP: f64 = 1e6;

/// Larger exponents count as this. A lobe so narrow is 0.14 degrees wide at half height, far below a
/// pixel, and the cosines of `f32` could not resolve a narrower one.
pub const SHININESS_MAX: f64 = 1e6;

/// The exponent that is calculated with: `shininess` held in `[1, SHININESS_MAX]`; NaN counts as 1.
pub fn effective_shininess(shininess: f64) -> f64 {
    // `max` before `min`: f64::max returns the other operand for NaN, where `clamp` would keep it.
    #[allow(clippy::manual_clamp)]
    shininess.max(1.0).min(SHININESS_MAX)
}

/// `<cosine>^shininess` with the [`effective_shininess`], in `[0, 1]`; 0 for a negative cosine, and a
/// cosine that rounding has put above 1 counts as 1.
pub fn cosine_power(cosine: f64, shininess: f64) -> f64 {
    if cosine > 0.0 { cosine.min(1.0).powf(effective_shininess(shininess)) } else { 0.0 }
}

/// Whether light and view are both on the side of the surface that `n` points to.
pub fn above_horizon(n: DVec3, v: DVec3, l: DVec3) -> bool {
    n.dot(l) > 0.0 && n.dot(v) > 0.0
}

/// A BRDF with what it needs besides the surface's `a = k_d`, `b = k_s` and `c = shininess`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrdfSettings {
    /// The BRDF.
    pub kind: BrdfKind,
    /// Whether it has the factor that keeps the lobe's albedo at most `b`.
    pub normalised: bool,
    /// Diagonal of Lafortune's matrix `A` in the local frame (tangent, bitangent, normal);
    /// (1, 1, -1) makes it Phong's lobe.
    pub lafortune: DVec3,
}

impl BrdfSettings {
    /// The BRDF as Appendix 6 has it, not normalised.
    pub fn new(kind: BrdfKind) -> Self {
        BrdfSettings { kind, normalised: false, lafortune: DVec3::new(1.0, 1.0, -1.0) }
    }

    /// The specular lobe in 1/sr for `b = 1`, without the diffuse part; 0 below the horizon, and
    /// always in `[0, LOBE_CAP]`. `l` is the unit vector to the light.
    pub fn lobe(&self, point: &ShadingPoint, surface: &Surface, l: DVec3) -> f64 {
        let c = surface.shininess;
        match self.kind {
            BrdfKind::Lambert => lambert::lobe(),
            BrdfKind::Lafortune => lafortune::lobe(point, l, self.lafortune, c, self.normalised),
            BrdfKind::Blinn => blinn::lobe(point, l, c, self.normalised),
            BrdfKind::Phong => phong::lobe(point, l, c, self.normalised),
            BrdfKind::Ward => ward::lobe(point, l, c, self.normalised),
        }
    }

    /// The whole `f = a / pi + b lobe` in 1/sr, per channel. `l` is the unit vector to the light.
    pub fn evaluate(&self, point: &ShadingPoint, surface: &Surface, l: DVec3) -> DVec3 {
        match self.kind {
            BrdfKind::Lambert => lambert::f(surface),
            BrdfKind::Lafortune => lafortune::f(point, surface, l, self.lafortune, self.normalised),
            BrdfKind::Blinn => blinn::f(point, surface, l, self.normalised),
            BrdfKind::Phong => phong::f(point, surface, l, self.normalised),
            BrdfKind::Ward => ward::f(point, surface, l, self.normalised),
        }
    }
}
