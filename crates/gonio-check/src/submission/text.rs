//! The text of a stage, decoded from the bytes of a file, and the position of each of its characters in that file.

use super::error::IntakeError;
use gonio_language::tr;

/// The start of a piece of the text that is contiguous in the file, up to the end of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stretch {
    /// 0 for the stage's own file, else one more than the index of an inserted one.
    source: usize,
    text_line: u32,
    text_column: u32,
    file_line: u32,
    file_column: u32,
}

/// The text of a stage for the compiler, with positions in the student's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StageText {
    /// The text, with lines that end in `\n` and otherwise unchanged.
    pub text: String,
    /// The file, as the student named it.
    pub file: String,
    /// The files that were inserted for `#include`.
    inserted: Vec<String>,
    /// In order of the text; empty if the text is the whole file.
    stretches: Vec<Stretch>,
}

impl StageText {
    /// Creates a text that is a whole file.
    #[must_use]
    pub fn whole(file: impl Into<String>, text: impl Into<String>) -> Self {
        Self { text: text.into(), file: file.into(), inserted: Vec::new(), stretches: Vec::new() }
    }

    /// Returns the file, line and column of a line and column of the text, all from 1, columns in characters.
    ///
    /// Column 0 means the whole line and gives the column of its first character. A position after the end of the
    /// text gives the last known position in the file.
    #[must_use]
    pub fn place(&self, line: u32, column: u32) -> (&str, u32, u32) {
        let (line, column) = (line.max(1), column.max(1));
        let after = self.stretches.partition_point(|s| (s.text_line, s.text_column) <= (line, column));
        let Some(stretch) = after.checked_sub(1).and_then(|i| self.stretches.get(i)) else {
            return match self.stretches.first() {
                None => (&self.file, line, column),
                Some(first) => (self.source(first), first.file_line, first.file_column),
            };
        };
        if stretch.text_line == line {
            let column = stretch.file_column.saturating_add(column - stretch.text_column);
            (self.source(stretch), stretch.file_line, column)
        } else {
            (self.source(stretch), stretch.file_line, stretch.file_column)
        }
    }

    /// Whether a part of the text is from this file: the stage's own, or one that it includes.
    #[must_use]
    pub fn has_file(&self, name: &str) -> bool {
        self.file == name || self.inserted.iter().any(|inserted| inserted == name)
    }

    fn source(&self, stretch: &Stretch) -> &str {
        let inserted = stretch.source.checked_sub(1).and_then(|at| self.inserted.get(at));
        inserted.map_or(&self.file, String::as_str)
    }

    /// Returns a line of the text, from 1, without its end.
    #[must_use]
    pub fn line(&self, line: u32) -> Option<&str> {
        self.text.lines().nth(usize::try_from(line.checked_sub(1)?).ok()?)
    }
}

/// Builds a [`StageText`] character by character.
#[derive(Clone, Debug)]
pub(super) struct Builder {
    pub(super) text: String,
    /// The source of the next characters: 0 for the stage's own file, else one more than the index of an inserted one.
    pub(super) source: usize,
    stretches: Vec<Stretch>,
    line: u32,
    column: u32,
    /// The position in the file at which the next character continues the current piece.
    next_in_file: Option<(u32, u32)>,
}

impl Builder {
    pub(super) fn new() -> Self {
        Self { text: String::new(), source: 0, stretches: Vec::new(), line: 1, column: 1, next_in_file: None }
    }

    /// Appends a character with its position in the file.
    pub(super) fn push(&mut self, c: char, line: u32, column: u32) {
        if self.column == 1 || self.next_in_file != Some((line, column)) {
            self.stretches.push(Stretch {
                source: self.source,
                text_line: self.line,
                text_column: self.column,
                file_line: line,
                file_column: column,
            });
        }
        self.text.push(c);
        if c == '\n' {
            self.line = self.line.saturating_add(1);
            self.column = 1;
            self.next_in_file = None;
        } else {
            self.column = self.column.saturating_add(1);
            self.next_in_file = Some((line, column.saturating_add(1)));
        }
    }

    /// Appends lines of the file from `first` (from 0) up to `end`, exclusive.
    pub(super) fn push_lines(&mut self, lines: &[&str], first: usize, end: usize) {
        for (index, text) in lines.iter().enumerate().take(end).skip(first) {
            self.push_line(text, number(index + 1));
        }
    }

