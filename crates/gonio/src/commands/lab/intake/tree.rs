//! Folders and archives as one tree, which is read on demand.
//!
//! Nothing here trusts its input: links are not followed, only regular files are opened, and an archive is unpacked entry by
//! entry, never beyond the sizes in its directory.

use crate::error::io_reason;
use gonio_app::files::zip;
use gonio_scene::files::{Disk, FileBytes, FileSource};
use std::ffi::OsStr;
use std::fs::{File, Metadata};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Larger files are not an answer to any exercise.
pub const MAX_FILE_BYTES: u64 = 32 << 20;
/// Most bytes of an archive within another, which must be unpacked as a whole.
const MAX_PACKED_ARCHIVE_BYTES: u64 = 256 << 20;
/// Entries of one folder or archive.
const MAX_ENTRIES: usize = 20_000;
/// Archives within archives.
const MAX_ARCHIVE_DEPTH: usize = 3;
/// Folders within folders in an archive.
const MAX_FOLDER_DEPTH: usize = 32;

/// A file, a folder or an archive, and its name without folders.
#[derive(Clone)]
pub struct Tree {
    /// The name, in which bytes that are not UTF-8 are written as `\xff`, so that different names stay different.
    pub name: String,
    node: Node,
    is_archive: bool,
}

#[derive(Clone)]
enum Node {
    Folder(PathBuf),
    File(PathBuf, u64),
    /// A file that came through a pipe.
    Piped(FileBytes),
    /// A file in an archive.
    Packed(Arc<Archive>, zip::ZipEntry),
    /// A folder in an archive.
    PackedFolder(Vec<Tree>),
    /// Something that is not read, and the reason.
    Unread(String),
}

/// The bytes of an archive, and the number of archives around it.
struct Archive {
    bytes: FileBytes,
    depth: usize,
}

impl Tree {
    /// Opens a path from the command line: links are followed, and a pipe is read.
    ///
    /// # Errors
    /// The reason why it cannot be read, without its path.
    pub fn open(path: &Path) -> Result<Tree, String> {
        let metadata = std::fs::metadata(path).map_err(|error| io_reason(&error))?;
        let name = shown(path.file_name().unwrap_or(path.as_os_str()));
        if is_device(&metadata) {
            return Err("it is a device, not a file".into());
        }
        if !metadata.is_dir() && !metadata.is_file() && !is_open_already(path) {
            return Err("it is a pipe or a socket, not a file".into());
        }
        if metadata.is_dir() {
            return Ok(Tree { name, node: Node::Folder(path.to_owned()), is_archive: false });
        }
        if metadata.is_file() {
            // Within a submission only the name makes an archive: `.docx` is one too, but not a folder of files.
            let mut start = Vec::new();
            let file = File::open(path).map_err(|error| io_reason(&error))?;
            file.take(4).read_to_end(&mut start).map_err(|error| io_reason(&error))?;
            let is_archive = zip::is_zip(&start) || has_archive_name(&name);
            return Ok(Tree { name, node: Node::File(path.to_owned(), metadata.len()), is_archive });
        }
        let bytes = read_bounded(path)?;
        Ok(Tree { name, is_archive: zip::is_zip(&bytes), node: Node::Piped(bytes.into()) })
    }

    fn new(name: String, node: Node) -> Tree {
        let is_archive = has_archive_name(&name) && matches!(node, Node::File(..) | Node::Packed(..));
        Tree { name, node, is_archive }
    }

    /// Whether it is a folder or an archive.
    pub fn is_container(&self) -> bool {
        self.is_archive || matches!(self.node, Node::Folder(_) | Node::PackedFolder(_))
    }

    /// The reason why it is not read, if it is not.
    pub fn unread(&self) -> Option<&str> {
        match &self.node {
            Node::Unread(reason) => Some(reason),
            _ => None,
        }
    }

    /// The size of a file in bytes; 0 for everything else.
    pub fn size(&self) -> u64 {
        match &self.node {
            Node::File(_, size) => *size,
            Node::Packed(_, entry) => entry.size,
            _ => 0,
        }
    }

    /// The entries of a folder or an archive, by name.
    ///
    /// # Errors
    /// The reason why they cannot be read, as half a sentence.
    pub fn children(&self) -> Result<Vec<Tree>, String> {
        match &self.node {
            Node::Folder(path) => folder_entries(path),
            Node::PackedFolder(children) => Ok(children.clone()),
            Node::Unread(reason) => Err(reason.clone()),
            Node::Piped(bytes) => archive_entries(Archive { bytes: bytes.clone(), depth: 0 }),
            Node::File(path, _) => {
                let bytes = Disk.read(path).map_err(|error| io_reason(&error))?;
                archive_entries(Archive { bytes, depth: 0 })
            }
            Node::Packed(archive, _) if archive.depth >= MAX_ARCHIVE_DEPTH => {
                Err(format!("it is nested in more than {MAX_ARCHIVE_DEPTH} archives"))
            }
            Node::Packed(_, entry) if entry.size > MAX_PACKED_ARCHIVE_BYTES => {
                Err(format!("it is an archive of more than {} MiB inside another", MAX_PACKED_ARCHIVE_BYTES >> 20))
            }
            Node::Packed(archive, entry) => {
                let bytes = entry.unpack(&archive.bytes)?.into();
                archive_entries(Archive { bytes, depth: archive.depth + 1 })
            }
        }
    }

