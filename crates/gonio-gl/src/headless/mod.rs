//! Contexts without a window: by EGL on Linux and other Unixes, by CGL on macOS, by WGL and a hidden window on Windows. Any thread
//! may have them, and a process any number.

#[cfg(target_os = "macos")]
mod cgl;
#[cfg(all(unix, not(target_os = "macos")))]
mod egl;
#[cfg(windows)]
mod wgl;

#[cfg(target_os = "macos")]
use cgl::HeadlessPlatform;
#[cfg(all(unix, not(target_os = "macos")))]
use egl::HeadlessPlatform;
#[cfg(windows)]
use wgl::HeadlessPlatform;

use crate::{Gl, GlError, Remedy};
use std::path::PathBuf;
use std::sync::Arc;

/// The oldest OpenGL that the renderer runs on: 3.3 core.
pub const MINIMUM_VERSION: (u32, u32) = (3, 3);

/// Options of a context.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HeadlessOptions {
    /// The EGL library to load instead of `libEGL.so.1`. Ignored on Windows and macOS.
    pub egl_library: Option<PathBuf>,
    /// A debug context, which reports more and is slower.
    pub debug: bool,
    /// OpenGL ES 3, the native counterpart of WebGL2, instead of OpenGL. EGL only.
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

    /// A context with options.
    pub fn with_options(options: &HeadlessOptions) -> Result<Self, GlError> {
        let platform = HeadlessPlatform::new(options)?;
        let gl = Gl::keeping_alive(Arc::new(platform.functions()), platform);
        let (major, minor) = gl.version();
        let required = if options.es { (3, 0) } else { MINIMUM_VERSION };
        if (major, minor) < required {
            return Err(GlError::new(format!(
                "the driver offers OpenGL {major}.{minor}, but gonio needs at least {}.{}; install a newer driver, or \
                 Mesa's software driver",
                required.0, required.1
            ))
            .with_remedy(Remedy::CpuRenderer));
        }
        Ok(HeadlessContext { gl })
    }

    /// Starts the driver on another thread, so that the first context of this process is there sooner. Errors are those of
    /// opening that context, and are ignored here.
    pub fn start_driver(options: HeadlessOptions) {
        std::thread::spawn(move || {
            // Never dropped: ending a driver takes time too.
            Self::with_options(&options).map(std::mem::forget)
        });
    }

    /// The functions.
    pub fn gl(&self) -> &Gl {
        &self.gl
    }
}
