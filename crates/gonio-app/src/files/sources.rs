//! Sources of files on top of others: one source before another, files that were dropped later, and a record of the files that
//! were read.

use super::base_name;
use gonio_scene::files::{FileBytes, FileSource};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Two sources: files are looked up in the first, and then in the second.
pub struct Layered {
    /// The first source.
    pub first: Arc<dyn FileSource>,
    /// The source of files that the first does not have.
    pub then: Arc<dyn FileSource>,
}

impl FileSource for Layered {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        match self.first.read_within(path, most) {
            // Errors of the first source are reported; files that it does not have may be in the second.
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::IsADirectory) => self
                .then
                .read_within(path, most)
                .map_err(|other| if other.kind() == ErrorKind::NotFound { error } else { other }),
            other => other,
        }
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let mut names = self.first.list(folder);
        for name in self.then.list(folder) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.first.builtin(name).or_else(|| self.then.builtin(name))
    }

    fn is_coming(&self, name: &str) -> bool {
        self.first.is_coming(name) || self.then.is_coming(name)
    }
}

/// A source, and beside it files that were dropped later: they are found by their names alone, in whatever folder a model looks
/// for them.
pub struct Adopted {
    first: Arc<dyn FileSource>,
    later: Arc<dyn FileSource>,
    /// Paths in `later` by name, in lower case.
    names: BTreeMap<String, PathBuf>,
}

impl Adopted {
    /// Adds the files `names` of `later` to those of `first`, which go before.
    pub fn new(first: Arc<dyn FileSource>, later: Arc<dyn FileSource>, names: &[String]) -> Self {
        let named = |name: &String| (base_name(name).to_lowercase(), PathBuf::from(name));
        Adopted { first, later, names: names.iter().map(named).collect() }
    }
}

impl FileSource for Adopted {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        match self.first.read_within(path, most) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let name = base_name(&path.to_string_lossy()).to_lowercase();
                self.names.get(&name).map_or(Err(error), |later| self.later.read_within(later, most))
            }
            other => other,
        }
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        self.first.list(folder)
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.first.builtin(name)
    }

    fn is_coming(&self, name: &str) -> bool {
        self.first.is_coming(name)
    }
}

/// Most files that are recorded, because watching more would be too expensive.
const MOST: usize = 2000;

/// A source that records which files are requested from another one, also missing ones, which may appear later.
pub struct ReadRecorder {
    inner: Arc<dyn FileSource>,
    requests: Mutex<Requests>,
}

#[derive(Default)]
struct Requests {
    paths: BTreeSet<PathBuf>,
    missing: BTreeSet<PathBuf>,
    files: usize,
    bytes: u64,
    /// Built-in files that had not arrived yet.
    late: Vec<String>,
}

impl ReadRecorder {
    /// Records requests to `inner`.
    pub fn new(inner: Arc<dyn FileSource>) -> Self {
        ReadRecorder { inner, requests: Mutex::default() }
    }

    /// The requested paths, each once.
    pub fn paths(&self) -> Vec<PathBuf> {
        self.lock().paths.iter().cloned().collect()
    }

    /// The requested paths at which there is no file.
    pub fn missing(&self) -> Vec<PathBuf> {
        self.lock().missing.iter().cloned().collect()
    }

    /// Number of files read so far, and their bytes.
    pub fn amount(&self) -> (usize, u64) {
        let requests = self.lock();
        (requests.files, requests.bytes)
    }

    /// Whether a file that was requested too early has not arrived yet.
    pub fn is_waiting(&self) -> bool {
        self.lock().late.iter().any(|name| self.inner.is_coming(name))
    }

    /// Clears the record, before everything is requested again.
    pub fn forget(&self) {
        *self.lock() = Requests::default();
    }

    /// Ignores poisoning: no operation under the lock can leave the record inconsistent.
    fn lock(&self) -> MutexGuard<'_, Requests> {
        self.requests.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl FileSource for ReadRecorder {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        let read = self.inner.read_within(path, most);
        let mut requests = self.lock();
        if requests.paths.len() < MOST {
            requests.paths.insert(path.to_owned());
        }
        match &read {
            Ok(bytes) => {
                requests.files += 1;
                requests.bytes += bytes.len() as u64;
            }
            Err(error) if error.kind() == ErrorKind::NotFound && requests.missing.len() < MOST => {
                requests.missing.insert(path.to_owned());
            }
            Err(_) => {}
        }
        read
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        self.inner.list(folder)
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        let bytes = self.inner.builtin(name);
        if bytes.is_none() && self.inner.is_coming(name) {
            self.lock().late.push(name.to_owned());
        }
        bytes
    }

