//! BRDFs: values at known angles, reciprocity, energy, and the distributions of microfacets.

mod support;

use gonio_light::brdf::{BrdfKind, BrdfSettings, LOBE_CAP, SHININESS_MAX, blinn, effective_shininess, phong, ward};
use gonio_light::microfacet::{
    ALPHA_MIN, alpha, distribution, environment_brdf, hammersley, specular_integral, unshadowed_share, visibility,
    visible_facet,
};
use gonio_light::{DVec3, ShadingPoint};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};
use support::{Sequence, assert_close, direction, surface, upright};

const SHININESSES: [f64; 5] = [1.0, 2.0, 8.0, 32.0, 128.0];

/// All BRDFs with a lobe, Lafortune's also off-specular, retro-reflecting, anisotropic and too large.
fn with_lobes(normalised: bool) -> Vec<BrdfSettings> {
    let new = |kind, lafortune| BrdfSettings { kind, normalised, lafortune };
    let mirror = DVec3::new(1.0, 1.0, -1.0);
    let lafortune = [mirror, DVec3::new(1.0, 1.0, -0.6), -DVec3::ONE, DVec3::new(0.9, 0.4, -0.8), mirror * 3.0];
    [BrdfKind::Phong, BrdfKind::Blinn, BrdfKind::Ward]
        .map(|kind| new(kind, mirror))
        .into_iter()
        .chain(lafortune.map(|diagonal| new(BrdfKind::Lafortune, diagonal)))
        .collect()
}

/// The integral of `lobe cos` over the light's hemisphere, by the midpoint rule. The view is in the
/// plane of normal and tangent, so all lobes are symmetric in `phi` and half of it is enough.
fn albedo(brdf: &BrdfSettings, shininess: f64, view_theta: f64) -> f64 {
    const THETAS: u32 = 400;
    const PHIS: u32 = 200;
    let (point, surface) = (upright(direction(view_theta, 0.0)), surface(shininess));
    let (d_theta, d_phi) = (FRAC_PI_2 / f64::from(THETAS), PI / f64::from(PHIS));
    let mut sum = 0.0;
    for i in 0..THETAS {
        let theta = (f64::from(i) + 0.5) * d_theta;
        let ring: f64 =
            (0..PHIS).map(|j| brdf.lobe(&point, &surface, direction(theta, (f64::from(j) + 0.5) * d_phi))).sum();
        sum += ring * theta.cos() * theta.sin();
    }
    2.0 * sum * d_theta * d_phi
}

#[test]
fn lambert_is_a_over_pi_everywhere_and_reflects_a() {
    let brdf = BrdfSettings::new(BrdfKind::Lambert);
    let point = upright(direction(0.3, 1.0));
    for theta in [0.0, 0.5, 1.5] {
        let l = direction(theta, 0.2);
        assert_eq!(brdf.lobe(&point, &surface(8.0), l), 0.0);
        assert_close(brdf.evaluate(&point, &surface(8.0), l).x, 0.5 / PI, 1e-15);
    }
}

#[test]
fn values_in_the_mirror_direction() {
    for c in SHININESSES {
        for theta in [0.0, 0.4, 1.2] {
            let point = upright(direction(theta, 0.0));
            let mirror = direction(theta, PI);
            let lobe = |kind, normalised| {
                BrdfSettings { normalised, ..BrdfSettings::new(kind) }.lobe(&point, &surface(c), mirror)
            };
            for kind in [BrdfKind::Phong, BrdfKind::Blinn, BrdfKind::Lafortune] {
                assert_close(lobe(kind, false), 1.0, 1e-12);
            }
            assert_close(lobe(BrdfKind::Phong, true), (c + 2.0) / (2.0 * PI), 1e-12);
            assert_close(lobe(BrdfKind::Lafortune, true), (c + 2.0) / (2.0 * PI), 1e-12);
            let blinn = (c + 2.0) * (c + 4.0) / (8.0 * PI * (2f64.powf(-c / 2.0) + c));
            assert_close(lobe(BrdfKind::Blinn, true), blinn, 1e-12);
            // delta = 0: 1 / (4 pi c^2 cos), and 1 / (4 pi c^2 cos^2) for the bounded form.
            let c2 = 2.0 / (c + 2.0);
            assert_close(lobe(BrdfKind::Ward, false), 1.0 / (4.0 * PI * c2 * theta.cos()), 1e-12);
            assert_close(lobe(BrdfKind::Ward, true), 1.0 / (4.0 * PI * c2 * theta.cos().powi(2)), 1e-12);
        }
    }
}

