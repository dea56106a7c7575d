//! The lines of a text around one of them.

use super::file::{missing_line, printable};
use crate::ReadError;
use crate::encoding::to_utf8;
use crate::text::decode;
use serde::Serialize;

/// Bytes at the start of a file that are searched for zeros, which texts do not contain.
const START: usize = 8192;

/// Lines of a text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Excerpt {
    /// The requested line, from 1.
    pub line: u64,
    /// The number of the first line of the excerpt.
    pub first_line: u64,
    /// The lines, with control characters escaped, each cut after 500 characters.
    pub lines: Vec<String>,
    /// The number of lines of the whole text.
    pub line_count: u64,
}

/// The line `line` (from 1) of a text, with at most `around` lines before and after it. Lines end at LF, CR LF or CR.
///
/// # Errors
/// There is no such line, or the file is no text.
pub fn excerpt(bytes: &[u8], line: u64, around: u64) -> Result<Excerpt, ReadError> {
    let text = to_utf8(bytes);
    let bytes = text.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&text.bytes);
    if bytes.iter().take(START).any(|byte| *byte == 0) {
        return Err(ReadError::new("the file is binary, so it has no lines"));
    }
    let shown = line.saturating_sub(around).max(1)..=line.saturating_add(around);
    let mut excerpt = Excerpt { line, first_line: *shown.start(), lines: Vec::new(), line_count: 0 };
    let mut rest = bytes;
    while !rest.is_empty() {
        let end = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let (text, after) = rest.split_at(end);
        excerpt.line_count += 1;
        if shown.contains(&excerpt.line_count) {
            excerpt.lines.push(printable(&decode(text)));
        }
        let line_end = if after.starts_with(b"\r\n") { 2 } else { 1 };
        rest = after.get(line_end..).unwrap_or_default();
    }
    if line == 0 || line > excerpt.line_count {
        return Err(missing_line(line, excerpt.line_count));
    }
    Ok(excerpt)
}
