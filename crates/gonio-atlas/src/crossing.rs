//! Finds a chart that overlaps itself: a triangle is turned over, two edges of its border cross or touch, or triangles
//! around a vertex of the border overlap.
//!
//! Where no triangle is turned over, a chart covers each point of the plane as often as its border winds around it, so
//! a border that never meets itself proves that the chart does not overlap.

use crate::flatten::{ChartMesh, signed_area};
use glam::DVec2;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Returns two triangles (indices into the chart's) at which the chart overlaps itself; `None` if it does not.
pub(crate) fn find_overlap(chart: &ChartMesh, plane: &[DVec2]) -> Option<(usize, usize)> {
    if chart.corners.len() < 2 {
        return None;
    }
    if let Some(turned) = chart.corners.iter().position(|c| signed_area(c.map(|i| plane[i as usize])) <= 0.0) {
        // The triangle turned over, and one far from it.
        let other = if turned == 0 { chart.corners.len() - 1 } else { 0 };
        return Some((turned, other));
    }
    if let Some(found) = overlap_around_vertex(chart, plane) {
        return Some(found);
    }
    let edges: Vec<Segment> = chart
        .border
        .iter()
        .map(|edge| {
            let (i, j) = chart.border_ends(edge);
            Segment { ends: [i, j], places: [plane[i as usize], plane[j as usize]], triangle: edge.0 }
        })
        .collect();
    let cell = cell_size(&edges)?;
    let mut grid: HashMap<(i64, i64), Vec<u32>> = HashMap::new();
    for (index, segment) in edges.iter().enumerate() {
        for key in cells(segment, cell) {
            let others = grid.entry(key).or_default();
            for &other in others.iter() {
                if segment.meets(&edges[other as usize]) && segment.triangle != edges[other as usize].triangle {
                    return Some((segment.triangle as usize, edges[other as usize].triangle as usize));
                }
            }
            others.push(index as u32);
        }
    }
    None
}

/// The sum of the angles around a vertex may exceed a full turn by this much where edges of the border coincide.
const ROUNDING: f64 = 1e-9;

/// Edges with a common end are not compared with each other, so the angles between them are.
///
/// The triangles around a vertex must not add up to more than a full turn, and where several fans of triangles meet, the
/// edges at which they begin and end must alternate.
fn overlap_around_vertex(chart: &ChartMesh, plane: &[DVec2]) -> Option<(usize, usize)> {
    let mut is_border = vec![false; plane.len()];
    let mut turns = vec![0.0; plane.len()];
    // Vertex, angle of the edge, whether a fan begins there, triangle.
    let mut rays: Vec<(u32, f64, bool, u32)> = Vec::with_capacity(2 * chart.border.len());
    for edge in &chart.border {
        let (i, j) = chart.border_ends(edge);
        let along = plane[j as usize] - plane[i as usize];
        rays.push((i, along.to_angle(), true, edge.0));
        rays.push((j, (-along).to_angle(), false, edge.0));
        (is_border[i as usize], is_border[j as usize]) = (true, true);
    }
    for corners in &chart.corners {
        for k in 0..3 {
            let [at, next, last] = [0, 1, 2].map(|step| corners[(k + step) % 3] as usize);
            if is_border[at] {
                turns[at] += (plane[next] - plane[at]).angle_to(plane[last] - plane[at]).abs();
            }
        }
    }
    rays.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    for around in rays.chunk_by(|a, b| a.0 == b.0) {
        let alternate = around.windows(2).all(|pair| pair[0].2 != pair[1].2);
        if turns[around[0].0 as usize] > TAU + ROUNDING || (around.len() > 2 && !alternate) {
            let other = around.iter().find(|ray| ray.3 != around[0].3)?;
            return Some((around[0].3 as usize, other.3 as usize));
        }
    }
    None
}

struct Segment {
    ends: [u32; 2],
    places: [DVec2; 2],
    triangle: u32,
}

impl Segment {
    /// Whether two segments without a common end have a common point.
    fn meets(&self, other: &Segment) -> bool {
        if self.ends.iter().any(|end| other.ends.contains(end)) {
            return false;
        }
        let ([a, b], [c, d]) = (self.places, other.places);
        let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
        let (c_side, d_side) = (side(a, b, c), side(a, b, d));
        let (a_side, b_side) = (side(c, d, a), side(c, d, b));
        if c_side * d_side > 0.0 || a_side * b_side > 0.0 {
            return false;
        }
        // Segments on one line meet if their boxes do.
        a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all()
    }
}

/// Twice the mean length, but no more than 4096 cells along a side.
fn cell_size(edges: &[Segment]) -> Option<f64> {
    let lengths: f64 = edges.iter().map(|s| s.places[0].distance(s.places[1])).sum();
    let points = || edges.iter().flat_map(|s| s.places);
    let (low, high) = (points().reduce(DVec2::min)?, points().reduce(DVec2::max)?);
    let cell = (2.0 * lengths / edges.len() as f64).max((high - low).max_element() / 4096.0);
    (cell.is_finite() && cell > 0.0).then_some(cell)
}

/// The cells that a segment's box touches, except those that the segment is far from.
fn cells(segment: &Segment, cell: f64) -> impl Iterator<Item = (i64, i64)> {
    let [a, b] = segment.places;
    let (low, high) = ((a.min(b) / cell).floor(), (a.max(b) / cell).floor());
    let (direction, middle) = ((b - a).normalize_or(DVec2::X), 0.5 * (a + b));
    let columns = low.x as i64..=high.x as i64;
    columns.flat_map(move |x| (low.y as i64..=high.y as i64).map(move |y| (x, y))).filter(move |&(x, y)| {
        let center = cell * (DVec2::new(x as f64, y as f64) + 0.5);
        direction.perp_dot(center - middle).abs() <= 0.75 * cell
    })
}
