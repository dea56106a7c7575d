//! Reads all materials of the document and assigns them to primitives.

use super::document::{Document, name_of};
use super::effect::{self, EffectMaterial};
use super::image::Images;
use super::xml::Element;
use crate::text::quote;
use crate::{EmbeddedImage, Material, ReadError, Severity};
use std::collections::HashMap;

pub(super) struct Materials {
    made: Vec<EffectMaterial>,
    /// By element.
    index_of: HashMap<u32, usize>,
    needs_default: bool,
    images: Vec<EmbeddedImage>,
}

/// The binding of one symbol by a `bind_material`.
#[derive(Clone)]
struct Bound {
    /// Index among the materials.
    material: Option<usize>,
    /// Names of texture coordinates, and their sets.
    sets: Vec<(String, u32)>,
}

/// The symbols that a `bind_material` binds.
#[derive(Default)]
pub(super) struct Binding {
    bound: HashMap<String, Bound>,
}

impl Materials {
    /// Reads all materials, used or not.
    pub(super) fn read<'t>(document: &Document<'t>) -> Result<Self, ReadError> {
        let mut images = Images::default();
        let mut made = Vec::new();
        let mut index_of = HashMap::new();
        for library in document.tree.root().all("library_materials") {
            for element in library.all("material") {
                index_of.insert(element.index, made.len());
                made.push(effect::material(document, &mut images, element)?);
            }
        }
        Ok(Materials { made, index_of, needs_default: false, images: images.embedded })
    }

    /// Reads the bindings of an instance of a geometry.
    pub(super) fn bind(&self, document: &Document<'_>, instance: Element<'_>) -> Binding {
        let mut binding = Binding::default();
        let technique = instance.path(&["bind_material", "technique_common"]);
        for bound in technique.iter().flat_map(|technique| technique.all("instance_material")) {
            let symbol = bound.attribute("symbol").unwrap_or_default().into_owned();
            let target = document.target(bound, "target", &["material"]);
            let sets = bound
                .all("bind_vertex_input")
                .filter(|input| input.attribute("input_semantic").as_deref() == Some("TEXCOORD"))
                .filter_map(|input| {
                    let set = document.count(input, "input_set").and_then(|set| u32::try_from(set).ok()).unwrap_or(0);
                    Some((input.attribute("semantic")?.into_owned(), set))
                })
                .collect();
            let material = target.and_then(|target| self.index_of.get(&target.index)).copied();
            binding.bound.entry(symbol).or_insert(Bound { material, sets });
        }
        binding
    }

    /// Returns the index of a primitive's material in a list that begins with the default one. `at` is the byte of the
    /// primitive.
    pub(super) fn index(
        &mut self,
        document: &Document<'_>,
        binding: &Binding,
        symbol: Option<&str>,
        at: usize,
        instance: Element<'_>,
    ) -> usize {
        let found = match symbol.map(|symbol| (symbol, binding.bound.get(symbol))) {
            Some((_, Some(bound))) => bound.material,
            Some((symbol, None)) => self.unbound(document, symbol, instance),
            None => {
                document.add("primitives without a material", Severity::Note, at, || {
                    "these polygons have no material: using the default one".to_owned()
                });
                None
            }
        };
        self.needs_default |= found.is_none();
        found.map_or(0, |index| index + 1)
    }

    /// Some programs bind nothing and write the material's own id as the symbol.
    fn unbound(&self, document: &Document<'_>, symbol: &str, instance: Element<'_>) -> Option<usize> {
        let id = symbol.strip_prefix('#').unwrap_or(symbol);
        let found = document.by_id(&["material"], id).and_then(|material| self.index_of.get(&material.index));
        document.add("unbound materials", Severity::Warning, instance.at(), || {
            let symbol = quote(symbol.as_bytes());
            let taken = if found.is_some() { "the material with this id" } else { "the default one" };
            format!("<{}> binds no material to the symbol {symbol}: using {taken}", instance.name())
        });
        found.copied()
    }

    /// Returns the set of texture coordinates that the material of a symbol uses.
    pub(super) fn set(&self, binding: &Binding, symbol: Option<&str>) -> Option<u32> {
        let bound = binding.bound.get(symbol?)?;
        let set_name = self.made.get(bound.material?)?.tex_coord.as_ref()?;
        bound.sets.iter().find(|(name, _)| name == set_name).map(|(_, set)| *set)
    }

    /// Whether the material with an index of [`Self::index`] has a texture.
    pub(super) fn has_textures(&self, index: usize) -> bool {
        let material = index.checked_sub(1).and_then(|index| self.made.get(index));
        material.is_some_and(|made| {
            let m = &made.material;
            let maps = [&m.diffuse_map, &m.specular_map, &m.emitted_map, &m.opacity_map, &m.normal_map, &m.bump_map];
            maps.iter().any(|map| map.is_some())
        })
    }

    /// Returns the materials, the images in the document, and the number to subtract from each index of
    /// [`Self::index`]: the default material is only included where it is needed.
    pub(super) fn finish(self) -> (Vec<Material>, Vec<EmbeddedImage>, usize) {
        let materials = self.made.into_iter().map(|made| made.material);
        if self.needs_default {
            (std::iter::once(Material::default()).chain(materials).collect(), self.images, 0)
        } else {
            (materials.collect(), self.images, 1)
        }
    }
}

/// Returns the name of an instance for the user: that of its node, or of the geometry.
pub(super) fn part_name(node: Option<Element<'_>>, geometry: &str) -> String {
    node.map(name_of).filter(|name| !name.is_empty()).unwrap_or_else(|| geometry.to_owned())
}
