//! A context without a window.

use crate::GlError;
use std::rc::Rc;

/// A current OpenGL context without a window; it ends when this is dropped.
pub struct HeadlessContext {
    gl: Rc<glow::Context>,
}

impl HeadlessContext {
    /// OpenGL 3.3 core or later. Errors name what is missing and how to install it.
    pub fn new() -> Result<Self, GlError> {
        Err(GlError::new("not written yet"))
    }

    /// The functions.
    pub fn gl(&self) -> &Rc<glow::Context> {
        &self.gl
    }
}
