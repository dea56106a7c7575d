//! The scene's triangles, in a space of their own: the world, moved and scaled uniformly into the unit cube, where f32 is
//! fine enough wherever the scene is and however large.

use crate::tree::{Hit, Tree};
use glam::{DMat3, DVec3, Vec2, Vec3};
use gonio_light::vector;
use gonio_mesh::Mesh;
use gonio_scene::scene_file::Shading;
use gonio_scene::{Object, Scene};

/// All triangles, and the tree over them. Lengths are units of trace space.
pub(crate) struct Geometry {
    /// Of each vertex: unit, world space; zero where degenerate.
    normals: Vec<Vec3>,
    pub triangles: Vec<Triangle>,
    /// Of each triangle.
    facets: Vec<Facet>,
    objects: Vec<Placed>,
    pub tree: Tree,
    pub space: Space,
}

/// From the world to trace space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space {
    /// World position of the origin.
    pub center: DVec3,
    /// Units of trace space per world unit.
    pub scale: f64,
}

impl Space {
    /// A point of the world in trace space.
    pub fn point(&self, world: DVec3) -> Vec3 {
        ((world - self.center) * self.scale).as_vec3()
    }
}

/// One triangle of one object.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// Indices into the vertices of all objects.
    pub vertices: [u32; 3],
    pub object: u32,
    /// Index into the scene's materials.
    pub material: u32,
    /// Its light, if its material emits light.
    pub light: Option<u32>,
    /// The interpolated normal is the triangle's own everywhere.
    flat: bool,
    /// The mesh has neither texture coordinates nor colours nor tangents.
    bare: bool,
}

/// What a triangle's corners say.
#[derive(Clone, Copy, Debug)]
struct Facet {
    corners: [Vec3; 3],
    /// Unit, towards the front; zero for a triangle without area.
    normal: Vec3,
    /// Bound of the rounding error of a point's position along any axis.
    error: f32,
}

/// An object in its place.
#[derive(Clone, Copy, Debug)]
struct Placed {
    /// Index into the scene's meshes.
    mesh: usize,
    first_vertex: u32,
    /// For directions along the surface.
    world_from_model: DMat3,
    /// -1 where the transformation mirrors: the front is the side that is clockwise.
    handedness: f32,
    /// Normals are those of the triangles.
    flat: bool,
}

/// The geometry of a place on a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Trace space.
    pub position: Vec3,
    /// Bound of the position's rounding error along any axis.
    pub error: f32,
    /// Unit, towards the front of the triangle.
    pub geometric_normal: Vec3,
    /// Unit, interpolated, on the side of the geometric normal.
    pub normal: Vec3,
    /// The interpolated normal was on the other side, and was turned.
    pub normal_turned: bool,
    /// Whether the normal is that of the triangle.
    pub flat: bool,
    /// The derivative of the position by u, not of unit length, and the sign of the bitangent; where the mesh has it.
    pub tangent: Option<(Vec3, f32)>,
    pub uv: Vec2,
    /// White where the mesh has no colours.
    pub color: Vec3,
}

impl Geometry {
    /// Triangles with corners that are not finite, or with indices beyond the mesh, are left out.
    pub fn new(scene: &Scene) -> Self {
        let (low, high) = scene.bounds();
        let largest = (high - low).max_element();
        let scale = if largest > 0.0 && largest.is_finite() { 1.0 / largest } else { 1.0 };
        let space = Space { center: 0.5 * (low + high), scale };
        let mut geometry = Geometry {
            normals: Vec::new(),
            triangles: Vec::new(),
            facets: Vec::new(),
            objects: Vec::new(),
            tree: Tree::default(),
            space,
        };
        let mut positions = Vec::new();
        for (index, object) in scene.objects.iter().enumerate() {
            geometry.add(scene, index as u32, object, &mut positions);
        }
        let corners_of = |t: &Triangle| t.vertices.map(|v| positions[v as usize]);
        let corners: Vec<[Vec3; 3]> = geometry.triangles.iter().map(corners_of).collect();
        geometry.facets = geometry
            .triangles
            .iter()
            .zip(&corners)
            .map(|(t, corners)| Facet::new(*corners, geometry.objects[t.object as usize].handedness))
            .collect();
        for i in 0..geometry.triangles.len() {
            geometry.triangles[i].flat = geometry.is_flat(i);
        }
        geometry.tree = Tree::new(&corners);
        geometry
    }

