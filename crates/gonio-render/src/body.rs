//! An object's own triangles as a tree of boxes, for a shader that follows rays through the object, and their upload as a
//! float texture.
//!
//! The tree is a list of nodes in the order of a walk from the left: next to an inner node is its left child, and every
//! node has the index of the node to continue with if the ray misses its box. A shader then needs no stack.
//!
//! Everything is in *body space*: the world moved and scaled, not turned, so that the object is around the origin and
//! its diagonal is 1. The precision of f32 then does not depend on the place and size of the object.

use crate::glsl::BODY_ROW;
use glam::{DVec3, Vec3};
use gonio_gl::objects::TextureObject;
use gonio_gl::program::Program;
use gonio_gl::{Gl, GlError, Texels};
use gonio_light::{Optics, vector};
use gonio_mesh::Mesh;
use gonio_scene::Object;

/// Most triangles of a leaf.
const LEAF: usize = 4;
/// The factor of a leaf's first triangle, which leaves room for their number.
pub const LEAF_STEP: usize = 8;
/// Most triangles: numbers up to 2^24 are exact in f32.
pub const MOST_TRIANGLES: usize = (1 << 24) / LEAF_STEP;
/// The number of candidates for a cut along an axis.
const BINS: usize = 16;
/// Below this depth triangles are split into halves regardless of cost, so that the depth is bounded.
const DEEP: usize = 40;

/// The tree and its triangles as texels of four floats.
///
/// Nodes come first, two texels each: the least corner of the box and the node to continue with if it is missed; the greatest
/// corner and, for a leaf, `LEAF_STEP` times its first triangle plus their number (0 for an inner node). Then the corners
/// of the triangles, three texels each, counter-clockwise from outside; then their normals, as many.
pub struct BodyTable {
    /// All texels.
    pub texels: Vec<[f32; 4]>,
    /// The number of nodes.
    pub nodes: usize,
    /// The first texel of the corners.
    pub corners: usize,
    /// The first texel of the normals.
    pub normals: usize,
    /// The middle of body space, in the world.
    pub center: DVec3,
    /// Units of body space to a world unit.
    pub scale: f64,
}

/// One triangle in body space.
#[derive(Clone, Copy)]
struct Triangle {
    corners: [Vec3; 3],
    normals: [Vec3; 3],
}

impl BodyTable {
    /// Builds the tree of an object's triangles, with their own normals if `flat`, otherwise those of the corners. `None` without
    /// triangles, or with more than [`MOST_TRIANGLES`].
    pub fn new(mesh: &Mesh, object: &Object, flat: bool) -> Option<Self> {
        let m = object.world_from_model;
        let linear = glam::DMat3::from_mat4(m);
        let mirrored = linear.determinant() < 0.0;
        // M^-T up to a positive factor.
        let sign = if mirrored { -1.0 } else { 1.0 };
        let normal_matrix = sign
            * glam::DMat3::from_cols(
                linear.y_axis.cross(linear.z_axis),
                linear.z_axis.cross(linear.x_axis),
                linear.x_axis.cross(linear.y_axis),
            );
        let positions: Vec<DVec3> =
            mesh.positions.iter().map(|p| m.transform_point3(DVec3::from(p.map(f64::from)))).collect();
        let finite = positions.iter().filter(|p| p.is_finite());
        let (low, high) =
            finite.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let diagonal = vector::safe_length(high - low);
        if !(diagonal > 0.0 && diagonal.is_finite()) || mesh.triangle_count() > MOST_TRIANGLES {
            return None;
        }
        let (center, scale) = (0.5 * (low + high), 1.0 / diagonal);
        let normal_of = |v: usize| {
            let normal = mesh.normals.get(v).map_or(DVec3::ZERO, |n| DVec3::from(n.map(f64::from)));
            vector::unit_or(normal_matrix * normal, DVec3::ZERO).as_vec3()
        };
        let triangles: Vec<Triangle> = (0..mesh.triangle_count())
            .filter_map(|index| {
                let [a, b, c] = mesh.triangle(index);
                let vertices = if mirrored { [a, c, b] } else { [a, b, c] };
                let mut corners = [DVec3::ZERO; 3];
                for (corner, v) in corners.iter_mut().zip(vertices) {
                    *corner = positions.get(v).filter(|p| p.is_finite()).map(|p| (*p - center) * scale)?;
                }
                let [a, b, c] = corners;
                let geometric = vector::unit_or((b - a).cross(c - a), DVec3::ZERO).as_vec3();
                let normals = if flat { [geometric; 3] } else { vertices.map(normal_of) };
                Some(Triangle { corners: corners.map(|p| p.as_vec3()), normals })
            })
            .collect();
        if triangles.is_empty() {
            return None;
        }
        let mut builder = Builder::new(&triangles);
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        builder.add(&mut order, 0);
        let Builder { nodes, leaves, .. } = builder;
        let mut texels: Vec<[f32; 4]> = nodes.into_iter().flatten().collect();
        let count = texels.len() / 2;
        let mut add = |of: fn(&Triangle) -> [Vec3; 3]| {
            let first = texels.len();
            let in_order = leaves.iter().flat_map(|&id| of(&triangles[id as usize]));
            texels.extend(in_order.map(|v| v.extend(0.0).to_array()));
            first
        };
        let (corners, normals) = (add(|t| t.corners), add(|t| t.normals));
        Some(BodyTable { texels, nodes: count, corners, normals, center, scale })
    }
}

