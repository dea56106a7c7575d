//! `.mesh`: words and numbers separated by blanks or line ends.

use super::content::{Content, Locator, Numbers};
use super::{Keyword, Rows};
use crate::diagnostic::Reports;
use crate::text::{LineIndex, quote};
use crate::{Limits, ReadError, Severity, number};

const UNKNOWN: &str = "unknown keywords";

/// Reads a text file.
pub(super) fn read<'a>(
    bytes: &'a [u8],
    limits: &Limits,
    reports: &mut Reports,
) -> Result<(Content, Locator<'a>), ReadError> {
    let lines = LineIndex::new(bytes);
    let content = sections(&mut Words::new(bytes, &lines), limits, reports)?;
    Ok((content, Locator::Text(lines)))
}

fn sections(words: &mut Words<'_>, limits: &Limits, reports: &mut Reports) -> Result<Content, ReadError> {
    let mut content = Content::default();
    begin(words, reports)?;
    while let Some((at, word)) = words.next_keyword() {
        match super::by_name(word) {
            Some(keyword) => section(keyword, at, words, &mut content, limits, reports)?,
            None => words.warn(UNKNOWN, at, reports, || {
                format!("unknown keyword {}: skipped, with the numbers after it", quote(word))
            }),
        }
        if content.has_end {
            break;
        }
    }
    if !content.has_end {
        let end = words.bytes.len();
        words.warn("", end, reports, || "there is no End at the end: is the file cut off?".to_owned());
    }
    Ok(content)
}

/// Reads `MeshVersionFormatted 2`, the first two words; a file without them is read if it begins with another keyword.
fn begin(words: &mut Words<'_>, reports: &mut Reports) -> Result<(), ReadError> {
    let Some((at, word)) = words.next() else { return Err(ReadError::new("the file is empty")) };
    if word.eq_ignore_ascii_case(b"MeshVersionFormatted") {
        let version = words.integer()?;
        if !(1..=4).contains(&version) {
            return Err(words.error_at(at, format!("MeshVersionFormatted is {version}: only 1 to 4 are known")));
        }
        return Ok(());
    }
    if super::by_name(word).is_none() {
        let message =
            format!("this is not a Medit file: it begins with {}, not with MeshVersionFormatted", quote(word));
        return Err(words.error_at(at, message));
    }
    words.warn("", at, reports, || "the file does not begin with MeshVersionFormatted".to_owned());
    words.at = at;
    Ok(())
}

fn section(
    keyword: &'static Keyword,
    at: usize,
    words: &mut Words<'_>,
    content: &mut Content,
    limits: &Limits,
    reports: &mut Reports,
) -> Result<(), ReadError> {
    let again = content.has(keyword) || (keyword.rows == Rows::Dimension && content.has_dimension);
    if again {
        words.warn("duplicate sections", at, reports, || format!("duplicate section {}: ignored", keyword.name));
        return Ok(());
    }
    match keyword.rows {
        Rows::End => content.has_end = true,
        Rows::Bare => {}
        Rows::Dimension => {
            content.dimension = dimension(words)?;
            content.has_dimension = true;
        }
        Rows::Counted => {
            let count = count(keyword, words)?;
            content.counts.push((keyword, count as u64, at));
        }
        _ => {
            if content.dimension == 0 {
                content.dimension = words.find_dimension(at)?;
            }
            let count = count(keyword, words)?;
            content.counts.push((keyword, count as u64, at));
            words.section = keyword.name;
            content.read_rows(keyword, count, words, limits)?;
            words.section = "";
        }
    }
    Ok(())
}

fn dimension(words: &mut Words<'_>) -> Result<usize, ReadError> {
    let at = words.place();
    match words.integer()? {
        2 => Ok(2),
        3 => Ok(3),
        other => Err(words.error_at(at, format!("Dimension is {other}: only 2 and 3 can be drawn"))),
    }
}

fn count(keyword: &Keyword, words: &mut Words<'_>) -> Result<usize, ReadError> {
    let at = words.place();
    words.section = keyword.name;
    let count = words.integer()?;
    words.section = "";
    let impossible = || format!("invalid count of {}: {count}", keyword.name);
    usize::try_from(count).map_err(|_| words.error_at(at, impossible()))
}

