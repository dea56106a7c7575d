//! Reads a text byte by byte: lines, words, numbers, names, and their positions.

use crate::encoding::windows_1252;
use crate::number;
use std::cell::OnceCell;

/// A position in a text of statements, one per line, as in OBJ and MTL.
///
/// A line ends at LF, CR LF, CR or the end of the bytes; a `\` just before the line's end joins the next
/// line to it; `#` starts a comment.
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    line_start: usize,
}

/// The reason why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BadNumber {
    /// NaN, infinite, or too large for an `f32`.
    NotFinite,
    /// Not a number.
    Unreadable,
}

impl<'a> Cursor<'a> {
    /// Starts at the first statement, after a UTF-8 byte order mark.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        Cursor { bytes, at, line: 1, line_start: 0 }
    }

    /// Starts at the beginning of a line with a known number.
    pub(crate) fn at_line(bytes: &'a [u8], at: usize, line: u64) -> Self {
        let byte_order_mark = if at == 0 { Self::new(bytes).at } else { 0 };
        Cursor { bytes, at: at + byte_order_mark, line, line_start: at }
    }

    /// Returns the number of bytes read.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// Returns the line, from 1.
    pub(crate) fn line(&self) -> u64 {
        self.line
    }

    /// Returns the column in bytes, from 1.
    pub(crate) fn column(&self) -> u64 {
        (self.at - self.line_start) as u64 + 1
    }

    /// Whether the end is reached.
    pub(crate) fn at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    /// Returns all remaining bytes.
    pub(crate) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at.min(self.bytes.len())..]
    }

    #[inline]
    pub(crate) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    #[inline]
    pub(crate) fn advance(&mut self) {
        self.at += 1;
    }

    /// Skips blanks and joined lines. Returns whether the statement continues.
    #[inline]
    pub(crate) fn next_word(&mut self) -> bool {
        loop {
            match self.peek() {
                Some(b' ' | b'\t') => self.at += 1,
                None | Some(b'\n' | b'\r' | b'#') => return false,
                Some(0x0B | 0x0C) => self.at += 1,
                Some(b'\\') => match self.continuation() {
                    Some(next) => self.start_line(next),
                    None => return true,
                },
                Some(_) => return true,
            }
        }
    }

    /// Returns the start of the next line if the `\` here joins it to this one, perhaps after blanks.
    #[cold]
    fn continuation(&self) -> Option<usize> {
        let mut i = self.at + 1;
        while matches!(self.bytes.get(i), Some(b' ' | b'\t')) {
            i += 1;
        }
        match (self.bytes.get(i), self.bytes.get(i + 1)) {
            (Some(b'\r'), Some(b'\n')) => Some(i + 2),
            (Some(b'\n' | b'\r'), _) => Some(i + 1),
            (None, _) => Some(i),
            _ => None,
        }
    }

    fn start_line(&mut self, at: usize) {
        self.at = at;
        self.line += 1;
        self.line_start = at;
    }

    /// Whether a word ends here.
    #[inline]
    pub(crate) fn at_word_end(&self) -> bool {
        match self.peek() {
            None | Some(b' ' | b'\t' | b'\n' | b'\r' | b'#' | 0x0B | 0x0C) => true,
            Some(b'\\') => self.continuation().is_some(),
            Some(_) => false,
        }
    }

    /// Reads a word.
    pub(crate) fn word(&mut self) -> &'a [u8] {
        let start = self.at;
        while !self.at_word_end() {
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    /// Returns the word up to the next blank, including `#`, for messages.
    pub(crate) fn offending_word(&self) -> &'a [u8] {
        let rest = &self.bytes[self.at.min(self.bytes.len())..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        &rest[..end]
    }

    /// Reads a number. On failure the position does not change.
    #[inline]
    pub(crate) fn number(&mut self) -> Result<f32, BadNumber> {
        if let Some((value, length)) = number::f32_prefix(&self.bytes[self.at..]) {
            let start = self.at;
            self.at += length;
            if self.at_word_end() && (self.peek() != Some(b'#') || !self.is_microsoft_nan()) {
                if value.is_finite() {
                    return Ok(value);
                }
                self.at = start;
                return Err(BadNumber::NotFinite);
            }
            self.at = start;
        }
        Err(self.why_no_number())
    }

    /// Recognises `1.#QNAN`, `-1.#IND`, `1.#INF`, which Microsoft's C library used to write for non-finite numbers.
    fn is_microsoft_nan(&self) -> bool {
        let rest = &self.bytes[self.at..];
        self.bytes[..self.at].ends_with(b"1.")
            && [&b"#QNAN"[..], b"#SNAN", b"#IND", b"#INF"].iter().any(|text| rest.starts_with(text))
    }

    #[cold]
    fn why_no_number(&self) -> BadNumber {
        let word = self.offending_word().to_ascii_lowercase();
        let digits = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(&word);
        if digits.starts_with(b"nan") || digits.starts_with(b"inf") || digits.starts_with(b"1.#") {
            BadNumber::NotFinite
        } else {
            BadNumber::Unreadable
        }
    }

    /// Skips a number that is [`BadNumber::NotFinite`]; returns it in quotes.
    #[cold]
    pub(crate) fn skip_not_finite(&mut self) -> String {
        let what = quote(self.offending_word());
        while !self.at_word_end() || self.peek() == Some(b'#') && what.contains('#') {
            self.at += 1;
        }
        what
    }

    /// Reads an integer, saturating at the limits of `i64`.
    #[inline]
    pub(crate) fn integer(&mut self) -> Option<i64> {
        let (value, length) = number::integer_prefix(&self.bytes[self.at..])?;
        self.at += length;
        Some(value)
    }

    /// Reads the rest of the statement as one name: trimmed, with inner blanks.
    ///
    /// A `#` starts a comment only between blanks: `red # the red one` is `red`, while `Material #25` (as 3ds Max
    /// names them) and `a#b` are names.
    pub(crate) fn name(&mut self) -> String {
        let mut joined: Vec<u8> = Vec::new();
        while self.next_word() {
            let start = self.at;
            let end = self.name_piece();
            joined.extend_from_slice(self.bytes[start..end].trim_ascii_end());
            if self.peek() != Some(b'\\') {
                break;
            }
            joined.push(b' ');
        }
        // A name that begins with `#` and is not a comment, where `next_word` stopped.
        if joined.is_empty() && self.peek() == Some(b'#') && !self.is_comment() {
            let start = self.at;
            let end = self.name_piece();
            joined.extend_from_slice(self.bytes[start..end].trim_ascii_end());
        }
        decode(joined.trim_ascii_end())
    }

    /// Moves to the end of the line, the end of the name, or a joining `\`; returns the end of the name's piece.
    fn name_piece(&mut self) -> usize {
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' | b'\r' => break,
                b'#' if self.is_comment() => break,
                b'\\' if self.continuation().is_some() => break,
                _ => self.at += 1,
            }
        }
        self.at
    }

    /// Whether the `#` here is between blanks or line ends.
    fn is_comment(&self) -> bool {
        let blank = |byte: Option<&u8>| byte.is_none_or(|b| b.is_ascii_whitespace() || *b == b'#');
        blank(self.at.checked_sub(1).and_then(|i| self.bytes.get(i))) && blank(self.bytes.get(self.at + 1))
    }

    /// Moves to the start of the next line, skipping the rest of the statement and its joined lines.
    #[inline]
    pub(crate) fn next_line(&mut self) {
        let mut comment = false;
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' => return self.start_line(self.at + 1),
                b'\r' => {
                    let length = if self.bytes.get(self.at + 1) == Some(&b'\n') { 2 } else { 1 };
                    return self.start_line(self.at + length);
                }
                b'#' => {
                    comment = true;
                    self.at += 1;
                }
                b'\\' if !comment => match self.continuation() {
                    Some(next) => self.start_line(next),
                    None => self.at += 1,
                },
                _ => self.at += 1,
            }
        }
    }
}

