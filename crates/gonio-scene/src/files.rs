//! Where a scene's files come from: the disk, or what is built in.

use crate::document::nearest;
use gonio_mesh::{MissingSidecar, Sidecars};
use std::io::{Error, ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// What the paths of built-in files begin with.
pub const BUILTIN: &str = "builtin:";

macro_rules! builtin_files {
    ($($path:literal),+ $(,)?) => {
        &[$(($path, include_bytes!(concat!("../../../assets/", $path)))),+]
    };
}

/// Every built-in file, by its path below `assets`.
static FILES: &[(&str, &[u8])] = builtin_files![
    "models/cube.obj",
    "models/cube.mtl",
    "models/sphere_coarse.obj",
    "models/sphere_coarse.mtl",
    "models/sphere_coarse_averaged.obj",
    "models/sphere_coarse_averaged.mtl",
    "models/sphere_smooth.obj",
    "models/sphere_smooth.mtl",
    "models/still_life.obj",
    "models/still_life.mtl",
    "models/suzanne.obj",
    "models/suzanne.mtl",
    "models/textures/checker.png",
    "models/textures/planks.png",
    "models/textures/tiles.png",
    "scenes/lab-07.toml",
    "scenes/light-kinds.toml",
    "scenes/shadings.toml",
    "scenes/three-spheres.toml",
];

/// The files that have a name of their own: `models/still_life.obj` is `still-life`.
fn named() -> impl Iterator<Item = (String, &'static str)> {
    FILES.iter().filter_map(|(path, _)| {
        let (_, file) = path.rsplit_once('/')?;
        let stem = file.strip_suffix(".obj").or_else(|| file.strip_suffix(".toml"))?;
        Some((stem.replace('_', "-"), *path))
    })
}

/// The names of the built-in models and scenes: what may follow `builtin:`.
pub fn builtin_names() -> Vec<String> {
    named().map(|(name, _)| name).collect()
}

/// Models and scenes that gonio carries with it, by the name after `builtin:` (also the full path of
/// any built-in file).
pub fn builtin(name: &str) -> Option<&'static [u8]> {
    let path = builtin_path(name);
    FILES.iter().find(|(known, _)| *known == path).map(|(_, bytes)| *bytes)
}

/// The path below `assets` that the name after `builtin:` stands for.
fn builtin_path(name: &str) -> String {
    let wanted = name.replace('_', "-");
    named().find(|(known, _)| *known == wanted).map_or_else(|| name.to_owned(), |(_, path)| path.to_owned())
}

/// Reads a scene's files. The web page has its own. Paths of built-in files never come here.
pub trait FileSource: Send + Sync {
    /// The bytes of a file, or why they cannot be had (without the path).
    fn read(&self, path: &Path) -> Result<Vec<u8>, Error>;
    /// The names in a folder; empty where there is none.
    fn list(&self, folder: &Path) -> Vec<PathBuf>;
    /// At most `most` bytes from the beginning of a file: enough to tell what it is.
    fn read_start(&self, path: &Path, most: usize) -> Result<Vec<u8>, Error> {
        self.read(path).map(|mut bytes| {
            bytes.truncate(most);
            bytes
        })
    }
}

/// The disk.
pub struct Disk;

impl FileSource for Disk {
    fn read(&self, path: &Path) -> Result<Vec<u8>, Error> {
        std::fs::read(path)
    }
    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        std::fs::read_dir(folder)
            .map(|entries| entries.filter_map(|e| e.ok().map(|e| e.file_name().into())).collect())
            .unwrap_or_default()
    }
    fn read_start(&self, path: &Path, most: usize) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        std::fs::File::open(path)?.take(most as u64).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

/// Nothing but the built-in files.
pub struct BuiltinOnly;

impl FileSource for BuiltinOnly {
    fn read(&self, _: &Path) -> Result<Vec<u8>, Error> {
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

/// The name of a built-in file, if `path` is one; `..` is worked out.
fn builtin_of(path: &Path) -> Option<String> {
    let inner = path.to_str()?.strip_prefix(BUILTIN)?;
    let mut parts: Vec<&str> = Vec::new();
    for component in Path::new(inner).components() {
        match component {
            Component::ParentDir => drop(parts.pop()),
            Component::Normal(part) => parts.push(part.to_str()?),
            _ => {}
        }
    }
    Some(parts.join("/"))
}

/// A file of `files`, or a built-in one.
pub(crate) fn read(files: &dyn FileSource, path: &Path) -> Result<Vec<u8>, Error> {
    match builtin_of(path) {
        Some(name) => builtin(&name).map(<[u8]>::to_vec).ok_or_else(|| no_builtin(&name)),
        None => files.read(path),
    }
}

/// The beginning of a file of `files`, or of a built-in one.
pub(crate) fn read_start(files: &dyn FileSource, path: &Path, most: usize) -> Result<Vec<u8>, Error> {
    match builtin_of(path) {
        Some(name) => builtin(&name).map(|b| b[..b.len().min(most)].to_vec()).ok_or_else(|| no_builtin(&name)),
        None => files.read_start(path, most),
    }
}

fn no_builtin(name: &str) -> Error {
    let names = builtin_names();
    let meant = nearest(name, names.iter().map(String::as_str))
        .map_or(String::new(), |word| format!("did you mean `{BUILTIN}{word}`? "));
    let message = format!("nothing of this name is built in; {meant}there are {}", names.join(", "));
    Error::new(ErrorKind::NotFound, message)
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

fn list(files: &dyn FileSource, folder: &Path) -> Vec<PathBuf> {
    match builtin_of(folder) {
        Some(name) => FILES
            .iter()
            .filter_map(|(path, _)| path.strip_prefix(name.as_str())?.strip_prefix('/')?.split('/').next())
            .map(PathBuf::from)
            .collect(),
        None => files.list(folder),
    }
}

/// The file that a model calls `name`: in each of `folders`, under the whole name, then under its bare
/// file name; then the same with letters in any case. Backslashes count as slashes.
///
/// Gives the path and its bytes, or every place that was looked at.
pub(crate) fn find(files: &dyn FileSource, name: &str, folders: &[PathBuf]) -> Result<(PathBuf, Vec<u8>), Vec<String>> {
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
    fn read(&mut self, name: &str) -> Result<Vec<u8>, MissingSidecar> {
        match find(self.files, name, std::slice::from_ref(&self.folder)) {
            Ok((path, bytes)) => {
                self.found.push(path);
                Ok(bytes)
            }
            Err(tried) => Err(MissingSidecar { tried }),
        }
    }
}
