//! All objects of a scene as one mesh in world space.

use crate::texels::TexelSample;
use glam::{DMat2, DMat3, DVec2, DVec3};
use gonio_light::Surface;
use gonio_mesh::{Mesh, Part};
use gonio_scene::{BoundTexture, Object, Scene, SceneMaterial};

/// All triangles of a scene, in world space.
#[derive(Clone, Debug)]
pub struct SceneSurface {
    /// The mesh with the scene's own texture coordinates. A part for each part of an object; its material is an index into
    /// the scene's materials. Attributes that only some objects have are zero (colours: white) on the others.
    pub mesh: Mesh,
    /// The part of each triangle.
    part_of_triangle: Vec<u32>,
}

impl SceneSurface {
    /// Joins the objects of a scene. Triangles with indices beyond their mesh are left out.
    pub fn new(scene: &Scene) -> Self {
        let mut surface = SceneSurface { mesh: Mesh::default(), part_of_triangle: Vec::new() };
        let meshes: Vec<(&Object, &Mesh)> =
            scene.objects.iter().filter_map(|object| Some((object, &**scene.meshes.get(object.mesh)?))).collect();
        let any = |has: fn(&Mesh) -> bool| meshes.iter().any(|(_, mesh)| has(mesh));
        let attributes = [
            any(|mesh| !mesh.tex_coords.is_empty()),
            any(|mesh| !mesh.tangents.is_empty()),
            any(|mesh| !mesh.colors.is_empty()),
        ];
        for (object, mesh) in meshes {
            surface.add(object, mesh, attributes);
        }
        surface
    }

    fn add(&mut self, object: &Object, mesh: &Mesh, [tex_coords, tangents, colors]: [bool; 3]) {
        let first = self.mesh.positions.len() as u32;
        let m = object.world_from_model;
        let linear = DMat3::from_mat4(m);
        let mirrored = linear.determinant() < 0.0;
        // The inverse transpose up to a positive factor.
        let sign = if mirrored { -1.0 } else { 1.0 };
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let normals = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let unit = |v: DVec3| v.normalize_or_zero().as_vec3().to_array();
        self.mesh.positions.extend(mesh.positions.iter().map(|&p| m.transform_point3(vector(p)).as_vec3().to_array()));
        let count = mesh.positions.len();
        let normal = |i: usize| mesh.normals.get(i).map_or([0.0; 3], |&n| unit(normals * vector(n)));
        self.mesh.normals.extend((0..count).map(normal));
        if tex_coords {
            self.mesh.tex_coords.extend((0..count).map(|i| mesh.tex_coords.get(i).copied().unwrap_or_default()));
        }
        if colors {
            self.mesh.colors.extend((0..count).map(|i| mesh.colors.get(i).copied().unwrap_or([1.0; 4])));
        }
        if tangents {
            let tangent = |i: usize| {
                let [x, y, z, w] = mesh.tangents.get(i).copied().unwrap_or_default();
                let [x, y, z] = unit(linear * vector([x, y, z]));
                [x, y, z, w * sign as f32]
            };
            self.mesh.tangents.extend((0..count).map(tangent));
        }
        for part in &object.parts {
            let number = self.mesh.parts.len() as u32;
            let first_triangle = self.mesh.triangle_count();
            let triangles = mesh.indices.as_chunks::<3>().0.iter().skip(part.first_triangle).take(part.triangle_count);
            for &[a, b, c] in triangles.filter(|t| t.iter().all(|&i| (i as usize) < count)) {
                let [b, c] = if mirrored { [c, b] } else { [b, c] };
                self.mesh.indices.extend([a, b, c].map(|i| first + i));
                self.part_of_triangle.push(number);
            }
            let triangle_count = self.mesh.triangle_count() - first_triangle;
            let name = if object.parts.len() == 1 { &object.name } else { &part.name };
            self.mesh.parts.push(Part { name: name.clone(), material: part.material, first_triangle, triangle_count });
        }
    }

    /// The part of a triangle, an index into the mesh's parts.
    pub fn part(&self, triangle: usize) -> usize {
        self.part_of_triangle[triangle] as usize
    }

