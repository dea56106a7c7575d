//! Faces in plain form: `f` and corners of digits, slashes and minus signs, separated by single blanks.

use super::faces::Faces;
use super::fast_path::{Line, REACH};
use super::scan;
use super::vertices::{Corner, CornerAttributes};

/// A face in plain form that is being read.
pub(super) struct PlainFace<'a> {
    bytes: &'a [u8],
    /// The start of `line`.
    start: usize,
    line: Option<Line<'a>>,
    /// The byte after the last corner.
    end: u8,
}

impl<'a> PlainFace<'a> {
    /// Starts after the keyword.
    pub(super) fn new(bytes: &'a [u8], start: usize) -> Self {
        PlainFace { bytes, start, line: None, end: 0 }
    }

    /// Reads the next corner if it is plain and in range, and if all of its indices are negative or none is.
    #[inline(always)]
    pub(super) fn corner<const NEGATIVE: bool>(&mut self, faces: &Faces<'_>) -> Option<Corner> {
        if let Some(line) = &mut self.line {
            if self.end != b' ' {
                return None;
            }
            let at = line.at();
            let mut ahead = *line;
            if let Some((corner, end)) = plain_corner::<NEGATIVE>(&mut ahead, faces) {
                *line = ahead;
                self.end = end;
                return Some(corner);
            }
            // It may only be outside the window that has been examined.
            if at == 0 {
                return None;
            }
            self.start += at;
        }
        let mut line = Line::new(self.bytes.get(self.start..)?.first_chunk::<REACH>()?)?;
        let (corner, end) = plain_corner::<NEGATIVE>(&mut line, faces)?;
        self.line = Some(line);
        self.end = end;
        Some(corner)
    }

    /// Returns the start of the next line if this one ends here.
    #[inline(always)]
    pub(super) fn line_end(&self) -> Option<usize> {
        Some(self.start + self.line.as_ref()?.end(self.end)?)
    }
}

#[inline(always)]
fn plain_corner<const NEGATIVE: bool>(line: &mut Line<'_>, faces: &Faces<'_>) -> Option<(Corner, u8)> {
    let (position, mut end) = plain_index::<NEGATIVE>(line, faces, 0, Index::NONE)?;
    let (mut tex_coord, mut normal) = (Index::NONE, Index::NONE);
    if end == b'/' {
        if line.peek()? == b'/' {
            line.step();
            (normal, end) = plain_index::<NEGATIVE>(line, faces, 2, position)?;
        } else {
            (tex_coord, end) = plain_index::<NEGATIVE>(line, faces, 1, position)?;
            if end == b'/' {
                (normal, end) = plain_index::<NEGATIVE>(line, faces, 2, tex_coord)?;
            }
        }
    }
    Some((((position.value - 1) as u32, CornerAttributes::new(tex_coord.value, normal.value)), end))
}

/// An index from 1 that is in range, with its digits.
#[derive(Clone, Copy)]
struct Index {
    value: u64,
    /// The digits as [`Line::index`] returns them.
    digits: u64,
    /// The number that the digits represent.
    number: u64,
}

impl Index {
    /// No index; its digits never match.
    const NONE: Index = Index { value: 0, digits: u64::MAX, number: 0 };
}

/// Reads an index. `before` is the previous one, which many programs repeat.
#[inline(always)]
fn plain_index<const NEGATIVE: bool>(
    line: &mut Line<'_>,
    faces: &Faces<'_>,
    kind: usize,
    before: Index,
) -> Option<(Index, u8)> {
    if NEGATIVE {
        if line.peek()? != b'-' {
            return None;
        }
        line.step();
    }
    let (digits, end) = line.index()?;
    let number = if digits == before.digits { before.number } else { scan::aligned_digits(digits) };
    // Negative indices cannot refer to values after the statement.
    let (value, most) = if NEGATIVE {
        ((faces.counts[kind] + 1).wrapping_sub(number), faces.counts[kind])
    } else {
        (number, faces.totals[kind])
    };
    if value.wrapping_sub(1) < most { Some((Index { value, digits, number }, end)) } else { None }
}
