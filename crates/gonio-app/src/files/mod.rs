//! Files from the user: dropped, chosen, in a zip file or in a link.
//!
//! | file | what |
//! |---|---|
//! | `memory` | files that lie in memory, with folders |
//! | `layered` | one place of files over another |
//! | `recording` | which files were read, so that they can be watched |
//! | `zip`, `packed` | what a zip holds; files as a zip |
//! | `exercise_file` | a file of an exercise, with its place |
//! | `gathered` | which of several files is the model |
//! | `link` | a scene in the address of a page |

mod exercise_file;
mod gathered;
mod layered;
pub mod link;
mod memory;
mod packed;
mod recording;
pub mod zip;

pub use exercise_file::ExerciseFile;
pub use gathered::{Gathered, gather};
pub use layered::Layered;
pub use memory::MemoryFiles;
pub use packed::pack;
pub use recording::Recording;
