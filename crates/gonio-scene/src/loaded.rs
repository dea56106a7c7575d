//! A scene with its files read.

use crate::description::{Scene, Shading};
use crate::texture::Texture;
use glam::DMat4;
use gonio_mesh::{Diagnostic, Material, Mesh};

/// A scene with its files read: what both renderers draw.
#[derive(Clone, Debug, Default)]
pub struct LoadedScene {
    /// The effective scene: every default filled in.
    pub scene: Scene,
    /// Geometry; every mesh has normals.
    pub meshes: Vec<Mesh>,
    /// Of all objects.
    pub materials: Vec<SceneMaterial>,
    /// Each file once per color space.
    pub textures: Vec<Texture>,
    /// In the order of the scene.
    pub objects: Vec<Object>,
    /// Everything odd that was survived.
    pub diagnostics: Vec<Diagnostic>,
}

/// A model in its place.
#[derive(Clone, Debug)]
pub struct Object {
    /// For reports and debug groups.
    pub name: String,
    /// Index into [`LoadedScene::meshes`].
    pub mesh: usize,
    /// Where the equation is evaluated.
    pub shading: Shading,
    /// `M`
    pub world_from_model: DMat4,
    /// Runs of triangles with one material.
    pub parts: Vec<ObjectPart>,
    /// Closed, front faces outward, opaque: back faces are never seen.
    pub closed: bool,
}

/// A run of triangles with one material.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectPart {
    /// Its name in the file.
    pub name: String,
    /// First triangle.
    pub first_triangle: usize,
    /// How many.
    pub triangle_count: usize,
    /// Index into [`LoadedScene::materials`].
    pub material: usize,
}

/// A material with its textures found.
#[derive(Clone, Debug)]
pub struct SceneMaterial {
    /// The numbers, overrides applied.
    pub material: Material,
    /// The textures that were found.
    pub maps: Maps,
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
    /// Data, red channel (alpha was moved there where the file has one).
    pub opacity: Option<BoundTexture>,
    /// Tangent-space normal map, data, green up. Heights were turned into normals when loaded.
    pub normal: Option<BoundTexture>,
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundTexture {
    /// Index into [`LoadedScene::textures`].
    pub texture: usize,
    /// Texture coordinates are multiplied by this, ...
    pub scale: [f32; 2],
    /// ... then this is added.
    pub offset: [f32; 2],
    /// Clamped to the edge instead of repeated.
    pub clamp: bool,
}

impl SceneMaterial {
    /// Whether what is behind shows through anywhere.
    pub fn is_transparent(&self) -> bool {
        self.material.opacity < 1.0 || self.maps.opacity.is_some()
    }
}