    /// Appends a line with its end, from `line` of the file.
    pub(super) fn push_line(&mut self, text: &str, line: u32) {
        let mut column = 1u32;
        for c in text.chars() {
            self.push(c, line, column);
            column = column.saturating_add(1);
        }
        self.push('\n', line, column);
    }

    /// Appends the text of another builder.
    pub(super) fn append(&mut self, other: &Builder) {
        // The pieces of the other begin at line starts, so they are only shifted.
        let (line, column) = (self.line - 1, self.column - 1);
        self.stretches.extend(other.stretches.iter().map(|s| Stretch {
            text_line: s.text_line.saturating_add(line),
            text_column: if s.text_line == 1 { s.text_column.saturating_add(column) } else { s.text_column },
            ..*s
        }));
        self.text.push_str(&other.text);
        self.column = if other.line == 1 { self.column.saturating_add(other.column - 1) } else { other.column };
        self.line = self.line.saturating_add(other.line - 1);
        self.next_in_file = other.next_in_file;
    }

    /// Removes leading white space.
    pub(super) fn trim_start(&mut self) {
        if !self.text.starts_with(char::is_whitespace) {
            return;
        }
        let whole = std::mem::replace(self, Self::new()).finish("");
        let (mut line, mut column) = (1, 1);
        for c in whole.text.chars() {
            if !(self.text.is_empty() && c.is_whitespace()) {
                let (_, file_line, file_column) = whole.place(line, column);
                self.push(c, file_line, file_column);
            }
            (line, column) = if c == '\n' { (line + 1, 1) } else { (line, column + 1) };
        }
    }

    pub(super) fn finish(self, file: &str) -> StageText {
        self.finish_with(file, Vec::new())
    }

    /// Finishes a text into which other files were inserted.
    pub(super) fn finish_with(self, file: &str, inserted: Vec<String>) -> StageText {
        StageText { text: self.text, file: file.to_owned(), inserted, stretches: self.stretches }
    }
}

/// Converts a count to a line or column number.
pub(super) fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// The largest file that is read, in bytes.
pub(super) const LARGEST: usize = 10 * 1024 * 1024;

