//! Counts oddities in the connectivity of a mesh's triangles, with the first places.

use super::DisjointSets;
use crate::Mesh;
use crate::weld::{self, Table, mix};
use glam::{DVec3, Vec3};
use serde::Serialize;

/// Most places of a kind that are listed.
const MOST_PLACES: usize = 5;

/// The connectivity of a mesh's triangles. Vertices at the same position (bit by bit) count as one, so that seams of
/// texture coordinates or normals do not matter.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TopologyReport {
    /// All triangles of the mesh.
    pub triangles: u64,
    /// Distinct positions used by triangles.
    pub positions: u64,
    /// Distinct edges of triangles with three distinct positions.
    pub edges: u64,
    /// Triangles without area: two corners at one position, or all collinear. The former are excluded from everything
    /// below.
    pub degenerate_triangles: Findings,
    /// Triangles with the same three corners and the same winding as an earlier one.
    pub duplicate_triangles: Findings,
    /// Triangles with the same three corners as an earlier one but the opposite winding: the back of a leaf.
    pub back_to_back_triangles: Findings,
    /// Edges of one triangle.
    pub boundary_edges: Findings,
    /// Edges of more than two triangles.
    pub non_manifold_edges: Findings,
    /// Edges that two triangles use in the same direction: one shows its front where the other shows its back.
    pub inconsistent_edges: Findings,
    /// Positions around which the triangles form more than one fan: cones tip to tip, or boundaries that touch.
    pub non_manifold_positions: Findings,
    /// The smallest number of triangles to reverse so that the windings agree across every edge of two triangles; if
    /// the surface is not orientable, the number that a traversal finds.
    pub triangles_to_turn: u64,
    /// Whether all windings can be made to agree, which is impossible for a Moebius strip.
    pub orientable: bool,
    /// Components connected by at least a position.
    pub pieces: u64,
    /// Whether every edge is used equally often in both directions: there are no holes, and the windings agree.
    pub closed: bool,
    /// Whether it is closed and every component encloses a positive volume, so that fronts are outside.
    pub outward: bool,
    /// Positions - edges + triangles, over all components: 2 for a ball, 0 for a ring.
    pub euler_characteristic: i64,
    /// The number of handles of all components if the surface is closed, orientable and manifold.
    pub genus: Option<u64>,
    /// The total area of all triangles, in squared units of the model.
    pub area: f64,
    /// The enclosed volume, in cubed units, if the surface is closed: negative inside out.
    pub volume: Option<f64>,
}

/// The number of occurrences of an oddity, and the first ones.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Findings {
    /// The number of occurrences.
    pub count: u64,
    /// At most five, in the order of their triangles or, for edges and positions, of the mesh's positions.
    pub first: Vec<TopologyFinding>,
}

/// The place of an oddity.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TopologyFinding {
    /// Triangles that meet there (from 0, in the order of the mesh's indices), at most five.
    pub triangles: Vec<usize>,
    /// One position, the two ends of an edge, or the three corners of a triangle.
    pub positions: Vec<[f32; 3]>,
}

impl Findings {
    fn add(&mut self, finding: impl FnOnce() -> TopologyFinding) {
        self.count += 1;
        if self.first.len() < MOST_PLACES {
            self.first.push(finding());
        }
    }
}

