//! Render targets: targets of a scene, multisampled or not, and the encoded picture made from them.

use crate::Dialect;
use crate::objects::{Framebuffer, Renderbuffer, TextureObject};
use crate::{Gl, GlError, Remedy, Texels};

/// The precision of a target's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorPrecision {
    /// 8 bits: for displayed colours, from 0 to 1.
    Displayed,
    /// 16-bit floats, 11 bits of mantissa: enough for pictures of 8 bits a channel, and half the memory.
    Half,
    /// 32-bit floats: for linear output, and for comparisons.
    Full,
}

impl ColorPrecision {
    fn format(self) -> u32 {
        match self {
            ColorPrecision::Displayed => glow::RGBA8,
            ColorPrecision::Half => glow::RGBA16F,
            ColorPrecision::Full => glow::RGBA32F,
        }
    }

    /// The type of the components of such texels in memory.
    fn component(self) -> u32 {
        match self {
            ColorPrecision::Displayed => glow::UNSIGNED_BYTE,
            ColorPrecision::Half | ColorPrecision::Full => glow::FLOAT,
        }
    }
}

/// The samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Multisampling, with this many samples, at least 1: each triangle is shaded once per pixel.
    Multi(i32),
    /// Texels, this many along each side of a pixel, at least 2: each sample is shaded.
    Grid(i32),
}

impl Sampling {
    /// Texels along a pixel's side.
    pub fn grid(self) -> i32 {
        match self {
            Sampling::Multi(_) => 1,
            Sampling::Grid(side) => side,
        }
    }
}

/// The samples that the output shader averages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SamplesOf {
    /// One: a texel is a pixel.
    One,
    /// The samples of a multisampled texture (OpenGL only).
    Texel,
    /// The texels of a grid.
    Grid,
}

/// The targets of one picture size and sample count.
pub struct Target {
    /// Width and height in pixels.
    pub size: [i32; 2],
    /// The samples of each pixel.
    pub sampling: Sampling,
    /// The precision of its colours.
    pub precision: ColorPrecision,
    drawn: Framebuffer,
    _depth: Renderbuffer,
    color: Color,
}

/// The storage of the colours.
enum Color {
    /// One sample per texel: drawn into a texture.
    Single(TextureObject),
    /// Several: drawn into a multisampled texture, whose samples the output shader averages. (Drivers
    /// average in a blit as well, but compile a shader of their own for it in each process.)
    Samples(TextureObject),
    /// Several without multisampled textures (WebGL2): drawn into a renderbuffer, which is blitted into a texture.
    Blitted { _samples: Renderbuffer, resolved: Framebuffer, texture: TextureObject },
}

/// A texture that a framebuffer draws into.
fn texture_target(
    gl: &Gl,
    format: u32,
    transfer: (u32, u32),
    size: [i32; 2],
    name: &str,
) -> Result<(Framebuffer, TextureObject), GlError> {
    let texture = TextureObject::bound(gl, name)?;
    storage(gl, format, transfer, size);
    for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
    }
    for parameter in [glow::TEXTURE_WRAP_S, glow::TEXTURE_WRAP_T] {
        gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::CLAMP_TO_EDGE as i32);
    }
    let framebuffer = Framebuffer::bound(gl, name)?;
    attach_texture(gl, glow::TEXTURE_2D, &texture);
    Ok((framebuffer, texture))
}

/// Allocates memory for the bound texture.
fn storage(gl: &Gl, format: u32, (transfer, kind): (u32, u32), size: [i32; 2]) {
    gl.tex_image_2d(glow::TEXTURE_2D, 0, format, size, Texels::none(transfer, kind));
}

/// Attaches a texture to the bound framebuffer.
fn attach_texture(gl: &Gl, target: u32, texture: &TextureObject) {
    gl.framebuffer_texture_2d(glow::FRAMEBUFFER, glow::COLOR_ATTACHMENT0, target, Some(texture.handle()), 0);
}

