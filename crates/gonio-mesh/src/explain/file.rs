//! Lines and statements of a text: finds the requested one and shows it.

use super::{LONGEST, LineExplanation};
use crate::text::{Cursor, decode};
use crate::{Diagnostic, ReadError, Severity};

/// The range of a statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Its first byte, including preceding blanks.
    pub(super) start: usize,
    pub(super) first_line: u64,
    pub(super) last_line: u64,
}

impl Extent {
    /// Returns the range of the statement that starts at `start` on `first_line`, with the cursor after it: at the
    /// start of a line or at the end of the file.
    pub(super) fn ending_at(start: usize, first_line: u64, cursor: &Cursor<'_>, bytes: &[u8]) -> Self {
        let last_line = if cursor.at_end() {
            // A `\` or a line end may be the last byte: no line begins after it.
            first_line + line_ends(bytes.get(start..bytes.len().saturating_sub(1)).unwrap_or_default(), bytes.last())
        } else {
            cursor.line() - 1
        };
        Extent { start, first_line, last_line: last_line.max(first_line) }
    }
}

/// Counts the line ends in a text; `next` is the byte after it.
fn line_ends(text: &[u8], next: Option<&u8>) -> u64 {
    let followers = text.iter().skip(1).chain(next);
    text.iter().zip(followers).filter(|(byte, next)| **byte == b'\n' || **byte == b'\r' && **next != b'\n').count()
        as u64
}

/// Creates the error for a line that does not exist; `cursor` is at the end of the file.
pub(super) fn no_such_line(line: u64, cursor: &Cursor<'_>, bytes: &[u8]) -> ReadError {
    let is_empty = bytes.is_empty() || bytes == b"\xEF\xBB\xBF";
    missing_line(line, if is_empty { 0 } else { Extent::ending_at(0, 1, cursor, bytes).last_line })
}

/// Creates the error for a line that does not exist in a file of `count` lines.
pub(super) fn missing_line(line: u64, count: u64) -> ReadError {
    if line == 0 {
        return ReadError::new("lines are counted from 1: there is no line 0");
    }
    let lines = if count == 1 { "1 line".to_owned() } else { format!("{count} lines") };
    ReadError::new(format!("the file has {lines}: there is no line {line}"))
}

/// Creates an explanation with only the position filled in.
pub(super) fn blank(bytes: &[u8], line: u64, extent: Extent) -> LineExplanation {
    LineExplanation {
        line,
        text: text_of_line(bytes, extent, line),
        first_line: extent.first_line,
        last_line: extent.last_line,
        meaning: String::new(),
        details: Vec::new(),
        value: None,
        in_force: Vec::new(),
        problems: Vec::new(),
    }
}

/// Adds the range of the statement, if it is not just the requested line.
pub(super) fn describe_extent(explanation: &mut LineExplanation) {
    let (line, first, last) = (explanation.line, explanation.first_line, explanation.last_line);
    if line > first {
        explanation.meaning = format!("continues line {first}: {}", explanation.meaning);
    }
    if last > first {
        explanation.details.insert(0, format!("the statement spans lines {first} to {last}, joined by \\"));
    }
}

/// Returns the text of a line of a statement.
fn text_of_line(bytes: &[u8], extent: Extent, line: u64) -> String {
    let mut at = extent.start;
    for _ in extent.first_line..line {
        let rest = bytes.get(at..).unwrap_or_default();
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        at += end + if rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
    }
    let rest = bytes.get(at..).unwrap_or_default();
    let end = rest.iter().take(4 * LONGEST + 4).position(|byte| matches!(byte, b'\n' | b'\r'));
    let shown = &rest[..end.unwrap_or(rest.len().min(4 * LONGEST + 4))];
    let shown = if at == 0 { shown.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(shown) } else { shown };
    printable(&decode(shown))
}

/// Escapes control characters and shortens long text, for a terminal.
pub(super) fn printable(text: &str) -> String {
    let mut shown = String::new();
    for c in text.chars().take(LONGEST) {
        if c.is_control() && c != '\t' { shown.extend(c.escape_debug()) } else { shown.push(c) }
    }
    if text.chars().nth(LONGEST).is_some() {
        shown.push_str("...");
    }
    shown
}

/// Quotes a name for a message.
pub(super) fn named(name: &str) -> String {
    format!("`{}`", printable(name))
}

pub(super) fn warning(message: String, line: u64, column: u64) -> Diagnostic {
    Diagnostic::warning(message).at(line, Some(column))
}

pub(super) fn note(message: impl Into<String>, line: u64, column: u64) -> Diagnostic {
    Diagnostic { severity: Severity::Note, ..warning(message.into(), line, column) }
}

/// Formats a count: `1 face`, `2 faces`.
pub(super) fn count(count: u64, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

pub(super) fn numbers(values: &[f32]) -> String {
    values.iter().map(f32::to_string).collect::<Vec<_>>().join(" ")
}
