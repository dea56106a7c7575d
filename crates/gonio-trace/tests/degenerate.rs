//! Scenes with numbers that are not, surfaces without area and extreme sizes: right pictures, and nothing that is not finite.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, matte, point, sphere, square};
use glam::{DMat4, DVec3};
use gonio_light::{Fresnel, Light, LightKind, Optics};
use gonio_mesh::{Material, Mesh};
use gonio_scene::LightShape;
use gonio_trace::{Technique, TraceOddity, TraceScene, TraceSettings};
use std::f64::consts::PI;

fn lamp(radiance: [f32; 3]) -> Material {
    Material { emitted: radiance, ..matte(0.3) }
}

#[track_caller]
fn pixels(scene: &TestScene) -> Vec<[f32; 4]> {
    let film = scene.trace(&RGB, 16);
    let pixels = film.picture().pixels;
    assert!(pixels.iter().flatten().all(|v| v.is_finite() && *v >= 0.0));
    assert!(film.variance().iter().all(|v| v.is_finite()));
    pixels
}

/// The mean is `expected` in every channel, within four standard errors and 0.1 %.
fn assert_mean(name: &str, scene: &TestScene, expected: f64) {
    pixels(scene);
    let (mean, error) = scene.mean(&RGB, 64);
    let difference = (mean - expected).abs().max_element();
    assert!(difference <= 4.0 * error + 1e-3 * expected, "{name}: {mean} instead of {expected}, {error:.1e}");
}

/// A ground under two lamps of this radiance, a sphere of this colour, a point light and a sky.
fn still_life(radiance: [f32; 3], color: [f32; 3], light: Light, sky: impl Fn(DVec3) -> DVec3) -> TestScene {
    let mut scene = TestScene::new()
        .object(square(2.0, 0.0), matte(0.5))
        .placed(square(0.3, 1.5), lamp(radiance), Optics::default(), DMat4::IDENTITY)
        .placed(square(0.3, 1.0), lamp([2.0; 3]), Optics::default(), DMat4::from_rotation_y(0.5))
        .placed(
            sphere(8),
            Material { diffuse: color, specular: color, ..matte(0.0) },
            Optics::default(),
            DMat4::from_translation(DVec3::new(-0.5, 0.0, 0.0)) * DMat4::from_scale(DVec3::splat(0.4)),
        )
        .light(point([1.0, 1.0, 1.0], 1.0))
        .light(light)
        .environment(sky)
        .eye([0.0, -4.0, 3.0], [0.0; 3]);
    scene.frame.camera.fov_y_rad = 0.8;
    scene
}

#[test]
fn light_that_is_no_number_counts_as_none() {
    let dark = point([0.0, 1.0, 2.0], 0.0);
    let even = |_: DVec3| DVec3::splat(0.2);
    let expected = pixels(&still_life([0.0; 3], [0.4; 3], dark, even));
    assert!(expected.iter().any(|p| p[0] > 0.1));
    for bad in [f32::NAN, f32::NEG_INFINITY, -1.0] {
        assert!(pixels(&still_life([bad; 3], [0.4; 3], dark, even)) == expected, "lamp {bad}");
        let light = point([0.0, 1.0, 2.0], bad.into());
        assert!(pixels(&still_life([0.0; 3], [0.4; 3], light, even)) == expected, "light {bad}");
    }
    assert!(pixels(&still_life([f32::INFINITY; 3], [0.4; 3], dark, even)) == expected, "infinitely bright lamp");
    let infinite = point([0.0, 1.0, 2.0], f64::INFINITY);
    assert!(pixels(&still_life([0.0; 3], [0.4; 3], infinite, even)) == expected, "infinitely bright light");
    // One channel that is no number.
    let mut light = dark;
    light.color = DVec3::new(1.0, f64::NAN, 1.0);
    assert!(pixels(&still_life([0.0; 3], [0.4; 3], light, even)).len() == 64);
    for kind in [
        LightKind::Point { position: DVec3::NAN },
        LightKind::Directional { direction: DVec3::ZERO },
        LightKind::Directional { direction: DVec3::NAN },
        LightKind::Spot { position: DVec3::INFINITY, axis: DVec3::ZERO, inner_rad: f64::NAN, outer_rad: 0.0 },
    ] {
        pixels(&still_life([0.0; 3], [0.4; 3], Light { kind, color: DVec3::ONE, ..dark }, even));
    }
    pixels(&still_life([0.0; 3], [f32::NAN; 3], dark, even));
    pixels(&still_life([0.0; 3], [f32::INFINITY; 3], dark, even));
    pixels(&still_life([0.0; 3], [0.4; 3], dark, |d| if d.y > 0.9 { DVec3::NAN } else { DVec3::splat(0.2) }));
    pixels(&still_life([0.0; 3], [0.4; 3], dark, |d| DVec3::splat(if d.y > 0.9 { f64::INFINITY } else { 0.2 })));
    // The brightest numbers there are.
    pixels(&still_life([1e30; 3], [1.0; 3], dark, even));
}

