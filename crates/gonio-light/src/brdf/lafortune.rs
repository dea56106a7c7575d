//! Lafortune's generalised cosine lobe: Phong's, about a direction that a matrix makes from the other.
//!
//! | parameter | is | range |
//! |---|---|---|
//! | `a` | [`Surface::diffuse`], linear RGB | `[0, 1]` |
//! | `b` | [`Surface::specular`], linear RGB | `[0, 1]` |
//! | `k` | [`Surface::shininess`], no unit | `[1, SHININESS_MAX]`, see [`effective_shininess`] |
//! | `A` | [`BrdfSettings::lafortune`](super::BrdfSettings::lafortune): a diagonal, in the local frame (tangent, bitangent, normal) | any; `diag(1, 1, -1)` is Phong's lobe |
//!
//! `f = a / pi + b <-w_i^T A w_o>^k`; 0 lobe where `N.L <= 0` or `N.V <= 0`. In the paper's letters
//! `C = -A`: `C_x = C_y = -1, C_z = 1` mirrors, `C_x = C_y = C_z = 1` reflects back to where the light
//! came from, `|C_z| < |C_x|` leans off the mirror direction, `C_x != C_y` is anisotropic.
//!
//! *Normalised*: `A` is divided by its largest magnitude `m` (so it gives only the lobe's shape) and
//! the lobe is multiplied by `(k + 2) / (2 pi)`. `-A w_o / m` is never longer than 1, and a cosine
//! power about any direction holds at most what it holds about the normal, `2 pi / (k + 2)`; so the
//! lobe's albedo is at most 1 from every view. For `diag(1, 1, -1)` it is Phong's factor exactly.
//!
//! *Source*: E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg, *Non-Linear Approximation
//! of Reflectance Functions*, SIGGRAPH 1997, section 4: `f = rho_s [C_x u_x v_x + C_y u_y v_y +
//! C_z u_z v_z]^n`, its general form `[u^T M v]^n`, and the normalisation `(n + 2) / (2 pi)` of the
//! cosine lobe that it starts from.
//! *The seed's print* (Appendix 6, headed "Lafourture") has the matrix with a minus sign in front:
//! its `A` is the paper's `-M`. The clamp at 0 is missing.
//! *Limits*: one lobe; where `m > 1` the lobe without normalisation grows like `m^k`: it is held at
//! [`LOBE_CAP`]. A matrix that is 0 (`m` below [`vector::DEGENERATE_LENGTH`]) has no lobe when
//! normalised.

use super::{LOBE_CAP, above_horizon, cosine_power, effective_shininess, phong};
use crate::shading_point::ShadingPoint;
use crate::shading_point::Surface;
use crate::vector;
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

/// `f` in 1/sr, per channel; `l` is the unit vector to the light, `diagonal` that of `A`.
pub fn f(point: &ShadingPoint, surface: &Surface, l: DVec3, diagonal: DVec3, normalised: bool) -> DVec3 {
    surface.diffuse * FRAC_1_PI + surface.specular * lobe(point, l, diagonal, surface.shininess, normalised)
}

/// The specular lobe in 1/sr for `b = 1`.
pub fn lobe(point: &ShadingPoint, l: DVec3, diagonal: DVec3, shininess: f64, normalised: bool) -> f64 {
    let (n, v) = (point.normal, point.view);
    if !above_horizon(n, v, l) {
        return 0.0;
    }
    let (t, b) = vector::tangent_frame(n, point.tangent);
    let local_l = DVec3::new(t.dot(l), b.dot(l), n.dot(l));
    let local_v = DVec3::new(t.dot(v), b.dot(v), n.dot(v));
    if normalised {
        let largest = diagonal.abs().max_element();
        if largest < vector::DEGENERATE_LENGTH {
            return 0.0;
        }
        let shape = diagonal / largest;
        cosine_power(-local_l.dot(shape * local_v), shininess) * phong::normalisation(shininess)
    } else {
        let base = -local_l.dot(diagonal * local_v);
        // Infinities of opposite sign make NaN, which is not greater than 0 and so has no lobe.
        if base > 0.0 { base.powf(effective_shininess(shininess)).min(LOBE_CAP) } else { 0.0 }
    }
}