/// Decodes a name: UTF-8, or else Windows-1252, as older Windows programs wrote.
pub(crate) fn decode(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => windows_1252(bytes).into_owned(),
    }
}

/// Quotes bytes of a file for a message: escaped, cut at 40 characters.
pub(crate) fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(4 * LONGEST)]);
    let mut quoted = String::from("\"");
    for c in text.chars().take(LONGEST) {
        if c == '\'' { quoted.push(c) } else { quoted.extend(c.escape_debug()) }
    }
    if text.chars().nth(LONGEST).is_some() {
        quoted.push_str("...");
    }
    quoted.push('"');
    quoted
}

/// The starts of the lines of a text, computed on first use.
pub(crate) struct LineIndex<'a> {
    bytes: &'a [u8],
    starts: OnceCell<Vec<usize>>,
}

impl<'a> LineIndex<'a> {
    /// Creates an index of lines, which end at LF, CR LF or CR.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        LineIndex { bytes, starts: OnceCell::new() }
    }

    /// Returns the line and the column (in bytes) of a byte, both from 1.
    pub(crate) fn place(&self, at: usize) -> (u64, u64) {
        let starts = self.starts.get_or_init(|| starts(self.bytes));
        let line = starts.partition_point(|&start| start <= at).max(1);
        let start = starts.get(line - 1).copied().unwrap_or(0);
        (line as u64, (at - start) as u64 + 1)
    }
}

