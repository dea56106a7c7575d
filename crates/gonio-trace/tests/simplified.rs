//! The simplifications: each by itself, and all of them, which is the light equation.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, matte, point, sphere, square};
use glam::{DMat4, DVec3};
use gonio_light::brdf::{BrdfKind, BrdfSettings};
use gonio_light::{Attenuation, Convention, Equation, Light, LightKind, Optics, Spectrum, Specular};
use gonio_mesh::{AmbientRule, Material, MetallicRoughness};
use gonio_reference::ReferenceScene;
use gonio_scene::scene_file::LightSourceKind;
use gonio_scene::settings::LightSettings;
use gonio_scene::texture::{ColorSpace, Texture};
use gonio_scene::{BoundTexture, LightShape};
use gonio_trace::{LightOrigin, Simplification, Simplifications, TraceScene, TraceSettings};
use std::sync::Arc;

const LIGHT_EQUATION: TraceSettings = TraceSettings { simplified: Simplifications::ALL, ..RGB };

/// A glossy sphere and a metal one over a textured floor, under a light of each kind.
fn scene() -> TestScene {
    let glossy = Material {
        diffuse: [0.7, 0.4, 0.2],
        specular: [0.6, 0.8, 1.0],
        ambient: AmbientRule::Value([0.3, 0.2, 0.1]),
        shininess: 20.0,
        ..Material::default()
    };
    let metal = Material {
        metallic_roughness: Some(MetallicRoughness {
            base_color: [0.9, 0.6, 0.3],
            metallic: 0.5,
            roughness: 0.4,
            metallic_map: None,
            roughness_map: None,
        }),
        emitted: [0.05, 0.1, 0.0],
        ..glossy.clone()
    };
    let mut floor = square(3.0, 0.0);
    floor.tex_coords = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mirror = Optics { reflectivity: 0.5, ..Optics::default() };
    let mut scene = TestScene::new()
        .object(floor, glossy.clone())
        .placed(sphere(48), glossy, mirror, DMat4::from_translation(DVec3::new(-1.2, 0.0, 1.2)))
        .placed(sphere(48), metal, Optics::default(), DMat4::from_translation(DVec3::new(1.2, 0.5, 1.0)));
    let texels: Vec<u8> = (0..16_u8).flat_map(|i| [40 + 12 * i, 200 - 9 * i, 17 * (i % 4), 255]).collect();
    scene.scene.textures.push(Arc::new(Texture::new("test", 4, 4, texels, ColorSpace::Srgb)));
    scene.scene.materials[0].maps.diffuse = Some(BoundTexture::plain(0));
    scene.frame.bounds_min = DVec3::new(-3.0, -3.0, 0.0);
    scene.frame.bounds_max = DVec3::new(3.0, 3.0, 2.2);
    let fading = Attenuation { constant: 0.5, linear: 0.1, quadratic: 0.05 };
    let spot = LightKind::Spot {
        position: DVec3::new(2.0, 2.0, 4.0),
        axis: DVec3::new(-1.0, -1.0, -2.0).normalize(),
        inner_rad: 0.2,
        outer_rad: 0.7,
    };
    let light = |kind, color: [f64; 3]| Light { kind, color: color.into(), attenuation: fading };
    scene
        .light(light(LightKind::Point { position: DVec3::new(-2.0, 1.0, 3.0) }, [1.0, 0.9, 0.8]))
        .light(light(LightKind::Ambient, [0.2, 0.3, 0.4]))
        .light(light(LightKind::Directional { direction: DVec3::new(0.3, -0.5, -1.0).normalize() }, [0.2, 0.3, 0.5]))
        .light(light(spot, [0.8, 0.8, 0.3]))
        .light(light(LightKind::Point { position: DVec3::new(0.0, 0.0, -2.0) }, [0.3, 0.2, 0.1]))
}

