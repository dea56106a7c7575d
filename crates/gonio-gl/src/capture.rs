//! RenderDoc captures of a frame, through its in-application interface.
//!
//! RenderDoc records only what is called after it has intercepted OpenGL. On Linux it does so by coming before `dlopen` and
//! EGL in the dynamic linker's order, and that order is fixed when the program starts: a library that is loaded later, even
//! before EGL, records no context (tried with RenderDoc 1.24). So it must be in `LD_PRELOAD` ([`PRELOAD`]), and a program
//! that needs a capture restarts itself if [`is_loaded`] returns `false`. On Windows RenderDoc patches loaded libraries, so
//! [`load`] is enough if it is called before OpenGL. RenderDoc does not run on other systems; there every call is an error.
#![cfg_attr(windows, allow(unsafe_code))]

pub use platform::{Capture, PRELOAD, is_loaded, load, missing};

#[cfg(any(windows, target_os = "linux"))]
mod platform {
    use crate::{Gl, GlError};
    use renderdoc::{RenderDoc, V112};
    use std::path::{Path, PathBuf};

    /// The environment variable that brings RenderDoc into a program, and what has to be in it, where
    /// RenderDoc cannot be loaded when the program runs.
    pub const PRELOAD: Option<(&str, &str)> =
        if cfg!(target_os = "linux") { Some(("LD_PRELOAD", "librenderdoc.so")) } else { None };

    /// Whether RenderDoc is in this process.
    pub fn is_loaded() -> bool {
        RenderDoc::<V112>::new().is_ok()
    }

    /// Loads RenderDoc into this process; an error that says how to install it where there is none. Where
    /// [`PRELOAD`] is something, this is always an error.
    pub fn load() -> Result<(), GlError> {
        #[cfg(windows)]
        // SAFETY: loading a library runs its initialisers; RenderDoc is made to be loaded into any program.
        if let Ok(library) = unsafe { libloading::Library::new("renderdoc.dll") } {
            // It has patched other libraries by now, so it stays.
            std::mem::forget(library);
            return Ok(());
        }
        Err(missing())
    }

    /// RenderDoc cannot be loaded, and what to do.
    pub fn missing() -> GlError {
        GlError::new(if cfg!(windows) {
            "a capture needs RenderDoc, and renderdoc.dll could not be loaded; install RenderDoc and put its folder into PATH"
        } else {
            "a capture needs RenderDoc, and librenderdoc.so could not be loaded; on Debian: apt-get install librenderdoc"
        })
    }

    /// RenderDoc in this process, with a place to write to.
    pub struct Capture {
        renderdoc: RenderDoc<V112>,
        captures_before: u32,
    }

    impl Capture {
        /// Takes hold of the loaded RenderDoc; before [`crate::HeadlessContext::new`], so that an error comes
        /// early. Captures become files in `folder`, under names that RenderDoc chooses.
        pub fn new(folder: &Path) -> Result<Self, GlError> {
            // The crate would panic over others.
            if folder.to_str().is_none() {
                return Err(GlError::new(format!(
                    "RenderDoc only writes to folders whose names are UTF-8, not to `{}`",
                    folder.display()
                )));
            }
            let mut renderdoc = RenderDoc::<V112>::new().map_err(|why| {
                GlError::new(format!("RenderDoc does not answer in this process ({why}), so no capture can be taken"))
            })?;
            renderdoc.set_capture_file_path_template(folder.join("capture"));
            let captures_before = renderdoc.get_num_captures();
            Ok(Capture { renderdoc, captures_before })
        }

        /// Begins the capture: everything that the context does from here on is in it; what its objects hold
        /// by now is kept as well.
        pub fn start(&mut self) {
            self.renderdoc.start_frame_capture(std::ptr::null::<std::ffi::c_void>(), std::ptr::null());
        }

        /// Ends the capture of what this context did and tells which file it is in. Errors of OpenGL are to be
        /// asked for before: its error flag is clear afterwards.
        pub fn end(&mut self, gl: &Gl) -> Result<PathBuf, GlError> {
            self.renderdoc.end_frame_capture(std::ptr::null::<std::ffi::c_void>(), std::ptr::null());
            // For a preview RenderDoc reads a window's picture, and where there is no window that raises an
            // error (GL_INVALID_FRAMEBUFFER_OPERATION, RenderDoc 1.24), which is none of ours. A driver has one
            // flag, or one for each of its parts.
            for _ in 0..8 {
                if gl.get_error() == glow::NO_ERROR {
                    break;
                }
            }
            let count = self.renderdoc.get_num_captures();
            if count <= self.captures_before {
                return Err(GlError::new(
                    "RenderDoc wrote no capture: either it has not seen this process's OpenGL context, or its folder is full",
                ));
            }
            let (path, _) = self
                .renderdoc
                .get_capture(count - 1)
                .ok_or_else(|| GlError::new("RenderDoc does not say where its capture is"))?;
            Ok(path)
        }
    }
}

#[cfg(not(any(windows, target_os = "linux")))]
mod platform {
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
}
