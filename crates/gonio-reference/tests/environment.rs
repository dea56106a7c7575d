//! Panoramas and cube faces of a scene, and the environment's light.

#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat3, DMat4, DVec3, Vec3Swizzles};
use gonio_environment::cubemap::texel_direction;
use gonio_environment::prefilter::dominant_direction;
use gonio_environment::{BrdfTable, Cubemap, Face, Layout, Panorama};
use gonio_image::Image;
use gonio_light::microfacet::roughness_of_shininess;
use gonio_light::{Optics, Quantity};
use gonio_mesh::Material;
use gonio_reference::ReferenceScene;
use gonio_scene::scene_file::Shading;
use gonio_scene::{Camera, Maps, Picture};

const EYE: [f64; 3] = [0.3, -0.2, 0.4];

/// Six balls in the directions of the axes and a small one beside each, every one of another colour, and light that
/// comes from one side. The camera looks askew: it must not count.
fn room() -> TestScene {
    let mut lab = TestScene::new().light(directional([-1.0, -2.0, -0.5], 0.6)).frame(|f| {
        f.background.top = DVec3::new(0.2, 0.3, 0.6);
        f.background.bottom = DVec3::new(0.3, 0.2, 0.1);
        f.samples = 4;
    });
    for (i, axis) in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z].into_iter().enumerate() {
        let color =
            [[1.0, 0.1, 0.1], [0.1, 1.0, 1.0], [0.1, 1.0, 0.1], [1.0, 0.1, 1.0], [0.1, 0.1, 1.0], [1.0, 1.0, 0.1]];
        let aside = axis.zxy() * 1.9 + axis.yzx() * 0.9;
        for (offset, size, weight) in [(DVec3::ZERO, 1.2, 1.0), (aside, 1.0, 0.4)] {
            let material = Material { emitted: color[i].map(|v| 0.3 * weight * v), ..matte(color[i]) };
            let m =
                DMat4::from_translation(DVec3::from(EYE) + 3.5 * axis + offset) * DMat4::from_scale(DVec3::splat(size));
            lab = lab.placed(sphere(16, 24), Shading::Phong, material, Maps::default(), m);
        }
    }
    lab.eye(EYE, [1.0, 2.0, -3.0])
}

fn image(picture: Picture) -> Image {
    Image { width: picture.width, height: picture.height, pixels: picture.pixels }
}

/// Decibels under a peak of 1; the larger, the more alike.
fn psnr(pairs: impl Iterator<Item = (DVec3, DVec3)>) -> f64 {
    let (sum, count) = pairs.fold((0.0, 0.0), |(s, n), (a, b)| (s + (a - b).length_squared() / 3.0, n + 1.0));
    -10.0 * (sum / count).log10()
}

/// Faces of 64 texels in a layout.
fn faces(reference: &ReferenceScene, lab: &TestScene, layout: Layout) -> [Image; 6] {
    Face::ALL.map(|face| image(reference.cube_face(&lab.frame, face, layout, 64)))
}

