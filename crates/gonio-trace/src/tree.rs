//! Rays against triangles: a tree of boxes with four children per node, and triangles in packets of four.
//!
//! The tree is built by parallel locally-ordered clustering (D. Meister and J. Bittner, *Parallel Locally-Ordered Clustering
//! for Bounding Volume Hierarchy Construction*, TVCG 2018; the crate `obvhs`), then every other level is left out. Four
//! boxes and four triangles are tested at once. The triangle test lets no ray pass between triangles that share an edge
//! (S. Woop, C. Benthin, I. Wald, *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013): edges belong to both.

use glam::{Vec3, Vec3A, Vec4};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

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
#[derive(Debug, Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The least and the largest coordinates, by axis.
    bounds: [[Vec4; 2]; 3],
    /// An inner node's index; or [`LEAF`], a bit for a second packet, and the index of the first packet; [`EMPTY`] where
    /// there is no child.
    children: [u32; 4],
}

const LEAF: u32 = 1 << 31;
const SECOND_PACKET: u32 = 1 << 30;
const EMPTY: u32 = u32::MAX;
/// The axes after each axis, in turn and in reverse.
const AXES: [[usize; 2]; 6] = [[1, 2], [2, 1], [2, 0], [0, 2], [0, 1], [1, 0]];
/// Triangles per leaf, at most: two packets.
const MOST_IN_LEAF: u32 = 8;

/// Four triangles: x, y and z of each corner. Unused places repeat the first triangle.
#[derive(Clone, Copy, Debug)]
struct Packet {
    corners: [[Vec4; 3]; 3],
    triangles: [u32; 4],
}

impl Tree {
    /// `corners`: of each triangle; all finite.
    pub fn new(corners: &[[Vec3; 3]]) -> Self {
        if corners.is_empty() {
            return Tree::default();
        }
        let boxes: Vec<Aabb> = corners
            .iter()
            .map(|&[a, b, c]| Aabb { min: Vec3A::from(a.min(b).min(c)), max: Vec3A::from(a.max(b).max(c)) })
            .collect();
        let indices = (0..corners.len() as u32).collect();
        let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
            PlocSearchDistance::Low,
            &boxes,
            indices,
            SortPrecision::U64,
            1,
        );
        collapse(&mut bvh, MOST_IN_LEAF, 1.0);
        let mut tree = Tree { nodes: Vec::with_capacity(bvh.nodes.len() / 2 + 1), packets: Vec::new() };
        tree.add_node(&bvh, corners);
        tree
    }

    /// Adds the tree below the root of `bvh`, without recursion: a tree of equal boxes may be deep.
    fn add_node(&mut self, bvh: &Bvh2, corners: &[[Vec3; 3]]) {
        // A node to fill, and the nodes of `bvh` below it.
        let mut todo = vec![(0, first_children(bvh))];
        self.nodes.push(Node::EMPTY);
        while let Some((index, mut children)) = todo.pop() {
            while children.len() < 4 {
                let largest = children
                    .iter()
                    .enumerate()
                    .filter(|(_, child)| !child.is_leaf())
                    .max_by(|(_, a), (_, b)| a.aabb().half_area().total_cmp(&b.aabb().half_area()))
                    .map(|(i, _)| i);
                let Some(largest) = largest else { break };
                let first = children.swap_remove(largest).first_index as usize;
                children.extend([bvh.nodes[first], bvh.nodes[first + 1]]);
            }
            for (lane, child) in children.iter().enumerate() {
                let aabb = child.aabb();
                for axis in 0..3 {
                    self.nodes[index].bounds[axis][0][lane] = aabb.min[axis];
                    self.nodes[index].bounds[axis][1][lane] = aabb.max[axis];
                }
                if child.is_leaf() {
                    let first = child.first_index as usize;
                    let triangles = &bvh.primitive_indices[first..first + child.prim_count as usize];
                    let second = if triangles.len() > 4 { SECOND_PACKET } else { 0 };
                    self.nodes[index].children[lane] = LEAF | second | self.packets.len() as u32;
                    self.packets.extend(triangles.chunks(4).map(|four| Packet::new(four, corners)));
                } else {
                    let inner = self.nodes.len();
                    self.nodes[index].children[lane] = inner as u32;
                    self.nodes.push(Node::EMPTY);
                    let first = child.first_index as usize;
                    todo.push((inner, vec![bvh.nodes[first], bvh.nodes[first + 1]]));
                }
            }
        }
    }

    /// The nearest triangle in front of the ray's origin.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut hit = None;
        self.visit::<true>(ray, |packet, line, reach| {
            let Some(found) = packet.nearest(line, reach) else { return Some(reach) };
            hit = Some(found);
            Some(found.distance)
        });
        hit
    }

    /// Whether any triangle lies in the ray's reach.
    pub fn is_blocked(&self, ray: &Ray) -> bool {
        let mut blocked = false;
        self.visit::<false>(ray, |packet, line, reach| {
            blocked = packet.blocks(line, reach);
            (!blocked).then_some(reach)
        });
        blocked
    }

    /// Hands over packets that may have a hit within reach, which is what `meet` returned for the last; ends where it returns
    /// none. `SORTED`: near ones first.
    #[inline(always)]
    fn visit<const SORTED: bool>(&self, ray: &Ray, mut meet: impl FnMut(&Packet, &Line, f32) -> Option<f32>) {
        if self.nodes.is_empty() {
            return;
        }
        let line = Line::new(ray);
        let mut reach = ray.reach;
        let mut stack = Stack::new();
        stack.insert::<SORTED>(0, 0.0, 0);
        while let Some((entry, child)) = stack.pop() {
            if SORTED && entry > reach {
                continue;
            }
            if child & LEAF != 0 {
                let first = (child & !(LEAF | SECOND_PACKET)) as usize;
                let end = first + 1 + usize::from(child & SECOND_PACKET != 0);
                for packet in &self.packets[first..end] {
                    match meet(packet, &line, reach) {
                        Some(nearer) => reach = nearer,
                        None => return,
                    }
                }
                continue;
            }
            let node = &self.nodes[child as usize];
            let (entries, mut bits) = node.entries(&line, reach);
            if bits == 0 {
                continue;
            }
            // Farther children go below nearer ones: an insertion sort of at most four.
            let bottom = stack.length;
            while bits != 0 {
                let lane = (bits.trailing_zeros() & 3) as usize;
                bits &= bits - 1;
                if node.children[lane] != EMPTY {
                    stack.insert::<SORTED>(bottom, entries[lane], node.children[lane]);
                }
            }
        }
    }
}