/// Attaches a renderbuffer to the bound framebuffer.
fn attach_renderbuffer(gl: &Gl, attachment: u32, buffer: &Renderbuffer) {
    gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(buffer.handle()));
}

fn check_complete(gl: &Gl, what: &str, size: [i32; 2], samples: i32) -> Result<(), GlError> {
    let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
    if status == glow::FRAMEBUFFER_COMPLETE {
        return Ok(());
    }
    Err(GlError::new(format!(
        "the driver cannot create the {what} of {} x {} pixels with {samples} samples (status {status:#x}); a smaller \
         picture or fewer samples may work",
        size[0], size[1]
    ))
    .with_remedy(Remedy::SmallerPicture))
}

impl Target {
    /// Makes the targets. `size`, times the side of a grid, must be within the driver's limits.
    pub fn new(
        gl: &Gl,
        dialect: Dialect,
        size: [i32; 2],
        sampling: Sampling,
        precision: ColorPrecision,
    ) -> Result<Self, GlError> {
        let format = precision.format();
        let transfer = (glow::RGBA, precision.component());
        let texels = size.map(|side| side * sampling.grid());
        let samples = if let Sampling::Multi(samples) = sampling { samples } else { 1 };
        let (drawn, color) = if samples <= 1 {
            let (drawn, texture) = texture_target(gl, format, transfer, texels, "linear picture")?;
            (drawn, Color::Single(texture))
        } else if dialect == Dialect::Core330 {
            let texture = TextureObject::multisampled(gl, format, texels, samples, "samples")?;
            let drawn = Framebuffer::bound(gl, "samples")?;
            attach_texture(gl, glow::TEXTURE_2D_MULTISAMPLE, &texture);
            (drawn, Color::Samples(texture))
        } else {
            let (resolved, texture) = texture_target(gl, format, transfer, texels, "linear picture")?;
            check_complete(gl, "linear picture", texels, 1)?;
            let buffer = Renderbuffer::new(gl, format, texels, samples, "samples")?;
            let drawn = Framebuffer::bound(gl, "samples")?;
            attach_renderbuffer(gl, glow::COLOR_ATTACHMENT0, &buffer);
            (drawn, Color::Blitted { _samples: buffer, resolved, texture })
        };
        let depth_samples = if samples > 1 { samples } else { 0 };
        let depth = Renderbuffer::new(gl, glow::DEPTH_COMPONENT24, texels, depth_samples, "depth")?;
        attach_renderbuffer(gl, glow::DEPTH_ATTACHMENT, &depth);
        check_complete(gl, "target", texels, samples)?;
        Ok(Target { size, sampling, precision, drawn, _depth: depth, color })
    }

    /// Binds and clears what the scene is drawn into: colour and alpha 0, depth 1. What is drawn lands
    /// where the target holds the rows from `first_row` of a picture of `picture_height`.
    pub fn begin(&self, gl: &Gl, first_row: i32, picture_height: i32) {
        let grid = self.sampling.grid();
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.drawn.handle()));
        gl.viewport(0, -first_row * grid, self.size[0] * grid, picture_height * grid);
        gl.disable(glow::SCISSOR_TEST);
        gl.color_mask(true, true, true, true);
        gl.depth_mask(true);
        gl.clear_color(0.0, 0.0, 0.0, 0.0);
        gl.clear_depth_f32(1.0);
        gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
    }

    /// Averages the samples where the output shader cannot do it.
    pub fn resolve(&self, gl: &Gl) {
        let Color::Blitted { resolved, .. } = &self.color else { return };
        let [w, h] = self.size;
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(self.drawn.handle()));
        gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(resolved.handle()));
        gl.blit_framebuffer([0, 0, w, h], [0, 0, w, h], glow::COLOR_BUFFER_BIT, glow::NEAREST);
    }

    /// The samples that the output shader averages, and their number: samples, or texels along a side.
    pub fn to_average(&self) -> (SamplesOf, i32) {
        match (&self.color, self.sampling) {
            (Color::Samples(_), Sampling::Multi(samples)) => (SamplesOf::Texel, samples),
            (_, Sampling::Grid(side)) => (SamplesOf::Grid, side),
            _ => (SamplesOf::One, 1),
        }
    }

    /// Binds the linear picture (premultiplied alpha, bottom row first) to the active unit.
    pub fn bind_linear(&self, gl: &Gl) {
        let (target, texture) = match &self.color {
            Color::Single(texture) | Color::Blitted { texture, .. } => (glow::TEXTURE_2D, texture),
            Color::Samples(texture) => (glow::TEXTURE_2D_MULTISAMPLE, texture),
        };
        gl.bind_texture(target, Some(texture.handle()));
    }
}

