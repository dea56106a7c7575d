//! RenderDoc captures of a frame, through its in-application interface.

use crate::GlError;
use renderdoc::{RenderDoc, V112};
use std::path::{Path, PathBuf};

/// RenderDoc, loaded into this process.
pub struct Capture {
    renderdoc: RenderDoc<V112>,
    captures_before: u32,
}

impl Capture {
    /// Loads RenderDoc. Its hooks only see contexts that are made afterwards, so this comes before
    /// [`crate::HeadlessContext::new`]. Captures are written beside `target`.
    pub fn load(target: &Path) -> Result<Self, GlError> {
        let mut renderdoc = RenderDoc::<V112>::new().map_err(|why| {
            GlError::new(format!(
                "a capture needs RenderDoc, and librenderdoc.so could not be loaded ({why}); on Debian: \
                 apt-get install librenderdoc"
            ))
        })?;
        renderdoc.set_capture_file_path_template(target.with_extension(""));
        let captures_before = renderdoc.get_num_captures();
        Ok(Capture { renderdoc, captures_before })
    }

    /// Begins the capture: everything that the context does from here on is in it.
    pub fn start(&mut self) {
        self.renderdoc.start_frame_capture(std::ptr::null::<std::ffi::c_void>(), std::ptr::null());
    }

    /// Ends the capture and tells which file it is in.
    pub fn end(&mut self) -> Result<PathBuf, GlError> {
        self.renderdoc.end_frame_capture(std::ptr::null::<std::ffi::c_void>(), std::ptr::null());
        let count = self.renderdoc.get_num_captures();
        if count <= self.captures_before {
            return Err(GlError::new(
                "RenderDoc wrote no capture: it has not seen this process's OpenGL context",
            ));
        }
        let (path, _) = self
            .renderdoc
            .get_capture(count - 1)
            .ok_or_else(|| GlError::new("RenderDoc does not say where its capture is"))?;
        Ok(path)
    }
}
