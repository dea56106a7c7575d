//! Conversion of environments, and the difference of two pictures.

use crate::conversion::Converter;
use crate::{DifferenceScale, DisplayTexture, Renderer};
use glam::{DMat3, DVec3};
use gonio_environment::convert::{Conversion, EnvironmentRef, Filter};
use gonio_environment::{Cubemap, Panorama};
use gonio_gl::Texels;
use gonio_image::Pixel;
use gonio_scene::difference::{heat, signed};

/// A value of its own in every direction, with waves and a lamp of 20.
fn radiance(d: DVec3) -> DVec3 {
    let waves = DVec3::new((9.0 * d.x).sin(), (8.0 * d.y + 1.0).sin(), (7.0 * d.z).cos());
    let lamp = 20.0 * (30.0 * (d.dot(DVec3::new(0.6, 0.7, -0.3).normalize()) - 1.0)).exp();
    DVec3::new(1.5 + d.x, 1.5 + d.y * d.z, 1.5 - d.z) + 0.3 * waves + DVec3::splat(lamp)
}

/// The largest difference, and the mean one.
fn difference(a: &[Pixel], b: &[Pixel]) -> (f32, f32) {
    assert_eq!(a.len(), b.len());
    let all = a.iter().zip(b).flat_map(|(a, b)| (0..4).map(move |c| (a[c] - b[c]).abs()));
    let (most, sum) = all.fold((0.0_f32, 0.0_f32), |(most, sum), d| (most.max(d), sum + d));
    (most, sum / (4 * a.len()).max(1) as f32)
}

#[test]
fn gpu_and_cpu_convert_alike() {
    let (map, pano) = (Cubemap::from_function(40, radiance), Panorama::from_function(120, 60, radiance));
    let turn = DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_z(1.1);
    let mut worst = Vec::new();
    for es in [false, true] {
        let context = super::context(es);
        let converter = Converter::new(context.gl().clone()).unwrap_or_else(|e| panic!("{e}"));
        for &filter in Filter::ALL {
            for source_from_target in [DMat3::IDENTITY, turn] {
                let conversion = Conversion { filter: Some(filter), source_from_target };
                for (from, name) in
                    [(EnvironmentRef::Cubemap(&map), "cubemap"), (EnvironmentRef::Panorama(&pano), "panorama")]
                {
                    // Coarser and finer than the source; even, so that no texel looks at a pole, which has no longitude.
                    for size in [14, 52] {
                        let cpu = conversion.cubemap(from, size);
                        let gpu = converter.cubemap(&conversion, from, size).unwrap_or_else(|e| panic!("{e}"));
                        worst.push((difference(cpu.pixels(), gpu.environment.pixels()), filter, name, size));
                        let cpu = conversion.panorama(from, 2 * size, size);
                        let gpu =
                            converter.panorama(&conversion, from, 2 * size, size).unwrap_or_else(|e| panic!("{e}"));
                        let (cpu, gpu) = (cpu.image.pixels, gpu.environment.image.pixels);
                        worst.push((difference(&cpu, &gpu), filter, name, 2 * size));
                    }
                }
            }
        }
    }
    for ((most, mean), filter, name, size) in worst {
        // Places agree to some 1e-5 texels, and texels differ by up to 3. The nearest texel is another one where a place
        // lies between two; a pixel of the area filter has another number of lookups where rounding decides it.
        let limit = if matches!(filter, Filter::Nearest | Filter::Area) { 3.0 } else { 1e-3 };
        assert!(most < limit && mean < 1e-3, "{filter} from a {name} to {size}: {most}, {mean} on average");
    }
}

#[test]
fn what_is_too_large_for_the_driver_is_reduced_and_told() {
    let context = super::context(false);
    let mut converter = Converter::new(context.gl().clone()).unwrap_or_else(|e| panic!("{e}"));
    converter.info.max_size = 64;
    let (map, pano) = (Cubemap::from_function(100, radiance), Panorama::from_function(256, 128, radiance));
    for from in [EnvironmentRef::Cubemap(&map), EnvironmentRef::Panorama(&pano)] {
        let made = converter.cubemap(&Conversion::default(), from, 16).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(made.notes.len(), 1);
        assert!(made.notes[0].contains("exceed the driver's limit of 64"), "{}", made.notes[0]);
        // The mean over texels of 0.1 rad of a function that is smooth there.
        let (_, mean) = difference(made.environment.pixels(), Conversion::default().cubemap(from, 16).pixels());
        assert!(mean < 0.02, "{mean}");
    }
    let refused = converter.cubemap(&Conversion::default(), EnvironmentRef::Panorama(&pano), 65).map(|_| ());
    assert!(refused.is_err_and(|e| e.message.contains("65 x 65 texels exceed the driver's limit of 64")));
}

const SIZE: [u32; 2] = [48, 32];

/// A display texture of given pixels.
fn canvas(gl: &gonio_gl::Gl, pixels: &[u8]) -> DisplayTexture {
    let canvas = DisplayTexture::new(gl, SIZE).unwrap_or_else(|e| panic!("{e}"));
    gl.bind_texture(glow::TEXTURE_2D, Some(canvas.texture()));
    gl.tex_sub_image_2d(glow::TEXTURE_2D, 0, [0, 0], SIZE.map(|side| side as i32), Texels::u8(glow::RGBA, pixels));
    canvas
}

/// Every size of difference, in each channel, of both signs.
fn pictures() -> [Vec<u8>; 2] {
    let count = (SIZE[0] * SIZE[1]) as usize;
    let byte = |i: usize, salt: usize| ((i * 37 + salt * 101 + i * i % 61 * salt) % 256) as u8;
    let of =
        |salt: usize| (0..count).flat_map(|i| [byte(i, salt), byte(i + 7, salt), byte(3 * i, salt), 255]).collect();
    [of(1), of(2)]
}

#[test]
fn gpu_and_cpu_colour_differences_alike() {
    for es in [false, true] {
        let context = super::context(es);
        let gl = context.gl();
        let mut renderer = Renderer::new(gl.clone()).unwrap_or_else(|e| panic!("{e}"));
        let [first, second] = pictures();
        let (a, b) = (canvas(gl, &first), canvas(gl, &second));
        let mut map = DisplayTexture::new(gl, [1, 1]).unwrap_or_else(|e| panic!("{e}"));
        for (full_scale, is_signed) in [(255.0, false), (24.0, false), (200.0, true)] {
            let scale = DifferenceScale { full_scale, signed: is_signed };
            renderer.paint_difference(&a, &b, scale, &mut map).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(map.size(), SIZE);
            let drawn = map.read8();
            for (i, pixel) in drawn.chunks_exact(4).enumerate() {
                let ways = [0, 1, 2].map(|c| f64::from(second[4 * i + c]) - f64::from(first[4 * i + c]));
                // The first of equals, as the shader has it.
                let way = ways.into_iter().fold(0.0, |most: f64, way| if way.abs() > most.abs() { way } else { most });
                let wanted = if is_signed { signed(way / full_scale) } else { heat(way.abs() / full_scale) };
                for (got, wanted) in pixel.iter().zip(wanted) {
                    // Rounding of f32 decides between two neighbours.
                    assert!(got.abs_diff(wanted) <= 1, "pixel {i}: {pixel:?} and {wanted:?}, es {es}");
                }
            }
        }
        let other = DisplayTexture::new(gl, [3, 3]).unwrap_or_else(|e| panic!("{e}"));
        let refused =
            renderer.paint_difference(&a, &other, DifferenceScale { full_scale: 1.0, signed: false }, &mut map);
        assert!(refused.is_err());
    }
}