#[test]
fn panorama_and_faces_are_the_same_world() {
    let lab = room();
    let reference = ReferenceScene::new(&lab.scene);
    let panorama = Panorama::new(image(reference.panorama(&lab.frame, 512, 256))).unwrap();
    let mut cubes = Vec::new();
    for layout in [Layout::OpenGl, Layout::Photographic] {
        let faces = faces(&reference, &lab, layout);
        for (face, drawn) in Face::ALL.into_iter().zip(&faces) {
            let against = |columns_flipped: bool, other: Face| {
                let pixels = (0..64 * 64).map(|i| (i % 64, i / 64));
                psnr(pixels.map(|(x, y)| {
                    let (s, t) = ((2.0 * f64::from(x) + 1.0) / 64.0 - 1.0, (2.0 * f64::from(y) + 1.0) / 64.0 - 1.0);
                    let d = other.direction(if columns_flipped { -s } else { s }, t, layout);
                    (rgb(drawn.at(x, y)), panorama.sample(d))
                }))
            };
            // Set by the edges of the balls, which lie between other pixels in the two pictures: measured 41 to 46.
            let right = against(false, face);
            assert!(right > 40.0, "{layout} {face:?}: {right} dB");
            // A mirrored face and every other face are far from it: measured at most 20.3.
            let mirrored = against(true, face);
            assert!(mirrored < 22.0, "{layout} {face:?}: mirrored {mirrored} dB");
            for other in Face::ALL.into_iter().filter(|other| *other != face) {
                let swapped = against(false, other);
                assert!(swapped < 22.0, "{layout} {face:?} as {other:?}: {swapped} dB");
            }
        }
        cubes.push(Cubemap::from_faces(faces, layout).unwrap());
    }
    // The other way: the panorama's pixels in the cube; and one cube whichever layout its faces were drawn in.
    let pixels = (0..512 * 256).map(|i| (i % 512, i / 512));
    let of_cube = psnr(pixels.map(|(x, y)| {
        let d = gonio_environment::panorama::direction((f64::from(x) + 0.5) / 512.0, (f64::from(y) + 0.5) / 256.0);
        (rgb(panorama.image.at(x, y)), cubes[0].sample(d))
    }));
    // The faces are the coarser ones here: an edge is as wide as their texels.
    assert!(of_cube > 29.0, "{of_cube} dB");
    let both = cubes[0].pixels().iter().zip(cubes[1].pixels()).map(|(a, b)| (rgb(*a), rgb(*b)));
    // Their samples lie mirrored in the pixels: only edges differ.
    let both = psnr(both);
    assert!(both > 35.0, "{both} dB");
}

#[test]
fn a_face_is_what_a_camera_sees() {
    let lab = room().frame(|f| f.samples = 1);
    let reference = ReferenceScene::new(&lab.scene);
    for face in Face::ALL {
        let axis = |s, t| face.direction(s, t, Layout::Photographic);
        let (front, up) = (axis(0.0, 0.0), axis(0.0, -1.0) - axis(0.0, 0.0));
        let mut frame = lab.frame.clone();
        (frame.width, frame.height) = (64, 64);
        let fov = std::f64::consts::FRAC_PI_2;
        frame.camera = Camera::looking_along(EYE.into(), front, up, fov, 0.1, 100.0);
        // A camera's background follows its picture, not the world.
        frame.background.bottom = frame.background.top;
        let seen = reference.render(&frame, None, &|_| ()).picture;
        let drawn = reference.cube_face(&frame, face, Layout::Photographic, 64);
        for (a, b) in drawn.pixels.iter().zip(&seen.pixels) {
            // The same rays but for rounding; no pixel's centre lies on an edge.
            assert!(rgb(*a).abs_diff_eq(rgb(*b), 1e-5), "{face:?}: {a:?} is not {b:?}");
        }
    }
}

#[test]
fn an_environment_comes_back_as_it_was() {
    let lab = TestScene::new().environment(compass()).eye(EYE, [1.0, 2.0, -3.0]);
    let reference = ReferenceScene::new(&lab.scene);
    let drawn = reference.panorama(&lab.frame, 64, 32);
    let expected = Panorama::from_function(64, 32, on_cube);
    let mut compared = 0;
    for (i, (got, expected)) in drawn.pixels.iter().zip(&expected.image.pixels).enumerate() {
        let (x, y) = ((i % 64) as f64 + 0.5, (i / 64) as f64 + 0.5);
        if is_exact(gonio_environment::panorama::direction(x / 64.0, y / 32.0)) {
            // f32 of texels and of pixels.
            assert!(rgb(*got).abs_diff_eq(rgb(*expected), 1e-6), "{i}");
            compared += 1;
        }
    }
    assert!(compared > 1500, "{compared}");
    for layout in [Layout::OpenGl, Layout::Photographic] {
        let faces = Face::ALL.map(|face| image(reference.cube_face(&lab.frame, face, layout, COMPASS_SIZE)));
        let back = Cubemap::from_faces(faces, layout).unwrap();
        for face in Face::ALL {
            for (x, y) in (0..COMPASS_SIZE).flat_map(|y| (0..COMPASS_SIZE).map(move |x| (x, y))) {
                let expected = on_cube(texel_direction(face, x, y, COMPASS_SIZE));
                assert!(rgb(back.at(face, x, y)).abs_diff_eq(expected, 1e-6), "{layout} {face:?} {x},{y}");
            }
        }
    }
}

