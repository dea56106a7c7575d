//! How much a file may make a reader allocate.

use crate::ReadError;

/// How much a file may make a reader allocate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most vertices after splitting (`u32` indices set the default).
    pub max_vertices: u64,
    /// Most triangles.
    pub max_triangles: u64,
    /// Most bytes that a file may have when it is unpacked, and that arrays may take which the file asks for without
    /// holding them itself. A program that reads several files for one input shares this among them.
    pub max_bytes: u64,
}

/// A default that suits most machines; a program that knows the memory of its own gives a share of it instead.
pub const DEFAULT_MAX_BYTES: u64 = if usize::BITS >= 64 { 2 << 30 } else { 1 << 30 };

impl Default for Limits {
    fn default() -> Self {
        Limits { max_vertices: u32::MAX as u64, max_triangles: u32::MAX as u64 / 3, max_bytes: DEFAULT_MAX_BYTES }
    }
}

// Which of these a reader can exceed, and when it can tell, is its own affair; what it says then is not.

#[cold]
pub(crate) fn too_many_triangles(most: u64) -> ReadError {
    ReadError::new(format!("contains more than {most} triangles, which is the limit"))
}

#[cold]
pub(crate) fn too_many_vertices(most: u64) -> ReadError {
    ReadError::new(format!("needs more than {most} vertices, which is the limit"))
}