#[test]
fn values_off_the_mirror_direction() {
    // View along the normal, light at 60 degrees: R.V = 1/2, N.H = cos 30, tan(delta) = 1/sqrt(3).
    let point = upright(DVec3::Z);
    let l = direction(PI / 3.0, 0.4);
    let lobe = |kind, normalised| BrdfSettings { normalised, ..BrdfSettings::new(kind) }.lobe(&point, &surface(4.0), l);
    assert_close(lobe(BrdfKind::Phong, false), 1.0 / 16.0, 1e-14);
    assert_close(lobe(BrdfKind::Lafortune, false), 1.0 / 16.0, 1e-14);
    assert_close(lobe(BrdfKind::Blinn, false), 9.0 / 16.0, 1e-14);
    // c^2 = 1/3, so the exponent is -1.
    let e = (-1f64).exp();
    assert_close(lobe(BrdfKind::Ward, false), 3.0 * e / (4.0 * PI * 0.5f64.sqrt()), 1e-14);
    // |L+V|^2 = 3, N.(L+V) = 3/2.
    assert_close(lobe(BrdfKind::Ward, true), 3.0 * e / PI * 3.0 / 1.5f64.powi(4), 1e-14);
}

#[test]
fn evaluate_is_a_over_pi_plus_b_times_the_lobe() {
    let mut sequence = Sequence::new(3);
    for brdf in with_lobes(false).into_iter().chain(with_lobes(true)) {
        for _ in 0..50 {
            let (point, l) = (upright(sequence.above()), sequence.above());
            let surface = surface(sequence.within(1.0, 200.0));
            let expected = 0.5 * FRAC_1_PI + 0.25 * brdf.lobe(&point, &surface, l);
            assert_close(brdf.evaluate(&point, &surface, l).y, expected, 1e-14);
        }
    }
}

#[test]
fn reciprocity() {
    let mut sequence = Sequence::new(4);
    for brdf in with_lobes(false).into_iter().chain(with_lobes(true)) {
        let mut lit = 0;
        for _ in 0..500 {
            // A tilted, twisted frame: reciprocity must not depend on the axes.
            let normal = sequence.direction();
            let tangent = sequence.direction();
            let v = (normal + 0.99 * sequence.direction()).normalize();
            let l = (normal + 0.99 * sequence.direction()).normalize();
            let surface = surface(sequence.pick(&SHININESSES));
            let from =
                |view, l| brdf.evaluate(&ShadingPoint { position: DVec3::ZERO, normal, view, tangent }, &surface, l).x;
            // Rounding, amplified by the exponent (128).
            assert_close(from(v, l), from(l, v), 1e-11);
            lit += i32::from(from(v, l) > 0.5 * FRAC_1_PI);
        }
        assert!(lit > 100, "{brdf:?}: a lobe that is 0 is reciprocal too, and shows nothing");
    }
}

#[test]
fn a_normalised_lobe_never_reflects_more_than_it_receives() {
    for brdf in with_lobes(true) {
        for shininess in SHININESSES {
            for degrees in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0] {
                let albedo = albedo(&brdf, shininess, f64::to_radians(degrees));
                // 1e-3 is the quadrature's (0.225 degrees against a lobe of 6).
                assert!(albedo <= 1.0 + 1e-3, "{brdf:?} {shininess}, {degrees} degrees: {albedo}");
                assert!(albedo > 0.0);
            }
        }
    }
}

