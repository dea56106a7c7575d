//! Pictures whose values are known on paper.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, irradiance_below_square, matte, point, sphere, square};
use glam::{DMat4, DVec3};
use gonio_light::{Fresnel, Optics};
use gonio_mesh::{Material, MetallicRoughness};
use gonio_trace::{Simplifications, Technique, TraceSettings};
use std::f64::consts::PI;

/// The mean is `expected` within four standard errors and `tolerance`, in every channel.
fn assert_mean(name: &str, scene: &TestScene, settings: &TraceSettings, samples: u32, expected: f64, tolerance: f64) {
    let (mean, error) = scene.mean(settings, samples);
    let difference = (mean - expected).abs().max_element();
    assert!(difference <= 4.0 * error + tolerance, "{name}: {mean} instead of {expected}, standard error {error:.2e}");
    // A test that noise hides tells nothing.
    assert!(error < 0.02 * expected.max(0.05), "{name}: standard error {error:.2e} of {expected}");
}

fn furnace(material: Material, optics: Optics) -> TestScene {
    let mut scene = TestScene::new().placed(sphere(64), material, optics, DMat4::IDENTITY).environment(|_| DVec3::ONE);
    scene.frame.camera.fov_y_rad = 20f64.to_radians();
    scene
}

/// Everything that reflects all light is invisible in light that is 1 everywhere.
#[test]
fn white_furnace() {
    let mirror = Optics { reflectivity: 1.0, ..Optics::default() };
    let lacquer = Optics { reflectivity: 1.0, fresnel: Fresnel::Exact, ..Optics::default() };
    let glass = Optics { transmission: 1.0, fresnel: Fresnel::Exact, ..Optics::default() };
    for settings in [RGB, TraceSettings { simplified: Simplifications::NONE, ..RGB }] {
        for (name, scene) in [
            ("matte", furnace(matte(1.0), Optics::default())),
            ("mirror", furnace(matte(0.5), mirror)),
            ("lacquer", furnace(matte(1.0), lacquer)),
            ("glass", furnace(Material { refraction_index: 1.5, ..matte(0.5) }, glass)),
            ("diamond", furnace(Material { refraction_index: 2.4, ..matte(0.5) }, glass)),
            ("half opaque", furnace(Material { opacity: 0.5, ..matte(1.0) }, Optics::default())),
        ] {
            // 0.002: directions below the triangle but above the interpolated normal are lost, and interreflections of
            // glass end at some depth.
            assert_mean(&format!("{name}, {:?}", settings.simplified), &scene, &settings, 64, 1.0, 2e-3);
        }
    }
}

/// A lobe never returns more than it receives; a narrow one at normal incidence returns all of it.
#[test]
fn glossy_furnace() {
    let glossy = |shininess: f32| Material { specular: [1.0; 3], shininess, ..matte(0.0) };
    let metal = |roughness: f32| Material {
        specular: [1.0; 3],
        metallic_roughness: Some(MetallicRoughness {
            base_color: [1.0; 3],
            metallic: 1.0,
            roughness,
            metallic_map: None,
            roughness_map: None,
        }),
        ..matte(0.0)
    };
    for (name, material, least) in [("phong 5", glossy(5.0), 0.7), ("phong 500", glossy(500.0), 0.98)] {
        let mut scene = furnace(material, Optics::default());
        scene.frame.camera.fov_y_rad = 2f64.to_radians();
        let (mean, error) = scene.mean(&RGB, 64);
        assert!(mean.max_element() <= 1.0 + 4.0 * error && mean.min_element() > least, "{name}: {mean}");
    }
    for roughness in [0.2, 0.5, 1.0] {
        let mut scene = furnace(metal(roughness), Optics::default());
        scene.frame.camera.fov_y_rad = 0.5f64.to_radians();
        let (scale, bias) = gonio_light::microfacet::environment_brdf(1.0, roughness.into());
        assert_mean(&format!("metal {roughness}"), &scene, &RGB, 256, scale + bias, 2e-3);
    }
}

/// `E = I cos / d^2`, and `L = rho E / pi`.
#[test]
fn inverse_square() {
    for (height, scale) in [(2.0, 1.0), (4.0, 1.0), (2.0, 1000.0)] {
        let mut scene = TestScene::new()
            .placed(square(1.0, 0.0), matte(0.6), Optics::default(), DMat4::from_scale(DVec3::splat(scale)))
            .eye([0.0, 3.0 * scale, 4.0 * scale], [0.0; 3])
            .light(point([height * scale, 0.0, height * scale], 7.0));
        scene.frame.camera.fov_y_rad = 0.01;
        let expected = 0.6 / PI * 7.0 * 0.5_f64.sqrt() / (2.0 * (height * scale).powi(2));
        // One pixel is not quite a point.
        assert_mean("point light", &scene, &RGB, 4, expected, 1e-4 * expected);
    }
}

