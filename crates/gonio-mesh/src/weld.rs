//! Vertices: finds those at the same place, merges equal corners, and splits vertices whose corners differ.

use crate::Mesh;
use std::collections::HashMap;

const EMPTY: u32 = u32::MAX;

/// Returns a place for each vertex, equal for equal positions (bit by bit, except that -0 is 0), numbered from 0 in the
/// order of their first vertices. Also returns their number.
pub(crate) fn places(positions: &[[f32; 3]]) -> (Vec<u32>, usize) {
    let mut table = Table::with_room_for(positions.len());
    let mut place_of_vertex = Vec::with_capacity(positions.len());
    let mut first_vertices: Vec<u32> = Vec::new();
    for (vertex, position) in positions.iter().enumerate() {
        let key = position.map(bits);
        let hash = u64::from(key[0]) | u64::from(key[1]) << 32;
        let hash = mix(mix(hash) ^ u64::from(key[2]));
        let found = table.find(hash, |place| positions[first_vertices[place as usize] as usize].map(bits) == key);
        place_of_vertex.push(found.unwrap_or_else(|slot| {
            let place = first_vertices.len() as u32;
            table.fill(slot, place);
            first_vertices.push(vertex as u32);
            place
        }));
    }
    (place_of_vertex, first_vertices.len())
}

/// Returns the bits of a coordinate, equal for 0 and -0.
fn bits(value: f32) -> u32 {
    (value + 0.0).to_bits()
}

/// A bijection of 64 bits in which each bit of the input affects half of the output (the finisher of SplitMix64: G.
/// Steele, D. Lea, C. Flood, 2014).
#[inline]
pub(crate) fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A hash table of numbers with open addressing, at most half full, with a fixed size.
pub(crate) struct Table {
    slots: Vec<u32>,
    mask: usize,
}

impl Table {
    /// Creates a table for at most `count` entries.
    pub(crate) fn with_room_for(count: usize) -> Self {
        let size = (2 * count).next_power_of_two().max(2);
        Table { slots: vec![EMPTY; size], mask: size - 1 }
    }

    /// Returns the entry with this hash for which `is_it` holds, or the slot where it belongs.
    #[inline]
    pub(crate) fn find(&self, hash: u64, is_it: impl Fn(u32) -> bool) -> Result<u32, usize> {
        let mut slot = hash as usize & self.mask;
        loop {
            let entry = self.slots[slot];
            if entry == EMPTY {
                return Err(slot);
            }
            if is_it(entry) {
                return Ok(entry);
            }
            slot = (slot + 1) & self.mask;
        }
    }

    /// Stores an entry in a slot returned by [`Self::find`].
    pub(crate) fn fill(&mut self, slot: usize, entry: u32) {
        self.slots[slot] = entry;
    }
}

const NONE: u32 = u32::MAX;

/// Most vertices at one position that are searched linearly.
const MOST_IN_A_CHAIN: usize = 16;

/// The vertices made so far, each from the index of a position and `N` other indices.
pub(crate) struct Joiner<const N: usize> {
    /// For each position its latest vertex.
    first: Vec<u32>,
    /// For each vertex the previous one at the same position.
    next: Vec<u32>,
    /// For each vertex the other indices.
    made_of: Vec<[u32; N]>,
    /// Vertices of positions with many of them.
    crowded: HashMap<(u32, [u32; N]), u32>,
}

impl<const N: usize> Joiner<N> {
    /// Creates a table for indices below `positions`.
    pub(crate) fn new(positions: usize) -> Self {
        Joiner { first: vec![NONE; positions], next: Vec::new(), made_of: Vec::new(), crowded: HashMap::new() }
    }

    /// Returns the vertex of a corner and whether it is new. Vertices are numbered from 0 in the order of first use.
    #[inline]
    pub(crate) fn vertex(&mut self, position: u32, rest: [u32; N]) -> (u32, bool) {
        let first = self.first[position as usize];
        let mut vertex = first;
        let mut steps = 0;
        while vertex != NONE && steps < MOST_IN_A_CHAIN {
            if self.made_of[vertex as usize] == rest {
                return (vertex, false);
            }
            vertex = self.next[vertex as usize];
            steps += 1;
        }
        let made = self.made_of.len() as u32;
        if steps == MOST_IN_A_CHAIN {
            if let Some(&vertex) = self.crowded.get(&(position, rest)) {
                return (vertex, false);
            }
            self.crowded.insert((position, rest), made);
            self.next.push(NONE);
        } else {
            self.first[position as usize] = made;
            self.next.push(first);
        }
        self.made_of.push(rest);
        (made, true)
    }
}

/// Most vertices made from one that are searched for an equal value.
const MOST_VALUES_IN_A_CHAIN: usize = 64;

/// Splits vertices so that each corner (index into `indices`) has its own value; returns the mesh and the value of each
/// vertex. Vertices without triangles are removed; the order is that of first use.
pub(crate) fn split_by_corner_values<T: Copy + PartialEq>(mesh: &Mesh, value_of_corner: &[T]) -> (Mesh, Vec<T>) {
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
            vertex = if steps < MOST_VALUES_IN_A_CHAIN { next[vertex as usize] } else { NONE };
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
        second_tex_coords: gather(&mesh.second_tex_coords, &made_of),
        tangents: gather(&mesh.tangents, &made_of),
        colors: gather(&mesh.colors, &made_of),
        indices,
        smoothing_groups: mesh.smoothing_groups.clone(),
        parts: mesh.parts.clone(),
        normal_source: mesh.normal_source,
    };
    (split, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_a_place() {
        let positions = [[0.0, 1.0, 2.0], [-0.0, 1.0, 2.0], [0.0, 1.0, 2.000_000_2], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
        assert_eq!(places(&positions), (vec![0, 0, 1, 2, 0], 3));
        assert_eq!(places(&[]), (vec![], 0));
    }

    #[test]
    fn equal_corners_are_one_vertex() {
        let mut joiner = Joiner::new(2);
        let corners = [(0, [5]), (1, [5]), (0, [6]), (0, [5]), (1, [5])];
        let vertices = corners.map(|(position, rest)| joiner.vertex(position, rest));
        assert_eq!(vertices, [(0, true), (1, true), (2, true), (0, false), (1, false)]);
    }

    /// Far more vertices at one position than are searched linearly.
    #[test]
    fn crowded_positions_are_looked_up() {
        let mut joiner = Joiner::new(1);
        for round in 0..2 {
            for rest in 0..1000 {
                assert_eq!(joiner.vertex(0, [rest, 7]), (rest, round == 0));
            }
        }
    }
}
