//! All triangles of all objects in world space, and the tree of boxes over them. Scenes that differ only in lights or
//! colours share it.

use glam::{DMat3, DMat4, DVec3, Vec3A};
use gonio_light::{Surfaces, vector};
use gonio_mesh::Mesh;
use gonio_scene::{Object, Scene};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use rayon::prelude::*;
use std::sync::Arc;

/// The triangles of a scene in world space, with the tree of boxes over them: what takes long to build. Can be built on
/// one thread and used on others.
pub struct ReferenceGeometry {
    world: WorldGeometry,
    built_of: Vec<ObjectParts>,
}

/// The properties of an object that its triangles depend on.
struct ObjectParts {
    mesh: Option<Arc<Mesh>>,
    world_from_model: DMat4,
    closed: bool,
    looked_through: bool,
    parts: Vec<Part>,
}

/// First triangle, number of triangles, material, and whether it is transparent.
type Part = (usize, usize, usize, bool);

impl ReferenceGeometry {
    /// Carries the geometry to world space and builds the tree.
    pub fn new(scene: &Scene) -> Self {
        ReferenceGeometry { world: WorldGeometry::new(scene), built_of: objects(scene).collect() }
    }

    /// Whether it is what [`Self::new`] would build for a scene: of the same meshes (the same ones, not equal ones), in
    /// the same places, with materials of the same numbers that are transparent, and looked through, where they were.
    /// Colours, textures, shading, lights, camera and environment may be others.
    pub fn fits(&self, scene: &Scene) -> bool {
        self.built_of.len() == scene.objects.len() && self.built_of.iter().zip(objects(scene)).all(|(a, b)| a.is(&b))
    }

    pub(crate) fn world(&self) -> &WorldGeometry {
        &self.world
    }
}

impl ObjectParts {
    fn is(&self, other: &ObjectParts) -> bool {
        let same_mesh = match (&self.mesh, &other.mesh) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        same_mesh
            && self.world_from_model == other.world_from_model
            && (self.closed, self.looked_through) == (other.closed, other.looked_through)
            && self.parts == other.parts
    }
}

fn objects(scene: &Scene) -> impl Iterator<Item = ObjectParts> {
    scene.objects.iter().map(|object| ObjectParts {
        mesh: scene.meshes.get(object.mesh).cloned(),
        world_from_model: object.world_from_model,
        closed: object.closed,
        looked_through: is_looked_through(scene, object),
        parts: object
            .parts
            .iter()
            .map(|part| {
                let transparent = scene.materials.get(part.material).is_some_and(|m| m.is_transparent());
                (part.first_triangle, part.triangle_count, part.material, transparent)
            })
            .collect(),
    })
}

/// One triangle of one object, in the order in which a GPU would draw them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// Indices into [`WorldGeometry::positions`]; bit-identical corners of neighbours keep edges tight.
    pub vertices: [u32; 3],
    /// Index into the scene's objects.
    pub object: u32,
    /// Index into the object's parts.
    pub part: u32,
    /// Index into the scene's materials.
    pub material: u32,
    /// Index of the triangle in its mesh.
    pub in_mesh: u32,
    /// Whether surfaces behind it may be visible.
    pub transparent: bool,
    /// Back faces are never hit.
    pub closed: bool,
    /// `M` mirrors: the front is the side that is clockwise.
    pub mirrored: bool,
}

/// The transformation of an object's vectors to world space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    /// The matrix for directions along the surface.
    pub world_from_model: DMat3,
    /// -1 where `M` mirrors, else 1.
    pub handedness: f64,
    /// The diagonal of the box around the object, world units; 0 where no view ray goes through the object.
    pub diagonal: f64,
}

/// Geometry in world space.
pub(crate) struct WorldGeometry {
    /// The vertices of all objects, one object after the other.
    pub positions: Vec<DVec3>,
    /// Unit, or zero where the mesh's normal is degenerate; by the inverse transpose of `M`.
    pub normals: Vec<DVec3>,
    /// The triangles to draw.
    pub triangles: Vec<Triangle>,
    /// The placement of each object.
    pub placements: Vec<Placement>,
    /// `None` where there is no triangle.
    pub tree: Option<Tree>,
}