struct Builder {
    /// The centres of the triangles.
    boxes: Vec<[Vec3; 2]>,
    nodes: Vec<[[f32; 4]; 2]>,
    /// Triangles in the order of the leaves.
    leaves: Vec<u32>,
}

fn around(boxes: impl Iterator<Item = [Vec3; 2]>) -> [Vec3; 2] {
    boxes.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], [l, h]| [low.min(l), high.max(h)])
}

/// Half the surface of a box; 0 for an empty one.
fn half_area([low, high]: [Vec3; 2]) -> f32 {
    let size = (high - low).max(Vec3::ZERO);
    size.x * size.y + size.y * size.z + size.z * size.x
}

impl Builder {
    fn new(triangles: &[Triangle]) -> Self {
        let boxes = triangles.iter().map(|t| around(t.corners.iter().map(|&c| [c, c]))).collect();
        Builder { boxes, nodes: Vec::new(), leaves: Vec::new() }
    }

    fn center(&self, id: u32) -> Vec3 {
        let [low, high] = self.boxes[id as usize];
        0.5 * (low + high)
    }

    /// Adds the node of a range of triangles, and all nodes below it.
    fn add(&mut self, ids: &mut [u32], depth: usize) {
        let [low, high] = around(ids.iter().map(|&id| self.boxes[id as usize]));
        let node = self.nodes.len();
        let mut leaf = 0;
        self.nodes.push([[0.0; 4]; 2]);
        if ids.len() <= LEAF {
            leaf = LEAF_STEP * self.leaves.len() + ids.len();
            self.leaves.extend_from_slice(ids);
        } else {
            let middle = self.cut(ids, depth);
            let (left, right) = ids.split_at_mut(middle);
            self.add(left, depth + 1);
            self.add(right, depth + 1);
        }
        // All nodes below this one have been added: the walk continues after them.
        let skip = self.nodes.len();
        self.nodes[node] = [low.extend(skip as f32).to_array(), high.extend(leaf as f32).to_array()];
    }

    /// Sorts triangles into two sets and returns the size of the first. The cut is along the longest axis of their centres, where
    /// the sum of the surfaces of both boxes, each times its number of triangles, is least (J. D. MacDonald and K. S. Booth 1990,
    /// "Heuristics for ray tracing using space subdivision"; in bins after I. Wald 2007, "On fast construction of SAH-based
    /// bounding volume hierarchies").
    fn cut(&self, ids: &mut [u32], depth: usize) -> usize {
        let [low, high] = around(ids.iter().map(|&id| [self.center(id); 2]));
        let size = high - low;
        let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
        let half = ids.len() / 2;
        if size[axis] <= 0.0 {
            return half; // All in one place: any halves will do.
        }
        let bin = |id: u32| {
            let at = (self.center(id)[axis] - low[axis]) / size[axis] * BINS as f32;
            (at as usize).min(BINS - 1)
        };
        if depth < DEEP {
            let mut bins = [([Vec3::INFINITY, Vec3::NEG_INFINITY], 0_usize); BINS];
            for &id in ids.iter() {
                let (bounds, count) = &mut bins[bin(id)];
                *bounds = around([*bounds, self.boxes[id as usize]].into_iter());
                *count += 1;
            }
            let cost = |part: &[([Vec3; 2], usize)]| {
                let count: usize = part.iter().map(|(_, count)| count).sum();
                if count == 0 { f32::INFINITY } else { half_area(around(part.iter().map(|b| b.0))) * count as f32 }
            };
            let cuts = (1..BINS).map(|cut| (cost(&bins[..cut]) + cost(&bins[cut..]), cut));
            let best = cuts.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(cost, _)| cost.is_finite());
            if let Some((_, cut)) = best {
                ids.sort_by_key(|&id| bin(id) >= cut);
                return ids.partition_point(|&id| bin(id) < cut);
            }
        }
        ids.select_nth_unstable_by(half, |&a, &b| self.center(a)[axis].total_cmp(&self.center(b)[axis]));
        half
    }
}

/// An object's own triangles for rays that go through it; freed when dropped.
pub(crate) struct BodyOnGpu {
    texture: TextureObject,
    table: BodyTable,
}

