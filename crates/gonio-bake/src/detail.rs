//! Which parts of a scene need texels, and where charts have to end, for maps of materials alone.

use crate::maps::MapKind;
use crate::surface::SceneSurface;
use gonio_atlas::UnwrapSettings;
use gonio_scene::Scene;

/// The density of parts of one colour, relative to all others. Any texel of such a part has the colour of all of it, so its charts
/// could be smaller still; but they keep a margin of the same size, and at a quarter little room is left to win.
const PLAIN_DENSITY: f64 = 0.5;

/// The detail of each part of a surface in maps of its materials.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialDetail {
    /// Whether all of a part has one colour in each of the maps.
    is_plain: Vec<bool>,
    /// The material of each part.
    material: Vec<usize>,
}

impl MaterialDetail {
    /// `None` if one of the maps shows more than the materials: light, normals, positions or numbers of parts.
    pub fn new(scene: &Scene, surface: &SceneSurface, kinds: &[MapKind]) -> Option<Self> {
        let shows_materials_only =
            kinds.iter().all(|kind| matches!(kind, MapKind::Diffuse | MapKind::Specular | MapKind::Emitted));
        if !shows_materials_only {
            return None;
        }
        let parts = &surface.mesh.parts;
        let is_plain = parts.iter().map(|part| {
            let Some(material) = scene.materials.get(part.material) else { return true };
            let has_texture = |kind: &MapKind| match kind {
                MapKind::Diffuse => material.maps.diffuse.is_some(),
                MapKind::Specular => material.maps.specular.is_some(),
                _ => material.maps.emitted.is_some(),
            };
            let vertices = surface.mesh.indices.iter().skip(3 * part.first_triangle).take(3 * part.triangle_count);
            let mut colors = vertices.filter_map(|&i| surface.mesh.colors.get(i as usize));
            let first = colors.next();
            !kinds.iter().any(has_texture) && colors.all(|color| Some(color) == first)
        });
        Some(MaterialDetail {
            is_plain: is_plain.collect(),
            material: parts.iter().map(|part| part.material).collect(),
        })
    }

    /// Parts of one colour, if other parts have more.
    pub fn plain_parts(&self) -> usize {
        let plain = self.is_plain.iter().filter(|is_plain| **is_plain).count();
        if plain == self.is_plain.len() { 0 } else { plain }
    }

    /// Gives parts of one colour fewer texels than the others, and lets charts end where the material changes: within a chart the
    /// hard edge between two materials would be as wide as a texel.
    #[must_use]
    pub fn applied_to(&self, settings: UnwrapSettings) -> UnwrapSettings {
        let density = |is_plain: &bool| if *is_plain { PLAIN_DENSITY } else { 1.0 };
        let density_of_part = self.is_plain.iter().map(density).collect();
        UnwrapSettings { density_of_part, group_of_part: self.material.clone(), ..settings }
    }
}
