//! Faces in their plain form: `f` and corners of digits, slashes and minus signs, with one blank between them.

use super::faces::Faces;
use super::fast_path::{Line, REACH};
use super::scan;
use super::vertices::{Corner, CornerAttributes};

/// A face as exporters write it, being read.
pub(super) struct PlainFace<'a> {
    bytes: &'a [u8],
    /// Where `line` starts.
    start: usize,
    line: Option<Line<'a>>,
    /// The byte behind the last corner.
    end: u8,
}

impl<'a> PlainFace<'a> {
    /// From behind the keyword on.
    pub(super) fn new(bytes: &'a [u8], start: usize) -> Self {
        PlainFace { bytes, start, line: None, end: 0 }
    }

    /// The next corner, if it is plain and points at something, and all of its indices are negative or none is.
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
            // Perhaps it only lies beyond what has been looked at.
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

    /// Where the next line starts, if this one ends here.
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

/// An index that points at something, from 1, and how it is written.
#[derive(Clone, Copy)]
struct Index {
    value: u64,
    /// As [`Line::index`] gives them.
    digits: u64,
    /// What they say.
    number: u64,
}

impl Index {
    /// None, or none that can be written again: these are no digits.
    const NONE: Index = Index { value: 0, digits: u64::MAX, number: 0 };
}

/// `before` is the index before it, which many programs write again and again.
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
    // What lies behind the statement can be named from the front only.
    let (value, most) = if NEGATIVE {
        ((faces.counts[kind] + 1).wrapping_sub(number), faces.counts[kind])
    } else {
        (number, faces.totals[kind])
    };
    if value.wrapping_sub(1) < most { Some((Index { value, digits, number }, end)) } else { None }
}