/// A square with a triangle that is a line and one that is a point.
fn with_flat_triangles() -> Mesh {
    let mut mesh = square(2.0, 0.0);
    mesh.indices.extend([0, 2, 2, 1, 1, 1, 0, 1, 0]);
    mesh
}

#[test]
fn surfaces_without_area_are_not_there() {
    let lit = |mesh: Mesh, extra: Option<(Mesh, DMat4)>| {
        let mut scene = TestScene::new().object(mesh, matte(0.5)).light(point([0.5, 0.0, 2.0], 3.0));
        if let Some((mesh, m)) = extra {
            scene = scene.placed(mesh, lamp([1e6; 3]), Optics::default(), m);
        }
        pixels(&scene)
    };
    let expected = lit(square(2.0, 0.0), None);
    assert!(lit(with_flat_triangles(), None) == expected, "triangles without area");
    let line = Mesh { indices: vec![0, 1, 1, 2, 2, 2], ..square(1.0, 0.5) };
    assert!(lit(square(2.0, 0.0), Some((line, DMat4::IDENTITY))) == expected, "lamps without area");
    let flat = DMat4::from_scale(DVec3::new(0.0, 0.0, 1.0));
    assert!(lit(square(2.0, 0.0), Some((square(1.0, 0.5), flat))) == expected, "a lamp scaled to a point");
    let lost = DMat4::from_cols_array(&[f64::NAN; 16]);
    pixels(&TestScene::new().object(square(2.0, 0.0), matte(0.5)).placed(
        square(1.0, 0.0),
        matte(0.5),
        Optics::default(),
        lost,
    ));
    let beyond = Mesh { indices: vec![0, 1, 9], ..square(1.0, 0.5) };
    assert!(lit(square(2.0, 0.0), Some((beyond, DMat4::IDENTITY))) == expected, "indices beyond the mesh");
}

/// Two surfaces in one place look like one, and let nothing through.
#[test]
fn coincident_faces_are_one_surface() {
    let once = || TestScene::new().object(square(1.0, 0.0), matte(0.6)).eye([1.0, 0.0, 4.0], [0.0; 3]);
    let lit = |scene: TestScene| scene.light(point([0.0, 1.0, 2.0], 7.0)).light(point([0.3, 0.0, -1.0], 900.0));
    let one = pixels(&lit(once()));
    assert!(pixels(&lit(once().object(square(1.0, 0.0), matte(0.6)))) == one);
    // A closed room of two coincident walls, and a box that stands on another one.
    let room = TestScene::new()
        .object(cuboid([1.0; 3]), matte(0.5))
        .object(cuboid([1.0; 3]), matte(0.5))
        .environment(|_| DVec3::ONE)
        .eye([0.1, 0.2, 0.3], [0.0, 0.0, -1.0]);
    assert!(pixels(&room).iter().all(|p| p[..3] == [0.0; 3]), "light comes through walls");
    let stack = TestScene::new()
        .object(cuboid([0.5; 3]), matte(0.5))
        .placed(cuboid([0.5; 3]), matte(0.5), Optics::default(), DMat4::from_translation(DVec3::new(0.0, 0.0, 1.0)))
        .environment(|_| DVec3::ONE);
    pixels(&stack);
}

