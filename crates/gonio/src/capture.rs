//! `--capture`: a RenderDoc capture of the first picture.

use crate::output::atomic;
use crate::report::CliError;
use gonio_gl::Gl;
use gonio_gl::capture::{self, Capture};
use std::convert::Infallible;
use std::io::Write;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// Set in the program that is started anew with RenderDoc in it, so that this happens once.
#[cfg(unix)]
const STARTED_ANEW: &str = "GONIO_STARTED_FOR_CAPTURE";

/// Puts RenderDoc into this process, which on Linux takes starting the program anew with `LD_PRELOAD`
/// (`gonio_gl::capture` says why): this process then becomes that program, with the same arguments,
/// number and streams, and this function does not return. Under `renderdoccmd capture`, which has done
/// so already, nothing happens.
///
/// Comes before anything is read or written; what is wrong with `target` or with the system is said
/// here.
pub fn prepare(target: &Path) -> Result<(), CliError> {
    if !target.extension().is_some_and(|e| e.eq_ignore_ascii_case("rdc")) {
        return Err(CliError::new(format!("`{}`: a capture is a .rdc file", target.display())));
    }
    atomic::check_writable(target)?;
    if capture::is_loaded() {
        return Ok(());
    }
    match capture::PRELOAD {
        Some((variable, library)) => match start_anew(variable, library)? {},
        None => Ok(capture::load()?),
    }
}

/// Returns only where that failed.
#[cfg(unix)]
fn start_anew(variable: &str, library: &str) -> Result<Infallible, CliError> {
    use std::os::unix::process::CommandExt;
    if std::env::var_os(STARTED_ANEW).is_some() {
        return Err(CliError::new(format!(
            "a capture needs RenderDoc, and {variable}={library} did not bring it into this program; \
             `renderdoccmd capture -w gonio ...` may"
        )));
    }
    let program = std::env::current_exe()
        .map_err(|e| CliError::io("a capture needs this program to be started anew, and its file is not known", &e))?;
    let failed = |e| CliError::io(format_args!("a capture needs `{}` to be started anew", program.display()), &e);
    // After what is there already: RenderDoc only has to come before the C library.
    let mut preloaded = std::env::var_os(variable).unwrap_or_default();
    if !preloaded.is_empty() {
        preloaded.push(":");
    }
    preloaded.push(library);
    let anew = || {
        let mut command = Command::new(&program);
        command.env(variable, &preloaded).env(STARTED_ANEW, "1");
        command
    };
    // A library that cannot be preloaded is only a complaint of the dynamic linker on stderr. It is
    // read here from a program that does nothing, so that nobody sees more than our sentence.
    let trial = anew().arg("--version").stdin(Stdio::null()).output().map_err(failed)?;
    if String::from_utf8_lossy(&trial.stderr).contains(library) {
        return Err(capture::missing().into());
    }
    let mut arguments = std::env::args_os();
    let mut command = anew();
    if let Some(name) = arguments.next() {
        command.arg0(name);
    }
    Err(failed(command.args(arguments).exec()))
}

#[cfg(not(unix))]
fn start_anew(variable: &str, library: &str) -> Result<Infallible, CliError> {
    Err(CliError::new(format!("a capture needs {variable}={library} to be set before gonio starts")))
}

/// A capture that is to be made.
pub struct Recorder {
    capture: Capture,
    target: PathBuf,
    /// Where RenderDoc writes, under names of its own; beside the target, so that a rename suffices.
    folder: TempDir,
}

impl Recorder {
    /// After [`prepare`], and before OpenGL is loaded.
    pub fn new(target: &Path) -> Result<Self, CliError> {
        let folder = atomic::folder_beside(target)?;
        Ok(Recorder { capture: Capture::new(folder.path())?, target: target.to_owned(), folder })
    }

    /// From here on everything that the context does is recorded.
    pub fn start(&mut self) {
        self.capture.start();
    }

    /// Puts the capture where it was asked for.
    pub fn finish(mut self, gl: &Gl) -> Result<(), CliError> {
        let written = self.capture.end(gl)?;
        self.check_room()
            .map_err(|e| CliError::io(format_args!("`{}` cannot be written", self.target.display()), &e))?;
        atomic::replace(&self.target, &written)?;
        // Its folder goes now; what could not be removed is not worth an error, for the capture is there.
        let _ = self.folder.close();
        Ok(())
    }

    /// RenderDoc does not say that a disk was full, and leaves half a capture; but then it still is full.
    fn check_room(&self) -> std::io::Result<()> {
        let mut more = tempfile::tempfile_in(self.folder.path())?;
        more.write_all(&[0; 1 << 16])?;
        more.sync_all()
    }
}
