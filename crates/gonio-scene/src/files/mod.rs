//! The files of a scene: on disk, or built in.
//!
//! Sources are wrapped in one another: [`Budgeted`] limits the memory of all files together, [`Sandbox`] the folders.

mod budget;
mod builtin;
mod disk;
mod refusal;
mod sandbox;

pub use budget::{Budget, Budgeted};
pub use builtin::{BUILTIN, builtin, builtin_names, is_builtin, sphere_of};
pub use disk::{Disk, DiskAndInput, STANDARD_INPUT};
pub use refusal::{FileRefusal, OverLimit};
pub use sandbox::Sandbox;

use builtin::{builtin_of, builtin_path, list_builtin, no_builtin, sphere_file};
use gonio_mesh::{Cause, MissingSidecar, ReadError, Sidecar, Sidecars};
use std::fmt;
use std::io::{Error, ErrorKind};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads a scene's files. The web page has its own. Paths of built-in files never come here.
pub trait FileSource: Send + Sync {
    /// The bytes of a file, or the reason why it cannot be read (without the path). A file of more than `most` bytes is
    /// refused with [`FileRefusal::OverLimit`], and no more than `most` bytes and one are read to find that out.
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error>;
    /// The bytes of a file of any size, for files that the program itself chose.
    fn read(&self, path: &Path) -> Result<FileBytes, Error> {
        self.read_within(path, u64::MAX)
    }
    /// The names in a folder; empty where there is none.
    fn list(&self, folder: &Path) -> Vec<PathBuf>;
    /// A built-in file by its path below `assets`: those that the program carries, by default. The web page carries
    /// none and fetches them.
    fn builtin(&self, name: &str) -> Option<FileBytes> {
        builtin(name).map(FileBytes::from_static)
    }
    /// A built-in file that is made and not stored, a sphere; or the error that there is none of this name.
    fn made(&self, name: &str) -> Result<FileBytes, Error> {
        sphere_file(name).map(FileBytes::from).ok_or_else(|| no_builtin(name))
    }
    /// Whether a built-in file that is missing now is being downloaded: whatever was read without it must be read again
    /// afterwards.
    fn is_coming(&self, _name: &str) -> bool {
        false
    }
}

/// The bytes of a file: owned, mapped, shared or built in. Cloning shares them.
#[derive(Clone)]
pub struct FileBytes(Place);

#[derive(Clone)]
enum Place {
    Static(&'static [u8]),
    Shared(Arc<dyn AsRef<[u8]> + Send + Sync>),
}

impl FileBytes {
    /// Bytes of the program itself.
    pub fn from_static(bytes: &'static [u8]) -> Self {
        FileBytes(Place::Static(bytes))
    }

    /// Bytes of a memory map or of a shared buffer.
    pub fn shared(bytes: Arc<dyn AsRef<[u8]> + Send + Sync>) -> Self {
        FileBytes(Place::Shared(bytes))
    }

    /// A copy of the bytes.
    pub fn into_vec(self) -> Vec<u8> {
        self.to_vec()
    }
}

/// Prints only their number: a file may be large.
impl fmt::Debug for FileBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "FileBytes({})", self.len())
    }
}

impl From<Vec<u8>> for FileBytes {
    fn from(bytes: Vec<u8>) -> Self {
        FileBytes(Place::Shared(Arc::new(bytes)))
    }
}

impl Deref for FileBytes {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        match &self.0 {
            Place::Static(bytes) => bytes,
            Place::Shared(bytes) => (**bytes).as_ref(),
        }
    }
}

/// Forwards everything, so that a borrowed or shared source can be wrapped.
macro_rules! forward {
    ($($pointer:ty),+) => {
        $(impl<S: FileSource + ?Sized> FileSource for $pointer {
            fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
                (**self).read_within(path, most)
            }
            fn list(&self, folder: &Path) -> Vec<PathBuf> {
                (**self).list(folder)
            }
            fn builtin(&self, name: &str) -> Option<FileBytes> {
                (**self).builtin(name)
            }
            fn made(&self, name: &str) -> Result<FileBytes, Error> {
                (**self).made(name)
            }
            fn is_coming(&self, name: &str) -> bool {
                (**self).is_coming(name)
            }
        })+
    };
}
forward!(&S, Box<S>, Arc<S>);

