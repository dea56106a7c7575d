//! Displayed pictures: what of a scene is displayed, the texture that it is drawn to, and showing that texture in a window.

use crate::glsl::presentation_sources;
use gonio_gl::objects::VertexArray;
use gonio_gl::program::Program;
use gonio_gl::target::OutputTarget;
use gonio_gl::{Gl, GlError};
use gonio_scene::{Overlays, SpecialView, ViewSpec};

/// A view of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum View {
    /// The picture.
    #[default]
    Picture,
    /// A quantity of the light equation.
    Quantity(ViewSpec),
    /// Another view.
    Special(SpecialView),
}

/// A view of a scene, and overlays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DisplayOptions {
    /// The view.
    pub view: View,
    /// The overlays.
    pub overlays: Overlays,
}

impl From<Option<ViewSpec>> for View {
    fn from(view: Option<ViewSpec>) -> Self {
        view.map_or(View::Picture, View::Quantity)
    }
}

impl From<Option<ViewSpec>> for DisplayOptions {
    fn from(view: Option<ViewSpec>) -> Self {
        DisplayOptions { view: view.into(), overlays: Overlays::default() }
    }
}

impl View {
    /// The quantity, if the view is one.
    pub(crate) fn quantity(self) -> Option<ViewSpec> {
        if let View::Quantity(view) = self { Some(view) } else { None }
    }

    /// The special view, if it is one.
    pub(crate) fn special(self) -> Option<SpecialView> {
        if let View::Special(view) = self { Some(view) } else { None }
    }
}

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
