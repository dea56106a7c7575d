//! Splits vertices where their corners have different values.

use crate::Mesh;

const NONE: u32 = u32::MAX;

/// Most vertices made from one that are searched for an equal value.
const MOST_IN_A_CHAIN: usize = 64;

/// Splits vertices so that each corner (index into `indices`) has its own value; returns the mesh and the value of each
/// vertex. Vertices without triangles are removed; the order is that of first use.
pub(crate) fn by_corner_values<T: Copy + PartialEq>(mesh: &Mesh, value_of_corner: &[T]) -> (Mesh, Vec<T>) {
    let vertex_count = mesh.positions.len();
    let mut first = vec![NONE; vertex_count];
    let mut next: Vec<u32> = Vec::with_capacity(vertex_count);
    let mut made_of: Vec<u32> = Vec::with_capacity(vertex_count);
    let mut values: Vec<T> = Vec::with_capacity(vertex_count);
    let mut indices = Vec::with_capacity(mesh.indices.len());
    for (&old, &value) in mesh.indices.iter().zip(value_of_corner) {
        let mut vertex = first[old as usize];
        let mut steps = 0;
        while vertex != NONE && values[vertex as usize] != value {
            vertex = if steps < MOST_IN_A_CHAIN { next[vertex as usize] } else { NONE };
            steps += 1;
        }
        if vertex == NONE {
            vertex = values.len() as u32;
            values.push(value);
            made_of.push(old);
            next.push(first[old as usize]);
            first[old as usize] = vertex;
        }
        indices.push(vertex);
    }
    fn gather<T: Copy>(values: &[T], made_of: &[u32]) -> Vec<T> {
        if values.is_empty() { Vec::new() } else { made_of.iter().map(|&old| values[old as usize]).collect() }
    }
    let split = Mesh {
        positions: gather(&mesh.positions, &made_of),
        normals: gather(&mesh.normals, &made_of),
        tex_coords: gather(&mesh.tex_coords, &made_of),
        tangents: gather(&mesh.tangents, &made_of),
        colors: gather(&mesh.colors, &made_of),
        indices,
        smoothing_groups: mesh.smoothing_groups.clone(),
        parts: mesh.parts.clone(),
        normal_source: mesh.normal_source,
    };
    (split, values)
}
