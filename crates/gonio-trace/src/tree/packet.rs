//! Eight triangles at once.
//!
//! No ray passes between triangles that share an edge (S. Woop, C. Benthin, I. Wald, *Watertight Ray/Triangle
//! Intersection*, JCGT 2(1), 2013): edges belong to both.

use super::{Hit, Ray};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};
use glam::Vec3;

/// Triangles per packet.
pub(super) const SIZE: usize = 8;
/// The axes after each axis, in turn and in reverse.
const AXES: [[usize; 2]; 6] = [[1, 2], [2, 1], [2, 0], [0, 2], [0, 1], [1, 0]];

/// Triangles: x, y and z of each corner. Unused places repeat the first triangle.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Packet {
    corners: [[[f32; SIZE]; 3]; 3],
    triangles: [u32; SIZE],
}

/// A ray, prepared for triangles: along the third axis of a sheared space.
pub(super) struct ShearedRay<S: Simd> {
    /// The axes, the direction's largest component last.
    axes: [usize; 3],
    shear: [f32x8<S>; 3],
    origin: [f32x8<S>; 3],
}

impl<S: Simd> ShearedRay<S> {
    #[inline(always)]
    pub fn new(simd: S, ray: &Ray, inverse: &[f32; 4]) -> Self {
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        // Without branches, which rays would take in no order.
        let size = ray.direction.abs();
        let z = if size.z > size.x.max(size.y) { 2 } else { usize::from(size.y > size.x) };
        let [x, y] = AXES[2 * z + usize::from(d[z] < 0.0)];
        let splat = |v: f32| f32x8::splat(simd, v);
        ShearedRay {
            axes: [x, y, z],
            shear: [splat(d[x] * inverse[z]), splat(d[y] * inverse[z]), splat(inverse[z])],
            origin: [splat(o[x]), splat(o[y]), splat(o[z])],
        }
    }

    /// Corners in the space where the ray is the third axis.
    #[inline(always)]
    fn sheared(&self, simd: S, corners: &[[f32; SIZE]; 3]) -> [f32x8<S>; 3] {
        let [kx, ky, kz] = self.axes;
        let z = f32x8::load_array_ref(simd, &corners[kz]) - self.origin[2];
        let x = f32x8::load_array_ref(simd, &corners[kx]) - self.origin[0] - self.shear[0] * z;
        let y = f32x8::load_array_ref(simd, &corners[ky]) - self.origin[1] - self.shear[1] * z;
        [x, y, z]
    }
}

/// Triangles that a ray meets.
struct Met<S: Simd> {
    /// A bit for each.
    lanes: u64,
    /// Weights of the corners times `determinant`.
    weights: [f32x8<S>; 3],
    determinant: f32x8<S>,
    distance: f32x8<S>,
}

impl Packet {
    /// One to eight triangles, by their indices.
    pub fn new(triangles: &[u32], corners: &[[Vec3; 3]]) -> Self {
        let triangles = std::array::from_fn(|lane| triangles[if lane < triangles.len() { lane } else { 0 }]);
        let corner = |c: usize, axis: usize| triangles.map(|t: u32| corners[t as usize][c][axis]);
        let corners = std::array::from_fn(|c| std::array::from_fn(|axis| corner(c, axis)));
        Packet { corners, triangles }
    }

    #[inline(always)]
    fn meet<S: Simd>(&self, simd: S, ray: &ShearedRay<S>, reach: f32) -> Option<Met<S>> {
        let [a, b, c] = &self.corners;
        let [ax, ay, az] = ray.sheared(simd, a);
        let [bx, by, bz] = ray.sheared(simd, b);
        let [cx, cy, cz] = ray.sheared(simd, c);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let zero = f32x8::splat(simd, 0.0);
        let inside = u.min(v).min(w).simd_ge(zero) | u.max(v).max(w).simd_le(zero);
        if !inside.any_true() {
            return None;
        }
        let determinant = u + v + w;
        let distance = (u * az + v * bz + w * cz) * ray.shear[2] / determinant;
        // A comparison with NaN (no area, or seen from the side) fails.
        let met = inside & distance.simd_gt(zero) & distance.simd_lt(f32x8::splat(simd, reach));
        let lanes = met.to_bitmask();
        (lanes != 0).then_some(Met { lanes, weights: [u, v, w], determinant, distance })
    }

    /// Whether any triangle lies within reach.
    #[inline(always)]
    pub fn blocks<S: Simd>(&self, simd: S, ray: &ShearedRay<S>, reach: f32) -> bool {
        self.meet(simd, ray, reach).is_some()
    }

    /// The nearest triangle within reach.
    #[inline(always)]
    pub fn nearest<S: Simd>(&self, simd: S, ray: &ShearedRay<S>, reach: f32) -> Option<Hit> {
        let Met { mut lanes, weights: [u, v, w], determinant, distance } = self.meet(simd, ray, reach)?;
        let distance = distance.to_array();
        let mut nearest = (lanes.trailing_zeros() & 7) as usize;
        lanes &= lanes - 1;
        while lanes != 0 {
            let lane = (lanes.trailing_zeros() & 7) as usize;
            lanes &= lanes - 1;
            if distance[lane] < distance[nearest] {
                nearest = lane;
            }
        }
        let [u, v, w, determinant] = [u, v, w, determinant].map(|lanes| lanes.to_array()[nearest]);
        Some(Hit {
            distance: distance[nearest],
            triangle: self.triangles[nearest],
            barycentrics: Vec3::new(u, v, w) / determinant,
        })
    }
}