/// The nodes below the root; the root itself where it is a leaf.
fn first_children(bvh: &Bvh2) -> Vec<Bvh2Node> {
    let root = bvh.nodes[0];
    if root.is_leaf() {
        vec![root]
    } else {
        let first = root.first_index as usize;
        vec![bvh.nodes[first], bvh.nodes[first + 1]]
    }
}

/// Nodes to visit, with the distance at which the ray enters them.
struct Stack {
    /// The distance's bits above the child's: distances are not negative, so their order is that of the integers.
    entries: [u64; Stack::SIZE],
    length: usize,
    /// What does not fit: only for trees of thousands of equal boxes.
    rest: Vec<u64>,
}

impl Stack {
    const SIZE: usize = 32;

    #[inline(always)]
    fn new() -> Self {
        Stack { entries: [0; Stack::SIZE], length: 0, rest: Vec::new() }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<(f32, u32)> {
        let top = if self.rest.is_empty() {
            self.length = self.length.checked_sub(1)?;
            self.entries[self.length]
        } else {
            self.rest.pop()?
        };
        Some((f32::from_bits((top >> 32) as u32), top as u32))
    }

    /// Pushes, `SORTED` between the entries from `bottom` on, which are sorted from far to near.
    #[inline(always)]
    fn insert<const SORTED: bool>(&mut self, bottom: usize, entry: f32, child: u32) {
        let packed = u64::from(entry.to_bits()) << 32 | u64::from(child);
        if self.length == Stack::SIZE || !self.rest.is_empty() {
            self.rest.push(packed);
            return;
        }
        let mut at = self.length;
        self.length += 1;
        while SORTED && at > bottom && self.entries[at - 1] < packed {
            self.entries[at] = self.entries[at - 1];
            at -= 1;
        }
        self.entries[at] = packed;
    }
}

impl Node {
    /// Boxes that no ray meets.
    const EMPTY: Node = Node { bounds: [[Vec4::INFINITY, Vec4::NEG_INFINITY]; 3], children: [EMPTY; 4] };

