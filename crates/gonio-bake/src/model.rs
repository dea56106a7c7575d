//! The model with the baked textures in place of its own.

use crate::maps::MapKind;
use crate::surface::SceneSurface;
use gonio_atlas::AtlasUv;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{ColorTag, encode8};
use gonio_mesh::{EmbeddedImage, Material, Model, TextureMap, Wrap};
use gonio_scene::{BoundTexture, Scene, SceneMaterial};

/// A baked map's file.
#[derive(Clone, Debug, PartialEq)]
pub struct MapFile {
    /// The quantity.
    pub kind: MapKind,
    /// The name of the file, as the model will refer to it.
    pub name: String,
    /// [`crate::BakedMap::factor`].
    pub factor: f32,
}

/// Where a model has the coordinates of an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtlasSet {
    /// In place of its own.
    Only,
    /// As a second set, for formats that have one (glTF); its own coordinates and textures stay.
    Second,
}

/// Returns the model of a surface with the coordinates of an atlas, in world space. Each material keeps its numbers, but those
/// that were baked are the map's factor, which multiplies its texture.
///
/// With [`AtlasSet::Only`], textures that were not baked are left out, as they belong to other coordinates; `lost` returns their
/// names. With [`AtlasSet::Second`], colours and normals stay, as pictures inside of the model. Vertex colours are dropped if the
/// diffuse colour was baked, as the texture contains them.
pub fn baked_model(
    scene: &Scene,
    surface: &SceneSurface,
    atlas: &AtlasUv,
    maps: &[MapFile],
    set: AtlasSet,
) -> BakedModel {
    let mut mesh = match set {
        AtlasSet::Only => surface.mesh.with_corner_tex_coords(&atlas.tex_coords),
        AtlasSet::Second => surface.mesh.with_second_corner_tex_coords(&atlas.tex_coords),
    };
    if maps.iter().any(|file| file.kind == MapKind::Diffuse) {
        mesh.colors = Vec::new();
    }
    let BakedMaterials { materials, images, lost } = baked_materials(scene, maps, set);
    BakedModel { model: Model { materials, mesh, images, ..Model::default() }, lost }
}

/// The materials of a model with baked textures.
pub struct BakedMaterials {
    /// One for each of the scene.
    pub materials: Vec<Material>,
    /// The pictures of textures that stay.
    pub images: Vec<EmbeddedImage>,
    /// The kinds of textures that the scene's materials have and these lack.
    pub lost: Vec<&'static str>,
}

/// Returns the materials of [`baked_model`].
pub fn baked_materials(scene: &Scene, maps: &[MapFile], set: AtlasSet) -> BakedMaterials {
    let find = |kind: MapKind| maps.iter().find(|file| file.kind == kind);
    let mut lost = Vec::new();
    let mut kept = KeptTextures { scene, images: Vec::new(), number: vec![None; scene.textures.len()] };
    let materials = (scene.materials.iter())
        .map(|own| {
            let mut material = baked_material(&own.material, &find, set, &mut lost);
            if set == AtlasSet::Second {
                kept.restore(own, &mut material);
            }
            material
        })
        .collect();
    lost.sort_unstable();
    lost.dedup();
    BakedMaterials { materials, images: kept.images, lost }
}

/// A model with baked textures.
pub struct BakedModel {
    /// The model.
    pub model: Model,
    /// The kinds of textures that the scene's materials have and the model lacks.
    pub lost: Vec<&'static str>,
}

fn baked_material<'f>(
    own: &Material,
    find: &impl Fn(MapKind) -> Option<&'f MapFile>,
    set: AtlasSet,
    lost: &mut Vec<&'static str>,
) -> Material {
    let leaves_out = |kind| set == AtlasSet::Only && find(kind).is_none();
    let had = [
        ("diffuse", own.diffuse_map.is_some() && leaves_out(MapKind::Diffuse)),
        ("specular", own.specular_map.is_some() && leaves_out(MapKind::Specular)),
        ("emitted", own.emitted_map.is_some() && leaves_out(MapKind::Emitted)),
        ("normal", (own.normal_map.is_some() || own.bump_map.is_some()) && leaves_out(MapKind::Normal)),
        ("opacity", own.opacity_map.is_some()),
        ("shininess", own.shininess_map.is_some() || own.metallic_roughness.as_ref().is_some_and(has_maps)),
    ];
    lost.extend(had.into_iter().filter(|(_, is_lost)| *is_lost).map(|(name, _)| name));
    let mut material = own.clone();
    material.drop_textures();
    // The baked colours are those of the light equation.
    material.metallic_roughness = None;
    material.sources = Vec::new();
    material.unused = Vec::new();
    let on_second_set = set == AtlasSet::Second;
    let map = |file: &MapFile| TextureMap { wrap: [Wrap::Clamp; 2], on_second_set, ..TextureMap::new(&file.name) };
    let replace = |kind, color: &mut [f32; 3], texture: &mut Option<TextureMap>| {
        if let Some(file) = find(kind) {
            (*color, *texture) = ([file.factor; 3], Some(map(file)));
        }
    };
    replace(MapKind::Diffuse, &mut material.diffuse, &mut material.diffuse_map);
    replace(MapKind::Specular, &mut material.specular, &mut material.specular_map);
    replace(MapKind::Emitted, &mut material.emitted, &mut material.emitted_map);
    material.normal_map = find(MapKind::Normal).map(map);
    material
}

/// The scene's textures that a model keeps.
struct KeptTextures<'s> {
    scene: &'s Scene,
    images: Vec<EmbeddedImage>,
    /// The number of each texture of the scene among the images.
    number: Vec<Option<usize>>,
}

impl KeptTextures<'_> {
    /// Gives a material its own textures where no map was baked.
    fn restore(&mut self, own: &SceneMaterial, material: &mut Material) {
        let restore = |kept: &mut Self, bound: &Option<BoundTexture>, map: &mut Option<TextureMap>| {
            if let (None, Some(bound)) = (map.as_ref(), bound) {
                *map = kept.map(bound);
            }
        };
        restore(self, &own.maps.diffuse, &mut material.diffuse_map);
        restore(self, &own.maps.specular, &mut material.specular_map);
        restore(self, &own.maps.emitted, &mut material.emitted_map);
        restore(self, &own.maps.normal, &mut material.normal_map);
    }

    /// `None` for a texture that the scene lacks.
    fn map(&mut self, bound: &BoundTexture) -> Option<TextureMap> {
        let texture = self.scene.textures.get(bound.texture)?;
        if self.number[bound.texture].is_none() {
            let (width, height, rgba) = (texture.width, texture.height, texture.rgba.clone());
            let bytes = encode8(&EncodedPicture { width, height, rgba }, ColorTag::Untagged).ok()?;
            self.number[bound.texture] = Some(self.images.len());
            self.images.push(EmbeddedImage { name: texture.name.clone(), bytes });
        }
        let BoundTexture { scale, rotation, offset, wrap, .. } = *bound;
        let embedded = self.number[bound.texture];
        Some(TextureMap { embedded, scale, rotation, offset, wrap, ..TextureMap::new(&texture.name) })
    }
}

fn has_maps(physical: &gonio_mesh::MetallicRoughness) -> bool {
    physical.metallic_map.is_some() || physical.roughness_map.is_some()
}
