//! Phong's lobe as a BRDF: a power of the cosine about the mirror direction.
//!
//! | parameter | is | range |
//! |---|---|---|
//! | `a` | [`Surface::diffuse`], linear RGB | `[0, 1]` |
//! | `b` | [`Surface::specular`], linear RGB | `[0, 1]` |
//! | `c` | [`Surface::shininess`], no unit | `[1, SHININESS_MAX]`, see [`effective_shininess`] |
//!
//! `f = a / pi + b <R.V>^c`, `R.V = 2 (N.L)(N.V) - L.V`; 0 lobe where `N.L <= 0` or `N.V <= 0`.
//!
//! *Normalised*: the lobe times `(c + 2) / (2 pi)`, the factor of the cosine-weighted form: the
//! lobe's albedo is then exactly 1 at normal view (the integral of `cos^(c+1)` over the hemisphere
//! is `2 pi / (c + 2)`) and smaller elsewhere, where part of the lobe falls below the horizon.
//!
//! *Source*: B. T. Phong, *Illumination for Computer Generated Pictures*, CACM 18(6), 1975: the term
//! `W(i) cos^n s`, which the paper adds *without* the factor `cos i`: it is not a BRDF. The reciprocal
//! form here and its factor: E. P. Lafortune and Y. D. Willems, *Using the Modified Phong
//! Reflectance Model for Physically Based Rendering*, report CW 197, K. U. Leuven, 1994.
//! *The seed's print* (Appendix 6) writes `cos^c (2<w_i|n><w_o|n> - <w_i|w_o>)`: its argument is a
//! cosine already, so the `cos` is to be read as "that cosine, to the power c"; and the clamp at 0
//! is missing.
//! *Limits*: dark at grazing views (the lobe is lost below the horizon); no Fresnel.

use super::{above_horizon, cosine_power, effective_shininess};
use crate::shading_point::ShadingPoint;
use crate::shading_point::Surface;
use crate::vector;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, TAU};

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
    let power = cosine_power(vector::reflection(n, l).dot(v), shininess);
    if normalised { power * normalisation(shininess) } else { power }
}

/// `(c + 2) / (2 pi)`, in 1/sr.
pub fn normalisation(shininess: f64) -> f64 {
    (effective_shininess(shininess) + 2.0) / TAU
}
