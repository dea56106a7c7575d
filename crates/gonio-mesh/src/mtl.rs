//! Wavefront MTL.

use crate::{Diagnostic, Material};

/// Reads a material library. Nothing in one is fatal: what cannot be understood is a warning.
pub fn read(bytes: &[u8]) -> (Vec<Material>, Vec<Diagnostic>) {
    let _ = bytes;
    (Vec::new(), Vec::new())
}