/// Checks bytes that are in memory already against the limit of [`FileSource::read_within`].
pub fn within(bytes: FileBytes, most: u64) -> Result<FileBytes, Error> {
    let needed = bytes.len() as u64;
    if needed > most {
        return Err(FileRefusal::OverLimit(OverLimit { needed: Some(needed), left: most, limit: most }).into());
    }
    Ok(bytes)
}

/// The built-in files only.
pub struct BuiltinOnly;

impl FileSource for BuiltinOnly {
    fn read_within(&self, _: &Path, _: u64) -> Result<FileBytes, Error> {
        Err(Error::new(ErrorKind::NotFound, "only built-in files can be read here"))
    }
    fn list(&self, _: &Path) -> Vec<PathBuf> {
        Vec::new()
    }
}

/// The path of the file that a scene in `base` calls `name`; `builtin:` names are spelt out.
pub(crate) fn resolve(base: &Path, name: &str) -> PathBuf {
    if let Some(name) = name.strip_prefix(BUILTIN) {
        return PathBuf::from(format!("{BUILTIN}{}", builtin_path(name)));
    }
    if base.as_os_str().is_empty() { PathBuf::from(name) } else { base.join(name) }
}

/// A file of `files`, or a built-in one.
pub(crate) fn read(files: &dyn FileSource, path: &Path) -> Result<FileBytes, Error> {
    match builtin_of(path) {
        Some(name) => files.builtin(&name).map_or_else(|| files.made(&name), Ok),
        None => files.read(path),
    }
}

/// Explains in a sentence why a file cannot be read and what to do.
pub(crate) fn explain(error: &Error) -> String {
    match error.kind() {
        // Our own errors already are sentences.
        ErrorKind::NotFound if error.raw_os_error().is_none() && error.get_ref().is_some() => error.to_string(),
        ErrorKind::NotFound => "there is no such file; check the path, or use builtin:suzanne to try things out".into(),
        ErrorKind::PermissionDenied => "the file may not be read; check its permissions".into(),
        ErrorKind::IsADirectory => "this is a folder; name a file in it".into(),
        _ => format!("the file cannot be read: {error}"),
    }
}

/// The error of a file that cannot be read.
pub(crate) fn failed(error: &Error) -> ReadError {
    let failed = ReadError::new(explain(error));
    match FileRefusal::in_error(error) {
        Some(FileRefusal::OverLimit(_)) => failed.caused_by(Cause::MemoryLimit),
        Some(FileRefusal::OutsideSandbox) => failed.caused_by(Cause::Sandbox),
        _ => failed,
    }
}

pub(crate) fn list(files: &dyn FileSource, folder: &Path) -> Vec<PathBuf> {
    match builtin_of(folder) {
        Some(name) => list_builtin(&name),
        None => files.list(folder),
    }
}

/// The file that a model calls `name`: in each of `folders`, under the whole name, then under its bare
/// file name; then the same with letters in any case. Backslashes count as slashes.
///
/// Gives the path and its bytes.
///
/// # Errors
///
/// All places that were searched, and the first reason why a file there was not read.
pub(crate) fn find(files: &dyn FileSource, name: &str, folders: &[PathBuf]) -> Result<(PathBuf, FileBytes), NotFound> {
    let name = name.trim().replace('\\', "/");
    let bare = name.rsplit('/').next().unwrap_or(&name);
    let mut places: Vec<(&Path, &str)> = Vec::new();
    for part in [name.as_str(), bare] {
        for folder in folders {
            if !part.is_empty() && !places.contains(&(folder.as_path(), part)) {
                places.push((folder, part));
            }
        }
    }
    let mut not_found = NotFound::default();
    let mut read_noting = |path: PathBuf| match read(files, &path) {
        Ok(bytes) => Some((path, bytes)),
        Err(error) => {
            not_found.note(&path, &error);
            None
        }
    };
    for (folder, part) in &places {
        if let Some(found) = read_noting(folder.join(part)) {
            return Ok(found);
        }
    }
    for (folder, part) in &places {
        if let Some(path) = in_any_case(files, folder, part)
            && let Some(found) = read_noting(path)
        {
            return Ok(found);
        }
    }
    not_found.missing.tried = places.iter().map(|(folder, part)| folder.join(part).display().to_string()).collect();
    Err(not_found)
}

