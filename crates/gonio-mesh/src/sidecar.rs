//! Files that a model file refers to: material libraries, buffers.

use serde::Serialize;

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