/// Places of the scene, seen through a telescope: nothing changes within a pixel.
const PLACES: [[f64; 3]; 8] = [
    [0.1, -1.7, 0.0],
    [-2.0, 0.3, 0.0],
    [-1.2, -0.4, 2.0],
    [-1.5, -0.7, 1.9],
    [-0.8, -0.8, 1.5],
    [1.2, 0.1, 1.9],
    [1.5, -0.2, 1.6],
    [0.7, 0.2, 1.7],
];

/// Asserts that the traced picture is the reference's, with these lights in place of the frame's.
fn assert_is_light_equation(name: &str, mut scene: TestScene, settings: &TraceSettings) {
    (scene.frame.width, scene.frame.height) = (2, 2);
    scene.frame.camera.fov_y_rad = 1e-5;
    let mut brightest = 0.0_f32;
    for place in PLACES {
        let scene = TestScene { scene: scene.scene.clone(), frame: scene.frame.clone() }.eye([0.5, -4.0, 6.0], place);
        let traced = scene.trace(settings, 1).picture();
        let mut frame = scene.frame.clone();
        frame.lights = TraceScene::new(&scene.scene, &frame).point_lights(settings.points_per_light);
        let expected = ReferenceScene::new(&scene.scene).render(&frame, None, &|_| ()).picture;
        for (traced, expected) in traced.pixels.iter().zip(&expected.pixels) {
            for channel in 0..4 {
                let (a, b) = (traced[channel], expected[channel]);
                // f32: positions are good to 1e-7, and a highlight of exponent 20 changes 20 times as fast.
                assert!((a - b).abs() <= 2e-4 * b.max(0.05), "{name} at {place:?}: {traced:?} instead of {expected:?}");
                brightest = brightest.max(b);
            }
        }
    }
    assert!(brightest > 0.2, "{name}: nothing is lit");
}

#[test]
fn all_of_them_are_the_light_equation() {
    for convention in [Convention::Lab, Convention::Physical] {
        for specular in [Specular::Phong, Specular::BlinnPhong, Specular::None] {
            for (gated, cosine_weighted) in [(true, false), (false, false), (true, true)] {
                let mut scene = scene();
                scene.frame.equation = Equation { convention, specular, gated, cosine_weighted, ..Equation::default() };
                let name = format!("{convention} {specular} {gated} {cosine_weighted}");
                assert_is_light_equation(&name, scene, &LIGHT_EQUATION);
            }
        }
        let mut scene = scene();
        let brdf = BrdfSettings { normalised: false, ..BrdfSettings::new(BrdfKind::Lafortune) };
        scene.frame.equation = Equation { convention, brdf: Some(brdf), ..Equation::default() };
        assert_is_light_equation("Lafortune", scene, &LIGHT_EQUATION);
    }
    let mut one_sided = scene();
    one_sided.frame.two_sided = false;
    one_sided.frame.equation.gated = false;
    assert_is_light_equation("one-sided", one_sided, &LIGHT_EQUATION);
    let mut switched = scene();
    switched.frame.equation.terms.ambient = false;
    switched.frame.equation.terms.attenuation = false;
    switched.frame.equation.terms.spot = false;
    assert_is_light_equation("switched off", switched, &LIGHT_EQUATION);
}

/// Lamps and objects that emit light become points.
#[test]
fn a_sum_has_points_in_place_of_lamps() {
    for points_per_light in [1, 7] {
        let lamp = Material { emitted: [2.0, 1.0, 0.5], ..matte(0.2) };
        let mut scene = scene().placed(
            square(0.3, 0.0),
            lamp,
            Optics::default(),
            DMat4::from_translation(DVec3::new(0.0, 2.5, 2.0)),
        );
        scene.frame.light_shapes = vec![LightShape::Sphere { radius: 0.4 }, LightShape::Point, LightShape::Point];
        let settings = TraceSettings { points_per_light, ..LIGHT_EQUATION };
        let lights = TraceScene::new(&scene.scene, &scene.frame).point_lights(points_per_light);
        // The sphere, four other lights, the objects: two spheres of which one glows, and the square.
        assert_eq!(lights.len() as u32, points_per_light + 4 + 2 * points_per_light);
        assert_is_light_equation(&format!("{points_per_light} points"), scene, &settings);
    }
}

