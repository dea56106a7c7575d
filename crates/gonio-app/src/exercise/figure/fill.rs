//! The inside of a shape of any form: egui's own fills are of convex ones.

use egui::{Color32, Mesh, Pos2, Shape, pos2};

/// The inside of lines from point to point: what an odd number of them surrounds.
pub fn inside(points: &[Pos2], color: Color32) -> Shape {
    if is_convex(points) {
        return Shape::convex_polygon(points.to_vec(), color, egui::Stroke::NONE);
    }
    let mut mesh = Mesh::default();
    let mut across: Vec<f32> = points.iter().map(|point| point.x).collect();
    across.sort_by(f32::total_cmp);
    across.dedup();
    // Between the places of two corners all lines are straight: what they enclose there are trapezoids.
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

/// Height of an edge at the left and the right end of a strip; `None` if it does not cross the strip.
fn within([a, b]: [Pos2; 2], left: f32, right: f32) -> Option<[f32; 2]> {
    let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
    let at = |x: f32| a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    (a.x <= left && b.x >= right && a.x < b.x).then(|| [at(left), at(right)])
}

/// Whether it turns one way at all corners.
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

    fn points(of: &[[f32; 2]]) -> Vec<Pos2> {
        of.iter().map(|[x, y]| pos2(*x, *y)).collect()
    }

    #[test]
    fn the_inside_has_the_area_that_it_has_on_paper() {
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
