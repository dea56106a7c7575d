//! Why an environment could not be read, made or written.

use gonio_image::ImageError;
use std::fmt;

/// Why an environment could not be read, made or written: one sentence that says what is wrong and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnvironmentError {
    /// Which file, as the user knows it, where it is about one.
    pub file: Option<String>,
    /// One sentence, without final full stop.
    pub message: String,
    /// Whether a larger limit on memory would help.
    pub over_limit: bool,
}

impl EnvironmentError {
    /// An error that names no file yet.
    pub fn new(message: impl Into<String>) -> Self {
        EnvironmentError { file: None, message: message.into(), over_limit: false }
    }

    /// The same about a named file, where none is named yet.
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
