//! Wavefront OBJ.

use crate::{Limits, Model, ReadError, Sidecars};

/// Reads an OBJ file; its material libraries are asked of `sidecars`.
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    let _ = (bytes, sidecars, limits);
    Err(ReadError::new("not written yet"))
}
