//! A rough mirror of microfacets: GGX, and its integral over an environment.
//!
//! | parameter | is | range |
//! |---|---|---|
//! | `roughness` | perceptual roughness; [`alpha`] is its square | `[0, 1]`, others are held there |
//! | `f0` | reflectance at normal incidence, linear RGB | `[0, 1]` |
//! | `cos_v`, `cos_l`, `cos_h` | cosines between the normal and the view, the light, the half vector | `[0, 1]` |
//!
//! ```text
//! f = D(H) Vis(L, V) F(V.H)        Vis = G / (4 <N.L> <N.V>)
//! D   = alpha^2 / (pi (cos_h^2 (alpha^2 - 1) + 1)^2)
//! Vis = 1/2 / (cos_l sqrt(alpha^2 + (1 - alpha^2) cos_v^2) + cos_v sqrt(alpha^2 + (1 - alpha^2) cos_l^2))
//! F   = f0 + (1 - f0) (1 - V.H)^5
//! ```
//!
//! *Sources*: D: B. Walter et al., *Microfacet Models for Refraction through Rough Surfaces*, EGSR 2007, eq. (33) (T. S.
//! Trowbridge and K. P. Reitz had it in 1975). Vis: E. Heitz, *Understanding the Masking-Shadowing Function in
//! Microfacet-Based BRDFs*, JCGT 3(2), 2014, eq. (99), shadowing correlated with masking by height. F:
//! [`schlick`](crate::optics::schlick). `alpha = roughness^2`: B. Burley, *Physically-Based Shading at Disney*, 2012.
//! The split sum: B. Karis, *Real Shading in Unreal Engine 4*, SIGGRAPH 2013 course.
//! The exponent of a roughness: a Blinn-Phong lobe about as wide as the one of `alpha` has the exponent `2 / alpha^2 - 2`
//! (Walter et al. 2007, section 5.2).
//! *Limits*: light that bounces from facet to facet more than once is lost: at roughness 1 a white mirror returns about
//! half of it.

use crate::vector::tangent_frame;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, TAU};

/// Cosines of the view below this count as this: nothing is seen edge on, and every quotient below stays finite.
pub const COS_VIEW_MIN: f64 = 1e-6;

/// The smallest `alpha` of [`distribution`]: at 0 it would be infinite. The lobe is then 0.01 degrees wide.
pub const ALPHA_MIN: f64 = 1e-4;

/// `roughness^2`, with the roughness held in `[0, 1]`; NaN counts as 0.
pub fn alpha(roughness: f64) -> f64 {
    let held = if roughness > 0.0 { roughness.min(1.0) } else { 0.0 };
    held * held
}

/// `D` in 1/sr: how much area of microfacets faces `H`, per area of surface and solid angle. Its integral with `cos_h`
/// over the hemisphere is 1. 0 from below (`cos_h <= 0`).
pub fn distribution(cos_h: f64, alpha: f64) -> f64 {
    if cos_h > 0.0 {
        let (a2, cos2) = (alpha.max(ALPHA_MIN).powi(2), cos_h.min(1.0).powi(2));
        let spread = cos2 * a2 + (1.0 - cos2);
        a2 * FRAC_1_PI / (spread * spread)
    } else {
        0.0
    }
}

/// `Vis`, which is `G / (4 <N.L> <N.V>)`; 0 where either cosine is not positive.
pub fn visibility(cos_v: f64, cos_l: f64, alpha: f64) -> f64 {
    if cos_v > 0.0 && cos_l > 0.0 {
        0.5 / (cos_l * slope_root(cos_v, alpha) + cos_v * slope_root(cos_l, alpha))
    } else {
        0.0
    }
}

/// `sqrt(alpha^2 + (1 - alpha^2) cos^2)`.
fn slope_root(cos: f64, alpha: f64) -> f64 {
    let a2 = alpha * alpha;
    (a2 + (1.0 - a2) * cos * cos).sqrt()
}

