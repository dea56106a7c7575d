//! Rays against triangles: trees of boxes, and a mesh that is ready for rays.
//!
//! The reference tests triangles in f64 itself and takes the tree alone; the path tracer has a wider tree of its own.
#![forbid(unsafe_code)]

use glam::{DVec3, Vec3A};
use gonio_mesh::Mesh;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::PlocBuilder;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

/// Where a ray meets a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshHit {
    /// Index of the triangle.
    pub triangle: usize,
    /// Barycentric coordinates.
    pub weights: DVec3,
}

/// A mesh, ready for rays in f32: it is moved and scaled into the unit cube.
pub struct RayMesh {
    bvh: Bvh2,
    /// In the order of the tree.
    triangles: Vec<Triangle>,
    center: DVec3,
    scale: f64,
}

/// Rays start this far from their surface, in sizes of the mesh: well above the rounding errors of f32.
const OFFSET: f64 = 2e-5;

impl RayMesh {
    /// `None` without triangles.
    pub fn new(mesh: &Mesh) -> Option<Self> {
        let bounds = mesh.bounds().filter(|_| !mesh.indices.is_empty())?;
        let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let (center, extent) = (0.5 * (low + high), (high - low).max_element());
        let scale = if extent > 0.0 && (1.0 / extent).is_finite() { 1.0 / extent } else { 1.0 };
        let carry = |p: glam::Vec3| Vec3A::from(((p.as_dvec3() - center) * scale).as_vec3());
        let own: Vec<Triangle> = (0..mesh.triangle_count())
            .map(|t| {
                let [v0, v1, v2] = mesh.triangle_positions(t).map(carry);
                Triangle { v0, v1, v2 }
            })
            .collect();
        let boxes: Vec<Aabb> =
            own.iter().map(|t| Aabb::new(t.v0.min(t.v1).min(t.v2) - 1e-7, t.v0.max(t.v1).max(t.v2) + 1e-7)).collect();
        let bvh = build_tree(&boxes);
        let triangles = bvh.primitive_indices.iter().map(|&i| own[i as usize]).collect();
        Some(RayMesh { bvh, triangles, center, scale })
    }

    /// The first triangle that a ray meets from `origin` within `reach` world units; `direction` is of unit length.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<MeshHit> {
        let ray = self.ray(origin, direction, reach);
        let mut hit = RayHit::none();
        self.bvh.ray_traverse(ray, &mut hit, |ray, id| self.triangles[id].intersect(ray));
        let triangle = self.triangles.get(hit.primitive_id as usize)?;
        let point = ray.origin + hit.t * ray.direction;
        let cross = |a: Vec3A, b: Vec3A| (a - point).cross(b - point);
        let normal = (triangle.v1 - triangle.v0).cross(triangle.v2 - triangle.v0);
        let weight = |a: Vec3A, b: Vec3A| f64::from(cross(a, b).dot(normal)).max(0.0);
        let weights = DVec3::new(
            weight(triangle.v1, triangle.v2),
            weight(triangle.v2, triangle.v0),
            weight(triangle.v0, triangle.v1),
        );
        let triangle = self.bvh.primitive_indices[hit.primitive_id as usize] as usize;
        let weights = weights / weights.element_sum();
        Some(MeshHit { triangle, weights: if weights.is_finite() { weights } else { DVec3::splat(1.0 / 3.0) } })
    }

    /// Whether a ray from a surface meets a triangle within `reach` world units. `normal` is that of the surface, on the
    /// side of the ray.
    pub fn is_blocked(&self, position: DVec3, normal: DVec3, direction: DVec3, reach: f64) -> bool {
        let offset = OFFSET / self.scale;
        let ray = self.ray(position + offset * normal, direction, reach - offset);
        !self.bvh.ray_traverse_miss(ray, |ray, id| self.triangles[id].intersect(ray))
    }

    fn ray(&self, origin: DVec3, direction: DVec3, reach: f64) -> Ray {
        let origin = Vec3A::from(((origin - self.center) * self.scale).as_vec3());
        Ray::new(origin, Vec3A::from(direction.as_vec3()), 0.0, (reach * self.scale) as f32)
    }
}

