//! The first pass: the attributes of vertices (`v`, `vt`, `vn`). All other statements are skipped, and their positions
//! are remembered for the second pass, which then knows all vertices, even those defined after a face.

use super::fast_path::{Line, REACH, small_numbers};
use super::scan::{self, Blanks, WINDOW};
use crate::diagnostic::Reports;
use crate::text::{BadNumber, Cursor, quote};
use crate::{ReadError, Severity};
use glam::DVec3;
use std::ops::Range;

/// Attributes of a piece of a file, or of all of it. Line numbers count from the start of the piece.
#[derive(Default)]
pub(super) struct Attributes {
    pub(super) positions: Vec<[f32; 3]>,
    /// Colours of the positions up to the last one with a colour; white in between.
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// Vectors of length 1, or 0 for those of length 0 in the file.
    pub(super) normals: Vec<[f32; 3]>,
    /// The ranges of other statements.
    pub(super) segments: Vec<Segment>,
    pub(super) reports: Reports,
    /// Number of positions with a colour.
    pub(super) colored: u64,
    /// The first line with a weight that is not 1.
    pub(super) weighted: Option<u64>,
    /// Number of lines.
    pub(super) lines: u64,
    /// The error that ended it before the end of the piece.
    pub(super) error: Option<ReadError>,
    /// Whether the last segment may be extended.
    is_open: bool,
}

/// A range of a file with statements other than attributes, and perhaps a few plain attributes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) bytes: Range<usize>,
    /// The line number of its first line.
    pub(super) line: u64,
    /// Numbers of positions, texture coordinates and normals before it.
    pub(super) counts: [u64; 3],
    /// The estimated number of triangles of its faces: rather too many than too few.
    pub(super) triangles: usize,
}

/// Segments with a smaller gap between them are merged, so that there are at most as many as the file has kilobytes.
const SMALLEST_GAP: usize = 1024;

impl Attributes {
    /// Parses a piece of a file that begins and ends between two statements. `fast_path` enables the fast path, which
    /// only changes the speed.
    ///
    /// Browsers optimise whole functions: a loop that is alone in its function is fast sooner.
    #[inline(never)]
    pub(super) fn parse(bytes: &[u8], piece: Range<usize>, fast_path: bool) -> Self {
        let mut attributes = Attributes { lines: 1, ..Attributes::default() };
        let mut at = piece.start;
        while at < piece.end {
            if fast_path && let Some(next) = attributes.plain_line(bytes, at, piece.end) {
                at = next;
                continue;
            }
            match attributes.slow(bytes, at) {
                Ok(next) => at = next,
                Err(error) => {
                    attributes.error = Some(error);
                    break;
                }
            }
        }
        attributes.lines -= 1;
        attributes
    }

    pub(super) fn counts(&self) -> [u64; 3] {
        [self.positions.len() as u64, self.tex_coords.len() as u64, self.normals.len() as u64]
    }

    /// Reads one plain attribute, or any number of plain other lines; returns the start of the next line.
    #[inline(always)]
    fn plain_line(&mut self, bytes: &[u8], at: usize, end: usize) -> Option<usize> {
        match bytes.get(at)? {
            b'v' => {
                let length = self.plain_attribute(bytes.get(at..)?.first_chunk()?)?;
                self.lines += 1;
                Some(at + length)
            }
            b'\n' => {
                self.lines += 1;
                Some(at + 1)
            }
            b' ' | b'\t' | 0x0B | 0x0C | b'\\' => None,
            // A byte order mark may precede a vertex.
            _ if at == 0 => None,
            _ => {
                let others = other_lines(bytes, at, end);
                if others.lines == 0 {
                    return None;
                }
                self.others(at..others.end, others.triangles);
                self.lines += others.lines;
                Some(others.end)
            }
        }
    }

