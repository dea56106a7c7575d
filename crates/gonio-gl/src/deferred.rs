//! OpenGL that is opened when it is first used.

use crate::{Dialect, Gl, GlError};
use std::cell::{Cell, OnceCell};

/// Opens a context, once.
type Open = Box<dyn FnOnce() -> Result<Gl, GlError>>;

/// OpenGL of a known dialect that may not be open yet: starting a driver takes tens of milliseconds, and work that needs
/// none can precede it.
pub struct DeferredGl {
    dialect: Dialect,
    gl: OnceCell<Gl>,
    open: Cell<Option<Open>>,
    /// Why it could not be opened.
    error: OnceCell<GlError>,
}

impl From<&Gl> for DeferredGl {
    /// OpenGL that is open already.
    fn from(gl: &Gl) -> Self {
        let dialect = gl.dialect();
        DeferredGl { dialect, gl: OnceCell::from(gl.clone()), open: Cell::default(), error: OnceCell::new() }
    }
}

impl DeferredGl {
    /// OpenGL that `open` opens, with this dialect.
    pub fn new(dialect: Dialect, open: impl FnOnce() -> Result<Gl, GlError> + 'static) -> Self {
        let open: Open = Box::new(open);
        DeferredGl { dialect, gl: OnceCell::new(), open: Cell::new(Some(open)), error: OnceCell::new() }
    }

    /// The dialect of GLSL that the context compiles.
    pub fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// The OpenGL, which is opened on the first call.
    ///
    /// # Errors
    /// Those of opening it, on every call.
    pub fn get(&self) -> Result<&Gl, GlError> {
        if let Some(open) = self.open.take() {
            match open() {
                Ok(gl) => drop(self.gl.set(gl)),
                Err(error) => drop(self.error.set(error)),
            }
        }
        self.gl.get().ok_or_else(|| self.error.get().cloned().unwrap_or_else(|| GlError::new("OpenGL is not open")))
    }
}