/// Examines all triangles, edges and positions in linear time, except for sorting around each position.
pub fn report(mesh: &Mesh) -> TopologyReport {
    let (place_of_vertex, place_count) = weld::places(&mesh.positions);
    let surface = Surface { mesh, place_of_vertex, place_count };
    let mut report = TopologyReport { triangles: mesh.triangle_count() as u64, ..TopologyReport::default() };
    let is_point_or_edge = surface.degenerate(&mut report);
    surface.duplicates(&is_point_or_edge, &mut report);
    let edges = HalfEdges::of_surface(&surface, &is_point_or_edge);
    let mut fans = DisjointSets::new(mesh.indices.len());
    let mut sides = OrientationSets::new(mesh.triangle_count());
    let mut pieces = DisjointSets::new(place_count);
    let mut is_balanced = true;
    edges.visit(|low, high, uses| {
        report.edges += 1;
        pieces.join(low, high);
        is_balanced &= uses.iter().map(|edge| if edge.is_upward() { 1 } else { -1 }).sum::<i64>() == 0;
        for edge in &uses[1..] {
            surface.join_fans(&mut fans, [low, high], uses[0].triangle(), edge.triangle());
        }
        let finding = || surface.edge_finding(low, high, uses);
        match uses {
            [_] => report.boundary_edges.add(finding),
            [a, b] => {
                let agree = a.is_upward() != b.is_upward();
                if !agree {
                    report.inconsistent_edges.add(finding);
                }
                sides.join(a.triangle(), b.triangle(), agree);
            }
            _ => report.non_manifold_edges.add(finding),
        }
    });
    surface.positions(&is_point_or_edge, &mut fans, &mut pieces, &mut report);
    let solid = is_point_or_edge.iter().filter(|is| !**is).count();
    (report.triangles_to_turn, report.orientable) = sides.finish(&is_point_or_edge);
    report.closed = is_balanced && solid > 0;
    report.euler_characteristic = report.positions as i64 - report.edges as i64 + solid as i64;
    surface.measure(&mut pieces, &mut report);
    let is_manifold = report.non_manifold_edges.count == 0 && report.non_manifold_positions.count == 0;
    let has_boundary = report.boundary_edges.count > 0;
    if solid > 0 && is_manifold && !has_boundary && report.orientable {
        // Each closed component contributes 2 - 2 g.
        report.genus = u64::try_from((2 * report.pieces as i64 - report.euler_characteristic) / 2).ok();
    }
    report
}

/// A mesh with the place of each vertex.
struct Surface<'a> {
    mesh: &'a Mesh,
    place_of_vertex: Vec<u32>,
    place_count: usize,
}

