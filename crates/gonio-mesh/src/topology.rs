//! The connectivity of triangles.

mod report;

pub use report::{Findings, TopologyFinding, TopologyReport, report};

use crate::Mesh;
use crate::weld::{self, mix};
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Whether the surface is closed (every edge, by position, is used equally often in both directions) and its outside is
/// the front (the enclosed volume is positive): then back faces are never seen from outside.
///
/// Both must hold for each connected component: one sphere turned inside out makes the answer no.
///
/// Edges are not sorted but summed: each directed edge adds a hash to its start and subtracts it from its end, so that
/// the sum of a vertex is 0 if all its edges are balanced, and otherwise is 0 with a probability of about 2^-64. Only
/// the remaining vertices, those of seams, are looked up by position, and their edges summed again. This takes linear
/// time with a small factor. The steps are not inlined: browsers optimise whole functions, and small ones sooner.
pub fn is_closed_outward(mesh: &Mesh) -> bool {
    if mesh.indices.is_empty() {
        return false;
    }
    let sums = edge_sums(mesh);
    let place_of_vertex = places_of_seams(mesh, &sums);
    is_closed(mesh, &sums, &place_of_vertex) && all_volumes_positive(mesh, &place_of_vertex)
}

/// Returns for each vertex the sum over its edges: 0 if, by index, all are balanced.
#[inline(never)]
fn edge_sums(mesh: &Mesh) -> Vec<u64> {
    let mut sums = vec![0_u64; mesh.positions.len()];
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|vertex| mix(u64::from(vertex) + 1));
        for (vertex, next, previous) in [(triangle[0], b, c), (triangle[1], c, a), (triangle[2], a, b)] {
            let sum = &mut sums[vertex as usize];
            *sum = sum.wrapping_add(next).wrapping_sub(previous);
        }
    }
    sums
}

/// Returns for each vertex itself; for those with unbalanced edges the first of them at its position.
#[inline(never)]
fn places_of_seams(mesh: &Mesh, sums: &[u64]) -> Vec<u32> {
    let mut places: Vec<u32> = (0..sums.len() as u32).collect();
    let seam: Vec<u32> = (0..sums.len() as u32).filter(|&vertex| sums[vertex as usize] != 0).collect();
    let positions: Vec<[f32; 3]> = seam.iter().map(|&vertex| mesh.positions[vertex as usize]).collect();
    let (place_of_seam, count) = weld::places(&positions);
    let mut first = vec![u32::MAX; count];
    for (&vertex, &place) in seam.iter().zip(&place_of_seam) {
        let first = &mut first[place as usize];
        *first = (*first).min(vertex);
        places[vertex as usize] = *first;
    }
    places
}

/// Whether the edges along seams are balanced by place; all others are balanced by index.
#[inline(never)]
fn is_closed(mesh: &Mesh, sums: &[u64], place_of_vertex: &[u32]) -> bool {
    let mut whole = [0_u64; 2];
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let is_seam = triangle.map(|vertex| sums[vertex as usize] != 0);
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            if !is_seam[i] || !is_seam[j] {
                continue;
            }
            let (from, to) = (place_of_vertex[triangle[i] as usize], place_of_vertex[triangle[j] as usize]);
            if from == to {
                continue;
            }
            let edge = u64::from(from.min(to)) << 32 | u64::from(from.max(to));
            let hashes = [mix(edge.wrapping_add(0x9E37_79B9_7F4A_7C15)), mix(edge ^ 0x6A09_E667_F3BC_C908)];
            for (sum, hash) in whole.iter_mut().zip(hashes) {
                *sum = if from < to { sum.wrapping_add(hash) } else { sum.wrapping_sub(hash) };
            }
        }
    }
    whole == [0; 2]
}

/// Whether each connected component of a closed surface encloses a positive volume.
#[inline(never)]
fn all_volumes_positive(mesh: &Mesh, place_of_vertex: &[u32]) -> bool {
    let mut pieces = DisjointSets::new(place_of_vertex.len());
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|vertex| place_of_vertex[vertex as usize]);
        pieces.join(a, b);
        pieces.join(b, c);
    }
    let roots = pieces.into_roots();
    // Six times the volume of the tetrahedra from one point to each triangle; a nearby point improves precision.
    let origin = mesh.bounds().map_or(DVec3::ZERO, |bounds| bounds.center().as_dvec3());
    let root_of = |triangle: &[u32; 3]| roots[place_of_vertex[triangle[0] as usize] as usize];
    let volume_of = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| Vec3::from(mesh.positions[vertex as usize]).as_dvec3() - origin);
        a.dot(b.cross(c))
    };
    // Triangles of one component are mostly consecutive: look them up once.
    let mut volumes: HashMap<u32, f64> = HashMap::new();
    for run in mesh.indices.as_chunks::<3>().0.chunk_by(|a, b| root_of(a) == root_of(b)) {
        *volumes.entry(root_of(&run[0])).or_default() += run.iter().map(volume_of).sum::<f64>();
    }
    volumes.values().all(|volume| *volume > 0.0)
}

