//! The material at a fragment: numbers, textures and their footprint, vertex colours, normal maps, transparency.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DVec3};
use gonio_light::{Quantity, Specular};
use gonio_mesh::Material;
use gonio_reference::{MAX_LAYERS, Probe, ReferenceScene};
use gonio_scene::scene_file::Shading;
use gonio_scene::{ColorSpace, Frame, Maps, Picture, TextureFilter};

fn glowing(color: [f32; 3], opacity: f32) -> Material {
    Material { emitted: color, opacity, ..with_ambient(matte([0.0; 3]), 0.0) }
}

fn probe(lab: &TestScene) -> Probe {
    ReferenceScene::new(&lab.scene).probe(&lab.frame, lab.frame.width / 2, lab.frame.height / 2).unwrap()
}

/// One texel, data: the value is byte / 255.
const GREY: [u8; 4] = [51, 102, 204, 255];

#[test]
fn maps_multiply_the_numbers_of_the_same_name() {
    let maps = Maps {
        roughness: None,
        diffuse: bound(0),
        specular: bound(0),
        emitted: bound(0),
        shininess: bound(0),
        opacity: bound(0),
        normal: None,
    };
    let mut mesh = square(2.0, 0.0);
    mesh.colors = vec![[0.5, 1.0, 0.25, 0.1]; 4];
    let material = Material {
        diffuse: [1.0, 0.5, 0.5],
        specular: [0.5, 0.5, 1.0],
        emitted: [2.0, 3.0, 4.0],
        shininess: 100.0,
        opacity: 0.5,
        refraction_index: 1.33,
        ..Material::default()
    };
    let lab = TestScene::new().texture(1, 1, &GREY, ColorSpace::Data).placed(
        mesh,
        Shading::Phong,
        material,
        maps,
        DMat4::IDENTITY,
    );
    let probe = probe(&lab);
    let texel = DVec3::new(0.2, 0.4, 0.8);
    let close = |a: DVec3, b: DVec3| a.distance(b) < 1e-6; // f32 of the material
    let s = probe.surface;
    assert!(close(s.diffuse, DVec3::new(1.0, 0.5, 0.5) * DVec3::new(0.5, 1.0, 0.25) * texel), "{s:?}");
    assert_eq!(s.ambient, s.diffuse);
    assert!(
        close(s.specular, DVec3::new(0.5, 0.5, 1.0) * texel) && close(s.emitted, DVec3::new(2.0, 3.0, 4.0) * texel)
    );
    assert!(near(s.shininess, 20.0, 1e-6) && near(s.refraction_index, 1.33, 1e-6) && near(probe.opacity, 0.1, 1e-6));
    assert_eq!(
        probe.texels.iter().map(|t| t.map).collect::<Vec<_>>(),
        ["diffuse", "specular", "emitted", "shininess", "opacity"]
    );
    assert!(probe.texels.iter().all(|t| close(t.value.truncate(), texel) && t.texture == "test"));
}

#[test]
fn ambient_follows_diffuse_or_is_a_value() {
    let of = |material: Material| {
        TestScene::new().object(square(2.0, 0.0), Shading::Phong, material).light(ambient(0.5)).middle()
    };
    assert!(near(of(matte([0.2, 0.4, 0.8]))[2], 0.4, 1e-6));
    assert!(near(of(with_ambient(matte([0.2, 0.4, 0.8]), 0.6))[2], 0.3, 1e-6));
}

/// A picture of four texels: red, green over blue, white.
#[test]
fn texture_coordinates_are_scaled_then_shifted() {
    let rgba = [255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255];
    let lab = |scale: [f32; 2], offset: [f32; 2]| {
        let mut maps = Maps { emitted: bound(0), ..Maps::default() };
        maps.emitted.as_mut().unwrap().scale = scale;
        maps.emitted.as_mut().unwrap().offset = offset;
        TestScene::new().texture(2, 2, &rgba, ColorSpace::Data).placed(
            square(2.0, 0.0),
            Shading::Phong,
            glowing([1.0; 3], 1.0),
            maps,
            DMat4::IDENTITY,
        )
    };
    let corners = |lab: TestScene| {
        let p = lab.draw().picture;
        [p.at(2, 2), p.at(30, 2), p.at(2, 30), p.at(30, 30)].map(|p| [p[0] as u8, p[1] as u8, p[2] as u8])
    };
    let (red, green, blue, white) = ([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]);
    assert_eq!(corners(lab([1.0, 1.0], [0.0, 0.0])), [red, green, blue, white]);
    assert_eq!(corners(lab([1.0, 1.0], [0.5, 0.0])), [green, red, white, blue]);
    assert_eq!(corners(lab([-1.0, 1.0], [0.0, 0.5])), [white, blue, green, red]);
    assert_eq!(corners(lab([0.5, 0.5], [0.5, 0.5])), [green; 4]);
}