/// Builds a tree over boxes, on one thread: a good one, above 200,000 boxes a quick one.
///
/// Same as `obvhs::bvh2::builder::build_bvh2`, without its clock, which the web does not have.
pub fn build_tree(boxes: &[Aabb]) -> Bvh2 {
    let p = if boxes.len() < 200_000 { BvhBuildParams::medium_build() } else { BvhBuildParams::very_fast_build() };
    let order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut builder = PlocBuilder::with_capacity(boxes.len());
    let mut bvh = builder.build(p.ploc_search_distance, boxes, order, p.sort_precision, p.search_depth_threshold);
    let mut optimizer = ReinsertionOptimizer::default();
    optimizer.run(&mut bvh, p.reinsertion_batch_ratio, None);
    collapse(&mut bvh, p.max_prims_per_leaf.clamp(1, 255), p.collapse_traversal_cost);
    optimizer.run(&mut bvh, p.reinsertion_batch_ratio * p.post_collapse_reinsertion_batch_ratio_multiplier, None);
    bvh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in [0, 1) without order.
    fn numbers() -> impl Iterator<Item = f64> {
        (1_u32..).map(|i| f64::from(i.wrapping_mul(2_654_435_761) ^ i.wrapping_mul(40_503) << 9) / 4_294_967_296.0)
    }

    /// The distance at which a ray meets a triangle, by Cramer's rule.
    fn distance(mesh: &Mesh, triangle: usize, origin: DVec3, direction: DVec3) -> Option<f64> {
        let [a, b, c] = mesh.triangle_positions(triangle).map(|p| p.as_dvec3());
        let (u, v, along) = (b - a, c - a, origin - a);
        let (p, q) = (direction.cross(v), along.cross(u));
        let [y, z, t] = [along.dot(p), direction.dot(q), v.dot(q)].map(|n| n / u.dot(p));
        (y >= 0.0 && z >= 0.0 && y + z <= 1.0 && t > 0.0).then_some(t)
    }

    /// Small triangles far from the origin, against the plain definition.
    #[test]
    fn the_first_hit_is_the_nearest() {
        let mut random = numbers();
        let mut point = |size: f64| DVec3::from([(); 3].map(|()| size * (random.next().unwrap_or(0.0) - 0.5)));
        let place = DVec3::new(1000.0, -500.0, 200.0);
        let mut mesh = Mesh::default();
        for i in 0..300 {
            let middle = place + point(4.0);
            mesh.positions.extend([(); 3].map(|()| (middle + point(2.0)).as_vec3().to_array()));
            mesh.indices.extend([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let Some(rays) = RayMesh::new(&mesh) else { unreachable!("there are triangles") };
        let mut hits = 0;
        for _ in 0..500 {
            let (origin, direction) = (place + point(5.0), point(1.0).normalize_or(DVec3::X));
            let all = (0..300).filter_map(|t| Some((distance(&mesh, t, origin, direction)?, t)));
            let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
            let found = rays.first_hit(origin, direction, 100.0);
            assert_eq!(found.map(|hit| hit.triangle), nearest.map(|(_, t)| t), "{origin} {direction}");
            if let (Some(hit), Some((distance, t))) = (found, nearest) {
                hits += 1;
                let corners = mesh.triangle_positions(t).map(|p| p.as_dvec3());
                let at: DVec3 = hit.weights.to_array().into_iter().zip(corners).map(|(w, corner)| w * corner).sum();
                assert!(at.distance(origin + distance * direction) < 1e-3, "{at}");
                assert!(rays.is_blocked(origin, direction, direction, distance + 0.1));
                assert!(!rays.is_blocked(origin, direction, direction, distance - 0.1));
            }
        }
        assert!(hits > 50, "{hits}");
    }
}
