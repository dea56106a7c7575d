//! The footprint by which textures are filtered: a sample's, not a pixel's.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DVec3};
use gonio_mesh::Material;
use gonio_scene::scene_file::Shading;
use gonio_scene::{ColorSpace, Frame, Maps, Picture, TextureFilter};

/// A glowing chequered plane that goes to the horizon; its squares become smaller than pixels on the way.
fn plane(filter: TextureFilter) -> TestScene {
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
        let lab = plane(filter);
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
