//! Triangles over places, with the attributes of their corners, while edges collapse.

use super::Quadric;
use crate::{Mesh, Part, weld};
use glam::DVec3;
use std::collections::HashMap;

/// The cost of moving away from an outline or a seam, relative to the surface.
const EDGE_WEIGHT: f64 = 10.0;
/// The cosine of the largest angle by which a triangle may turn when a corner of it moves: 78 degrees.
const LEAST_COSINE: f64 = 0.2;

/// A surface: triangles with a place and a wedge for each corner. A wedge consists of the attributes of a vertex other
/// than its place (normal, texture coordinates, colour) and its part; a place with several wedges is on a seam.
pub struct CollapsingSurface {
    /// Relative to the centre, so that quadrics are exact.
    pub places: Vec<DVec3>,
    /// Number of remaining triangles.
    pub live: usize,
    triangles: Vec<Triangle>,
    /// The remaining triangles around each place.
    around: Vec<Vec<u32>>,
    /// A vertex of the mesh for each wedge.
    vertex_of_wedge: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Triangle {
    places: [u32; 3],
    wedges: [u32; 3],
    alive: bool,
}

impl Triangle {
    fn corner_at(&self, place: u32) -> Option<usize> {
        self.places.iter().position(|p| *p == place)
    }

    fn has(&self, place: u32) -> bool {
        self.places.contains(&place)
    }
}

impl CollapsingSurface {
    /// Creates the surface of a mesh; without `with_normals`, normals make no seams.
    pub fn new(mesh: &Mesh, with_normals: bool) -> Self {
        let (place_of_vertex, count) = weld::places(&mesh.positions);
        let middle = mesh.bounds().map_or(DVec3::ZERO, |b| b.center().as_dvec3());
        let mut places = vec![DVec3::ZERO; count];
        for (position, place) in mesh.positions.iter().zip(&place_of_vertex) {
            places[*place as usize] = glam::Vec3::from(*position).as_dvec3() - middle;
        }
        let part_of_triangle = |t: usize| mesh.parts.partition_point(|part| part.first_triangle <= t) as u32;
        let mut wedges: HashMap<[u32; 11], u32> = HashMap::new();
        let mut vertex_of_wedge = Vec::new();
        let mut triangles = Vec::with_capacity(mesh.triangle_count());
        let mut around = vec![Vec::new(); count];
        let mut live = 0;
        for t in 0..mesh.triangle_count() {
            let part = part_of_triangle(t);
            let vertices = mesh.triangle(t);
            let of_corner = vertices.map(|v| {
                let normal = if with_normals { mesh.normals.get(v).copied().unwrap_or_default() } else { [0.0; 3] };
                let uv = mesh.tex_coords.get(v).copied().unwrap_or_default();
                let color = mesh.colors.get(v).copied().unwrap_or_default();
                let mut key = [0; 11];
                key[0] = place_of_vertex[v];
                key[1] = part;
                let values = normal.into_iter().chain(uv).chain(color);
                key[2..].iter_mut().zip(values).for_each(|(k, value)| *k = value.to_bits());
                *wedges.entry(key).or_insert_with(|| {
                    vertex_of_wedge.push(v as u32);
                    (vertex_of_wedge.len() - 1) as u32
                })
            });
            let corners = vertices.map(|v| place_of_vertex[v]);
            let [a, b, c] = corners;
            let alive = a != b && b != c && c != a;
            if alive {
                live += 1;
                corners.iter().for_each(|place| around[*place as usize].push(t as u32));
            }
            triangles.push(Triangle { places: corners, wedges: of_corner, alive });
        }
        CollapsingSurface { places, live, triangles, around, vertex_of_wedge }
    }

    /// Returns the places that share an edge with a place, each once.
    pub fn neighbours(&self, place: u32) -> Vec<u32> {
        let mut found: Vec<u32> = Vec::with_capacity(8);
        for &t in &self.around[place as usize] {
            for other in self.triangles[t as usize].places {
                if other != place && !found.contains(&other) {
                    found.push(other);
                }
            }
        }
        found
    }

    /// Returns the quadric of each place: the planes of its triangles, weighted by area, and planes perpendicular to
    /// the surface along outlines and seams.
    pub fn quadrics(&self) -> Vec<Quadric> {
        let mut quadrics = vec![Quadric::default(); self.places.len()];
        for triangle in self.triangles.iter().filter(|t| t.alive) {
            let [a, b, c] = triangle.places.map(|p| self.places[p as usize]);
            let cross = (b - a).cross(c - a);
            let Some(normal) = cross.try_normalize() else { continue };
            let plane = Quadric::of_plane(normal, a, 0.5 * cross.length());
            triangle.places.iter().for_each(|p| quadrics[*p as usize] = quadrics[*p as usize] + plane);
            for k in 0..3 {
                let [from, to] = [triangle.places[k], triangle.places[(k + 1) % 3]];
                if !self.is_crease(triangle, from, to) {
                    continue;
                }
                let along = self.places[to as usize] - self.places[from as usize];
                let Some(upright) = along.cross(normal).try_normalize() else { continue };
                let plane =
                    Quadric::of_plane(upright, self.places[from as usize], EDGE_WEIGHT * along.length_squared());
                [from, to].iter().for_each(|p| quadrics[*p as usize] = quadrics[*p as usize] + plane);
            }
        }
        quadrics
    }

