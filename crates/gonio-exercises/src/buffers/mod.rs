//! Exercise 02: compares the vertex buffer of a student's OBJ reader with what gonio-mesh reads.
//!
//! A buffer may have any known format ([`read_buffer`]) and order. It is compared with the model's triangles as a set. If it
//! differs, it is compared with the buffers of readers that make one known mistake, then of readers that make two
//! ([`compare()`]). A mistake is named only if its reader produces the student's buffer.

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

/// Endings by which buffers are recognised among other files: raw floats have no signature.
pub const ENDINGS: [&str; 6] = [".csv", ".json", ".bin", ".raw", ".f32", ".tsv"];
