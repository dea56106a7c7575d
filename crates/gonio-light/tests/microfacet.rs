//! The rough mirror: normalisation, its two integrals against plain quadrature, energy.

use gonio_light::DVec3;
use gonio_light::microfacet::{
    ALPHA_MIN, alpha, distribution, environment_brdf, hammersley, specular_integral, unshadowed_share, visibility,
    visible_facet,
};
use std::f64::consts::{FRAC_PI_2, PI};

const ROUGHNESSES: [f64; 4] = [0.3, 0.5, 0.75, 1.0];

/// Sums a function of the half vector (in the local frame) times the solid angle over the hemisphere, by the midpoint
/// rule; more points where the lobe is.
fn over_hemisphere(mut f: impl FnMut(DVec3) -> DVec3) -> DVec3 {
    const THETAS: u32 = 600;
    const PHIS: u32 = 240;
    let mut sum = DVec3::ZERO;
    for i in 0..THETAS {
        // theta = pi/2 x^2.
        let x = (f64::from(i) + 0.5) / f64::from(THETAS);
        let (sin, cos) = (FRAC_PI_2 * x * x).sin_cos();
        let d_theta = PI * x / f64::from(THETAS);
        for j in 0..PHIS {
            let (sin_phi, cos_phi) = (2.0 * PI * (f64::from(j) + 0.5) / f64::from(PHIS)).sin_cos();
            let h = DVec3::new(sin * cos_phi, sin * sin_phi, cos);
            sum += f(h) * sin * d_theta * 2.0 * PI / f64::from(PHIS);
        }
    }
    sum
}

/// The integral of `f L <N.L>` from the formulas as they stand: over half vectors, of which dL = 4 V.H dH.
fn by_quadrature(view: DVec3, f0: f64, roughness: f64, radiance: impl Fn(DVec3) -> DVec3) -> DVec3 {
    let a = alpha(roughness);
    over_hemisphere(|h| {
        let cos_vh = view.dot(h);
        let l = 2.0 * cos_vh * h - view;
        if cos_vh <= 0.0 || l.z <= 0.0 {
            return DVec3::ZERO;
        }
        let fresnel = f0 + (1.0 - f0) * (1.0 - cos_vh).powi(5);
        let f = distribution(h.z, a) * visibility(view.z, l.z, a) * fresnel;
        f * l.z * 4.0 * cos_vh * radiance(l)
    })
}

fn view(cos: f64) -> DVec3 {
    DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
}

#[test]
fn facets_cover_the_surface_once() {
    for roughness in ROUGHNESSES {
        let area = over_hemisphere(|h| DVec3::splat(distribution(h.z, alpha(roughness)) * h.z)).x;
        // The midpoint rule at the narrowest lobe.
        assert!((area - 1.0).abs() < 2e-4, "{roughness}: {area}");
        // Seen from anywhere, the facets turned to the view that are not masked look as large as the surface:
        // Walter et al. 2007, eq. (5). G_1(V) is G with the light overhead.
        for cos_v in [0.15, 0.6, 1.0] {
            let v = view(cos_v);
            let g1 = visibility(cos_v, 1.0, alpha(roughness)) * 4.0 * cos_v;
            let seen = over_hemisphere(|h| DVec3::splat(distribution(h.z, alpha(roughness)) * v.dot(h).max(0.0))).x;
            assert!((seen * g1 / cos_v - 1.0).abs() < 1e-3, "{roughness} {cos_v}: {seen} {g1}");
        }
    }
    assert_eq!((distribution(-0.1, 0.5), distribution(f64::NAN, 0.5)), (0.0, 0.0));
    let peak = distribution(1.0, 0.0);
    assert!((peak * PI * ALPHA_MIN * ALPHA_MIN - 1.0).abs() < 1e-9, "{peak}");
}

#[test]
fn light_and_view_may_be_exchanged() {
    for (cos_v, cos_l, a) in [(0.1, 0.9, 0.2), (0.5, 0.3, 0.7), (1e-3, 1.0, 1.0)] {
        assert!((visibility(cos_v, cos_l, a) / visibility(cos_l, cos_v, a) - 1.0).abs() < 1e-14);
    }
    assert_eq!((visibility(0.0, 0.5, 0.3), visibility(0.5, -0.1, 0.3)), (0.0, 0.0));
}

#[test]
fn the_share_is_a_quotient_of_the_visibilities() {
    for (cos_v, cos_l, a) in [(0.1, 0.9, 0.2), (0.5, 0.3, 0.7), (0.9, 0.01, 1.0)] {
        let g2 = visibility(cos_v, cos_l, a) * 4.0 * cos_v * cos_l;
        let g1 = visibility(cos_v, 1.0, a) * 4.0 * cos_v;
        assert!((unshadowed_share(cos_v, cos_l, a) - g2 / g1).abs() < 1e-14, "{cos_v} {cos_l} {a}");
    }
}

