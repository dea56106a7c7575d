//! Pictures that the objects' programs write as displayed colours, without a linear picture before: over all of a context's own
//! framebuffer (a window, or the canvas of a page), and on display textures while something moves.

use super::output::{Band, DisplaySettings};
use super::{PANES, Painted, Renderer, opaque_draws};
use crate::display::{DisplayOptions, DisplayTexture};
use crate::glsl::Display;
use crate::scene_on_gpu::GpuScene;
use gonio_gl::objects::DebugGroup;
use gonio_gl::target::ColorPrecision;
use gonio_gl::{GlError, SavedState};
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_scene::{DisplayMap, Frame};
use std::rc::Rc;

impl Renderer {
    /// Draws the picture, without shadows, over the context's own framebuffer, which has the frame's size and a depth buffer. A
    /// module that calls only this contains no code for shadow maps, debug views, overlays and counters.
    ///
    /// With one sample a pixel, and if all is opaque before a plain background, the programs of the objects write displayed
    /// colours: a software driver draws these sooner than linear ones and then those of the screen.
    pub fn paint_scene_on_window(&mut self, scene: &GpuScene, frame: &Frame) -> Result<(), GlError> {
        let shared = self.shared.clone();
        let _state = SavedState::save(&shared.gl);
        if let Some(display) = display_of_objects(scene, frame).filter(|_| frame.samples == 1) {
            shared.gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            return self.displayed_scene(scene, frame, display, Place { top_row_first: false, grid: 1 }).map(drop);
        }
        let look = DisplaySettings::new(None, frame).to_be_shown();
        let mut notes = Vec::new();
        let target = self.target_for(scene, frame, frame.height as i32, ColorPrecision::Half, PANES, &mut notes)?;
        // Before anything is drawn: checking whether a program linked waits for all earlier draws.
        shared.output_program_for(&target, look.encoded())?;
        self.draw_scene(scene, frame, None, None, &target, 0)?;
        target.resolve(&shared.gl);
        shared.gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        shared.gl.viewport(0, 0, target.size[0], target.size[1]);
        shared.output_onto_bound(&target, &look)
    }

    /// [`Self::paint`] as fast as possible, for pictures that are replaced soon: samples are averaged after encoding, which
    /// shifts edges by a fraction of a pixel. With one sample it differs by rounding alone.
    ///
    /// If all is opaque before a plain background, without overlays, it is drawn as [`Self::paint_scene_on_window`] does.
    pub fn paint_sketch(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        show: &DisplayOptions,
        canvas: &mut DisplayTexture,
    ) -> Result<Painted, GlError> {
        let is_plain = *show == DisplayOptions::default() && !frame.shadows;
        let Some(display) = display_of_objects(scene, frame).filter(|_| is_plain) else {
            return self.paint(scene, frame, show, canvas);
        };
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "sketch");
        let size = [frame.width, frame.height];
        if frame.samples == 1 {
            self.check_size(size)?;
            canvas.fit(size)?;
            canvas.begin_with_depth()?;
            let draw_calls = self.displayed_scene(scene, frame, display, Place { top_row_first: true, grid: 1 })?;
            return Ok(Painted { draw_calls, is_sketch: true, ..Painted::default() });
        }
        let mut notes = Vec::new();
        let height = frame.height as i32;
        let target = self.target_for(scene, frame, height, ColorPrecision::Displayed, PANES, &mut notes)?;
        canvas.fit(size)?;
        // Before anything is drawn: checking whether a program linked waits for all earlier draws.
        shared.output_program_for(&target, Display::Linear)?;
        target.begin(gl, 0, height);
        let place = Place { top_row_first: false, grid: target.sampling.grid() };
        let draw_calls = self.displayed_scene(scene, frame, display, place)?;
        target.resolve(gl);
        let whole = Band { picture_height: height, first_row: 0, rows: height };
        shared.output_into(canvas.output(), &target, whole, &DisplaySettings::of_numbers(), Display::Linear)?;
        Ok(Painted { notes, draw_calls, is_sketch: true, ..Painted::default() })
    }

    /// Draws opaque objects before the background as displayed colours, into the framebuffer that is bound.
    fn displayed_scene(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        display: (ToneMap, ColorEncoding),
        Place { top_row_first, grid }: Place,
    ) -> Result<u32, GlError> {
        let shared = Rc::clone(&self.shared);
        let gl = &shared.gl;
        self.fill_light_table(frame, None);
        let mut pass = self.pass(scene, frame, None, false)?;
        pass.display = Some(display);
        pass.top_row_first = top_row_first;
        let draws = opaque_draws(scene);
        for draw in &draws {
            pass.prepare(draw)?;
        }
        let [width, height] = [frame.width, frame.height].map(|side| side as i32 * grid);
        gl.viewport(0, 0, width, height);
        gl.color_mask(true, true, true, true);
        gl.depth_mask(true);
        gl.clear_depth_f32(1.0);
        gl.enable(glow::SCISSOR_TEST);
        for (rows, color) in background_bands(frame) {
            let start = if top_row_first { frame.height - rows.end } else { rows.start };
            gl.scissor(0, start as i32 * grid, width, rows.len() as i32 * grid);
            let [r, g, b] = color.map(|value| f32::from(value) / 255.0);
            gl.clear_color(r, g, b, 1.0);
            gl.clear(glow::COLOR_BUFFER_BIT);
        }
        gl.disable(glow::SCISSOR_TEST);
        gl.clear(glow::DEPTH_BUFFER_BIT);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LESS);
        gl.disable(glow::BLEND);
        for draw in &draws {
            pass.draw(draw)?;
        }
        gl.disable(glow::CULL_FACE);
        gl.front_face(glow::CCW);
        gl.bind_vertex_array(None);
        Ok(draws.len() as u32)
    }
}

/// Where displayed colours are drawn in a framebuffer.
#[derive(Clone, Copy)]
struct Place {
    /// The top row comes first, as on a display texture.
    top_row_first: bool,
    /// Texels along a pixel's side.
    grid: i32,
}

/// The tone map and encoding with which the objects' programs can write displayed colours: if all is opaque before a plain
/// background.
fn display_of_objects(scene: &GpuScene, frame: &Frame) -> Option<(ToneMap, ColorEncoding)> {
    let is_opaque = scene.objects.iter().all(|object| object.transparent.is_empty()) && !frame.background.transparent;
    match (DisplaySettings::new(None, frame).encoded(), frame.surroundings) {
        (Display::Light(tone_map, encoding), None) if is_opaque => Some((tone_map, encoding)),
        _ => None,
    }
}

/// The background as rows of one colour of 8 bits each, from the picture's bottom: a gradient between greys has few.
fn background_bands(frame: &Frame) -> Vec<(std::ops::Range<u32>, [u8; 3])> {
    let map = DisplayMap::for_view(None, frame);
    let mut bands: Vec<(std::ops::Range<u32>, [u8; 3])> = Vec::new();
    for row in 0..frame.height {
        let y = 1.0 - (f64::from(row) + 0.5) / f64::from(frame.height);
        let [r, g, b, _] = map.apply(frame.background.at(y).map(|value| value as f32));
        let color = [r, g, b].map(|value| (value * 255.0).round() as u8);
        match bands.last_mut() {
            Some((rows, last)) if *last == color => rows.end = row + 1,
            _ => bands.push((row..row + 1, color)),
        }
    }
    bands
}
