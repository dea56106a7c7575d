//! A context without a window: through EGL on Linux and other Unixes, through glutin's own routes
//! (a hidden window) on Windows and macOS.

#[cfg(all(unix, not(target_os = "macos")))]
mod egl;
#[cfg(any(windows, target_os = "macos"))]
mod glutin_window;

#[cfg(all(unix, not(target_os = "macos")))]
use egl::Platform;
#[cfg(any(windows, target_os = "macos"))]
use glutin_window::Platform;

use crate::{Gl, GlError};
use std::path::PathBuf;
use std::sync::Arc;

/// The oldest OpenGL that the renderer runs on: 3.3 core.
pub const MINIMUM_VERSION: (u32, u32) = (3, 3);

/// How a context is made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HeadlessOptions {
    /// EGL's library by another name than `libEGL.so.1`. Unused where EGL is not the way.
    pub egl_library: Option<PathBuf>,
    /// A context that checks more and says more; slower.
    pub debug: bool,
    /// OpenGL ES 3 instead of OpenGL: what a browser's WebGL2 is, natively. EGL only.
    pub es: bool,
}

/// A current OpenGL context without a window; it ends when this and every [`Gl`] from it is dropped.
pub struct HeadlessContext {
    gl: Gl,
}

impl HeadlessContext {
    /// OpenGL 3.3 core or later. Errors name what is missing and how to install it.
    pub fn new() -> Result<Self, GlError> {
        Self::with_options(&HeadlessOptions::default())
    }

    /// The same with options.
    pub fn with_options(options: &HeadlessOptions) -> Result<Self, GlError> {
        let platform = Platform::new(options)?;
        let gl = Gl::keeping_alive(Arc::new(platform.functions()), platform);
        let (major, minor) = gl.version();
        let wanted = if options.es { (3, 0) } else { MINIMUM_VERSION };
        if (major, minor) < wanted {
            return Err(GlError::new(format!(
                "the driver offers OpenGL {}.{}, and {}.{} is the least that gonio needs; a newer driver \
                 (or Mesa's software one) would do, and `--backend cpu` needs none",
                major, minor, wanted.0, wanted.1
            )));
        }
        Ok(HeadlessContext { gl })
    }

    /// The functions.
    pub fn gl(&self) -> &Gl {
        &self.gl
    }
}