/// A floor below a square at z = 1, all in its light.
fn floor() -> TestScene {
    let mut scene = TestScene::new()
        .object(square(3.0, 0.0), Material { specular: [0.3; 3], shininess: 20.0, ..matte(0.5) })
        .eye([0.0, -4.0, 0.4], [0.0; 3]);
    scene.frame.camera.fov_y_rad = 0.2;
    scene
}

fn quad_lamp(scene: TestScene, half: DVec3) -> TestScene {
    let axis = DVec3::NEG_Z;
    let kind = LightKind::Spot { position: DVec3::new(0.03, 0.07, 1.0), axis, inner_rad: 0.0, outer_rad: 0.5 * PI };
    let mut scene = scene.light(Light { kind, ..point([0.0; 3], 2.0) });
    let (half_right, half_up) = (DVec3::new(half.x, 0.0, 0.0), DVec3::new(0.0, -half.y, 0.0));
    scene.frame.light_shapes.push(LightShape::Rectangle { half_right, half_up });
    scene
}

/// Asserts that pictures by lights and by both techniques have the same mean, which is returned with its error.
#[track_caller]
fn agreeing_mean(scene: &TestScene) -> (DVec3, f64) {
    let of = |technique, seed| scene.mean(&TraceSettings { technique, seed, ..RGB }, 256);
    let ((both, error), (lights, other)) = (of(Technique::Both, 1), of(Technique::Lights, 2));
    let most = 4.0 * error.hypot(other) + 1e-3 * both.max_element();
    assert!((both - lights).abs().max_element() < most, "{both} with both techniques, {lights} by samples of lights");
    (both, error)
}

/// Where one light hides another, its picture is that of the other's absence.
#[track_caller]
fn assert_same_light(name: &str, a: &TestScene, b: &TestScene) {
    let ((a, a_error), (b, b_error)) = (agreeing_mean(a), agreeing_mean(b));
    let most = 4.0 * a_error.hypot(b_error) + 2e-3 * b.max_element();
    assert!((a - b).abs().max_element() < most, "{name}: {a} instead of {b}");
}

fn oddities(scene: &TestScene) -> Vec<TraceOddity> {
    TraceScene::new(&scene.scene, &scene.frame).oddities()
}

/// Triangles that emit light in the plane of others: light counts once.
#[test]
fn coincident_lights_shine_once() {
    // Moved, so that the triangles of the two are not the same.
    let panel = || square(0.5, 1.0);
    let other = || square(0.7, 1.0);
    let one = floor().object(panel(), lamp([3.0; 3]));
    assert_eq!(oddities(&one), []);
    let twice = floor().object(panel(), lamp([3.0; 3])).object(panel(), lamp([3.0; 3]));
    assert_same_light("twice", &twice, &one);
    assert_eq!(oddities(&twice), [TraceOddity::OverlappingLights(4)]);
    // A panel in the ceiling shines although the ceiling is there.
    let under = floor().object(panel(), lamp([3.0; 3])).object(square(2.9, 1.0), matte(0.0));
    assert_same_light("in the ceiling", &under, &floor().object(panel(), lamp([3.0; 3])));
    assert!(matches!(oddities(&under)[..], [TraceOddity::OverlappingLights(3..)]), "{:?}", oddities(&under));
    // Of two colours a place has one: neither black nor their sum.
    let red_and_green = floor().object(panel(), lamp([3.0, 0.0, 0.0])).object(other(), lamp([0.0, 3.0, 0.0]));
    let wide = agreeing_mean(&floor().object(other(), lamp([3.0; 3]))).0;
    let (mean, _) = agreeing_mean(&red_and_green);
    assert!((mean.x + mean.y - wide.y).abs() < 0.01 * wide.y, "{mean} of {wide}");
    assert!(pixels(&red_and_green) == pixels(&red_and_green));
}

