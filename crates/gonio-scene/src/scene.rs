//! A scene with its files read.

use crate::asset_cache::AssetCache;
use crate::environment::LoadedEnvironment;
use crate::material_brdf::MaterialBrdf;
use crate::part_material::PartName;
use crate::scene_file::{MaterialOverride, ObjectSpec, Shading, UpAxis};
use crate::settings::SceneSettings;
use crate::texture::Texture;
use glam::{DMat4, DQuat, DVec3, DVec4};
use gonio_light::microfacet::shininess_of_roughness;
use gonio_light::{Optics, Spectrum, Surface};
use gonio_mesh::mesh::Part;
use gonio_mesh::{AmbientRule, Diagnostic, Material, Mesh, Wrap};
use std::sync::{Arc, OnceLock};

/// A surface less opaque than this is a hole: a debug view shows what is behind it.
pub const HOLE_OPACITY: f64 = 1.0 / 255.0;

/// A surface blocks light if its opacity is at least this.
pub const SHADOW_OPACITY: f64 = 0.5;

/// A scene with its files read: what both renderers draw. Cloning shares geometry, textures and environment.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Its settings, every default filled in.
    pub settings: SceneSettings,
    /// Geometry; every mesh has normals.
    pub meshes: Vec<Arc<Mesh>>,
    /// The materials of all objects.
    pub materials: Vec<SceneMaterial>,
    /// Each file once per color space.
    pub textures: Vec<Arc<Texture>>,
    /// The environment.
    pub environment: Option<Arc<LoadedEnvironment>>,
    /// The objects, in the order of the scene file.
    pub objects: Vec<Object>,
    /// Warnings and notes about the files.
    pub diagnostics: Vec<Diagnostic>,
    /// The scene file had no camera position: one was chosen that frames the objects.
    pub camera_was_framed: bool,
    /// Remembered by [`Scene::bounds`]; leave it empty.
    pub known_bounds: OnceLock<(DVec3, DVec3)>,
    /// The assets that [`crate::edit::apply`] needs; empty in scenes that are built by hand.
    pub cache: Arc<AssetCache>,
}

impl Scene {
    /// Adds an object of one mesh with one material, for scenes that are built by hand; returns its index. Its shading is
    /// Phong, and its back faces are drawn.
    pub fn add_object(&mut self, mesh: Mesh, material: SceneMaterial, world_from_model: DMat4) -> usize {
        let index = self.objects.len();
        let part = ObjectPart {
            name: "part".into(),
            first_triangle: 0,
            triangle_count: mesh.triangle_count(),
            material: self.materials.len(),
        };
        self.objects.push(Object {
            name: format!("object {index}"),
            mesh: self.meshes.len(),
            shading: Shading::Phong,
            world_from_model,
            parts: vec![part],
            closed: false,
        });
        self.meshes.push(Arc::new(mesh));
        self.materials.push(material);
        self.known_bounds = OnceLock::new();
        index
    }

    /// Gives every mesh with texture coordinates its tangents, for a view that shows them: loading makes
    /// only those that a normal map needs, since they take longer than everything else.
    pub fn add_tangents(&mut self) {
        for mesh in self.meshes.iter_mut().filter(|mesh| mesh.tangents.is_empty()) {
            if let Some(with_tangents) = gonio_mesh::tangents::with_tangents(mesh) {
                *mesh = Arc::new(with_tangents);
            }
        }
    }

    /// The materials of an object's model that any triangle has, as in its file, without overrides of the
    /// scene. Empty in scenes that were built by hand.
    pub fn materials_in_file(&self, object: usize) -> Vec<&Material> {
        let Some((model, _)) = self.settings.objects.get(object).and_then(|spec| self.cache.find(spec)) else {
            return Vec::new();
        };
        let Some(cached) = self.cache.models.get(model) else { return Vec::new() };
        let used = |i: usize| cached.used.get(i).copied().unwrap_or(false);
        cached.materials.iter().enumerate().filter(|(i, _)| used(*i)).map(|(_, material)| material).collect()
    }