#[test]
fn large_pixels_show_smaller_copies() {
    let map = Cubemap::from_function(256, |d| (40.0 * d).map(|v| v.sin()) + 1.0);
    let mips = gonio_environment::CubeMips::new(map.clone());
    let lab = TestScene::new().environment(map).frame(|f| f.texture_filter = gonio_scene::TextureFilter::Mipmap);
    let reference = ReferenceScene::new(&lab.scene);
    // What a pixel in the middle covers, in texels of the full copy.
    let panorama = reference.panorama(&lab.frame, 80, 40).at(13, 17);
    let direction = gonio_environment::panorama::direction(13.5 / 80.0, 17.5 / 40.0);
    let expected = mips.sample(direction, (128.0 * std::f64::consts::PI / 40.0).log2());
    assert!(rgb(panorama).abs_diff_eq(expected, 1e-6), "{panorama:?} is not {expected}");
    let face = reference.cube_face(&lab.frame, Face::PosY, Layout::OpenGl, 48).at(13, 17);
    let expected = mips.sample(texel_direction(Face::PosY, 13, 17, 48), (256.0 / 48.0_f64).log2());
    assert!(rgb(face).abs_diff_eq(expected, 1e-6), "{face:?} is not {expected}");
}

#[test]
fn nothing_in_front_of_the_eye_is_cut_off() {
    let lab = TestScene::new()
        .object(square(0.01, 4.95), Shading::Flat, Material { emitted: [1.0; 3], ..matte([0.0; 3]) })
        .object(square(1e4, -1e3), Shading::Flat, Material { emitted: [0.5; 3], ..matte([0.0; 3]) });
    // Nearer than 0.1, farther than 100: in a picture neither is seen.
    assert_eq!(lab.middle()[0], 0.0);
    let reference = ReferenceScene::new(&lab.scene);
    let face = reference.cube_face(&lab.frame, Face::NegZ, Layout::OpenGl, 65);
    assert_eq!((face.at(32, 32)[0], face.at(0, 0)[0]), (1.0, 0.5));
    let panorama = reference.panorama(&lab.frame, 65, 33);
    assert_eq!((panorama.at(32, 16)[0], panorama.at(28, 16)[0], panorama.at(0, 16)[0]), (1.0, 0.5, 0.0));
}

#[test]
fn layers_optics_and_closed_objects_are_as_in_pictures() {
    let ball = |x: f64| DMat4::from_translation(DVec3::new(x, 0.1, 0.0));
    let pane = |opacity| Material { opacity, ..Material::default() };
    let maps = || Maps { diffuse: bound(0), ..Maps::default() };
    let lab = TestScene::new()
        .texture(
            2,
            2,
            &[255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 90, 90, 90, 255],
            gonio_scene::ColorSpace::Srgb,
        )
        .placed(sphere(8, 12), Shading::Gouraud, Material::default(), Maps::default(), ball(-1.1))
        .closed()
        .placed(sphere(8, 12), Shading::Flat, Material::default(), Maps::default(), ball(1.1))
        .optics(Optics { transmission: 0.8, surfaces: gonio_light::Surfaces::Two, ..Optics::default() })
        .placed(square(0.8, 1.5), Shading::Phong, pane(0.4), maps(), DMat4::IDENTITY)
        .placed(square(0.8, 1.8), Shading::Phong, pane(0.6), maps(), ball(0.4))
        // Askew through the first ball: half of it is behind.
        .placed(square(0.9, 0.0), Shading::Phong, pane(0.5), maps(), ball(-1.1) * DMat4::from_rotation_y(1.0))
        .light(directional([-1.0, -0.5, -1.0], 0.7))
        .environment(compass())
        .frame(|f| {
            (f.width, f.height) = (64, 64);
            f.camera.fov_y_rad = std::f64::consts::FRAC_PI_2;
            // Not anisotropic: where a pane lies parallel to the picture, rounding decides between one sample and two.
            f.texture_filter = gonio_scene::TextureFilter::Mipmap;
        });
    let reference = ReferenceScene::new(&lab.scene);
    let face = reference.cube_face(&lab.frame, Face::PosZ, Layout::Photographic, 64);
    let picture = lab.draw().picture;
    let mut on_objects = 0;
    for (a, b) in face.pixels.iter().zip(&picture.pixels) {
        assert!(rgb(*a).abs_diff_eq(rgb(*b), 1e-5), "{a:?} is not {b:?}");
        on_objects += u32::from(a[2] > -0.5);
    }
    assert!(on_objects > 200, "{on_objects}");
}