impl Surface<'_> {
    fn places(&self, t: usize) -> [u32; 3] {
        self.mesh.triangle(t).map(|vertex| self.place_of_vertex[vertex])
    }

    fn triangle_finding(&self, t: usize, with: &[usize]) -> TopologyFinding {
        let positions = self.mesh.triangle(t).map(|vertex| self.mesh.positions[vertex]).to_vec();
        TopologyFinding { triangles: with.iter().copied().chain([t]).collect(), positions }
    }

    fn edge_finding(&self, low: u32, high: u32, uses: &[HalfEdge]) -> TopologyFinding {
        let triangles: Vec<usize> = uses.iter().take(MOST_PLACES).map(|edge| edge.triangle()).collect();
        let position = |place: u32| {
            let corner = triangles.first().map(|&t| self.mesh.triangle(t)).unwrap_or_default();
            let vertex = corner.into_iter().find(|&vertex| self.place_of_vertex[vertex] == place);
            vertex.map(|vertex| self.mesh.positions[vertex]).unwrap_or_default()
        };
        let positions = vec![position(low), position(high)];
        TopologyFinding { triangles, positions }
    }

    /// Counts triangles without area; returns which of them use a position twice.
    fn degenerate(&self, report: &mut TopologyReport) -> Vec<bool> {
        (0..self.mesh.triangle_count())
            .map(|t| {
                let [a, b, c] = self.places(t);
                let is_point_or_edge = a == b || b == c || c == a;
                if is_point_or_edge || has_no_area(self.mesh, t) {
                    report.degenerate_triangles.add(|| self.triangle_finding(t, &[]));
                }
                is_point_or_edge
            })
            .collect()
    }

    /// Counts triangles with the corners of an earlier one.
    fn duplicates(&self, left_out: &[bool], report: &mut TopologyReport) {
        let count = self.mesh.triangle_count();
        let mut table = Table::with_room_for(count);
        let key = |t: usize| {
            let mut places = self.places(t);
            places.sort_unstable();
            places
        };
        for t in (0..count).filter(|&t| !left_out[t]) {
            let sorted = key(t);
            let hash = mix(mix(u64::from(sorted[0]) | u64::from(sorted[1]) << 32) ^ u64::from(sorted[2]));
            match table.find(hash, |earlier| key(earlier as usize) == sorted) {
                Err(slot) => table.fill(slot, t as u32),
                Ok(earlier) => {
                    let earlier = earlier as usize;
                    let is_same_way = is_rotation(self.places(earlier), self.places(t));
                    let kind =
                        if is_same_way { &mut report.duplicate_triangles } else { &mut report.back_to_back_triangles };
                    kind.add(|| self.triangle_finding(t, &[earlier]));
                }
            }
        }
    }

    /// Joins the corners of two triangles at both ends of a shared edge.
    fn join_fans(&self, fans: &mut DisjointSets, ends: [u32; 2], a: usize, b: usize) {
        for end in ends {
            let corner = |t: usize| self.places(t).iter().position(|&place| place == end).map(|k| (3 * t + k) as u32);
            if let (Some(a), Some(b)) = (corner(a), corner(b)) {
                fans.join(a, b);
            }
        }
    }

    /// Counts positions, those with more than one fan, and components.
    fn positions(
        &self,
        left_out: &[bool],
        fans: &mut DisjointSets,
        pieces: &mut DisjointSets,
        report: &mut TopologyReport,
    ) {
        const NONE: u32 = u32::MAX;
        let mut fan_of_place = vec![NONE; self.place_count];
        let mut is_odd = vec![false; self.place_count];
        let mut has_piece = vec![false; self.place_count];
        for t in (0..self.mesh.triangle_count()).filter(|&t| !left_out[t]) {
            for (k, place) in self.places(t).into_iter().enumerate() {
                let fan = fans.root((3 * t + k) as u32);
                let known = &mut fan_of_place[place as usize];
                if *known == NONE {
                    *known = fan;
                    report.positions += 1;
                    let root = pieces.root(place) as usize;
                    report.pieces += u64::from(!std::mem::replace(&mut has_piece[root], true));
                } else if *known != fan && !std::mem::replace(&mut is_odd[place as usize], true) {
                    let positions = vec![self.mesh.positions[self.mesh.triangle(t)[k]]];
                    let triangles = vec![*known as usize / 3, t];
                    report.non_manifold_positions.add(|| TopologyFinding { triangles, positions });
                }
            }
        }
    }

    /// Computes area and volume, and whether every component has its front outside.
    fn measure(&self, pieces: &mut DisjointSets, report: &mut TopologyReport) {
        let origin = self.mesh.bounds().map_or(DVec3::ZERO, |bounds| bounds.center().as_dvec3());
        let mut volumes = vec![0.0_f64; if report.closed { self.place_count } else { 0 }];
        let mut volume = 0.0;
        for t in 0..self.mesh.triangle_count() {
            let [a, b, c] = self.mesh.triangle_positions(t).map(|p: Vec3| p.as_dvec3() - origin);
            report.area += 0.5 * (b - a).cross(c - a).length();
            if report.closed {
                let part = a.dot(b.cross(c)) / 6.0;
                volume += part;
                volumes[pieces.root(self.places(t)[0]) as usize] += part;
            }
        }
        if report.closed {
            report.volume = Some(volume);
            let mut used = self.mesh.indices.iter().map(|&vertex| self.place_of_vertex[vertex as usize]);
            report.outward = used.all(|place| volumes[pieces.root(place) as usize] > 0.0);
        }
    }
}

/// The product of `f32` differences neither overflows nor vanishes in `f64`.
fn has_no_area(mesh: &Mesh, t: usize) -> bool {
    let [a, b, c] = mesh.triangle_positions(t).map(|p: Vec3| p.as_dvec3());
    let (ab, ac) = (b - a, c - a);
    // A smaller product is only the rounding error of parallel vectors.
    ab.cross(ac).length_squared() <= 1e-28 * ab.length_squared() * ac.length_squared()
}

/// Whether the second triangle is a rotation of the first.
fn is_rotation([a, b, c]: [u32; 3], other: [u32; 3]) -> bool {
    other == [a, b, c] || other == [b, c, a] || other == [c, a, b]
}

/// A triangle's side along an edge: the triangle and the direction.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct HalfEdge {
    /// The place at the other end.
    high: u32,
    /// The corner where it begins and, in the lowest bit, whether it goes from the lower place to the higher.
    corner: u64,
}