    fn is_coming(&self, name: &str) -> bool {
        self.inner.is_coming(name)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::files::MemoryFiles;

    fn one(name: &str, text: &str) -> Arc<MemoryFiles> {
        let mut files = MemoryFiles::default();
        files.insert(name, text.as_bytes().to_vec());
        Arc::new(files)
    }

    #[test]
    fn the_first_source_takes_precedence_over_the_second() {
        let first = one("a/sky.hdr", "new");
        let mut second = (*one("a/sky.hdr", "old")).clone();
        second.insert("a/cube.obj", b"cube".to_vec());
        let both = Layered { first, then: Arc::new(second) };
        let text = |name: &str| both.read(Path::new(name)).map(|b| b.into_vec()).map_err(|e| e.kind());
        assert_eq!(text("a/sky.hdr"), Ok(b"new".to_vec()));
        assert_eq!(text("a/cube.obj"), Ok(b"cube".to_vec()));
        assert_eq!(text("a/none"), Err(ErrorKind::NotFound));
        assert_eq!(both.list(Path::new("a")), [PathBuf::from("sky.hdr"), PathBuf::from("cube.obj")]);
    }

    #[test]
    fn read_and_missing_files_are_recorded() {
        let mut files = MemoryFiles::default();
        files.insert("a.obj", b"123".to_vec());
        let recording = ReadRecorder::new(Arc::new(files));
        assert!(recording.read(Path::new("a.obj")).is_ok());
        assert!(recording.read(Path::new("a.obj")).is_ok());
        assert!(recording.read(Path::new("a.mtl")).is_err());
        assert_eq!(recording.paths(), [PathBuf::from("a.mtl"), PathBuf::from("a.obj")]);
        assert_eq!(recording.amount(), (2, 6));
    }

    /// A source that expects one built-in file.
    #[derive(Default)]
    struct Fetching(Mutex<Option<&'static str>>);

    impl FileSource for Fetching {
        fn read_within(&self, _: &Path, _: u64) -> Result<FileBytes, Error> {
            Err(std::io::ErrorKind::NotFound.into())
        }
        fn list(&self, _: &Path) -> Vec<PathBuf> {
            Vec::new()
        }
        fn builtin(&self, _: &str) -> Option<FileBytes> {
            None
        }
        fn is_coming(&self, name: &str) -> bool {
            self.0.lock().is_ok_and(|coming| *coming == Some(name))
        }
    }

    #[test]
    fn it_waits_only_for_files_that_were_requested_too_early() {
        let fetching = Arc::new(Fetching(Mutex::new(Some("models/cube.mtl"))));
        let recording = ReadRecorder::new(fetching.clone());
        assert!(recording.builtin("models/cube.png").is_none());
        assert!(!recording.is_waiting());
        assert!(recording.builtin("models/cube.mtl").is_none());
        assert!(recording.is_waiting());
        if let Ok(mut coming) = fetching.0.lock() {
            *coming = None;
        }
        assert!(!recording.is_waiting());
    }

    #[test]
    fn forgetting_resets_the_counts() {
        let mut files = MemoryFiles::default();
        files.insert("a.obj", b"123".to_vec());
        let recording = ReadRecorder::new(Arc::new(files));
        assert!(recording.read(Path::new("a.obj")).is_ok());
        recording.forget();
        assert_eq!((recording.amount(), recording.paths()), ((0, 0), Vec::new()));
    }

    #[test]
    fn a_file_that_was_dropped_later_is_found_by_its_name() {
        let model = one("model/cube.obj", "cube");
        let later = one("Downloads/Wood.png", "wood");
        let record = ReadRecorder::new(model.clone());
        let wanted = Path::new("model/textures/wood.PNG");
        assert!(record.read(wanted).is_err() && record.read(Path::new("model/cube.obj")).is_ok());
        assert_eq!(record.missing(), [wanted.to_owned()]);
        let both = Adopted::new(model, later.clone(), &later.names());
        assert_eq!(both.read(wanted).unwrap().into_vec(), b"wood");
        assert!(both.read(Path::new("model/stone.png")).is_err());
    }
}
