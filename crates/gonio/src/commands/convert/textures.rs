//! The textures of a converted model, which are found and renamed relative to its new folder.

use crate::commands::scene::seen_from;
use gonio_mesh::{Diagnostic, EmbeddedImage, Model};
use gonio_scene::files::FileSource;
use gonio_scene::model_file::ModelFile;
use gonio_scene::model_textures::TextureFile;
use std::collections::BTreeMap;
use std::path::Path;

/// The files of all textures that are not inside the model, by their names in the model.
pub struct Textures {
    files: BTreeMap<String, TextureFile>,
}

impl Textures {
    /// Looks for all of them. A missing one is reported and keeps its name.
    pub fn find(file: &ModelFile, files: &dyn FileSource, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut textures = Textures { files: BTreeMap::new() };
        let mut missing: Vec<&str> = Vec::new();
        let maps = file.model.materials.iter().flat_map(|material| {
            material.textures().filter(|map| map.embedded.is_none()).map(move |map| (material, map))
        });
        for (material, map) in maps {
            if textures.files.contains_key(&map.path) || missing.contains(&map.path.as_str()) {
                continue;
            }
            match file.texture(&map.path, files) {
                Ok(found) => drop(textures.files.insert(map.path.clone(), found)),
                Err(not_found) => {
                    missing.push(&map.path);
                    let why = match not_found.refused {
                        Some(refused) => format!("was not read: {refused}"),
                        None => format!("was not found; tried {}", not_found.tried.join(", ")),
                    };
                    let message = format!("the texture {:?} {why}", map.path);
                    let diagnostic = Diagnostic { line: map.line, ..Diagnostic::warning(message) };
                    diagnostics.push(diagnostic.in_file(material.file.as_deref().unwrap_or(&file.name)));
                }
            }
        }
        textures
    }

    /// The bytes of the texture that the model calls `name`.
    pub fn bytes(&self, name: &str) -> Option<Vec<u8>> {
        self.files.get(name).map(|file| file.bytes.to_vec())
    }

    /// Names them relative to the folder of `output`; those that are not files of their own are embedded in the model.
    pub fn name_for(self, model: &mut Model, output: &Path) {
        let folder = output.parent().unwrap_or(Path::new(""));
        let mut image_of: BTreeMap<String, usize> = BTreeMap::new();
        for map in model.materials.iter_mut().flat_map(|material| material.textures_mut()) {
            let Some(file) = self.files.get(&map.path).filter(|_| map.embedded.is_none()) else { continue };
            if let Some(path) = &file.path {
                map.path = seen_from(folder, &path.to_string_lossy());
                continue;
            }
            let images = &mut model.images;
            let image = *image_of.entry(map.path.clone()).or_insert_with(|| {
                images.push(EmbeddedImage { name: map.path.clone(), bytes: file.bytes.to_vec() });
                images.len() - 1
            });
            map.embedded = Some(image);
        }
    }
}
