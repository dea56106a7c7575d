//! Simplifies meshes by edge collapse in the order of the quadric error metric.
//!
//! M. Garland, P. S. Heckbert, "Surface simplification using quadric error metrics" (SIGGRAPH 1997). An edge collapses
//! onto one of its ends (their "subset placement"), so that every remaining vertex keeps its position, normal, texture
//! coordinates and colour: a comparison then shows the effect of the triangles only.

mod surface;
#[cfg(test)]
mod tests;

use crate::{ByCost, Mesh, normals};
use glam::{DMat3, DVec3};
use std::collections::{BinaryHeap, HashSet};
use std::ops::Add;
use surface::CollapsingSurface;

/// Returns the mesh with at most `triangles` triangles, or as few as possible. Outlines, seams of textures and normals,
/// and borders between materials only lose vertices along themselves, and late; nothing folds over, no hole closes, and
/// a closed surface stays closed (though with very few triangles it may be flat). A corner where three seams meet
/// stays, so a cube with one normal per face keeps twelve triangles.
///
/// Parts stay in order, even without triangles. A mesh with one normal per triangle gets new normals; other meshes keep
/// those of the remaining vertices. Triangles without area are removed first.
pub fn simplify(mesh: &Mesh, triangles: usize) -> Mesh {
    if mesh.triangle_count() <= triangles {
        return mesh.clone();
    }
    let faceted = is_faceted(mesh);
    let mut surface = CollapsingSurface::new(mesh, !faceted);
    let mut quadrics = surface.quadrics();
    // A pass may be stopped by edges that could not collapse at their turn but can now.
    while surface.live > triangles && pass(&mut surface, &mut quadrics, triangles) {}
    let simplified = surface.into_mesh(mesh, !faceted);
    if faceted { normals::make_flat(&simplified) } else { simplified }
}

/// Whether nearly every face has normals of its own, which then do not mark edges of the surface. A cube's corners have
/// three normals each, those of a sphere of quads four, of triangles six.
fn is_faceted(mesh: &Mesh) -> bool {
    let (place_of_vertex, places) = crate::weld::places(&mesh.positions);
    let corners = place_of_vertex.iter().zip(&mesh.normals);
    let distinct: HashSet<(u32, [u32; 3])> =
        corners.map(|(place, n)| (*place, n.map(|v| (v + 0.0).to_bits()))).collect();
    2 * distinct.len() > 7 * places
}

/// An edge that may collapse, `from` onto `onto`, and the versions of both when the cost was computed.
type Candidate = ByCost<([u32; 2], [u32; 2])>;

/// Collapses edges until enough are gone or no more can; returns whether any did.
fn pass(surface: &mut CollapsingSurface, quadrics: &mut [Quadric], triangles: usize) -> bool {
    let mut versions = vec![0_u32; quadrics.len()];
    let mut heap = BinaryHeap::new();
    for from in 0..quadrics.len() as u32 {
        for onto in surface.neighbours(from) {
            heap.extend(candidate(surface, quadrics, &versions, from, onto));
        }
    }
    let mut any = false;
    while surface.live > triangles {
        let Some(Candidate { of: ([from, onto], seen), .. }) = heap.pop() else { break };
        if seen != [versions[from as usize], versions[onto as usize]] || !surface.collapse(from, onto) {
            continue;
        }
        any = true;
        quadrics[onto as usize] = quadrics[onto as usize] + quadrics[from as usize];
        versions[from as usize] += 1;
        versions[onto as usize] += 1;
        for next in surface.neighbours(onto) {
            heap.extend(candidate(surface, quadrics, &versions, onto, next));
            heap.extend(candidate(surface, quadrics, &versions, next, onto));
        }
    }
    any
}

fn candidate(
    surface: &CollapsingSurface,
    quadrics: &[Quadric],
    versions: &[u32],
    from: u32,
    onto: u32,
) -> Option<Candidate> {
    let sum = *quadrics.get(from as usize)? + *quadrics.get(onto as usize)?;
    let cost = sum.error_at(*surface.places.get(onto as usize)?);
    let versions = [*versions.get(from as usize)?, *versions.get(onto as usize)?];
    Some(Candidate { cost, of: ([from, onto], versions) })
}

/// The sum of weighted squared distances of a point p from planes: `p^T A p + 2 b.p + c` (Garland and Heckbert 1997,
/// section 4).
#[derive(Clone, Copy, Debug, Default)]
pub struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// Creates the quadric of the plane through `point` with the unit normal `normal`.
    pub fn of_plane(normal: DVec3, point: DVec3, weight: f64) -> Self {
        let d = -normal.dot(point);
        let a = DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        Quadric { a: a * weight, b: normal * (d * weight), c: d * d * weight }
    }

    /// Returns the weighted sum of squares at a point; not below 0 in spite of rounding.
    pub fn error_at(&self, p: DVec3) -> f64 {
        (p.dot(self.a * p) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }
}

impl Add for Quadric {
    type Output = Quadric;
    fn add(self, other: Quadric) -> Quadric {
        Quadric { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c }
    }
}
