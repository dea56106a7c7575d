//! Errors of OpenGL.

use std::fmt;

/// An error of OpenGL or of a driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GlError {
    /// What went wrong and where, and what to do about it: one sentence. After it, a driver's log may follow.
    pub message: String,
    /// What would help besides, in a program that offers it.
    pub remedy: Option<Remedy>,
}

/// What a program can do about an error, if it has an option for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Drawing on the CPU, which needs no OpenGL.
    CpuRenderer,
    /// A picture of fewer pixels, or fewer samples per pixel.
    SmallerPicture,
}

impl GlError {
    /// An error with this sentence.
    pub fn new(message: impl Into<String>) -> Self {
        GlError { message: message.into(), remedy: None }
    }

    /// The same error with a remedy.
    pub fn with_remedy(self, remedy: Remedy) -> Self {
        GlError { remedy: Some(remedy), ..self }
    }
}

impl fmt::Display for GlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for GlError {}
