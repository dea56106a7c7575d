//! Files in memory: dropped on a page, or unpacked.

use gonio_language::tr;
use gonio_scene::files::{FileBytes, FileSource, within};
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::{Component, Path, PathBuf};

/// Files by their names with folders and forward slashes (`model/textures/wood.png`).
///
/// Names match in any case, because models made on systems that ignore case may name `Wood.PNG` for `wood.png`. An exact match
/// goes first.
#[derive(Clone, Default)]
pub struct MemoryFiles {
    files: BTreeMap<String, FileBytes>,
}

impl MemoryFiles {
    /// Adds a file, or replaces the one of the same name. `.` and `..` are resolved, backslashes count as slashes.
    pub fn insert(&mut self, name: &str, bytes: impl Into<FileBytes>) {
        self.files.insert(normal(Path::new(&name.replace('\\', "/"))), bytes.into());
    }

    /// Adds all files of `other`.
    pub fn add_all(&mut self, other: MemoryFiles) {
        self.files.extend(other.files);
    }

    /// All names, in alphabetical order.
    pub fn names(&self) -> Vec<String> {
        self.files.keys().cloned().collect()
    }

    /// Bytes of all files together.
    pub fn total_bytes(&self) -> u64 {
        self.files.values().map(|bytes| bytes.len() as u64).sum()
    }

    /// Whether there are no files.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }
}

impl FileSource for MemoryFiles {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        let name = normal(path);
        if let Some(bytes) = self.files.get(&name) {
            return within(bytes.clone(), most);
        }
        let lower = name.to_lowercase();
        let same = self.files.iter().find(|(known, _)| known.to_lowercase() == lower);
        if let Some((_, bytes)) = same {
            return within(bytes.clone(), most);
        }
        if !self.list(path).is_empty() {
            return Err(ErrorKind::IsADirectory.into());
        }
        Err(Error::new(ErrorKind::NotFound, tr!("window-it-is-not-among-the-opened")))
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let mut within = normal(folder).to_lowercase();
        if !within.is_empty() {
            within.push('/');
        }
        let mut names: Vec<PathBuf> = self
            .files
            .keys()
            .filter(|name| name.to_lowercase().starts_with(&within))
            .filter_map(|name| name.get(within.len()..)?.split('/').next().map(PathBuf::from))
            .collect();
        names.dedup();
        names
    }
}

/// The path without `.`, `..` and roots, with forward slashes.
fn normal(path: &Path) -> String {
    let mut parts: Vec<String> = Vec::new();
    for component in path.components() {
        match component {
            Component::ParentDir => drop(parts.pop()),
            Component::Normal(part) => parts.push(part.to_string_lossy().into_owned()),
            Component::CurDir | Component::RootDir | Component::Prefix(_) => {}
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> MemoryFiles {
        let mut files = MemoryFiles::default();
        files.insert("model/A.obj", b"obj".to_vec());
        files.insert("model\\textures\\Wood.PNG", b"wood".to_vec());
        files.insert("./sky.hdr", b"sky".to_vec());
        files
    }

    fn text(files: &MemoryFiles, path: &str) -> Result<String, ErrorKind> {
        files.read(Path::new(path)).map(|b| String::from_utf8_lossy(&b).into_owned()).map_err(|e| e.kind())
    }

    #[test]
    fn names_are_found_through_folders_and_in_any_case() {
        let files = files();
        assert_eq!(text(&files, "model/A.obj").as_deref(), Ok("obj"));
        assert_eq!(text(&files, "Model/a.OBJ").as_deref(), Ok("obj"));
        assert_eq!(text(&files, "model/../model/./textures/wood.png").as_deref(), Ok("wood"));
        assert_eq!(text(&files, "sky.hdr").as_deref(), Ok("sky"));
        assert_eq!(text(&files, "model"), Err(ErrorKind::IsADirectory));
        assert_eq!(text(&files, "model/B.obj"), Err(ErrorKind::NotFound));
    }

    #[test]
    fn an_exact_match_of_the_case_goes_first() {
        let mut files = files();
        files.insert("model/a.obj", b"small".to_vec());
        assert_eq!(text(&files, "model/a.obj").as_deref(), Ok("small"));
        assert_eq!(text(&files, "model/A.obj").as_deref(), Ok("obj"));
    }

    #[test]
    fn folders_list_what_is_directly_in_them() {
        let files = files();
        let listed = |folder: &str| files.list(Path::new(folder));
        assert_eq!(listed(""), [PathBuf::from("model"), PathBuf::from("sky.hdr")]);
        assert_eq!(listed("MODEL"), [PathBuf::from("A.obj"), PathBuf::from("textures")]);
        assert!(listed("mod").is_empty());
    }

    #[test]
    fn a_model_finds_its_sidecars_here() {
        let mut files = MemoryFiles::default();
        for name in ["models/cube.obj", "models/cube.mtl"] {
            let bytes = gonio_scene::files::builtin(name).unwrap_or_else(|| panic!("{name} is not built in"));
            files.insert(&name.replace("models/", "Some Folder/").to_uppercase(), bytes.to_vec());
        }
        let scene = gonio_scene::load::describe(&["SOME FOLDER/CUBE.OBJ"], &files).unwrap_or_else(|e| panic!("{e}"));
        let loaded = gonio_scene::load::load(scene, Path::new(""), &files).unwrap_or_else(|e| panic!("{e}"));
        assert!(loaded.diagnostics.is_empty(), "{:?}", loaded.diagnostics);
    }
}