    /// Reads a `v`, `vt` or `vn` in plain form; returns its length.
    #[inline(always)]
    fn plain_attribute(&mut self, bytes: &[u8; REACH]) -> Option<usize> {
        match (bytes[1], bytes[2]) {
            (b' ', _) => match small_numbers(bytes, 2) {
                Some((position, length)) => {
                    self.positions.push(position);
                    Some(length)
                }
                None => self.plain_vertex(Line::new(bytes)?.after_keyword(2)?),
            },
            (b't', b' ') => match small_numbers(bytes, 3) {
                Some((tex_coord, length)) => {
                    self.tex_coords.push(tex_coord);
                    Some(length)
                }
                None => self.plain_tex_coord(Line::new(bytes)?.after_keyword(3)?),
            },
            (b'n', b' ') => {
                let (normal, length) = match small_numbers(bytes, 3) {
                    Some(small) => small,
                    None => {
                        let mut line = Line::new(bytes)?.after_keyword(3)?;
                        let (normal, end) = three(&mut line)?;
                        (normal, line.end(end)?)
                    }
                };
                self.normals.push(unit(normal));
                Some(length)
            }
            _ => None,
        }
    }

    /// Reads one, two or three numbers, of which the third is ignored.
    #[inline]
    fn plain_tex_coord(&mut self, mut line: Line<'_>) -> Option<usize> {
        let (u, end) = line.number()?;
        if let Some(length) = line.end(end) {
            self.tex_coords.push([u, 0.0]);
            return Some(length);
        }
        let (v, next_end) = line.number().filter(|_| end == b' ')?;
        let length = match line.end(next_end) {
            Some(length) => length,
            None => {
                let (_, last_end) = line.number().filter(|_| next_end == b' ')?;
                line.end(last_end)?
            }
        };
        self.tex_coords.push([u, v]);
        Some(length)
    }

    /// Reads three numbers, perhaps followed by a weight or a colour.
    #[inline]
    fn plain_vertex(&mut self, mut line: Line<'_>) -> Option<usize> {
        let (position, end) = three(&mut line)?;
        if let Some(length) = line.end(end) {
            self.positions.push(position);
            return Some(length);
        }
        let (fourth, end) = line.number().filter(|_| end == b' ')?;
        if let Some(length) = line.end(end) {
            if fourth != 1.0 && self.weighted.is_none() {
                self.weighted = Some(self.lines);
            }
            self.positions.push(position);
            return Some(length);
        }
        let (fifth, next_end) = line.number().filter(|_| end == b' ')?;
        let (sixth, last_end) = line.number().filter(|_| next_end == b' ')?;
        let length = line.end(last_end)?;
        self.color([fourth, fifth, sixth]);
        self.positions.push(position);
        Some(length)
    }

    /// Stores the colour of the next position.
    fn color(&mut self, color: [f32; 3]) {
        self.colors.resize(self.positions.len(), [1.0; 3]);
        self.colors.push(color);
        self.colored += 1;
    }

    /// Remembers a range of other statements, which starts at the next line.
    #[inline]
    fn others(&mut self, bytes: Range<usize>, triangles: usize) {
        let counts = self.counts();
        match self.segments.last_mut() {
            Some(last) if self.is_open && bytes.start - last.bytes.end < SMALLEST_GAP => {
                last.bytes.end = bytes.end;
                last.triangles += triangles;
            }
            _ => self.segments.push(Segment { bytes, line: self.lines, counts, triangles }),
        }
        self.is_open = true;
    }

    /// Reads any statement, byte by byte; returns the start of the next one.
    #[inline(never)]
    fn slow(&mut self, bytes: &[u8], at: usize) -> Result<usize, ReadError> {
        let mut cursor = Cursor::at_line(bytes, at, self.lines);
        let mut is_attribute = true;
        if cursor.next_word() {
            match cursor.word() {
                b"v" => self.vertex(&mut cursor)?,
                b"vt" => self.tex_coord(&mut cursor)?,
                b"vn" => self.normal(&mut cursor)?,
                keyword => {
                    is_attribute = false;
                    // Names have comments of their own kind: the reader of names decides where the line ends.
                    if matches!(keyword, b"o" | b"g" | b"usemtl" | b"mtllib") {
                        cursor.name();
                    }
                }
            }
        }
        cursor.next_line();
        let next = cursor.position().min(bytes.len());
        if is_attribute {
            // The second pass skips attributes of one line only.
            self.is_open &= cursor.line() == self.lines + 1;
        } else {
            let blanks = bytes[at..next].iter().filter(|byte| **byte <= b' ').count();
            self.others(at..next, likely_triangles(blanks, 1));
        }
        self.lines = cursor.line();
        Ok(next)
    }

