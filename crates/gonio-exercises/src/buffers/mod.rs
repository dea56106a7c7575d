//! Exercise 02: the vertex buffer that a student's own OBJ reader wrote, against what gonio-mesh reads.
//!
//! A buffer comes in whichever format ([`read_buffer`]) and order. It is compared with the model's triangles as a set;
//! where it differs, it is held against the buffers of readers that make one known mistake, then of readers that make
//! two ([`compare`]). A mistake is named only if its reader makes the student's buffer.

mod buffer;
mod compare;
mod cut;
mod error;
mod expected;
mod findings;
mod fit;
mod json;
mod keys;
mod mistakes;
mod obj_lines;
mod raw;
mod reader;
mod same;
mod table;
#[cfg(test)]
mod tests;
mod vertex;

pub use buffer::{Buffer, MOST_BYTES, read_buffer};
pub use compare::{choose, compare};
pub use error::BufferError;
pub use expected::Expected;
pub use findings::{BufferFindings, BufferMistake, Example, Shares};
pub use mistakes::{MistakeName, names};
pub use vertex::{Attributes, Vertex};

/// Endings of buffers among other files; raw floats have no beginning by which they could be known.
pub const ENDINGS: [&str; 6] = [".csv", ".json", ".bin", ".raw", ".f32", ".tsv"];