/// The weight of a sample of [`visible_facet`]: the share of its light that is not shadowed, `G_2 / G_1(V)`, in `[0,
/// 1]`. `cos_v > 0`; 0 where `cos_l` is not positive.
pub fn unshadowed_share(cos_v: f64, cos_l: f64, alpha: f64) -> f64 {
    if cos_l > 0.0 {
        let (root_v, root_l) = (slope_root(cos_v, alpha), slope_root(cos_l, alpha));
        (root_v + cos_v) * cos_l / (root_v * cos_l + root_l * cos_v)
    } else {
        0.0
    }
}

/// The normal of a facet as the view sees them: of all facets that are turned to it, each as likely as it looks large.
///
/// All in the local frame, normal along z: `view` a unit vector with `z > 0`, `u` and `v` in `[0, 1)`. `v` and `1/2 -
/// v` (modulo 1) give mirror images about the plane of normal and view. Source: E. Heitz, *Sampling the GGX
/// Distribution of Visible Normals*, JCGT 7(4), 2018.
pub fn visible_facet(view: DVec3, alpha: f64, u: f64, v: f64) -> DVec3 {
    let stretched = DVec3::new(alpha * view.x, alpha * view.y, view.z).normalize();
    let across = stretched.x.hypot(stretched.y);
    let first = if across > 0.0 { DVec3::new(-stretched.y, stretched.x, 0.0) / across } else { DVec3::X };
    let second = stretched.cross(first);
    let (sin, cos) = (TAU * v).sin_cos();
    let (a, b) = (u.sqrt() * cos, u.sqrt() * sin);
    let share = 0.5 * (1.0 + stretched.z);
    let b = (1.0 - share) * (1.0 - a * a).max(0.0).sqrt() + share * b;
    let up = (1.0 - a * a - b * b).max(0.0).sqrt();
    let facet = a * first + b * second + up * stretched;
    DVec3::new(alpha * facet.x, alpha * facet.y, facet.z.max(0.0)).normalize_or(DVec3::Z)
}

/// Point `index` of `count` spread evenly over the unit square: (i + 1/2) / count, and the bits of i read backwards as
/// a fraction. Source: J. M. Hammersley 1960; T.-T. Wong, W.-S. Luk, P.-A. Heng, *Sampling with Hammersley and Halton
/// Points*, JGT 2(2), 1997.
pub fn hammersley(index: u32, count: u32) -> (f64, f64) {
    let fraction = f64::from(index.reverse_bits()) / (f64::from(u32::MAX) + 1.0);
    ((f64::from(index) + 0.5) / f64::from(count.max(1)), fraction)
}

/// The reflection of uniform light 1 by a rough mirror: `f0 scale + bias`. The second factor of the split sum.
///
/// ```text
/// scale = integral of D Vis <N.L> (1 - (1 - V.H)^5) dL       bias = integral of D Vis <N.L> (1 - V.H)^5 dL
/// ```
///
/// Each is in `[0, 1]`, and so is their sum. `cos_v` and `roughness` are held in `[0, 1]`, the first not below
/// [`COS_VIEW_MIN`]. By a product rule over the facets that the view sees; the error is below 0.0006
/// (against 4,700 times as many points).
pub fn environment_brdf(cos_v: f64, roughness: f64) -> (f64, f64) {
    // Over the radius and half of the circle of `visible_facet`; the other half is its mirror image.
    const RADII: u32 = 32;
    const ANGLES: u32 = 8;
    let alpha = alpha(roughness);
    let cos_v = if cos_v > COS_VIEW_MIN { cos_v.min(1.0) } else { COS_VIEW_MIN };
    let view = DVec3::new((1.0 - cos_v * cos_v).sqrt(), 0.0, cos_v);
    let (mut scale, mut bias) = (0.0, 0.0);
    for i in 0..RADII {
        // A facet's slope goes with sqrt(1 - u) at the disc's rim: steps of that root, of which du = 2 root droot,
        // leave a smooth function. Steps of u itself err ten times as much.
        let root = (f64::from(i) + 0.5) / f64::from(RADII);
        let (u, weight) = (1.0 - root * root, 2.0 * root / f64::from(RADII * ANGLES));
        for j in 0..ANGLES {
            let v = 0.25 + 0.5 * (f64::from(j) + 0.5) / f64::from(ANGLES);
            let h = visible_facet(view, alpha, u, v);
            let cos_vh = view.dot(h).clamp(0.0, 1.0);
            let cos_l = 2.0 * cos_vh * h.z - view.z;
            let share = weight * unshadowed_share(cos_v, cos_l, alpha);
            let fresnel = (1.0 - cos_vh).powi(5);
            scale += share * (1.0 - fresnel);
            bias += share * fresnel;
        }
    }
    (scale, bias)
}

