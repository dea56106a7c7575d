//! From the linear picture on the GPU to a picture, or one pixel, in memory.

use super::shared::Shared;
use super::{PANES, Renderer};
use crate::glsl::{Display, OutputKey};
use crate::scene_on_gpu::GpuScene;
use glam::{DVec3, Vec2};
use gonio_gl::objects::{DebugGroup, GpuStatistics};
use gonio_gl::program::Program;
use gonio_gl::target::{ColorPrecision, OutputTarget, Target};
use gonio_gl::{GlError, SavedState};
use gonio_light::Quantity;
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{DisplayMap, Frame, Picture, ViewSpec};
use std::rc::Rc;

/// The settings that turn linear colours into displayed ones.
#[derive(Clone, Copy)]
pub(super) struct DisplaySettings {
    display: DisplayMap,
    background_top: DVec3,
    background_bottom: DVec3,
    background_alpha: f64,
    /// Colours are written times their alpha, as windows show them; files have them without.
    premultiplied: bool,
}

impl DisplaySettings {
    /// The settings for the picture (`None`) or a debug view.
    pub fn new(view: Option<ViewSpec>, frame: &Frame) -> Self {
        let display = DisplayMap::for_view(view, frame);
        // Debug views are black where there is no object.
        let is_picture = view.is_none_or(|v| v.quantity == Quantity::Total);
        let (top, bottom) =
            if is_picture { (frame.background.top, frame.background.bottom) } else { (DVec3::ZERO, DVec3::ZERO) };
        let alpha = if is_picture && frame.background.transparent { 0.0 } else { 1.0 };
        DisplaySettings {
            display,
            background_top: top,
            background_bottom: bottom,
            background_alpha: alpha,
            premultiplied: false,
        }
    }

    /// The settings for a window.
    pub fn to_be_shown(self) -> Self {
        DisplaySettings { premultiplied: true, ..self }
    }

    /// The settings for a window that shows numbers unchanged.
    pub fn of_numbers() -> Self {
        DisplaySettings {
            display: DisplayMap::Affine { scale: DVec3::ONE, bias: DVec3::ZERO },
            background_top: DVec3::ZERO,
            background_bottom: DVec3::ZERO,
            background_alpha: 1.0,
            premultiplied: true,
        }
    }

    /// The settings for a view whose values are shown unchanged.
    pub fn as_it_is(frame: &Frame) -> Self {
        let display = DisplayMap::Affine { scale: DVec3::ONE, bias: DVec3::ZERO };
        DisplaySettings {
            display,
            background_top: DVec3::ZERO,
            background_bottom: DVec3::ZERO,
            ..DisplaySettings::new(None, frame)
        }
    }

    /// The encoding of a picture file of the frame.
    pub fn encoded(&self) -> Display {
        match self.display {
            DisplayMap::Affine { .. } => Display::Affine,
            DisplayMap::Light(transform) => Display::Light(transform.tone_map, transform.encoding),
        }
    }
}

/// A horizontal band of a picture, or all of it.
#[derive(Clone, Copy)]
pub(super) struct Band {
    /// The height of the whole picture, pixels.
    pub picture_height: i32,
    /// The band's lowest row, from the picture's bottom.
    pub first_row: i32,
    /// The number of rows.
    pub rows: i32,
}

impl Shared {
    /// Draws the displayed pixels of a target into `output`, top row first. The code that reads them checks for errors, because
    /// that waits for the GPU on the web.
    pub(super) fn output_into(
        &self,
        output: &OutputTarget,
        target: &Target,
        band: Band,
        look: &DisplaySettings,
        display: Display,
    ) -> Result<(), GlError> {
        let gl = &self.gl;
        let _group = DebugGroup::new(gl, "output");
        self.prepare_output(target, band, look, display, true)?;
        output.bind(gl);
        gl.viewport(0, band.picture_height - band.first_row - band.rows, target.size[0], band.rows);
        self.draw_over_all(target);
        Ok(())
    }

    /// Draws the displayed pixels of a target over all of the framebuffer that is bound, which has the same size.
    pub(super) fn output_onto_bound(&self, target: &Target, look: &DisplaySettings) -> Result<(), GlError> {
        let whole = Band { picture_height: target.size[1], first_row: 0, rows: target.size[1] };
        self.prepare_output(target, whole, look, look.encoded(), false)?;
        self.draw_over_all(target);
        Ok(())
    }

    /// Binds the program of the output pass and sets its uniforms.
    fn prepare_output(
        &self,
        target: &Target,
        band: Band,
        look: &DisplaySettings,
        display: Display,
        top_row_first: bool,
    ) -> Result<(), GlError> {
        let (_, count) = target.to_average();
        let program = self.output_program_for(target, display)?;
        program.bind();
        program.set_i32("linear_picture", 0);
        program.set_i32("sample_count", count);
        program.set_i32("grid_side", count);
        program.set_i32("top_row_first", i32::from(top_row_first));
        program.set_f32("premultiply", if look.premultiplied { 1.0 } else { 0.0 });
        program.set_i32("first_row", band.first_row);
        program.set_vec2("picture_size", Vec2::new(target.size[0] as f32, band.picture_height as f32));
        program.set_dvec3("background_top", look.background_top);
        program.set_dvec3("background_bottom", look.background_bottom);
        program.set_f32("background_alpha", look.background_alpha as f32);
        match look.display {
            DisplayMap::Affine { scale, bias } => {
                program.set_dvec3("display_scale", scale);
                program.set_dvec3("display_bias", bias);
            }
            DisplayMap::Light(transform) => program.set_f32("exposure", transform.exposure as f32),
        }
        Ok(())
    }