    /// The material of a triangle.
    pub fn material<'s>(&self, scene: &'s Scene, triangle: usize) -> Option<&'s SceneMaterial> {
        scene.materials.get(self.mesh.parts[self.part(triangle)].material)
    }

    /// The material's values at a sample. Textures are filtered over the sample's share of its texel.
    pub fn surface(&self, scene: &Scene, sample: &TexelSample) -> Surface {
        let Some(material) = self.material(scene, sample.triangle) else { return Surface::default() };
        let color = if self.mesh.colors.is_empty() {
            DVec3::ONE
        } else {
            self.interpolate(sample.weights, sample.triangle, |i| {
                let [r, g, b, _] = self.mesh.colors[i];
                DVec3::from([r, g, b].map(f64::from))
            })
            // Beyond a triangle they may end.
            .max(DVec3::ZERO)
        };
        material.surface(color, |_, bound| self.texel(scene, bound, sample))
    }

    fn texel(&self, scene: &Scene, bound: &Option<BoundTexture>, sample: &TexelSample) -> Option<glam::DVec4> {
        let bound = bound.as_ref()?;
        let texture = scene.textures.get(bound.texture)?;
        let [u_axis, v_axis, offset] = bound.uv_matrix().map(|v| DVec2::from(v.map(f64::from)));
        let linear = DMat2::from_cols(u_axis, v_axis);
        let at = |weights: DVec3| {
            self.interpolate(weights, sample.triangle, |i| {
                let uv = self.mesh.tex_coords.get(i).map_or([0.0; 2], |uv| uv.map(f64::from));
                DVec3::new(uv[0], uv[1], 0.0)
            })
            .truncate()
        };
        let [dx, dy] = sample.steps.map(|step| linear * at(step));
        let uv = linear * at(sample.weights) + offset;
        Some(texture.sample(uv, dx, dy, scene.settings.picture.texture_filter, bound.wrap))
    }

    fn interpolate(&self, weights: DVec3, triangle: usize, value: impl Fn(usize) -> DVec3) -> DVec3 {
        let [a, b, c] = self.mesh.triangle(triangle);
        weights.x * value(a) + weights.y * value(b) + weights.z * value(c)
    }

    /// The position of a sample.
    pub fn position(&self, weights: DVec3, triangle: usize) -> DVec3 {
        self.interpolate(weights, triangle, |i| DVec3::from(self.mesh.positions[i].map(f64::from)))
    }

    /// Where a line meets the plane of a triangle, in barycentric coordinates, which may be outside of the triangle; `None` where it
    /// runs along the plane, or the triangle has no area.
    pub(crate) fn weights_in_plane(&self, triangle: usize, start: DVec3, direction: DVec3) -> Option<DVec3> {
        let [a, b, c] = self.mesh.triangle(triangle).map(|i| DVec3::from(self.mesh.positions[i].map(f64::from)));
        let normal = (b - a).cross(c - a);
        let p = start + direction * ((a - start).dot(normal) / direction.dot(normal));
        let share = |from: DVec3, to: DVec3| (from - p).cross(to - p).dot(normal) / normal.length_squared();
        let weights = DVec3::new(share(b, c), share(c, a), share(a, b));
        weights.is_finite().then_some(weights)
    }

    /// The unit normal of a triangle; zero without an area.
    pub fn geometric_normal(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.mesh.triangle(triangle).map(|i| DVec3::from(self.mesh.positions[i].map(f64::from)));
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// The interpolated unit normal at a sample, without a normal map.
    pub fn smooth_normal(&self, weights: DVec3, triangle: usize) -> DVec3 {
        let normal = self.interpolate(weights, triangle, |i| DVec3::from(self.mesh.normals[i].map(f64::from)));
        normal.normalize_or(self.geometric_normal(triangle))
    }

    /// The unit normal at a sample, with the material's normal map where there is one.
    pub fn normal(&self, scene: &Scene, sample: &TexelSample) -> DVec3 {
        let normal = self.smooth_normal(sample.weights, sample.triangle);
        let Some(material) = self.material(scene, sample.triangle) else { return normal };
        if self.mesh.tangents.is_empty() {
            return normal;
        }
        let Some(texel) = self.texel(scene, &material.maps.normal, sample) else { return normal };
        let Some(frame) = tangent_frame(&self.mesh, sample, normal) else { return normal };
        (frame * (2.0 * texel.truncate() - DVec3::ONE)).normalize_or(normal)
    }
}

/// The tangent, the bitangent and the normal at a sample of a mesh with tangents, orthonormal: from a normal map's numbers to
/// the space of the mesh. `None` where the tangent has no direction.
pub(crate) fn tangent_frame(mesh: &Mesh, sample: &TexelSample, normal: DVec3) -> Option<DMat3> {
    let corners = mesh.triangle(sample.triangle).map(|i| mesh.tangents[i].map(f64::from));
    let weights = sample.weights.to_array();
    let sum = |axis: usize| (0..3).map(|k| weights[k] * corners[k][axis]).sum::<f64>();
    let tangent = DVec3::new(sum(0), sum(1), sum(2));
    let tangent = (tangent - normal * normal.dot(tangent)).try_normalize()?;
    let handedness = if sum(3) < 0.0 { -1.0 } else { 1.0 };
    Some(DMat3::from_cols(tangent, handedness * normal.cross(tangent), normal))
}
