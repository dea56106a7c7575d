//! Displayed pictures: options of the display, the texture that a picture is drawn to, and its presentation in a window.
//!
//! The scene is drawn into a texture when something changed. Showing it is one triangle, in a callback of the code that paints
//! the window; the callback must be `Send`, so it has only the names of OpenGL objects.

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
/// Its values are encoded as the output of the picture requires (sRGB or linear), with premultiplied alpha, which is 1 except
/// where a picture has no background. It is shown pixel for pixel, so it has no mipmaps and is not filtered, which would double
/// the time to show it on software drivers.
///
/// OpenGL's name of the texture stays the same when its size changes. The code that shows it must not delete it.
pub struct DisplayTexture {
    gl: Gl,
    output: OutputTarget,
}

impl DisplayTexture {
    /// Creates an empty display texture of this size in pixels; sides of 0 count as 1.
    pub fn new(gl: &Gl, size: [u32; 2]) -> Result<Self, GlError> {
        Ok(DisplayTexture { gl: gl.clone(), output: OutputTarget::to_be_shown(gl, sides(size))? })
    }

    /// OpenGL's name of the texture, the same for the life of the display texture.
    pub fn texture(&self) -> glow::Texture {
        self.output.texture()
    }

    /// Size in pixels: that of the last painted frame.
    pub fn size(&self) -> [u32; 2] {
        self.output.size().map(|side| side as u32)
    }

    /// Changes its size; a different size loses the picture.
    pub(crate) fn fit(&mut self, size: [u32; 2]) -> Result<(), GlError> {
        self.output.resize(&self.gl, sides(size))
    }

    /// Binds it for drawing with a depth of 1 everywhere: a sketch, or lines over the picture.
    pub(crate) fn begin_with_depth(&mut self) -> Result<(), GlError> {
        self.output.begin_with_depth(&self.gl)
    }

    pub(crate) fn output(&self) -> &OutputTarget {
        &self.output
    }

    /// Waits until all calls are executed: reads one pixel, because that also waits on the web.
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

/// A picture to show: names of objects that belong to the [`Presenter`] and to the owner of the picture.
#[derive(Clone, Copy, Debug)]
pub struct Presentation {
    program: glow::Program,
    texture: glow::Texture,
    opaque: bool,
}

impl Presenter {
    /// Creates a presenter for a current context.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        let [vertex, fragment] = presentation_sources(gl.dialect());
        let program = Program::new(gl, "presentation", &vertex, &fragment, &[])?;
        program.bind();
        program.set_i32("picture", 0);
        Ok(Presenter { program })
    }

    /// Presents a texture of displayed, premultiplied colours whose first row is the top of the picture. It may be transparent.
    pub fn presentation(&self, texture: glow::Texture) -> Presentation {
        Presentation { program: self.program.handle(), texture, opaque: false }
    }
}

impl Presentation {
    /// The same picture without blending: it covers the pixels below, which need not be read.
    pub fn opaque(self) -> Self {
        Presentation { opaque: true, ..self }
    }

    /// Draws it over the whole of the current viewport, which should be of the texture's size, within the current scissor
    /// rectangle. Changes the program, the vertex array, texture unit 0, the blend function and whether there is blending.
    /// A picture whose texture was deleted is black: OpenGL treats the name of a deleted object as 0.
    pub fn draw(&self, gl: &Gl) {
        // Core profiles draw nothing without a vertex array, and this `Gl` does not track those of another one.
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