    /// The program of [`Self::output_into`].
    pub(super) fn output_program_for(&self, target: &Target, display: Display) -> Result<Rc<Program>, GlError> {
        let (samples, _) = target.to_average();
        self.output_program(OutputKey { display, samples })
    }

    /// Draws one triangle over the whole viewport, by the bound program, with a target's pixels on unit 0.
    pub(super) fn draw_over_all(&self, target: &Target) {
        let gl = &self.gl;
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.active_texture(glow::TEXTURE0);
        target.bind_linear(gl);
        gl.bind_vertex_array(Some(self.no_attributes.handle()));
        gl.draw_arrays(glow::TRIANGLES, 0, 3);
        gl.bind_vertex_array(None);
    }
}

/// A frame on the GPU, finished. Reading it back is a separate step.
pub struct RenderedFrame {
    pub(super) shared: Rc<Shared>,
    pub(super) target: Rc<Target>,
    pub(super) look: DisplaySettings,
    /// The counters of the GPU.
    pub statistics: GpuStatistics,
    /// Limits of the driver that changed the picture, for example fewer samples.
    pub notes: Vec<String>,
}

impl RenderedFrame {
    /// The linear values (for debug views: the raw vectors and scalars), premultiplied alpha.
    pub fn linear(&self) -> Result<Picture, GlError> {
        let [width, height] = self.target.size;
        let output = OutputTarget::new(&self.shared.gl, self.target.size, true)?;
        self.output_into(&output, Display::Linear)?;
        let values = output.read_f32(&self.shared.gl);
        self.shared.check_error("reading the picture")?;
        let top_first: &[[f32; 4]] = bytemuck::cast_slice(&values);
        let mut pixels = Vec::with_capacity(top_first.len());
        let affine = self.look.display.is_affine();
        for (row, line) in top_first.chunks_exact(width as usize).enumerate() {
            let y = (row as f64 + 0.5) / f64::from(height);
            let b = self.look.background_top.lerp(self.look.background_bottom, y);
            let b = [b.x, b.y, b.z, 1.0].map(|v| (v * self.look.background_alpha) as f32);
            pixels.extend(line.iter().map(|p| {
                if affine {
                    return *p;
                }
                let behind = 1.0 - p[3];
                [0, 1, 2, 3].map(|i| p[i] + behind * b[i])
            }));
        }
        Ok(Picture { width: width as u32, height: height as u32, pixels })
    }

    /// The displayed picture in 8 bits, encoded by the GPU.
    pub fn encoded8(&self) -> Result<EncodedPicture<u8>, GlError> {
        let output = OutputTarget::new(&self.shared.gl, self.target.size, false)?;
        self.output_into(&output, self.look.encoded())?;
        let rgba = output.read8(&self.shared.gl);
        self.shared.check_error("reading the picture")?;
        Ok(EncodedPicture { width: self.target.size[0] as u32, height: self.target.size[1] as u32, rgba })
    }

    /// The displayed picture in 16 bits, encoded by the GPU.
    pub fn encoded16(&self) -> Result<EncodedPicture<u16>, GlError> {
        let output = OutputTarget::new(&self.shared.gl, self.target.size, true)?;
        self.output_into(&output, self.look.encoded())?;
        let rgba = output.read_f32(&self.shared.gl);
        self.shared.check_error("reading the picture")?;
        let rgba = rgba.into_iter().map(|v| (v.clamp(0.0, 1.0) * 65535.0 + 0.5) as u16).collect();
        Ok(EncodedPicture { width: self.target.size[0] as u32, height: self.target.size[1] as u32, rgba })
    }

    fn output_into(&self, output: &OutputTarget, display: Display) -> Result<(), GlError> {
        let rows = self.target.size[1];
        let whole = Band { picture_height: rows, first_row: 0, rows };
        self.shared.output_into(output, &self.target, whole, &self.look, display)
    }
}

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
        // One more than the panes, so that their targets are kept.
        let target = self.target_for(scene, &frame, 1, ColorPrecision::Full, PANES + 1, &mut notes)?;
        let from_below = (frame.height.max(1) - 1 - y) as i32;
        let shadows = self.shadow_maps(scene, &frame, &mut notes)?;
        self.draw_scene(scene, &frame, None, shadows.as_deref(), &target, from_below)?;
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
        let scene = gonio_scene::toml_file::read(text).unwrap_or_else(|error| panic!("{error}"));
        let scene = gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"));
        let frame = Frame { samples: 1, ..scene.frame(0.0) };
        let context = crate::tests::context(false);
        let mut renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|error| panic!("{error}"));
        let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
        let whole = renderer.render(&uploaded, &frame, None).and_then(|drawn| drawn.linear());
        let whole = whole.unwrap_or_else(|error| panic!("{error}"));
        let mut different = 0;
        for (x, y) in [(0, 0), (89, 60), (45, 30), (30, 40), (60, 35), (45, 5), (10, 50), (70, 20)] {
            let pixel = renderer.pixel(&uploaded, &frame, x, y).unwrap_or_else(|error| panic!("{error}"));
            let expected = whole.at(x, y);
            different += usize::from(pixel != whole.at(0, 0));
            for (a, b) in pixel.into_iter().zip(expected) {
                // Corners of a row are snapped at different magnitudes: set on llvmpipe.
                assert!((a - b).abs() < 2e-3, "{x},{y}: {pixel:?} for {expected:?}");
            }
        }
        assert!(different > 4, "the pixels should not be the background's alone");
    }
}