impl Target {
    /// Replaces the colours of a target of one sample by these, four values a texel, the bottom row first; they must be as many
    /// as the target's. Changes the texture of the active unit.
    pub fn fill(&self, gl: &Gl, values: &[f32]) {
        self.bind_linear(gl);
        gl.tex_sub_image_2d(glow::TEXTURE_2D, 0, [0, 0], self.size, Texels::f32(glow::RGBA, values));
    }

    /// The texels of a target of one sample, four values each, the bottom row first. Waits for the GPU.
    pub fn read_single(&self, gl: &Gl) -> Vec<f32> {
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.drawn.handle()));
        let mut values = vec![0.0; values_of(self.size)];
        gl.read_rgba_f32(whole(self.size), &mut values);
        values
    }
}

/// Depths alone, in a texture that shaders read.
pub struct DepthTarget {
    framebuffer: Framebuffer,
    texture: TextureObject,
    size: [i32; 2],
}

impl DepthTarget {
    /// Depths in 32-bit floats, not filtered. The texture stays bound to the active unit.
    pub fn new(gl: &Gl, size: [i32; 2], name: &str) -> Result<Self, GlError> {
        let texture = TextureObject::bound(gl, name)?;
        storage(gl, glow::DEPTH_COMPONENT32F, (glow::DEPTH_COMPONENT, glow::FLOAT), size);
        for (parameter, value) in [
            (glow::TEXTURE_MIN_FILTER, glow::NEAREST),
            (glow::TEXTURE_MAG_FILTER, glow::NEAREST),
            (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_EDGE),
            (glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE),
        ] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, value as i32);
        }
        let framebuffer = Framebuffer::bound(gl, name)?;
        let (target, attachment) = (glow::FRAMEBUFFER, glow::DEPTH_ATTACHMENT);
        gl.framebuffer_texture_2d(target, attachment, glow::TEXTURE_2D, Some(texture.handle()), 0);
        check_complete(gl, name, size, 1)?;
        Ok(DepthTarget { framebuffer, texture, size })
    }

    /// Binds it for drawing with a depth of 1 everywhere. The viewport is the caller's.
    pub fn begin(&self, gl: &Gl) {
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer.handle()));
        gl.disable(glow::SCISSOR_TEST);
        gl.depth_mask(true);
        gl.clear_depth_f32(1.0);
        gl.clear(glow::DEPTH_BUFFER_BIT);
    }

    /// OpenGL's name of the texture.
    pub fn texture(&self) -> glow::Texture {
        self.texture.handle()
    }

    /// Texels.
    pub fn size(&self) -> [i32; 2] {
        self.size
    }
}

/// An encoded picture, to be shown or read back: 8 bits per channel, or floats.
pub struct OutputTarget {
    framebuffer: Framebuffer,
    texture: TextureObject,
    /// For surfaces that are drawn onto it, and for overlays, whose lines are hidden by surfaces in front of them.
    depth: Option<Renderbuffer>,
    size: [i32; 2],
}

impl OutputTarget {
    /// RGBA8, or RGBA32F where `float`.
    pub fn new(gl: &Gl, size: [i32; 2], float: bool) -> Result<Self, GlError> {
        let (format, transfer) = if float {
            (glow::RGBA32F, (glow::RGBA, glow::FLOAT))
        } else {
            (glow::RGBA8, (glow::RGBA, glow::UNSIGNED_BYTE))
        };
        let (framebuffer, texture) = texture_target(gl, format, transfer, size, "encoded picture")?;
        check_complete(gl, "encoded picture", size, 1)?;
        Ok(OutputTarget { framebuffer, texture, depth: None, size })
    }