    /// The content of a file, at most [`MAX_FILE_BYTES`].
    ///
    /// # Errors
    /// The reason why it cannot be read, as half a sentence.
    pub fn bytes(&self) -> Result<Vec<u8>, String> {
        match &self.node {
            Node::File(path, _) => read_bounded(path),
            Node::Packed(..) if self.size() > MAX_FILE_BYTES => Err(too_large()),
            Node::Packed(archive, entry) => entry.unpack(&archive.bytes),
            Node::Piped(bytes) => Ok(bytes.to_vec()),
            Node::Unread(reason) => Err(reason.clone()),
            Node::Folder(_) | Node::PackedFolder(_) => Err("it is a folder".into()),
        }
    }
}

fn has_archive_name(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"))
}

/// A name as text: bytes that are not UTF-8 as `\xff`.
pub fn shown(name: &OsStr) -> String {
    shown_bytes(name.as_encoded_bytes())
}

fn shown_bytes(bytes: &[u8]) -> String {
    let mut text = String::new();
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        chunk.invalid().iter().for_each(|byte| text.push_str(&format!("\\x{byte:02x}")));
    }
    text
}

fn node_of(path: &Path, metadata: &Metadata) -> Node {
    if metadata.is_dir() {
        Node::Folder(path.to_owned())
    } else if metadata.is_symlink() {
        Node::Unread("it is a link, and links are not followed".into())
    } else if metadata.is_file() {
        Node::File(path.to_owned(), metadata.len())
    } else {
        Node::Unread("it is a pipe or a device, not a file".into())
    }
}

fn folder_entries(folder: &Path) -> Result<Vec<Tree>, String> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(|error| io_reason(&error))? {
        names.push(entry.map_err(|error| io_reason(&error))?.file_name());
        if names.len() > MAX_ENTRIES {
            return Err(format!("it has more than {MAX_ENTRIES} entries"));
        }
    }
    names.sort();
    let tree = |name: &std::ffi::OsString| {
        let path = folder.join(name);
        let node = match std::fs::symlink_metadata(&path) {
            Ok(metadata) => node_of(&path, &metadata),
            Err(error) => Node::Unread(io_reason(&error)),
        };
        Tree::new(shown(name), node)
    };
    Ok(names.iter().map(tree).collect())
}

/// Reads a regular file up to the limit, whatever size its metadata states; also a pipe from the command line.
fn read_bounded(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| io_reason(&error))?;
    file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| io_reason(&error))?;
    if bytes.len() as u64 > MAX_FILE_BYTES { Err(too_large()) } else { Ok(bytes) }
}

fn too_large() -> String {
    format!("it is larger than {} MiB, the limit for one file", MAX_FILE_BYTES >> 20)
}

/// The files of an archive in their folders, in any order. Names that would lead out of it stay inside.
fn archive_entries(archive: Archive) -> Result<Vec<Tree>, String> {
    let entries = zip::entries(&archive.bytes, MAX_ENTRIES)?;
    let archive = Arc::new(archive);
    let mut top = Vec::new();
    for entry in entries.into_iter().filter(|entry| !entry.name.ends_with(b"/")) {
        let name = shown_bytes(&entry.name);
        let parts = name.split(['/', '\\']).filter(|part| !matches!(*part, "" | "." | ".."));
        let parts: Vec<String> = parts.map(str::to_owned).collect();
        if let [folders @ .., file] = parts.as_slice()
            && folders.len() <= MAX_FOLDER_DEPTH
        {
            let node = Node::Packed(archive.clone(), entry);
            insert(&mut top, folders, Tree::new(file.clone(), node));
        }
    }
    sort(&mut top);
    Ok(top)
}

fn insert(level: &mut Vec<Tree>, folders: &[String], tree: Tree) {
    let Some((first, rest)) = folders.split_first() else {
        return level.push(tree);
    };
    let at = level.iter().rposition(|known| known.name == *first && matches!(known.node, Node::PackedFolder(_)));
    let at = at.unwrap_or_else(|| {
        level.push(Tree::new(first.clone(), Node::PackedFolder(Vec::new())));
        level.len() - 1
    });
    if let Node::PackedFolder(children) = &mut level[at].node {
        insert(children, rest, tree);
    }
}

fn sort(level: &mut [Tree]) {
    level.sort_by(|a, b| a.name.cmp(&b.name));
    for tree in level {
        if let Node::PackedFolder(children) = &mut tree.node {
            sort(children);
        }
    }
}

/// Whether a shell made it for `<(...)`. Opening any other pipe could wait for a writer for ever.
fn is_open_already(path: &Path) -> bool {
    ["/dev/fd", "/dev/stdin", "/proc/self/fd"].iter().any(|place| path.starts_with(place))
}

#[cfg(unix)]
fn is_device(metadata: &Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    metadata.file_type().is_char_device() || metadata.file_type().is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: &Metadata) -> bool {
    false
}
