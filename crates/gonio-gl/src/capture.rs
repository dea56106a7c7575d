//! RenderDoc captures of a frame, through its in-application interface.
//!
//! RenderDoc records only what is called after it has intercepted OpenGL. On Linux it does so by coming before `dlopen` and
//! EGL in the dynamic linker's order, and that order is fixed when the program starts: a library that is loaded later, even
//! before EGL, records no context (tried with RenderDoc 1.24). So it must be in `LD_PRELOAD` ([`PRELOAD`]), and a program
//! that needs a capture restarts itself if [`is_loaded`] returns `false`. On Windows RenderDoc patches loaded libraries, so
//! [`load`] is enough if it is called before OpenGL. RenderDoc does not run on other systems; there every call is an error.
//!
//! A window captures one of its own pictures in the same way, if RenderDoc [`is_loaded`] since the program started.
#![cfg_attr(windows, allow(unsafe_code))]

pub use platform::{Capture, PRELOAD, hide_overlay, is_loaded, load, missing};

#[cfg(any(windows, target_os = "linux"))]
mod platform {
    use crate::{Gl, GlError};
    use renderdoc::{OverlayBits, RenderDoc, V112};
    use std::io::Write;
    use std::path::{Path, PathBuf};

    /// The environment variable that loads RenderDoc into a program, and its value, on systems where a running program
    /// cannot load it.
    pub const PRELOAD: Option<(&str, &str)> =
        if cfg!(target_os = "linux") { Some(("LD_PRELOAD", "librenderdoc.so")) } else { None };

    /// Whether RenderDoc is in this process.
    pub fn is_loaded() -> bool {
        RenderDoc::<V112>::new().is_ok()
    }

    /// Draws none of RenderDoc's text over the window. Its keys still capture whole frames.
    pub fn hide_overlay() {
        if let Ok(mut renderdoc) = RenderDoc::<V112>::new() {
            renderdoc.mask_overlay_bits(OverlayBits::NONE, OverlayBits::NONE);
        }
    }

    /// Loads RenderDoc into this process. The error explains how to install it. Always an error if [`PRELOAD`] is `Some`.
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

    /// The error that RenderDoc cannot be loaded, with a remedy.
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
        folder: PathBuf,
        /// Where RenderDoc writes the captures that its own keys start.
        template_before: PathBuf,
    }

    impl Capture {
        /// Connects to the loaded RenderDoc; call it before a context is created for the capture, so that an error comes early.
        /// Until this is dropped, captures are written to `folder`, under names that RenderDoc chooses.
        pub fn new(folder: &Path) -> Result<Self, GlError> {
            // The crate would panic over others.
            if folder.to_str().is_none() {
                return Err(GlError::new(format!(
                    "RenderDoc only writes to folders whose names are UTF-8, not to `{}`",
                    folder.display()
                )));
            }
            let mut renderdoc = RenderDoc::<V112>::new().map_err(|error| {
                GlError::new(format!("cannot take a capture: RenderDoc does not respond in this process ({error})"))
            })?;
            let template_before = renderdoc.get_capture_file_path_template().to_owned();
            renderdoc.set_capture_file_path_template(folder.join("capture"));
            let captures_before = renderdoc.get_num_captures();
            Ok(Capture { renderdoc, captures_before, folder: folder.to_owned(), template_before })
        }

        /// Begins the capture. It contains everything that the context does from now on, and the current contents of its objects.
        pub fn start(&mut self) {
            self.renderdoc.start_frame_capture(std::ptr::null::<std::ffi::c_void>(), std::ptr::null());
        }

        /// Ends the capture and returns its file. Fetch errors of OpenGL before: this clears the error flag.
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
                    "RenderDoc did not write a capture: it did not intercept the OpenGL context of this process, or the disk is full",
                ));
            }
            let (path, _) = self
                .renderdoc
                .get_capture(count - 1)
                .ok_or_else(|| GlError::new("RenderDoc did not report the path of its capture"))?;
            Ok(path)
        }

        /// Finds out whether the disk was full: RenderDoc does not report it and leaves half a capture, but then the disk is
        /// still full.
        pub fn check_room(&self) -> std::io::Result<()> {
            let probe = self.folder.join("room");
            let mut more = std::fs::File::create(&probe)?;
            let written = more.write_all(&[0; 1 << 16]).and_then(|()| more.sync_all());
            std::fs::remove_file(&probe)?;
            written
        }
    }

    impl Drop for Capture {
        fn drop(&mut self) {
            self.renderdoc.set_capture_file_path_template(&self.template_before);
        }
    }
}

#[cfg(not(any(windows, target_os = "linux")))]
mod platform {
    use crate::{Gl, GlError};
    use std::path::{Path, PathBuf};

    /// Nothing can be preloaded.
    pub const PRELOAD: Option<(&str, &str)> = None;

    /// Always `false`.
    pub fn is_loaded() -> bool {
        false
    }

    /// Does nothing.
    pub fn hide_overlay() {}

    /// Always an error.
    pub fn load() -> Result<(), GlError> {
        Err(missing())
    }

    /// RenderDoc does not run here.
    pub fn missing() -> GlError {
        GlError::new("cannot take a capture: RenderDoc does not run on this system, only on Linux and Windows")
    }

    /// A capture, which cannot be made on this system.
    pub struct Capture(());

    impl Capture {
        /// Always an error.
        pub fn new(_folder: &Path) -> Result<Self, GlError> {
            Err(missing())
        }

        /// Does nothing: no value of this type can be made.
        pub fn start(&mut self) {}

        /// Always an error.
        pub fn end(&mut self, _gl: &Gl) -> Result<PathBuf, GlError> {
            Err(missing())
        }

        /// Does nothing.
        pub fn check_room(&self) -> std::io::Result<()> {
            Ok(())
        }
    }
}
