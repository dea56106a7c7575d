//! One pixel of a frame as OpenGL draws it: what a probe sets beside the reference.

use super::output::{Band, DisplaySettings};
use super::{PANES, Renderer};
use crate::glsl::Display;
use crate::scene_on_gpu::GpuScene;
use gonio_gl::GlError;
use gonio_gl::SavedState;
use gonio_gl::objects::DebugGroup;
use gonio_gl::target::{OutputTarget, Precision};
use gonio_scene::Frame;

impl Renderer {
    /// The pixel in column `x` of row `y` (from the top left) of the picture with one sample a pixel, through its
    /// centre: linear, premultiplied RGBA over the background, in full floats, before exposure and tone map. Only the
    /// pixel's row is drawn. Waits for the GPU, and leaves its state as [`Renderer::paint`] does.
    ///
    /// A pixel outside of the picture counts as the nearest inside.
    pub fn pixel(&mut self, scene: &GpuScene, frame: &Frame, x: u32, y: u32) -> Result<[f32; 4], GlError> {
        let frame = Frame { samples: 1, ..frame.clone() };
        let (x, y) = (x.min(frame.width.max(1) - 1), y.min(frame.height.max(1) - 1));
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "one pixel");
        let mut notes = Vec::new();
        // One more than the panes, so that none of their targets has to go for it.
        let target = self.target_for(scene, &frame, 1, Precision::Full, PANES + 1, &mut notes)?;
        let from_below = (frame.height.max(1) - 1 - y) as i32;
        self.draw_scene(scene, &frame, None, &target, from_below)?;
        target.resolve(gl);
        let output = OutputTarget::new(gl, target.size, true)?;
        let row = Band { picture_height: 1, first_row: 0, rows: 1 };
        shared.output_into(&output, &target, row, &DisplaySettings::new(None, &frame), Display::Linear)?;
        let values = output.read_f32(gl);
        output.unbind(gl);
        shared.check_error("reading a pixel")?;
        let start = 4 * x as usize;
        let drawn: [f32; 4] = values.get(start..start + 4).and_then(|pixel| pixel.try_into().ok()).unwrap_or_default();
        let behind = frame.background.at((f64::from(y) + 0.5) / f64::from(frame.height.max(1)));
        Ok(std::array::from_fn(|i| drawn[i] + (1.0 - drawn[3]) * behind[i] as f32))
    }
}

#[cfg(test)]
mod tests {
    use crate::Renderer;
    use gonio_scene::Frame;
    use gonio_scene::files::Disk;
    use std::path::Path;

    #[test]
    fn a_pixel_is_that_of_the_whole_picture() {
        let text = "[picture]\nwidth = 90\nheight = 61\n[[object]]\nmodel = \"builtin:still-life\"\n";
        let scene = gonio_scene::toml_file::read(text).unwrap_or_else(|why| panic!("{why}"));
        let scene = gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|why| panic!("{why}"));
        let frame = Frame { samples: 1, ..scene.frame(0.0) };
        let context = crate::tests::context(false);
        let mut renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|why| panic!("{why}"));
        let uploaded = renderer.upload(&scene).unwrap_or_else(|why| panic!("{why}"));
        let whole = renderer.render(&uploaded, &frame, None).and_then(|drawn| drawn.linear());
        let whole = whole.unwrap_or_else(|why| panic!("{why}"));
        let mut different = 0;
        for (x, y) in [(0, 0), (89, 60), (45, 30), (30, 40), (60, 35), (45, 5), (10, 50), (70, 20)] {
            let pixel = renderer.pixel(&uploaded, &frame, x, y).unwrap_or_else(|why| panic!("{why}"));
            let expected = whole.at(x, y);
            different += usize::from(pixel != whole.at(0, 0));
            for (a, b) in pixel.into_iter().zip(expected) {
                // The row's corners are snapped at other magnitudes than the picture's: set on llvmpipe.
                assert!((a - b).abs() < 2e-3, "{x},{y}: {pixel:?} for {expected:?}");
            }
        }
        assert!(different > 4, "the pixels should not be the background's alone");
    }
}
