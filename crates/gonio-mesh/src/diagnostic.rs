//! Diagnostics of a file: errors, which end the reading, and warnings and notes, which do not.

use serde::Serialize;
use std::fmt;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The file was read as intended.
    Note,
    /// Reading continued, but part of the file is lost or guessed.
    Warning,
}

/// A warning or note about a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Diagnostic {
    /// Its severity.
    pub severity: Severity,
    /// One sentence, without position and final full stop.
    pub message: String,
    /// The file as the user knows it; set by the code that opened it.
    pub file: Option<String>,
    /// The line, from 1.
    pub line: Option<u64>,
    /// The column in bytes, from 1.
    pub column: Option<u64>,
    /// The cause, where a setting of the program can remove it.
    #[serde(skip)]
    pub cause: Option<Cause>,
}

impl Diagnostic {
    /// Creates a warning without a position.
    pub fn warning(message: impl Into<String>) -> Self {
        Diagnostic {
            severity: Severity::Warning,
            message: message.into(),
            file: None,
            line: None,
            column: None,
            cause: None,
        }
    }

    /// Creates a note without a position.
    pub fn note(message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Note, ..Self::warning(message) }
    }

    /// Sets a cause that a setting can remove.
    pub fn caused_by(mut self, cause: Cause) -> Self {
        self.cause = Some(cause);
        self
    }

    /// Sets the line, and perhaps the column.
    pub fn at(mut self, line: u64, column: Option<u64>) -> Self {
        self.line = Some(line);
        self.column = column;
        self
    }

    /// Sets the file, unless it is already set.
    pub fn in_file(mut self, file: &str) -> Self {
        self.file.get_or_insert_with(|| file.to_owned());
        self
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_position(f, self.file.as_deref(), self.line, self.column)?;
        let severity = match self.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
        };
        write!(f, "{severity}: {}", self.message)
    }
}

/// A cause of an error or a warning that a setting of the program can remove. Messages do not mention the setting; a
/// program that has one adds a hint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The file needs more memory than [`Limits::max_bytes`](crate::Limits::max_bytes).
    MemoryLimit,
    /// The file is outside the folders that may be read.
    Sandbox,
    /// The file was named as a model, and it is an environment.
    EnvironmentAsModel,
    /// A scene needs an environment and has none.
    NoEnvironment,
    /// The layout of an environment's faces was guessed.
    GuessedLayout,
    /// A panorama was made into a coarser cubemap than it is.
    CoarseEnvironment,
}

/// The reason why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// One sentence: what is wrong and what to do.
    pub message: String,
    /// The file as the user knows it; set by the code that opened it.
    pub file: Option<String>,
    /// The line, from 1.
    pub line: Option<u64>,
    /// The column in bytes, from 1.
    pub column: Option<u64>,
    /// The cause, if a setting can remove it.
    pub cause: Option<Cause>,
}

impl ReadError {
    /// Creates an error without a position.
    pub fn new(message: impl Into<String>) -> Self {
        ReadError { message: message.into(), file: None, line: None, column: None, cause: None }
    }

    /// Sets a cause that a setting can remove.
    pub fn caused_by(mut self, cause: Cause) -> Self {
        self.cause = Some(cause);
        self
    }

    /// Sets the line, and perhaps the column.
    pub fn at(mut self, line: u64, column: Option<u64>) -> Self {
        self.line = Some(line);
        self.column = column;
        self
    }

    /// Sets the file, unless it is already set.
    pub fn in_file(mut self, file: &str) -> Self {
        self.file.get_or_insert_with(|| file.to_owned());
        self
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_position(f, self.file.as_deref(), self.line, self.column)?;
        f.write_str(&self.message)
    }
}

impl std::error::Error for ReadError {}

fn write_position(
    f: &mut fmt::Formatter<'_>,
    file: Option<&str>,
    line: Option<u64>,
    column: Option<u64>,
) -> fmt::Result {
    if let Some(file) = file {
        write!(f, "{file}:")?;
    }
    if let Some(line) = line {
        write!(f, "{line}:")?;
    }
    if let (Some(_), Some(column)) = (line, column) {
        write!(f, "{column}:")?;
    }
    if file.is_some() || line.is_some() { f.write_str(" ") } else { Ok(()) }
}
