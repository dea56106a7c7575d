//! The inside of an object, for view rays that pass through it.

use crate::fragment::interpolate;
use crate::geometry::WorldGeometry;
use crate::ray::Ray;
use glam::DVec3;
use gonio_light::optics::{Body, Meeting, NEAREST_MEETING};
use gonio_light::vector;

/// The inside of one object: only its own triangles count.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::one_object;
    use gonio_light::{Optics, Surfaces};
    use gonio_mesh::Mesh;

    /// A wall of 20 x 20 at z = 0 whose outside is +Z, with normals that lean towards +X, and another at z = 4.
    fn walls() -> WorldGeometry {
        let corners = |z: f32| [[-10.0, -10.0, z], [10.0, -10.0, z], [10.0, 10.0, z], [-10.0, 10.0, z]];
        let mesh = Mesh {
            positions: [corners(0.0), corners(4.0)].concat(),
            normals: vec![[0.6, 0.0, 0.8]; 8],
            indices: vec![0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7],
            ..Mesh::default()
        };
        let optics = Optics { transmission: 1.0, surfaces: Surfaces::Two, ..Optics::default() };
        WorldGeometry::new(&one_object(mesh, optics))
    }

    #[test]
    fn the_nearest_wall_that_is_not_the_start_is_met_from_inside() {
        let geometry = walls();
        let body = |flat| ObjectBody { geometry: &geometry, object: 0, flat };
        let distance = |z: f64, d: DVec3| body(true).next_meeting(DVec3::new(1.0, 2.0, z), d).map(|m| m.distance);
        // A few roundings.
        let near = |got: Option<f64>, expected: f64| got.is_some_and(|got| (got - expected).abs() < 1e-13);
        assert!(near(distance(-1.0, DVec3::Z), 1.0) && near(distance(1.0, DVec3::Z), 3.0));
        // The box's diagonal is 28.6: within a millionth of it the wall is where the ray starts.
        let least = 1e-6 * (800.0_f64 + 16.0).sqrt();
        assert!(near(distance(-1.01 * least, DVec3::Z), 1.01 * least));
        assert!(near(distance(-0.99 * least, DVec3::Z), 4.0 + 0.99 * least), "{:?}", distance(-least, DVec3::Z));
        // Fronts are passed, and nothing is behind.
        assert_eq!(distance(5.0, DVec3::NEG_Z), None);
        assert_eq!(body(true).next_meeting(DVec3::new(30.0, 0.0, -1.0), DVec3::Z), None);
    }

    #[test]
    fn the_nearer_triangle_in_overlapping_boxes_counts() {
        // Along the z axis the first is met at 3, the second at 8; the boxes begin at 0 and at 1, in either order.
        let slanted = |low: f32, high: f32| [[-1.0, -1.0, low], [1.0, -1.0, high], [0.0, 2.0, 0.5 * (low + high)]];
        for (near, far) in [(slanted(0.0, 6.0), slanted(1.0, 15.0)), (slanted(1.0, 5.0), slanted(0.0, 16.0))] {
            let mesh = Mesh { positions: [near, far].concat(), indices: vec![0, 1, 2, 3, 4, 5], ..Mesh::default() };
            let geometry = WorldGeometry::new(&one_object(mesh, Optics::default()));
            let body = ObjectBody { geometry: &geometry, object: 0, flat: true };
            let distance = body.next_meeting(DVec3::NEG_Z, DVec3::Z).map(|m| m.distance);
            // A few roundings.
            assert!(distance.is_some_and(|d| (d - 4.0).abs() < 1e-12), "{distance:?}");
        }
    }

    #[test]
    fn normals_are_the_shadings_unless_they_look_back() {
        let geometry = walls();
        let body = |flat| ObjectBody { geometry: &geometry, object: 0, flat };
        let normal = |flat, d: DVec3| body(flat).next_meeting(DVec3::NEG_Z, d.normalize()).map(|m| m.normal);
        // f32 of the mesh.
        let leaning = DVec3::new(0.6_f32.into(), 0.0, 0.8_f32.into()).normalize();
        assert!(normal(false, DVec3::Z).is_some_and(|n| n.abs_diff_eq(leaning, 1e-12)));
        assert_eq!(normal(true, DVec3::Z), Some(DVec3::Z));
        // 0.6 (-2) + 0.8 (1) < 0.
        assert_eq!(normal(false, DVec3::new(-2.0, 0.0, 1.0)), Some(DVec3::Z));
    }
}