/// A lamp lies on the surfaces in its plane, and the first on the second.
#[test]
fn lamps_cover_what_lies_in_their_plane() {
    let half = DVec3::splat(0.5);
    let one = quad_lamp(floor(), half);
    assert_same_light("ceiling", &quad_lamp(floor().object(square(2.9, 1.0), matte(0.0)), half), &one);
    assert_same_light("panel", &quad_lamp(floor().object(square(0.3, 1.0), lamp([30.0; 3])), half), &one);
    let twice = quad_lamp(quad_lamp(floor(), half), half);
    assert_same_light("twice", &twice, &one);
    assert_eq!(oddities(&twice), [TraceOddity::OverlappingLamps(0, 1)]);
    assert_eq!(oddities(&one), []);
    let ball = |count: usize| {
        let mut scene = floor();
        for _ in 0..count {
            scene = scene.light(point([0.1, 0.2, 1.0], 2.0));
            scene.frame.light_shapes.push(LightShape::Sphere { radius: 0.3 });
        }
        scene
    };
    assert_same_light("balls", &ball(2), &ball(1));
    assert_eq!(oddities(&ball(2)), [TraceOddity::OverlappingLamps(0, 1)]);
    // The lamp is seen and not the ceiling; from above the ceiling is seen and not the back of the lamp.
    let lit_above = |scene: TestScene| {
        let mut scene = scene.light(point([0.0, 0.0, 3.0], 5.0)).eye([0.2, 0.5, 3.0], [0.0, 0.0, 1.0]);
        scene.frame.camera.fov_y_rad = 0.2;
        scene
    };
    let ceiling = || square(2.9, 1.0);
    let covered = quad_lamp(floor().object(ceiling(), matte(0.5)), half);
    let (mean, error) = lit_above(covered.clone()).mean(&RGB, 16);
    let bare = lit_above(floor().object(ceiling(), matte(0.5))).mean(&RGB, 16).0;
    assert!((mean - bare).abs().max_element() < 4.0 * error + 1e-3, "{mean} instead of {bare}");
    let mut below = covered.eye([0.2, 0.5, 0.1], [0.0, 0.0, 1.0]);
    below.frame.camera.fov_y_rad = 0.2;
    let seen = pixels(&below);
    assert!(seen.iter().all(|p| *p == seen[0] && p[0] > 0.5), "{seen:?}");
}

#[test]
fn the_eye_may_be_inside() {
    let inside = |material: Material, optics: Optics| {
        let mut scene = TestScene::new()
            .placed(sphere(128), material, optics, DMat4::IDENTITY)
            .environment(|_| DVec3::ONE)
            .eye([0.0; 3], [0.0, 0.0, -1.0]);
        scene.frame.camera.fov_y_rad = 0.8;
        scene
    };
    assert!(pixels(&inside(matte(1.0), Optics::default())).iter().all(|p| p[..3] == [0.0; 3]), "opaque");
    // Radiance in glass is larger by the square of its index; at the centre of a ball no reflection is total.
    let glass = Optics { transmission: 1.0, fresnel: Fresnel::Exact, ..Optics::default() };
    let body = |index| Material { refraction_index: index, ..matte(0.0) };
    assert_mean("glass", &inside(body(1.5), glass), 2.25);
    // A body that does not refract, and absorbs over its radius.
    let smoke = Optics { absorption: DVec3::splat(0.7), transmission: 1.0, ..Optics::default() };
    assert_mean("smoke", &inside(body(1.0), smoke), (-0.7_f64).exp());
}

