//! A stroke font with the letters of the debug cubemap.
//!
//! Units: a small letter `x` is 1 high; `y` points up from the baseline.

use glam::DVec2;

/// A pen stroke: points joined by straight lines.
pub(crate) type Stroke = Vec<DVec2>;

/// Height of capitals.
pub(crate) const CAPITAL: f64 = 1.4;

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
pub(crate) fn write(word: &str) -> (Vec<Stroke>, f64) {
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
            let (strokes, width) = write(word);
            // Nothing is wider than its place, or it would touch its neighbour.
            for p in strokes.iter().flatten() {
                assert!((-1e-9..=width + 1e-9).contains(&p.x) && (-0.51..=CAPITAL).contains(&p.y), "{word}: {p}");
            }
        }
        assert_eq!(write("").1, 0.0);
    }
}
