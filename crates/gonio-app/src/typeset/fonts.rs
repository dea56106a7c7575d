//! Formulas in egui: how large its letters are, and how they are painted.

use super::layout::{Laid, Shape};
use super::node::{Face, Tag};
use super::{Extent, Measure};
use crate::theme;
use egui::{Color32, FontId, Galley, Painter, Pos2, Rect};
use std::sync::Arc;

fn font(face: Face, size: f32) -> FontId {
    match face {
        Face::Upright => theme::math_font(size),
        Face::Italic => theme::math_italic_font(size),
        Face::Large => theme::math_large_font(size),
    }
}

/// The baseline of a line of text, from the galley's top.
fn baseline(galley: &Galley) -> f32 {
    let row = galley.rows.first();
    row.and_then(|row| row.glyphs.first().map(|glyph| row.pos.y + glyph.pos.y)).unwrap_or_default()
}

/// The window's fonts.
pub struct EguiFonts<'a>(pub &'a Painter);

impl EguiFonts<'_> {
    fn galley(&self, text: &str, face: Face, size: f32, color: Color32) -> Arc<Galley> {
        self.0.layout_no_wrap(text.to_owned(), font(face, size), color)
    }
}

impl Measure for EguiFonts<'_> {
    fn measure(&mut self, text: &str, face: Face, size: f32) -> Extent {
        let galley = self.galley(text, face, size, Color32::PLACEHOLDER);
        let base = baseline(&galley);
        let ink = galley.mesh_bounds;
        let (ascent, descent) =
            if ink.is_positive() { ((base - ink.top()).max(0.0), (ink.bottom() - base).max(0.0)) } else { (0.0, 0.0) };
        Extent { width: galley.rect.width(), ascent, descent }
    }
}

/// Draws a formula whose baseline begins at `start`; gives the tagged parts' rectangles in the window.
pub fn paint(painter: &Painter, laid: &Laid, start: Pos2, color: &dyn Fn(Option<Tag>) -> Color32) -> Vec<(Tag, Rect)> {
    let fonts = EguiFonts(painter);
    for piece in &laid.pieces {
        let (at, color) = (start + piece.at, color(piece.tag));
        match &piece.shape {
            Shape::Text(text, face, size) => {
                let galley = fonts.galley(text, *face, *size, color);
                let top = at.y - baseline(&galley);
                painter.galley(Pos2::new(at.x, top), galley, color);
            }
            Shape::Rule(size) => {
                painter.rect_filled(Rect::from_min_size(at, *size), 0.0, color);
            }
        }
    }
    laid.tagged.iter().map(|(tag, rect)| (*tag, rect.translate(start.to_vec2()))).collect()
}
