//! Files that a model file names: material libraries, buffers.

use serde::Serialize;

/// Where a reader gets the files that a model file names.
pub trait Sidecars {
    /// The file that a model calls `name` (as written there: relative, perhaps with backslashes or in the wrong
    /// case), or the places that were looked at in vain.
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar>;
}

/// A file that a model names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sidecar {
    /// Where it was found, as the user knows it.
    pub path: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// No such file, or none that may be read; where it was sought.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MissingSidecar {
    /// Every place looked at, in order.
    pub tried: Vec<String>,
    /// The reason for which a file that exists was not read, as a sentence that names it: it is a pipe, it is too large.
    pub refused: Option<String>,
}

/// For models that stand alone, and for tests: nothing is found.
pub struct NoSidecars;

impl Sidecars for NoSidecars {
    fn read(&mut self, _name: &str) -> Result<Sidecar, MissingSidecar> {
        Err(MissingSidecar::default())
    }
}

/// A file that a model named, and what became of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SidecarUse {
    /// As written in the model.
    pub name: String,
    /// The line of the model that names it, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Where it was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<String>,
    /// Where it was sought in vain.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tried: Vec<String>,
    /// The reason for which a file that exists was not read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
}

impl SidecarUse {
    /// Asks `sidecars` for `name`, and remembers the answer.
    pub fn ask(sidecars: &mut dyn Sidecars, name: &str, line: Option<u64>) -> (Self, Option<Vec<u8>>) {
        let unanswered = SidecarUse { name: name.to_owned(), line, found: None, tried: Vec::new(), refused: None };
        match sidecars.read(name) {
            Ok(Sidecar { path, bytes }) => (SidecarUse { found: Some(path), ..unanswered }, Some(bytes)),
            Err(MissingSidecar { tried, refused }) => (SidecarUse { tried, refused, ..unanswered }, None),
        }
    }
}