    /// The material of a part in its model's file, without overrides of the scene. `None` if the scene was built by hand, or has
    /// no such part.
    pub fn part_material_in_file(&self, object: usize, part: usize) -> Option<&Material> {
        let (model, _) = self.cache.find(self.settings.objects.get(object)?)?;
        self.cache.models.get(model)?.materials.get(self.mesh_part(object, part)?.material)
    }

    /// The values that `spec`, in place of the object's present settings, has for a part.
    pub fn part_material(&self, object: usize, part: usize, spec: &ObjectSpec) -> MaterialOverride {
        let name = self.part_names(object).nth(part);
        name.and_then(|name| name.material_in(spec)).unwrap_or_else(|| spec.material.clone())
    }

    /// The shortest name that the scene file can use for a part and for no other part of its object.
    pub fn part_name(&self, object: usize, part: usize) -> String {
        let others = self.part_names(object).enumerate().filter(|(index, _)| *index != part).map(|(_, name)| name);
        self.part_names(object).nth(part).map_or_else(String::new, |name| name.unique_among(others))
    }

    /// The names of an object's parts, in order.
    fn part_names(&self, object: usize) -> impl Iterator<Item = PartName<'_>> + Clone {
        let mesh = self.objects.get(object).and_then(|object| self.meshes.get(object.mesh));
        let model = self.settings.objects.get(object).and_then(|spec| self.cache.find(spec));
        let materials =
            model.and_then(|(model, _)| self.cache.models.get(model)).map(|model| model.materials.as_slice());
        let parts = mesh.map(|mesh| mesh.parts.as_slice()).unwrap_or_default();
        parts.iter().map(move |part| PartName::of(part, materials.unwrap_or_default()))
    }

    fn mesh_part(&self, object: usize, part: usize) -> Option<&Part> {
        self.meshes.get(self.objects.get(object)?.mesh)?.parts.get(part)
    }

    /// The smallest box around all vertices, world space; both corners 0 where there is no vertex.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        *self.known_bounds.get_or_init(|| {
            let [x, y, z] = DVec3::AXES;
            let reach = self.support(&[x, y, z, -x, -y, -z]);
            if reach.iter().any(|r| !r.is_finite()) {
                return (DVec3::ZERO, DVec3::ZERO);
            }
            (-DVec3::new(reach[3], reach[4], reach[5]), DVec3::new(reach[0], reach[1], reach[2]))
        })
    }
}

/// The extent of all objects along directions.
pub(crate) trait Extent {
    /// Returns for each direction (of any length) the largest `direction . p` over all points `p`, world space.
    fn support(&self, directions: &[DVec3]) -> Vec<f64>;
}

impl Extent for Scene {
    fn support(&self, directions: &[DVec3]) -> Vec<f64> {
        let mut reach = vec![f64::NEG_INFINITY; directions.len()];
        for object in &self.objects {
            let Some(mesh) = self.meshes.get(object.mesh) else { continue };
            // d . (A p + t) = (A^T d) . p + d . t: the directions are carried to the model, not the points
            // to the world.
            let linear = glam::DMat3::from_mat4(object.world_from_model);
            let translation = object.world_from_model.w_axis.truncate();
            let in_model: Vec<DVec3> = directions.iter().map(|&d| linear.transpose() * d).collect();
            for ((r, m), d) in reach.iter_mut().zip(mesh.reach(&in_model)).zip(directions) {
                *r = r.max(m + d.dot(translation));
            }
        }
        reach
    }
}

/// A model in its place.
#[derive(Clone, Debug)]
pub struct Object {
    /// The name in reports and debug groups.
    pub name: String,
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// The points at which the equation is evaluated.
    pub shading: Shading,
    /// `M`
    pub world_from_model: DMat4,
    /// Runs of triangles with one material.
    pub parts: Vec<ObjectPart>,
    /// Closed, front faces outward, opaque: back faces are never seen.
    pub closed: bool,
}

impl Object {
    /// The part that a triangle of its mesh belongs to.
    pub fn part_of(&self, triangle: usize) -> Option<usize> {
        let is_in =
            |part: &ObjectPart| (part.first_triangle..part.first_triangle + part.triangle_count).contains(&triangle);
        self.parts.iter().position(is_in)
    }
}

