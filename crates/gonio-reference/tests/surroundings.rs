//! The environment behind the objects and in mirrors: its orientation, and how it is mixed.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat3, DMat4, DVec3};
use gonio_environment::{CubeMips, Cubemap};
use gonio_light::{Fresnel, Optics, Quantity, vector};
use gonio_mesh::Material;
use gonio_reference::ReferenceScene;
use gonio_scene::scene_file::Shading;
use gonio_scene::{LoadedEnvironment, Maps, TextureFilter, ViewSpec};
use std::sync::Arc;

/// f32 of texels and of the picture.
const ROUNDING: f64 = 1e-6;

const MIRROR: fn() -> Optics = || Optics { reflectivity: 1.0, ..Optics::default() };

/// Each pixel's colour and direction, if `expected` gives what it should be.
fn compare(lab: &TestScene, expected: impl Fn(DVec3) -> Option<DVec3>) -> u32 {
    let picture = lab.draw().picture;
    let mut compared = 0;
    for (x, y) in (0..lab.frame.height).flat_map(|y| (0..lab.frame.width).map(move |x| (x, y))) {
        let direction = ray_of(lab, x, y);
        let Some(expected) = expected(direction) else { continue };
        let got = rgb(picture.at(x, y));
        assert!(got.abs_diff_eq(expected, ROUNDING), "{x},{y} along {direction}: {got} is not {expected}");
        assert_eq!(picture.at(x, y)[3], 1.0);
        compared += 1;
    }
    compared
}

#[test]
fn the_sky_lies_where_the_world_has_it() {
    let lab = TestScene::new().environment(compass());
    // Looking along -Z: that is ahead, +X is on the right, +Y is above.
    let picture = lab.draw().picture;
    let at = |x, y| rgb(picture.at(x, y));
    assert!(at(16, 16).abs_diff_eq(DVec3::NEG_Z, ROUNDING), "{}", at(16, 16));
    assert!(at(32, 16).x > 0.3 && at(32, 16).y.abs() < ROUNDING, "{}", at(32, 16));
    assert!(at(16, 0).y > 0.3 && at(16, 0).x.abs() < ROUNDING, "{}", at(16, 0));
    for target in [[1.0, 0.0, 0.0], [-1.0, 0.2, 0.1], [0.0, 1.0, 0.1], [0.0, -1.0, 0.0], [0.3, 0.1, 1.0]] {
        // Wherever the eye is: it only turns.
        let eye = [3.0, -2.0, 1.0];
        let lab = TestScene::new().environment(compass());
        let lab = lab.eye(eye, (DVec3::from(eye) + DVec3::from(target)).to_array());
        assert!(compare(&lab, |d| is_exact(d).then(|| on_cube(d))) > 500, "{target:?}");
    }
}

#[test]
fn it_is_turned_and_made_brighter() {
    let turn = DMat3::from_rotation_y(0.4) * DMat3::from_rotation_x(-0.3);
    let lab = TestScene::new().environment(compass()).frame(|f| {
        let surroundings = f.surroundings.as_mut().unwrap();
        surroundings.environment_from_world = turn;
        surroundings.intensity = 2.5;
    });
    let expected = |d: DVec3| is_exact(turn * d).then(|| 2.5 * on_cube(turn * d));
    assert!(compare(&lab, expected) > 500);
    let mirror = lab.object(square(9.0, 0.0), Shading::Flat, Material::default()).optics(MIRROR());
    assert!(compare(&mirror, |d| expected(d * DVec3::new(1.0, 1.0, -1.0))) > 500);
}