/// A checkerboard of single texels, far smaller than a pixel: its mean, unless the filter takes one texel.
#[test]
fn footprints_reach_the_filter() {
    let rgba: Vec<u8> = (0..64 * 64).flat_map(|i| [if (i + i / 64) % 2 == 0 { 255u8 } else { 0 }, 0, 0, 255]).collect();
    let mut maps = Maps { emitted: bound(0), ..Maps::default() };
    maps.emitted.as_mut().unwrap().scale = [40.0, 40.0];
    let lab = TestScene::new().texture(64, 64, &rgba, ColorSpace::Data).placed(
        square(2.0, 0.0),
        Shading::Phong,
        glowing([1.0; 3], 1.0),
        maps,
        DMat4::from_rotation_x(-1.2),
    );
    let reds = |filter: TextureFilter| -> Vec<f32> {
        let lab = TestScene {
            scene: lab.scene.clone(),
            frame: gonio_scene::Frame { texture_filter: filter, ..lab.frame.clone() },
        };
        (4..29).map(|x| lab.draw().picture.at(x, 16)[0]).collect()
    };
    // Mipmaps are rounded to 8 bits: 127.5 / 255 is one step off at most.
    assert!(reds(TextureFilter::Mipmap).iter().all(|r| (r - 0.5).abs() < 0.01));
    assert!(reds(TextureFilter::Nearest).iter().all(|r| *r == 0.0 || *r == 1.0));
}

/// Derivatives: one texel per pixel on a wall that faces the eye.
#[test]
fn the_footprint_is_that_of_a_pixel() {
    // 33 pixels high, 2 tan(20 deg) 5 world units; 4 units are one uv.
    let pixel_in_uv = 2.0 * 20f64.to_radians().tan() * 5.0 / 33.0 / 4.0;
    // Level 1 of a texture with 2 texels per pixel: `size` texels in uv 1.
    let size = 64;
    let rgba: Vec<u8> = (0..size * size).flat_map(|i| [if i % 2 == 0 { 255u8 } else { 0 }, 0, 0, 255]).collect();
    for (texels_per_pixel, mean) in [(0.99, false), (2.01, true)] {
        let mut maps = Maps { emitted: bound(0), ..Maps::default() };
        let scale = (texels_per_pixel / pixel_in_uv / f64::from(size)) as f32;
        maps.emitted.as_mut().unwrap().scale = [scale, scale];
        let lab = TestScene::new()
            .texture(size, size, &rgba, ColorSpace::Data)
            .placed(square(2.0, 0.0), Shading::Phong, glowing([1.0; 3], 1.0), maps, DMat4::IDENTITY)
            .frame(|f| f.texture_filter = TextureFilter::Mipmap);
        let picture = lab.draw().picture;
        let spread = (5..28).map(|x| (picture.at(x, 16)[0] - 0.5).abs()).fold(0.0, f32::max);
        assert_eq!(spread < 0.01, mean, "{texels_per_pixel}: {spread}");
    }
}

#[test]
fn normal_maps_tilt_the_normal_in_the_tangent_frame() {
    // x, y, z = 2 * byte / 255 - 1
    let texel = [204u8, 153, 230, 255];
    let v = DVec3::new(2.0 * 204.0 / 255.0 - 1.0, 2.0 * 153.0 / 255.0 - 1.0, 2.0 * 230.0 / 255.0 - 1.0).normalize();
    let lab = |handedness: f32, m: DMat4, shading: Shading| {
        let mut mesh = square(2.0, 0.0);
        // Not quite perpendicular to the normal: Gram-Schmidt must see to it.
        mesh.tangents = vec![[0.8, 0.0, 0.6, handedness]; 4];
        let maps = Maps { normal: bound(0), ..Maps::default() };
        TestScene::new().texture(1, 1, &texel, ColorSpace::Data).placed(mesh, shading, matte([0.5; 3]), maps, m)
    };
    let close = |a: DVec3, b: DVec3| a.distance(b) < 1e-6; // f32 of the picture
    let plain = DMat4::IDENTITY;
    assert!(close(lab(1.0, plain, Shading::Phong).middle_of(Quantity::Normal), v));
    assert!(close(lab(-1.0, plain, Shading::Phong).middle_of(Quantity::Normal), DVec3::new(v.x, -v.y, v.z)));
    // The tangent is the mesh's, perpendicular to the mapped normal.
    let t = DVec3::new(0.8, 0.0, 0.6);
    let tangent = lab(1.0, plain, Shading::Phong).middle_of(Quantity::Tangent);
    assert!(close(tangent, (t - v * v.dot(t)).normalize()), "{tangent}");
    // Without effect where the shading has no normal per fragment.
    assert!(close(lab(1.0, plain, Shading::Flat).middle_of(Quantity::Normal), DVec3::Z));
    assert!(close(lab(1.0, plain, Shading::Gouraud).middle_of(Quantity::Normal), DVec3::Z));
    assert!(close(lab(1.0, plain, Shading::Gouraud).middle_of(Quantity::Tangent), DVec3::X));
    // Turned with the object; mirrored with it.
    let turn = DMat4::from_rotation_z(0.5);
    assert!(close(lab(1.0, turn, Shading::Phong).middle_of(Quantity::Normal), turn.transform_vector3(v)));
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    assert!(close(lab(1.0, mirror, Shading::Phong).middle_of(Quantity::Normal), DVec3::new(-v.x, v.y, v.z)));
    // From behind N is turned first: N = -Z, T = X, B = N x T = -Y.
    let behind = lab(1.0, plain, Shading::Phong).eye([0.0, 0.0, -5.0], [0.0; 3]);
    assert!(close(behind.middle_of(Quantity::Normal), DVec3::new(v.x, -v.y, -v.z)));
}