/// A tree of boxes. Box space is world space moved and scaled uniformly so that everything lies in
/// `[-1/2, 1/2]`: there f32 is fine enough for boxes, wherever the scene is and however large.
pub(crate) struct Tree {
    /// Its nodes; the boxes are rounded outwards.
    pub bvh: Bvh2,
    /// World position of box space's origin.
    pub center: DVec3,
    /// Box units per world unit.
    pub scale: f64,
}

/// The matrix for normals: `M^-T` up to a positive factor, and so defined for singular matrices too.
pub(crate) fn normal_matrix(m: &DMat3) -> DMat3 {
    let sign = handedness(m);
    DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis)) * sign
}

/// -1 where `m` mirrors, else 1.
pub(crate) fn handedness(m: &DMat3) -> f64 {
    if m.determinant() < 0.0 { -1.0 } else { 1.0 }
}

/// `v` at unit length however small it is (a small triangle has a short cross product); zero stays zero.
pub(crate) fn unit_of_any_size(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { vector::unit(v / largest).unwrap_or(DVec3::ZERO) } else { DVec3::ZERO }
}

impl WorldGeometry {
    /// Carries everything to world space. Parts, materials, indices or positions that do not fit are left out, as a
    /// GPU would read nothing sensible from them either.
    pub fn new(scene: &Scene) -> Self {
        let mut geometry = WorldGeometry {
            positions: Vec::new(),
            normals: Vec::new(),
            triangles: Vec::new(),
            placements: Vec::new(),
            tree: None,
        };
        for object_index in 0..scene.objects.len() {
            geometry.add_object(scene, object_index);
        }
        geometry.tree = Tree::new(&geometry.positions, &geometry.triangles);
        geometry
    }

    fn add_object(&mut self, scene: &Scene, object_index: usize) {
        let object = &scene.objects[object_index];
        let m: DMat4 = object.world_from_model;
        let directions = DMat3::from_mat4(m);
        let first_vertex = self.positions.len() as u32;
        self.placements.push(Placement {
            world_from_model: directions,
            handedness: handedness(&directions),
            diagonal: 0.0,
        });
        let Some(mesh) = scene.meshes.get(object.mesh) else { return };
        let normals_to_world = normal_matrix(&directions);
        let vertex_count = mesh.positions.len();
        self.positions.par_extend(mesh.positions.par_iter().map(|&p| m.transform_point3(p.map(f64::from).into())));
        self.normals.par_extend((0..vertex_count).into_par_iter().map(|i| {
            let normal = mesh.normals.get(i).map_or(DVec3::ZERO, |&n| n.map(f64::from).into());
            unit_of_any_size(normals_to_world * normal)
        }));
        if is_looked_through(scene, object) {
            let finite = self.positions[first_vertex as usize..].iter().filter(|p| p.is_finite());
            let (low, high) =
                finite.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
            self.placements[object_index].diagonal = vector::safe_length((high - low).max(DVec3::ZERO));
        }

        for (part_index, part) in object.parts.iter().enumerate() {
            let Some(material) = scene.materials.get(part.material) else { continue };
            let transparent = material.is_transparent();
            let end = part.first_triangle.saturating_add(part.triangle_count).min(mesh.triangle_count());
            for in_mesh in part.first_triangle..end {
                let local = mesh.triangle(in_mesh);
                if local.iter().any(|&v| v >= vertex_count) {
                    continue;
                }
                let vertices = local.map(|v| first_vertex + v as u32);
                if vertices.iter().any(|&v| !self.positions[v as usize].is_finite()) {
                    continue;
                }
                self.triangles.push(Triangle {
                    vertices,
                    object: object_index as u32,
                    part: part_index as u32,
                    material: part.material as u32,
                    in_mesh: in_mesh as u32,
                    transparent,
                    closed: object.closed,
                    mirrored: handedness(&directions) < 0.0,
                });
            }
        }
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: &Triangle) -> [DVec3; 3] {
        triangle.vertices.map(|v| self.positions[v as usize])
    }

