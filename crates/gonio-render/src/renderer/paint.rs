//! A frame for a window: onto a display texture, with nothing to wait for, and with the window's own state left as it was.

use super::output::{Band, DisplaySettings};
use super::{PANES, RenderedPicture, Renderer};
use crate::display_options::DisplayOptions;
use crate::display_texture::DisplayTexture;
use crate::scene_on_gpu::GpuScene;
use gonio_gl::GlError;
use gonio_gl::SavedState;
use gonio_gl::objects::DebugGroup;
use gonio_gl::statistics::{GpuStatistics, StatisticsQueries};
use gonio_gl::target::Precision;
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{Frame, Picture, SpecialView, ViewSpec};

/// The result of painting a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Painted {
    /// Limits of the driver that changed the picture, for example fewer samples.
    pub notes: Vec<String>,
    /// Draw calls of the view and its overlays.
    pub draw_calls: u32,
    /// The counters of the GPU, if they were requested.
    pub statistics: Option<GpuStatistics>,
}

impl Renderer {
    /// Draws the frame onto the display texture, which takes the frame's size. Nothing is waited for: the GPU may still be
    /// drawing when this returns, and whoever shows the display texture shows it in order.
    ///
    /// The state that a window's toolkit relies upon is as before: framebuffer, viewport, scissor, blending, depth,
    /// culling, the active texture unit (on the web: as of a new context, with no framebuffer bound). No program and no
    /// vertex array stays bound; textures of ours do, on units that everybody binds before use.
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

    /// A picture of 8 bits with whatever is to be shown, read back: [`Self::paint_counted`] for a file, whose colours are
    /// not premultiplied.
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
    /// saves what it shows. Waits for the GPU; the window's state is as before, as after [`Self::paint`].
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
        let target = self.target_for(scene, &sampled, height, Precision::Half, PANES, &mut notes)?;
        canvas.fit([frame.width, frame.height])?;
        let as_it_is = special == Some(SpecialView::UvChecker);
        let look =
            if as_it_is { DisplaySettings::as_it_is(frame) } else { DisplaySettings::new(view, frame) }.to_be_shown();
        if special != Some(SpecialView::Overdraw) {
            // Before anything is drawn: asking whether a program is well waits for all that was.
            shared.output_program_for(&target, look.encoded())?;
        }
        let queries = counted.then(|| StatisticsQueries::begin(gl, &shared.info)).transpose()?;
        let drawn = match special {
            Some(special) => shared.draw_special(special, scene, frame, &target),
            None => self.draw_scene(scene, frame, view, &target, 0),
        };
        // Counters end even where drawing failed: they cannot begin again before.
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
        Ok(Painted { notes, draw_calls, statistics })
    }
}