#[test]
fn gloss_is_that_of_the_equation() {
    let lab = |shading| {
        TestScene::new()
            .object(square(2.0, 0.0), shading, Material { specular: [0.5; 3], shininess: 10.0, ..matte([0.0; 3]) })
            .light(directional([0.0, -0.6, -0.8], 1.0))
            .frame(|f| f.equation.specular = Specular::BlinnPhong)
    };
    // V = Z, L = (0, 0.6, 0.8): cos of half the angle, squared, is (1 + 0.8) / 2.
    let expected = 0.5 * 0.9f64.powf(5.0);
    assert!(
        near(lab(Shading::Phong).middle()[0], expected, 1e-6) && near(lab(Shading::Flat).middle()[0], expected, 1e-6)
    );
}

#[test]
fn transparent_surfaces_are_composited_from_front_to_back() {
    let red = || glowing([1.0, 0.0, 0.0], 0.5);
    let green = || glowing([0.0, 1.0, 0.0], 0.25);
    let blue = || glowing([0.0, 0.0, 1.0], 1.0);
    // Red in front of green in front of blue, drawn in several orders.
    let expected = [0.5, 0.5 * 0.25, 0.5 * 0.75, 1.0];
    let lab = |order: [usize; 3]| {
        order.iter().fold(TestScene::new(), |lab, &i| {
            let (z, material) = [(1.0, red()), (0.5, green()), (0.0, blue())][i].clone();
            lab.object(square(1.5, z), Shading::Flat, material)
        })
    };
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let value = lab(order).middle();
        assert!(value.iter().zip(expected).all(|(a, b)| near(*a, b, 1e-6)), "{value:?}");
    }
    assert_eq!(probe(&lab([2, 1, 0])).surfaces_behind, 2);
    // Every surface is seen, and so counted, wherever it is.
    let alone = |z: f32| TestScene::new().object(square(1.5, z), Shading::Flat, blue()).draw().fragments;
    assert_eq!(lab([0, 1, 2]).draw().fragments, alone(0.0) + alone(0.5) + alone(1.0));
    // In front of nothing: premultiplied alpha.
    let alone =
        TestScene::new().object(square(1.0, 0.0), Shading::Flat, red()).frame(|f| f.background.transparent = true);
    assert_eq!(alone.middle(), [0.5, 0.0, 0.0, 0.5]);
    // In front of a background.
    let grey = TestScene::new().object(square(1.0, 0.0), Shading::Flat, red()).frame(|f| {
        f.background.top = DVec3::ONE;
        f.background.bottom = DVec3::ONE;
    });
    assert_eq!(grey.middle(), [1.0, 0.5, 0.5, 1.0]);
    // Behind something opaque: not at all, where that hides everything and where it is one pixel large.
    for half in [1.0, 0.06] {
        let hidden = TestScene::new().object(square(half, 1.0), Shading::Flat, blue()).object(
            square(1.0, 0.0),
            Shading::Flat,
            red(),
        );
        assert_eq!((hidden.middle(), probe(&hidden).surfaces_behind), ([0.0, 0.0, 1.0, 1.0], 0));
    }
}

