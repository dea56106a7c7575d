//! The student's texture coordinates: where they are, and which charts they form.

use super::answer::Answer;
use super::matching::{Counterpart, Matching};
use super::original::Original;
use gonio_atlas::{UnwrapSettings, UvSource, unwrap};

/// Coordinates this far outside of the unit square are rounding.
const ROUNDING: f32 = 1e-3;
/// Coordinates are those of the original if they differ by no more.
const SAME: f32 = 2e-4;

/// The texture coordinates of an answer, and the counterparts of its triangles.
pub struct UvLayout {
    /// Three for each triangle, v up. Triangles that are wholly in another tile are moved to the unit square if the texture
    /// repeats.
    pub tex_coords: Vec<[f32; 2]>,
    /// Whether a triangle was moved, or reaches out of the unit square.
    pub is_outside: Vec<bool>,
    /// The chart of each triangle; `None` without an area.
    pub chart: Vec<Option<u32>>,
    /// The part of the original that each triangle belongs to.
    pub part: Vec<Option<u16>>,
}

impl UvLayout {
    /// Returns the layout; `None` without texture coordinates.
    pub fn new(answer: &Answer, matching: &Matching, original: &Original) -> Option<UvLayout> {
        let mesh = &answer.mesh;
        if mesh.tex_coords.len() != mesh.positions.len() {
            return None;
        }
        let materials = answer.material_of_triangles();
        let mut tex_coords = Vec::with_capacity(mesh.indices.len());
        let mut is_outside = Vec::with_capacity(mesh.triangle_count());
        for (t, &material) in materials.iter().enumerate() {
            let material = answer.materials.get(material);
            let at = |i: usize| material.map_or(mesh.tex_coords[i], |m| m.sampled_at(mesh.tex_coords[i]));
            let mut corners = mesh.triangle(t).map(at);
            let is_inside =
                |corners: &[[f32; 2]; 3]| corners.iter().flatten().all(|c| (-ROUNDING..=1.0 + ROUNDING).contains(c));
            is_outside.push(!is_inside(&corners));
            if !is_inside(&corners) && material.is_none_or(super::answer::AnswerMaterial::repeats) {
                let middle = [0, 1].map(|axis| corners.iter().map(|c| c[axis]).sum::<f32>() / 3.0);
                let moved = corners.map(|c| [c[0] - middle[0].floor(), c[1] - middle[1].floor()]);
                if is_inside(&moved) {
                    corners = moved;
                }
            }
            tex_coords.extend(corners);
        }
        let part = |counterpart: &Counterpart| {
            let triangle = match counterpart {
                Counterpart::Same(triangle, _) => *triangle,
                Counterpart::Among(near) => *near.first()?,
                Counterpart::Nothing => return None,
            };
            u16::try_from(original.surface.part(triangle as usize)).ok()
        };
        let part = matching.counterparts.iter().map(part).collect();
        let laid = mesh.with_corner_tex_coords(&tex_coords);
        let kept = UnwrapSettings { source: UvSource::Kept, ..UnwrapSettings::default() };
        let chart = unwrap(&laid, &kept, &|_| true).map(|atlas| atlas.chart_of_triangle);
        let chart = chart.unwrap_or_else(|_| vec![None; mesh.triangle_count()]);
        Some(UvLayout { tex_coords, is_outside, chart, part })
    }

    /// The area of all triangles in the texture, of which the unit square holds 1 without overlaps.
    pub fn area(&self) -> f64 {
        let area = |t: usize| {
            let [a, b, c] = self.corners(t).map(|uv| glam::DVec2::from(uv.map(f64::from)));
            0.5 * (b - a).perp_dot(c - a).abs()
        };
        (0..self.chart.len()).map(area).filter(|area| area.is_finite()).sum()
    }

    /// Three coordinates of a triangle.
    pub fn corners(&self, triangle: usize) -> [[f32; 2]; 3] {
        [0, 1, 2].map(|k| self.tex_coords[3 * triangle + k])
    }

    /// The parts of the original all of whose triangles have the original's own texture coordinates.
    pub fn kept_parts(&self, answer: &Answer, matching: &Matching, original: &Original) -> Vec<u16> {
        let parts = original.surface.mesh.parts.len();
        let mut counts = vec![[0_usize; 2]; parts];
        let own = &original.surface.mesh;
        for (t, counterpart) in matching.counterparts.iter().enumerate() {
            let (Counterpart::Same(triangle, corners), Some(part)) = (counterpart, self.part[t]) else { continue };
            let theirs = own.triangle(*triangle as usize);
            let is_same = answer.mesh.triangle(t).iter().zip(corners).all(|(&i, &corner)| {
                let (a, b) = (answer.mesh.tex_coords[i], own.tex_coords.get(theirs[usize::from(corner)]));
                b.is_some_and(|b| (0..2).all(|k| (a[k] - b[k]).abs() <= SAME))
            });
            counts[usize::from(part)][usize::from(is_same)] += 1;
        }
        let is_kept = |[other, same]: [usize; 2]| same > 0 && 50 * other < same;
        (0..parts).filter(|&part| is_kept(counts[part])).filter_map(|part| u16::try_from(part).ok()).collect()
    }

    /// The share of triangles without an area in the texture, by their area in space.
    pub fn collapsed_share(&self, answer: &Answer) -> f64 {
        let (mut collapsed, mut whole) = (0.0, 0.0);
        for t in 0..self.chart.len() {
            let [a, b, c] = answer.mesh.triangle_positions(t).map(|p| p.as_dvec3());
            let area = (b - a).cross(c - a).length();
            let [p, q, r] = self.corners(t).map(|uv| glam::DVec2::from(uv.map(f64::from)));
            let in_texture = (q - p).perp_dot(r - p).abs();
            whole += area;
            collapsed += if in_texture < 1e-12 { area } else { 0.0 };
        }
        if whole > 0.0 { collapsed / whole } else { 0.0 }
    }
}
