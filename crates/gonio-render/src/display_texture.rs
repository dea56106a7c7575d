//! A picture that stays on the GPU, to be shown by somebody else: a window's toolkit.

use gonio_gl::target::OutputTarget;
use gonio_gl::{Gl, GlError};

/// A texture of 8 bits a channel, and what draws into it. The top row comes first: v = 0 is the picture's top edge.
/// The numbers in it are encoded as the picture's output says (sRGB or direct), the alpha is 1 but where a picture has no
/// background; colours are premultiplied with it, as they are shown. It is shown pixel for pixel, so it is not filtered (which
/// costs software drivers as much as the rest of showing it), and it has no mipmaps.
///
/// OpenGL's name of the texture stays the same when its size changes. The code that shows it must not delete it.
pub struct DisplayTexture {
    gl: Gl,
    output: OutputTarget,
}

impl DisplayTexture {
    /// An empty display texture, pixels; sides of 0 count as 1.
    pub fn new(gl: &Gl, size: [u32; 2]) -> Result<Self, GlError> {
        Ok(DisplayTexture { gl: gl.clone(), output: OutputTarget::to_be_shown(gl, sides(size))? })
    }

    /// OpenGL's name of the texture, the same for the life of the display texture.
    pub fn texture(&self) -> glow::Texture {
        self.output.texture()
    }

    /// Pixels: those of the frame that was painted last.
    pub fn size(&self) -> [u32; 2] {
        self.output.size().map(|side| side as u32)
    }

    /// Gives it another size; what was painted is lost where it is another one.
    pub(crate) fn fit(&mut self, size: [u32; 2]) -> Result<(), GlError> {
        self.output.resize(&self.gl, sides(size))
    }

    /// Binds it for drawing lines over the picture, with a depth of 1 everywhere.
    pub(crate) fn begin_overlays(&mut self) -> Result<(), GlError> {
        self.output.begin_overlays(&self.gl)
    }

    pub(crate) fn output(&self) -> &OutputTarget {
        &self.output
    }

    /// Waits until everything that was asked for is drawn: reads one pixel, for that is what waits on the web too.
    pub fn wait(&self) {
        self.output.wait(&self.gl);
        self.output.unbind(&self.gl);
    }

    /// The picture, four bytes a pixel, the top row first. Waits for the GPU; leaves no framebuffer bound.
    pub fn read8(&self) -> Vec<u8> {
        let pixels = self.output.read8(&self.gl);
        self.output.unbind(&self.gl);
        pixels
    }
}

fn sides(size: [u32; 2]) -> [i32; 2] {
    size.map(|side| side.clamp(1, i32::MAX as u32) as i32)
}
