//! Blinn's lobe as a BRDF: a power of the cosine between normal and half vector.
//!
//! | parameter | is | range |
//! |---|---|---|
//! | `a` | [`Surface::diffuse`], linear RGB | `[0, 1]` |
//! | `b` | [`Surface::specular`], linear RGB | `[0, 1]` |
//! | `c` | [`Surface::shininess`], no unit | `[1, SHININESS_MAX]`, see [`effective_shininess`] |
//!
//! `f = a / pi + b <N.H>^c`; 0 lobe where `N.L <= 0` or `N.V <= 0`.
//!
//! *Normalised*: the lobe times `(c + 2)(c + 4) / (8 pi (2^(-c/2) + c))`. It is exact: at normal view
//! the half vector's angle is half of the light's, and the integral of `cos^c(t/2) cos t` over the
//! hemisphere is the inverse of that factor (substitute `u = cos(t/2)`), so the lobe's albedo is 1
//! there and smaller elsewhere. The well-known `(c + 8) / (8 pi)` is its approximation for large `c`.
//!
//! *Source*: J. F. Blinn, *Models of Light Reflection for Computer Synthesized Pictures*, SIGGRAPH
//! 1977: the distribution `D_1 = cos^c1 alpha`, without the paper's geometric and Fresnel factors.
//! The factor: F. Giesen, *Derivation of Phong and Blinn-Phong normalization factors*, 2009.
//! *The seed's print* (Appendix 6) writes `b cos^c b <w_i|w_o>`: the second `b` is a slip, and the
//! angle is the one between `N` and `H`, not the one between `w_i` and `w_o`.
//! *Limits*: about four times the exponent of Phong's for a highlight of the same size; no Fresnel.

use super::{above_horizon, cosine_power, effective_shininess};
use crate::shading_point::ShadingPoint;
use crate::shading_point::Surface;
use crate::vector;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, PI};

/// `f` in 1/sr, per channel; `l` is the unit vector to the light.
pub fn f(point: &ShadingPoint, surface: &Surface, l: DVec3, normalised: bool) -> DVec3 {
    surface.diffuse * FRAC_1_PI + surface.specular * lobe(point, l, surface.shininess, normalised)
}

/// The specular lobe in 1/sr for `b = 1`.
pub fn lobe(point: &ShadingPoint, l: DVec3, shininess: f64, normalised: bool) -> f64 {
    let (n, v) = (point.normal, point.view);
    if !above_horizon(n, v, l) {
        return 0.0;
    }
    let power = cosine_power(n.dot(vector::half_vector(l, v, n)), shininess);
    if normalised { power * normalisation(shininess) } else { power }
}

/// `(c + 2)(c + 4) / (8 pi (2^(-c/2) + c))`, in 1/sr.
pub fn normalisation(shininess: f64) -> f64 {
    let c = effective_shininess(shininess);
    (c + 2.0) * (c + 4.0) / (8.0 * PI * ((-0.5 * c).exp2() + c))
}