/// A file that was not found, or not read.
#[derive(Debug, Default)]
pub(crate) struct NotFound {
    pub missing: MissingSidecar,
    /// The error of the first file that needs more memory than what is left.
    pub over_limit: Option<Box<ReadError>>,
}

impl NotFound {
    /// Notes why the file at `path` is not read, unless it does not exist.
    fn note(&mut self, path: &Path, error: &Error) {
        use ErrorKind::{InvalidFilename, InvalidInput, IsADirectory, NotADirectory, NotFound};
        let refusal = FileRefusal::in_error(error);
        let shown = path.display();
        if let Some(FileRefusal::OverLimit(_)) = refusal {
            self.over_limit.get_or_insert_with(|| Box::new(failed(error).in_file(&shown.to_string())));
        }
        let reason = match refusal {
            Some(refusal) => format!("`{shown}` {refusal}"),
            None if matches!(
                error.kind(),
                NotFound | NotADirectory | IsADirectory | InvalidInput | InvalidFilename
            ) =>
            {
                return;
            }
            None => format!("`{shown}`: {}", explain(error)),
        };
        self.missing.refused.get_or_insert(reason);
    }
}

/// Finds `part` below `folder`, whatever the case of its names.
fn in_any_case(files: &dyn FileSource, folder: &Path, part: &str) -> Option<PathBuf> {
    if part.starts_with('/') {
        return None;
    }
    part.split('/').filter(|step| !step.is_empty() && *step != ".").try_fold(folder.to_owned(), |here, step| {
        if step == ".." {
            return Some(here.join(step));
        }
        let lower = step.to_lowercase();
        let found = list(files, &here)
            .into_iter()
            .find(|entry| entry.file_name().and_then(|n| n.to_str()).is_some_and(|n| n.to_lowercase() == lower))?;
        Some(here.join(found.file_name()?))
    })
}

/// The files beside one model.
pub(crate) struct SidecarFolder<'a> {
    files: &'a dyn FileSource,
    budget: &'a Budget,
    /// The folder of the model.
    folder: PathBuf,
    /// The material libraries that were found, in order.
    pub found: Vec<PathBuf>,
    /// The error of the first file that needs more memory than what is left.
    pub over_limit: Option<ReadError>,
}

impl<'a> SidecarFolder<'a> {
    /// The files beside `model`, charged to `budget` when they are read from `files`.
    pub fn new(model: &Path, files: &'a dyn FileSource, budget: &'a Budget) -> Self {
        let folder = model.parent().map(Path::to_owned).unwrap_or_default();
        SidecarFolder { files, budget, folder, found: Vec::new(), over_limit: None }
    }

    /// Readers get copies. Reading charges the first; a copy under another name is charged here.
    fn pay_for_copy(&self, path: &PathBuf, bytes: &FileBytes) -> Result<(), OverLimit> {
        if self.found.contains(path) { self.budget.spend(bytes.len() as u64) } else { Ok(()) }
    }
}

impl Sidecars for SidecarFolder<'_> {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        let (path, bytes) = match find(self.files, name, std::slice::from_ref(&self.folder)) {
            Ok(found) => found,
            Err(NotFound { missing, over_limit }) => {
                self.over_limit = self.over_limit.take().or(over_limit.map(|error| *error));
                return Err(missing);
            }
        };
        if let Err(over) = self.pay_for_copy(&path, &bytes) {
            let (error, shown) = (failed(&FileRefusal::OverLimit(over).into()), path.display().to_string());
            let refused = Some(format!("`{shown}` {over}"));
            self.over_limit.get_or_insert(error.in_file(&shown));
            return Err(MissingSidecar { tried: vec![shown], refused });
        }
        self.found.push(path.clone());
        Ok(Sidecar { path: path.display().to_string(), bytes: bytes.into_vec() })
    }
}