    fn vertex(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let mut position = [0.0; 3];
        for value in &mut position {
            *value = coordinate(cursor, "v", 3)?;
        }
        if cursor.next_word() {
            self.more_of_vertex(cursor)?;
        }
        self.positions.push(position);
        Ok(())
    }

    /// After x y z: w, or r g b, or r g b a (whose a is ignored). All of them are optional.
    fn more_of_vertex(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let line = cursor.line();
        let mut more = [0.0; 4];
        let mut count = 0;
        let mut first_not_finite = None;
        while count < 4 && cursor.next_word() {
            let at = (cursor.line(), cursor.column());
            more[count] = match cursor.number() {
                Ok(value) => value,
                Err(BadNumber::Unreadable) => return Err(unreadable(cursor, "v")),
                Err(BadNumber::NotFinite) => {
                    first_not_finite.get_or_insert((at, cursor.skip_not_finite()));
                    0.0
                }
            };
            count += 1;
        }
        if let Some(((line, column), what)) = &first_not_finite
            && let Some(message) = not_finite_behind_position(count, what)
        {
            self.reports.add("numbers of v not finite", Severity::Warning, *line, Some(*column), || message);
        }
        match count {
            1 => {
                if more[0] != 1.0 && first_not_finite.is_none() && self.weighted.is_none() {
                    self.weighted = Some(line);
                }
            }
            3 | 4 => self.color([more[0], more[1], more[2]]),
            _ => self.reports.add("vertices with five numbers", Severity::Warning, line, None, || {
                "v has 5 numbers instead of 3, 4, 6 or 7: the last two are ignored".to_owned()
            }),
        }
        Ok(())
    }

    fn tex_coord(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let u = self.finite(cursor, "vt")?;
        let v = if cursor.next_word() { self.finite(cursor, "vt")? } else { 0.0 };
        self.tex_coords.push([u, v]);
        Ok(())
    }

    fn normal(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let mut normal = [0.0; 3];
        for value in &mut normal {
            *value = self.finite(cursor, "vn")?;
        }
        self.normals.push(unit(normal));
        Ok(())
    }

    /// Reads a number of an optional attribute; non-finite ones become 0.
    fn finite(&mut self, cursor: &mut Cursor<'_>, keyword: &'static str) -> Result<f32, ReadError> {
        if !cursor.next_word() {
            return Err(too_short(cursor, keyword, if keyword == "vt" { 1 } else { 3 }));
        }
        match cursor.number() {
            Ok(value) => Ok(value),
            Err(BadNumber::Unreadable) => Err(unreadable(cursor, keyword)),
            Err(BadNumber::NotFinite) => {
                let (line, column) = (cursor.line(), Some(cursor.column()));
                let what = cursor.skip_not_finite();
                let kind = if keyword == "vt" { "numbers of vt not finite" } else { "numbers of vn not finite" };
                self.reports.add(kind, Severity::Warning, line, column, || {
                    format!("{keyword} has {what}, which is not a finite number: using 0 instead")
                });
                Ok(0.0)
            }
        }
    }
}

/// Reads three numbers separated by blanks, and the byte after them.
#[inline(always)]
fn three(line: &mut Line<'_>) -> Option<([f32; 3], u8)> {
    let (x, end) = line.number()?;
    let (y, next_end) = line.number().filter(|_| end == b' ')?;
    let (z, last_end) = line.number().filter(|_| next_end == b' ')?;
    Some(([x, y, z], last_end))
}

/// How far the squared length may differ from 1 to be corrected without division: to at least six decimal places.
const ALMOST_UNIT: f64 = 1e-4;

/// Returns the vector with length 1, or zero.
#[inline(always)]
fn unit(normal: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = normal;
    let normal = DVec3::new(x.into(), y.into(), z.into());
    let excess = normal.length_squared() - 1.0;
    let unit = if excess.abs() < ALMOST_UNIT {
        // The series of 1 / sqrt(1 + excess): the omitted terms are below the precision of an `f32` (5/16 of the cube).
        normal * (1.0 - excess * (0.5 - 0.375 * excess))
    } else {
        normal.normalize_or_zero()
    };
    unit.as_vec3().to_array()
}

/// Estimates the triangles of faces on lines of their own from the number of blanks and line ends: one precedes each
/// corner, and a polygon has two more corners than triangles.
fn likely_triangles(blanks: usize, faces: usize) -> usize {
    blanks.saturating_sub(3 * faces)
}

