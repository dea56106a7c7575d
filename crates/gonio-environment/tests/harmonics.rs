//! Irradiance by nine harmonics, compared with the integral that it approximates.

use glam::DVec3;
use gonio_environment::cubemap::{solid_angle, texel_direction};
use gonio_environment::{Cubemap, Face, Harmonics};
use std::f64::consts::PI;

/// The integral of radiance times cosine over all texels, for a unit normal.
fn brute_force(map: &Cubemap, normal: DVec3) -> DVec3 {
    let size = map.size();
    let mut sum = DVec3::ZERO;
    for face in Face::ALL {
        for y in 0..size {
            for x in 0..size {
                let cosine = texel_direction(face, x, y, size).normalize().dot(normal).max(0.0);
                let [r, g, b, _] = map.at(face, x, y);
                sum += cosine * solid_angle(x, y, size) * DVec3::new(r.into(), g.into(), b.into());
            }
        }
    }
    sum
}

/// Directions all over the sphere, none of them on an axis (a spiral, R. Swinbank and R. J. Purser 2006).
fn normals(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let y = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let (sin, cos) = (i as f64 * PI * (3.0 - 5.0_f64.sqrt())).sin_cos();
        let across = (1.0 - y * y).sqrt();
        DVec3::new(across * cos, y, across * sin)
    })
}

/// The largest error over many normals, relative to the largest irradiance.
fn worst_error(map: &Cubemap) -> f64 {
    let harmonics = Harmonics::from_cubemap(map);
    let (mut worst, mut largest): (f64, f64) = (0.0, 0.0);
    for n in normals(60) {
        let expected = brute_force(map, n);
        worst = worst.max((harmonics.irradiance(n) - expected).abs().max_element());
        largest = largest.max(expected.max_element());
    }
    assert!(largest > 0.0);
    worst / largest
}

#[test]
fn a_uniform_environment_gives_pi() {
    for size in [1, 3, 16] {
        let harmonics = Harmonics::from_cubemap(&Cubemap::new(size, [1.0, 0.5, 2.0, 1.0]));
        for n in normals(20) {
            let got = harmonics.irradiance(n);
            // Symmetry makes it exact up to rounding, however coarse.
            assert!(got.abs_diff_eq(PI * DVec3::new(1.0, 0.5, 2.0), 1e-12), "{size}: {got}");
        }
    }
}

#[test]
fn single_lobes_are_scaled_by_the_cosine_lobe() {
    // Radiance a + b x (and y, z): irradiance pi a + (2 pi / 3) b x, on paper.
    let map = Cubemap::from_function(64, |d| DVec3::ONE + 0.5 * d);
    let harmonics = Harmonics::from_cubemap(&map);
    // In the documented order: 1, y, z, x.
    let slope = PI / 3.0;
    let expected = [PI * DVec3::ONE, slope * DVec3::Y, slope * DVec3::Z, slope * DVec3::X];
    for (got, expected) in harmonics.polynomial().into_iter().zip(expected) {
        assert!(got.abs_diff_eq(expected, 1e-3), "{got} is not {expected}");
    }
    // Of second degree: x y keeps pi / 4.
    let second = Harmonics::from_cubemap(&Cubemap::from_function(64, |d| {
        DVec3::new(1.0 + d.x * d.y, 1.0 + d.y * d.z, 1.0 + (3.0 * d.z * d.z - 1.0))
    }));
    for n in normals(20) {
        let expected = PI * DVec3::ONE + 2.0 * PI / 3.0 * 0.5 * n;
        let got = harmonics.irradiance(n);
        // A texel's middle stands for the texel: 64 texels an edge leave 1e-3 of it.
        assert!(got.abs_diff_eq(expected, 1e-3), "{n}: {got} is not {expected}");
        let expected = PI * DVec3::ONE + PI / 4.0 * DVec3::new(n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0);
        let got = second.irradiance(n);
        assert!(got.abs_diff_eq(expected, 1e-3), "{n}: {got} is not {expected}");
    }
}

#[test]
fn light_of_low_frequency_is_exact() {
    let map = Cubemap::from_function(48, |d| {
        DVec3::new(2.0 + d.x - 0.5 * d.y * d.z, 1.0 + d.z * d.z, 3.0 + d.x * d.y - d.x * d.x)
    });
    // Both integrals take a texel's middle for the texel.
    let error = worst_error(&map);
    assert!(error < 5e-4, "{error}");
    let harmonics = Harmonics::from_cubemap(&map);
    for d in normals(20) {
        let expected = DVec3::new(2.0 + d.x - 0.5 * d.y * d.z, 1.0 + d.z * d.z, 3.0 + d.x * d.y - d.x * d.x);
        assert!(harmonics.radiance(d).abs_diff_eq(expected, 2e-3), "{d}");
    }
}

#[test]
fn smooth_environments_are_within_a_few_per_cent() {
    // A sky over dark hills (a horizon at y = 0 would be an odd function, and exact), with a soft edge, three soft
    // lamps, and a bright window.
    let smooth_step = |x: f64| 1.0 / (1.0 + (-x).exp());
    let sky = |d: DVec3| DVec3::new(0.3, 0.5, 1.0) * smooth_step(12.0 * d.y - 4.0) + DVec3::splat(0.1);
    let lamps = |d: DVec3| {
        let lamp = |towards: DVec3| (8.0 * (d.dot(towards.normalize()) - 1.0)).exp();
        DVec3::new(lamp(DVec3::new(1.0, 0.4, 0.2)), lamp(DVec3::new(-0.3, 1.0, 0.6)), lamp(DVec3::new(0.1, -0.7, -1.0)))
    };
    let window = |d: DVec3| DVec3::splat(if d.x > 0.7 && d.y.abs() < 0.5 { 5.0 } else { 0.3 });
    for (name, error) in [
        ("sky", worst_error(&Cubemap::from_function(32, sky))),
        ("lamps", worst_error(&Cubemap::from_function(32, lamps))),
        ("window", worst_error(&Cubemap::from_function(32, window))),
    ] {
        // The paper's bound for any light is 9 % (of the largest irradiance, section 3), a few per cent for natural
        // light.
        assert!(error < 0.05, "{name}: {error}");
        // They do have higher frequencies, or the comparison would prove nothing.
        assert!(error > 1e-3, "{name}: {error}");
    }
    // The worst light: one direction. Harmonics turn <cos> into 1/4 + cos/2 + 5 (3 cos^2 - 1) / 32: 6.25 % too bright
    // from behind and as much too dark from the front.
    let towards = DVec3::new(0.3, 0.8, -0.5).normalize();
    let error =
        worst_error(&Cubemap::from_function(64, |d| DVec3::splat(if d.dot(towards) > 0.995 { 1.0 } else { 0.0 })));
    assert!((0.04..0.09).contains(&error), "{error}");
}