#[test]
fn at_normal_view_the_exact_normalisations_reflect_everything() {
    for kind in [BrdfKind::Phong, BrdfKind::Blinn, BrdfKind::Lafortune] {
        let brdf = BrdfSettings { normalised: true, ..BrdfSettings::new(kind) };
        for shininess in SHININESSES {
            // 2e-4 is the midpoint rule's, at the sharpest lobe.
            assert_close(albedo(&brdf, shininess, 0.0), 1.0, 2e-4);
        }
    }
    // Ward's own form is nearly normalised where it is sharp and the view is steep, by the paper.
    let ward = BrdfSettings::new(BrdfKind::Ward);
    assert_close(albedo(&ward, 128.0, 0.0), 1.0, 0.05);
    // Without the factor, Phong's lobe is far from it: the test distinguishes them.
    assert!(albedo(&BrdfSettings::new(BrdfKind::Phong), 32.0, 0.0) < 0.2);
}

#[test]
fn blinns_factor_is_the_inverse_of_the_integral_at_normal_view() {
    let brdf = BrdfSettings::new(BrdfKind::Blinn);
    for c in SHININESSES {
        assert_close(albedo(&brdf, c, 0.0) * blinn::normalisation(c), 1.0, 2e-4);
        assert_close(albedo(&BrdfSettings::new(BrdfKind::Phong), c, 0.0) * phong::normalisation(c), 1.0, 2e-4);
    }
    assert_close(blinn::normalisation(1e4) / ((1e4 + 8.0) / (8.0 * PI)), 1.0, 1e-3);
}

#[test]
fn lafortune_with_the_mirror_matrix_is_phong() {
    let mut sequence = Sequence::new(5);
    for normalised in [false, true] {
        for _ in 0..500 {
            let normal = sequence.direction();
            let tangent = sequence.direction();
            let point = ShadingPoint { position: DVec3::ZERO, normal, view: sequence.direction(), tangent };
            let (surface, l) = (surface(sequence.within(1.0, 100.0)), sequence.direction());
            let lobe = |kind| BrdfSettings { normalised, ..BrdfSettings::new(kind) }.lobe(&point, &surface, l);
            assert_close(lobe(BrdfKind::Lafortune), lobe(BrdfKind::Phong), 1e-11);
        }
    }
}

#[test]
fn lafortune_reflects_back_and_follows_the_tangent() {
    let retro = BrdfSettings { lafortune: -DVec3::ONE, ..BrdfSettings::new(BrdfKind::Lafortune) };
    let v = direction(1.0, 0.3);
    assert_close(retro.lobe(&upright(v), &surface(32.0), v), 1.0, 1e-12);
    assert!(retro.lobe(&upright(v), &surface(32.0), direction(1.0, 0.3 + PI)) < 0.01);

    let brushed = BrdfSettings { lafortune: DVec3::new(1.0, 0.2, -1.0), ..BrdfSettings::new(BrdfKind::Lafortune) };
    let along_x = upright(direction(0.8, 0.0));
    let along_y = ShadingPoint { tangent: DVec3::Y, ..along_x };
    let l = direction(0.8, PI);
    assert!(brushed.lobe(&along_x, &surface(8.0), l) > 2.0 * brushed.lobe(&along_y, &surface(8.0), l));
    // A tangent that leans out of the surface counts by its part across the normal.
    let leaning = ShadingPoint { tangent: DVec3::new(3.0, 0.0, 2.0), ..along_x };
    assert_eq!(brushed.lobe(&leaning, &surface(8.0), l), brushed.lobe(&along_x, &surface(8.0), l));
}

#[test]
fn a_lobe_is_dark_below_the_horizon() {
    for brdf in with_lobes(false).into_iter().chain(with_lobes(true)) {
        let (above, below) = (direction(0.5, 0.1), direction(2.0, 3.0));
        let grazing = DVec3::X;
        for (v, l) in [(above, below), (below, above), (below, below), (above, grazing), (grazing, above)] {
            assert_eq!(brdf.lobe(&upright(v), &surface(2.0), l), 0.0, "{brdf:?}");
        }
        assert!(brdf.lobe(&upright(above), &surface(1.0), direction(0.2, 2.0)) > 0.0, "{brdf:?}");
    }
}

