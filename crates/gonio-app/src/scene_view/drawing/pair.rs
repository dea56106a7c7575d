//! The difference of two panes: a map drawn on the GPU, and its statistics.

use super::pane::PaneDrawing;
use crate::document::DifferenceSettings;
use crate::session::comparison::DifferenceFacts;
use gonio_gl::{Gl, GlError};
use gonio_render::{DifferenceScale, DisplayTexture, Renderer};
use gonio_scene::difference;

/// A pixel differs where a colour is more than so many 8-bit steps apart.
const TOLERANCE: f64 = 1.0;

/// Identifies a pair of pictures: panes and picture numbers.
type Made = ([usize; 2], [u64; 2]);

/// State of the pair between pictures.
#[derive(Default)]
pub struct PairDrawing {
    pub map: Option<DisplayTexture>,
    drawn: Option<(Made, DifferenceSettings)>,
    measured: Option<(Made, DifferenceFacts)>,
}

impl PairDrawing {
    /// Draws the map, if anything changed since; whether there is one: both pictures are there, of one size.
    pub fn draw(
        &mut self,
        gl: &Gl,
        renderer: &mut Renderer,
        panes: [&PaneDrawing; 2],
        pair: [usize; 2],
        settings: DifferenceSettings,
    ) -> Result<bool, GlError> {
        let [Some(a), Some(b)] = panes.map(|pane| pane.canvas.as_ref()) else { return Ok(false) };
        if a.size() != b.size() {
            return Ok(false);
        }
        let wanted = ((pair, panes.map(|pane| pane.serial)), settings);
        if self.drawn != Some(wanted) {
            let map = match &mut self.map {
                Some(map) => map,
                none => none.insert(DisplayTexture::new(gl, a.size())?),
            };
            let scale = DifferenceScale { full_scale: settings.full_scale, signed: settings.signed };
            renderer.paint_difference(a, b, scale, map)?;
            self.drawn = Some(wanted);
        }
        Ok(true)
    }

    /// Its numbers: both pictures are read back, if they are others than last time.
    pub fn measured(&mut self, panes: [&PaneDrawing; 2], pair: [usize; 2]) -> Option<DifferenceFacts> {
        let made = (pair, panes.map(|pane| pane.serial));
        if let Some((of, facts)) = &self.measured
            && *of == made
        {
            return Some(facts.clone());
        }
        let [Some(a), Some(b)] = panes.map(|pane| pane.canvas.as_ref()) else { return None };
        let tally = difference::of_bytes(&a.read8(), &b.read8(), TOLERANCE);
        let facts = DifferenceFacts::new(&tally, a.size());
        self.measured = Some((made, facts.clone()));
        Some(facts)
    }
}
