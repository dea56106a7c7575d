//! Rays from the eye against triangles: edge functions in f64 that never leak at shared edges.
//!
//! Eye space is (right, up, along the viewing direction), so that a ray is the set of points `z (sx, sy, 1)`. A
//! triangle is sheared until the ray is the z axis, `x' = x - sx z`, `y' = y - sy z`, and the signs of the three 2-D
//! edge functions give the side of each edge on which the ray passes (after Woop, Benthin, Wald: "Watertight
//! Ray/Triangle Intersection", JCGT 2013). Both triangles at an edge compute its function from the same two numbers
//! with only the sign exchanged, and rounding never turns the sign of `a b - c d`, so no ray passes between them. Where
//! the function is 0 the edge belongs to one of the two by the top-left rule of rasterisers, so that no ray hits both.

use crate::geometry::WorldGeometry;
use crate::samples::sample_width;
use glam::{DVec2, DVec3};
use gonio_scene::{Camera, Frame};
use rayon::prelude::*;

/// One frame's view of the geometry.
pub(crate) struct EyeSpace {
    /// The eye.
    pub camera: Camera,
    /// Half the picture's extent at `z = 1`.
    pub half_extent: DVec2,
    /// Pixels.
    pub size: DVec2,
    /// The part of a pixel's width that a ray represents.
    pub sample_width: f64,
    /// [`WorldGeometry::positions`] in eye space.
    pub positions: Vec<DVec3>,
}

/// A space in which rays from the eye are pairs (`sx`, `sy`).
pub(crate) trait RaySpace {
    /// Three corners in it.
    fn corners(&self, vertices: [u32; 3]) -> [DVec3; 3];
    /// The footprint of a ray: the difference to a ray beside it on the right, and to one below. They are as far away
    /// as the samples of the picture are from each other.
    fn steps(&self) -> [DVec2; 2];
}

impl RaySpace for EyeSpace {
    #[inline]
    fn corners(&self, vertices: [u32; 3]) -> [DVec3; 3] {
        vertices.map(|v| self.positions[v as usize])
    }

    fn steps(&self) -> [DVec2; 2] {
        let step = self.sample_width * 2.0 * self.half_extent / self.size;
        [DVec2::new(step.x, 0.0), DVec2::new(0.0, -step.y)]
    }
}

/// The intersection of a ray and a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Weights of the corners; their sum is 1.
    pub barycentrics: DVec3,
    /// Along the viewing direction, world units.
    pub depth: f64,
    /// The corners are counter-clockwise in the picture.
    pub counter_clockwise: bool,
}

impl EyeSpace {
    pub fn new(geometry: &WorldGeometry, frame: &Frame) -> Self {
        let camera = frame.camera;
        let tan = (0.5 * camera.fov_y_rad).tan();
        let size = DVec2::new(f64::from(frame.width), f64::from(frame.height));
        let to_eye = |&p: &DVec3| {
            let d = p - camera.position;
            DVec3::new(d.dot(camera.right), d.dot(camera.up), d.dot(camera.front))
        };
        EyeSpace {
            camera,
            half_extent: DVec2::new(tan * size.x / size.y, tan),
            size,
            sample_width: sample_width(frame.samples),
            positions: geometry.positions.par_iter().map(to_eye).collect(),
        }
    }

    /// The ray through a point of the picture: pixels, x to the right, y down.
    #[inline]
    pub fn ray(&self, pixel: DVec2) -> DVec2 {
        DVec2::new(2.0 * pixel.x / self.size.x - 1.0, 1.0 - 2.0 * pixel.y / self.size.y) * self.half_extent
    }

    /// The unit direction of a ray in the world.
    pub fn direction(&self, ray: DVec2) -> DVec3 {
        let Camera { front, right, up, .. } = self.camera;
        (front + ray.x * right + ray.y * up).normalize()
    }

    /// The inverse of [`Self::ray`].
    #[inline]
    pub fn pixel(&self, ray: DVec2) -> DVec2 {
        let normalised = ray / self.half_extent;
        DVec2::new(0.5 * (normalised.x + 1.0), 0.5 * (1.0 - normalised.y)) * self.size
    }
}

/// The three edge functions of a triangle (eye space) at a ray, and the sheared edges: function `i` is that of the
/// edge opposite to corner `i`, twice the area that this corner weighs with.
#[inline]
fn edge_functions([a, b, c]: &[DVec3; 3], ray: DVec2) -> ([f64; 3], [DVec2; 3]) {
    let shear = |p: &DVec3| DVec2::new(p.x - ray.x * p.z, p.y - ray.y * p.z);
    let (a, b, c) = (shear(a), shear(b), shear(c));
    let edge = |p: DVec2, q: DVec2| p.x * q.y - p.y * q.x;
    ([edge(b, c), edge(c, a), edge(a, b)], [a, b, c])
}

/// The intersection of the ray and the triangle at any depth (behind the eye too), or `None`.
#[inline]
pub(crate) fn cross(corners: &[DVec3; 3], ray: DVec2) -> Option<Crossing> {
    let (e, sheared) = edge_functions(corners, ray);
    let [u, v, w] = e;
    let counter_clockwise = u >= 0.0 && v >= 0.0 && w >= 0.0;
    let clockwise = u <= 0.0 && v <= 0.0 && w <= 0.0;
    if !(counter_clockwise || clockwise) {
        return None;
    }
    let sum = u + v + w;
    if sum == 0.0 {
        return None; // Seen edge-on, or without area.
    }
    if (u == 0.0 || v == 0.0 || w == 0.0) && !owns_zero_edges(&e, &sheared, counter_clockwise) {
        return None;
    }
    let barycentrics = DVec3::new(u, v, w) / sum;
    let depth = barycentrics.dot(DVec3::new(corners[0].z, corners[1].z, corners[2].z));
    Some(Crossing { barycentrics, depth, counter_clockwise })
}

