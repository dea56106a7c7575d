//! Rays against triangles: a tree of boxes with eight children per node, and triangles in packets of eight.
//!
//! The tree is built by parallel locally-ordered clustering (D. Meister and J. Bittner, *Parallel Locally-Ordered Clustering
//! for Bounding Volume Hierarchy Construction*, TVCG 2018; the crate `obvhs`), then two of three levels are left out. Eight
//! boxes and eight triangles are tested at once (I. Wald, C. Benthin and S. Boulos, *Getting Rid of Packets*, 2008).

mod build;
mod packet;
mod stack;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};
use glam::{Vec3, Vec4};
use gonio_environment::simd::{Kernel, SimdLevel};
use packet::{Packet, ShearedRay};
use stack::Stack;

/// A ray with its nearest hit so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: Vec3,
    /// Unit.
    pub direction: Vec3,
    /// Nothing beyond this distance counts.
    pub reach: f32,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub distance: f32,
    /// Index of the triangle.
    pub triangle: u32,
    /// Weights of the triangle's corners.
    pub barycentrics: Vec3,
}

/// The tree.
#[derive(Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
    level: SimdLevel,
}

/// Eight boxes, and what is in each.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Node {
    /// The least and the largest coordinates, by axis.
    bounds: [[[f32; 8]; 2]; 3],
    /// An inner node's index, or [`LEAF`] and a packet's index. Where there is no child no ray meets the box.
    children: [u32; 8],
}

const LEAF: u32 = 1 << 31;

impl Default for Tree {
    fn default() -> Self {
        Tree { nodes: Vec::new(), packets: Vec::new(), level: SimdLevel::detect() }
    }
}

impl Tree {
    /// The nearest triangle in front of the ray's origin.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.level.run(Nearest { tree: self, ray })
    }

    /// Whether any triangle lies in the ray's reach.
    pub fn is_blocked(&self, ray: &Ray) -> bool {
        self.level.run(IsBlocked { tree: self, ray })
    }

    /// Hands over packets that may have a hit within reach, which is what `meet` returned for the last; ends where it returns
    /// none. `SORTED`: near ones first.
    #[inline(always)]
    fn visit<const SORTED: bool, S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        mut meet: impl FnMut(&Packet, &ShearedRay<S>, f32) -> Option<f32>,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let inverse = inverse(ray.direction);
        let slabs = Slabs::new(simd, ray, &inverse);
        let sheared = ShearedRay::new(simd, ray, &inverse);
        let mut reach = ray.reach;
        let mut stack = Stack::new();
        let mut child = 0;
        loop {
            if child & LEAF != 0 {
                match meet(&self.packets[(child & !LEAF) as usize], &sheared, reach) {
                    Some(nearer) => reach = nearer,
                    None => return,
                }
            } else {
                let node = &self.nodes[child as usize];
                let (entries, mut bits) = slabs.entries(simd, node, reach);
                if bits.is_power_of_two() {
                    child = node.children[(bits.trailing_zeros() & 7) as usize];
                    continue;
                }
                // Farther children go below nearer ones: an insertion sort of at most eight.
                let bottom = stack.len();
                while bits != 0 {
                    let lane = (bits.trailing_zeros() & 7) as usize;
                    bits &= bits - 1;
                    stack.insert::<SORTED>(bottom, entries[lane], node.children[lane]);
                }
            }
            child = loop {
                let Some((entry, next)) = stack.pop() else { return };
                if !SORTED || entry <= reach {
                    break next;
                }
            };
        }
    }
}

struct Nearest<'t> {
    tree: &'t Tree,
    ray: &'t Ray,
}

impl Kernel for Nearest<'_> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Hit> {
        let mut hit = None;
        self.tree.visit::<true, S>(
            simd,
            self.ray,
            #[inline(always)]
            |packet, sheared, reach| {
                let Some(found) = packet.nearest(simd, sheared, reach) else { return Some(reach) };
                hit = Some(found);
                Some(found.distance)
            },
        );
        hit
    }
}

struct IsBlocked<'t> {
    tree: &'t Tree,
    ray: &'t Ray,
}

impl Kernel for IsBlocked<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let mut blocked = false;
        self.tree.visit::<false, S>(
            simd,
            self.ray,
            #[inline(always)]
            |packet, sheared, reach| {
                blocked = packet.blocks(simd, sheared, reach);
                (!blocked).then_some(reach)
            },
        );
        blocked
    }
}

impl Node {
    /// Boxes that no ray meets.
    const EMPTY: Node = Node { bounds: [[[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]]; 3], children: [0; 8] };
}

/// A ray, prepared for boxes: the places where it crosses the planes of their sides.
struct Slabs<S: Simd> {
    origin: [f32x8<S>; 3],
    inverse: [f32x8<S>; 3],
    /// The same, a little larger, so that no box is missed by rounding (T. Ize, *Robust BVH Ray Traversal*, JCGT 2(2),
    /// 2013).
    inverse_out: [f32x8<S>; 3],
    /// 1 where the direction's component is negative, else 0.
    negative: [usize; 3],
}

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray, &[x, y, z, _]: &[f32; 4]) -> Self {
        let splat = |v: f32| f32x8::splat(simd, v);
        let out = |v: f32| splat(v * (1.0 + 4.0 * f32::EPSILON));
        Slabs {
            origin: [splat(ray.origin.x), splat(ray.origin.y), splat(ray.origin.z)],
            inverse: [splat(x), splat(y), splat(z)],
            inverse_out: [out(x), out(y), out(z)],
            negative: [usize::from(x < 0.0), usize::from(y < 0.0), usize::from(z < 0.0)],
        }
    }

    /// The distances at which the ray enters the boxes, and a bit for each box that it meets within `reach`.
    #[inline(always)]
    fn entries(&self, simd: S, node: &Node, reach: f32) -> ([f32; 8], u64) {
        let (mut from, mut to) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, reach));
        for axis in 0..3 {
            // Looked up, because a branch would often be predicted wrongly.
            let near = f32x8::load_array_ref(simd, &node.bounds[axis][self.negative[axis] & 1]);
            let far = f32x8::load_array_ref(simd, &node.bounds[axis][self.negative[axis] & 1 ^ 1]);
            from = ((near - self.origin[axis]) * self.inverse[axis]).max(from);
            to = ((far - self.origin[axis]) * self.inverse_out[axis]).min(to);
        }
        (from.to_array(), from.simd_le(to).to_bitmask())
    }
}

/// Components of directions count as at least this large: over the length of the scene, 1, rays miss by less than a rounding.
const LEAST_COMPONENT: f32 = 1e-30;

/// The reciprocals of a direction's components, in the first three places. Never infinite: 0 times infinity, for a ray in a
/// side of a box, would not be a number.
#[inline(always)]
fn inverse(direction: Vec3) -> [f32; 4] {
    let direction = direction.extend(1.0);
    (Vec4::ONE / direction.abs().max(Vec4::splat(LEAST_COMPONENT)).copysign(direction)).to_array()
}

#[cfg(test)]
mod tests;
