//! `--capture`: a RenderDoc capture of the first picture.

use crate::error::CliError;
use crate::output::atomic;
use gonio_gl::Gl;
use gonio_gl::capture::{self, Capture};
use std::convert::Infallible;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// Set for the program that is restarted with RenderDoc in it, so that this happens only once.
#[cfg(unix)]
const RESTARTED: &str = "GONIO_RESTARTED_FOR_CAPTURE";

/// Loads RenderDoc into this process. On Linux that takes a restart of the program with `LD_PRELOAD` (`gonio_gl::capture`
/// explains why): this process becomes that program, with the same arguments, process id and streams, and this function does not
/// return. Under `renderdoccmd capture`, which has done so already, nothing happens.
///
/// Call it before anything is read or written. It reports what is wrong with `target` or with the system.
pub fn prepare(target: &Path) -> Result<(), CliError> {
    if !target.extension().is_some_and(|e| e.eq_ignore_ascii_case("rdc")) {
        return Err(CliError::new(format!("`{}`: captures are written as .rdc files only", target.display())));
    }
    atomic::check_writable(target)?;
    if capture::is_loaded() {
        return Ok(());
    }
    match capture::PRELOAD {
        Some((variable, library)) => match restart(variable, library)? {},
        None => Ok(capture::load()?),
    }
}

/// Restarts the program. Returns only if that failed.
#[cfg(unix)]
fn restart(variable: &str, library: &str) -> Result<Infallible, CliError> {
    use std::os::unix::process::CommandExt;
    if std::env::var_os(RESTARTED).is_some() {
        return Err(CliError::new(format!(
            "a capture needs RenderDoc, and {variable}={library} did not load it into this program; try \
             `renderdoccmd capture -w gonio ...`"
        )));
    }
    let program = std::env::current_exe()
        .map_err(|e| CliError::io("a capture needs a restart of this program, whose file is unknown", &e))?;
    let failed = |e| CliError::io(format_args!("a capture needs a restart of `{}`", program.display()), &e);
    // After other libraries: RenderDoc only has to precede the C library.
    let mut preloaded = std::env::var_os(variable).unwrap_or_default();
    if !preloaded.is_empty() {
        preloaded.push(":");
    }
    preloaded.push(library);
    let restarted = || {
        let mut command = Command::new(&program);
        command.env(variable, &preloaded).env(RESTARTED, "1");
        command
    };
    // The dynamic linker reports a library that cannot be preloaded on stderr. Its message is caught here, from a program that
    // does nothing else, so that ours is the only one.
    let trial = restarted().arg("-V").stdin(Stdio::null()).output().map_err(failed)?;
    if String::from_utf8_lossy(&trial.stderr).contains(library) {
        return Err(capture::missing().into());
    }
    let mut arguments = std::env::args_os();
    let mut command = restarted();
    if let Some(name) = arguments.next() {
        command.arg0(name);
    }
    Err(failed(command.args(arguments).exec()))
}

#[cfg(not(unix))]
fn restart(variable: &str, library: &str) -> Result<Infallible, CliError> {
    Err(CliError::new(format!("a capture needs {variable}={library} to be set before gonio starts")))
}

/// A capture of one picture.
pub struct CaptureRecorder {
    capture: Capture,
    target: PathBuf,
    /// The folder where RenderDoc writes, under names of its own; beside the target, so that a rename suffices.
    folder: TempDir,
}

impl CaptureRecorder {
    /// Must come after [`prepare`], and before OpenGL is loaded.
    pub fn new(target: &Path) -> Result<Self, CliError> {
        let folder = atomic::folder_beside(target)?;
        Ok(CaptureRecorder { capture: Capture::new(folder.path())?, target: target.to_owned(), folder })
    }

    /// Starts the recording of everything that the context does.
    pub fn start(&mut self) {
        self.capture.start();
    }

    /// Moves the capture to its target.
    pub fn finish(mut self, gl: &Gl) -> Result<(), CliError> {
        let written = self.capture.end(gl)?;
        self.capture
            .check_room()
            .map_err(|e| CliError::io(format_args!("`{}` cannot be written", self.target.display()), &e))?;
        atomic::replace(&self.target, &written)?;
        // A folder that cannot be removed is not worth an error: the capture exists.
        let _ = self.folder.close();
        Ok(())
    }
}
