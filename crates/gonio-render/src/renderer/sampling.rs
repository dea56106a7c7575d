//! Whether a driver's samples are used, or a finer picture.

use gonio_gl::DriverInfo;
use gonio_gl::target::Sampling;
use gonio_scene::Frame;

/// Pixels of a picture for each triangle up to which triangles count as fine: from there on down a grid of samples was
/// measured to take less time on llvmpipe than samples of the driver.
const PIXELS_PER_TRIANGLE: usize = 3;

/// Chooses how the samples of a frame are drawn.
///
/// Where triangles are not much larger than pixels, nearly every sample is shaded anyway, and software drivers spend
/// more on keeping the samples of a pixel apart than on shading: there a finer picture, averaged, is the same for less.
pub(super) fn choose(info: &DriverInfo, triangles: usize, frame: &Frame, samples: i32) -> Sampling {
    let pixels = frame.width as usize * frame.height as usize;
    let is_fine = triangles.saturating_mul(PIXELS_PER_TRIANGLE) >= pixels;
    let fits = |side: i32| u64::from(frame.width.max(frame.height)) * side as u64 <= u64::from(info.max_size);
    match (2..=4).find(|side| side * side == samples) {
        Some(side) if is_fine && info.is_software() && fits(side) => Sampling::Grid(side),
        _ => Sampling::Multi(samples),
    }
}

#[cfg(test)]
mod tests {
    use crate::Renderer;
    use gonio_scene::files::Disk;
    use gonio_scene::{Picture, Scene};
    use std::path::Path;

    /// Suzanne's 968 triangles on 40 x 30 pixels: fine ones; `finer` times as wide and high.
    fn scene(samples: u32, finer: u32) -> Scene {
        let text = format!(
            "[picture]\nwidth = {}\nheight = {}\nsamples = {samples}\n[[object]]\nmodel = \"builtin:suzanne\"\n",
            40 * finer,
            30 * finer
        );
        let scene = gonio_scene::toml_file::read(&text).unwrap_or_else(|why| panic!("{why}"));
        gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|why| panic!("{why}"))
    }

    fn linear(renderer: &mut Renderer, scene: &Scene) -> Picture {
        let uploaded = renderer.upload(scene).unwrap_or_else(|why| panic!("{why}"));
        let drawn = renderer.render(&uploaded, &scene.frame(0.0), None);
        drawn.and_then(|drawn| drawn.linear()).unwrap_or_else(|why| panic!("{why}"))
    }

    /// Four samples of fine triangles are the four pixels of a picture twice as large: in OpenGL, in OpenGL ES, and
    /// whatever comes before it.
    #[test]
    fn fine_triangles_are_a_finer_picture_averaged() {
        for es in [false, true] {
            let context = crate::tests::context(es);
            let mut renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|why| panic!("{why}"));
            assert!(renderer.info().is_software(), "{}", renderer.info().renderer);
            let finer = linear(&mut renderer, &scene(1, 2));
            let picture = linear(&mut renderer, &scene(4, 1));
            assert_eq!((picture.width, picture.height), (40, 30));
            let (mut differs, mut covered) = (0.0_f32, 0);
            for (i, pixel) in picture.pixels.iter().enumerate() {
                let (x, y) = (2 * (i % 40), 2 * (i / 40));
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| finer.pixels[(y + dy) * 80 + x + dx]);
                for channel in 0..3 {
                    let mean = four.iter().map(|texel| texel[channel]).sum::<f32>() / 4.0;
                    differs = differs.max((mean - pixel[channel]).abs());
                }
                covered += usize::from(four.iter().any(|texel| *texel != four[0]));
            }
            // The background is a gradient in steps of rows, so half a step of it may part them.
            assert!(differs < 2e-3, "{differs}");
            assert!(covered > 200, "{covered} pixels are not of one colour");
        }
    }
}