/// A point of a white floor below a light: a closed form for each simplification by itself.
fn floor_under(light: Light) -> TestScene {
    let mut scene = TestScene::new().object(square(4.0, 0.0), matte(0.5)).light(light).eye([0.0, -2.0, 2.0], [0.0; 3]);
    scene.frame.camera.fov_y_rad = 1e-4;
    scene
}

fn with(one: Simplification) -> TraceSettings {
    TraceSettings { simplified: RGB.simplified.with(one), ..RGB }
}

#[test]
fn shadows() {
    let blocker = |one| {
        let scene = floor_under(point([0.0, 0.0, 2.0], 4.0)).object(square(0.2, 1.0), matte(0.0));
        scene.mean(&with(one), 16).0.x
    };
    assert!(blocker(Simplification::Time) < 1e-6);
    let expected = 0.5 / std::f64::consts::PI * 4.0 / 4.0;
    assert!((blocker(Simplification::Shadows) - expected).abs() < 1e-4 * expected);
}

#[test]
fn interreflection() {
    // Inside a sphere of albedo rho under a point at its centre: L (1 + rho + rho^2 + ...).
    let mean = |one| {
        let scene = TestScene::new().object(sphere(32), matte(0.5)).light(point([0.0; 3], 1.0));
        scene.eye([0.0, 0.0, 0.5], [0.0, 0.0, -1.0]).mean(&with(one), 256).0.x
    };
    let direct = 0.5 / std::f64::consts::PI;
    let (all, one) = (mean(Simplification::Time), mean(Simplification::Interreflection));
    // The facets lie a little inside the sphere, and the walls are seen from inside.
    assert!((one / direct - 1.0).abs() < 0.01, "{one} {direct}");
    assert!((all / (2.0 * direct) - 1.0).abs() < 0.02, "{all} {direct}");
}

#[test]
fn attenuation() {
    let attenuation = Attenuation { constant: 1.0, linear: 0.5, quadratic: 0.0 };
    let mean = |one, shape| {
        let light = Light { attenuation, ..point([0.0, 0.0, 2.0], 1.0) };
        let mut scene = floor_under(light);
        (scene.frame.bounds_min, scene.frame.bounds_max) = (DVec3::splat(-4.0), DVec3::new(4.0, 4.0, -2.0));
        scene.frame.light_shapes = vec![shape];
        scene.mean(&with(one), 256).0.x
    };
    // The centre of the box is 5 away, where the light has 1/3.5 of its strength.
    for shape in [LightShape::Point, LightShape::Sphere { radius: 0.01 }] {
        let exact = 0.5 / std::f64::consts::PI * 25.0 / 3.5 / 4.0;
        let simple = 0.5 / std::f64::consts::PI / 2.0;
        let (a, b) = (mean(Simplification::Time, shape), mean(Simplification::Attenuation, shape));
        assert!((a / exact - 1.0).abs() < 1e-3, "{shape:?}: {a} instead of {exact}");
        assert!((b / simple - 1.0).abs() < 0.02, "{shape:?}: {b} instead of {simple}");
    }
}

