//! The triangles that the rays of one block of pixels see. All rays of a block go through the tree of boxes together.
//!
//! All rays start at the eye, so those of a block of pixels fill a narrow pyramid. A box outside of the pyramid, or
//! behind what already covers the whole block, is passed over for all rays at once; the triangles that are left are
//! tested ray by ray. The result is that of tracing each ray alone: the nearest triangle, and of equally near ones
//! the first that is drawn.

use crate::geometry::{Tree, Triangle, WorldGeometry};
use crate::intersect::{Crossing, EyeSpace, RaySpace, cross};
use glam::{DVec2, DVec3};
use obvhs::bvh2::node::Bvh2Node;

/// Stands for "no triangle".
pub(crate) const NOTHING: u32 = u32::MAX;

/// A block of pixels: columns `x0..x1`, rows `y0..y1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Block {
    pub x0: u32,
    pub y0: u32,
    pub x1: u32,
    pub y1: u32,
}

impl Block {
    fn width(&self) -> usize {
        (self.x1 - self.x0) as usize
    }

    fn pixel_count(&self) -> usize {
        self.width() * (self.y1 - self.y0) as usize
    }
}

/// A triangle that a ray passes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layer {
    /// Index of the ray: pixel by pixel in rows, sample by sample.
    pub ray: u32,
    /// Index into the triangles.
    pub triangle: u32,
    /// Along the viewing direction.
    pub depth: f64,
}

/// The triangles that each ray of a block sees. Reused between blocks for its memory.
#[derive(Default)]
pub(crate) struct Visible {
    /// The rays (`sx`, `sy`).
    pub rays: Vec<DVec2>,
    /// Depth of the nearest opaque triangle, infinite where there is none.
    depths: Vec<f64>,
    /// The nearest opaque triangle, or [`NOTHING`].
    pub opaque: Vec<u32>,
    /// Perhaps transparent triangles in front of the opaque one: sorted by ray, then from front to back.
    pub layers: Vec<Layer>,
    stack: Vec<(f64, u32)>,
}

/// The pyramid of a block, in the space of the tree's boxes.
struct Pyramid {
    eye: DVec3,
    /// Inward normals of the four sides.
    sides: [DVec3; 4],
    front: DVec3,
    near: f64,
    far: f64,
    /// The margin added to every box, larger than the rounding errors.
    slack: f64,
}

impl Pyramid {
    /// Nearest depth of the box, in the tree's units, or `None` where it is outside.
    fn entry(&self, node: &Bvh2Node, farthest: f64) -> Option<f64> {
        let aabb = node.aabb();
        let (low, high) = (aabb.min.as_dvec3(), aabb.max.as_dvec3());
        let center = 0.5 * (low + high) - self.eye;
        let half = 0.5 * (high - low) + DVec3::splat(self.slack);
        let depth = self.front.dot(center);
        let reach = self.front.abs().dot(half);
        if depth + reach < self.near || depth - reach > farthest.min(self.far) {
            return None;
        }
        let outside = self.sides.iter().any(|side| side.dot(center) + side.abs().dot(half) < 0.0);
        (!outside).then_some(depth - reach)
    }
}

impl Visible {
    /// Traces the rays through `positions` (in each pixel) of all pixels of `block`.
    pub fn trace(&mut self, geometry: &WorldGeometry, eye: &EyeSpace, positions: &[[f64; 2]], block: Block) {
        self.rays.clear();
        for y in block.y0..block.y1 {
            for x in block.x0..block.x1 {
                let corner = DVec2::new(f64::from(x), f64::from(y));
                self.rays.extend(positions.iter().map(|&p| eye.ray(corner + DVec2::from(p))));
            }
        }
        let count = block.pixel_count() * positions.len();
        self.depths.clear();
        self.depths.resize(count, f64::INFINITY);
        self.opaque.clear();
        self.opaque.resize(count, NOTHING);
        self.layers.clear();
        if let Some(tree) = &geometry.tree {
            self.descend(tree, geometry, eye, positions.len(), block);
        }
        let depths = &self.depths;
        let opaque = &self.opaque;
        self.layers.retain(|layer| {
            let behind = (depths[layer.ray as usize], opaque[layer.ray as usize]);
            (layer.depth, layer.triangle) < behind
        });
        self.layers.sort_by(|a, b| {
            (a.ray, a.depth, a.triangle).partial_cmp(&(b.ray, b.depth, b.triangle)).unwrap_or(std::cmp::Ordering::Equal)
        });
    }

    fn pyramid(&self, tree: &Tree, eye: &EyeSpace) -> Option<Pyramid> {
        let first = *self.rays.first()?;
        let (low, high) = self.rays.iter().fold((first, first), |(low, high), r| (low.min(*r), high.max(*r)));
        let camera = &eye.camera;
        let (right, up, front) = (camera.right, camera.up, camera.front);
        let eye_in_box = (camera.position - tree.center) * tree.scale;
        Some(Pyramid {
            eye: eye_in_box,
            sides: [right - low.x * front, high.x * front - right, up - low.y * front, high.y * front - up],
            front,
            near: camera.near * tree.scale,
            far: camera.far * tree.scale,
            slack: 1e-12 * (1.0 + eye_in_box.abs().max_element()),
        })
    }