fn starts(bytes: &[u8]) -> Vec<usize> {
    let mut starts = vec![0];
    for (at, &byte) in bytes.iter().enumerate() {
        if byte == b'\n' || (byte == b'\r' && bytes.get(at + 1) != Some(&b'\n')) {
            starts.push(at + 1);
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_three_ways_and_join() {
        let mut cursor = Cursor::new(b"a\nb\r\nc\rd \\\n e\\\r\nf # g \\\nh");
        let mut words = Vec::new();
        loop {
            while cursor.next_word() {
                words.push((String::from_utf8_lossy(cursor.word()).into_owned(), cursor.line()));
            }
            if cursor.at_end() {
                break;
            }
            cursor.next_line();
        }
        let expected = [("a", 1), ("b", 2), ("c", 3), ("d", 4), ("e", 5), ("f", 6), ("h", 7)];
        assert_eq!(words, expected.map(|(w, l)| (w.to_owned(), l)));
    }

    #[test]
    fn names_keep_what_belongs_to_them() {
        let name = |text: &str| {
            let mut cursor = Cursor::new(text.as_bytes());
            cursor.name()
        };
        assert_eq!(name("  two words \t\r\nnext"), "two words");
        assert_eq!(name("red # the red one"), "red");
        assert_eq!(name("Material #25"), "Material #25");
        assert_eq!(name("#25"), "#25");
        assert_eq!(name("a#b\\c.png"), "a#b\\c.png");
        assert_eq!(name("long \\\n  name"), "long name");
        assert_eq!(name("# nothing"), "");
        let mut cursor = Cursor::new(b"fa\xE7ade \x80");
        assert_eq!(cursor.name(), "fa\u{e7}ade \u{20ac}");
    }

    #[test]
    fn quotes_are_short_and_printable() {
        assert_eq!(quote(b"a\"b\x00"), "\"a\\\"b\\0\"");
        assert_eq!(quote(&[b'x'; 50]), format!("\"{}...\"", "x".repeat(40)));
    }

    #[test]
    fn all_three_line_ends_count() {
        let index = LineIndex::new(b"a\nbc\r\nd\re");
        let places: Vec<(u64, u64)> = (0..10).map(|at| index.place(at)).collect();
        let expected = [(1, 1), (1, 2), (2, 1), (2, 2), (2, 3), (2, 4), (3, 1), (3, 2), (4, 1), (4, 2)];
        assert_eq!(places, expected);
        assert_eq!(LineIndex::new(b"").place(0), (1, 1));
    }
}
