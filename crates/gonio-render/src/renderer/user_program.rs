//! Draws students' programs for a window, as their own program would show them.

use super::Renderer;
use super::output::{Band, DisplaySettings};
use crate::display_texture::DisplayTexture;
use crate::glsl::Display;
use gonio_gl::Dialect;
use gonio_gl::GlError;
use gonio_gl::SavedState;
use gonio_gl::objects::DebugGroup;
use gonio_gl::target::{Precision, Sampling, Target};
use std::rc::Rc;

/// Samples per pixel, where the driver has them.
const SAMPLES: u32 = 4;
/// Pictures of one window that are drawn in turn: a student's and the reference.
const PICTURES: usize = 2;

impl Renderer {
    /// Draws what `draw` draws, programs of [`crate::user_program`], onto the display texture, which takes `size`. Colours are
    /// shown unchanged, 0 to 1, without any encoding; alpha is ignored. `background` is the colour where nothing is drawn.
    ///
    /// The viewport is a square in the picture's middle, as wide as the longer side: its matrices are those of a square
    /// picture, of which the window shows a part. There is a depth buffer, with a test that lets the farthest plane pass too,
    /// as a sky needs; nothing is culled.
    ///
    /// Waits for nothing and leaves the window's state as [`Renderer::paint`] does.
    pub fn paint_user_program(
        &mut self,
        canvas: &mut DisplayTexture,
        size: [u32; 2],
        background: [f32; 3],
        draw: impl FnOnce(),
    ) -> Result<(), GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "user program");
        let most = shared.info.max_size;
        let size = size.map(|side| side.clamp(1, most) as i32);
        let target = self.user_program_target(size)?;
        canvas.fit(size.map(|side| side as u32))?;
        shared.output_program_for(&target, Display::Affine)?;
        target.begin(gl, 0, size[1]);
        let side = size[0].max(size[1]);
        let [r, g, b] = background;
        gl.clear_color(r, g, b, 1.0);
        gl.clear(glow::COLOR_BUFFER_BIT);
        gl.viewport((size[0] - side) / 2, (size[1] - side) / 2, side, side);
        gl.color_mask(true, true, true, false);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LEQUAL);
        draw();
        gl.color_mask(true, true, true, true);
        target.resolve(gl);
        let whole = Band { picture_height: size[1], first_row: 0, rows: size[1] };
        shared.output_into(canvas.output(), &target, whole, &DisplaySettings::of_numbers(), Display::Affine)
    }

    fn user_program_target(&mut self, size: [i32; 2]) -> Result<Rc<Target>, GlError> {
        let samples = Sampling::Multi(SAMPLES.min(self.shared.info.max_samples).max(1) as i32);
        for sampling in [samples, Sampling::Multi(1)] {
            if let Some(target) = self.targets.find(size, sampling, Precision::Half) {
                return Ok(target);
            }
        }
        self.targets.make_room(PICTURES);
        let shared = &self.shared;
        let make = |sampling| Target::new(&shared.gl, shared.info.dialect, size, sampling, Precision::Half);
        let target = Rc::new(match make(samples) {
            // Drivers of the web do not say how many samples they have of which format.
            Err(_) if shared.info.dialect == Dialect::Es300 => {
                shared.forget_errors();
                make(Sampling::Multi(1))?
            }
            made => made?,
        });
        self.targets.keep(target.clone());
        Ok(target)
    }
}
