//! The text of a GL program and its calls.

use super::reader;
use gonio_render::gl_program::Step;
use serde::Serialize;
use std::fmt;

/// Most calls of a GL program.
pub const MOST_CALLS: usize = 1000;
/// Most bytes of its text.
pub const MOST_TEXT_BYTES: usize = 4 << 20;
/// Most bytes that one list of numbers fills.
pub const MOST_DATA_BYTES: usize = 1 << 20;
/// Most errors that are told at once.
pub const MOST_ERRORS: usize = 50;

/// A GL program, read.
#[derive(Clone, Debug, PartialEq)]
pub struct GlProgram {
    /// The file's name.
    pub file: String,
    /// Its calls, in order.
    pub steps: Vec<Step>,
    /// Its lines, to be quoted.
    lines: Vec<String>,
}

/// Something that is no GL program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GlProgramError {
    /// The file's name.
    pub file: String,
    /// From 1.
    pub line: u32,
    /// From 1, in characters.
    pub column: u32,
    /// The error, a sentence without its full stop.
    pub message: String,
    /// The remedy; may be empty.
    pub help: String,
}

impl fmt::Display for GlProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.line, self.column, self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "; {}", self.help) }
    }
}

impl std::error::Error for GlProgramError {}

impl GlProgram {
    /// Reads a text. All errors that it has, up to [`MOST_ERRORS`]; never an empty list.
    pub fn parse(text: &str, file_name: &str) -> Result<Self, Vec<GlProgramError>> {
        let error = |message: String, help: &str| {
            vec![GlProgramError { file: file_name.to_owned(), line: 1, column: 1, message, help: help.to_owned() }]
        };
        if text.len() > MOST_TEXT_BYTES {
            let most = MOST_TEXT_BYTES >> 20;
            return Err(error(format!("the text has {} bytes", text.len()), &format!("{most} MB is the most")));
        }
        if text.contains('\0') {
            return Err(error("the file is not text".to_owned(), "hand in the GL program as text"));
        }
        let steps = reader::read(text, file_name)?;
        let lines = text.lines().map(str::to_owned).collect();
        Ok(GlProgram { file: file_name.to_owned(), steps, lines })
    }

    /// Reads a file's bytes.
    pub fn parse_bytes(bytes: &[u8], file_name: &str) -> Result<Self, Vec<GlProgramError>> {
        // A byte order mark is no mistake of the student's.
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        match std::str::from_utf8(bytes) {
            Ok(text) => Self::parse(text, file_name),
            Err(why) => {
                let line = bytes[..why.valid_up_to()].iter().filter(|byte| **byte == b'\n').count() as u32 + 1;
                Err(vec![GlProgramError {
                    file: file_name.to_owned(),
                    line,
                    column: 1,
                    message: "the file is not UTF-8 text".to_owned(),
                    help: "hand in the GL program as text".to_owned(),
                }])
            }
        }
    }

    /// A line of the text, from 1, without blanks around it.
    pub fn quoted(&self, line: u32) -> Option<&str> {
        self.lines.get((line as usize).checked_sub(1)?).map(|line| line.trim())
    }
}
