//! Pictures that the objects' programs write as displayed colours, without a linear picture before: over all of a context's own
//! framebuffer (a window, or the canvas of a page), and on display textures while something moves.

use super::output::DisplaySettings;
use super::{PANES, Painted, Renderer, opaque_draws};
use crate::display::{DisplayOptions, DisplayTexture};
use crate::glsl::Display;
use crate::scene_on_gpu::GpuScene;
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
        if let Some(display) = display_of_objects(scene, frame) {
            shared.gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            return self.displayed_scene(scene, frame, display, false).map(drop);
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

    /// [`Self::paint`], with one sample a pixel and as fast as possible, for pictures that are replaced soon. It differs by
    /// rounding alone.
    ///
    /// If all is opaque before a plain background, without overlays, it is drawn as [`Self::paint_scene_on_window`] does.
    pub fn paint_sketch(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        show: &DisplayOptions,
        canvas: &mut DisplayTexture,
    ) -> Result<Painted, GlError> {
        let frame = Frame { samples: 1, ..frame.clone() };
        let is_plain = *show == DisplayOptions::default();
        let size = [frame.width, frame.height];
        let is_drawable = size.iter().all(|side| *side <= self.shared.info.max_size);
        let display = display_of_objects(scene, &frame).filter(|_| is_plain && is_drawable && !frame.shadows);
        let Some(display) = display else { return self.paint(scene, &frame, show, canvas) };
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        canvas.fit(size)?;
        canvas.begin_with_depth()?;
        let draw_calls = self.displayed_scene(scene, &frame, display, true)?;
        Ok(Painted { draw_calls, ..Painted::default() })
    }

    /// Draws opaque objects before the background as displayed colours, into the framebuffer that is bound.
    fn displayed_scene(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        display: (ToneMap, ColorEncoding),
        top_row_first: bool,
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
        gl.viewport(0, 0, frame.width as i32, frame.height as i32);
        gl.color_mask(true, true, true, true);
        gl.depth_mask(true);
        gl.clear_depth_f32(1.0);
        gl.enable(glow::SCISSOR_TEST);
        for (rows, color) in background_bands(frame) {
            let start = if top_row_first { frame.height - rows.end } else { rows.start };
            gl.scissor(0, start as i32, frame.width as i32, rows.len() as i32);
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

/// The tone map and encoding with which the objects' programs can write displayed colours: if there is one sample a pixel, and
/// all is opaque before a plain background.
fn display_of_objects(scene: &GpuScene, frame: &Frame) -> Option<(ToneMap, ColorEncoding)> {
    let is_opaque = scene.objects.iter().all(|object| object.transparent.is_empty()) && !frame.background.transparent;
    match (DisplaySettings::new(None, frame).encoded(), frame.surroundings) {
        (Display::Light(tone_map, encoding), None) if is_opaque && frame.samples == 1 => Some((tone_map, encoding)),
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