/// Lines that were skipped.
struct Others {
    /// The start of the next line.
    end: usize,
    lines: u64,
    /// The estimated number of triangles of their faces.
    triangles: usize,
}

/// Skips lines, the first of which is not an attribute, up to one that may be an attribute, is not plain, or is at
/// `end` or after it.
#[inline]
fn other_lines(bytes: &[u8], start: usize, end: usize) -> Others {
    let (mut line_start, mut lines, mut faces, mut blanks) = (start, 0, 0, Blanks::new());
    let mut is_face = bytes[start] == b'f';
    let mut at = start;
    'windows: while let Some(window) = bytes.get(at..).and_then(|rest| rest.first_chunk::<WINDOW>()) {
        blanks.count(window);
        let mut ends = scan::line_ends(window);
        while ends != 0 {
            let place = at + ends.trailing_zeros() as usize;
            ends &= ends - 1;
            let next = bytes.get(place + 1);
            match bytes[place] {
                b'\n' => {
                    lines += 1;
                    faces += usize::from(is_face);
                    is_face = next == Some(&b'f');
                    line_start = place + 1;
                    let is_plain = !matches!(next, None | Some(b'v' | b' ' | b'\t' | b'\r' | 0x0B | 0x0C | b'\\'));
                    if !is_plain || line_start >= end {
                        break 'windows;
                    }
                }
                b'\r' if next == Some(&b'\n') => {}
                _ => break 'windows,
            }
        }
        at += WINDOW;
    }
    Others { end: line_start, lines, triangles: likely_triangles(blanks.sum(), faces) }
}

/// Describes a non-finite number after the position of a vertex with `count` further numbers; `None` if those numbers
/// are ignored anyway.
pub(crate) fn not_finite_behind_position(count: usize, what: &str) -> Option<String> {
    match count {
        1 => Some(format!("v has the weight {what}, which is not a finite number: it is ignored")),
        2 => None,
        _ => Some(format!("v has the color component {what}, which is not a finite number: using 0 instead")),
    }
}

/// Reads a required coordinate.
fn coordinate(cursor: &mut Cursor<'_>, keyword: &str, needed: usize) -> Result<f32, ReadError> {
    if !cursor.next_word() {
        return Err(too_short(cursor, keyword, needed));
    }
    match cursor.number() {
        Ok(value) => Ok(value),
        Err(BadNumber::Unreadable) => Err(unreadable(cursor, keyword)),
        Err(BadNumber::NotFinite) => Err(not_finite(cursor, keyword)),
    }
}

#[cold]
fn too_short(cursor: &Cursor<'_>, keyword: &str, needed: usize) -> ReadError {
    let numbers = if needed == 1 { "number" } else { "numbers" };
    ReadError::new(format!("{keyword} ends early: it needs at least {needed} {numbers}; is the file cut off?"))
        .at(cursor.line(), Some(cursor.column()))
}

#[cold]
fn unreadable(cursor: &Cursor<'_>, keyword: &str) -> ReadError {
    ReadError::new(format!("{keyword}: expected a number, found {}", quote(cursor.offending_word())))
        .at(cursor.line(), Some(cursor.column()))
}

#[cold]
fn not_finite(cursor: &Cursor<'_>, keyword: &str) -> ReadError {
    let what = quote(cursor.offending_word());
    ReadError::new(format!("{keyword} has the coordinate {what}, which is not a finite number: export the model again"))
        .at(cursor.line(), Some(cursor.column()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths around the limit below which division is avoided: the result is that of the division except for the last
    /// bit, which two ways of rounding may affect.
    #[test]
    fn normals_are_of_unit_length_however_it_is_reached() {
        for step in -2000..=2000_i32 {
            let length = 1.0 + f64::from(step) * 5e-6;
            let normal = [0.36, -0.48, 0.8].map(|x| (x * length) as f32);
            let divided = DVec3::from(normal.map(f64::from)).normalize().as_vec3().to_array();
            for (found, expected) in unit(normal).into_iter().zip(divided) {
                assert!((found - expected).abs() <= f32::EPSILON / 2.0, "{length}: {found} is not {expected}");
            }
        }
        assert_eq!(unit([0.0; 3]), [0.0; 3]);
        assert_eq!(unit([0.0, 3e-30, 4e-30]), [0.0, 0.6, 0.8]);
    }
}
