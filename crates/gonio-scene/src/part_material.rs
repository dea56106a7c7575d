//! Materials of single parts of a model: the names that a scene has for parts, and the values that replace theirs.

use crate::scene_file::{MaterialOverride, ObjectSpec};
use crate::toml_table::nearest_word;
use gonio_mesh::mesh::Part;
use gonio_mesh::{Diagnostic, Material};
use std::collections::BTreeMap;

/// Values of materials by the names of parts.
pub type PartMaterials = BTreeMap<String, MaterialOverride>;

/// The values for one part, as an option gives them.
#[derive(Clone, Debug, PartialEq)]
pub struct PartMaterial {
    /// A name of the part.
    pub part: String,
    /// The values.
    pub material: MaterialOverride,
}

/// Most names in a message.
const MOST_NAMES: usize = 12;

/// What a scene can call a part: its own name in the model's file, the name of its material, or both as `PART/MATERIAL`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PartName<'a> {
    /// The name of the group or object that it belongs to; may be empty.
    pub part: &'a str,
    /// The name of its material; may be empty.
    pub material: &'a str,
}

impl<'a> PartName<'a> {
    /// The names of a part whose material is one of `materials`.
    pub fn of(part: &'a Part, materials: &'a [Material]) -> Self {
        PartName { part: &part.name, material: materials.get(part.material).map_or("", |m| m.name.as_str()) }
    }

    /// Whether `name` is one of its names.
    pub fn is(self, name: &str) -> bool {
        !name.is_empty() && (name == self.material || name == self.part || self.is_both(name))
    }

    fn is_both(self, name: &str) -> bool {
        name.strip_prefix(self.part).and_then(|rest| rest.strip_prefix('/')) == Some(self.material)
    }

    /// The shortest of its names that none of `others` has too; the longest if there is none.
    pub fn unique_among<'b>(self, others: impl Iterator<Item = PartName<'b>> + Clone) -> String {
        let PartName { part, material } = self;
        let is_unique = |name: &&str| !name.is_empty() && !others.clone().any(|other| other.is(name));
        match [part, material].into_iter().find(is_unique) {
            Some(name) => name.to_owned(),
            None if part.is_empty() => material.to_owned(),
            None => format!("{part}/{material}"),
        }
    }

    /// The values of an object's material for this part: those of its material's name replace the object's, those of its own
    /// name replace these, those of both names replace all. `None` if the object has none for it.
    pub fn material_in(self, object: &ObjectSpec) -> Option<MaterialOverride> {
        let mut chosen: Vec<(u8, &MaterialOverride)> = Vec::new();
        for (name, values) in object.parts.iter().filter(|(name, _)| self.is(name)) {
            let rank = if name == self.part { 1 } else { u8::from(name != self.material) * 2 };
            chosen.push((rank, values));
        }
        chosen.sort_by_key(|(rank, _)| *rank);
        let mut whole = (!chosen.is_empty()).then(|| object.material.clone())?;
        chosen.into_iter().for_each(|(_, values)| whole.replace_by(values));
        Some(whole)
    }
}

impl ObjectSpec {
    /// The values for the whole object, then those for its parts.
    pub fn materials(&self) -> impl Iterator<Item = &MaterialOverride> {
        std::iter::once(&self.material).chain(self.parts.values())
    }

    /// [`Self::materials`], to be changed.
    pub fn materials_mut(&mut self) -> impl Iterator<Item = &mut MaterialOverride> {
        std::iter::once(&mut self.material).chain(self.parts.values_mut())
    }
}

impl MaterialOverride {
    /// Takes over the values that `changes` has.
    pub fn replace_by(&mut self, changes: &MaterialOverride) {
        if changes.diffuse.is_some() || changes.diffuse_spectrum.is_some() {
            (self.diffuse, self.diffuse_spectrum) = (changes.diffuse, changes.diffuse_spectrum.clone());
        }
        self.ambient = changes.ambient.or(self.ambient);
        self.specular = changes.specular.or(self.specular);
        self.emitted = changes.emitted.or(self.emitted);
        self.shininess = changes.shininess.or(self.shininess);
        self.refraction_index = changes.refraction_index.or(self.refraction_index);
        self.opacity = changes.opacity.or(self.opacity);
        self.textures = changes.textures.or(self.textures);
        self.medium = changes.medium.or(self.medium);
        self.reflectivity = changes.reflectivity.or(self.reflectivity);
        self.transmission = changes.transmission.or(self.transmission);
        self.fresnel = changes.fresnel.or(self.fresnel);
        self.tint = changes.tint.or(self.tint);
        self.absorption = changes.absorption.or(self.absorption);
        self.dispersion = changes.dispersion.or(self.dispersion);
        self.surfaces = changes.surfaces.or(self.surfaces);
        self.replace_brdf(changes.brdf.clone(), changes.brdf_file.clone());
    }