#[test]
fn facets_are_drawn_as_the_view_sees_them() {
    // Means over the samples are integrals over the density G_1 D V.H / N.V: of H, and of H.z squared.
    for roughness in [0.5, 1.0] {
        for cos_v in [0.2, 0.7, 1.0] {
            let (v, a) = (view(cos_v), alpha(roughness));
            let count = 4096;
            let mut mean = DVec3::ZERO;
            for i in 0..count {
                let (s, t) = hammersley(i, count);
                let h = visible_facet(v, a, s, t);
                assert!((h.length() - 1.0).abs() < 1e-12 && h.z >= 0.0 && v.dot(h) > -1e-9, "{h}");
                mean += DVec3::new(h.x, h.y.abs(), h.z * h.z) / f64::from(count);
            }
            let g1 = visibility(cos_v, 1.0, a) * 4.0 * cos_v;
            let wanted = over_hemisphere(|h| {
                DVec3::new(h.x, h.y.abs(), h.z * h.z) * (distribution(h.z, a) * v.dot(h).max(0.0) * g1 / cos_v)
            });
            // Hammersley's points at 4096, and the midpoint rule.
            assert!(mean.abs_diff_eq(wanted, 2e-3), "{roughness} {cos_v}: {mean} is not {wanted}");
        }
    }
}

#[test]
fn the_environment_brdf_is_its_integral() {
    for roughness in ROUGHNESSES {
        for cos_v in [0.05, 0.2, 0.5, 0.9, 1.0] {
            let white = by_quadrature(view(cos_v), 1.0, roughness, |_| DVec3::ONE).x;
            let bias_alone = by_quadrature(view(cos_v), 0.0, roughness, |_| DVec3::ONE).x;
            let (scale, bias) = environment_brdf(cos_v, roughness);
            // 6e-4 by its documentation; the rest is the midpoint rule's here, at the narrowest lobe seen at grazing.
            assert!((scale + bias - white).abs() < 1.5e-3, "{roughness} {cos_v}: {} is not {white}", scale + bias);
            assert!((bias - bias_alone).abs() < 1.5e-3, "{roughness} {cos_v}: {bias} is not {bias_alone}");
        }
    }
}

#[test]
fn no_light_is_made() {
    for i in 0..=20 {
        for j in 0..=20 {
            let (cos_v, roughness) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
            let (scale, bias) = environment_brdf(cos_v, roughness);
            assert!(scale >= 0.0 && bias >= 0.0 && scale + bias <= 1.0 + 1e-12, "{cos_v} {roughness}: {scale} {bias}");
        }
    }
    for cos_v in [0.1, 0.5, 1.0] {
        // A smooth mirror: Schlick's Fresnel, nothing lost.
        let (scale, bias) = environment_brdf(cos_v, 0.0);
        let fresnel = (1.0 - cos_v).powi(5);
        assert!((scale - (1.0 - fresnel)).abs() < 1e-9 && (bias - fresnel).abs() < 1e-9, "{cos_v}: {scale} {bias}");
        // The rougher, the more is lost between the facets.
        let white = |roughness| {
            let (s, b) = environment_brdf(cos_v, roughness);
            s + b
        };
        assert!(white(0.3) > white(0.6) && white(0.6) > white(1.0));
    }
    // At normal view and roughness 1 on paper: D = 1 / pi, so the share 2 cos_l / (1 + cos_l) over cosine-weighted facets,
    // cos_l = 2 h^2 - 1: integral of 2 h (2 h^2 - 1) / h^2 dh from sqrt(1/2) to 1 = 1 - ln 2.
    let (scale, bias) = environment_brdf(1.0, 1.0);
    assert!((scale + bias - (1.0 - 2.0_f64.ln())).abs() < 6e-4, "{}", scale + bias);
    assert!(environment_brdf(f64::NAN, f64::NAN).0.is_finite());
}

#[test]
fn the_reference_is_the_plain_integral() {
    let light =
        |d: DVec3| DVec3::new(1.0 + d.x, 1.0 + d.y * d.z, (3.0 * (d.dot(DVec3::new(0.6, 0.0, 0.8)) - 1.0)).exp());
    // The surface's frame is not the world's: turned about Y by 0.6, about X by 0.3.
    let turn = gonio_light::DQuat::from_rotation_y(0.6) * gonio_light::DQuat::from_rotation_x(0.3);
    for roughness in ROUGHNESSES {
        for cos_v in [0.15, 0.5, 1.0] {
            let v = view(cos_v);
            let wanted = by_quadrature(v, 0.04, roughness, light);
            let in_world = |d: DVec3| light(turn.inverse() * d);
            let got = specular_integral(turn * DVec3::Z, turn * v, DVec3::splat(0.04), roughness, in_world, 4096);
            // Points over the sphere, 4096 of them, against the midpoint rule; relative to what a white mirror returns
            // this is 1e-3.
            assert!(got.abs_diff_eq(wanted, 1e-3), "{roughness} {cos_v}: {got} is not {wanted}");
        }
    }
    // A smooth mirror sees one direction.
    let mirrored = specular_integral(DVec3::Y, DVec3::new(0.6, 0.8, 0.0), DVec3::ONE, 0.0, light, 16);
    assert!(mirrored.abs_diff_eq(light(DVec3::new(-0.6, 0.8, 0.0)), 1e-9), "{mirrored}");
    assert_eq!(specular_integral(DVec3::Y, -DVec3::Y, DVec3::ONE, 0.5, light, 16), DVec3::ZERO);
}