#[test]
fn light_of_a_square_lamp() {
    for (half, height) in [(0.5, 1.0), (2.0, 0.5), (0.1, 3.0)] {
        let mut scene = TestScene::new()
            .object(square(5.0, 0.0), matte(0.5))
            .object(square(half, height), Material { emitted: [3.0; 3], ..matte(0.0) })
            .eye([0.0, 0.2 * f64::from(height), 0.1 * f64::from(height)], [0.0; 3]);
        scene.frame.camera.fov_y_rad = 0.001;
        let expected = 0.5 / PI * 3.0 * irradiance_below_square(half.into(), height.into());
        for technique in [Technique::Both, Technique::Lights, Technique::Directions] {
            let settings = TraceSettings { technique, ..RGB };
            assert_mean(&format!("{half} {height} {technique:?}"), &scene, &settings, 1024, expected, 1e-4);
        }
    }
}

/// `exp(-absorption d)` through a slab that neither reflects nor refracts.
#[test]
fn beer_lambert() {
    let optics = Optics { transmission: 1.0, absorption: DVec3::new(0.5, 1.0, 2.0), ..Optics::default() };
    let material = Material { refraction_index: 1.0, ..matte(0.0) };
    let scene =
        TestScene::new().placed(cuboid([2.0, 2.0, 0.7]), material, optics, DMat4::IDENTITY).environment(|_| DVec3::ONE);
    let (mean, _) = scene.mean(&RGB, 4);
    let expected = (-DVec3::new(0.5, 1.0, 2.0) * 1.4).exp();
    // The outermost pixels look a little askew: 5 degrees of field, so at most 0.1 % more way.
    assert!(((mean - expected) / expected).abs().max_element() < 3e-3, "{mean} instead of {expected}");
    // The way behind the slab absorbs nothing.
    let (mean, _) = scene.object(square(3.0, -2.0), Material { emitted: [1.0; 3], ..matte(0.0) }).mean(&RGB, 4);
    assert!(((mean - expected) / expected).abs().max_element() < 3e-3, "{mean} instead of {expected}, before a lamp");
}

/// All techniques have the same mean: a glossy and a matte surface under a small and a large lamp and the sky, also behind a
/// screen that lets light through.
#[test]
fn techniques_agree() {
    let lamp = |color: f32| Material { emitted: [color; 3], ..matte(0.0) };
    let mut scene = TestScene::new()
        .object(square(1.0, 0.0), Material { specular: [0.5; 3], shininess: 30.0, ..matte(0.4) })
        .placed(square(0.6, 0.0), lamp(4.0), Optics::default(), DMat4::from_translation(DVec3::new(0.8, 0.3, 1.0)))
        .environment(|d| DVec3::splat(if d.y > 0.7 { 6.0 } else { 0.3 }))
        .eye([0.0, -1.5, 1.0], [0.0; 3]);
    scene.frame.camera.fov_y_rad = 20f64.to_radians();
    let behind_screen = scene.clone().object(square(1.5, 0.5), Material { opacity: 0.4, ..matte(0.3) });
    for (name, scene) in [("open", scene), ("behind a screen", behind_screen)] {
        let of = |technique, seed| scene.mean(&TraceSettings { technique, seed, ..RGB }, 2048);
        let (both, both_error) = of(Technique::Both, 1);
        for technique in [Technique::Lights, Technique::Directions] {
            let (mean, error) = of(technique, 2);
            let z = (mean.y - both.y).abs() / both_error.hypot(error);
            // 3.3 standard errors: p = 0.001.
            assert!(z < 3.3, "{name}, {technique:?}: {mean} instead of {both}, z = {z:.1}");
            assert!(error < 0.01 * both.y, "{name}, {technique:?}: {error} of {both}");
        }
    }
}

/// The edge of a bright half plane through a lens of radius A: at the distance `e` inside of the edge, the share of a disc of
/// radius `s = A |1 - d / f|` that is bright, `1/2 + (t sqrt(1 - t^2) + asin t) / pi` with `t = e / s`.
#[test]
fn a_lens_blurs_what_is_not_in_focus() {
    let half_plane = DMat4::from_translation(DVec3::new(10.0, 0.0, 0.0));
    let bright = Material { emitted: [1.0; 3], ..matte(0.0) };
    let scene = TestScene::new().placed(square(10.0, 0.0), bright, Optics::default(), half_plane);
    let (aperture, distance) = (0.2, 5.0_f64);
    for (focus, e) in [(2.5, 0.1), (2.5, -0.15), (10.0, 0.05), (10.0, -0.05), (5.0, 0.01), (5.0, -0.01)] {
        let mut scene = scene.clone().eye([e, 0.0, distance], [e, 0.0, 0.0]);
        scene.frame.camera.fov_y_rad = 1e-4;
        let t = (e / (aperture * (1.0 - distance / focus).abs())).clamp(-1.0, 1.0);
        let expected = 0.5 + (t * (1.0 - t * t).sqrt() + t.asin()) / PI;
        let (mean, error) = scene.mean(&TraceSettings { aperture, focus, ..RGB }, 1024);
        assert!((mean.y - expected).abs() < 4.0 * error + 1e-3, "focus {focus}, {e}: {mean} instead of {expected}");
    }
}

/// Inside a closed room of albedo rho that emits E everywhere, light is E / (1 - rho).
#[test]
fn glowing_room() {
    let scene = TestScene::new()
        .object(sphere(24), Material { emitted: [1.0; 3], ..matte(0.5) })
        .eye([0.1, 0.2, 0.3], [0.0, 0.0, -1.0]);
    // The sphere's facets are seen from inside: nothing is lost.
    assert_mean("room", &scene, &RGB, 256, 2.0, 2e-3);
}
