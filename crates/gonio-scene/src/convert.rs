//! A model file in another format, with the files beside it.

use crate::files::FileSource;
use crate::model_file::{ModelFile, TextureFile};
use gonio_mesh::write::ply::PlyEncoding;
use gonio_mesh::write::{self, ImageFile, glb};
use gonio_mesh::{Diagnostic, EmbeddedImage, FilePlace, Model};
use std::collections::BTreeMap;
use std::path::Path;

/// The formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelFormat {
    /// Wavefront OBJ, with its material library.
    Obj,
    /// PLY.
    Ply,
    /// Binary glTF.
    Glb,
}

impl ModelFormat {
    /// All of them.
    pub const ALL: &'static [Self] = &[Self::Obj, Self::Ply, Self::Glb];

    /// The file name extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Glb => "glb",
        }
    }

    /// The format of a file by its extension, in any case.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
        Self::ALL.iter().copied().find(|format| format.name() == extension)
    }
}

/// What becomes of textures that are files of their own. A `.glb` contains all textures in either case.
#[derive(Clone, Copy)]
pub enum TexturePlacement<'a> {
    /// They stay where they are: the written model has the path that the function returns for a file's path. Textures
    /// without a path are copied.
    Stay(&'a dyn Fn(&Path) -> String),
    /// They are copied beside the model.
    Copied,
}

/// A converted model.
#[derive(Clone, Debug)]
pub struct ConvertedModel {
    /// The bytes of the model's file.
    pub main: Vec<u8>,
    /// The names and bytes of the files beside it that it refers to.
    pub beside: Vec<(String, Vec<u8>)>,
    /// What the format cannot represent.
    pub diagnostics: Vec<Diagnostic>,
}

impl ConvertedModel {
    /// Writes a model for a file with the name `stem` before its extension. Names of textures in `model` are replaced by
    /// those that are written.
    ///
    /// # Errors
    /// The model is too large for the format.
    pub fn new(
        model: &mut Model,
        textures: &ModelTextures,
        placement: TexturePlacement<'_>,
        stem: &str,
        format: ModelFormat,
        encoding: PlyEncoding,
    ) -> Result<ConvertedModel, glb::TooLarge> {
        if format == ModelFormat::Glb {
            let glb = glb::write(model, &mut |map| textures.bytes(&map.path))?;
            return Ok(ConvertedModel { main: glb.bytes, beside: Vec::new(), diagnostics: glb.diagnostics });
        }
        textures.name(model, placement);
        if format == ModelFormat::Ply {
            let files = write::ply::write(model, stem, encoding);
            let beside = image_files(model, &files.images).collect();
            return Ok(ConvertedModel { main: files.ply, beside, diagnostics: files.diagnostics });
        }
        let files = write::obj::write(model, &format!("{stem}.mtl"));
        let mut beside = Vec::new();
        if !files.mtl.is_empty() {
            beside.push((files.mtl_name, files.mtl));
        }
        beside.extend(image_files(model, &files.images));
        Ok(ConvertedModel { main: files.obj, beside, diagnostics: files.diagnostics })
    }
}

/// The pictures inside the model, as files beside it.
fn image_files<'m>(model: &'m Model, images: &'m [ImageFile]) -> impl Iterator<Item = (String, Vec<u8>)> + 'm {
    images.iter().filter_map(|file| Some((file.name.clone(), model.images.get(file.image)?.bytes.clone())))
}

/// The files of all textures that are not inside the model, by their names in the model.
pub struct ModelTextures {
    files: BTreeMap<String, TextureFile>,
}

impl ModelTextures {
    /// Looks for all of them. A missing one is reported and keeps its name.
    pub fn find(file: &ModelFile, files: &dyn FileSource, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut textures = ModelTextures { files: BTreeMap::new() };
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
                    let fault = match not_found.refused {
                        Some(refused) => format!("was not read: {refused}"),
                        None => format!("was not found; tried {}", not_found.tried.join(", ")),
                    };
                    let message = format!("the texture {:?} {fault}", map.path);
                    let diagnostic = Diagnostic { place: FilePlace::on_line(map.line), ..Diagnostic::warning(message) };
                    diagnostics.push(diagnostic.in_file(material.file.as_deref().unwrap_or(&file.name)));
                }
            }
        }
        textures
    }

    /// The bytes of the texture that the model calls `name`.
    fn bytes(&self, name: &str) -> Option<Vec<u8>> {
        self.files.get(name).map(|file| file.bytes.to_vec())
    }

    /// Names them as they are written; those that are copied become pictures inside the model.
    fn name(&self, model: &mut Model, placement: TexturePlacement<'_>) {
        let mut image_of: BTreeMap<String, usize> = BTreeMap::new();
        for map in model.materials.iter_mut().flat_map(|material| material.textures_mut()) {
            let Some(file) = self.files.get(&map.path).filter(|_| map.embedded.is_none()) else { continue };
            if let (TexturePlacement::Stay(name), Some(path)) = (placement, &file.path) {
                map.path = name(path);
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
