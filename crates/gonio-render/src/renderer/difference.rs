//! Difference maps of two finished pictures, drawn on the GPU.

use super::Renderer;
use crate::display_texture::DisplayTexture;
use crate::glsl::difference_sources;
use gonio_gl::GlError;
use gonio_gl::SavedState;
use gonio_gl::objects::DebugGroup;
use gonio_gl::program::Program;
use std::rc::Rc;

/// The colours of a difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferenceScale {
    /// The 8-bit steps that get the scale's last colour, above 0.
    pub full_scale: f64,
    /// The second minus the first, in [`gonio_scene::difference::signed`]'s colours; otherwise the size of the difference
    /// alone, in [`gonio_scene::difference::heat`]'s.
    pub signed: bool,
}

impl Renderer {
    /// Draws onto `map`, which takes the size of the first, where two display textures of one size differ: of each pixel the
    /// channel (red, green or blue, as displayed) that differs most. Waits for nothing and leaves the window's state as
    /// [`Renderer::paint`] does. Textures of different sizes are an error.
    pub fn paint_difference(
        &mut self,
        first: &DisplayTexture,
        second: &DisplayTexture,
        scale: DifferenceScale,
        map: &mut DisplayTexture,
    ) -> Result<(), GlError> {
        if first.size() != second.size() {
            return Err(GlError::new("pictures of different sizes cannot be compared"));
        }
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "difference");
        map.fit(first.size())?;
        let known = shared.difference.borrow().clone();
        let program = match known {
            Some(program) => program,
            None => {
                let [vertex, fragment] = difference_sources(gl.dialect());
                let program = Rc::new(Program::new(gl, "difference", &vertex, &fragment, &[])?);
                *shared.difference.borrow_mut() = Some(program.clone());
                program
            }
        };
        program.bind();
        program.set_i32("first", 0);
        program.set_i32("second", 1);
        program.set_f32("full_scale", scale.full_scale.max(1e-3) as f32);
        program.set_i32("is_signed", i32::from(scale.signed));
        map.output().bind(gl);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.disable(glow::SCISSOR_TEST);
        for (unit, canvas) in [(1, second), (0, first)] {
            gl.active_texture(glow::TEXTURE0 + unit);
            gl.bind_texture(glow::TEXTURE_2D, Some(canvas.texture()));
        }
        gl.bind_vertex_array(Some(shared.no_attributes.handle()));
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
        Ok(())
    }
}
