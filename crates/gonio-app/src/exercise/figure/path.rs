//! A path as points: moves, lines, quadratic curves and arcs of circles, with absolute coordinates.

use egui::{Pos2, Vec2, pos2, vec2};
use std::f32::consts::TAU;

/// Pieces of a quarter of a circle, and of a curve: at the sizes of figures no corner is seen.
const PIECES: usize = 16;

/// The points, and whether the last is joined with the first. Nothing where there is a command that is not known here.
pub fn flattened(d: &str) -> Option<(Vec<Pos2>, bool)> {
    let mut points: Vec<Pos2> = Vec::new();
    let mut closed = false;
    let mut rest = d;
    while let Some(command) = rest.chars().next() {
        rest = rest.get(command.len_utf8()..)?;
        let end = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let numbers: Vec<f32> = numbers(rest.get(..end)?)?;
        rest = rest.get(end..)?;
        match (command, numbers.as_slice()) {
            ('M', &[x, y]) if points.is_empty() => points.push(pos2(x, y)),
            ('L', pairs) => points.extend(pairs.chunks_exact(2).map(|pair| pos2(pair[0], pair[1]))),
            ('Q', &[x1, y1, x, y]) => curve(&mut points, pos2(x1, y1), pos2(x, y))?,
            ('A', &[radius, same, _, large, clockwise, x, y]) if radius == same => {
                arc(&mut points, radius, large != 0.0, clockwise != 0.0, pos2(x, y))?;
            }
            ('Z', &[]) => closed = true,
            _ => return None,
        }
    }
    (points.len() > 1).then_some((points, closed))
}

/// Numbers between spaces and commas.
fn numbers(text: &str) -> Option<Vec<f32>> {
    text.split([' ', ',']).filter(|number| !number.is_empty()).map(|number| number.parse().ok()).collect()
}

/// A quadratic Bézier curve.
fn curve(points: &mut Vec<Pos2>, control: Pos2, to: Pos2) -> Option<()> {
    let from = *points.last()?;
    points.extend((1..=PIECES).map(|piece| {
        let t = piece as f32 / PIECES as f32;
        from.lerp(control, t).lerp(control.lerp(to, t), t)
    }));
    Some(())
}

/// An arc of a circle: W3C, SVG 2, appendix B.2.4, for equal radii.
fn arc(points: &mut Vec<Pos2>, radius: f32, large: bool, clockwise: bool, to: Pos2) -> Option<()> {
    let from = *points.last()?;
    let half = (to - from) / 2.0;
    let length = half.length();
    // Too small a circle is made as large as it must be.
    let radius = radius.abs().max(length);
    if length < 1e-6 {
        return Some(());
    }
    let away = (radius * radius - length * length).max(0.0).sqrt() / length;
    let side = if large == clockwise { -away } else { away };
    let center = from + half + vec2(half.y, -half.x) * -side;
    let angle = |point: Pos2| (point - center).angle();
    let mut turn = angle(to) - angle(from);
    if clockwise && turn < 0.0 {
        turn += TAU;
    } else if !clockwise && turn > 0.0 {
        turn -= TAU;
    }
    let pieces = (turn.abs() / (TAU / 4.0) * PIECES as f32).ceil().max(1.0) as usize;
    points.extend((1..=pieces).map(|piece| {
        let angle = angle(from) + turn * piece as f32 / pieces as f32;
        center + Vec2::angled(angle) * radius
    }));
    Some(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn an_arc_lies_on_its_circle_and_ends_where_it_should() {
        // A quarter around (0, 0) from right to down, which is clockwise where y points down.
        for (d, center, middle) in [
            ("M10 0A10 10 0 0 1 0 10", pos2(0.0, 0.0), pos2(7.071, 7.071)),
            ("M10 0A10 10 0 0 0 0 10", pos2(10.0, 10.0), pos2(2.929, 2.929)),
            ("M10 0A10 10 0 1 0 0 10", pos2(0.0, 0.0), pos2(-7.071, -7.071)),
            ("M10 0A10 10 0 1 1 0 10", pos2(10.0, 10.0), pos2(17.071, 17.071)),
        ] {
            let (points, closed) = flattened(d).unwrap();
            assert!(points.iter().all(|point| (point.distance(center) - 10.0).abs() < 1e-3), "{d}: {points:?}");
            assert!(points[points.len() / 2].distance(middle) < 0.6, "{d}: {points:?}");
            assert!(points.last().unwrap().distance(pos2(0.0, 10.0)) < 1e-3 && !closed);
        }
    }

    #[test]
    fn curves_are_closed_and_what_is_not_known_is_refused() {
        let (points, closed) = flattened("M0 0Q10 10 20 0Q10 -10 0 0Z").unwrap();
        assert!(closed && points[PIECES / 2].distance(pos2(10.0, 5.0)) < 1e-3, "{points:?}");
        assert!(flattened("M0 0C1 1 2 2 3 3").is_none() && flattened("m0 0l1 1").is_none() && flattened("").is_none());
    }
}
