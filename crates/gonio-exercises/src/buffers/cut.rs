//! Triangulation of polygons: how a correct reader cuts one, and whether a student's triangles cover one.

use glam::DVec3;
use gonio_mesh::{Limits, NoSidecars};
use std::collections::HashMap;
use std::fmt::Write;

/// A polygon's triangles as gonio-mesh cuts them (corners counted from 0), and whether the polygon is convex, so that every
/// triangulation of it draws the same. Fewer than three corners have no triangles.
pub(super) fn polygon(corners: &[[f32; 3]]) -> (Vec<[usize; 3]>, bool) {
    if corners.len() < 3 {
        return (Vec::new(), true);
    }
    let fan = || (1..corners.len() - 1).map(|i| [0, i, i + 1]).collect();
    if is_convex(corners) {
        return (fan(), true);
    }
    // The library that reads the model cuts a model with this polygon alone.
    let mut text = String::new();
    let mut face = String::from("f");
    for (number, [x, y, z]) in (1..).zip(corners) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {x} {y} {z}");
        let _ = write!(face, " {number}");
    }
    text.push_str(&face);
    let read = gonio_mesh::obj::read(text.as_bytes(), &mut NoSidecars, &Limits::default());
    match read {
        Ok(model) if model.mesh.positions.len() == corners.len() => {
            (model.mesh.indices.as_chunks::<3>().0.iter().map(|t| t.map(|i| i as usize)).collect(), false)
        }
        _ => (fan(), false),
    }
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

/// Newell's normal: twice the vector area.
fn area_vector(corners: &[[f32; 3]]) -> DVec3 {
    let origin = corners.first().map_or(DVec3::ZERO, |corner| wide(*corner));
    let relative = |i: usize| wide(corners[i % corners.len()]) - origin;
    (0..corners.len()).map(|i| relative(i).cross(relative(i + 1))).sum()
}

/// Whether every corner turns the same way. Polygons that go around more than once do not occur in models.
fn is_convex(corners: &[[f32; 3]]) -> bool {
    let n = corners.len();
    let normal = area_vector(corners);
    n == 3
        || (0..n).all(|i| {
            let [a, b, c] = [corners[i], corners[(i + 1) % n], corners[(i + 2) % n]].map(wide);
            (b - a).cross(c - b).dot(normal) > 0.0
        })
}

/// Whether triangles (of corners counted from 0) cover a polygon once: each side is a side of one triangle, every other
/// edge belongs to two that lie on both of its sides, and none is turned over.
pub(super) fn covers(corners: &[[f32; 3]], triangles: &[[usize; 3]]) -> bool {
    let n = corners.len();
    if triangles.len() + 2 != n || triangles.iter().flatten().any(|corner| *corner >= n) {
        return false;
    }
    let mut edges: HashMap<(usize, usize), i32> = HashMap::new();
    for [a, b, c] in triangles {
        for edge in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    let count = |a: usize, b: usize| edges.get(&(a, b)).copied().unwrap_or(0);
    let is_joined = edges.iter().all(|((a, b), times)| {
        let is_side = (a + 1) % n == *b;
        *times == 1 && if is_side { count(*b, *a) == 0 } else { count(*b, *a) == 1 }
    });
    let sides = (0..n).all(|i| count(i, (i + 1) % n) == 1);
    let normal = area_vector(corners);
    // Corners on a straight line make triangles without area, which rounding may turn over.
    let slack = -1e-6 * normal.length_squared();
    let is_upright = triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|i| wide(corners[i]));
        (b - a).cross(c - a).dot(normal) >= slack
    });
    sides && is_joined && is_upright
}