    /// Takes over a model or a file of a BRDF, if either is given.
    pub fn replace_brdf(&mut self, model: Option<String>, file: Option<String>) {
        if model.is_some() || file.is_some() {
            (self.brdf, self.brdf_file) = (model, file);
        }
    }
}

/// The parts of an object's model, and the materials of its file.
pub(crate) struct NamedParts<'a> {
    pub parts: &'a [Part],
    pub materials: &'a [Material],
}

impl<'a> NamedParts<'a> {
    fn names(&self) -> impl Iterator<Item = PartName<'a>> + use<'a> {
        let materials = self.materials;
        self.parts.iter().map(|part| PartName::of(part, materials))
    }
}

/// Warnings about names of parts that no object with such a name has; `models` are those of the objects.
pub(crate) fn unknown_parts(objects: &[ObjectSpec], models: &[NamedParts<'_>]) -> Vec<Diagnostic> {
    let mut names: Vec<&String> = objects.iter().flat_map(|object| object.parts.keys()).collect();
    names.sort_unstable();
    names.dedup();
    let mut warnings = Vec::new();
    for name in names {
        let named = || objects.iter().zip(models).filter(|(object, _)| object.parts.contains_key(name));
        if named().any(|(_, model)| model.names().any(|part| part.is(name))) {
            continue;
        }
        let mut known: Vec<&str> = named().flat_map(|(_, m)| m.names().flat_map(|n| [n.part, n.material])).collect();
        known.retain(|known| !known.is_empty());
        known.sort_unstable();
        known.dedup();
        let meant =
            nearest_word(name, known.iter().copied()).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
        let (stop, there) = if meant.is_empty() { (": ", "there") } else { (" ", "There") };
        let there_are = match known.len() {
            0 => "its parts have no names".to_owned(),
            count if count > MOST_NAMES => {
                format!("{there} are {}, and {} more", known[..MOST_NAMES].join(", "), count - MOST_NAMES)
            }
            _ => format!("{there} are {}", known.join(", ")),
        };
        let file = named().next().map_or("", |(object, _)| object.model.as_str());
        let message = format!("no part and no material is named `{name}`{meant}{stop}{there_are}");
        warnings.push(Diagnostic::warning(message).in_file(file));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shiny(value: f64) -> MaterialOverride {
        MaterialOverride { shininess: Some(value), ..MaterialOverride::default() }
    }

    #[test]
    fn the_more_exact_name_of_a_part_replaces_the_others() {
        let part = PartName { part: "Cup", material: "Gold" };
        let mut object = ObjectSpec { material: shiny(2.0), ..ObjectSpec::default() };
        object.material.opacity = Some(0.5);
        assert_eq!(part.material_in(&object), None);
        for (name, value) in [("Gold", 3.0), ("Cup", 4.0), ("Cup/Gold", 5.0)] {
            object.parts.insert(name.to_owned(), shiny(value));
            let found = part.material_in(&object).unwrap_or_default();
            assert_eq!((found.shininess, found.opacity), (Some(value), Some(0.5)), "{name}");
        }
        assert_eq!(PartName { part: "Saucer", material: "" }.material_in(&object), None);
    }

    #[test]
    fn a_part_gets_its_shortest_name_that_is_its_own() {
        let all = [("Cup", "Gold"), ("Cup", "Glaze"), ("Saucer", "Glaze"), ("", "Wood")];
        let all = all.map(|(part, material)| PartName { part, material });
        let name =
            |i: usize| all[i].unique_among(all.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, part)| *part));
        assert_eq!([0, 1, 2, 3].map(name), ["Gold", "Cup/Glaze", "Saucer", "Wood"]);
    }
}
