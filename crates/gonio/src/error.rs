//! How a command ends, and the options that help with an error or a warning: libraries do not know them.

use gonio_gallery::GalleryError;
use gonio_gl::{GlError, Remedy};
use gonio_image::ImageError;
use gonio_mesh::{Cause, ReadError};
use std::fmt::Display;
use std::io;

/// Outcome of a command that did not fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOutcome {
    /// Exit code 0.
    Done,
    /// A requested check failed: exit code 1.
    CheckFailed,
}

/// The reason why a command failed: exit code 2.
#[derive(Debug)]
pub enum CliError {
    /// One sentence: what is wrong, where, and what to do.
    Message(String),
    /// Several lines, as from a compiler.
    Lines(Vec<String>),
    /// The reader of stdout has gone. This counts as success and prints nothing.
    ClosedPipe,
    /// The process that did the work, or the panic hook, has printed the reason.
    AlreadyReported,
}

impl CliError {
    pub fn new(message: impl Into<String>) -> Self {
        CliError::Message(message.into())
    }

    pub fn lines(lines: impl IntoIterator<Item = String>) -> Self {
        CliError::Lines(lines.into_iter().collect())
    }

    /// `context`, followed by the system's reason.
    pub fn io(context: impl Display, error: &io::Error) -> Self {
        CliError::Message(format!("{context}: {}", io_reason(error)))
    }
}

impl Display for CliError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CliError::Message(message) => f.write_str(message),
            CliError::Lines(lines) => f.write_str(&lines.join("\n")),
            CliError::ClosedPipe => f.write_str("stdout was closed before everything was written"),
            CliError::AlreadyReported => f.write_str("the reason was printed before"),
        }
    }
}

impl From<ReadError> for CliError {
    fn from(error: ReadError) -> Self {
        CliError::Message(format!("{error}{}", hint(error.cause)))
    }
}

impl From<GalleryError> for CliError {
    fn from(error: GalleryError) -> Self {
        match error {
            GalleryError::Scene(error) => error.into(),
            GalleryError::OpenGl(error) => error.into(),
            other => CliError::new(other.to_string()),
        }
    }
}

impl From<ImageError> for CliError {
    fn from(error: ImageError) -> Self {
        CliError::new(error.to_string())
    }
}

impl From<GlError> for CliError {
    fn from(error: GlError) -> Self {
        // A driver's messages about a shader have several lines; those errors have no remedy.
        let message = format!("{}{}", error.message, opengl_hint(error.remedy));
        CliError::lines(message.lines().map(str::to_owned))
    }
}

/// The reason of an I/O error, without the system's number.
pub fn io_reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        io::ErrorKind::IsADirectory => "it is a folder".into(),
        io::ErrorKind::NotADirectory => "a part of the path is not a folder".into(),
        io::ErrorKind::StorageFull => "the disk is full".into(),
        io::ErrorKind::QuotaExceeded => "the disk quota is exceeded".into(),
        io::ErrorKind::FileTooLarge => "the file would become larger than this system allows".into(),
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".into(),
        _ => {
            let text = error.to_string();
            match text.find(" (os error") {
                Some(end) => text[..end].to_lowercase(),
                None => text,
            }
        }
    }
}

/// The hint after a message; empty if no option helps.
pub fn hint(cause: Option<Cause>) -> &'static str {
    match cause {
        None => "",
        Some(Cause::MemoryLimit) => "; --max-memory raises the limit",
        Some(Cause::Sandbox) => "; without --sandbox it is read",
        Some(Cause::EnvironmentAsModel) => " with --environment",
        Some(Cause::NoEnvironment) => "; add one with --environment",
        Some(Cause::GuessedLayout) => " with --environment-layout",
        Some(Cause::CoarseEnvironment) => " with --environment-size",
    }
}

/// The hint after a message about an OpenGL error; empty if no option helps.
pub fn opengl_hint(remedy: Option<Remedy>) -> &'static str {
    match remedy {
        None => "",
        Some(Remedy::CpuRenderer) => "; `--backend cpu` needs no OpenGL",
        Some(Remedy::SmallerPicture) => " (--size, --samples)",
    }
}
