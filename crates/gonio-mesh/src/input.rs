//! The input of a reader: limits on memory, and the files that a model file refers to.

use crate::ReadError;
use serde::Serialize;

/// Limits on the memory that a file can make a reader allocate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most vertices after splitting (the default is given by `u32` indices).
    pub max_vertices: u64,
    /// Most triangles.
    pub max_triangles: u64,
    /// Most bytes that an unpacked file may have, and that may be allocated for arrays whose size the file declares
    /// without containing them. A program that reads several files for one input divides this among them.
    pub max_bytes: u64,
}

/// A default that suits most machines; a program that knows the available memory sets a share of it instead.
pub const DEFAULT_MAX_BYTES: u64 = if usize::BITS >= 64 { 2 << 30 } else { 1 << 30 };

impl Default for Limits {
    fn default() -> Self {
        Limits { max_vertices: u32::MAX as u64, max_triangles: u32::MAX as u64 / 3, max_bytes: DEFAULT_MAX_BYTES }
    }
}

// Each reader decides which limits it can exceed and when it notices; the messages are shared.

#[cold]
pub(crate) fn too_many_triangles(most: u64) -> ReadError {
    ReadError::new(format!("contains more than {most} triangles, which is the limit"))
}

#[cold]
pub(crate) fn too_many_vertices(most: u64) -> ReadError {
    ReadError::new(format!("needs more than {most} vertices, which is the limit"))
}

/// Provides the files that a model file refers to.
pub trait Sidecars {
    /// Reads the file that a model calls `name` (as written there: relative, perhaps with backslashes or in the wrong
    /// case). Fails with the places that were tried.
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar>;
}

/// A file that a model refers to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sidecar {
    /// Its path as the user knows it.
    pub path: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// A file that does not exist or may not be read, and the places that were tried.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MissingSidecar {
    /// All places that were tried, in order.
    pub tried: Vec<String>,
    /// The reason why an existing file was not read, as a sentence that names it: it is a pipe, it is too large.
    pub refused: Option<String>,
}

/// A source without files, for models in a single file and for tests.
pub struct NoSidecars;

impl Sidecars for NoSidecars {
    fn read(&mut self, _name: &str) -> Result<Sidecar, MissingSidecar> {
        Err(MissingSidecar::default())
    }
}

/// A file that a model refers to, and whether it was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SidecarUse {
    /// The name as written in the model.
    pub name: String,
    /// The line of the model that refers to it, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// The path where it was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<String>,
    /// The paths that were tried in vain.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tried: Vec<String>,
    /// The reason why an existing file was not read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
}

impl SidecarUse {
    /// Requests `name` from `sidecars` and records the answer.
    pub fn ask(sidecars: &mut dyn Sidecars, name: &str, line: Option<u64>) -> (Self, Option<Vec<u8>>) {
        let unanswered = SidecarUse { name: name.to_owned(), line, found: None, tried: Vec::new(), refused: None };
        match sidecars.read(name) {
            Ok(Sidecar { path, bytes }) => (SidecarUse { found: Some(path), ..unanswered }, Some(bytes)),
            Err(MissingSidecar { tried, refused }) => (SidecarUse { tried, refused, ..unanswered }, None),
        }
    }
}
