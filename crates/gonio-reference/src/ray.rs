//! Rays from anywhere in the world against all triangles: inside of bodies, and for panoramas.
//!
//! The ray is the z axis of a space of its own, so that the test is the one of [`cross`], and as tight at edges.

use crate::geometry::{Triangle, WorldGeometry};
use crate::intersect::{Crossing, cross};
use glam::{DVec2, DVec3};
use gonio_light::vector;
use obvhs::bvh2::node::Bvh2Node;

/// A ray in the world with a picture's directions about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// World space.
    pub origin: DVec3,
    /// Unit, to the right of one who looks along the ray.
    right: DVec3,
    /// Unit, upwards.
    up: DVec3,
    /// Unit, along the ray.
    pub direction: DVec3,
}

impl Ray {
    /// `direction` is of unit length.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let right = vector::any_orthonormal_vector(direction);
        Ray { origin, right, up: right.cross(direction), direction }
    }

    /// A direction in the ray's space: to the right, upwards, along the ray.
    pub fn of_world(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.right), v.dot(self.up), v.dot(self.direction))
    }

    /// Three corners in the ray's space.
    pub fn corners(&self, geometry: &WorldGeometry, vertices: [u32; 3]) -> [DVec3; 3] {
        vertices.map(|v| self.of_world(geometry.positions[v as usize] - self.origin))
    }

    /// Hands every triangle that the ray meets in front of its origin to `meet`, in no certain order; the crossing's
    /// depth is the distance in world units. `meet` returns how far the search still goes: what is farther may be
    /// left out.
    pub fn trace(&self, geometry: &WorldGeometry, mut meet: impl FnMut(u32, &Triangle, Crossing) -> f64) {
        let Some(tree) = &geometry.tree else { return };
        let nodes = &tree.bvh.nodes;
        let line = Line::new((self.origin - tree.center) * tree.scale, self.direction);
        let mut reach = f64::INFINITY;
        let mut stack = Vec::with_capacity(64);
        stack.extend(nodes.first().and_then(|root| line.entry(root, reach)).map(|entry| (entry, 0)));
        while let Some((entry, index)) = stack.pop() {
            if entry > reach {
                continue;
            }
            let node = &nodes[index as usize];
            let first = node.first_index;
            if node.is_leaf() {
                let first = first as usize;
                for &id in &tree.bvh.primitive_indices[first..first + node.prim_count as usize] {
                    let triangle = &geometry.triangles[id as usize];
                    let crossing = cross(&self.corners(geometry, triangle.vertices), DVec2::ZERO);
                    // Written so that a depth that is not a number is no hit.
                    if let Some(crossing) = crossing.filter(|c| c.depth > 0.0) {
                        // Grown a little, as the boxes are.
                        reach = meet(id, triangle, crossing) * tree.scale + line.slack;
                    }
                }
            } else {
                let [left, right] = [first, first + 1].map(|child| {
                    let entry = line.entry(&nodes[child as usize], reach);
                    entry.map(|entry| (entry, child))
                });
                // The nearer one comes next.
                let swapped = matches!((left, right), (Some((l, _)), Some((r, _))) if l < r);
                let (later, next) = if swapped { (right, left) } else { (left, right) };
                stack.extend(later);
                stack.extend(next);
            }
        }
    }
}

/// A ray in the space of the tree's boxes.
struct Line {
    origin: DVec3,
    direction: DVec3,
    /// The margin added to every box, larger than the rounding errors.
    slack: f64,
}

impl Line {
    fn new(origin: DVec3, direction: DVec3) -> Self {
        Line { origin, direction, slack: 1e-12 * (1.0 + origin.abs().max_element()) }
    }