#[test]
fn the_background_may_be_another_environment_or_none() {
    let red = Cubemap::new(1, [1.0, 0.0, 0.0, 1.0]);
    let both = LoadedEnvironment::new("test", compass()).with_background(red);
    let mut lab = TestScene::new()
        .object(square(1.0, 0.0), Shading::Flat, Material::default())
        .optics(MIRROR())
        .environment(compass());
    lab.scene.environment = Some(Arc::new(both));
    let corner = |lab: &TestScene| lab.draw().picture.at(0, 0);
    assert_eq!(corner(&lab), [1.0, 0.0, 0.0, 1.0]);
    assert!(rgb(lab.draw().picture.at(16, 16)).abs_diff_eq(DVec3::Z, ROUNDING), "mirrors show the first");
    // The background's transparency is only that of the background.
    let lab = lab.frame(|f| {
        f.background.top = DVec3::Y;
        f.background.bottom = DVec3::Y;
        f.background.transparent = true;
    });
    assert_eq!(corner(&lab), [1.0, 0.0, 0.0, 1.0]);
    let lab = lab.frame(|f| f.surroundings.as_mut().unwrap().visible = false);
    assert_eq!(corner(&lab), [0.0; 4]);
    assert!(rgb(lab.draw().picture.at(16, 16)).abs_diff_eq(DVec3::Z, ROUNDING), "unseen, it is mirrored still");
    let lab = lab.frame(|f| f.background.transparent = false);
    assert_eq!(corner(&lab), [0.0, 1.0, 0.0, 1.0]);
}

#[test]
fn mirrors_show_what_is_in_front_of_them() {
    // Turned about the vertical axis, and leaning.
    for m in [DMat4::IDENTITY, DMat4::from_rotation_y(0.6), DMat4::from_rotation_x(-0.5) * DMat4::from_rotation_y(0.2)]
    {
        for shading in [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong] {
            let lab = TestScene::new()
                .placed(square(9.0, 0.0), shading, Material::default(), Maps::default(), m)
                .optics(MIRROR())
                .environment(compass());
            let n = m.transform_vector3(DVec3::Z);
            let seen = compare(&lab, |d| {
                let mirrored = d - 2.0 * d.dot(n) * n;
                is_exact(mirrored).then(|| on_cube(mirrored))
            });
            assert!(seen > 500, "{shading}: {seen}");
        }
    }
}

#[test]
fn curved_mirrors_take_the_normal_that_the_shading_has() {
    for shading in [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong] {
        let lab =
            TestScene::new().object(sphere(6, 9), shading, Material::default()).optics(MIRROR()).environment(compass());
        let (reference, picture) = (ReferenceScene::new(&lab.scene), lab.draw().picture);
        let mut compared = 0;
        for (x, y) in (8..25).flat_map(|y| (8..25).map(move |x| (x, y))) {
            let Some(probe) = reference.probe(&lab.frame, x, y) else { continue };
            let n = shading_normal(&lab, &probe, shading);
            let mirrored = vector::reflection(n, -ray_of(&lab, x, y));
            if is_exact(mirrored) {
                let got = rgb(picture.at(x, y));
                assert!(got.abs_diff_eq(on_cube(mirrored), ROUNDING), "{shading} {x},{y}: {got}");
                compared += 1;
            }
        }
        assert!(compared > 100, "{shading}: {compared}");
    }
}

#[test]
fn the_sky_is_seen_through_transparent_surfaces() {
    let pane = Material { opacity: 0.4, emitted: [0.5, 0.25, 1.0], ..matte([0.0; 3]) };
    let lab = TestScene::new().object(square(9.0, 0.0), Shading::Flat, pane).environment(compass());
    // f32 of the material's numbers.
    let expected = |d: DVec3| f64::from(0.4_f32) * DVec3::new(0.5, 0.25, 1.0) + (1.0 - f64::from(0.4_f32)) * on_cube(d);
    assert!(compare(&lab, |d| is_exact(d).then(|| expected(d))) > 500);
}