/// A light in the middle of a room lights the nearest walls as the light equation says.
#[test]
fn a_light_at_the_centre_lights_its_surroundings() {
    let attenuation = Attenuation { constant: 1.0, linear: 0.5, quadratic: 0.0 };
    let settings = with(Simplification::Interreflection);
    for shape in [LightShape::Point, LightShape::Sphere { radius: 0.05 }] {
        for at in [0.0, 0.3] {
            let light = Light { attenuation, ..point([0.0, 0.0, at], 2.0) };
            let mut scene = TestScene::new().object(cuboid([2.0, 3.0, 1.0]), matte(0.5)).light(light);
            scene = scene.eye([1.0, 0.5, 0.2], [0.0, 0.0, -1.0]);
            scene.frame.camera.fov_y_rad = 1e-4;
            (scene.frame.bounds_min, scene.frame.bounds_max) = (-DVec3::new(2.0, 3.0, 1.0), DVec3::new(2.0, 3.0, 1.0));
            scene.frame.light_shapes = vec![shape];
            let mean = scene.mean(&settings, 256).0.x;
            // From there on it obeys the inverse square law.
            let expected = 0.5 / std::f64::consts::PI * 2.0 / 1.5 / (1.0_f64 + at).powi(2);
            assert!((mean / expected - 1.0).abs() < 0.01, "{shape:?} at {at}: {mean} instead of {expected}");
        }
    }
}

#[test]
fn ambient() {
    let light = Light { kind: LightKind::Ambient, ..point([0.0; 3], 0.8) };
    let mean = |one| floor_under(light).mean(&with(one), 4).0.x;
    assert_eq!(mean(Simplification::Time), 0.0);
    assert!((mean(Simplification::Ambient) - 0.4).abs() < 1e-6);
}

/// Two materials of one colour: in white ambient light both have it with and without wavelengths, in that of a narrow lamp
/// each reflects what it reflects at the line.
#[test]
fn ambient_light_sees_spectra() {
    let line = || Spectrum::new(vec![[588.0, 0.0], [589.0, 1.0], [590.0, 0.0]]);
    let luminance = |c: DVec3| c.dot(DVec3::new(0.2126, 0.7152, 0.0722));
    let mut at_lines = Vec::new();
    for at_line in [0.1, 0.8] {
        let samples =
            vec![[500.0, 0.2], [560.0, 0.45], [579.0, 0.45], [580.0, at_line], [598.0, at_line], [599.0, 0.45]];
        let spectrum = Arc::new(Spectrum::new(samples));
        let scene = |color: DVec3, narrow: bool| {
            let mut scene = floor_under(Light { kind: LightKind::Ambient, color, ..point([0.0; 3], 1.0) });
            let mut settings = LightSettings::new(LightSourceKind::Ambient);
            settings.spectrum = narrow.then(|| Arc::new(line()));
            scene.scene.settings.lights.push(settings);
            scene.scene.materials[0].material.diffuse = spectrum.color_of_surface().as_vec3().to_array();
            scene.scene.materials[0].diffuse_spectrum = Some(spectrum.clone());
            scene
        };
        let spectral = TraceSettings { simplified: Simplifications::NONE.with(Simplification::Ambient), ..RGB };
        let white = scene(DVec3::splat(0.8), false);
        let (mean, expected) = (white.mean(&spectral, 4096).0, white.mean(&with(Simplification::Ambient), 4).0);
        assert!((mean - expected).abs().max_element() < 0.01 * expected.max_element(), "{mean} {expected}");
        let color = line().color_of_light().unwrap();
        let mean = luminance(scene(color, true).mean(&spectral, 1024).0);
        let expected = at_line * luminance(color);
        assert!((mean / expected - 1.0).abs() < 0.02, "{mean} {expected}");
        at_lines.push(mean);
    }
    assert!((at_lines[1] / at_lines[0] - 8.0).abs() < 0.2, "{at_lines:?}");
}

#[test]
fn emission_has_the_mean_of_its_texture() {
    let mean = |one, at: f64| {
        let mut lamp = square(1.0, 0.0);
        lamp.tex_coords = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mut scene = TestScene::new()
            .object(lamp, Material { emitted: [3.0; 3], ..matte(0.0) })
            .eye([at, 0.0, 2.0], [at, 0.0, 0.0]);
        let texels = [255, 255, 255, 255, 0, 0, 0, 255].to_vec();
        scene.scene.textures.push(Arc::new(Texture::new("halves", 2, 1, texels, ColorSpace::Data)));
        scene.scene.materials[0].maps.emitted = Some(BoundTexture::plain(0));
        scene.mean(&with(one), 16).0.x
    };
    assert!((mean(Simplification::Time, -0.5) - 3.0).abs() < 0.2 && mean(Simplification::Time, 0.5) < 0.2);
    for at in [-0.5, 0.5] {
        let mean = mean(Simplification::Emission, at);
        assert!((mean - 1.5).abs() < 0.01, "{mean}");
    }
}

