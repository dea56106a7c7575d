//! Antialiased strokes and words on a square picture, in linear light.

use crate::stroke_font::{self, CAPITAL, Stroke};
use glam::{DVec2, DVec3};
use gonio_image::Image;

/// A face being drawn. Positions are (s, t), both from -1 to 1, columns to the right and rows downwards.
pub(crate) struct FaceDrawing {
    size: u32,
    colors: Vec<DVec3>,
    /// The share of each texel that the current strokes cover.
    covered: Vec<f64>,
}

impl FaceDrawing {
    /// Fills the face with a function of the position, evaluated at the middle of each texel.
    pub fn new(size: u32, ground: impl Fn(DVec2) -> DVec3) -> Self {
        let middle = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(size) - 1.0;
        let colors: Vec<DVec3> =
            (0..size).flat_map(|y| (0..size).map(move |x| DVec2::new(middle(x), middle(y)))).map(ground).collect();
        FaceDrawing { size, covered: vec![0.0; colors.len()], colors }
    }

    /// Draws lines of a width and an opacity, with round ends. Where they cross they count once.
    pub fn stroke(&mut self, strokes: &[Stroke], width: f64, color: DVec3, opacity: f64) {
        self.covered.fill(0.0);
        for stroke in strokes {
            for ends in stroke.windows(2) {
                self.cover(ends[0], ends[1], 0.5 * width);
            }
        }
        for (there, covered) in self.colors.iter_mut().zip(&self.covered) {
            *there = there.lerp(color, covered * opacity);
        }
    }

    /// Writes a word with the middle of its capitals at `centre`. `height` is the height of a capital.
    pub fn write(&mut self, word: &str, centre: DVec2, height: f64, width: f64, color: DVec3) {
        let (mut strokes, length) = stroke_font::write(word);
        let scale = height / CAPITAL;
        for p in strokes.iter_mut().flatten() {
            // Letters stand upwards, rows run downwards.
            *p = centre + scale * DVec2::new(p.x - 0.5 * length, 0.5 * CAPITAL - p.y);
        }
        self.stroke(&strokes, width, color, 1.0);
    }

    /// Covers the texels near a straight line: fully inside, and falling off over the width of one texel.
    fn cover(&mut self, a: DVec2, b: DVec2, half_width: f64) {
        let texel = 2.0 / f64::from(self.size);
        let reach = half_width + texel;
        let column = |v: f64| (0.5 * (v + 1.0) * f64::from(self.size)).clamp(0.0, f64::from(self.size)) as u32;
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        // A line thinner than a texel never covers it whole.
        let most = (2.0 * half_width / texel).min(1.0);
        for y in column(low.y)..(column(high.y) + 1).min(self.size) {
            for x in column(low.x)..(column(high.x) + 1).min(self.size) {
                let p = texel * (DVec2::new(f64::from(x), f64::from(y)) + 0.5) - 1.0;
                let along = b - a;
                let share = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
                let distance = (p - a - share * along).length();
                let covers = ((half_width - distance) / texel + 0.5).clamp(0.0, most);
                let there = &mut self.covered[(y * self.size + x) as usize];
                *there = there.max(covers);
            }
        }
    }

    /// Returns the picture, opaque.
    pub fn finish(self) -> Image {
        let pixels = self.colors.iter().map(|c| [c.x as f32, c.y as f32, c.z as f32, 1.0]).collect();
        Image { width: self.size, height: self.size, pixels }
    }
}
