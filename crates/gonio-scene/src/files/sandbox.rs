//! Restricts reading to the folders of the inputs.

use super::{FileBytes, FileRefusal, FileSource};
use std::ffi::OsString;
use std::io::Error;
use std::path::{Component, Path, PathBuf};

/// A source of the inputs that a user named and the files in their folders only: models and scenes cannot read anything
/// else, whatever paths they name and wherever links in these folders lead.
///
/// Paths are compared after all links and `..` are resolved, and files are opened by their resolved paths. A file that
/// a hard link brings into the folder counts as being in it, and so does one that another program moves there while it
/// is being opened.
pub struct Sandbox<S> {
    inner: S,
    /// As the user named them; they may be anywhere.
    inputs: Vec<PathBuf>,
    /// Resolved paths.
    folders: Vec<PathBuf>,
}

impl<S: FileSource> Sandbox<S> {
    /// `inner`, confined to `inputs` and their folders. A file allows the folder that it is in; a folder or a
    /// pattern of files (`sky_*.png`) allows itself. Other inputs (a pipe, standard input, a built-in name) allow no
    /// folder.
    pub fn new<'i>(inner: S, inputs: impl IntoIterator<Item = &'i str>) -> Self {
        let inputs: Vec<PathBuf> = inputs.into_iter().map(PathBuf::from).collect();
        let folders = inputs.iter().filter_map(|input| folder_of(input)).collect();
        Sandbox { inner, inputs, folders }
    }

    /// The resolved path, if it is in one of the folders, or would be if the file existed.
    fn inside(&self, path: &Path) -> Result<PathBuf, FileRefusal> {
        let resolved = resolved(path).ok_or(FileRefusal::OutsideSandbox)?;
        let is_inside = self.folders.iter().any(|folder| resolved.starts_with(folder));
        if is_inside { Ok(resolved) } else { Err(FileRefusal::OutsideSandbox) }
    }
}

impl<S: FileSource> FileSource for Sandbox<S> {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        if self.inputs.iter().any(|input| input == path) {
            return self.inner.read_within(path, most);
        }
        self.inner.read_within(&self.inside(path)?, most)
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        self.inside(folder).map(|folder| self.inner.list(&folder)).unwrap_or_default()
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.inner.builtin(name)
    }
    fn made(&self, name: &str) -> Result<FileBytes, Error> {
        self.inner.made(name)
    }

    fn is_coming(&self, name: &str) -> bool {
        self.inner.is_coming(name)
    }
}

/// The folder that an input allows, resolved.
fn folder_of(input: &Path) -> Option<PathBuf> {
    let is_pattern = || input.file_name().is_some_and(|name| name.to_string_lossy().contains('*'));
    match std::fs::metadata(input) {
        Ok(metadata) if metadata.is_dir() => canonical(input),
        Ok(metadata) if metadata.is_file() => canonical(input.parent()?),
        Err(_) if is_pattern() => canonical(input.parent()?),
        _ => None,
    }
}

fn canonical(path: &Path) -> Option<PathBuf> {
    std::fs::canonicalize(or_here(path)).ok()
}

fn or_here(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}

/// `path` without links and `..`. If it does not exist, its longest existing prefix is resolved; `None` if the rest
/// contains `..`, or no prefix exists.
fn resolved(path: &Path) -> Option<PathBuf> {
    let mut rest: Vec<OsString> = Vec::new();
    let mut begin = path;
    loop {
        if let Some(mut resolved) = canonical(begin) {
            resolved.extend(rest.iter().rev());
            return Some(resolved);
        }
        // A dangling link is refused, because its target cannot be resolved.
        if begin.is_symlink() {
            return None;
        }
        match begin.components().next_back()? {
            Component::Normal(name) => rest.push(name.to_owned()),
            _ => return None,
        }
        begin = begin.parent()?;
    }
}
