//! The light at points of surfaces: values known on paper, and pictures of the same points.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, irradiance_below_square, matte, point, sphere, square};
use glam::{DMat4, DVec3};
use gonio_light::color::luminance;
use gonio_light::{Attenuation, Convention, Light, LightKind, Optics};
use gonio_mesh::Material;
use gonio_trace::{Simplifications, SurfacePoint, Technique, TraceScene, TraceSettings};

fn up(position: DVec3, normal: DVec3) -> SurfacePoint {
    SurfacePoint { position, geometric_normal: normal, normal }
}

/// The radiance is `expected` within four standard errors and `tolerance`, in every channel; no path is lost.
fn assert_light(name: &str, scene: &TestScene, settings: &TraceSettings, at: &SurfacePoint, expected: f64, paths: u32) {
    let light = TraceScene::new(&scene.scene, &scene.frame).light_at(settings, at, 7, paths);
    let (difference, error) = ((light.radiance - expected).abs().max_element(), light.variance.sqrt());
    assert!(difference <= 4.0 * error + 1e-3 * expected, "{name}: {light:?} instead of {expected}");
    assert!(error < 0.03 * expected.max(0.05), "{name}: standard error {error:.2e} of {expected}");
    assert_eq!(light.lost, 0, "{name}");
}

/// A white surface in light that is 1 everywhere is 1, outside on a sphere and inside of a box that shines and reflects:
/// `L = e + rho L`.
#[test]
fn furnaces() {
    for settings in [RGB, TraceSettings { simplified: Simplifications::NONE, ..RGB }] {
        let name = format!("{:?}", settings.simplified);
        let scene = TestScene::new().object(sphere(32), matte(0.3)).environment(|_| DVec3::ONE);
        let at = DVec3::new(0.6, 0.0, 0.8);
        assert_light(&format!("sphere, {name}"), &scene, &settings, &up(at, at), 1.0, 256);
        let inside = Material { emitted: [0.5; 3], ..matte(0.75) };
        let scene = TestScene::new().object(cuboid([1.0, 2.0, 3.0]), inside);
        let at = up(DVec3::new(0.3, 2.0, -1.0), DVec3::NEG_Y);
        assert_light(&format!("box, {name}"), &scene, &settings, &at, 2.0, 4096);
    }
}

/// `I cos / d^2 / pi`, also far from the origin, where a position has few digits, and on either side of the triangle.
#[test]
fn inverse_square() {
    for offset in [DVec3::ZERO, DVec3::new(1e5, -2e5, 3e4)] {
        for side in [1.0, -1.0] {
            let scene = TestScene::new()
                .placed(square(1.0, 0.0), matte(0.6), Optics::default(), DMat4::from_translation(offset))
                .light(point((offset + DVec3::new(2.0, 0.0, 2.0 * side)).to_array(), 7.0));
            let expected = 7.0 * 0.5_f64.sqrt() / 8.0 / std::f64::consts::PI;
            let at = SurfacePoint { position: offset, geometric_normal: DVec3::Z, normal: DVec3::Z * side };
            assert_light(&format!("{offset}, {side}"), &scene, &RGB, &at, expected, 4);
            let behind = SurfacePoint { normal: -at.normal, ..at };
            let dark = TraceScene::new(&scene.scene, &scene.frame).light_at(&RGB, &behind, 7, 4);
            assert_eq!(dark.radiance, DVec3::ZERO, "{offset}, {side}");
        }
    }
}

#[test]
fn light_of_a_square_lamp() {
    for (half, height) in [(0.5, 1.0), (2.0, 0.5), (0.1, 3.0)] {
        let lamp = Material { emitted: [3.0; 3], ..matte(0.0) };
        let scene = TestScene::new().object(square(5.0, 0.0), matte(0.5)).object(square(half, height), lamp);
        let expected = 3.0 * irradiance_below_square(half.into(), height.into()) / std::f64::consts::PI;
        for technique in [Technique::Both, Technique::Lights, Technique::Directions] {
            let settings = TraceSettings { technique, most_depth: 2, ..RGB };
            let paths = if technique == Technique::Directions && half < 1.0 { 1 << 17 } else { 1 << 14 };
            assert_light(
                &format!("{half} {height} {technique:?}"),
                &scene,
                &settings,
                &up(DVec3::ZERO, DVec3::Z),
                expected,
                paths,
            );
        }
    }
}