/// The words of a file; `#` starts a comment up to the end of the line.
#[derive(Clone, Copy)]
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The keyword of the current section, for messages.
    section: &'static str,
    lines: &'a LineIndex<'a>,
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8], lines: &'a LineIndex<'a>) -> Self {
        let at = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        Words { bytes, at, section: "", lines }
    }

    fn warn(&self, kind: &'static str, at: usize, reports: &mut Reports, message: impl FnOnce() -> String) {
        let (line, column) = self.lines.place(at);
        reports.add(kind, Severity::Warning, line, Some(column), message);
    }

    /// Moves to the next word.
    #[inline]
    fn skip_blanks(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte == b'#' {
                while !matches!(self.bytes.get(self.at), None | Some(b'\n' | b'\r')) {
                    self.at += 1;
                }
            } else if byte.is_ascii_whitespace() || byte == 0x0B {
                self.at += 1;
            } else {
                return;
            }
        }
    }

    #[inline]
    fn next(&mut self) -> Option<(usize, &'a [u8])> {
        self.skip_blanks();
        let start = self.at;
        while let Some(&byte) = self.bytes.get(self.at) {
            if byte.is_ascii_whitespace() || byte == b'#' || byte == 0x0B {
                break;
            }
            self.at += 1;
        }
        (self.at > start).then(|| (start, &self.bytes[start..self.at]))
    }

    /// Returns the next word that begins with a letter, skipping the numbers of sections that are not read.
    fn next_keyword(&mut self) -> Option<(usize, &'a [u8])> {
        loop {
            let (at, word) = self.next()?;
            let is_number = matches!(word.to_ascii_lowercase().as_slice(), b"nan" | b"inf" | b"infinity");
            if word.first().is_some_and(u8::is_ascii_alphabetic) && !is_number {
                return Some((at, word));
            }
        }
    }

    /// Looks ahead for the dimension if it follows the rows that depend on it.
    #[cold]
    fn find_dimension(&self, at: usize) -> Result<usize, ReadError> {
        let mut ahead = Words { section: "", ..*self };
        while let Some((_, word)) = ahead.next_keyword() {
            if word.eq_ignore_ascii_case(b"Dimension") {
                return dimension(&mut ahead);
            }
        }
        Err(self.error_at(at, "there is no Dimension: the number of coordinates per vertex is unknown".to_owned()))
    }

    #[cold]
    fn error_at(&self, at: usize, message: String) -> ReadError {
        let (line, column) = self.lines.place(at);
        ReadError::new(message).at(line, Some(column))
    }

    #[cold]
    fn no_number(&self, at: usize, word: Option<&[u8]>) -> ReadError {
        let of = if self.section.is_empty() { String::new() } else { format!(" of {}", self.section) };
        let message = match word {
            None => format!("the file ends where a number{of} is expected: is it cut off?"),
            Some(word) => format!("expected a number{of}, found {}", quote(word)),
        };
        self.error_at(at, message)
    }
}

impl Numbers for Words<'_> {
    #[inline]
    fn real(&mut self) -> Result<f32, ReadError> {
        let Some((at, word)) = self.next() else { return Err(self.no_number(self.bytes.len(), None)) };
        let value = match number::f32_prefix(word) {
            Some((value, length)) if length == word.len() => value,
            _ => fortran_number(word).ok_or_else(|| self.no_number(at, Some(word)))?,
        };
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.error_at(at, format!("{} of {} is not a finite number", quote(word), self.section)))
    }

    #[inline]
    fn integer(&mut self) -> Result<i64, ReadError> {
        let Some((at, word)) = self.next() else { return Err(self.no_number(self.bytes.len(), None)) };
        match number::integer_prefix(word) {
            Some((value, length)) if length == word.len() => Ok(value),
            // Some programs write all numbers as reals.
            _ => match std::str::from_utf8(word).ok().and_then(|w| w.parse::<f64>().ok()) {
                Some(value) if value.fract() == 0.0 && value.abs() < 9e15 => Ok(value as i64),
                _ => Err(self.no_number(at, Some(word))),
            },
        }
    }

    fn place(&mut self) -> usize {
        self.skip_blanks();
        self.at
    }

    fn error(&mut self, message: String) -> ReadError {
        let at = self.place();
        self.error_at(at, message)
    }

    fn most_left(&self) -> usize {
        // A digit and a blank each, except for the last.
        (self.bytes.len() - self.at.min(self.bytes.len())).div_ceil(2)
    }
}

/// Parses `1.5D+00`, as Fortran writes it, and everything that the standard library accepts.
#[cold]
fn fortran_number(word: &[u8]) -> Option<f32> {
    std::str::from_utf8(word).ok()?.replace(['d', 'D'], "e").parse().ok()
}