/// f32 of texels and of the picture.
const ROUNDING: f64 = 1e-6;

const SHADINGS: [Shading; 4] = [Shading::Flat, Shading::FlatPerFace, Shading::Gouraud, Shading::Phong];

fn lit(lab: TestScene, intensity: f64) -> TestScene {
    lab.frame(|f| {
        let surroundings = f.surroundings.as_mut().unwrap();
        (surroundings.lights, surroundings.intensity) = (true, intensity);
    })
}

fn gloss(shininess: f32) -> Material {
    Material { specular: [0.5, 0.25, 0.125], shininess, ..matte([0.5, 0.25, 1.0]) }
}

#[test]
fn even_light_is_multiplied_by_the_material() {
    for shading in SHADINGS {
        let even = |material| {
            // Something that shines is in every scene, here out of sight.
            let lab = TestScene::new().object(square(0.1, 9.0), shading, gloss(10.0));
            let lab = lab.object(square(9.0, 0.0), shading, material);
            lit(lab.environment(Cubemap::new(4, [1.0, 1.0, 0.5, 1.0])), 2.0)
        };
        let near = |got: DVec3, expected: DVec3| {
            assert!(got.abs_diff_eq(expected, ROUNDING), "{shading}: {got} not {expected}")
        };
        let light = DVec3::new(2.0, 2.0, 1.0);
        // The irradiance is pi; a black k_s is matte, whatever its shininess.
        let lab = even(matte([0.5, 0.25, 1.0]));
        near(DVec3::from_slice(&lab.middle()), light * DVec3::new(0.5, 0.25, 1.0));
        near(lab.middle_of(Quantity::EnvironmentDiffuse), light * DVec3::new(0.5, 0.25, 1.0));
        near(lab.middle_of(Quantity::EnvironmentSpecular), DVec3::ZERO);
        // Seen along the normal.
        let lab = even(gloss(10.0));
        let (scale, bias) = BrdfTable::get().lookup(1.0, roughness_of_shininess(10.0));
        let specular = light * (DVec3::new(0.5, 0.25, 0.125) * scale + bias);
        near(lab.middle_of(Quantity::EnvironmentSpecular), specular);
        near(DVec3::from_slice(&lab.middle()), specular + light * DVec3::new(0.5, 0.25, 1.0));
        // Exponents below 1 count as 1, as in the light equation.
        let specular_of = |shininess| even(gloss(shininess)).middle_of(Quantity::EnvironmentSpecular);
        assert_eq!(specular_of(0.0), specular_of(1.0), "{shading}");
        // The reflection replaces all lit terms.
        let lab = lab.optics(Optics { reflectivity: 0.25, ..Optics::default() });
        let expected = 0.75 * (specular + light * DVec3::new(0.5, 0.25, 1.0)) + 0.25 * light;
        near(DVec3::from_slice(&lab.middle()), expected);
        // Each by its switch, and both by the environment's.
        let lab = lab.optics(Optics::default()).frame(|f| f.equation.terms.diffuse = false);
        near(DVec3::from_slice(&lab.middle()), specular);
        let lab = lab.frame(|f| (f.equation.terms.diffuse, f.equation.terms.specular) = (true, false));
        near(DVec3::from_slice(&lab.middle()), light * DVec3::new(0.5, 0.25, 1.0));
        let lab = lab.frame(|f| f.surroundings.as_mut().unwrap().lights = false);
        near(DVec3::from_slice(&lab.middle()), DVec3::ZERO);
    }
}

