//! Files from the user: dropped, chosen, in a zip file or in a link.
//!
//! | file | contents |
//! |---|---|
//! | `memory` | files in memory, with folders |
//! | `sources` | one source before another; a record of the files that were read |
//! | `zip` | reading and writing zip files |
//! | `gathered` | finds the model among several files |
//! | `link` | a scene in the address of a page |

mod gathered;
pub mod link;
mod memory;
mod sources;
pub mod zip;

pub use gathered::{GatheredInputs, gather};
pub use memory::MemoryFiles;
pub use sources::{Layered, ReadRecorder};
pub use zip::pack;

use std::path::PathBuf;

/// A file of an exercise, with its path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExerciseFile {
    /// The name in the exercise.
    pub name: String,
    /// The path on disk; `None` for a file in memory.
    pub path: Option<PathBuf>,
    /// Its content.
    pub bytes: Vec<u8>,
}
