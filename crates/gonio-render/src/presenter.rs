//! Shows a finished picture in the frame of a window or a page.
//!
//! The scene is drawn into a texture of its own, when something changed. Showing it is one triangle, in a callback of
//! whoever paints the window; that callback must be `Send` and holds no object of ours, only their names.

use crate::glsl::presentation_sources;
use gonio_gl::objects::VertexArray;
use gonio_gl::program::Program;
use gonio_gl::{Gl, GlError};

/// The objects that show pictures; freed when dropped.
pub struct Presenter {
    program: Program,
}

/// A picture to be shown: names of objects that live in the [`Presenter`] and in the picture's owner.
#[derive(Clone, Copy, Debug)]
pub struct Presentation {
    program: glow::Program,
    texture: glow::Texture,
    opaque: bool,
}

impl Presenter {
    /// For a current context.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let [vertex, fragment] = presentation_sources(gl.dialect());
        let program = Program::new(gl, "presentation", &vertex, &fragment, &[])?;
        program.bind();
        program.set_i32("picture", 0);
        Ok(Presenter { program })
    }

    /// A texture whose first row is the picture's top, of colours as they are displayed, premultiplied. It may have holes.
    pub fn presentation(&self, texture: glow::Texture) -> Presentation {
        Presentation { program: self.program.handle(), texture, opaque: false }
    }
}

impl Presentation {
    /// The same picture without blending: it covers what is below, which need not be read.
    pub fn opaque(self) -> Self {
        Presentation { opaque: true, ..self }
    }

    /// Draws it over the whole of the current viewport, which should be of the texture's size, within the current scissor
    /// rectangle. Changes the program, the vertex array, texture unit 0, the blend function and whether there is blending.
    /// A picture whose texture is gone is black: OpenGL takes the name of a deleted object for none.
    pub fn draw(&self, gl: &Gl) {
        // Core profiles draw nothing without a vertex array, and one of another `Gl` is not known to this one.
        let Ok(array) = VertexArray::bound(gl, "presentation") else { return };
        gl.use_program(Some(self.program));
        gl.active_texture(glow::TEXTURE0);
        gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
        if self.opaque {
            gl.disable(glow::BLEND)
        } else {
            gl.enable(glow::BLEND)
        }
        gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::CULL_FACE);
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
        drop(array);
    }
}