    /// `normalize(M^-T n)`, `n` the triangle's own normal in the model; zero for a triangle without area.
    pub fn geometric_normal(&self, triangle: &Triangle) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        let sign = if triangle.mirrored { -1.0 } else { 1.0 };
        // At unit length first: the cross product of two tiny edges may be too small a number.
        unit_of_any_size(unit_of_any_size(b - a).cross(unit_of_any_size(c - a))) * sign
    }
}

impl Tree {
    fn new(positions: &[DVec3], triangles: &[Triangle]) -> Option<Tree> {
        let used = || triangles.iter().flat_map(|t| t.vertices).map(|v| positions[v as usize]);
        let first = used().next()?;
        let (low, high) = used().fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        let center = 0.5 * low + 0.5 * high;
        let extent = (high - low).max_element();
        let scale = if extent > 0.0 && (1.0 / extent).is_finite() { 1.0 / extent } else { 1.0 };
        let boxes: Vec<Aabb> = triangles
            .par_iter()
            .map(|t| {
                let [a, b, c] = t.vertices.map(|v| (positions[v as usize] - center) * scale);
                Aabb::new(rounded_down(a.min(b).min(c)), -rounded_down(-a.max(b).max(c)))
            })
            .collect();
        Some(Tree { bvh: gonio_rays::build_tree(&boxes), center, scale })
    }
}

/// Whether view rays go through the inside of an object.
pub(crate) fn is_looked_through(scene: &Scene, object: &Object) -> bool {
    let mut optics = object.parts.iter().filter_map(|part| scene.materials.get(part.material)).map(|m| &m.optics);
    optics.any(|o| o.transmission > 0.0 && o.surfaces == Surfaces::Two)
}

/// Rounds to f32, never upwards.
fn rounded_down(v: DVec3) -> Vec3A {
    let down = |x: f64| {
        let nearest = x as f32;
        if f64::from(nearest) > x { nearest.next_down() } else { nearest }
    };
    Vec3A::new(down(v.x), down(v.y), down(v.z))
}

/// A scene of one mesh, for tests.
#[cfg(test)]
pub(crate) fn one_object(mesh: gonio_mesh::Mesh, optics: gonio_light::Optics) -> Scene {
    use gonio_scene::scene_file::Shading;
    use gonio_scene::{ObjectPart, SceneMaterial};
    let part =
        ObjectPart { name: String::new(), first_triangle: 0, triangle_count: mesh.triangle_count(), material: 0 };
    let (name, world_from_model) = (String::new(), DMat4::IDENTITY);
    let object = Object { name, mesh: 0, shading: Shading::Flat, world_from_model, parts: vec![part], closed: false };
    Scene {
        meshes: vec![std::sync::Arc::new(mesh)],
        materials: vec![SceneMaterial { optics, ..gonio_mesh::Material::default().into() }],
        objects: vec![object],
        ..Scene::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_matrix_is_the_inverse_transpose() {
        let m = DMat3::from_cols(DVec3::new(2.0, 0.3, 0.0), DVec3::new(-0.4, 0.5, 1.0), DVec3::new(0.1, 0.0, -3.0));
        let expected = m.inverse().transpose();
        for v in [DVec3::X, DVec3::Y, DVec3::new(0.3, -0.2, 0.7)] {
            // Exact but for rounding.
            assert!((normal_matrix(&m) * v).normalize().distance((expected * v).normalize()) < 1e-14);
        }
    }

    #[test]
    fn boxes_are_rounded_outwards() {
        for x in [0.1, -0.1, 1.0 / 3.0, -1.0 / 3.0, 0.0, 0.5] {
            let low = f64::from(rounded_down(DVec3::splat(x)).x);
            assert!(low <= x && x - low < 1e-7, "{x} {low}");
        }
    }

    #[test]
    fn tiny_vectors_have_a_direction() {
        assert_eq!(unit_of_any_size(DVec3::new(0.0, 3e-200, 0.0)), DVec3::Y);
        assert_eq!(unit_of_any_size(DVec3::ZERO), DVec3::ZERO);
    }
}
