//! Lambert's BRDF: the same radiance in every direction.
//!
//! | parameter | is | range |
//! |---|---|---|
//! | `a` | [`Surface::diffuse`], the albedo, linear RGB | `[0, 1]` for a passive surface |
//!
//! `f = a / pi`.
//!
//! *Source*: J. H. Lambert, *Photometria* (1760), the cosine law; the factor `1/pi` because the
//! integral of the cosine over the hemisphere is `pi`. *The seed's print* (Appendix 6) is the same.
//! *Normalised variant*: already normalised: its albedo is `a` from every view direction.
//! *Limits*: no highlight; no dependence on the view.

use crate::shading_point::Surface;
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

/// `f = a / pi` in 1/sr, per channel.
pub fn f(surface: &Surface) -> DVec3 {
    surface.diffuse * FRAC_1_PI
}

/// The specular lobe: there is none, so 0.
pub fn lobe() -> f64 {
    0.0
}