/// A ball, half mirror, half glass, lit; all views of one pixel add up to the picture.
fn mixed(shading: Shading) -> TestScene {
    let optics = Optics {
        reflectivity: 0.3,
        transmission: 0.6,
        fresnel: Fresnel::Exact,
        tint: DVec3::new(1.0, 0.9, 0.5),
        dispersion: 0.1,
        surfaces: gonio_light::Surfaces::Two,
        ..Optics::default()
    };
    let material = Material { emitted: [0.1, 0.05, 0.2], ..Material::default() };
    TestScene::new()
        .object(sphere(12, 18), shading, material)
        .optics(optics)
        .object(square(0.5, 1.5), shading, Material { opacity: 0.4, ..Material::default() })
        .optics(MIRROR())
        .light(ambient(0.2))
        .light(directional([-1.0, -0.5, -1.0], 0.7))
        .environment(Cubemap::from_function(16, |d| DVec3::splat(1.5) + d * DVec3::new(1.0, 0.5, 1.5)))
}

#[test]
fn the_views_add_up_to_the_picture() {
    for shading in [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong] {
        let mut lab = mixed(shading);
        // The ball alone.
        lab.scene.objects.truncate(1);
        let quantities = [
            Quantity::Ambient,
            Quantity::Emitted,
            Quantity::Diffuse,
            Quantity::Specular,
            Quantity::Reflected,
            Quantity::Transmitted,
            Quantity::Fresnel,
            Quantity::Total,
        ];
        let views = quantities.map(|quantity| ViewSpec { quantity, light: None });
        let drawn = ReferenceScene::new(&lab.scene).views(&lab.frame, &views, &|_| ());
        let mut on_ball = 0;
        for i in 0..33 * 33 {
            let v: Vec<DVec3> = drawn.iter().map(|d| rgb(d.picture.pixels[i])).collect();
            let [reflected, transmitted, fresnel, total] = [v[4], v[5], v[6], v[7]];
            if fresnel == DVec3::ZERO {
                // Views of light are black beside the objects, the picture shows the sky there.
                assert!(reflected == DVec3::ZERO && total != DVec3::ZERO);
                assert_eq!((drawn[4].picture.pixels[i][3], drawn[6].picture.pixels[i][3]), (1.0, 0.0));
                continue;
            }
            let (lit, w) = (v[0] + v[1] + v[2] + v[3], 0.3 * fresnel.y);
            let expected = 0.4 * ((1.0 - w) * lit + w * reflected) + 0.6 * (fresnel * reflected + transmitted);
            assert!(total.abs_diff_eq(expected, ROUNDING), "{shading} {i}: {total} is not {expected}");
            on_ball += 1;
        }
        assert!(on_ball > 100, "{shading}: {on_ball}");
    }
}

#[test]
fn the_probe_agrees_with_the_picture() {
    for shading in [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong] {
        let lab = mixed(shading);
        let reference = ReferenceScene::new(&lab.scene);
        let picture = lab.draw().picture;
        let (mut hits, mut beside) = (0, 0);
        for (x, y) in (0..33).flat_map(|y| (0..33).map(move |x| (x, y))) {
            let pixel = picture.at(x, y);
            let Some(probe) = reference.probe(&lab.frame, x, y) else {
                let behind = reference.behind(&lab.frame, x, y).map(|v| v as f32);
                // One rounding in another place.
                assert!(rgb(behind).abs_diff_eq(rgb(pixel), 3e-7) && behind[3] == 1.0, "{x},{y}: {behind:?} {pixel:?}");
                beside += 1;
                continue;
            };
            assert_eq!(probe.total.to_array().map(|v| v as f32), pixel, "{shading} {x},{y}");
            let seen = probe.terms.environment;
            let composed = probe.optics.compose(probe.lit + seen.diffuse + seen.specular, &seen.sight);
            assert_eq!(composed, probe.radiance, "{shading} {x},{y}");
            assert!(probe.radiance != probe.lit);
            if matches!(shading, Shading::Flat | Shading::Phong) {
                assert!(probe.terms.total.abs_diff_eq(probe.radiance, 1e-12));
            }
            hits += 1;
        }
        assert!(hits > 100 && beside > 100, "{shading}: {hits} {beside}");
    }
}

