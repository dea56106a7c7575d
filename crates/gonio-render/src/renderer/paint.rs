//! Pictures for a window: frames, difference maps and students' programs, drawn onto display textures. Nothing waits
//! for the GPU, and the window's own state is restored.

use super::output::{Band, DisplaySettings};
use super::{PANES, RenderedPicture, Renderer};
use crate::display::{DisplayOptions, DisplayTexture};
use crate::glsl::{Display, difference_sources};
use crate::scene_on_gpu::GpuScene;
use gonio_gl::objects::{DebugGroup, GpuStatistics, StatisticsQueries};
use gonio_gl::program::Program;
use gonio_gl::target::{ColorPrecision, Sampling, Target};
use gonio_gl::{Dialect, GlError, SavedState};
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{Frame, Picture, SpecialView, ViewSpec};
use std::rc::Rc;

/// The result of painting a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Painted {
    /// Limits of the driver that changed the picture, for example fewer samples.
    pub notes: Vec<String>,
    /// Whether it differs from the picture at edges, as [`Renderer::paint_sketch`] may draw it.
    pub is_sketch: bool,
    /// Draw calls of the view and its overlays.
    pub draw_calls: u32,
    /// The counters of the GPU, if they were requested.
    pub statistics: Option<GpuStatistics>,
}

impl Renderer {
    /// Draws the frame onto the display texture, which takes the frame's size. Does not wait: the GPU may still be
    /// drawing when this returns, and later calls that show the texture are executed in order.
    ///
    /// The state that a window's toolkit relies upon is as before: framebuffer, viewport, scissor, blending, depth,
    /// culling, the active texture unit (on the web: as of a new context, with no framebuffer bound). No program and no
    /// vertex array stays bound; textures of the scene do, on units that all code binds before use.
    pub fn paint(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        show: &DisplayOptions,
        canvas: &mut DisplayTexture,
    ) -> Result<Painted, GlError> {
        self.paint_onto(scene, frame, show, canvas, false)
    }

    /// [`Self::paint`], with the vertices and fragments of the view (not of its overlays) counted where the driver can:
    /// waits for the GPU. Where it cannot, [`Self::count_fragments`] counts by drawing.
    pub fn paint_counted(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        show: &DisplayOptions,
        canvas: &mut DisplayTexture,
    ) -> Result<Painted, GlError> {
        self.paint_onto(scene, frame, show, canvas, true)
    }

    /// Draws a view with its overlays and reads it back in 8 bits: [`Self::paint_counted`] for a file, whose colours are not
    /// premultiplied.
    pub fn render_shown8(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        show: &DisplayOptions,
    ) -> Result<RenderedPicture, GlError> {
        let mut canvas = DisplayTexture::new(&self.shared.gl, [frame.width, frame.height])?;
        let painted = self.paint_counted(scene, frame, show, &mut canvas)?;
        let mut rgba = canvas.read8();
        for [color @ .., alpha] in rgba.as_chunks_mut::<4>().0.iter_mut().filter(|pixel| (1..255).contains(&pixel[3])) {
            let alpha = u32::from(*alpha);
            color.iter_mut().for_each(|c| *c = ((u32::from(*c) * 255 + alpha / 2) / alpha).min(255) as u8);
        }
        self.shared.check_error("reading the picture")?;
        let picture = EncodedPicture { width: frame.width, height: frame.height, rgba };
        let statistics = GpuStatistics { draw_calls: painted.draw_calls, ..painted.statistics.unwrap_or_default() };
        Ok(RenderedPicture { picture, statistics, notes: painted.notes })
    }

    /// The linear values (of a debug view: the raw vectors and scalars), premultiplied, in full floats: for a window that
    /// saves its picture. Waits for the GPU; the window's state is as before, as after [`Self::paint`].
    pub fn paint_linear(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<Picture, GlError> {
        let shared = self.shared.clone();
        let _state = SavedState::save(&shared.gl);
        self.render(scene, frame, view)?.linear()
    }

    fn paint_onto(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        show: &DisplayOptions,
        canvas: &mut DisplayTexture,
        counted: bool,
    ) -> Result<Painted, GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "paint");
        let mut notes = Vec::new();
        let height = frame.height as i32;
        let (view, special) = (show.view.quantity(), show.view.special());
        // Counts have no samples.
        let samples = if special == Some(SpecialView::Overdraw) { 1 } else { frame.samples };
        let sampled = Frame { samples, ..frame.clone() };
        let target = self.target_for(scene, &sampled, height, ColorPrecision::Half, PANES, &mut notes)?;
        canvas.fit([frame.width, frame.height])?;
        let as_it_is = special == Some(SpecialView::UvChecker);
        let look =
            if as_it_is { DisplaySettings::as_it_is(frame) } else { DisplaySettings::new(view, frame) }.to_be_shown();
        if special != Some(SpecialView::Overdraw) {
            // Before anything is drawn: checking whether a program linked waits for all earlier draws.
            shared.output_program_for(&target, look.encoded())?;
        }
        let shadows = match special {
            None => self.shadow_maps(scene, frame, &mut notes)?,
            Some(_) => None,
        };
        let queries = counted.then(|| StatisticsQueries::begin(gl, &shared.info)).transpose()?;
        let drawn = match special {
            Some(special) => shared.draw_special(special, scene, frame, &target),
            None => self.draw_scene(scene, frame, view, shadows.as_deref(), &target, 0),
        };
        // Counters end even if drawing failed, because they could not be started again.
        let statistics = queries.map(|q| q.end(gl, drawn.as_ref().copied().unwrap_or_default()).read());
        let mut draw_calls = drawn?;
        target.resolve(gl);
        if special == Some(SpecialView::Overdraw) {
            shared.overdraw_into(canvas.output(), &target)?;
        } else {
            let whole = Band { picture_height: height, first_row: 0, rows: height };
            shared.output_into(canvas.output(), &target, whole, &look, look.encoded())?;
        }
        if show.overlays.any() {
            draw_calls += shared.draw_overlays(show.overlays, scene, &mut self.cache, frame, canvas)?;
        }
        Ok(Painted { notes, draw_calls, statistics, ..Painted::default() })
    }
}