#[test]
fn empty_scenes_show_what_is_behind() {
    let mut empty = TestScene::new().light(point([0.0, 0.0, 2.0], 1.0));
    empty.frame.background.top = DVec3::splat(0.3);
    empty.frame.background.bottom = DVec3::splat(0.3);
    for technique in [Technique::Both, Technique::Lights, Technique::Directions] {
        let (mean, _) = empty.mean(&TraceSettings { technique, ..RGB }, 2);
        assert!((mean - 0.3).abs().max_element() < 1e-6, "{mean}");
    }
    empty.frame.background.top = DVec3::splat(0.9);
    let seen = pixels(&empty);
    // The middles of the outermost of 8 rows.
    for (row, expected) in [(0, 0.9 - 0.6 / 16.0), (7, 0.3 + 0.6 / 16.0)] {
        assert!((f64::from(seen[8 * row][0]) - expected).abs() < 0.01, "{:?} in row {row}", seen[8 * row]);
    }
    let mut sky = TestScene::new().environment(|_| DVec3::splat(0.7));
    sky.frame.surroundings.as_mut().unwrap().visible = true;
    assert_mean("sky", &sky, 0.7);
    // Objects without triangles.
    assert!(pixels(&TestScene::new().object(Mesh::default(), matte(0.5))).iter().all(|p| p[..3] == [0.0; 3]));
}

/// One triangle, in whose middle the eye looks, from near and from far, under a light from infinity.
#[test]
fn one_huge_triangle() {
    for size in [10.0, 1e4, 1e9, 1e18, 1e30_f32] {
        let mesh = Mesh {
            positions: vec![[-size, -size, 0.0], [size, -size, 0.0], [0.0, size, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        };
        let sun =
            Light { kind: LightKind::Directional { direction: DVec3::new(0.0, -0.6, -0.8) }, ..point([0.0; 3], 3.0) };
        let scene = TestScene::new().object(mesh, matte(0.5)).light(sun);
        assert_mean(&format!("{size}"), &scene, 0.5 / PI * 3.0 * 0.8);
    }
}

/// The same scene at every size: light that grows with the square of the size gives the same picture.
#[test]
fn size_does_not_matter() {
    for size in [1.0, 1e-12, 1e12, 1e-30, 1e30] {
        let metres = DVec3::splat(size);
        let light = point([2.0 * size, 0.0, 2.0 * size], 7.0 * size * size);
        // In the transformation, and in the mesh itself.
        let in_mesh = size as f32;
        for (mesh, scale) in [(square(1.0, 0.0), DMat4::from_scale(metres)), (square(in_mesh, 0.0), DMat4::IDENTITY)] {
            let mut scene = TestScene::new()
                .placed(mesh, matte(0.6), Optics::default(), scale)
                .light(light)
                .eye([0.0, 3.0, 4.0], [0.0; 3]);
            let camera = &mut scene.frame.camera;
            camera.position *= size;
            (camera.fov_y_rad, camera.near, camera.far) = (0.01, 1e-3 * size, 1e3 * size);
            assert_mean(&format!("{size:e}"), &scene, 0.6 / PI * 7.0 * 0.5_f64.sqrt() / 8.0);
        }
    }
    // A speck beside something of ordinary size, and one that is a lamp.
    let speck = DMat4::from_translation(DVec3::new(0.0, 0.0, 0.5)) * DMat4::from_scale(DVec3::splat(1e-12));
    let scene = TestScene::new()
        .object(square(1.0, 0.0), matte(0.6))
        .placed(sphere(4), matte(0.5), Optics::default(), speck)
        .placed(sphere(4), lamp([1e12; 3]), Optics::default(), DMat4::from_translation(DVec3::X) * speck)
        .light(point([0.0, 2.0, 2.0], 7.0));
    pixels(&scene);
}