#[test]
fn lobes_are_finite_for_every_input() {
    let diagonals = [0.0, 1e-13, -1e-320, 1.0, -1.0, 1e150, -1e300, f64::MAX];
    let shininesses = [f64::MIN, 0.0, 0.5, 1.0, 1e5, 1e6, 1e300, f64::NAN, f64::INFINITY];
    let cosines = [0.0, 1e-320, 1e-160, 1e-20, 1e-7, 0.5, 1.0];
    let at = |cos: f64, phi: f64| direction(FRAC_PI_2, phi).with_z(0.0) * (1.0 - cos * cos).sqrt() + DVec3::Z * cos;
    let mut largest: f64 = 0.0;
    for kind in BrdfKind::ALL.iter().copied() {
        for normalised in [false, true] {
            for (i, &x) in diagonals.iter().enumerate() {
                let lafortune = DVec3::new(x, diagonals[(i + 3) % diagonals.len()], -x);
                let brdf = BrdfSettings { kind, normalised, lafortune };
                for shininess in shininesses {
                    for cos_l in cosines {
                        for cos_v in cosines {
                            for phi in [0.0, 1.0, PI] {
                                let lobe = brdf.lobe(&upright(at(cos_v, 0.0)), &surface(shininess), at(cos_l, phi));
                                let context = format!("{brdf:?} {shininess} {cos_l} {cos_v} {phi}");
                                assert!((0.0..=LOBE_CAP).contains(&lobe), "{context}: {lobe}");
                                largest = largest.max(lobe);
                            }
                        }
                    }
                }
            }
        }
    }
    assert_eq!(largest, LOBE_CAP, "the cap was not reached, so it was not tested");
}

#[test]
fn shininess_is_held_in_its_range() {
    assert_eq!([-3.0, 0.0, 1.0, 7.5, 1e9, f64::NAN].map(effective_shininess), [1.0, 1.0, 1.0, 7.5, SHININESS_MAX, 1.0]);
    assert_close(ward::roughness(0.0), (2f64 / 3.0).sqrt(), 1e-15);
    assert_close(ward::roughness(198.0), 0.1, 1e-15);
}

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

/// The integral of `f L <N.L>` directly from the formulas: over half vectors, of which dL = 4 V.H dH.
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
            let integral = over_hemisphere(|h| {
                DVec3::new(h.x, h.y.abs(), h.z * h.z) * (distribution(h.z, a) * v.dot(h).max(0.0) * g1 / cos_v)
            });
            // Hammersley's points at 4096, and the midpoint rule.
            assert!(mean.abs_diff_eq(integral, 2e-3), "{roughness} {cos_v}: {mean} is not {integral}");
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
fn no_light_is_created() {
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
            let integral = by_quadrature(v, 0.04, roughness, light);
            let in_world = |d: DVec3| light(turn.inverse() * d);
            let got = specular_integral(turn * DVec3::Z, turn * v, DVec3::splat(0.04), roughness, in_world, 4096);
            // Points over the sphere, 4096 of them, against the midpoint rule; relative to what a white mirror returns
            // this is 1e-3.
            assert!(got.abs_diff_eq(integral, 1e-3), "{roughness} {cos_v}: {got} is not {integral}");
        }
    }
    // A smooth mirror sees one direction.
    let mirrored = specular_integral(DVec3::Y, DVec3::new(0.6, 0.8, 0.0), DVec3::ONE, 0.0, light, 16);
    assert!(mirrored.abs_diff_eq(light(DVec3::new(-0.6, 0.8, 0.0)), 1e-9), "{mirrored}");
    assert_eq!(specular_integral(DVec3::Y, -DVec3::Y, DVec3::ONE, 0.5, light, 16), DVec3::ZERO);
}