/// The top-left rule: of the edges through the ray a triangle owns those that are on its left or on its top.
fn owns_zero_edges(e: &[f64; 3], corners: &[DVec2; 3], counter_clockwise: bool) -> bool {
    (0..3).filter(|&i| e[i] == 0.0).all(|i| {
        let along = corners[(i + 2) % 3] - corners[(i + 1) % 3];
        // Counter-clockwise with y up, the inside is to the left of an edge: left edges lead down, top edges to -x.
        let along = if counter_clockwise { along } else { -along };
        along.y < 0.0 || (along.y == 0.0 && along.x < 0.0)
    })
}

/// The weights where the ray meets the triangle's *plane*, perhaps outside of the triangle; `None` where the plane is
/// seen from its other side or not at all (beyond its horizon). For differences between neighbouring pixels.
pub(crate) fn plane_barycentrics(corners: &[DVec3; 3], ray: DVec2, counter_clockwise: bool) -> Option<DVec3> {
    let (e, _) = edge_functions(corners, ray);
    let sum = e[0] + e[1] + e[2];
    let same_side = if counter_clockwise { sum > 0.0 } else { sum < 0.0 };
    same_side.then(|| DVec3::from(e) / sum).filter(|b| b.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [DVec3; 3] {
        [a.into(), b.into(), c.into()]
    }

    /// A small random number generator of our own (SplitMix64), so that runs are the same everywhere.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        }
    }

    #[test]
    fn depth_and_weights_are_those_of_the_point() {
        let corners = triangle([-1.0, -1.0, 2.0], [3.0, -1.0, 4.0], [-1.0, 2.0, 3.0]);
        let weights = DVec3::new(0.2, 0.3, 0.5);
        let p = weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
        let hit = cross(&corners, DVec2::new(p.x / p.z, p.y / p.z)).expect("inside");
        // Rounding only.
        assert!((hit.depth - p.z).abs() < 1e-14 && hit.barycentrics.distance(weights) < 1e-14 && hit.counter_clockwise);
        let [a, b, c] = corners;
        assert!(!cross(&[a, c, b], DVec2::new(p.x / p.z, p.y / p.z)).expect("inside").counter_clockwise);
        assert!(cross(&corners, DVec2::new(2.0, 2.0)).is_none());
    }

    /// A ray through a fan's spoke, its hub or its inside belongs to exactly one triangle of the fan, with exact
    /// numbers and with rounded ones.
    #[test]
    fn fans_are_covered_exactly_once() {
        let mut random = Random(7);
        for round in 0..400 {
            let spokes = 3 + round % 9;
            let hub_ray = DVec2::new(random.next() - 0.5, random.next() - 0.5);
            let point = |ray: DVec2, z: f64| DVec3::new(ray.x * z, ray.y * z, z);
            let hub = point(hub_ray, 1.0 + random.next());
            let turn = random.next();
            let rim: Vec<DVec3> = (0..spokes)
                .map(|i| {
                    let angle = (f64::from(i) + turn + 0.3 * random.next()) / f64::from(spokes) * std::f64::consts::TAU;
                    point(hub_ray + DVec2::from_angle(angle) * (0.1 + random.next()), 0.5 + 3.0 * random.next())
                })
                .collect();
            let hits = |ray: DVec2| {
                (0..rim.len()).filter(|&i| cross(&[hub, rim[i], rim[(i + 1) % rim.len()]], ray).is_some()).count()
            };
            // The ray that was rounded from the hub's own position, and rays along the spokes.
            assert_eq!(hits(DVec2::new(hub.x / hub.z, hub.y / hub.z)), 1, "hub of fan {round}");
            for corner in &rim {
                let t = 0.05 * random.next();
                let p = hub.lerp(*corner, t);
                assert_eq!(hits(DVec2::new(p.x / p.z, p.y / p.z)), 1, "spoke of fan {round}");
            }
        }
    }

    #[test]
    fn an_exact_shared_edge_belongs_to_one_side() {
        // The edge x = 0 and its mirror images, hit exactly.
        let left = triangle([0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [-1.0, 0.0, 1.0]);
        let right = triangle([0.0, 1.0, 1.0], [0.0, -1.0, 1.0], [1.0, 0.0, 1.0]);
        let flipped = [right[1], right[0], right[2]];
        let ray = DVec2::new(0.0, 0.25);
        assert!(cross(&left, ray).is_none());
        // It is the left edge of the right triangle, whichever way that is wound.
        assert!(cross(&right, ray).is_some() && cross(&flipped, ray).is_some());
        // A horizontal edge is the top of the lower triangle.
        let lower = triangle([1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [0.0, -1.0, 1.0]);
        let upper = triangle([-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]);
        assert!(cross(&lower, DVec2::new(0.5, 0.0)).is_some() && cross(&upper, DVec2::new(0.5, 0.0)).is_none());
    }

    #[test]
    fn planes_go_on_beyond_the_triangle_but_not_beyond_their_horizon() {
        let floor = triangle([-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [0.0, -1.0, 4.0]);
        let weights = plane_barycentrics(&floor, DVec2::new(3.0, -1.0), true).expect("below the horizon");
        let p = weights.x * floor[0] + weights.y * floor[1] + weights.z * floor[2];
        assert!((p - DVec3::new(3.0, -1.0, 1.0)).length() < 1e-14, "{p}");
        assert!(plane_barycentrics(&floor, DVec2::new(0.0, 0.1), true).is_none());
    }
}
