//! One model file, read with the files beside it.

use crate::files::{self, Beside, FileSource};
use crate::model_kind;
use gonio_mesh::{Format, Limits, Material, Model, ReadError, compression};
use std::path::{Path, PathBuf};

/// A model file, read.
pub struct ModelFile {
    /// As the user knows it.
    pub name: String,
    /// Where it lies.
    pub path: PathBuf,
    /// What it was read as.
    pub format: Format,
    /// Bytes of the file.
    pub size: u64,
    /// Bytes of what was in it, where it was compressed.
    pub unpacked_size: Option<u64>,
    /// What is in it. Its diagnostics name their file.
    pub model: Model,
    /// The sidecar files that were found.
    pub libraries: Vec<PathBuf>,
}

/// Reads the model at `path`, which the user knows as `name`.
///
/// It may be compressed (`.gz`, `.zst`). An error names the file, and a place in it where there is one.
pub fn read(path: &Path, name: &str, files: &dyn FileSource, limits: &Limits) -> Result<ModelFile, ReadError> {
    let bytes = files::read(files, path).map_err(|e| ReadError::new(files::explain(&e)).in_file(name))?;
    read_bytes(&bytes, path, name, files, limits).map_err(|e| e.in_file(name))
}

fn read_bytes(
    bytes: &[u8],
    path: &Path,
    name: &str,
    files: &dyn FileSource,
    limits: &Limits,
) -> Result<ModelFile, ReadError> {
    let unpacked = compression::unpack(bytes, limits)?;
    let content = unpacked.as_deref().unwrap_or(bytes);
    let format = model_kind::format_of(content, &path.to_string_lossy()).map_err(ReadError::new)?;
    let mut beside = Beside { files, folder: path.parent().map(Path::to_owned).unwrap_or_default(), found: Vec::new() };
    let mut model = format.read(content, &mut beside, limits)?;
    if model.mesh.triangle_count() == 0 {
        return Err(ReadError::new("the model has no triangles, so there is nothing to draw"));
    }
    if model.materials.is_empty() {
        model.materials.push(Material::default());
    }
    model.diagnostics.iter_mut().filter(|d| d.file.is_none()).for_each(|d| d.file = Some(name.to_owned()));
    Ok(ModelFile {
        name: name.to_owned(),
        path: path.to_owned(),
        format,
        size: bytes.len() as u64,
        unpacked_size: unpacked.as_ref().map(|u| u.len() as u64),
        model,
        libraries: beside.found,
    })
}
