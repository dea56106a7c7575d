//! Limits on the memory that a file can make a reader allocate.

use crate::ReadError;

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