/// Sets that can be joined (union-find, with path halving: R. E. Tarjan and J. van Leeuwen, 1984).
struct DisjointSets {
    parents: Vec<u32>,
}

impl DisjointSets {
    fn new(count: usize) -> Self {
        DisjointSets { parents: (0..count as u32).collect() }
    }

    fn root(&mut self, mut place: u32) -> u32 {
        loop {
            let parent = self.parents[place as usize];
            if parent == place {
                return place;
            }
            let grandparent = self.parents[parent as usize];
            self.parents[place as usize] = grandparent;
            place = grandparent;
        }
    }

    /// The smaller root stays: meshes need no ranks, because their places are numbered along the surface.
    fn join(&mut self, a: u32, b: u32) {
        if self.parents[a as usize] == self.parents[b as usize] {
            return;
        }
        let (a, b) = (self.root(a), self.root(b));
        let (low, high) = (a.min(b), a.max(b));
        self.parents[high as usize] = low;
    }

    /// Returns the root of each element.
    fn into_roots(mut self) -> Vec<u32> {
        for place in 0..self.parents.len() {
            // Parents come before their children, so the parent's entry is already a root.
            self.parents[place] = self.parents[self.parents[place] as usize];
        }
        self.parents
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: Vec<[f32; 3]>, indices: &[u32]) -> Mesh {
        Mesh { positions, indices: indices.to_vec(), ..Mesh::default() }
    }

    /// A tetrahedron of edge length about 1 somewhere, front faces outside.
    fn tetrahedron(at: [f32; 3]) -> Mesh {
        let [x, y, z] = at;
        let positions = vec![[x, y, z], [x + 1.0, y, z], [x, y + 1.0, z], [x, y, z + 1.0]];
        mesh(positions, &[0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
    }

    fn inside_out(mut mesh: Mesh) -> Mesh {
        mesh.indices.chunks_exact_mut(3).for_each(|t| t.swap(0, 1));
        mesh
    }

    fn both(mut a: Mesh, b: Mesh) -> Mesh {
        let offset = a.positions.len() as u32;
        a.positions.extend(b.positions);
        a.indices.extend(b.indices.iter().map(|i| i + offset));
        a
    }

    #[test]
    fn closed_and_outward() {
        assert!(is_closed_outward(&tetrahedron([0.0; 3])));
        assert!(is_closed_outward(&tetrahedron([1000.0, -1000.0, 500.0])));
        // Seams do not matter, nor does the sign of a zero.
        let mut unshared = tetrahedron([0.0; 3]).unshared();
        assert!(is_closed_outward(&unshared));
        unshared.positions[0] = [-0.0, 0.0, -0.0];
        assert!(is_closed_outward(&unshared));
        assert!(is_closed_outward(&both(tetrahedron([0.0; 3]), tetrahedron([5.0, 0.0, 0.0]))));
    }

    #[test]
    fn open_or_inward() {
        assert!(!is_closed_outward(&Mesh::default()));
        assert!(!is_closed_outward(&inside_out(tetrahedron([0.0; 3]))));
        for missing in 0..4 {
            let mut open = tetrahedron([0.0; 3]);
            open.indices.drain(3 * missing..3 * missing + 3);
            assert!(!is_closed_outward(&open), "without triangle {missing}");
            let mut flipped = tetrahedron([0.0; 3]);
            flipped.indices.swap(3 * missing, 3 * missing + 1);
            assert!(!is_closed_outward(&flipped), "with triangle {missing} turned");
        }
        // A corner moved by one bit opens it.
        let mut torn = tetrahedron([1.0; 3]).unshared();
        torn.positions[0][0] = torn.positions[0][0].next_up();
        assert!(!is_closed_outward(&torn));
        // Triangles of two pieces in turn: each volume is summed, though others come in between.
        let mixed = |a: Mesh, b: Mesh| {
            let mut both = both(a, b);
            let (first, second) = both.indices.split_at(12);
            let in_turn = first.as_chunks::<3>().0.iter().zip(second.as_chunks::<3>().0);
            both.indices = in_turn.flat_map(|(a, b)| [*a, *b]).flatten().collect();
            both
        };
        let (here, there) = (|| tetrahedron([0.0; 3]), || tetrahedron([-3.0, 2.0, 5.0]));
        assert!(is_closed_outward(&mixed(here(), there())) && is_closed_outward(&mixed(there(), here())));
        assert!(!is_closed_outward(&mixed(inside_out(here()), there())));
        assert!(!is_closed_outward(&mixed(here(), inside_out(there()))));
        // One piece inside out, though the other is larger.
        let mut large = tetrahedron([10.0, 0.0, 0.0]);
        large.positions.iter_mut().flatten().for_each(|x| *x *= 3.0);
        assert!(!is_closed_outward(&both(large, inside_out(tetrahedron([0.0; 3])))));
    }
}
