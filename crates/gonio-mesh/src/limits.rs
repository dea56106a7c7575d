//! How much a file may make a reader allocate.

use crate::ReadError;

/// How much a file may make a reader allocate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most vertices after splitting (`u32` indices set the default).
    pub max_vertices: u64,
    /// Most triangles.
    pub max_triangles: u64,
    /// Most bytes that a compressed file may unpack to, and that arrays may take which the file asks for without
    /// holding them itself.
    pub max_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { max_vertices: u32::MAX as u64, max_triangles: u32::MAX as u64 / 3, max_bytes: 8 << 30 }
    }
}

// Which of these a reader can exceed, and when it can tell, is its own affair; what it says then is not.

#[cold]
pub(crate) fn too_many_triangles(most: u64) -> ReadError {
    ReadError::new(format!("holds more than {most} triangles, which is the limit"))
}

#[cold]
pub(crate) fn too_many_vertices(most: u64) -> ReadError {
    ReadError::new(format!("needs more than {most} vertices, which is the limit"))
}
