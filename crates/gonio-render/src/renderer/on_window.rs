//! Pictures over all of a context's own framebuffer: a window, or the canvas of a page.

use super::output::DisplaySettings;
use super::{PANES, Renderer, opaque_draws};
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
        let look = DisplaySettings::new(None, frame).to_be_shown();
        let is_opaque =
            scene.objects.iter().all(|object| object.transparent.is_empty()) && !frame.background.transparent;
        if let (Display::Light(tone_map, encoding), true, 1, None) =
            (look.encoded(), is_opaque, frame.samples, frame.surroundings)
        {
            return self.displayed_scene(scene, frame, (tone_map, encoding));
        }
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

    /// Draws opaque objects before the background as displayed colours.
    fn displayed_scene(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        display: (ToneMap, ColorEncoding),
    ) -> Result<(), GlError> {
        let shared = Rc::clone(&self.shared);
        let gl = &shared.gl;
        self.fill_light_table(frame, None);
        let mut pass = self.pass(scene, frame, None, false)?;
        pass.display = Some(display);
        let draws = opaque_draws(scene);
        for draw in &draws {
            pass.prepare(draw)?;
        }
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        gl.viewport(0, 0, frame.width as i32, frame.height as i32);
        gl.color_mask(true, true, true, true);
        gl.depth_mask(true);
        gl.clear_depth_f32(1.0);
        gl.enable(glow::SCISSOR_TEST);
        for (rows, color) in background_bands(frame) {
            gl.scissor(0, rows.start as i32, frame.width as i32, rows.len() as i32);
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
        Ok(())
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
