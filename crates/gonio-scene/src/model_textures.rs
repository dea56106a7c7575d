//! A model file by itself, without a scene, and where its textures are.

use crate::files::{self, BUILTIN, FileBytes, FileSource};
use crate::model_file::{self, ModelFile};
use gonio_mesh::{Limits, MissingSidecar, ReadError};
use std::path::{Path, PathBuf};

/// A texture's file.
pub struct TextureFile {
    /// Its path; `None` for built-in files.
    pub path: Option<PathBuf>,
    /// Its content.
    pub bytes: FileBytes,
}

impl ModelFile {
    /// Reads the model that the user calls `input`: a path, or `builtin:NAME`.
    pub fn open(input: &str, files: &dyn FileSource, limits: &Limits) -> Result<ModelFile, ReadError> {
        model_file::read(&files::resolve(Path::new(""), input), input, files, limits)
    }

    /// The file that the model's materials call `name`, sought where a scene seeks it (beside the model, then beside
    /// its material libraries, under the whole name and the bare one, in any case); or every place that was looked at.
    pub fn texture(&self, name: &str, files: &dyn FileSource) -> Result<TextureFile, MissingSidecar> {
        let (path, bytes) = files::find(files, name, &self.texture_folders()).map_err(|e| e.missing)?;
        let is_builtin = path.to_str().is_some_and(|path| path.starts_with(BUILTIN));
        Ok(TextureFile { path: Some(path).filter(|_| !is_builtin), bytes })
    }

    /// The folders in which its textures are searched for, in order.
    pub(crate) fn texture_folders(&self) -> Vec<PathBuf> {
        let mut folders: Vec<PathBuf> = Vec::new();
        for file in [&self.path].into_iter().chain(&self.libraries) {
            let folder = file.parent().map(PathBuf::from).unwrap_or_default();
            if !folders.contains(&folder) {
                folders.push(folder);
            }
        }
        folders
    }
}
