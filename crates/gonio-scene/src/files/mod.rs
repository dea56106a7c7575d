//! Where a scene's files come from: the disk, or what is built in.

mod builtin;
mod bytes;
mod disk;

pub use builtin::{BUILTIN, builtin, builtin_names, is_builtin, sphere_of};
pub use bytes::FileBytes;
pub use disk::{Disk, DiskAndInput, STANDARD_INPUT};

use builtin::{builtin_of, builtin_path, list_builtin, no_builtin, sphere_file};
use gonio_mesh::{MissingSidecar, Sidecar, Sidecars};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Reads a scene's files. The web page has its own. Paths of built-in files never come here.
pub trait FileSource: Send + Sync {
    /// The bytes of a file, or why they cannot be had (without the path).
    fn read(&self, path: &Path) -> Result<FileBytes, Error>;
    /// The names in a folder; empty where there is none.
    fn list(&self, folder: &Path) -> Vec<PathBuf>;
    /// A built-in file by its path below `assets`: those that the program carries, by default. The web page carries
    /// none and fetches them.
    fn builtin(&self, name: &str) -> Option<FileBytes> {
        builtin(name).map(FileBytes::from_static)
    }
    /// Whether a built-in file that cannot be had now is on its way: what was read without it is not what it will be,
    /// and is to be read again when it has come.
    fn is_coming(&self, _name: &str) -> bool {
        false
    }
}

/// Nothing but the built-in files.
pub struct BuiltinOnly;

impl FileSource for BuiltinOnly {
    fn read(&self, _: &Path) -> Result<FileBytes, Error> {
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
        Some(name) => {
            let made = sphere_file(&name).map(FileBytes::from);
            made.or_else(|| files.builtin(&name)).ok_or_else(|| no_builtin(&name))
        }
        None => files.read(path),
    }
}

/// Why a file cannot be read, as a sentence that says what to do.
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

pub(crate) fn list(files: &dyn FileSource, folder: &Path) -> Vec<PathBuf> {
    match builtin_of(folder) {
        Some(name) => list_builtin(&name),
        None => files.list(folder),
    }
}

/// The file that a model calls `name`: in each of `folders`, under the whole name, then under its bare
/// file name; then the same with letters in any case. Backslashes count as slashes.
///
/// Gives the path and its bytes, or every place that was looked at.
pub(crate) fn find(
    files: &dyn FileSource,
    name: &str,
    folders: &[PathBuf],
) -> Result<(PathBuf, FileBytes), Vec<String>> {
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
    for (folder, part) in &places {
        let path = folder.join(part);
        if let Ok(bytes) = read(files, &path) {
            return Ok((path, bytes));
        }
    }
    for (folder, part) in &places {
        if let Some(path) = in_any_case(files, folder, part)
            && let Ok(bytes) = read(files, &path)
        {
            return Ok((path, bytes));
        }
    }
    Err(places.iter().map(|(folder, part)| folder.join(part).display().to_string()).collect())
}

/// `part` below `folder`, each of its names taken in whatever case it stands there.
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

/// The files beside one model; remembers what was found.
pub(crate) struct Beside<'a> {
    pub files: &'a dyn FileSource,
    /// Where the model lies.
    pub folder: PathBuf,
    /// The material libraries that were found, in order.
    pub found: Vec<PathBuf>,
}

impl Sidecars for Beside<'_> {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        match find(self.files, name, std::slice::from_ref(&self.folder)) {
            Ok((path, bytes)) => {
                self.found.push(path.clone());
                Ok(Sidecar { path: path.display().to_string(), bytes: bytes.into_vec() })
            }
            Err(tried) => Err(MissingSidecar { tried }),
        }
    }
}
