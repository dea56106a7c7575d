//! One model file, read with the files beside it, and where its textures are.

use crate::files::{self, BUILTIN, Budget, Budgeted, FileBytes, FileSource, OverLimit, SidecarFolder};
use crate::readers::Readers;
use gonio_mesh::{Cause, Format, Limits, Material, MissingSidecar, Model, ReadError, compression};
use std::path::{Path, PathBuf};

/// A model file, read.
pub struct ModelFile {
    /// The name that the user knows.
    pub name: String,
    /// Its path.
    pub path: PathBuf,
    /// Its format.
    pub format: Format,
    /// Bytes of the file.
    pub size: u64,
    /// Bytes of what was in it, where it was compressed.
    pub unpacked_size: Option<u64>,
    /// The model. Its diagnostics name their file.
    pub model: Model,
    /// The sidecar files that were found.
    pub libraries: Vec<PathBuf>,
}

/// A texture's file.
pub struct TextureFile {
    /// Its path; `None` for built-in files.
    pub path: Option<PathBuf>,
    /// Its content.
    pub bytes: FileBytes,
}

impl ModelFile {
    /// Reads the model `input`: a path, or `builtin:NAME`.
    pub fn open(input: &str, files: &dyn FileSource, limits: &Limits) -> Result<ModelFile, ReadError> {
        read(&files::resolve(Path::new(""), input), input, files, limits)
    }

    /// The file that the model's materials call `name`, searched for as in a scene (beside the model, then beside
    /// its material libraries, by its path and by its file name, ignoring case); or every place that was searched.
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

/// Reads the model at `path`, which the user knows as `name`.
///
/// It may be compressed (`.gz`, `.zst`). The file and those that it names may take `limits.max_bytes` together,
/// unpacked as well. An error names the file, and a place in it where there is one.
pub fn read(path: &Path, name: &str, files: &dyn FileSource, limits: &Limits) -> Result<ModelFile, ReadError> {
    read_within(path, name, &Budgeted::new(files, limits.max_bytes), limits)
}

/// [`read`] as one of several files that share a budget.
pub(crate) fn read_within<S: FileSource>(
    path: &Path,
    name: &str,
    files: &Budgeted<S>,
    limits: &Limits,
) -> Result<ModelFile, ReadError> {
    read_by(Readers::ALL, path, name, files, limits)
}

/// [`read_within`] by these readers.
pub(crate) fn read_by<S: FileSource>(
    readers: &Readers,
    path: &Path,
    name: &str,
    files: &Budgeted<S>,
    limits: &Limits,
) -> Result<ModelFile, ReadError> {
    let bytes = files::read(files, path).map_err(|e| files::failed(&e).in_file(name))?;
    read_bytes(readers, &bytes, path, name, files, limits).map_err(|e| e.in_file(name))
}

/// Unpacks compressed bytes and charges them to the budget; `None` where they are not compressed.
pub(crate) fn unpack(bytes: &[u8], limits: &Limits, budget: &Budget) -> Result<Option<Vec<u8>>, ReadError> {
    if !compression::is_compressed(bytes) {
        return Ok(None);
    }
    budget
        .make(|left| {
            let unpacked =
                compression::unpack(bytes, &Limits { max_bytes: left, ..*limits }).map_err(|e| match e.cause {
                    Some(Cause::MemoryLimit) => Failed::OverLimit(budget.over(None, left)),
                    _ => Failed::Damaged(e),
                })?;
            let size = unpacked.as_ref().map_or(0, |unpacked| unpacked.len() as u64);
            Ok((unpacked, size))
        })
        .map_err(|failed| match failed {
            Failed::OverLimit(over) => ReadError::new(format!("unpacked, it {over}")).caused_by(Cause::MemoryLimit),
            Failed::Damaged(error) => error,
        })
}

enum Failed {
    OverLimit(OverLimit),
    Damaged(ReadError),
}

impl From<OverLimit> for Failed {
    fn from(over: OverLimit) -> Self {
        Failed::OverLimit(over)
    }
}

fn read_bytes<S: FileSource>(
    readers: &Readers,
    bytes: &[u8],
    path: &Path,
    name: &str,
    files: &Budgeted<S>,
    limits: &Limits,
) -> Result<ModelFile, ReadError> {
    let unpacked = (readers.unpack)(bytes, limits, files.budget())?;
    let content = unpacked.as_deref().unwrap_or(bytes);
    let format = (readers.format)(content, &path.to_string_lossy()).map_err(ReadError::new)?;
    let mut beside = SidecarFolder::new(path, files, files.budget());
    let read = (readers.model)(format, content, &mut beside, limits);
    // What other files leave over depends on the order in which threads read them: that a model goes without a file
    // for want of memory would not be the same every time.
    if let Some(over) = beside.over_limit {
        return Err(over);
    }
    let mut model = read?;
    if model.mesh.triangle_count() == 0 {
        return Err(ReadError::new("the model has no triangles, so there is nothing to draw"));
    }
    if model.materials.is_empty() {
        model.materials.push(Material::default());
    }
    model.diagnostics.iter_mut().filter(|d| d.place.file.is_none()).for_each(|d| d.place.file = Some(name.to_owned()));
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
