//! The error of environments.

use gonio_image::ImageError;
use std::fmt;

/// Describes why an environment could not be read, made or written: one sentence with the fault and the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnvironmentError {
    /// The name of the file as the user knows it, if the error concerns one.
    pub file: Option<String>,
    /// One sentence without a final full stop.
    pub message: String,
    /// Whether a larger limit on memory would help.
    pub over_limit: bool,
}

impl EnvironmentError {
    /// Creates an error that does not name a file yet.
    pub fn new(message: impl Into<String>) -> Self {
        EnvironmentError { file: None, message: message.into(), over_limit: false }
    }

    /// Names the file, unless one is named already.
    pub fn in_file(mut self, file: &str) -> Self {
        self.file.get_or_insert_with(|| file.to_owned());
        self
    }
}

impl fmt::Display for EnvironmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for EnvironmentError {}

impl From<ImageError> for EnvironmentError {
    fn from(ImageError { file, message, over_limit }: ImageError) -> Self {
        EnvironmentError { file, message, over_limit }
    }
}
