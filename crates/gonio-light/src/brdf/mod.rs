//! The BRDFs of Appendix 6, `f` in 1/sr.

use crate::equation::{ShadingPoint, Surface};
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

/// A BRDF with what it needs besides the surface's `a = k_d`, `b = k_s` and `c = shininess`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrdfSettings {
    /// Which one.
    pub kind: BrdfKind,
    /// With the factor that keeps the lobe's albedo at most `b`.
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

    /// The specular lobe in 1/sr for `b = 1`, without the diffuse part; 0 below the horizon.
    pub fn lobe(&self, _point: &ShadingPoint, _surface: &Surface, _l: DVec3) -> f64 {
        0.0
    }
}