    /// The distance at which the ray enters the box, in the tree's units, not negative; `None` where it misses it or meets it beyond
    /// `reach`.
    fn entry(&self, node: &Bvh2Node, reach: f64) -> Option<f64> {
        let aabb = node.aabb();
        let low = aabb.min.as_dvec3() - self.slack - self.origin;
        let high = aabb.max.as_dvec3() + self.slack - self.origin;
        let (mut from, mut to) = (0.0_f64, reach);
        for axis in 0..3 {
            let d = self.direction[axis];
            if d == 0.0 {
                // Beside the slab, or between its two planes all along.
                if low[axis] > 0.0 || high[axis] < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (low[axis] / d, high[axis] / d);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
        (from <= to).then_some(from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::one_object;
    use glam::Vec3Swizzles;
    use gonio_light::Optics;
    use gonio_mesh::Mesh;

    /// A cloud of triangles of one object.
    fn cloud() -> WorldGeometry {
        // Multiples of irrational numbers: spread evenly, the same everywhere.
        let number = |i: u32, k: f64| ((f64::from(i) * k).fract() * 2.0 - 1.0) as f32;
        let positions = (0..900u32)
            .map(|i| {
                let (t, c) = (i / 3, i % 3);
                let small = |k| 0.2 * number(3 * t + c + 1, k);
                [
                    number(t + 1, 0.618_034) + small(0.414_214),
                    number(t + 1, 0.754_878) + small(0.732_051),
                    number(t + 1, 0.569_840) + small(0.236_068),
                ]
            })
            .collect();
        let mesh = Mesh { positions, indices: (0..900).collect(), ..Mesh::default() };
        WorldGeometry::new(&one_object(mesh, Optics::default()))
    }

    #[test]
    fn the_tree_loses_no_triangle() {
        let geometry = cloud();
        let mut hits = 0;
        for i in 0..500 {
            let angle = f64::from(i) * 2.399_963;
            let height = 1.0 - 2.0 * (f64::from(i) + 0.5) / 500.0;
            let radius = (1.0_f64 - height * height).sqrt();
            let away = DVec3::new(radius * angle.cos(), height, radius * angle.sin());
            // From outside, from inside, and along axes, where a direction has zeros.
            for (origin, direction) in [
                (2.0 * away, -away),
                (0.3 * away.yzx(), away),
                (1.5 * away, -DVec3::AXES[i as usize % 3]),
                (DVec3::ZERO, away),
            ] {
                let ray = Ray::new(origin, direction);
                let mut all: Vec<u32> = Vec::new();
                let mut nearest = (f64::INFINITY, u32::MAX);
                for (id, triangle) in geometry.triangles.iter().enumerate() {
                    let crossing = cross(&ray.corners(&geometry, triangle.vertices), DVec2::ZERO);
                    if let Some(c) = crossing.filter(|c| c.depth > 0.0) {
                        all.push(id as u32);
                        nearest = if (c.depth, id as u32) < nearest { (c.depth, id as u32) } else { nearest };
                    }
                }
                let mut met: Vec<u32> = Vec::new();
                ray.trace(&geometry, |id, _, _| {
                    met.push(id);
                    f64::INFINITY
                });
                met.sort_unstable();
                assert_eq!(met, all, "from {origin} along {direction}");
                let mut first = (f64::INFINITY, u32::MAX);
                ray.trace(&geometry, |id, _, c| {
                    first = if (c.depth, id) < first { (c.depth, id) } else { first };
                    first.0
                });
                assert_eq!(first, nearest, "from {origin} along {direction}");
                hits += all.len();
            }
        }
        assert!(hits > 1000, "{hits}");
    }

    #[test]
    fn distance_and_side_are_those_of_the_ray() {
        let positions = vec![[-1.0, -1.0, -3.0], [1.0, -1.0, -3.0], [0.0, 1.0, -3.0]];
        let mesh = Mesh { positions, indices: vec![0, 1, 2], ..Mesh::default() };
        let geometry = WorldGeometry::new(&one_object(mesh, Optics::default()));
        // Its front looks towards +Z: counter-clockwise from there, clockwise from behind.
        for (origin, direction, ccw) in
            [(DVec3::ZERO, DVec3::NEG_Z, true), (DVec3::new(0.0, 0.0, -5.0), DVec3::Z, false)]
        {
            let ray = Ray::new(origin, direction);
            let hit = cross(&ray.corners(&geometry, [0, 1, 2]), DVec2::ZERO);
            let distance = (origin.z + 3.0).abs();
            // A few roundings.
            assert!(
                hit.is_some_and(|h| (h.depth - distance).abs() < 1e-14 && h.counter_clockwise == ccw),
                "from {origin}: {hit:?}"
            );
        }
    }
}
