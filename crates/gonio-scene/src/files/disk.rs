//! The disk, and what is piped in.

// The memory map below is the one place of this crate that needs it.
#![allow(unsafe_code)]

use super::{FileBytes, FileRefusal, FileSource, OverLimit};
use std::collections::HashMap;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{Error, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Smaller files are read: mapping costs more than it saves.
const WORTH_MAPPING: u64 = 1 << 16;

/// The ordinary files of the disk. Large ones are mapped into memory, not read: unused parts are not loaded, and
/// nothing is copied.
///
/// Devices, pipes and sockets are refused without being opened, because a model may name them: reading them may wait
/// for ever, never end, or have an effect.
pub struct Disk;

impl FileSource for Disk {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        check_ordinary(&std::fs::metadata(path)?)?;
        let file = open_without_waiting(path)?;
        // Once more, of what was opened: the path may lead to something else by now.
        let metadata = file.metadata()?;
        check_ordinary(&metadata)?;
        let size = metadata.len();
        if size > most {
            return Err(over(Some(size), most));
        }
        if size >= WORTH_MAPPING {
            // SAFETY: the map is only read, and lives as long as its bytes are used. No operating system prevents
            // another program from shortening or rewriting the file meanwhile (as with any program that maps files):
            // readers check every number where they use it, so that changed bytes give a wrong model or an error; a
            // shortened file ends the process with a signal.
            if let Ok(map) = unsafe { memmap2::MmapOptions::new().len(size as usize).map(&file) } {
                return Ok(FileBytes::shared(Arc::new(map)));
            }
        }
        if size == 0 {
            return read_empty(&file, most);
        }
        Ok(read_to_end(&file, most)?.into())
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        std::fs::read_dir(folder)
            .map(|entries| entries.filter_map(|e| e.ok().map(|e| e.file_name().into())).collect())
            .unwrap_or_default()
    }
}

fn check_ordinary(metadata: &Metadata) -> Result<(), Error> {
    if metadata.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    match special(metadata) {
        Some(refusal) => Err(refusal.into()),
        None => Ok(()),
    }
}

#[cfg(unix)]
fn special(metadata: &Metadata) -> Option<FileRefusal> {
    use std::os::unix::fs::FileTypeExt;
    let kind = metadata.file_type();
    if kind.is_char_device() || kind.is_block_device() {
        Some(FileRefusal::Device)
    } else if kind.is_fifo() {
        Some(FileRefusal::Pipe)
    } else if kind.is_socket() {
        Some(FileRefusal::Socket)
    } else {
        None
    }
}

#[cfg(not(unix))]
fn special(metadata: &Metadata) -> Option<FileRefusal> {
    (!metadata.is_file()).then_some(FileRefusal::Device)
}

/// Opens a file so that a pipe or a terminal in its place, put there a moment ago, neither waits nor takes over.
fn open_without_waiting(path: &Path) -> Result<File, Error> {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(libc::O_NONBLOCK | libc::O_NOCTTY);
    }
    options.open(path)
}

/// Reads a file whose size is 0: one that is being written may have grown since; one whose size is still 0 and that has
/// data is generated while it is read.
fn read_empty(file: &File, most: u64) -> Result<FileBytes, Error> {
    let mut bytes = Vec::new();
    // A few: some of these files can only be read in words.
    file.take(most.saturating_add(1).min(64)).read_to_end(&mut bytes)?;
    if !bytes.is_empty() && file.metadata()?.len() == 0 {
        return Err(FileRefusal::Generated.into());
    }
    let Some(left) = most.checked_sub(bytes.len() as u64) else { return Err(over(None, most)) };
    let rest = read_to_end(file, left).map_err(|error| match FileRefusal::in_error(&error) {
        Some(FileRefusal::OverLimit(_)) => over(None, most),
        _ => error,
    })?;
    bytes.extend(rest);
    Ok(bytes.into())
}

/// Reads the rest. One byte more than `most` is read to detect that it is too much.
fn read_to_end(reader: impl Read, most: u64) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    reader.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(over(None, most));
    }
    Ok(bytes)
}

fn over(needed: Option<u64>, most: u64) -> Error {
    FileRefusal::OverLimit(OverLimit { needed, left: most, limit: most }).into()
}

/// The name of an input that comes from standard input.
pub const STANDARD_INPUT: &str = "-";

/// The disk, with standard input as the file [`STANDARD_INPUT`], and the pipes among the inputs that a user named:
/// `/dev/stdin`, `/dev/fd/63`, which shells make of `<(command)`. Each of these is read to its end when first
/// needed, and kept, because it cannot be read twice.
#[derive(Default)]
pub struct DiskAndInput {
    /// The paths that may be pipes.
    inputs: Vec<PathBuf>,
    piped: Mutex<HashMap<PathBuf, Piped>>,
}

/// The content of a pipe.
type Piped = Result<Arc<Vec<u8>>, Failed>;

/// An error that can be returned more than once.
#[derive(Clone)]
enum Failed {
    Refused(FileRefusal),
    System(String),
}

impl DiskAndInput {
    /// The disk, where the paths among `inputs` may be pipes.
    pub fn new<'i>(inputs: impl IntoIterator<Item = &'i str>) -> Self {
        DiskAndInput { inputs: inputs.into_iter().map(PathBuf::from).collect(), piped: Mutex::default() }
    }

    fn may_be_read_as_pipe(&self, path: &Path) -> bool {
        path == Path::new(STANDARD_INPUT)
            || self.inputs.iter().any(|input| input == path)
                && std::fs::metadata(path).is_ok_and(|metadata| special(&metadata) == Some(FileRefusal::Pipe))
    }
}

impl FileSource for DiskAndInput {
    fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
        // Nothing that is done under the lock can leave it half done.
        let mut piped = self.piped.lock().unwrap_or_else(PoisonError::into_inner);
        if !piped.contains_key(path) && !self.may_be_read_as_pipe(path) {
            drop(piped);
            return Disk.read_within(path, most);
        }
        let read = piped.entry(path.to_owned()).or_insert_with(|| {
            read_pipe(path, most).map(Arc::new).map_err(|error| match FileRefusal::in_error(&error) {
                Some(refusal) => Failed::Refused(refusal.clone()),
                None => Failed::System(error.to_string()),
            })
        });
        match read {
            Ok(bytes) if bytes.len() as u64 > most => Err(over(Some(bytes.len() as u64), most)),
            Ok(bytes) => Ok(FileBytes::shared(bytes.clone())),
            Err(Failed::Refused(refusal)) => Err(refusal.clone().into()),
            Err(Failed::System(message)) => Err(Error::other(message.clone())),
        }
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        Disk.list(folder)
    }
}

fn read_pipe(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    if path == Path::new(STANDARD_INPUT) {
        return read_to_end(std::io::stdin().lock(), most);
    }
    read_to_end(File::open(path)?, most)
}
