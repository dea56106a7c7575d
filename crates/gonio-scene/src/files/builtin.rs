//! Models and scenes that gonio carries with it.

use crate::document::nearest;
use std::io::{Error, ErrorKind};
use std::path::{Component, Path, PathBuf};

/// What the paths of built-in files begin with.
pub const BUILTIN: &str = "builtin:";

macro_rules! builtin_files {
    ($($path:literal),+ $(,)?) => {
        &[$(($path, include_bytes!(concat!("../../../../assets/", $path)))),+]
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
    "scenes/glass-and-mirror.toml",
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
pub(super) fn builtin_path(name: &str) -> String {
    let wanted = name.replace('_', "-");
    named().find(|(known, _)| *known == wanted).map_or_else(|| name.to_owned(), |(_, path)| path.to_owned())
}

/// The name of a built-in file, if `path` is one; `..` is worked out.
pub(super) fn builtin_of(path: &Path) -> Option<String> {
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

pub(super) fn no_builtin(name: &str) -> Error {
    let names = builtin_names();
    let meant = nearest(name, names.iter().map(String::as_str))
        .map_or(String::new(), |word| format!("did you mean `{BUILTIN}{word}`? "));
    let message = format!("nothing of this name is built in; {meant}there are {}", names.join(", "));
    Error::new(ErrorKind::NotFound, message)
}

/// The names of built-in files in a folder below `assets`.
pub(super) fn list_builtin(folder: &str) -> Vec<PathBuf> {
    FILES
        .iter()
        .filter_map(|(path, _)| path.strip_prefix(folder)?.strip_prefix('/')?.split('/').next())
        .map(PathBuf::from)
        .collect()
}
