//! The model with the baked textures in place of its own.

use crate::maps::MapKind;
use crate::surface::SceneSurface;
use gonio_atlas::AtlasUv;
use gonio_mesh::{Material, Model, TextureMap, Wrap};
use gonio_scene::Scene;

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

/// Returns the model of a surface with the coordinates of an atlas, in world space. Each material keeps its numbers, but those
/// that were baked are the map's factor, which multiplies its texture.
///
/// Textures that were not baked are left out, as they belong to other coordinates; `lost` returns their names. Vertex colours
/// are dropped if the diffuse colour was baked, as the texture contains them.
pub fn baked_model(scene: &Scene, surface: &SceneSurface, atlas: &AtlasUv, maps: &[MapFile]) -> BakedModel {
    let mut mesh = surface.mesh.with_corner_tex_coords(&atlas.tex_coords);
    if maps.iter().any(|file| file.kind == MapKind::Diffuse) {
        mesh.colors = Vec::new();
    }
    let (materials, lost) = baked_materials(scene, maps);
    BakedModel { model: Model { materials, mesh, ..Model::default() }, lost }
}

/// The materials of [`baked_model`], one for each of the scene, and the kinds of textures that they lack.
pub fn baked_materials(scene: &Scene, maps: &[MapFile]) -> (Vec<Material>, Vec<&'static str>) {
    let find = |kind: MapKind| maps.iter().find(|file| file.kind == kind);
    let mut lost = Vec::new();
    let materials =
        scene.materials.iter().map(|material| baked_material(&material.material, &find, &mut lost)).collect();
    lost.sort_unstable();
    lost.dedup();
    (materials, lost)
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
    lost: &mut Vec<&'static str>,
) -> Material {
    let had = [
        ("diffuse", own.diffuse_map.is_some() && find(MapKind::Diffuse).is_none()),
        ("specular", own.specular_map.is_some() && find(MapKind::Specular).is_none()),
        ("emitted", own.emitted_map.is_some() && find(MapKind::Emitted).is_none()),
        ("normal", (own.normal_map.is_some() || own.bump_map.is_some()) && find(MapKind::Normal).is_none()),
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
    let map = |file: &MapFile| TextureMap { wrap: [Wrap::Clamp; 2], ..TextureMap::new(&file.name) };
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

fn has_maps(physical: &gonio_mesh::MetallicRoughness) -> bool {
    physical.metallic_map.is_some() || physical.roughness_map.is_some()
}