/// Every set of simplifications gives a finite picture, and the specular term its cosine only where it should.
#[test]
fn any_combination_is_finite() {
    let mut scene = scene();
    scene.frame.light_shapes = vec![LightShape::Sphere { radius: 0.3 }];
    scene = scene.environment(|d| DVec3::splat(0.5 + 0.5 * d.z));
    scene = scene.eye([0.5, -6.0, 6.0], [0.0, 0.0, 0.5]);
    scene.frame.camera.fov_y_rad = 0.8;
    scene.frame.equation.gated = false;
    // Every fifth keeps the test short, and has each pair both with and without the other.
    for bits in (0..1_u32 << 9).step_by(5) {
        let simplified: Simplifications = Simplification::ALL
            .iter()
            .skip(1)
            .enumerate()
            .filter(|(i, _)| bits & (1 << i) != 0)
            .map(|(_, one)| *one)
            .collect();
        let film = scene.trace(&TraceSettings { simplified, most_depth: 4, ..RGB }, 1);
        let sum: f32 = film.picture().pixels.iter().map(|p| p[0] + p[1] + p[2]).sum();
        assert!(sum.is_finite() && sum > 1.0, "{simplified:?}: {sum}");
    }
}

/// The parts of a pixel are its picture's.
#[test]
fn contributions_add_up() {
    let mut scene = scene();
    scene.frame.light_shapes = vec![LightShape::Sphere { radius: 0.3 }];
    scene = scene.environment(|d| DVec3::splat(0.5 + 0.5 * d.z)).eye([0.5, -6.0, 6.0], [0.0, 0.0, 0.5]);
    scene.frame.camera.fov_y_rad = 0.8;
    for simplified in [Simplifications::NONE, RGB.simplified, Simplifications::ALL] {
        let settings = TraceSettings { simplified, ..RGB };
        let picture = scene.trace(&settings, 32).picture();
        let ready = TraceScene::new(&scene.scene, &scene.frame);
        let mut origins = Vec::new();
        for (x, y) in (0..64).map(|i| (i % 8, i / 8)) {
            let parts = ready.contributions(&settings, x, y, 32, &|_| true);
            let pixel = picture.at(x, y);
            let expected = DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into());
            let direct: DVec3 = parts.direct.iter().map(|(_, light)| *light).sum();
            let sum = parts.emitted + direct + parts.first_bounce + parts.rest;
            assert!((parts.total - expected).abs().max_element() <= 1e-5 * expected.max_element(), "{parts:?}");
            assert!((parts.total - sum).abs().max_element() <= 1e-5 * expected.max_element(), "{parts:?}");
            assert!(parts.samples == 32 && parts.standard_error.is_finite());
            origins.extend(parts.direct.iter().map(|(origin, _)| *origin));
        }
        assert!(origins.contains(&LightOrigin::Light(0)));
        assert_eq!(origins.contains(&LightOrigin::Environment), simplified != Simplifications::ALL);
        assert_eq!(origins.contains(&LightOrigin::Ambient), simplified == Simplifications::ALL);
    }
}

