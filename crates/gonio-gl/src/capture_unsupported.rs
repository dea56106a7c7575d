//! RenderDoc captures where RenderDoc does not run: asking for one is an error that says so.

use crate::{Gl, GlError};
use std::path::{Path, PathBuf};

/// Nothing can be preloaded; see `capture.rs` for the real one.
pub const PRELOAD: Option<(&str, &str)> = None;

/// Never.
pub fn is_loaded() -> bool {
    false
}

/// Always an error.
pub fn load() -> Result<(), GlError> {
    Err(missing())
}

/// RenderDoc does not run here.
pub fn missing() -> GlError {
    GlError::new("RenderDoc does not run on this system, so no capture can be taken; Linux and Windows have it")
}

/// RenderDoc, which there is not here.
pub struct Capture(());

impl Capture {
    /// Always an error.
    pub fn new(_folder: &Path) -> Result<Self, GlError> {
        Err(missing())
    }

    /// Nothing: no value of this type can be made.
    pub fn start(&mut self) {}

    /// Always an error.
    pub fn end(&mut self, _gl: &Gl) -> Result<PathBuf, GlError> {
        Err(missing())
    }
}
