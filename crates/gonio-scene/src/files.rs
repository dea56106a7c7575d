//! Where a scene's files come from: the disk, or what is built in.

use std::path::{Path, PathBuf};

/// Models that gonio carries with it, by the name after `builtin:`.
pub fn builtin(name: &str) -> Option<&'static [u8]> {
    let _ = name;
    None
}

/// Reads a scene's files. The web page has its own.
pub trait FileSource: Send + Sync {
    /// The bytes of a file, or why they cannot be had (without the path).
    fn read(&self, path: &Path) -> Result<Vec<u8>, std::io::Error>;
    /// The names in a folder; empty where there is none.
    fn list(&self, folder: &Path) -> Vec<PathBuf>;
}

/// The disk.
pub struct Disk;

impl FileSource for Disk {
    fn read(&self, path: &Path) -> Result<Vec<u8>, std::io::Error> {
        std::fs::read(path)
    }
    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        std::fs::read_dir(folder)
            .map(|entries| entries.filter_map(|e| e.ok().map(|e| e.path())).collect())
            .unwrap_or_default()
    }
}
