//! `.meshb`: a chain of sections.
//!
//! The code 1 as 32 bits identifies the byte order; then follows the version: 1 (32-bit reals), 2 (64-bit reals), 3
//! (also 64-bit positions), 4 (also 64-bit integers). Each section consists of a keyword's code, the position of the
//! next section (0 for the last one), the number of rows, and the rows.

use super::content::{Content, Locator, Numbers};
use super::{Keyword, Rows};
use crate::diagnostic::Reports;
use crate::{Limits, ReadError, Severity};

/// Whether the file begins like a binary one.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(&[1, 0, 0, 0]) || bytes.starts_with(&[0, 0, 0, 1])
}

pub(super) fn read<'a>(
    bytes: &'a [u8],
    limits: &Limits,
    reports: &mut Reports,
) -> Result<(Content, Locator<'a>), ReadError> {
    let mut cursor = Bytes { bytes, at: 4, big_endian: bytes.first() == Some(&0), version: 0, section: "the header" };
    cursor.version = cursor.int32()?;
    if !(1..=4).contains(&cursor.version) {
        let version = cursor.version;
        return Err(ReadError::new(format!(
            "the version of this binary Medit file is {version}: only 1 to 4 are known"
        )));
    }
    let (sections, has_end) = sections(&mut cursor, reports)?;
    let mut content = Content { has_end, ..Content::default() };
    for section in sections.iter().filter(|section| section.keyword.rows == Rows::Dimension) {
        content.dimension = match cursor.enter(section).int32()? {
            dimension @ (2 | 3) => dimension as usize,
            other => {
                return Err(cursor.error_at(section.data, format!("Dimension is {other}: only 2 and 3 can be drawn")));
            }
        };
    }
    for section in &sections {
        read_section(section, &mut cursor, &mut content, limits, reports)?;
    }
    if !has_end {
        Locator::Binary.report(
            Severity::Warning,
            bytes.len(),
            reports,
            "there is no End at the end: is the file cut off?".into(),
        );
    }
    Ok((content, Locator::Binary))
}

struct Section {
    keyword: &'static Keyword,
    /// The position of its code.
    at: usize,
    /// The range of its numbers.
    data: usize,
    end: usize,
}

/// Follows the chain of sections, which must lead forward. Also returns whether it ends with End.
fn sections(cursor: &mut Bytes<'_>, reports: &mut Reports) -> Result<(Vec<Section>, bool), ReadError> {
    let mut sections = Vec::new();
    let mut has_end = false;
    while cursor.at < cursor.bytes.len() {
        let at = cursor.at;
        cursor.section = "a keyword";
        let code = cursor.int32()?;
        let next = cursor.position()?;
        let data = cursor.at;
        let keyword = u32::try_from(code).ok().and_then(super::by_code);
        if keyword.is_some_and(|keyword| keyword.rows == Rows::End) {
            has_end = true;
            break;
        }
        let end = match usize::try_from(next) {
            Ok(0) => cursor.bytes.len(),
            Ok(next) if next >= data && next <= cursor.bytes.len() => next,
            _ => {
                let name = keyword.map_or_else(|| format!("keyword {code}"), |k| k.name.to_owned());
                let message = format!(
                    "the section after {name} is declared to begin at byte {next}, which is before it or beyond the end"
                );
                return Err(cursor.error_at(at, message));
            }
        };
        match keyword {
            Some(keyword) => sections.push(Section { keyword, at, data, end }),
            None => {
                Locator::Binary.warn("unknown keywords", at, reports, || format!("unknown keyword {code}: skipped"))
            }
        }
        if next == 0 {
            break;
        }
        cursor.at = end;
    }
    Ok((sections, has_end))
}

fn read_section(
    section: &Section,
    cursor: &mut Bytes<'_>,
    content: &mut Content,
    limits: &Limits,
    reports: &mut Reports,
) -> Result<(), ReadError> {
    let keyword = section.keyword;
    if matches!(keyword.rows, Rows::Dimension | Rows::Bare | Rows::End) {
        return Ok(());
    }
    if content.has(keyword) {
        let message = format!("duplicate section {}: ignored", keyword.name);
        Locator::Binary.report(Severity::Warning, section.at, reports, message);
        return Ok(());
    }
    let mut numbers = cursor.enter(section);
    let count = numbers.integer()?;
    let impossible = || format!("invalid count of {}: {count}", keyword.name);
    let count = usize::try_from(count).map_err(|_| numbers.error_at(section.data, impossible()))?;
    content.counts.push((keyword, count as u64, section.at));
    if content.dimension == 0 && content.numbers_in_row(keyword.rows).is_some() {
        let message = "there is no Dimension: the number of coordinates per vertex is unknown";
        return Err(numbers.error_at(section.at, message.to_owned()));
    }
    content.read_rows(keyword, count, &mut numbers, limits)
}

/// A position in the file.
#[derive(Clone, Copy)]
struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
    big_endian: bool,
    version: i32,
    /// The name of the section that is read, for messages.
    section: &'static str,
}

impl<'a> Bytes<'a> {
    /// Returns a cursor at the numbers of a section that ends where the section ends.
    fn enter(&self, section: &Section) -> Bytes<'a> {
        Bytes { bytes: &self.bytes[..section.end], at: section.data, section: section.keyword.name, ..*self }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], ReadError> {
        let Some(bytes) = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk::<N>()) else {
            return Err(self
                .error_at(self.at, format!("{} ends in the middle of a number: is the file cut off?", self.section)));
        };
        self.at += N;
        let mut bytes = *bytes;
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn int32(&mut self) -> Result<i32, ReadError> {
        self.take().map(i32::from_le_bytes)
    }

    fn position(&mut self) -> Result<i64, ReadError> {
        if self.version >= 3 { self.take().map(i64::from_le_bytes) } else { self.int32().map(i64::from) }
    }

    #[cold]
    fn error_at(&self, at: usize, message: String) -> ReadError {
        ReadError::new(format!("{message} (at byte {})", at + 1))
    }
}

impl Numbers for Bytes<'_> {
    #[inline]
    fn real(&mut self) -> Result<f32, ReadError> {
        let at = self.at;
        let value =
            if self.version == 1 { f32::from_le_bytes(self.take()?) } else { f64::from_le_bytes(self.take()?) as f32 };
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.error_at(at, format!("{value} of {} is not a finite number", self.section)))
    }

    #[inline]
    fn integer(&mut self) -> Result<i64, ReadError> {
        if self.version == 4 { self.take().map(i64::from_le_bytes) } else { self.int32().map(i64::from) }
    }

    fn place(&mut self) -> usize {
        self.at
    }

    fn error(&mut self, message: String) -> ReadError {
        self.error_at(self.at, message)
    }

    fn most_left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at) / 4
    }
}
