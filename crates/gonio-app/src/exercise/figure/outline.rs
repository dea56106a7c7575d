//! Outlines of shapes: paths as points, and the inside of a closed outline.
//!
//! Paths have moves, lines, quadratic curves and arcs of circles, with absolute coordinates. The inside of an outline need
//! not be convex; egui fills convex shapes only.

use egui::{Color32, Mesh, Pos2, Shape, Vec2, pos2, vec2};
use std::f32::consts::TAU;

/// Number of pieces of a quarter of a circle, and of a curve: enough that no corner is visible.
const PIECES: usize = 16;

/// The points of a path, and whether it is closed. `None` if a command is not supported.
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
    // A circle that is too small is enlarged until it reaches both points.
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

/// The inside of a closed outline, by the even-odd rule.
pub fn inside(points: &[Pos2], color: Color32) -> Shape {
    if is_convex(points) {
        return Shape::convex_polygon(points.to_vec(), color, egui::Stroke::NONE);
    }
    let mut mesh = Mesh::default();
    let mut across: Vec<f32> = points.iter().map(|point| point.x).collect();
    across.sort_by(f32::total_cmp);
    across.dedup();
    // Between the x coordinates of two neighbouring corners, the inside consists of trapezoids.
    for strip in across.windows(2) {
        let &[left, right] = strip else { continue };
        let mut edges: Vec<[f32; 2]> = edges(points).filter_map(|edge| within(edge, left, right)).collect();
        edges.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        for pair in edges.chunks_exact(2) {
            let &[upper, lower] = pair else { continue };
            let first = mesh.vertices.len() as u32;
            for corner in [(left, upper[0]), (right, upper[1]), (right, lower[1]), (left, lower[0])] {
                mesh.colored_vertex(pos2(corner.0, corner.1), color);
            }
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first, first + 2, first + 3);
        }
    }
    Shape::mesh(mesh)
}

fn edges(points: &[Pos2]) -> impl Iterator<Item = [Pos2; 2]> + '_ {
    points.iter().copied().zip(points.iter().copied().cycle().skip(1)).map(|(from, to)| [from, to])
}

/// The y coordinates of an edge at both sides of a strip; `None` if the edge does not cross it.
fn within([a, b]: [Pos2; 2], left: f32, right: f32) -> Option<[f32; 2]> {
    let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
    let at = |x: f32| a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    (a.x <= left && b.x >= right && a.x < b.x).then(|| [at(left), at(right)])
}

/// Whether the outline turns the same way at all corners.
fn is_convex(points: &[Pos2]) -> bool {
    let mut turns = [false; 2];
    for [before, corner] in edges(points) {
        let next = edges(points).find(|[from, _]| *from == corner).map_or(corner, |[_, to]| to);
        let (a, b) = (corner - before, next - corner);
        let turn = a.x * b.y - a.y * b.x;
        // Corners are rounded to a tenth.
        if turn.abs() > 0.5 {
            turns[usize::from(turn > 0.0)] = true;
        }
    }
    turns != [true; 2]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn an_arc_lies_on_its_circle_and_ends_at_its_end_point() {
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
    fn curves_are_closed_and_unknown_commands_refused() {
        let (points, closed) = flattened("M0 0Q10 10 20 0Q10 -10 0 0Z").unwrap();
        assert!(closed && points[PIECES / 2].distance(pos2(10.0, 5.0)) < 1e-3, "{points:?}");
        assert!(flattened("M0 0C1 1 2 2 3 3").is_none() && flattened("m0 0l1 1").is_none() && flattened("").is_none());
    }

    fn points(of: &[[f32; 2]]) -> Vec<Pos2> {
        of.iter().map(|[x, y]| pos2(*x, *y)).collect()
    }

    #[test]
    fn the_inside_has_the_expected_area() {
        // An arrow head with a notch: a triangle of 200 less one of 50.
        let notched = points(&[[0.0, 0.0], [20.0, 10.0], [0.0, 20.0], [5.0, 10.0]]);
        assert!(!is_convex(&notched));
        let Shape::Mesh(mesh) = inside(&notched, Color32::RED) else { panic!("no mesh") };
        let area = |triangle: &[u32]| {
            let corner = |at: usize| mesh.vertices[triangle[at] as usize].pos;
            let (a, b) = (corner(1) - corner(0), corner(2) - corner(0));
            (a.x * b.y - a.y * b.x).abs() / 2.0
        };
        let area: f32 = mesh.indices.chunks(3).map(area).sum();
        assert!((area - 150.0).abs() < 1e-3, "{area}");
        assert!(is_convex(&points(&[[0.0, 0.0], [20.0, 10.0], [0.0, 20.0]])));
    }
}