/// The light that a rough mirror sends to the view, linear RGB: the integral of `f L <N.L>` over the hemisphere, the
/// reference for all approximations.
///
/// `n` and `v` are unit vectors in the world, `v` to the eye; seen from below (`n.v <= 0`) it is 0. `radiance` is that
/// from a unit direction in the world. `samples` facets (0 counts as 1) that the view sees are evaluated; the error
/// falls almost as `1 / samples` where the light is smooth.
pub fn specular_integral(
    n: DVec3,
    v: DVec3,
    f0: DVec3,
    roughness: f64,
    radiance: impl Fn(DVec3) -> DVec3,
    samples: u32,
) -> DVec3 {
    let cos_v = n.dot(v);
    if cos_v.is_nan() || cos_v <= 0.0 {
        return DVec3::ZERO;
    }
    let (alpha, samples) = (alpha(roughness), samples.max(1));
    let (t, b) = tangent_frame(n, DVec3::ZERO);
    let cos_v = cos_v.clamp(COS_VIEW_MIN, 1.0);
    let across = DVec3::new(t.dot(v), b.dot(v), 0.0).normalize_or_zero() * (1.0 - cos_v * cos_v).sqrt();
    let view = DVec3::new(across.x, across.y, cos_v);
    let mut sum = DVec3::ZERO;
    for index in 0..samples {
        let (a, c) = hammersley(index, samples);
        let h = visible_facet(view, alpha, a, c);
        let cos_vh = view.dot(h).clamp(0.0, 1.0);
        let l = 2.0 * cos_vh * h - view;
        let share = unshadowed_share(cos_v, l.z, alpha);
        if share > 0.0 {
            let fresnel = f0 + (DVec3::ONE - f0) * (1.0 - cos_vh).powi(5);
            sum += share * fresnel * radiance((l.x * t + l.y * b + l.z * n).normalize());
        }
    }
    sum / f64::from(samples)
}

/// No roughness gives a larger exponent: a lobe of it is a degree wide, and a mirror's would never be seen.
pub const SHININESS_OF_ROUGHNESS_MAX: f64 = 10_000.0;

/// The exponent of a roughness in [0, 1] (beyond: as at the edge), from 1 to [`SHININESS_OF_ROUGHNESS_MAX`].
pub fn shininess_of_roughness(roughness: f64) -> f64 {
    let alpha = roughness * roughness;
    (2.0 / (alpha * alpha).max(1e-12) - 2.0).clamp(1.0, SHININESS_OF_ROUGHNESS_MAX)
}

/// The roughness of an exponent, in (0, 1]: the inverse, where there is one.
pub fn roughness_of_shininess(shininess: f64) -> f64 {
    (2.0 / (shininess.max(0.0) + 2.0)).powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_and_back() {
        // alpha 0.25: 2 / 0.0625 - 2.
        assert_eq!(shininess_of_roughness(0.5), 30.0);
        assert_eq!((shininess_of_roughness(0.0), shininess_of_roughness(1.0)), (SHININESS_OF_ROUGHNESS_MAX, 1.0));
        for shininess in [1.0, 2.0, 32.0, 500.0, 9_999.0] {
            let back = shininess_of_roughness(roughness_of_shininess(shininess));
            // Two powers in f64.
            assert!((back / shininess - 1.0).abs() < 1e-12, "{shininess}: {back}");
        }
    }
}