    /// An RGBA8 target whose texture other code shows, pixel for pixel. Leaves no framebuffer bound.
    pub fn to_be_shown(gl: &Gl, size: [i32; 2]) -> Result<Self, GlError> {
        let target = Self::new(gl, size, false)?;
        gl.bind_texture(glow::TEXTURE_2D, None);
        target.unbind(gl);
        Ok(target)
    }

    /// Changes the size of an 8-bit target; its texture keeps its name.
    pub fn resize(&mut self, gl: &Gl, size: [i32; 2]) -> Result<(), GlError> {
        if size == self.size {
            return Ok(());
        }
        let shown = (glow::RGBA, glow::UNSIGNED_BYTE);
        gl.bind_texture(glow::TEXTURE_2D, Some(self.texture.handle()));
        storage(gl, glow::RGBA8, shown, size);
        gl.bind_texture(glow::TEXTURE_2D, None);
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer.handle()));
        self.size = size;
        if self.depth.take().is_some() {
            self.add_depth(gl)?;
        }
        check_complete(gl, "encoded picture", size, 1)
    }

    /// Attaches a depth buffer to the framebuffer, which is bound.
    fn add_depth(&mut self, gl: &Gl) -> Result<(), GlError> {
        let depth = Renderbuffer::new(gl, glow::DEPTH_COMPONENT24, self.size, 0, "depth of the encoded picture")?;
        attach_renderbuffer(gl, glow::DEPTH_ATTACHMENT, &depth);
        self.depth = Some(depth);
        check_complete(gl, "encoded picture with depth", self.size, 1)
    }

    /// Binds it for drawing with a depth of 1 everywhere.
    pub fn begin_with_depth(&mut self, gl: &Gl) -> Result<(), GlError> {
        self.bind(gl);
        if self.depth.is_none() {
            self.add_depth(gl)?;
        }
        gl.disable(glow::SCISSOR_TEST);
        gl.depth_mask(true);
        gl.clear_depth_f32(1.0);
        gl.clear(glow::DEPTH_BUFFER_BIT);
        Ok(())
    }

    /// OpenGL's name of the texture.
    pub fn texture(&self) -> glow::Texture {
        self.texture.handle()
    }

    /// Pixels.
    pub fn size(&self) -> [i32; 2] {
        self.size
    }

    /// Binds no framebuffer: the window's own, where there is one.
    pub fn unbind(&self, gl: &Gl) {
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
    }

    /// Binds it for drawing.
    pub fn bind(&self, gl: &Gl) {
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer.handle()));
        gl.viewport(0, 0, self.size[0], self.size[1]);
    }

    /// Reads one pixel of an 8-bit target, which waits for what draws into it.
    pub fn wait(&self, gl: &Gl) {
        let mut pixel = [0_u8; 4];
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer.handle()));
        gl.read_rgba8([0, 0, 1, 1], &mut pixel);
    }

    /// Reads an 8-bit target, in the order in which it was drawn.
    pub fn read8(&self, gl: &Gl) -> Vec<u8> {
        let mut values = vec![0; values_of(self.size)];
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer.handle()));
        gl.read_rgba8(whole(self.size), &mut values);
        values
    }

    /// Reads a float target, in the order in which it was drawn.
    pub fn read_f32(&self, gl: &Gl) -> Vec<f32> {
        let mut values = vec![0.0; values_of(self.size)];
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer.handle()));
        gl.read_rgba_f32(whole(self.size), &mut values);
        values
    }
}

/// Four for each pixel.
fn values_of(size: [i32; 2]) -> usize {
    size[0] as usize * size[1] as usize * 4
}

fn whole([width, height]: [i32; 2]) -> [i32; 4] {
    [0, 0, width, height]
}
