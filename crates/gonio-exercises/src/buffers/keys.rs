//! Keys of vertices and triangles, which are equal if the vertices are equal within the tolerance. Buffers can then be
//! compared as sets, in any order.

use super::buffer::{Attributes, Vertex, unit};
use super::obj_lines::ObjLines;
use super::reader::Corner;

/// Tolerance, relative to the model's largest coordinate (to 1 for texture coordinates and normals): ten times the rounding
/// of six printed digits. The exercise sets it.
pub(super) const TOLERANCE: f64 = 1e-5;

/// Keys of a corner's position, texture coordinate and normal; `None` if the value is unknown.
pub(super) type CornerKeys = [Option<u64>; 3];

/// Numbers that a reader may make of a file, each with a key; numbers within the tolerance share a key.
struct Values {
    /// Numbers in ascending order, with their keys.
    known: Vec<(f64, u64)>,
    tolerance: f64,
}

impl Values {
    fn new(values: impl Iterator<Item = f32>, scale: f64) -> Self {
        let tolerance = TOLERANCE * scale;
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).map(f64::from).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let (mut known, mut key, mut first) = (Vec::with_capacity(values.len()), 0, f64::NEG_INFINITY);
        for value in values {
            if value - first > tolerance {
                (first, key) = (value, key + 1);
            }
            known.push((value, key));
        }
        Values { known, tolerance }
    }

    fn nearest(&self, value: f64) -> Option<(f64, u64)> {
        let above = self.known.partition_point(|(known, _)| *known < value);
        let distance = |place: usize| self.known.get(place).map(|(known, _)| (known - value).abs());
        let place = match (above.checked_sub(1).and_then(distance), distance(above)) {
            (Some(below_by), Some(above_by)) if below_by < above_by => above - 1,
            (Some(_), None) => above - 1,
            _ => above,
        };
        self.known.get(place).copied().filter(|(known, _)| (known - value).abs() <= self.tolerance)
    }

    fn key(&self, value: f32) -> u64 {
        let value = f64::from(value);
        if !value.is_finite() {
            return u64::MAX;
        }
        match self.nearest(value) {
            Some((_, key)) => key,
            // Numbers that no reader makes get keys of their own, far from the others.
            None => (1 << 62) ^ ((value / self.tolerance).round() as i64 as u64),
        }
    }
}

/// The keys of a model's numbers.
pub(super) struct Keys {
    positions: Values,
    tex_coords: Values,
    normals: Values,
    /// The largest absolute coordinate; 1 if all are zero.
    pub(super) scale: f64,
}

impl Keys {
    pub(super) fn new(source: &ObjLines) -> Self {
        let largest = source.positions.iter().flatten().fold(0.0, |a: f32, b| a.max(b.abs()));
        let scale = if largest > 0.0 && largest.is_finite() { f64::from(largest) } else { 1.0 };
        let with_signs = |value: f32| [value, -value, value.trunc(), -value.trunc(), 0.0];
        let positions = source.positions.iter().flatten().flat_map(|value| with_signs(*value));
        let tex_coords =
            source.tex_coords.iter().flatten().flat_map(|x| [*x, 1.0 - x, x.trunc(), 1.0 - x.trunc(), 0.0, 1.0]);
        let of_faces = source.faces.iter().flat_map(|face| face.cut.iter().map(move |cut| (face, cut)));
        let flat = of_faces.filter_map(|(face, cut)| {
            let position = |corner: usize| {
                let index = face.corners.get(corner)?[0]?;
                let place = if index > 0 { index - 1 } else { (face.before[0] as i64).saturating_add(index) };
                source.positions.get(usize::try_from(place).ok()?).map(|p| glam::Vec3::from(*p))
            };
            let [a, b, c] = [position(cut[0])?, position(cut[1])?, position(cut[2])?];
            Some(unit((b - a).cross(c - a).into()))
        });
        let written = source.normals.iter().flat_map(|n| {
            let [x, y, z] = n.map(f32::trunc);
            [unit(*n), unit([x, y, z]), unit([x, 0.0, 0.0])]
        });
        let normals = written.chain(flat).flatten().flat_map(|value| [value, -value, 0.0, 1.0]);
        Keys {
            positions: Values::new(positions, scale),
            tex_coords: Values::new(tex_coords, 1.0),
            normals: Values::new(normals, 1.0),
            scale,
        }
    }

    pub(super) fn vertex(&self, vertex: &Vertex, compared: Attributes) -> [u64; 3] {
        [
            join(vertex.position.map(|value| self.positions.key(value))),
            if compared.tex_coords { join(vertex.tex_coord.map(|value| self.tex_coords.key(value))) } else { 0 },
            if compared.normals { join(vertex.normal.map(|value| self.normals.key(value))) } else { 0 },
        ]
    }

    pub(super) fn corner(&self, corner: &Corner, compared: Attributes) -> CornerKeys {
        let vertex = Vertex {
            position: corner.position.unwrap_or_default(),
            tex_coord: corner.tex_coord.unwrap_or_default(),
            normal: corner.normal.unwrap_or_default(),
        };
        let [position, tex_coord, normal] = self.vertex(&vertex, compared);
        [
            corner.position.map(|_| position),
            if compared.tex_coords { corner.tex_coord.map(|_| tex_coord) } else { Some(0) },
            if compared.normals { corner.normal.map(|_| normal) } else { Some(0) },
        ]
    }

    /// The share of numbers that some reader may have made of the file.
    pub(super) fn share_known(&self, vertices: &[Vertex], compared: Attributes) -> f64 {
        // Enough to distinguish the interpretations of the columns.
        const MOST: usize = 20_000;
        let (mut known, mut all) = (0u64, 0u64);
        let mut count = |values: &Values, numbers: &[f32]| {
            all += numbers.len() as u64;
            known += numbers.iter().filter(|value| values.nearest(f64::from(**value)).is_some()).count() as u64;
        };
        for vertex in vertices.iter().take(MOST) {
            count(&self.positions, &vertex.position);
            if compared.tex_coords {
                count(&self.tex_coords, &vertex.tex_coord);
            }
            if compared.normals {
                count(&self.normals, &vertex.normal);
            }
        }
        if all == 0 { 0.0 } else { known as f64 / all as f64 }
    }
}

/// Mixes a number's bits (the finaliser of SplitMix64: Steele, Lea, Flood 2014).
pub(super) fn mix(mut bits: u64) -> u64 {
    bits = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^ (bits >> 31)
}

/// Combines several keys into one, which depends on their order.
pub(super) fn join<const N: usize>(keys: [u64; N]) -> u64 {
    keys.iter().fold(N as u64, |all, key| mix(all ^ mix(*key)))
}

/// The key of a triangle, independent of the corner it starts with; the triangle turned over has a different key.
pub(super) fn triangle(corners: [u64; 3]) -> u64 {
    let [a, b, c] = corners;
    join([[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or(corners))
}
