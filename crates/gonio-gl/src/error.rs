//! What can go wrong with OpenGL.

use std::fmt;

/// One sentence: what went wrong, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GlError {
    /// The sentence.
    pub message: String,
}

impl GlError {
    /// An error with this sentence.
    pub fn new(message: impl Into<String>) -> Self {
        GlError { message: message.into() }
    }
}

impl fmt::Display for GlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for GlError {}