/// In the lab's convention a light of colour L makes `k_d L <N.L>`, so the map is `L <N.L>`, as the light equation's is.
#[test]
fn the_convention_of_the_lab() {
    let direction = -DVec3::new(0.0, 0.6, 0.8);
    let kind = LightKind::Directional { direction };
    let mut scene = TestScene::new().object(square(1.0, 0.0), matte(0.5)).light(Light {
        kind,
        color: DVec3::splat(0.5),
        attenuation: Attenuation::NONE,
    });
    scene.frame.equation.convention = Convention::Lab;
    assert_light("lab", &scene, &RGB, &up(DVec3::ZERO, DVec3::Z), 0.5 * 0.8, 4);
}

/// The pixel of a grey surface in a coloured room is its albedo times the light there: soft shadow, three bounces and an
/// environment included.
#[test]
fn a_picture_of_the_surface_is_its_albedo_times_the_light() {
    let red = Material { diffuse: [0.9, 0.2, 0.1], ..matte(0.0) };
    let wall = DMat4::from_translation(DVec3::X) * DMat4::from_rotation_y(-std::f64::consts::FRAC_PI_2);
    let mut scene = TestScene::new()
        .object(square(1.0, 0.0), matte(0.6))
        .placed(square(1.0, 0.0), red, Optics::default(), wall)
        .object(square(0.3, 0.7), Material { emitted: [4.0, 3.0, 2.0], ..matte(0.1) })
        .environment(|d| DVec3::new(0.1, 0.2, 0.3) * (1.0 + d.y))
        .eye([0.0, -4.0, 2.0], [0.4, 0.0, 0.0]);
    scene.frame.camera.fov_y_rad = 1e-4;
    for (simplified, most_depth) in [(RGB.simplified, 64), (RGB.simplified, 2), (Simplifications::NONE, 4)] {
        let settings = TraceSettings { simplified, most_depth, ..RGB };
        let (picture, picture_error) = scene.mean(&settings, 1024);
        let other_noise = TraceSettings { seed: 5, ..settings };
        let at = up(DVec3::new(0.4, 0.0, 0.0), DVec3::Z);
        let light = TraceScene::new(&scene.scene, &scene.frame).light_at(&other_noise, &at, 3, 1 << 15);
        let difference = (0.6 * luminance(light.radiance) - luminance(picture)).abs();
        let error = (0.36 * light.variance + picture_error * picture_error).sqrt();
        assert!(difference < 3.0 * error, "{settings:?}: {difference:.2e}, {:.1} standard errors", difference / error);
        assert!(error < 0.02 * luminance(picture), "{settings:?}: {error}");
    }
}

/// More paths of the same number continue the same sequence; other numbers and seeds are other noise.
#[test]
fn random_numbers_follow_from_number_and_seed() {
    let scene = TestScene::new().object(square(1.0, 0.0), matte(0.5)).environment(|d| DVec3::splat(1.0 + d.x));
    let ready = TraceScene::new(&scene.scene, &scene.frame);
    let at = up(DVec3::ZERO, DVec3::Z);
    let light = |seed, number| ready.light_at(&TraceSettings { seed, ..RGB }, &at, number, 16).radiance;
    assert_eq!(light(1, 2), light(1, 2));
    assert_ne!(light(1, 2), light(1, 3));
    assert_ne!(light(1, 2), light(2, 2));
    assert_eq!(ready.light_at(&RGB, &at, 0, 0).radiance, DVec3::ZERO);
}