#[test]
fn light_comes_from_where_the_environment_is_bright() {
    let turn = DMat3::from_rotation_y(0.4) * DMat3::from_rotation_x(-0.3);
    let map = Cubemap::from_function(64, |d| DVec3::ONE + d);
    for shading in SHADINGS {
        let lab = TestScene::new().object(sphere(12, 18), shading, gloss(40.0)).environment(map.clone());
        let lab = lit(lab, 1.5).frame(|f| f.surroundings.as_mut().unwrap().environment_from_world = turn);
        let glossy = lab.scene.environment.as_ref().unwrap().glossy();
        let reference = ReferenceScene::new(&lab.scene);
        let pictures = [Quantity::EnvironmentDiffuse, Quantity::EnvironmentSpecular].map(|q| lab.show(q).picture);
        let mut compared = 0;
        for (x, y) in (0..33).flat_map(|y| (0..33).map(move |x| (x, y))) {
            let Some(probe) = reference.probe(&lab.frame, x, y) else { continue };
            let n = shading_normal(&lab, &probe, shading);
            // Of 1 + d under a cosine: pi + 2/3 pi n.
            let diffuse = 1.5 * DVec3::new(0.5, 0.25, 1.0) * (DVec3::ONE + 2.0 / 3.0 * (turn * n));
            let got = rgb(pictures[0].at(x, y));
            // Texels of 64 an edge for an integral.
            assert!(got.abs_diff_eq(diffuse, 1e-3), "{shading} {x},{y}: {got} is not {diffuse}");
            let (v, roughness) = (-ray_of(&lab, x, y), roughness_of_shininess(40.0));
            let (scale, bias) = BrdfTable::get().lookup(n.dot(v).max(0.0), roughness);
            let about = glossy.sample(turn * dominant_direction(n, v, roughness), roughness);
            let specular = 1.5 * (DVec3::new(0.5, 0.25, 0.125) * scale + bias) * about;
            let got = rgb(pictures[1].at(x, y));
            assert!(got.abs_diff_eq(specular, ROUNDING), "{shading} {x},{y}: {got} is not {specular}");
            let seen = probe.terms.environment;
            assert!(probe.radiance.abs_diff_eq(probe.lit + seen.diffuse + seen.specular, 1e-12));
            compared += 1;
        }
        assert!(compared > 100, "{shading}: {compared}");
    }
}

#[test]
fn a_blurred_background_is_that_of_a_rough_mirror() {
    let map = Cubemap::from_function(64, |d| (9.0 * d).map(|v| v.sin()) + 1.0);
    for filter in [gonio_scene::TextureFilter::Linear, gonio_scene::TextureFilter::Mipmap] {
        let lab = TestScene::new().environment(map.clone()).frame(|f| {
            let surroundings = f.surroundings.as_mut().unwrap();
            (surroundings.blur, surroundings.intensity) = (0.4, 0.5);
            f.texture_filter = filter;
        });
        let environment = lab.scene.environment.clone().unwrap();
        let picture = lab.draw().picture;
        for (x, y) in [(0, 0), (16, 16), (31, 7)] {
            let (got, expected) =
                (rgb(picture.at(x, y)), 0.5 * environment.seen_glossy().sample(ray_of(&lab, x, y), 0.4));
            assert!(got.abs_diff_eq(expected, ROUNDING), "{filter} {x},{y}: {got} is not {expected}");
            let sharp = 0.5 * environment.seen().sample(ray_of(&lab, x, y), 0.0);
            assert!(!got.abs_diff_eq(sharp, 0.01), "{x},{y} is not blurred");
        }
    }
}
