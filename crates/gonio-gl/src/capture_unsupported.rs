//! RenderDoc captures where RenderDoc does not run: asking for one is an error that says so.

use crate::GlError;
use std::path::{Path, PathBuf};

/// RenderDoc, which there is not here; see `capture.rs` for the real one.
pub struct Capture(());

impl Capture {
    /// Always an error.
    pub fn load(_target: &Path) -> Result<Self, GlError> {
        Err(unsupported())
    }

    /// Nothing: no value of this type can be made.
    pub fn start(&mut self) {}

    /// Always an error.
    pub fn end(&mut self) -> Result<PathBuf, GlError> {
        Err(unsupported())
    }
}

fn unsupported() -> GlError {
    GlError::new("RenderDoc does not run on this system, so no capture can be taken; Linux and Windows have it")
}