    fn descend(&mut self, tree: &Tree, geometry: &WorldGeometry, eye: &EyeSpace, per_pixel: usize, block: Block) {
        let Some(pyramid) = self.pyramid(tree, eye) else { return };
        let nodes = &tree.bvh.nodes;
        let Some(root) = nodes.first() else { return };
        let mut farthest = f64::INFINITY;
        let mut stack = std::mem::take(&mut self.stack);
        stack.clear();
        if let Some(entry) = pyramid.entry(root, farthest) {
            stack.push((entry, 0));
        }
        while let Some((entry, index)) = stack.pop() {
            if entry > farthest {
                continue;
            }
            let node = &nodes[index as usize];
            if node.is_leaf() {
                let first = node.first_index as usize;
                let mut covered = false;
                for &id in &tree.bvh.primitive_indices[first..first + node.prim_count as usize] {
                    covered |= self.test(id, &geometry.triangles[id as usize], eye, per_pixel, block);
                }
                if covered {
                    // Grown a little, as the boxes are.
                    let deepest = self.depths.iter().fold(0.0, |d: f64, &e| d.max(e)) * tree.scale;
                    farthest = deepest + pyramid.slack;
                }
            } else {
                let left = node.first_index;
                let entries = [left, left + 1].map(|child| (pyramid.entry(&nodes[child as usize], farthest), child));
                match entries {
                    [(Some(a), l), (Some(b), r)] => {
                        let (near, far) = if a <= b { ((a, l), (b, r)) } else { ((b, r), (a, l)) };
                        stack.push(far);
                        stack.push(near);
                    }
                    [(Some(a), l), (None, _)] => stack.push((a, l)),
                    [(None, _), (Some(b), r)] => stack.push((b, r)),
                    _ => {}
                }
            }
        }
        self.stack = stack;
    }

    /// One triangle against the rays that it may cover; whether an opaque depth changed.
    fn test(&mut self, id: u32, triangle: &Triangle, eye: &EyeSpace, per_pixel: usize, block: Block) -> bool {
        let corners = eye.corners(triangle.vertices);
        let Some(bounds) = pixels_of(&corners, eye, block) else { return false };
        let (near, far) = (eye.camera.near, eye.camera.far);
        let mut changed = false;
        for y in bounds.y0..bounds.y1 {
            let row = (y - block.y0) as usize * block.width();
            let first = (row + (bounds.x0 - block.x0) as usize) * per_pixel;
            let last = (row + (bounds.x1 - block.x0) as usize) * per_pixel;
            for ray in first..last {
                let Some(Crossing { depth, counter_clockwise, .. }) = cross(&corners, self.rays[ray]) else { continue };
                let front = counter_clockwise != triangle.mirrored;
                // Written so that a depth that is not a number is no hit.
                let within = depth >= near && depth <= far;
                if !within || (triangle.closed && !front) {
                    continue;
                }
                if triangle.transparent {
                    self.layers.push(Layer { ray: ray as u32, triangle: id, depth });
                } else if (depth, id) < (self.depths[ray], self.opaque[ray]) {
                    self.depths[ray] = depth;
                    self.opaque[ray] = id;
                    changed = true;
                }
            }
        }
        changed
    }
}

/// The pixels of `block` that a triangle may cover: grown by a hundred-thousandth of a pixel, which is far more than
/// rounding. `None`: none of them.
fn pixels_of(corners: &[DVec3; 3], eye: &EyeSpace, block: Block) -> Option<Block> {
    // A corner at or behind the eye has no place in the picture.
    let nearest = corners[0].z.min(corners[1].z).min(corners[2].z);
    let farthest = corners[0].z.max(corners[1].z).max(corners[2].z);
    if farthest < eye.camera.near {
        return None;
    }
    if nearest < 1e-3 * eye.camera.near {
        return Some(block);
    }
    let [a, b, c] = corners.map(|p| eye.pixel(DVec2::new(p.x / p.z, p.y / p.z)));
    let low = a.min(b).min(c) - 1e-5;
    let high = a.max(b).max(c) + 1e-5;
    // Casts to u32 saturate.
    let bounds = Block {
        x0: block.x0.max(low.x.floor() as u32),
        y0: block.y0.max(low.y.floor() as u32),
        x1: block.x1.min((high.x.floor() + 1.0) as u32),
        y1: block.y1.min((high.y.floor() + 1.0) as u32),
    };
    (bounds.x0 < bounds.x1 && bounds.y0 < bounds.y1).then_some(bounds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::Camera;

    /// The order in which the tree meets them does not matter.
    #[test]
    fn the_first_drawn_of_equally_near_triangles_wins() {
        let camera = Camera::looking_along(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 0.1, 10.0);
        let eye = EyeSpace {
            camera,
            half_extent: DVec2::ONE,
            size: DVec2::ONE,
            sample_width: 1.0,
            positions: vec![DVec3::new(-9.0, -9.0, 2.0), DVec3::new(9.0, -9.0, 2.0), DVec3::new(0.0, 9.0, 2.0)],
        };
        let triangle = Triangle {
            vertices: [0, 1, 2],
            object: 0,
            part: 0,
            material: 0,
            in_mesh: 0,
            transparent: false,
            closed: false,
            mirrored: false,
        };
        let block = Block { x0: 0, y0: 0, x1: 1, y1: 1 };
        for order in [[3, 5, 8], [8, 5, 3], [5, 3, 8]] {
            let mut visible = Visible {
                rays: vec![DVec2::ZERO],
                depths: vec![f64::INFINITY],
                opaque: vec![NOTHING],
                ..Visible::default()
            };
            for id in order {
                visible.test(id, &triangle, &eye, 1, block);
            }
            assert_eq!((visible.opaque[0], visible.depths[0]), (3, 2.0), "{order:?}");
        }
    }
}