/// The largest half float: what is brighter would become infinite.
const MOST: f32 = 65504.0;

impl Renderer {
    /// Shows a finished linear picture, premultiplied, as the frame's picture is shown: exposure, tone mapping, encoding. The
    /// display texture takes the frame's size; a picture of another size is stretched, its pixels being rectangles. Does not wait,
    /// and leaves the window's state as [`Renderer::paint`] does.
    pub fn paint_picture(
        &mut self,
        picture: &Picture,
        frame: &Frame,
        canvas: &mut DisplayTexture,
    ) -> Result<(), GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "finished picture");
        let most = shared.info.max_size;
        let [width, height] = [frame.width, frame.height].map(|side| side.clamp(1, most));
        let size = [width as i32, height as i32];
        let target = match self.targets.find(size, Sampling::Multi(1), ColorPrecision::Half) {
            Some(target) => target,
            None => {
                self.targets.make_room(PANES);
                let precision = ColorPrecision::Half;
                let made = Target::new(gl, shared.info.dialect, size, Sampling::Multi(1), precision)?;
                let made = Rc::new(made);
                self.targets.keep(made.clone());
                made
            }
        };
        canvas.fit([width, height])?;
        let along = |at: u32, side: u32, count: u32| u64::from(at) * u64::from(count) / u64::from(side);
        let mut values = Vec::with_capacity(4 * width as usize * height as usize);
        for y in (0..height).rev() {
            let row = along(y, height, picture.height) * u64::from(picture.width);
            for x in 0..width {
                let pixel = picture.pixels.get((row + along(x, width, picture.width)) as usize);
                values.extend(pixel.copied().unwrap_or_default().map(|v| v.clamp(-MOST, MOST)));
            }
        }
        gl.disable(glow::SCISSOR_TEST);
        gl.active_texture(glow::TEXTURE0);
        target.fill(gl, &values);
        let look = DisplaySettings::new(None, frame).to_be_shown();
        let whole = Band { picture_height: size[1], first_row: 0, rows: size[1] };
        shared.output_into(canvas.output(), &target, whole, &look, look.encoded())
    }
}

/// The colours of a difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferenceScale {
    /// The difference in 8-bit steps, above 0, that has the last colour of the scale.
    pub full_scale: f64,
    /// The second minus the first, in [`gonio_scene::difference::signed`]'s colours; otherwise the size of the difference
    /// alone, in [`gonio_scene::difference::heat`]'s.
    pub signed: bool,
}

impl Renderer {
    /// Draws onto `map`, which takes the size of the first, where two display textures of one size differ: the largest
    /// difference of the displayed channels of each pixel. Does not wait, and leaves the window's state as
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

/// Samples per pixel, where the driver has them.
const SAMPLES: u32 = 4;
/// Pictures of one window that are drawn in turn: a student's and the reference.
const PICTURES: usize = 2;

impl Renderer {
    /// Calls `draw`, which draws programs of [`crate::user_program`], onto the display texture, which takes `size`. Colours
    /// from 0 to 1 are shown unchanged, without encoding; alpha is ignored. `background` is the colour where nothing is drawn.
    ///
    /// The viewport is a square in the picture's middle, as wide as the longer side: its matrices are those of a square
    /// picture, of which the window shows a part. There is a depth buffer, with a test that lets the farthest plane pass too,
    /// as a sky needs; nothing is culled.
    ///
    /// Does not wait, and leaves the window's state as [`Renderer::paint`] does.
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
        let target = self.user_program_target(size, SAMPLES, ColorPrecision::Half)?;
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

    /// A multisampled target: each triangle is shaded once per pixel.
    pub(super) fn user_program_target(
        &mut self,
        size: [i32; 2],
        samples: u32,
        precision: ColorPrecision,
    ) -> Result<Rc<Target>, GlError> {
        let samples = Sampling::Multi(samples.min(self.shared.info.max_samples).max(1) as i32);
        for sampling in [samples, Sampling::Multi(1)] {
            if let Some(target) = self.targets.find(size, sampling, precision) {
                return Ok(target);
            }
        }
        self.targets.make_room(PICTURES);
        let shared = &self.shared;
        let make = |sampling| Target::new(&shared.gl, shared.info.dialect, size, sampling, precision);
        let target = Rc::new(match make(samples) {
            // WebGL does not report the number of samples of each format.
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