/// Decodes a file to text with lines that end in `\n`. Also returns a warning if it had to be corrected.
pub(super) fn decode(file: &str, bytes: &[u8]) -> Result<(String, Option<String>), IntakeError> {
    let file_owned = || file.to_owned();
    if bytes.len() > LARGEST {
        return Err(IntakeError::TooLarge { file: file_owned(), bytes: bytes.len() });
    }
    let (text, warning) = match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => {
            (utf8_or_latin1(file, rest)?.0, Some(tr!("check-submission-begins-with-a-byte-order-mark", file = file)))
        }
        [0xFF, 0xFE, rest @ ..] => (utf16(file, rest, u16::from_le_bytes)?, Some(utf16_warning(file))),
        [0xFE, 0xFF, rest @ ..] => (utf16(file, rest, u16::from_be_bytes)?, Some(utf16_warning(file))),
        _ => utf8_or_latin1(file, bytes)?,
    };
    if text.trim().is_empty() {
        return Err(IntakeError::Empty { file: file_owned() });
    }
    if text.trim_start().starts_with("{\\rtf") {
        return Err(IntakeError::RichText { file: file_owned() });
    }
    Ok((if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n") } else { text }, warning))
}

fn utf16_warning(file: &str) -> String {
    tr!("check-submission-is-utf-16-which-no-glsl", file = file)
}

fn utf16(file: &str, bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, IntakeError> {
    let binary = |because: &str| IntakeError::Binary { file: file.to_owned(), because: because.to_owned() };
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    let text: String = char::decode_utf16(units)
        .collect::<Result<_, _>>()
        .map_err(|_| binary(tr!("check-submission-broken-utf-16")))?;
    if text.contains('\0') { Err(binary(tr!("check-submission-zeros-in-utf-16-text"))) } else { Ok(text) }
}

fn utf8_or_latin1(file: &str, bytes: &[u8]) -> Result<(String, Option<String>), IntakeError> {
    let binary = |because: String| Err(IntakeError::Binary { file: file.to_owned(), because });
    if let Some(offset) = bytes.iter().position(|&b| b == 0) {
        return binary(tr!("check-submission-a-zero-byte-at-offset", offset = offset));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok((text.to_owned(), None)),
        Err(error) => {
            // Latin-1 text is mostly ASCII, with a few accents and no control characters except white space.
            let controls = bytes.iter().filter(|b| b.is_ascii_control() && !b.is_ascii_whitespace()).count();
            let foreign = bytes.iter().filter(|b| !b.is_ascii()).count();
            if controls > 0 || foreign * 5 > bytes.len() {
                return binary(tr!("check-submission-invalid-utf-8-at-offset", offset = error.valid_up_to()));
            }
            let warning = tr!("check-submission-is-not-utf-8-gonio-read", file = file);
            Ok((bytes.iter().map(|&b| char::from(b)).collect(), Some(warning)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_in_a_whole_file_are_unchanged() {
        let text = StageText::whole("a.vert", "one\ntwo\n");
        assert_eq!(text.place(2, 3), ("a.vert", 2, 3));
        assert_eq!(text.place(0, 0), ("a.vert", 1, 1));
        assert_eq!(text.line(2), Some("two"));
        assert_eq!((text.line(0), text.line(3)), (None, None));
    }

    #[test]
    fn characters_keep_their_position_in_the_file() {
        let mut builder = Builder::new();
        for (c, line, column) in [('a', 3, 9), ('b', 3, 10), ('\t', 3, 11), ('c', 3, 13), ('\n', 3, 14), ('d', 5, 2)] {
            builder.push(c, line, column);
        }
        let text = builder.finish("main.cpp");
        assert_eq!(text.text, "ab\tc\nd");
        assert_eq!(text.place(1, 2), ("main.cpp", 3, 10));
        assert_eq!(text.place(1, 4), ("main.cpp", 3, 13));
        assert_eq!(text.place(2, 0), ("main.cpp", 5, 2));
        assert_eq!(text.place(90, 7), ("main.cpp", 5, 2));
    }

    #[test]
    fn appended_text_keeps_its_positions() {
        let mut first = Builder::new();
        first.push('a', 1, 5);
        let mut second = Builder::new();
        for (c, column) in [('b', 8), ('\n', 9), ('c', 11)] {
            second.push(c, 2, column);
        }
        first.append(&second);
        first.push('d', 7, 1);
        let text = first.finish("f");
        assert_eq!(text.text, "ab\ncd");
        assert_eq!(text.place(1, 1), ("f", 1, 5));
        assert_eq!(text.place(1, 2), ("f", 2, 8));
        assert_eq!(text.place(2, 1), ("f", 2, 11));
        assert_eq!(text.place(2, 2), ("f", 7, 1));
    }

    #[test]
    fn the_usual_encodings_are_decoded() {
        let utf16 = |swap: bool| -> Vec<u8> {
            "\u{FEFF}void é\r\n"
                .encode_utf16()
                .flat_map(|u| if swap { u.to_be_bytes() } else { u.to_le_bytes() })
                .collect()
        };
        for (bytes, text, warned) in [
            (b"a\r\nb\rc\n".to_vec(), "a\nb\nc\n", None),
            ("é".as_bytes().to_vec(), "é", None),
            (b"\xEF\xBB\xBF#version".to_vec(), "#version", Some("byte order mark")),
            (b"// lumi\xE8re de c\xF4t\xE9".to_vec(), "// lumière de côté", Some("Latin-1")),
            (utf16(false), "void é\n", Some("UTF-16")),
            (utf16(true), "void é\n", Some("UTF-16")),
        ] {
            let (read, warning) = decode("f", &bytes).unwrap();
            assert_eq!(read, text);
            assert_eq!(warning.is_some(), warned.is_some(), "{warning:?}");
            assert!(warning.unwrap_or_default().contains(warned.unwrap_or_default()));
        }
    }

    #[test]
    fn binary_files_are_rejected() {
        for (bytes, says) in [
            (b"".to_vec(), "f is empty"),
            (b" \r\n\t".to_vec(), "f is empty"),
            (b"\xEF\xBB\xBF".to_vec(), "f is empty"),
            (b"void main\0".to_vec(), "a zero byte at offset 9"),
            (b"\x89PNG\r\n\x1A\n".to_vec(), "invalid UTF-8 at offset 0"),
            (vec![0xE9; 40], "invalid UTF-8 at offset 0"),
            (b"\xFF\xFE\x00\xD8a\x00".to_vec(), "broken UTF-16"),
            (b"\xFF\xFEa\x00\x00\x00".to_vec(), "zeros in UTF-16"),
            (b"{\\rtf1\\ansi void main}".to_vec(), "word processor"),
            (vec![b'a'; LARGEST + 1], "has 10485761 bytes"),
        ] {
            let message = decode("f", &bytes).unwrap_err().to_string();
            assert!(message.contains(says), "{message}");
        }
    }
}