#[test]
fn holes_are_seen_through_in_pictures_and_in_views() {
    // The left half of the texture is cut out.
    let rgba = [0, 0, 0, 255, 255, 255, 255, 255];
    let maps = Maps { opacity: bound(0), ..Maps::default() };
    let lab = TestScene::new()
        .texture(2, 1, &rgba, ColorSpace::Data)
        .placed(square(1.0, 1.0), Shading::Phong, glowing([1.0, 0.0, 0.0], 1.0), maps, DMat4::IDENTITY)
        .object(square(2.0, 0.0), Shading::Phong, glowing([0.0, 1.0, 0.0], 1.0));
    let (picture, depth) = (lab.draw().picture, lab.show(Quantity::Depth).picture);
    assert_eq!((picture.at(12, 16), picture.at(20, 16)), ([0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]));
    assert_eq!((depth.at(12, 16)[0], depth.at(20, 16)[0]), (5.0, 4.0));
    let invisible = TestScene::new().object(square(2.0, 0.0), Shading::Phong, glowing([1.0; 3], 0.003));
    assert_eq!(invisible.middle(), [0.0, 0.0, 0.0, 1.0]);
    assert!(ReferenceScene::new(&invisible.scene).probe(&invisible.frame, 16, 16).is_none());
}

#[test]
fn layers_end_at_the_documented_number() {
    let lab = (0..MAX_LAYERS + 10).fold(TestScene::new(), |lab, i| {
        lab.object(square(1.0, -0.01 * i as f32), Shading::Flat, glowing([1.0; 3], 0.01))
    });
    let lab = lab.frame(|f| f.background.transparent = true);
    let expected = 1.0 - 0.99f64.powi(MAX_LAYERS as i32);
    assert!(near(lab.middle()[3], expected, 1e-6), "{:?} {expected}", lab.middle());
}

/// A glowing chequered plane that goes to the horizon; its squares become smaller than pixels on the way.
fn chequered_plane(filter: TextureFilter) -> TestScene {
    let square_of = |i: usize| (i % 64 / 8 + i / 64 / 8) % 2;
    let rgba: Vec<u8> = (0..64 * 64).flat_map(|i| [[230, 60][square_of(i)]; 3].into_iter().chain([255])).collect();
    let mut maps = Maps { emitted: bound(0), ..Maps::default() };
    maps.emitted.as_mut().unwrap().scale = [24.0, 24.0];
    let flat = DMat4::from_translation(DVec3::new(0.0, -1.0, 0.0)) * DMat4::from_rotation_x(-90f64.to_radians());
    let glowing = Material { emitted: [1.0; 3], ..with_ambient(matte([0.0; 3]), 0.0) };
    TestScene::new()
        .texture(64, 64, &rgba, ColorSpace::Data)
        .placed(square(48.0, 0.0), Shading::Phong, glowing, maps, flat)
        .frame(|f| (f.width, f.height, f.texture_filter) = (96, 64, filter))
}

/// The mean of `finer` times `finer` pixels for each.
fn reduced(picture: &Picture, finer: u32) -> Picture {
    let (width, height) = (picture.width / finer, picture.height / finer);
    let mean = |x: u32, y: u32| {
        let block = (0..finer * finer).map(|i| picture.at(x * finer + i % finer, y * finer + i / finer));
        let sum = block.fold([0.0; 4], |sum: [f32; 4], pixel| std::array::from_fn(|c| sum[c] + pixel[c]));
        sum.map(|channel| channel / (finer * finer) as f32)
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| mean(x, y)).collect();
    Picture { width, height, pixels }
}

/// The root of the mean square of the differences, in steps of 1/255.
fn rms_steps(a: &Picture, b: &Picture) -> f64 {
    let squares = a.pixels.iter().zip(&b.pixels).map(|(a, b)| f64::from(255.0 * (a[0] - b[0])).powi(2));
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt()
}

#[test]
fn more_samples_do_not_blur_a_texture_twice() {
    for filter in [TextureFilter::Mipmap, TextureFilter::Anisotropic] {
        let lab = chequered_plane(filter);
        // Single samples of a finer picture: no average of samples is in it.
        let finer =
            TestScene { scene: lab.scene.clone(), frame: Frame { width: 768, height: 512, ..lab.frame.clone() } };
        let truth = reduced(&finer.draw().picture, 8);
        let error = |samples: u32| {
            let frame = Frame { samples, ..lab.frame.clone() };
            rms_steps(&TestScene { scene: lab.scene.clone(), frame }.draw().picture, &truth)
        };
        // Measured: 6.4 of 12.5 steps with mipmaps and 3.9 of 8.2 with anisotropic filtering; with a whole pixel's
        // footprint for each sample 11.9 and 5.7.
        let (one, four) = (error(1), error(4));
        assert!(four < 0.6 * one, "{filter}: {four} steps with 4 samples, {one} with 1");
    }
}
