//! Exercise 02: the vertex buffer that a student's own OBJ reader wrote, against what gonio-mesh reads.
//!
//! A buffer comes in whichever format ([`read_buffer`]) and order. It is compared with the model's triangles as a set;
//! where it differs, it is held against the buffers of readers that make one known mistake, then of readers that make
//! two ([`compare`]). A mistake is named only if its reader makes the student's buffer.

mod buffer;
mod compare;
mod cut;
mod expected;
mod fit;
mod formats;
mod json;
mod keys;
mod mistakes;
mod obj_lines;
mod reader;
mod same;
mod table;
#[cfg(test)]
mod tests;

pub use buffer::{Attributes, Buffer, BufferError, Vertex};
pub use compare::{BufferFindings, BufferMistake, Example, Shares, choose, compare};
pub use expected::Expected;
pub use formats::{MOST_BYTES, read_buffer};
pub use mistakes::{MistakeName, names};

/// Endings of buffers among other files; raw floats have no beginning by which they could be known.
pub const ENDINGS: [&str; 6] = [".csv", ".json", ".bin", ".raw", ".f32", ".tsv"];