    /// The distances at which the ray enters the boxes, and a bit for each box that it meets within `reach`.
    #[inline]
    fn entries(&self, line: &Line, reach: f32) -> ([f32; 4], u32) {
        let (mut from, mut to) = (Vec4::ZERO, Vec4::splat(reach));
        for axis in 0..3 {
            // Looked up, because a branch would often be predicted wrongly.
            let near = self.bounds[axis][line.negative[axis] & 1];
            let far = self.bounds[axis][line.negative[axis] & 1 ^ 1];
            // In this order a NaN (0 times infinity: the ray lies in a side of the box) leaves the interval as it is.
            from = ((near - line.box_origin[axis]) * line.inverse[axis]).max(from);
            to = ((far - line.box_origin[axis]) * line.inverse_out[axis]).min(to);
        }
        // An index into a vector would be a jump.
        (from.to_array(), from.cmple(to).bitmask())
    }
}

/// A ray, prepared.
struct Line {
    box_origin: [Vec4; 3],
    inverse: [Vec4; 3],
    /// The same, a little larger, so that no box is missed by rounding (T. Ize, *Robust BVH Ray Traversal*, JCGT 2(2),
    /// 2013).
    inverse_out: [Vec4; 3],
    /// 1 where the direction's component is negative, else 0.
    negative: [usize; 3],
    /// The axes, the direction's largest component last.
    axes: [usize; 3],
    shear: [Vec4; 3],
    origin: [Vec4; 3],
}

impl Line {
    #[inline]
    fn new(ray: &Ray) -> Self {
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        // Without branches, which rays would take in no order.
        let size = ray.direction.abs();
        let z = if size.z > size.x.max(size.y) { 2 } else { usize::from(size.y > size.x) };
        let [x, y] = AXES[2 * z + usize::from(d[z] < 0.0)];
        let inverse = (Vec4::ONE / ray.direction.extend(1.0)).to_array();
        Line {
            box_origin: [0, 1, 2].map(|i| Vec4::splat(o[i])),
            inverse: [0, 1, 2].map(|i| Vec4::splat(inverse[i])),
            inverse_out: [0, 1, 2].map(|i| Vec4::splat(inverse[i] * (1.0 + 4.0 * f32::EPSILON))),
            negative: [0, 1, 2].map(|i| usize::from(inverse[i] < 0.0)),
            axes: [x, y, z],
            shear: [d[x] * inverse[z], d[y] * inverse[z], inverse[z]].map(Vec4::splat),
            origin: [x, y, z].map(|i| Vec4::splat(o[i])),
        }
    }
}

impl Packet {
    fn new(triangles: &[u32], corners: &[[Vec3; 3]]) -> Self {
        let triangles = std::array::from_fn(|lane| triangles[if lane < triangles.len() { lane } else { 0 }]);
        let corner = |c: usize, axis: usize| Vec4::from(triangles.map(|t: u32| corners[t as usize][c][axis]));
        let corners = std::array::from_fn(|c| std::array::from_fn(|axis| corner(c, axis)));
        Packet { corners, triangles }
    }

    /// The triangles that the line meets, as bits, with the weights of their corners before normalisation, and the distances.
    #[inline(always)]
    fn meet(&self, line: &Line, reach: f32) -> Option<(u32, [Vec4; 4], Vec4)> {
        let [kx, ky, kz] = line.axes;
        let [sx, sy, sz] = line.shear;
        let [ox, oy, oz] = line.origin;
        let sheared = |c: &[Vec4; 3]| {
            let z = c[kz] - oz;
            (c[kx] - ox - sx * z, c[ky] - oy - sy * z, z)
        };
        let (ax, ay, az) = sheared(&self.corners[0]);
        let (bx, by, bz) = sheared(&self.corners[1]);
        let (cx, cy, cz) = sheared(&self.corners[2]);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let all_positive = u.min(v).min(w).cmpge(Vec4::ZERO);
        let all_negative = u.max(v).max(w).cmple(Vec4::ZERO);
        let inside = all_positive | all_negative;
        if !inside.any() {
            return None;
        }
        let determinant = u + v + w;
        let distance = (u * az + v * bz + w * cz) * sz / determinant;
        // A comparison with NaN (no area, or seen from the side) fails.
        let met = (inside & distance.cmpgt(Vec4::ZERO) & distance.cmplt(Vec4::splat(reach))).bitmask();
        (met != 0).then_some((met, [u, v, w, determinant], distance))
    }

    /// Whether any triangle lies within reach.
    #[inline]
    fn blocks(&self, line: &Line, reach: f32) -> bool {
        self.meet(line, reach).is_some()
    }