#[test]
fn without_an_environment_mirrors_and_glass_are_lit_surfaces() {
    for optics in [MIRROR(), Optics { transmission: 1.0, ..Optics::default() }] {
        let plain = TestScene::new()
            .object(sphere(12, 18), Shading::Phong, Material::default())
            .light(directional([-1.0, -0.5, -1.0], 0.7));
        let before = plain.draw();
        let lab = plain.optics(optics);
        assert_eq!(lab.draw(), before);
        let probe = ReferenceScene::new(&lab.scene).probe(&lab.frame, 16, 16).unwrap();
        assert!(probe.optics.is_plain() && probe.radiance == probe.lit);
        // The other way round: an environment that is not seen changes no plain surface.
        let unseen = lab.environment(compass()).optics(Optics::default());
        let unseen = unseen.frame(|f| f.surroundings.as_mut().unwrap().visible = false);
        assert_eq!(unseen.draw(), before);
    }
}

#[test]
fn the_number_of_threads_does_not_change_the_bytes() {
    let lab = mixed(Shading::Phong).frame(|f| f.samples = 4);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let drawn = [1, 3].map(|threads| {
        pool(threads).install(|| (lab.draw(), ReferenceScene::new(&lab.scene).panorama(&lab.frame, 40, 20)))
    });
    assert_eq!(drawn[0], drawn[1]);
}

#[test]
fn smaller_copies_are_looked_up_as_far_as_directions_turn() {
    // Large enough that a pixel covers several texels, and no two texels alike.
    let map = Cubemap::from_function(512, |d| (40.0 * d).map(|v| v.sin()) + 1.0);
    let mips = CubeMips::new(map.clone());
    let filters = |filter| move |f: &mut gonio_scene::Frame| f.texture_filter = filter;
    let level = |step: f64| (256.0 * step).log2();
    let far = |lab: &TestScene, x: u32, y: u32, of: &dyn Fn(DVec3) -> DVec3| {
        let at = |x, y| of(ray_of(lab, x, y));
        level(at(x, y).distance(at(x + 1, y)).max(at(x, y).distance(at(x, y + 1))))
    };
    let across = |n: DVec3| move |d: DVec3| d - 2.0 * d.dot(n) * n;
    let into = |d: DVec3| vector::refraction(DVec3::Z, -d, 1.0 / 1.5).unwrap();
    let pane = |optics| {
        TestScene::new().object(square(9.0, 0.0), Shading::Phong, Material::default()).optics(optics).index(1.5)
    };
    let glass = Optics { transmission: 1.0, ..Optics::default() };
    let sky_level = level(2.0 * (20f64.to_radians()).tan() / 33.0);
    assert!(sky_level > 1.0, "{sky_level}");
    for filter in [TextureFilter::Nearest, TextureFilter::Linear, TextureFilter::Mipmap, TextureFilter::Anisotropic] {
        let has_levels = matches!(filter, TextureFilter::Mipmap | TextureFilter::Anisotropic);
        let labs =
            [TestScene::new(), pane(MIRROR()), pane(glass)].map(|l| l.environment(map.clone()).frame(filters(filter)));
        for (x, y) in [(16, 16), (3, 20), (30, 1)] {
            let d = ray_of(&labs[0], x, y);
            let (mirrored, bent) = (across(DVec3::Z)(d), into(d));
            let expected = [
                (d, sky_level),
                (mirrored, far(&labs[1], x, y, &across(DVec3::Z))),
                (bent, far(&labs[2], x, y, &into)),
            ];
            for (lab, (direction, level)) in labs.iter().zip(expected) {
                let level = if has_levels { level } else { 0.0 };
                let (got, expected) = (rgb(lab.draw().picture.at(x, y)), mips.sample(direction, level));
                assert!(got.abs_diff_eq(expected, ROUNDING), "{filter} {x},{y}: {got} is not {expected} of {level}");
            }
        }
    }
}