impl HalfEdge {
    fn triangle(self) -> usize {
        (self.corner >> 1) as usize / 3
    }

    fn is_upward(self) -> bool {
        self.corner & 1 == 1
    }
}

/// All sides of all triangles, by the lower of their places.
struct HalfEdges {
    uses: Vec<HalfEdge>,
    /// The end of each place's entries.
    ends: Vec<usize>,
}

impl HalfEdges {
    fn of_surface(surface: &Surface<'_>, left_out: &[bool]) -> Self {
        let triangles = || (0..surface.mesh.triangle_count()).filter(|&t| !left_out[t]);
        let sides = |t: usize| {
            let [a, b, c] = surface.places(t);
            [(a, b), (b, c), (c, a)]
        };
        let mut ends = vec![0_usize; surface.place_count];
        for (from, to) in triangles().flat_map(sides) {
            ends[from.min(to) as usize] += 1;
        }
        let mut total = 0;
        for end in &mut ends {
            // At first, the start of the place's entries.
            total += std::mem::replace(end, total);
        }
        let mut uses = vec![HalfEdge { high: 0, corner: 0 }; total];
        for t in triangles() {
            for (k, (from, to)) in sides(t).into_iter().enumerate() {
                let at = &mut ends[from.min(to) as usize];
                let corner = ((3 * t + k) as u64) << 1 | u64::from(from < to);
                uses[*at] = HalfEdge { high: from.max(to), corner };
                *at += 1;
            }
        }
        HalfEdges { uses, ends }
    }

    /// Calls `visit` with the two places of each edge and its half-edges, in the order of the places.
    fn visit(mut self, mut visit: impl FnMut(u32, u32, &[HalfEdge])) {
        let mut first = 0;
        for (low, end) in self.ends.into_iter().enumerate() {
            let uses = &mut self.uses[first..end];
            first = end;
            uses.sort_unstable();
            for same in uses.chunk_by(|a, b| a.high == b.high) {
                visit(low as u32, same[0].high, same);
            }
        }
    }
}

/// Sets of triangles joined with or without reversing one of them: each triangle records whether it is reversed
/// relative to the set's root (union-find with parity).
struct OrientationSets {
    parents: Vec<u32>,
    is_turned: Vec<bool>,
    is_orientable: bool,
}

impl OrientationSets {
    fn new(count: usize) -> Self {
        OrientationSets { parents: (0..count as u32).collect(), is_turned: vec![false; count], is_orientable: true }
    }

    /// Returns the root, and whether the triangle is reversed relative to it.
    fn root(&mut self, triangle: usize) -> (usize, bool) {
        let (mut at, mut is_turned) = (triangle, false);
        loop {
            let parent = self.parents[at] as usize;
            if parent == at {
                return (at, is_turned);
            }
            let grandparent = self.parents[parent];
            // Path halving: the entry skips its parent.
            let skipped = self.is_turned[at] ^ self.is_turned[parent];
            if grandparent as usize != parent {
                self.parents[at] = grandparent;
                self.is_turned[at] = skipped;
            }
            is_turned ^= self.is_turned[at];
            at = self.parents[at] as usize;
        }
    }

    fn join(&mut self, a: usize, b: usize, agree: bool) {
        let ((a, a_turned), (b, b_turned)) = (self.root(a), self.root(b));
        let is_turned = a_turned ^ b_turned ^ !agree;
        if a == b {
            self.is_orientable &= !is_turned;
        } else {
            let (low, high) = (a.min(b), a.max(b));
            self.parents[high] = low as u32;
            self.is_turned[high] = is_turned;
        }
    }

    /// Returns the number of triangles to reverse, the smaller part of each set; and whether that suffices.
    fn finish(mut self, left_out: &[bool]) -> (u64, bool) {
        let mut parts = vec![[0_u64; 2]; self.parents.len()];
        for triangle in (0..self.parents.len()).filter(|&t| !left_out[t]) {
            let (root, is_turned) = self.root(triangle);
            parts[root][usize::from(is_turned)] += 1;
        }
        (parts.iter().map(|[a, b]| a.min(b)).sum(), self.is_orientable)
    }
}