/// `M = T * Rz * Ry * Rx * S * U`: turned so that the model's up axis is y, scaled, turned about the world's x, y and z axes,
/// moved.
pub fn world_from_model(object: &ObjectSpec) -> DMat4 {
    let [x, y, z] = object.rotate.map(f64::to_radians);
    let rotation = DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
    DMat4::from_scale_rotation_translation(object.scale.into(), rotation, object.translate.into()) * upright(object.up)
}

/// The rotation that carries a model's up axis to y. Of a model with z up, x stays and -y becomes z, the front; of one with x
/// up, z stays.
fn upright(up: UpAxis) -> DMat4 {
    let columns = match up {
        UpAxis::Y => return DMat4::IDENTITY,
        UpAxis::Z => [DVec3::X, DVec3::NEG_Z, DVec3::Y],
        UpAxis::X => [DVec3::Y, DVec3::NEG_X, DVec3::Z],
        UpAxis::NegativeY => [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z],
        UpAxis::NegativeZ => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
        UpAxis::NegativeX => [DVec3::NEG_Y, DVec3::X, DVec3::Z],
    };
    DMat4::from_mat3(glam::DMat3::from_cols(columns[0], columns[1], columns[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_up_axis_becomes_y() {
        let axis = |up: UpAxis| {
            let sign = if up.name().starts_with('-') { -1.0 } else { 1.0 };
            sign * DVec3::AXES[["x", "y", "z"].iter().position(|name| up.name().ends_with(name)).unwrap_or(9)]
        };
        for &up in UpAxis::ALL {
            let matrix = world_from_model(&ObjectSpec { up, ..ObjectSpec::default() });
            assert_eq!(matrix.transform_vector3(axis(up)), DVec3::Y, "{up}");
            assert_eq!(matrix.determinant(), 1.0, "{up}: not mirrored");
        }
        // The scale is along the world's axes, whatever the model's up axis is.
        let object = ObjectSpec { up: UpAxis::Z, scale: [1.0, 5.0, 1.0], ..ObjectSpec::default() };
        assert_eq!(world_from_model(&object).transform_vector3(DVec3::Z), 5.0 * DVec3::Y);
    }
}

/// A run of triangles with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectPart {
    /// Its name in the file.
    pub name: String,
    /// First triangle.
    pub first_triangle: usize,
    /// The number of triangles.
    pub triangle_count: usize,
    /// Index into [`Scene::materials`].
    pub material: usize,
}

/// A material with its textures found.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMaterial {
    /// The numbers, overrides applied.
    pub material: Material,
    /// The reflectance that the diffuse colour is derived from; `None` where only the colour is known.
    pub diffuse_spectrum: Option<Arc<Spectrum>>,
    /// The textures that were found.
    pub maps: Maps,
    /// Reflection and refraction of the environment.
    pub optics: Optics,
    /// A BRDF of its own. `material` then has its albedo as the diffuse colour, and the specular colour 1.
    pub brdf: Option<Arc<MaterialBrdf>>,
}

impl SceneMaterial {
    /// The material's numbers without textures and vertex colours: the values at a vertex.
    pub fn base_surface(&self) -> Surface {
        let m = &self.material;
        let color = |c: [f32; 3]| DVec3::from(c.map(f64::from));
        Surface {
            ambient: match m.ambient {
                AmbientRule::FollowsDiffuse => color(m.diffuse),
                AmbientRule::Value(v) => color(v),
            },
            diffuse: color(m.diffuse),
            specular: color(m.specular),
            emitted: color(m.emitted),
            shininess: m.shininess.into(),
            refraction_index: m.refraction_index.into(),
        }
    }

    /// The material where the mesh has the colour `vertex_color`, and where `texel` looks up a texture of this name: linear
    /// RGBA, `None` where there is none.
    pub fn surface(
        &self,
        vertex_color: DVec3,
        texel: impl Fn(&'static str, &Option<BoundTexture>) -> Option<DVec4>,
    ) -> Surface {
        let SceneMaterial { material, maps, .. } = self;
        let color = |map, bound| texel(map, bound).map_or(DVec3::ONE, |t| t.truncate());
        let base = self.base_surface();
        let tint = vertex_color * color("diffuse", &maps.diffuse);
        Surface {
            ambient: match material.ambient {
                AmbientRule::FollowsDiffuse => base.diffuse * tint,
                AmbientRule::Value(_) => base.ambient,
            },
            diffuse: base.diffuse * tint,
            specular: base.specular * color("specular", &maps.specular),
            emitted: base.emitted * color("emitted", &maps.emitted),
            shininess: match (texel("shininess", &maps.shininess), maps.roughness) {
                (Some(texel), Some(roughness)) => shininess_of_roughness(f64::from(roughness) * texel.x),
                (texel, _) => base.shininess * texel.map_or(1.0, |t| t.x),
            },
            refraction_index: base.refraction_index,
        }
    }
}

/// A material's textures. Each multiplies the number of the same name, except `normal`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Maps {
    /// Colour.
    pub diffuse: Option<BoundTexture>,
    /// Colour.
    pub specular: Option<BoundTexture>,
    /// Colour.
    pub emitted: Option<BoundTexture>,
    /// Data, red channel.
    pub shininess: Option<BoundTexture>,
    /// If it is `Some`, `shininess` is a texture of roughness: the exponent is that of this number times the texel
    /// ([`gonio_mesh::MetallicRoughness::shininess`]).
    pub roughness: Option<f32>,
    /// Data, red channel (alpha was moved there where the file has one).
    pub opacity: Option<BoundTexture>,
    /// Tangent-space normal map, data, green up. Heights were turned into normals when loaded.
    pub normal: Option<BoundTexture>,
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundTexture {
    /// Index into [`Scene::textures`].
    pub texture: usize,
    /// Texture coordinates are multiplied by this, ...
    pub scale: [f32; 2],
    /// ... turned by this (radians, counter-clockwise, v up), ...
    pub rotation: f32,
    /// ... then this is added.
    pub offset: [f32; 2],
    /// The values beyond the picture's edges, along u and along v.
    pub wrap: [Wrap; 2],
}

impl BoundTexture {
    /// A texture at its texture coordinates, without transformation.
    pub fn plain(texture: usize) -> Self {
        BoundTexture { texture, scale: [1.0; 2], rotation: 0.0, offset: [0.0; 2], wrap: [Wrap::Repeat; 2] }
    }

    /// The columns of the matrix `M` that carries texture coordinates to the picture: `M * (u, v, 1)`.
    pub fn uv_matrix(&self) -> [[f32; 2]; 3] {
        let (sin, cos) = self.rotation.sin_cos();
        let [su, sv] = self.scale;
        [[cos * su, sin * su], [-sin * sv, cos * sv], self.offset]
    }
}

impl SceneMaterial {
    /// Whether any part shows what is behind it.
    pub fn is_transparent(&self) -> bool {
        self.material.opacity < 1.0 || self.maps.opacity.is_some()
    }
}

/// The part of a material's surface that blocks light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowCaster {
    /// None: light goes through.
    Nothing,
    /// All of it.
    Everything,
    /// Where the texture of opacity, times the material's opacity, is at least [`SHADOW_OPACITY`].
    WhereOpaque,
}

impl SceneMaterial {
    /// The part of its surface that blocks light. In an environment a material that lets at least half of the light through
    /// (glass) blocks none.
    pub fn shadow_caster(&self, in_environment: bool) -> ShadowCaster {
        let clear = in_environment && self.optics.transmission >= 0.5;
        if clear || f64::from(self.material.opacity) < SHADOW_OPACITY {
            ShadowCaster::Nothing
        } else if self.maps.opacity.is_some() {
            ShadowCaster::WhereOpaque
        } else {
            ShadowCaster::Everything
        }
    }
}

/// A material whose textures were all found, for tests and tools that build scenes by hand.
impl From<Material> for SceneMaterial {
    fn from(material: Material) -> Self {
        SceneMaterial { material, diffuse_spectrum: None, maps: Maps::default(), optics: Optics::default(), brdf: None }
    }
}

/// A material that is a BRDF, for tests and tools that build scenes by hand.
impl From<Arc<MaterialBrdf>> for SceneMaterial {
    fn from(brdf: Arc<MaterialBrdf>) -> Self {
        let mut material = Material::default();
        brdf.replace(&mut material);
        SceneMaterial { brdf: Some(brdf), ..material.into() }
    }
}
