//! The inside of an object, as the rays of sight that go through it find it.

use crate::fragment::interpolate;
use crate::geometry::WorldGeometry;
use crate::ray::Ray;
use glam::DVec3;
use gonio_light::optics::{Body, Meeting};
use gonio_light::vector;

/// What lies nearer to a ray's origin than this share of the object's diagonal is the surface that it starts from:
/// more than what positions in f32 are rounded by, and far below what is seen.
const NEAREST_MEETING: f64 = 1e-6;

/// The inside of one object: its own triangles only, whatever else is in the way.
pub(crate) struct ObjectBody<'a> {
    pub geometry: &'a WorldGeometry,
    /// Index into the scene's objects.
    pub object: u32,
    /// The triangles' own normals count, not the corners'.
    pub flat: bool,
}

impl Body for ObjectBody<'_> {
    /// The nearest triangle whose back the ray meets: so neither the one where it went in nor one that it only passes
    /// from outside.
    fn next_meeting(&self, origin: DVec3, direction: DVec3) -> Option<Meeting> {
        let least = NEAREST_MEETING * self.geometry.placements[self.object as usize].diagonal;
        let ray = Ray::new(origin, direction);
        let (mut nearest, mut weights) = ((f64::INFINITY, u32::MAX), DVec3::ZERO);
        ray.trace(self.geometry, |id, triangle, crossing| {
            let from_inside = crossing.counter_clockwise == triangle.mirrored;
            let found = (crossing.depth, id);
            if triangle.object == self.object && from_inside && crossing.depth > least && found < nearest {
                (nearest, weights) = (found, crossing.barycentrics);
            }
            nearest.0
        });
        let (distance, id) = nearest;
        let triangle = self.geometry.triangles.get(id as usize)?;
        let geometric = self.geometry.geometric_normal(triangle);
        let shading = if self.flat {
            geometric
        } else {
            let normals = triangle.vertices.map(|v| self.geometry.normals[v as usize]);
            vector::unit_or(interpolate(weights, normals), geometric)
        };
        // Interpolated normals may look at the ray where the triangle does not.
        let normal = if shading.dot(direction) > 0.0 { shading } else { geometric };
        Some(Meeting { position: interpolate(weights, self.geometry.corners(triangle)), normal, distance })
    }
}
