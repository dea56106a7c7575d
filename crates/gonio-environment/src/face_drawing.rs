//! Antialiased strokes and words on a square picture, in linear light, and the stroke font of the words: the letters of
//! the debug cubemap.

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
        let (mut strokes, length) = strokes_of(word);
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

/// A pen stroke: points joined by straight lines.
type Stroke = Vec<DVec2>;

/// Height of capitals.
const CAPITAL: f64 = 1.4;

/// Gap between letters.
const GAP: f64 = 0.42;

/// A part of a letter.
enum Part {
    Line(&'static [(f64, f64)]),
    /// Centre, radii, and from which angle to which, in degrees anticlockwise from the right.
    Arc((f64, f64), (f64, f64), f64, f64),
}
use Part::{Arc, Line};

/// Returns the width and the parts of a letter; an unknown letter is blank.
fn glyph(letter: char) -> (f64, &'static [Part]) {
    const HALF: (f64, f64) = (0.5, 0.5);
    match letter {
        'X' => (1.05, &[Line(&[(0.0, 0.0), (1.05, CAPITAL)]), Line(&[(0.0, CAPITAL), (1.05, 0.0)])]),
        'Y' => (1.1, &[Line(&[(0.0, CAPITAL), (0.55, 0.68), (1.1, CAPITAL)]), Line(&[(0.55, 0.68), (0.55, 0.0)])]),
        'Z' => (1.0, &[Line(&[(0.0, CAPITAL), (1.0, CAPITAL), (0.0, 0.0), (1.0, 0.0)])]),
        '+' => (0.9, &[Line(&[(0.0, 0.7), (0.9, 0.7)]), Line(&[(0.45, 0.25), (0.45, 1.15)])]),
        '-' => (0.9, &[Line(&[(0.0, 0.7), (0.9, 0.7)])]),
        'e' => (1.0, &[Line(&[(0.0, 0.5), (1.0, 0.5)]), Arc(HALF, HALF, 0.0, 315.0)]),
        'g' => {
            (1.0, &[Arc(HALF, HALF, 0.0, 360.0), Line(&[(1.0, 1.0), (1.0, 0.0)]), Arc((0.5, 0.0), HALF, 0.0, -150.0)])
        }
        'n' => (
            0.9,
            &[
                Line(&[(0.0, 0.0), (0.0, 1.0)]),
                Arc((0.45, 0.55), (0.45, 0.45), 180.0, 0.0),
                Line(&[(0.9, 0.55), (0.9, 0.0)]),
            ],
        ),
        'o' => (1.0, &[Arc(HALF, HALF, 0.0, 360.0)]),
        'p' => (1.0, &[Line(&[(0.0, 1.0), (0.0, -0.5)]), Arc(HALF, HALF, 0.0, 360.0)]),
        's' => (0.78, &[Arc((0.39, 0.75), (0.35, 0.25), 25.0, 270.0), Arc((0.39, 0.25), (0.39, 0.25), 90.0, -150.0)]),
        'x' => (0.85, &[Line(&[(0.0, 0.0), (0.85, 1.0)]), Line(&[(0.0, 1.0), (0.85, 0.0)])]),
        'y' => (0.9, &[Line(&[(0.0, 1.0), (0.46, 0.0)]), Line(&[(0.9, 1.0), (0.23, -0.5)])]),
        'z' => (0.85, &[Line(&[(0.0, 1.0), (0.85, 1.0), (0.0, 0.0), (0.85, 0.0)])]),
        _ => (0.6, &[]),
    }
}

/// Returns the strokes of a word, from `x = 0`, and its width.
fn strokes_of(word: &str) -> (Vec<Stroke>, f64) {
    let (mut strokes, mut at) = (Vec::new(), 0.0);
    for letter in word.chars() {
        let (width, parts) = glyph(letter);
        for part in parts {
            let mut stroke = points(part);
            stroke.iter_mut().for_each(|p| p.x += at);
            strokes.push(stroke);
        }
        at += width + GAP;
    }
    (strokes, (at - GAP).max(0.0))
}

fn points(part: &Part) -> Stroke {
    match *part {
        Line(points) => points.iter().map(|&(x, y)| DVec2::new(x, y)).collect(),
        Arc(centre, radii, from, to) => {
            // Every 10 degrees: a chord is 0.4 % of the radius away from its arc.
            let steps = ((to - from).abs() / 10.0).ceil().max(1.0);
            let at = |i: f64| {
                let (sin, cos) = (from + (to - from) * i / steps).to_radians().sin_cos();
                DVec2::new(centre.0 + radii.0 * cos, centre.1 + radii.1 * sin)
            };
            (0..=steps as u32).map(|i| at(f64::from(i))).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_that_is_needed_is_there() {
        for word in ["+X", "-Y", "Z", "posx", "negy", "posz"] {
            for letter in word.chars() {
                assert!(!glyph(letter).1.is_empty(), "{letter}");
            }
            let (strokes, width) = strokes_of(word);
            // Nothing is wider than its place, or it would touch its neighbour.
            for p in strokes.iter().flatten() {
                assert!((-1e-9..=width + 1e-9).contains(&p.x) && (-0.51..=CAPITAL).contains(&p.y), "{word}: {p}");
            }
        }
        assert_eq!(strokes_of("").1, 0.0);
    }
}
