//! RenderDoc captures of the window's pictures.

use super::storage::{could_not_be_written, hidden_beside};
use crate::platform::CaptureAccess;
use gonio_gl::capture::{self, Capture};
use gonio_gl::{Gl, GlError};
use std::path::{Path, PathBuf};

/// Whether RenderDoc is in this process.
pub fn access() -> CaptureAccess {
    if !cfg!(any(windows, target_os = "linux")) {
        CaptureAccess::Unsupported
    } else if capture::is_loaded() {
        CaptureAccess::Ready
    } else {
        CaptureAccess::NotLoaded
    }
}

/// Captures what `draw` does. RenderDoc writes into a hidden folder beside `place`, and the finished capture is renamed, so that a
/// failure leaves the file as it was. An error is one sentence.
pub fn write(place: &Path, gl: &Gl, draw: &mut dyn FnMut() -> Result<(), GlError>) -> Result<(), String> {
    if let Some(obstacle) = access().obstacle() {
        return Err(obstacle.into());
    }
    let folder = hidden_beside(place)?;
    std::fs::create_dir(&folder).map_err(|error| could_not_be_written(place, &error))?;
    let written = write_within(&folder, place, gl, draw);
    // A folder that cannot be removed is not worth an error.
    let _ = std::fs::remove_dir_all(&folder);
    written
}

fn write_within(
    folder: &Path,
    place: &Path,
    gl: &Gl,
    draw: &mut dyn FnMut() -> Result<(), GlError>,
) -> Result<(), String> {
    let sentence = |error: GlError| error.to_string();
    let mut capture = Capture::new(folder).map_err(sentence)?;
    capture.start();
    let drawn = draw();
    // It ends even if drawing failed, because it could not be started again.
    let finished: Result<PathBuf, GlError> = capture.end(gl);
    drawn.map_err(sentence)?;
    let finished = finished.map_err(sentence)?;
    let renamed = capture.check_room().and_then(|()| std::fs::rename(finished, place));
    renamed.map_err(|error| could_not_be_written(place, &error))
}
