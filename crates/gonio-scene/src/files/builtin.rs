//! Models, scenes and pictures that gonio carries with it.

use crate::toml_table::nearest_word;
use gonio_environment::builtin::ROOM_FILE;
use gonio_mesh::sphere;
use std::fmt::Write;
use std::io::{Error, ErrorKind};
use std::path::{Component, Path, PathBuf};

/// The prefix of the paths of built-in files.
pub const BUILTIN: &str = "builtin:";

/// A module for the web carries the names alone: together the files are as large as the rest of it, and the first
/// picture wants but one of them.
macro_rules! builtin_files {
    ($($path:literal),+ $(,)?) => {
        &[$((
            $path,
            #[cfg(not(target_arch = "wasm32"))]
            Some(include_bytes!(concat!("../../../../assets/", $path))),
            #[cfg(target_arch = "wasm32")]
            None,
        )),+]
    };
}

/// Every built-in file, by its path below `assets`. (`web/build/pack.mjs` reads this list, to put them beside the
/// page.)
static FILES: &[(&str, Option<&[u8]>)] = builtin_files![
    "goals/ex02.png",
    "goals/ex11.png",
    "goals/ex13.png",
    "goals/s1.png",
    "models/cube.obj",
    "models/cube.mtl",
    "models/screen.obj",
    "models/screen.mtl",
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
    "scenes/easy-to-simplify.toml",
    "scenes/glass-and-mirror.toml",
    "scenes/hard-to-simplify.toml",
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
/// any built-in file). On the web `None`: see [`FileSource::builtin`](super::FileSource::builtin).
pub fn builtin(name: &str) -> Option<&'static [u8]> {
    let path = builtin_path(name);
    FILES.iter().find(|(known, _)| *known == path).and_then(|(_, bytes)| *bytes)
}

/// Whether a built-in file has this path below `assets`: a scene, a model with its files, the goal of an exercise, or the room.
pub fn is_builtin(path: &str) -> bool {
    path == ROOM_FILE || FILES.iter().any(|(known, _)| *known == path)
}

/// The name of the built-in sphere with a number of triangles: `sphere-512`.
const SPHERE: &str = "sphere-";

/// The frequency of the sphere with a model's name, `builtin:sphere-N`, where a sphere of N triangles can be
/// made: of 8, 32, 72, ... 8 f². Its vertices are on the unit sphere, and so are its normals ([`sphere::sphere`]).
pub fn sphere_of(model: &str) -> Option<u32> {
    sphere_named(model.strip_prefix(BUILTIN)?)
}

fn sphere_named(name: &str) -> Option<u32> {
    let triangles = count_of_sphere(name)?;
    let frequency = sphere::nearest_frequency(triangles);
    (sphere::triangle_count(frequency) == triangles).then_some(frequency)
}

/// N of `sphere-N`, and of its file `models/sphere_N.obj`; N is written without leading zeros.
fn count_of_sphere(name: &str) -> Option<usize> {
    let name = name.strip_prefix("models/").unwrap_or(name);
    let name = name.strip_suffix(".obj").unwrap_or(name).replace('_', "-");
    let digits = name.strip_prefix(SPHERE)?;
    let is_number = digits.bytes().all(|b| b.is_ascii_digit()) && !digits.starts_with('0');
    digits.parse().ok().filter(|_| is_number)
}

/// The sphere as an OBJ file, with the material of the other built-in spheres.
pub(super) fn sphere_file(name: &str) -> Option<Vec<u8>> {
    let mesh = sphere::sphere(sphere_named(name)?).ok()?;
    let mut text = String::from("mtllib sphere_smooth.mtl\no Sphere\n");
    // Writing to a string cannot fail.
    for [x, y, z] in &mesh.positions {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for [u, v] in &mesh.tex_coords {
        let _ = writeln!(text, "vt {u} {v}");
    }
    for [x, y, z] in &mesh.normals {
        let _ = writeln!(text, "vn {x} {y} {z}");
    }
    text.push_str("usemtl Clay\n");
    for corners in mesh.indices.chunks_exact(3) {
        text.push('f');
        for corner in corners {
            let n = corner + 1;
            let _ = write!(text, " {n}/{n}/{n}");
        }
        text.push('\n');
    }
    Some(text.into_bytes())
}

/// The path below `assets` of the name after `builtin:`.
pub(super) fn builtin_path(name: &str) -> String {
    let spelling = name.replace('_', "-");
    if let Some(triangles) = count_of_sphere(name) {
        return format!("models/sphere_{triangles}.obj");
    }
    named().find(|(known, _)| *known == spelling).map_or_else(|| name.to_owned(), |(_, path)| path.to_owned())
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
    if let Some(triangles) = count_of_sphere(name) {
        let near = sphere::nearest_frequency(triangles);
        let counts = [near.saturating_sub(1).max(1), near, (near + 1).min(sphere::MOST_FREQUENCY)];
        let [below, at, above] = counts.map(sphere::triangle_count);
        let message = format!(
            "a sphere cannot have {triangles} triangles: each of an octahedron's 8 faces is divided into 1, 4, 9, ...; \
             use {below}, {at} or {above}"
        );
        return Error::new(ErrorKind::NotFound, message);
    }
    if is_builtin(&builtin_path(name)) {
        // A page fetches them.
        return Error::new(ErrorKind::NotFound, "this sample was not downloaded; load the page again");
    }
    let names = builtin_names();
    let meant = nearest_word(name, names.iter().map(String::as_str))
        .map_or(String::new(), |word| format!("; did you mean `{BUILTIN}{word}`?"));
    let names = names.join(", ");
    let message = format!("unknown built-in file: expected one of {names}, or sphere-N with N triangles{meant}");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_download_is_not_an_unknown_name() {
        assert!(no_builtin("suzanne").to_string().contains("was not downloaded"));
        assert!(no_builtin("models/suzanne.mtl").to_string().contains("was not downloaded"));
        assert!(is_builtin("environments/room.hdr") && !is_builtin("environments/rooms.hdr"));
        assert!(no_builtin("suzane").to_string().contains("did you mean `builtin:suzanne`?"));
    }
}
