//! Why a student's file could not be read as a vertex buffer.

use serde::Serialize;
use std::fmt;

/// Why a file is no vertex buffer: one sentence, and where in the file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BufferError {
    /// The error and the remedy.
    pub message: String,
    /// From 1; none where the whole file is meant, or where it has no lines.
    pub line: Option<u64>,
    /// In bytes, from 1.
    pub column: Option<u64>,
}

impl BufferError {
    /// About the whole file.
    pub fn new(message: impl Into<String>) -> Self {
        BufferError { message: message.into(), line: None, column: None }
    }

    /// The same at a line, and perhaps a column.
    pub fn at(mut self, line: u64, column: Option<u64>) -> Self {
        self.line = Some(line);
        self.column = column;
        self
    }
}

impl fmt::Display for BufferError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}")?;
            if let Some(column) = self.column {
                write!(f, ", column {column}")?;
            }
            f.write_str(": ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for BufferError {}
