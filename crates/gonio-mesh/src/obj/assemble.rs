//! Assembles the mesh from attributes, vertices and triangles.

use super::attributes::Attributes;
use super::vertices::{Corner, CornerAttributes, Vertices};
use crate::input::{too_many_triangles, too_many_vertices};
use crate::{Limits, Mesh, NormalSource, ReadError};
use gonio_threads::prelude::*;
use std::mem;

/// Fewer indices than this are not worth several threads.
const MANY_INDICES: usize = 1 << 17;

/// Assembles the mesh, without parts. `indices` refer to `vertices`, three for each triangle.
///
/// Most of this is about memory: arrays are freed as soon as possible, and reused in place where possible.
#[inline(never)]
pub(super) fn mesh(
    attributes: Attributes,
    vertices: Vertices,
    mut indices: Vec<u32>,
    limits: &Limits,
) -> Result<Mesh, ReadError> {
    let position_count = vertices.position_count();
    let first_attributes = Used::new(vertices);
    let vertex_count = (first_attributes.count + first_attributes.extras.len()) as u64;
    let most = limits.max_vertices.min(u64::from(u32::MAX));
    if vertex_count > most {
        return Err(too_many_vertices(most));
    }
    if indices.len() as u64 / 3 > limits.max_triangles {
        return Err(too_many_triangles(limits.max_triangles));
    }
    let normals = gather(attributes.normals, &first_attributes, CornerAttributes::normal);
    let tex_coords = gather(attributes.tex_coords, &first_attributes, CornerAttributes::tex_coord);
    let colors = gather_colors(attributes.colors, &first_attributes);
    let positions = gather_positions(attributes.positions, &first_attributes);
    first_attributes.renumber(position_count, &mut indices);
    Ok(Mesh {
        normal_source: if normals.is_empty() { NormalSource::None } else { NormalSource::File },
        positions,
        normals,
        tex_coords,
        colors,
        indices,
        ..Mesh::default()
    })
}

/// The vertices: the used positions with their first attributes, then the extra vertices.
struct Used {
    vertices: Vertices,
    extras: Vec<Corner>,
    /// Number of used positions.
    count: usize,
}

impl Used {
    fn new(mut vertices: Vertices) -> Self {
        let count = vertices.used_count();
        let extras = mem::take(&mut vertices.extras).into_corners();
        Used { vertices, extras, count }
    }

    /// Removes the numbers of unused positions.
    fn renumber(mut self, position_count: usize, indices: &mut [u32]) {
        let unused = (position_count - self.count) as u32;
        if unused == 0 {
            return;
        }
        self.vertices.number_used();
        let vertices = &self.vertices;
        let renumber = |index: &mut u32| {
            *index = match vertices.number(*index as usize) {
                Some(number) => number,
                None => *index - unused,
            };
        };
        if indices.len() < MANY_INDICES {
            indices.iter_mut().for_each(renumber);
        } else {
            indices.par_chunks_mut(MANY_INDICES).for_each(|chunk| chunk.iter_mut().for_each(renumber));
        }
    }
}

/// Gathers one attribute of all vertices; empty if no vertex has it. `index` returns its index from 1, or 0.
fn gather<const N: usize>(
    mut values: Vec<[f32; N]>,
    used: &Used,
    index: impl Fn(CornerAttributes) -> usize,
) -> Vec<[f32; N]> {
    let value = |values: &[[f32; N]], kind: CornerAttributes| match index(kind).checked_sub(1) {
        Some(place) => values[place],
        None => [0.0; N],
    };
    // Each vertex's value is at its own index or later, so they can move forward one by one.
    let (mut has_any, mut is_in_order) = (false, true);
    for (vertex, (_, kind)) in used.vertices.firsts().enumerate() {
        let place = index(kind);
        has_any |= place > 0;
        is_in_order &= place == 0 || place > vertex;
    }
    has_any |= used.extras.iter().any(|(_, kind)| index(*kind) > 0);
    if !has_any {
        return Vec::new();
    }
    if is_in_order && used.count <= values.len() {
        let extras: Vec<[f32; N]> = used.extras.iter().map(|(_, kind)| value(&values, *kind)).collect();
        for (vertex, (_, kind)) in used.vertices.firsts().enumerate() {
            values[vertex] = value(&values, kind);
        }
        return end(values, used.count, extras);
    }
    let mut gathered = Vec::with_capacity(used.count + used.extras.len());
    gathered.extend(used.vertices.firsts().map(|(_, kind)| value(&values, kind)));
    gathered.extend(used.extras.iter().map(|(_, kind)| value(&values, *kind)));
    gathered
}

fn gather_positions(mut values: Vec<[f32; 3]>, used: &Used) -> Vec<[f32; 3]> {
    let extras = used.extras.iter().map(|(position, _)| values[*position as usize]).collect();
    if used.count < values.len() {
        for (vertex, (position, _)) in used.vertices.firsts().enumerate() {
            values[vertex] = values[position];
        }
    }
    end(values, used.count, extras)
}

/// White where there is no colour.
fn gather_colors(values: Vec<[f32; 3]>, used: &Used) -> Vec<[f32; 4]> {
    if values.is_empty() {
        return Vec::new();
    }
    let color = |position: usize| {
        let [r, g, b] = values.get(position).copied().unwrap_or([1.0; 3]);
        [r, g, b, 1.0]
    };
    let firsts = used.vertices.firsts().map(|(position, _)| color(position));
    firsts.chain(used.extras.iter().map(|(position, _)| color(*position as usize))).collect()
}

fn end<const N: usize>(mut values: Vec<[f32; N]>, count: usize, extras: Vec<[f32; N]>) -> Vec<[f32; N]> {
    values.truncate(count);
    values.reserve_exact(extras.len());
    values.extend_from_slice(&extras);
    values.shrink_to_fit();
    values
}