    #[inline]
    fn nearest(&self, line: &Line, reach: f32) -> Option<Hit> {
        let (mut met, [u, v, w, determinant], distance) = self.meet(line, reach)?;
        let distance = distance.to_array();
        let mut nearest = (met.trailing_zeros() & 3) as usize;
        met &= met - 1;
        while met != 0 {
            let lane = (met.trailing_zeros() & 3) as usize;
            met &= met - 1;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;

    /// Small triangles everywhere in the unit cube, and a few large ones.
    fn cloud(count: u32) -> Vec<[Vec3; 3]> {
        (0..count)
            .map(|i| {
                let mut random = Sampler::new(5, i, 0);
                let mut point = || random.next_2d().extend(random.next_1d());
                let (center, size) = (point(), if i % 50 == 0 { 0.5 } else { 0.05 });
                [0, 1, 2].map(|_| center + size * (point() - 0.5))
            })
            .collect()
    }

    fn brute_force(corners: &[[Vec3; 3]], ray: &Ray) -> Option<Hit> {
        let line = Line::new(ray);
        let hits = (0..corners.len() as u32).filter_map(|i| Packet::new(&[i], corners).nearest(&line, ray.reach));
        hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    #[test]
    fn the_tree_loses_no_triangle() {
        let corners = cloud(3000);
        let tree = Tree::new(&corners);
        let mut hits = 0;
        for i in 0..2000 {
            let mut random = Sampler::new(9, i, 0);
            let mut point = || random.next_2d().extend(random.next_1d());
            let (origin, target) = (point() * 2.0 - 0.5, point());
            let mut direction = (target - origin).normalize();
            if i % 4 == 0 {
                direction = [Vec3::X, Vec3::Y, Vec3::Z][i as usize / 4 % 3] * if i % 8 == 0 { 1.0 } else { -1.0 };
            }
            let reach = if i % 3 == 0 { 0.3 } else { f32::INFINITY };
            let ray = Ray { origin, direction, reach };
            let expected = brute_force(&corners, &ray);
            assert_eq!(tree.nearest(&ray).map(|h| h.distance), expected.map(|h| h.distance), "ray {i}");
            assert_eq!(tree.is_blocked(&ray), expected.is_some(), "ray {i}");
            hits += u32::from(expected.is_some());
        }
        assert!(hits > 500, "{hits}");
    }

    /// From inside, every ray meets a closed body: here a sphere of 8 to 8,000 triangles that share their corners.
    #[test]
    fn no_ray_leaves_a_closed_body() {
        for rings in [2_usize, 9, 60] {
            let corner = |ring: usize, slice: usize| {
                let (polar, turn) = (ring as f32 / rings as f32, (slice % (2 * rings)) as f32 / (2 * rings) as f32);
                crate::sampling::from_polar((std::f32::consts::PI * polar).cos(), turn)
            };
            let mut corners = Vec::new();
            for ring in 0..rings {
                for slice in 0..2 * rings {
                    let (a, b) = (corner(ring, slice), corner(ring, slice + 1));
                    let (c, d) = (corner(ring + 1, slice), corner(ring + 1, slice + 1));
                    corners.extend([[a, c, b], [b, c, d]]);
                }
            }
            let tree = Tree::new(&corners);
            for i in 0..20_000 {
                let mut random = Sampler::new(2, i, 0);
                let origin = 0.4 * (random.next_2d().extend(random.next_1d()) - 0.5);
                // Towards corners and edges too, where a ray passes between triangles if it can.
                let target = match i % 3 {
                    0 => corners[i as usize % corners.len()][0],
                    1 => corners[i as usize % corners.len()][0]
                        .lerp(corners[i as usize % corners.len()][1], random.next_1d()),
                    _ => crate::sampling::from_polar(2.0 * random.next_1d() - 1.0, random.next_1d()),
                };
                let direction = (target - origin).normalize();
                assert!(
                    tree.nearest(&Ray { origin, direction, reach: f32::INFINITY }).is_some(),
                    "{rings} rings: ray {i} from {origin} along {direction}"
                );
            }
        }
    }

    #[test]
    fn places_and_weights_are_those_of_the_hit() {
        let corners = vec![[Vec3::new(-1.0, -1.0, 2.0), Vec3::new(3.0, -1.0, 4.0), Vec3::new(-1.0, 2.0, 3.0)]];
        let weights = Vec3::new(0.2, 0.3, 0.5);
        let target = corners[0][0] * weights.x + corners[0][1] * weights.y + corners[0][2] * weights.z;
        let ray = Ray { origin: Vec3::ZERO, direction: target.normalize(), reach: f32::INFINITY };
        let hit = Tree::new(&corners).nearest(&ray).expect("inside");
        // A few roundings in f32.
        assert!(
            (hit.distance - target.length()).abs() < 1e-5 && (hit.barycentrics - weights).abs().max_element() < 1e-6
        );
        assert_eq!(hit.triangle, 0);
    }

    #[test]
    fn thousands_of_equal_triangles_are_no_trouble() {
        let corners = vec![[Vec3::ZERO, Vec3::X, Vec3::Y]; 20_000];
        let tree = Tree::new(&corners);
        let ray = Ray { origin: Vec3::new(0.2, 0.2, 1.0), direction: -Vec3::Z, reach: f32::INFINITY };
        assert!(tree.nearest(&ray).is_some_and(|hit| hit.distance == 1.0));
        assert!(Tree::new(&[]).nearest(&ray).is_none());
        let flat = vec![[Vec3::ZERO, Vec3::X, Vec3::X * 2.0]];
        assert!(Tree::new(&flat).nearest(&ray).is_none());
    }
}
