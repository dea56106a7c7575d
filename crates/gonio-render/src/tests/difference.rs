//! The difference map on the GPU against the same colours on the CPU.

use crate::{DifferenceScale, DisplayTexture, Renderer};
use gonio_gl::Texels;
use gonio_scene::difference::{heat, signed};

const SIZE: [u32; 2] = [48, 32];

/// A canvas of given pixels.
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
