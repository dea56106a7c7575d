//! The disk, and what is piped in.

// The memory map below is the one place of this crate that needs it.
#![allow(unsafe_code)]

use super::{FileBytes, FileSource};
use std::fs::{File, Metadata};
use std::io::{Error, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// Smaller files are read: mapping costs more than it saves.
const WORTH_MAPPING: u64 = 1 << 16;

/// The disk. Large files are mapped into memory, not read: what is not looked at is not loaded, and nothing is copied.
pub struct Disk;

impl FileSource for Disk {
    fn read(&self, path: &Path) -> Result<FileBytes, Error> {
        let metadata = std::fs::metadata(path)?;
        if metadata.is_dir() {
            return Err(std::io::ErrorKind::IsADirectory.into());
        }
        // Before it is opened, which may wait or do something.
        if is_device(&metadata) {
            return Err(Error::other("it is a device, not a file"));
        }
        let mut file = File::open(path)?;
        if metadata.is_file() && metadata.len() >= WORTH_MAPPING {
            // SAFETY: the map is only read, and lives as long as its bytes are used. That no other program shortens or
            // rewrites the file meanwhile cannot be had from an operating system (as with any program that maps files):
            // readers check every number where they use it, so that changed bytes give a wrong model or an error; a
            // shortened file ends the process with a signal.
            if let Ok(map) = unsafe { memmap2::Mmap::map(&file) } {
                return Ok(FileBytes::shared(Arc::new(map)));
            }
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        Ok(bytes.into())
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        std::fs::read_dir(folder)
            .map(|entries| entries.filter_map(|e| e.ok().map(|e| e.file_name().into())).collect())
            .unwrap_or_default()
    }
}

/// What a model names as its texture may be a device that has no end. (Pipes are allowed: shells make them.)
#[cfg(unix)]
fn is_device(metadata: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_char_device() || metadata.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: &Metadata) -> bool {
    false
}

/// What an input is called that comes from standard input.
pub const STANDARD_INPUT: &str = "-";

/// The disk, with standard input as the file [`STANDARD_INPUT`]. It is read to its end when it is first wanted.
#[derive(Default)]
pub struct DiskAndInput {
    input: OnceLock<Result<Arc<Vec<u8>>, String>>,
}

impl FileSource for DiskAndInput {
    fn read(&self, path: &Path) -> Result<FileBytes, Error> {
        if path != Path::new(STANDARD_INPUT) {
            return Disk.read(path);
        }
        let read = self.input.get_or_init(|| {
            let mut bytes = Vec::new();
            match std::io::stdin().lock().read_to_end(&mut bytes) {
                Ok(_) => Ok(Arc::new(bytes)),
                Err(error) => Err(error.to_string()),
            }
        });
        match read {
            Ok(bytes) => Ok(FileBytes::shared(bytes.clone())),
            Err(message) => Err(Error::other(message.clone())),
        }
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        Disk.list(folder)
    }
}