    fn add(&mut self, scene: &Scene, index: u32, object: &Object, positions: &mut Vec<Vec3>) {
        let directions = DMat3::from_mat4(object.world_from_model);
        let first_vertex = positions.len() as u32;
        let handedness = if directions.determinant() < 0.0 { -1.0 } else { 1.0 };
        self.objects.push(Placed {
            mesh: object.mesh,
            first_vertex,
            world_from_model: directions,
            handedness,
            flat: matches!(object.shading, Shading::Flat | Shading::FlatPerFace),
        });
        let Some(mesh) = scene.meshes.get(object.mesh) else { return };
        // M^-T up to a positive factor: defined for singular matrices too.
        let m = directions;
        let normal_matrix =
            DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis))
                * f64::from(handedness);
        let world = |p: [f32; 3]| object.world_from_model.transform_point3(DVec3::from(p.map(f64::from)));
        positions.extend(mesh.positions.iter().map(|&p| self.space.point(world(p))));
        let bare = mesh.tex_coords.is_empty() && mesh.colors.is_empty() && mesh.tangents.is_empty();
        self.normals.extend((0..mesh.positions.len()).map(|i| {
            let normal = mesh.normals.get(i).map_or(DVec3::ZERO, |&n| DVec3::from(n.map(f64::from)));
            vector::unit(normal_matrix * normal).unwrap_or(DVec3::ZERO).as_vec3()
        }));
        for part in &object.parts {
            if part.material >= scene.materials.len() {
                continue;
            }
            let end = part.first_triangle.saturating_add(part.triangle_count).min(mesh.triangle_count());
            for in_mesh in part.first_triangle..end {
                let local = mesh.triangle(in_mesh);
                if local.iter().any(|&v| v >= mesh.positions.len()) {
                    continue;
                }
                let vertices = local.map(|v| first_vertex + v as u32);
                if vertices.iter().all(|&v| positions[v as usize].is_finite()) {
                    self.triangles.push(Triangle {
                        vertices,
                        object: index,
                        material: part.material as u32,
                        light: None,
                        flat: false,
                        bare,
                    });
                }
            }
        }
    }

    /// Unit, towards the front; zero for a triangle without area.
    #[inline]
    pub fn geometric_normal(&self, triangle: u32) -> Vec3 {
        self.facets[triangle as usize].normal
    }

    /// Whether the normals of the corners are the triangle's: as exactly as f32 tells.
    fn is_flat(&self, index: usize) -> bool {
        let triangle = &self.triangles[index];
        let own = self.facets[index].normal;
        self.objects[triangle.object as usize].flat
            || triangle.vertices.iter().all(|&v| {
                let normal = self.normals[v as usize];
                let difference = if normal.dot(own) < 0.0 { normal + own } else { normal - own };
                difference.abs().max_element() < 4.0 * f32::EPSILON
            })
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.facets[triangle as usize].corners
    }

    /// Area of a triangle, in units of trace space squared.
    pub fn area(&self, triangle: u32) -> f32 {
        let [a, b, c] = self.facets[triangle as usize].corners;
        0.5 * (b - a).cross(c - a).length()
    }

    /// A point of a triangle, with the bound of its rounding error.
    #[inline]
    pub fn point(&self, triangle: u32, weights: Vec3) -> (Vec3, f32) {
        let facet = &self.facets[triangle as usize];
        let [a, b, c] = facet.corners;
        (a * weights.x + b * weights.y + c * weights.z, facet.error)
    }

    /// The mesh of a triangle, and its corners in that mesh.
    fn in_mesh<'s>(&self, scene: &'s Scene, triangle: &Triangle) -> (&'s Mesh, [usize; 3]) {
        let object = &self.objects[triangle.object as usize];
        let [a, b, c] = triangle.vertices;
        let local = |v: u32| (v - object.first_vertex) as usize;
        (&scene.meshes[object.mesh], [local(a), local(b), local(c)])
    }

    /// The place where a ray hit.
    #[inline]
    pub fn place(&self, scene: &Scene, hit: &Hit) -> Place {
        let triangle = &self.triangles[hit.triangle as usize];
        let weights = hit.barycentrics;
        let (position, error) = self.point(hit.triangle, weights);
        let geometric_normal = self.geometric_normal(hit.triangle);
        let mut place = Place {
            position,
            error,
            geometric_normal,
            normal: geometric_normal,
            normal_turned: false,
            flat: true,
            tangent: None,
            uv: Vec2::ZERO,
            color: Vec3::ONE,
        };
        if !(triangle.flat && triangle.bare) {
            self.interpolate(scene, triangle, weights, &mut place);
        }
        place
    }

    /// What the corners of a triangle give besides the position.
    #[inline(never)]
    fn interpolate(&self, scene: &Scene, triangle: &Triangle, weights: Vec3, place: &mut Place) {
        let object = &self.objects[triangle.object as usize];
        place.flat = object.flat;
        if !triangle.flat {
            let [a, b, c] = triangle.vertices.map(|v| self.normals[v as usize]);
            let normal = (a * weights.x + b * weights.y + c * weights.z).normalize_or(place.geometric_normal);
            place.normal_turned = normal.dot(place.geometric_normal) < 0.0;
            place.normal = if place.normal_turned { -normal } else { normal };
        }
        if triangle.bare {
            return;
        }
        let (mesh, corners) = self.in_mesh(scene, triangle);
        if !mesh.tex_coords.is_empty() {
            let [a, b, c] = corners.map(|v| mesh.tex_coords.get(v).map_or(Vec2::ZERO, |&uv| uv.into()));
            place.uv = a * weights.x + b * weights.y + c * weights.z;
        }
        if !mesh.colors.is_empty() {
            let [a, b, c] = corners.map(|v| mesh.colors.get(v).map_or(Vec3::ONE, |c| Vec3::new(c[0], c[1], c[2])));
            place.color = a * weights.x + b * weights.y + c * weights.z;
        }
        place.tangent = (!mesh.tangents.is_empty()).then(|| {
            let [a, b, c] = corners.map(|v| mesh.tangents.get(v).copied().unwrap_or_default());
            let mix = |i: usize| a[i] * weights.x + b[i] * weights.y + c[i] * weights.z;
            let along = object.world_from_model * DVec3::new(mix(0).into(), mix(1).into(), mix(2).into());
            (along.as_vec3(), if mix(3) * object.handedness < 0.0 { -1.0 } else { 1.0 })
        });
    }
}

impl Facet {
    fn new(corners: [Vec3; 3], handedness: f32) -> Self {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let largest = normal.abs().max_element();
        let normal = if largest > 0.0 { (normal / largest).normalize() * handedness } else { Vec3::ZERO };
        // Seven roundings (M. Pharr, W. Jakob, G. Humphreys, *Physically Based Rendering*, 4th edition, section 6.8.4), and two
        // for the step away from the surface.
        let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
        Facet { corners, normal, error: 9.0 * 0.5 * f32::EPSILON * largest }
    }
}

impl Place {
    /// The origin of a ray that leaves the surface along `direction`: just outside of what rounding may have done to the
    /// position.
    #[inline]
    pub fn leave(&self, direction: Vec3) -> Vec3 {
        offset(self.position, self.error, self.geometric_normal, direction)
    }
}

/// `position` moved along `normal` to the side of `direction`, beyond its rounding error. `error` covers the rounding of
/// this step too.
#[inline]
pub(crate) fn offset(position: Vec3, error: f32, normal: Vec3, direction: Vec3) -> Vec3 {
    let distance = error * normal.abs().element_sum() + f32::MIN_POSITIVE;
    position + normal * distance.copysign(direction.dot(normal))
}
