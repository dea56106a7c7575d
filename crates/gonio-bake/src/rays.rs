//! Rays against a mesh, in f32: the mesh is moved and scaled into the unit cube first.

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
pub(crate) struct MeshHit {
    pub triangle: usize,
    /// Barycentric coordinates.
    pub weights: DVec3,
}

/// A mesh, ready for rays.
pub(crate) struct RayMesh {
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
        let bvh = build(&boxes);
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

/// Same as `obvhs::bvh2::builder::build_bvh2`, without its clock, which the web does not have.
fn build(boxes: &[Aabb]) -> Bvh2 {
    let p = if boxes.len() < 200_000 { BvhBuildParams::medium_build() } else { BvhBuildParams::very_fast_build() };
    let order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut builder = PlocBuilder::with_capacity(boxes.len());
    let mut bvh = builder.build(p.ploc_search_distance, boxes, order, p.sort_precision, p.search_depth_threshold);
    let mut optimizer = ReinsertionOptimizer::default();
    optimizer.run(&mut bvh, p.reinsertion_batch_ratio, None);
    collapse(&mut bvh, p.max_prims_per_leaf.clamp(1, 255), p.collapse_traversal_cost);
    bvh
}