    /// Whether a triangle's edge is an outline or a seam: no other triangle has both of its wedges.
    fn is_crease(&self, triangle: &Triangle, from: u32, to: u32) -> bool {
        let wedges = |t: &Triangle| Some([t.wedges[t.corner_at(from)?], t.wedges[t.corner_at(to)?]]);
        let own = wedges(triangle);
        let sharing = self.around[from as usize].iter().filter(|t| wedges(&self.triangles[**t as usize]) == own);
        sharing.count() != 2
    }

    /// Moves everything at `from` onto `onto` if that preserves the surface; returns whether it did.
    pub fn collapse(&mut self, from: u32, onto: u32) -> bool {
        let Some(wedge_onto) = self.wedges_onto(from, onto) else { return false };
        for t in std::mem::take(&mut self.around[from as usize]) {
            let triangle = &mut self.triangles[t as usize];
            if triangle.has(onto) {
                triangle.alive = false;
                self.live -= 1;
                for place in triangle.places.into_iter().filter(|p| *p != from) {
                    self.around[place as usize].retain(|other| *other != t);
                }
            } else if let Some(corner) = triangle.corner_at(from) {
                let wedge = triangle.wedges[corner];
                triangle.places[corner] = onto;
                triangle.wedges[corner] = wedge_onto.iter().find(|(w, _)| *w == wedge).map_or(wedge, |(_, to)| *to);
                self.around[onto as usize].push(t);
            }
        }
        true
    }

    /// Returns the wedge at `onto` for each wedge at `from`; `None` if the edge must not collapse.
    fn wedges_onto(&self, from: u32, onto: u32) -> Option<Vec<(u32, u32)>> {
        let of = |t: &u32| &self.triangles[*t as usize];
        let (shared, moved): (Vec<u32>, Vec<u32>) = self.around[from as usize].iter().partition(|t| of(t).has(onto));
        if shared.is_empty() || shared.len() > 2 {
            return None;
        }
        // A vertex on an outline stays on the outline.
        if shared.len() == 2 && self.is_on_outline(from) {
            return None;
        }
        // The link condition (Dey et al. 1999): otherwise a hole would close, or two sheets would touch.
        let neighbours = self.neighbours(onto);
        if self.neighbours(from).iter().filter(|p| neighbours.contains(p)).count() != shared.len() {
            return None;
        }
        let mut map: Vec<(u32, u32)> = Vec::with_capacity(2);
        for triangle in shared.iter().map(of) {
            let pair = (triangle.wedges[triangle.corner_at(from)?], triangle.wedges[triangle.corner_at(onto)?]);
            match map.iter().find(|(w, _)| *w == pair.0) {
                Some(known) if known.1 != pair.1 => return None,
                Some(_) => {}
                None => map.push(pair),
            }
        }
        for triangle in moved.iter().map(of) {
            let corner = triangle.corner_at(from)?;
            // A seam runs along the edge, or not through `from` at all.
            map.iter().find(|(w, _)| *w == triangle.wedges[corner])?;
            let [next, last] = [triangle.places[(corner + 1) % 3], triangle.places[(corner + 2) % 3]];
            if self.around[onto as usize].iter().map(of).any(|t| t.has(next) && t.has(last)) {
                return None;
            }
            let [a, b] = [next, last].map(|p| self.places[p as usize]);
            let normal_with = |corner: u32| (a - self.places[corner as usize]).cross(b - self.places[corner as usize]);
            let (before, after) = (normal_with(from), normal_with(onto));
            if after.dot(before) <= LEAST_COSINE * before.length() * after.length() {
                return None;
            }
        }
        Some(map)
    }

    /// Whether an edge at a place has only one triangle.
    fn is_on_outline(&self, place: u32) -> bool {
        let around = &self.around[place as usize];
        self.neighbours(place)
            .iter()
            .any(|other| around.iter().filter(|t| self.triangles[**t as usize].has(*other)).count() == 1)
    }

    /// Returns the remaining mesh; without normals if they were ignored.
    pub fn into_mesh(self, mesh: &Mesh, with_normals: bool) -> Mesh {
        let mut vertex_of: Vec<Option<u32>> = vec![None; self.vertex_of_wedge.len()];
        let mut kept: Vec<u32> = Vec::new();
        let mut left = Mesh { normal_source: mesh.normal_source, ..Mesh::default() };
        for (t, triangle) in self.triangles.iter().enumerate().filter(|(_, triangle)| triangle.alive) {
            for wedge in triangle.wedges {
                let index = *vertex_of[wedge as usize].get_or_insert_with(|| {
                    kept.push(self.vertex_of_wedge[wedge as usize]);
                    (kept.len() - 1) as u32
                });
                left.indices.push(index);
            }
            left.smoothing_groups.extend(mesh.smoothing_groups.get(t));
        }
        left.positions = gather(&mesh.positions, &kept);
        left.tex_coords = gather(&mesh.tex_coords, &kept);
        left.colors = gather(&mesh.colors, &kept);
        if with_normals {
            left.normals = gather(&mesh.normals, &kept);
            left.tangents = gather(&mesh.tangents, &kept);
        }
        let mut first_triangle = 0;
        for part in &mesh.parts {
            let all = self.triangles.iter().skip(part.first_triangle).take(part.triangle_count);
            let triangle_count = all.filter(|t| t.alive).count();
            left.parts.push(Part { first_triangle, triangle_count, ..part.clone() });
            first_triangle += triangle_count;
        }
        left
    }
}

fn gather<T: Copy>(values: &[T], kept: &[u32]) -> Vec<T> {
    kept.iter().filter_map(|vertex| values.get(*vertex as usize).copied()).collect()
}
