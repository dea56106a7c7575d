//! Reads the numbers after the header one by one, from text or bytes.

use super::header::{Element, Property};
use super::scalar::Scalar;
use crate::ReadError;
use crate::Severity;
use crate::diagnostic::{Reports, Tally};
use crate::number;
use crate::polygon::too_many_corners;
use crate::text::quote;

/// The reason why there is no number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NumberProblem {
    /// The file has ended.
    Ended,
    /// Other text at this line and column.
    NoNumber { found: String, line: u64, column: u64 },
}

/// A source of numbers.
pub(super) trait NumberReader {
    /// Called before each element.
    fn begin(&mut self) {}
    /// Called after each element.
    fn end(&mut self) {}
    /// Reads a coordinate, rounded once.
    fn coordinate(&mut self, scalar: Scalar) -> Result<f32, NumberProblem>;
    /// Reads a count or an index.
    fn number(&mut self, scalar: Scalar) -> Result<f64, NumberProblem>;
    /// Skips a number.
    fn skip(&mut self, scalar: Scalar) -> Result<(), NumberProblem>;
    /// Returns the number of remaining bytes.
    fn left(&self) -> usize;
    /// Returns the line of the current element in a text.
    fn line(&self) -> Option<u64>;
    /// Reports oddities, and data after the last element.
    fn finish(&mut self, reports: &mut Reports);
}

/// Text with each element on a line of its own.
pub(super) struct AsciiReader<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    line_start: usize,
    /// The line where the element began.
    element_line: u64,
    continued: Tally,
    left_over: Tally,
}

impl<'a> AsciiReader<'a> {
    /// Starts at `at`, the beginning of a line.
    pub(super) fn new(bytes: &'a [u8], at: usize, line: u64) -> Self {
        let (continued, left_over) = (Tally::default(), Tally::default());
        AsciiReader { bytes, at, line, line_start: at, element_line: line, continued, left_over }
    }

    #[inline]
    fn skip_blanks(&mut self) {
        while matches!(self.bytes.get(self.at), Some(b' ' | b'\t' | 0x0B | 0x0C)) {
            self.at += 1;
        }
    }

    /// Skips a line end, if there is one.
    #[inline]
    fn skip_line_end(&mut self) -> bool {
        let length = match self.bytes.get(self.at) {
            Some(b'\n') => 1,
            Some(b'\r') if self.bytes.get(self.at + 1) == Some(&b'\n') => 2,
            Some(b'\r') => 1,
            _ => return false,
        };
        self.at += length;
        self.line += 1;
        self.line_start = self.at;
        true
    }

    /// Moves to the next word, which should be on this line.
    #[inline]
    fn find_word(&mut self) -> Result<(), NumberProblem> {
        self.skip_blanks();
        while self.skip_line_end() {
            let line = self.line;
            if line == self.element_line + 1 {
                self.continued.add(Some(self.element_line), String::new);
            }
            self.skip_blanks();
        }
        if self.at < self.bytes.len() { Ok(()) } else { Err(NumberProblem::Ended) }
    }

    #[inline]
    fn is_word_end(&self, at: usize) -> bool {
        self.bytes.get(at).is_none_or(u8::is_ascii_whitespace) || self.bytes.get(at) == Some(&0x0B)
    }

    fn word(&self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = (0..rest.len()).find(|i| self.is_word_end(self.at + i)).unwrap_or(rest.len());
        &rest[..length]
    }

    /// Reads a number as the standard library does, or a NaN as Microsoft's library writes it.
    fn slow_number(&mut self) -> Result<f64, NumberProblem> {
        let word = self.word();
        let text = std::str::from_utf8(word).unwrap_or_default();
        let microsoft_nan = || text.trim_start_matches('-').starts_with("1.#").then_some(f64::NAN);
        match text.parse().ok().or_else(microsoft_nan) {
            Some(value) => {
                self.at += word.len();
                Ok(value)
            }
            None => {
                let column = (self.at - self.line_start) as u64 + 1;
                Err(NumberProblem::NoNumber { found: quote(word), line: self.line, column })
            }
        }
    }
}

