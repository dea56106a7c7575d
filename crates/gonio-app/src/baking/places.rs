//! From a texel to the surface, and back.

use glam::{DVec2, DVec3};
use gonio_bake::BakedAtlas;

/// A point of the surface, and its texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtlasPlace {
    /// Triangle of the baked surface.
    pub triangle: usize,
    /// The chart.
    pub chart: u32,
    /// Texture coordinates, v up.
    pub uv: DVec2,
    /// World space.
    pub position: DVec3,
    /// The triangle's unit normal, world space; zero without an area.
    pub normal: DVec3,
}

/// Finds triangles by their texture coordinates: those of each cell of a grid over the unit square.
pub struct TexelTriangles {
    side: usize,
    cells: Vec<Vec<u32>>,
}

/// Limits of the cells along a side.
const SIDES: [f64; 2] = [8.0, 512.0];

impl TexelTriangles {
    /// Sorts the triangles of an atlas.
    pub fn new(atlas: &BakedAtlas) -> Self {
        let triangles = atlas.uv.tex_coords.as_chunks::<3>().0;
        let side = (triangles.len() as f64).sqrt().clamp(SIDES[0], SIDES[1]) as usize;
        let mut cells = vec![Vec::new(); side * side];
        let cell = |value: f32| ((value * side as f32) as usize).min(side - 1);
        for (index, corners) in triangles.iter().enumerate() {
            let bound = |axis: usize, pick: fn(f32, f32) -> f32| {
                corners[1..].iter().fold(corners[0][axis], |b, c| pick(b, c[axis]))
            };
            let [low, high] = [f32::min, f32::max].map(|pick| [bound(0, pick), bound(1, pick)]);
            let is_inside = corners.as_flattened().iter().all(|c| c.is_finite())
                && high.iter().all(|h| *h >= 0.0)
                && low.iter().all(|l| *l <= 1.0);
            if !is_inside || atlas.uv.chart_of_triangle.get(index).copied().flatten().is_none() {
                continue;
            }
            for row in cell(low[1])..=cell(high[1]) {
                for column in cell(low[0])..=cell(high[0]) {
                    cells[row * side + column].push(index as u32);
                }
            }
        }
        TexelTriangles { side, cells }
    }

    /// The place at these texture coordinates; `None` between the charts. Where charts overlap, the last triangle counts.
    pub fn place(&self, atlas: &BakedAtlas, uv: DVec2) -> Option<AtlasPlace> {
        if !(DVec2::ZERO.cmple(uv) & uv.cmple(DVec2::ONE)).all() {
            return None;
        }
        let cell = |value: f64| ((value * self.side as f64) as usize).min(self.side - 1);
        let members = self.cells.get(cell(uv.y) * self.side + cell(uv.x))?;
        members.iter().rev().find_map(|&triangle| {
            let weights = weights(corners(atlas, triangle as usize)?, uv)?;
            place(atlas, triangle as usize, weights)
        })
    }
}

/// The place in a triangle with these weights of its corners.
pub fn place(atlas: &BakedAtlas, triangle: usize, weights: DVec3) -> Option<AtlasPlace> {
    let chart = atlas.uv.chart_of_triangle.get(triangle).copied().flatten()?;
    let [a, b, c] = corners(atlas, triangle)?;
    let positions = atlas.corners.get(3 * triangle..3 * triangle + 3)?;
    let [p, q, r] = [0, 1, 2].map(|k| DVec3::from(positions[k].map(f64::from)));
    let [u, v, w] = weights.to_array();
    Some(AtlasPlace {
        triangle,
        chart,
        uv: u * a + v * b + w * c,
        position: u * p + v * q + w * r,
        normal: (q - p).cross(r - p).normalize_or_zero(),
    })
}

fn corners(atlas: &BakedAtlas, triangle: usize) -> Option<[DVec2; 3]> {
    let uv = atlas.uv.tex_coords.get(3 * triangle..3 * triangle + 3)?;
    Some([0, 1, 2].map(|k| DVec2::from(uv[k].map(f64::from))))
}

/// The weights of the corners at a point within a triangle.
fn weights([a, b, c]: [DVec2; 3], point: DVec2) -> Option<DVec3> {
    let area = (b - a).perp_dot(c - a);
    let weights =
        DVec3::new((b - point).perp_dot(c - point), (c - point).perp_dot(a - point), (a - point).perp_dot(b - point));
    let weights = weights / area;
    (weights.is_finite() && weights.min_element() >= 0.0).then_some(weights)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_bake::BakeJob;
    use gonio_scene::files::BuiltinOnly;
    use gonio_scene::load;
    use std::path::Path;

    #[test]
    fn every_triangle_is_found_at_its_texture_coordinates() {
        let described = load::describe(&["builtin:still-life"], &BuiltinOnly).unwrap();
        let scene = load::load(described, Path::new(""), &BuiltinOnly).unwrap();
        let job = BakeJob { size: 32, ..BakeJob::default() };
        let atlas = job.run(&scene, 0.0, "still-life", &|_, _| true).unwrap();
        let triangles = TexelTriangles::new(&atlas);
        let mut found = 0;
        for triangle in 0..atlas.corners.len() / 3 {
            let Some(expected) = place(&atlas, triangle, DVec3::new(0.5, 0.2, 0.3)) else { continue };
            let place = triangles.place(&atlas, expected.uv).unwrap();
            assert_eq!((place.triangle, place.chart), (triangle, expected.chart));
            assert!(place.position.distance(expected.position) < 1e-4, "{place:?} {expected:?}");
            found += 1;
        }
        assert!(found > 500, "{found}");
        assert_eq!(triangles.place(&atlas, DVec2::new(0.0, 0.0)), None, "the margin");
        for outside in [DVec2::new(-0.1, 0.5), DVec2::new(0.5, 1.2), DVec2::splat(f64::NAN)] {
            assert_eq!(triangles.place(&atlas, outside), None);
        }
    }
}