/// Below a lamp: `E = pi L sin^2` for a sphere, Lambert's polygon formula for a rectangle; with every technique. The lamp is as
/// bright at the centre of the objects as its light.
#[test]
fn light_of_lamps() {
    let at = |position: [f64; 3], shape, technique, kind: LightKind| {
        let light = Light { kind, ..point(position, 2.0) };
        let mut scene = floor_under(light);
        scene.frame.light_shapes = vec![shape];
        // Its brightness is chosen for 2 units below.
        (scene.frame.bounds_min, scene.frame.bounds_max) = (DVec3::splat(-1.0), DVec3::ONE);
        scene.mean(&TraceSettings { technique, ..RGB }, 2048)
    };
    use gonio_trace::Technique::{Both, Directions, Lights};
    for technique in [Both, Lights, Directions] {
        let position = [0.0, 0.0, 2.0];
        for radius in [0.1, 0.6, 1.3] {
            if radius < 0.5 && technique == Directions {
                continue;
            }
            let kind = LightKind::Point { position: position.into() };
            let (mean, error) = at(position, LightShape::Sphere { radius }, technique, kind);
            // I / d^2, whatever the radius.
            let expected = 0.5 / std::f64::consts::PI * 2.0 / 4.0;
            assert!((mean.x - expected).abs() < 4.0 * error + 1e-4, "{radius} {technique:?}: {mean} {expected}");
            assert!(error < 0.02 * expected);
        }
        for half in [DVec3::new(0.5, 0.5, 0.0), DVec3::new(3.0, 0.4, 0.0)] {
            let axis = DVec3::NEG_Z;
            let kind = LightKind::Spot {
                position: position.into(),
                axis,
                inner_rad: 0.0,
                outer_rad: std::f64::consts::FRAC_PI_2,
            };
            let shape = LightShape::Rectangle {
                half_right: DVec3::new(half.x, 0.0, 0.0),
                half_up: DVec3::new(0.0, -half.y, 0.0),
            };
            let (mean, error) = at(position, shape, technique, kind);
            // As bright below it as the spot that stands for it.
            let expected = 0.5 / std::f64::consts::PI * 2.0 / 4.0;
            assert!((mean.x - expected).abs() < 4.0 * error + 1e-4, "{half} {technique:?}: {mean} {expected}");
            assert!(error < 0.02 * expected);
        }
    }
}

/// A lamp with one narrow line has the luminance of its colour, without much noise, and surfaces reflect what they reflect
/// at that line: two of nearly the same colour differ by a factor of 8.
#[test]
fn a_narrow_lamp_shows_what_colors_hide() {
    let line = || Spectrum::new(vec![[588.0, 0.0], [589.0, 1.0], [590.0, 0.0]]);
    let mut means = Vec::new();
    for at_line in [0.1, 0.8] {
        let mut scene = floor_under(point([0.0, 0.0, 2.0], 4.0));
        let color = line().color_of_light().unwrap();
        scene.frame.lights[0].color *= color;
        let mut settings = LightSettings::new(LightSourceKind::Point);
        settings.spectrum = Some(Arc::new(line()));
        scene.scene.settings.lights.push(settings);
        let samples = vec![[579.0, 0.45], [580.0, at_line], [598.0, at_line], [599.0, 0.45]];
        scene.scene.materials[0].diffuse_spectrum = Some(Arc::new(Spectrum::new(samples)));
        scene.scene.materials[0].material.diffuse = [0.45; 3];
        let luminance = |c: DVec3| c.dot(DVec3::new(0.2126, 0.7152, 0.0722));
        let (mean, error) = scene.mean(&TraceSettings { simplified: Simplifications::NONE, ..RGB }, 256);
        let expected = at_line / std::f64::consts::PI * luminance(scene.frame.lights[0].color) / 4.0;
        // The table has 8 points per nm of a line that is 2 nm wide.
        assert!((luminance(mean) - expected).abs() < 4.0 * error + 0.005 * expected, "{mean} {expected}");
        assert!(error < 0.01 * expected, "{error} of {expected}");
        means.push(luminance(mean));
        let rgb = luminance(scene.mean(&RGB, 16).0);
        let expected = 0.45 / std::f64::consts::PI * luminance(scene.frame.lights[0].color) / 4.0;
        assert!((rgb - expected).abs() < 1e-3 * expected, "{rgb} {expected}");
    }
    assert!((means[1] / means[0] - 8.0).abs() < 0.2, "{means:?}");
}