impl NumberReader for AsciiReader<'_> {
    fn begin(&mut self) {
        self.skip_blanks();
        while self.skip_line_end() {
            self.skip_blanks();
        }
        self.element_line = self.line;
    }

    fn end(&mut self) {
        self.skip_blanks();
        if !self.is_word_end(self.at) {
            let (line, word) = (self.line, self.word());
            self.left_over.add(Some(line), || quote(word));
        }
        while self.at < self.bytes.len() && !self.skip_line_end() {
            self.at += 1;
        }
    }

    #[inline]
    fn coordinate(&mut self, _: Scalar) -> Result<f32, NumberProblem> {
        self.find_word()?;
        if let Some((value, length)) = number::f32_prefix(&self.bytes[self.at..])
            && self.is_word_end(self.at + length)
        {
            self.at += length;
            return Ok(value);
        }
        self.slow_number().map(|value| value as f32)
    }

    #[inline]
    fn number(&mut self, _: Scalar) -> Result<f64, NumberProblem> {
        self.find_word()?;
        if let Some((value, length)) = number::integer_prefix(&self.bytes[self.at..])
            && self.is_word_end(self.at + length)
        {
            self.at += length;
            return Ok(value as f64);
        }
        self.slow_number()
    }

    fn skip(&mut self, _: Scalar) -> Result<(), NumberProblem> {
        self.find_word()?;
        self.at += self.word().len();
        Ok(())
    }

    fn left(&self) -> usize {
        // One more for the blank that the last number does not need.
        self.bytes.len() - self.at + 1
    }

    fn line(&self) -> Option<u64> {
        Some(self.element_line)
    }

    fn finish(&mut self, reports: &mut Reports) {
        self.continued.report(Severity::Warning, reports, |tally| {
            format!(
                "{} not on one line: the next lines are read as the rest",
                tally.counted("element is", "elements are")
            )
        });
        self.left_over.report(Severity::Warning, reports, |tally| {
            let lines = tally.counted("line has", "lines have");
            format!("{lines} more numbers than the header declares (the first is {}): ignored", tally.first)
        });
        self.begin();
        if self.at < self.bytes.len() {
            let message = format!("{} after the last element is ignored", quote(self.word()));
            reports.warning(self.line, message);
        }
    }
}

pub(super) struct BinaryReader<'a> {
    bytes: &'a [u8],
    at: usize,
    is_big_endian: bool,
}

impl<'a> BinaryReader<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize, is_big_endian: bool) -> Self {
        BinaryReader { bytes, at, is_big_endian }
    }
}

impl NumberReader for BinaryReader<'_> {
    #[inline]
    fn coordinate(&mut self, scalar: Scalar) -> Result<f32, NumberProblem> {
        self.number(scalar).map(|value| value as f32)
    }

    #[inline]
    fn number(&mut self, scalar: Scalar) -> Result<f64, NumberProblem> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let value = scalar.read(rest, self.is_big_endian).ok_or(NumberProblem::Ended)?;
        self.at += scalar.size();
        Ok(value)
    }

    #[inline]
    fn skip(&mut self, scalar: Scalar) -> Result<(), NumberProblem> {
        if self.left() < scalar.size() {
            return Err(NumberProblem::Ended);
        }
        self.at += scalar.size();
        Ok(())
    }

    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn line(&self) -> Option<u64> {
        None
    }

    fn finish(&mut self, reports: &mut Reports) {
        if self.left() > 0 {
            let message = format!("{} bytes after the last element (from byte {}) are ignored", self.left(), self.at);
            reports.push(u64::MAX, crate::Diagnostic::warning(message));
        }
    }
}

/// Reads the length of a list. It is only a claim: nothing may be allocated for it.
#[inline]
pub(super) fn list_length(source: &mut impl NumberReader, count: Scalar) -> Result<u64, ListProblem> {
    let length = source.number(count)?;
    // Beyond 2^64 it is 2^64 - 1, which exceeds the file as well.
    if length >= 0.0 && length.fract() == 0.0 { Ok(length as u64) } else { Err(ListProblem::BadLength(length)) }
}

/// The reason why a list cannot be read.
pub(super) enum ListProblem {
    Number(NumberProblem),
    BadLength(f64),
    TooManyCorners,
}

impl From<NumberProblem> for ListProblem {
    fn from(problem: NumberProblem) -> Self {
        ListProblem::Number(problem)
    }
}

/// Skips a property.
pub(super) fn skip_property(source: &mut impl NumberReader, property: &Property) -> Result<(), ListProblem> {
    let Some(count) = property.count else { return Ok(source.skip(property.value)?) };
    for _ in 0..list_length(source, count)? {
        source.skip(property.value)?;
    }
    Ok(())
}

/// Converts a problem with property `property` of the `index`-th `element` to an error.
#[cold]
pub(super) fn explain(
    problem: ListProblem,
    source: &impl NumberReader,
    element: &Element,
    index: u64,
    property: &Property,
) -> ReadError {
    let (what, name) = (&element.name, &property.name);
    let at_line = |error: ReadError| match source.line() {
        Some(line) => error.at(line, None),
        None => error,
    };
    match problem {
        ListProblem::Number(NumberProblem::Ended) => ended(element, index),
        ListProblem::Number(NumberProblem::NoNumber { found, line, column }) => {
            let message =
                format!("{what} {index} has {found} for {name}, which is not a number: export the file again");
            ReadError::new(message).at(line, Some(column))
        }
        ListProblem::BadLength(length) => at_line(ReadError::new(format!(
            "{what} {index} has a list {name} of {length} numbers: the file is damaged"
        ))),
        ListProblem::TooManyCorners => at_line(too_many_corners(&format!("{what} {index}"))),
    }
}

/// Creates the error for a file that ends inside an element.
#[cold]
fn ended(element: &Element, complete: u64) -> ReadError {
    let (name, count) = (&element.name, element.count);
    let message = format!("the file ends early: its header declares {count} {name} elements, but only {complete}");
    ReadError::new(format!("{message} {} there; get it again", if complete == 1 { "is" } else { "are" }))
}