impl BodyOnGpu {
    /// Uploads a table; `None` if it has more rows than the driver's largest texture.
    pub fn upload(gl: &Gl, mut table: BodyTable, name: &str, max_size: u32) -> Result<Option<Self>, GlError> {
        let rows = table.texels.len().div_ceil(BODY_ROW);
        if rows > max_size as usize {
            return Ok(None);
        }
        table.texels.resize(rows * BODY_ROW, [0.0; 4]);
        let texture = TextureObject::bound(gl, &format!("inside of {name}"))?;
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::RGBA32F,
            [BODY_ROW as i32, rows as i32],
            Texels::f32(glow::RGBA, bytemuck::cast_slice(&table.texels)),
        );
        for parameter in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, parameter, glow::NEAREST as i32);
        }
        table.texels = Vec::new();
        Ok(Some(BodyOnGpu { texture, table }))
    }

    /// Binds it to a texture unit.
    pub fn bind(&self, gl: &Gl, unit: u32) {
        gl.active_texture(glow::TEXTURE0 + unit);
        gl.bind_texture(glow::TEXTURE_2D, Some(self.texture.handle()));
    }

    /// Sets the uniforms of body.glsl.
    pub fn set(&self, program: &Program, optics: &Optics) {
        program.set_i32("body_nodes", self.table.nodes as i32);
        program.set_i32("body_corners", self.table.corners as i32);
        program.set_i32("body_normals", self.table.normals as i32);
        program.set_dvec3("body_center", self.table.center);
        program.set_f32("body_scale", self.table.scale as f32);
        // A product beyond f32 also attenuates light to 0, and 0 times it stays 0.
        let absorption = (optics.absorption / self.table.scale).min(DVec3::splat(1e30));
        program.set_dvec3("absorption_in_body", absorption);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;
    use gonio_scene::scene_file::Shading;

    fn cloud(count: u32) -> Mesh {
        let number = |i: u32, k: f64| ((f64::from(i) * k).fract() * 2.0 - 1.0) as f32;
        let positions = (0..3 * count).map(|i| {
            let (t, c) = (i / 3 + 1, i % 3);
            let near = |k| 0.1 * number(3 * t + c, k);
            // A third of them in one place, where no cut separates them.
            let t = if t % 3 == 0 { 3 } else { t };
            [number(t, 0.618_034) + near(0.414_214), number(t, 0.754_878) + near(0.732_051), number(t, 0.569_840)]
        });
        Mesh { positions: positions.collect(), indices: (0..3 * count).collect(), ..Mesh::default() }
    }

    fn object(world_from_model: DMat4) -> Object {
        let (name, parts) = (String::new(), Vec::new());
        Object { name, mesh: 0, shading: Shading::Flat, world_from_model, parts, closed: false }
    }

    /// Every walk from the root visits each triangle once, within the boxes of all nodes above it.
    #[test]
    fn the_walk_comes_by_every_triangle_once() {
        for count in [1, 4, 5, 1000] {
            let place = DMat4::from_translation(DVec3::new(1e4, 0.0, 0.0)) * DMat4::from_scale(DVec3::splat(500.0));
            let table = BodyTable::new(&cloud(count), &object(place), true).unwrap_or_else(|| panic!("a table"));
            assert_eq!((table.corners, table.normals), (2 * table.nodes, 2 * table.nodes + 3 * count as usize));
            assert_eq!(table.texels.len(), table.normals + 3 * count as usize);
            let mut seen = vec![0; count as usize];
            let mut open: Vec<(usize, [Vec3; 2])> = Vec::new();
            for node in 0..table.nodes {
                let [low, high] = [0, 1].map(|i| glam::Vec4::from(table.texels[2 * node + i]));
                let (skip, leaf) = (low.w as usize, high.w as usize);
                assert!(skip > node && skip <= table.nodes);
                open.retain(|(end, _)| *end > node);
                assert!(open.iter().all(|(end, _)| skip <= *end), "boxes within boxes");
                open.push((skip, [low.truncate(), high.truncate()]));
                assert!(open.len() < 70, "{} deep", open.len());
                assert!((leaf == 0) == (skip > node + 1), "leaves have nothing below");
                let first = leaf / LEAF_STEP;
                for (triangle, times) in seen.iter_mut().enumerate().skip(first).take(leaf % LEAF_STEP) {
                    *times += 1;
                    for corner in 0..3 {
                        let corner = glam::Vec4::from(table.texels[table.corners + 3 * triangle + corner]).truncate();
                        assert!(open.iter().all(|(_, [l, h])| corner.cmpge(*l).all() && corner.cmple(*h).all()));
                        assert!(corner.abs().max_element() <= 0.5);
                    }
                }
            }
            assert!(seen.iter().all(|times| *times == 1), "{count}: {seen:?}");
        }
    }

    #[test]
    fn mirrored_bodies_are_turned_inside_out_and_back() {
        let corner = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Mesh {
            positions: corner.to_vec(),
            normals: vec![[0.6, 0.0, 0.8]; 3],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        };
        let normal = |scale: DVec3, flat| {
            let table = BodyTable::new(&mesh, &object(DMat4::from_scale(scale)), flat);
            table.map(|t| glam::Vec4::from(t.texels[t.normals]).truncate())
        };
        assert_eq!(normal(DVec3::ONE, true), Some(Vec3::Z));
        assert_eq!(normal(DVec3::new(-1.0, 1.0, 1.0), true), Some(Vec3::Z));
        let shading = normal(DVec3::new(-1.0, 1.0, 1.0), false).unwrap_or_default();
        assert!(shading.abs_diff_eq(Vec3::new(-0.6, 0.0, 0.8), 1e-6), "{shading}");
        assert_eq!(normal(DVec3::ZERO, true), None);
    }
}
