//! The second pass: converts faces to triangles of vertices, and reads all other statements.

use super::attributes::{Attributes, Segment};
use super::parts::{PartSpans, SmoothingGroup};
use super::plain_face::PlainFace;
use super::statistics::{MOST_COUNTED, Statistics};
use super::triangles::Triangles;
use super::vertices::{Corner, CornerAttributes, Vertices};
use crate::diagnostic::Reports;
use crate::input::too_many_triangles;
use crate::polygon::{Cut, FEW, MOST_CORNERS, Triangulator, too_many_corners};
use crate::text::{Cursor, quote};
use crate::{ReadError, Severity};
use std::mem;

const NONE: u32 = u32::MAX;

/// The results of a range of a file.
pub(super) struct Faces<'a> {
    bytes: &'a [u8],
    positions: &'a [[f32; 3]],
    /// Numbers of positions, texture coordinates and normals in the whole file.
    pub(super) totals: [u64; 3],
    /// The same numbers before the current statement.
    pub(super) counts: [u64; 3],
    line: u64,
    pub(super) vertices: Vertices,
    pub(super) triangles: Triangles<'a>,
    most_triangles: u64,
    pub(super) spans: PartSpans,
    /// Each `mtllib` with its line.
    pub(super) libraries: Vec<(u64, String)>,
    pub(super) statistics: Statistics,
    pub(super) reports: Reports,
    /// Out-of-range indices of the current face.
    beyond: Vec<Beyond>,
    corners: Vec<Corner>,
    polygon: Vec<Corner>,
    polygon_points: Vec<[f32; 3]>,
    polygon_vertices: Vec<u32>,
    triangulator: Triangulator,
}

impl<'a> Faces<'a> {
    /// Reads consecutive segments. `attributes` are those of the whole file.
    pub(super) fn read(
        bytes: &'a [u8],
        attributes: &'a Attributes,
        segments: &[Segment],
        triangles: Triangles<'a>,
        most_triangles: u64,
        fast_path: bool,
    ) -> Result<Self, ReadError> {
        let mut faces = Faces {
            bytes,
            positions: &attributes.positions,
            totals: attributes.counts(),
            counts: [0; 3],
            line: 1,
            vertices: Vertices::new(attributes.positions.len()),
            triangles,
            most_triangles,
            spans: PartSpans::default(),
            libraries: Vec::new(),
            statistics: Statistics::default(),
            reports: Reports::default(),
            beyond: Vec::new(),
            corners: Vec::new(),
            polygon: Vec::new(),
            polygon_points: Vec::new(),
            polygon_vertices: Vec::new(),
            triangulator: Triangulator::default(),
        };
        for segment in segments {
            faces.counts = segment.counts;
            faces.line = segment.line;
            faces.segment(segment.bytes.start, segment.bytes.end, fast_path)?;
        }
        faces.spans.finish(faces.triangles.count());
        Ok(faces)
    }

    /// Reads a segment. It is not inlined, for the reason of [`Attributes::parse`].
    #[inline(never)]
    fn segment(&mut self, start: usize, end: usize, fast_path: bool) -> Result<(), ReadError> {
        let mut at = start;
        while at < end {
            if fast_path && self.bytes[at] == b'f' && self.bytes.get(at + 1) == Some(&b' ') {
                let blanks = usize::from(self.bytes.get(at + 2) == Some(&b' '));
                let start = at + 2 + blanks;
                let is_negative = self.bytes.get(start) == Some(&b'-');
                let next = if is_negative { self.negative_face(start)? } else { self.plain_face::<false>(start)? };
                if let Some(next) = next {
                    self.line += 1;
                    at = next;
                    continue;
                }
            } else if fast_path && self.bytes[at] == b'v' && self.step_over_attribute(&mut at) {
                continue;
            }
            at = self.statement(at)?;
        }
        Ok(())
    }

    /// [`Self::plain_face`] with indices from the end. Exporters write either all or none that way.
    #[inline(never)]
    fn negative_face(&mut self, start: usize) -> Result<Option<usize>, ReadError> {
        self.plain_face::<true>(start)
    }

    /// Skips an attribute, which the first pass has read and found to be on one line.
    fn step_over_attribute(&mut self, at: &mut usize) -> bool {
        let kind = match (self.bytes.get(*at + 1), self.bytes.get(*at + 2)) {
            (Some(b' '), _) => 0,
            (Some(b't'), Some(b' ')) => 1,
            (Some(b'n'), Some(b' ')) => 2,
            _ => return false,
        };
        let rest = &self.bytes[*at..];
        let Some(length) = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else { return false };
        self.counts[kind] += 1;
        self.line += 1;
        let is_pair = rest[length..].starts_with(b"\r\n");
        *at += length + if is_pair { 2 } else { 1 };
        true
    }

    /// Reads a face in plain form from after its keyword; returns the start of the next line. `None` if it is not
    /// plain, or has an error.
    #[inline(always)]
    fn plain_face<const NEGATIVE: bool>(&mut self, start: usize) -> Result<Option<usize>, ReadError> {
        let mut line = PlainFace::new(self.bytes, start);
        let mut corner = |faces: &Self| line.corner::<NEGATIVE>(faces);
        let (Some(a), Some(b), Some(c)) = (corner(self), corner(self), corner(self)) else { return Ok(None) };
        if let Some(next) = line.line_end() {
            self.triangle([a, b, c])?;
            return Ok(Some(next));
        }
        let Some(d) = line.corner::<NEGATIVE>(self) else { return Ok(None) };
        if let Some(next) = line.line_end() {
            self.quadrilateral([a, b, c, d])?;
            return Ok(Some(next));
        }
        let mut corners = mem::take(&mut self.corners);
        corners.clear();
        corners.extend([a, b, c, d]);
        let next = loop {
            let Some(corner) = line.corner::<NEGATIVE>(self) else { break None };
            if corners.len() == MOST_CORNERS {
                break None;
            }
            corners.push(corner);
            if let Some(next) = line.line_end() {
                break Some(next);
            }
        };
        let result = if next.is_some() { self.face(&corners) } else { Ok(()) };
        self.corners = corners;
        result.map(|()| next)
    }

    #[inline(always)]
    fn triangle(&mut self, corners: [Corner; 3]) -> Result<(), ReadError> {
        self.begin_face(&corners);
        let [a, b, c] = corners;
        let triangle = [self.vertices.of_corner(a)?, self.vertices.of_corner(b)?, self.vertices.of_corner(c)?];
        self.triangles.push(triangle);
        Ok(())
    }

    /// Counts a face that will be drawn.
    #[inline(always)]
    fn begin_face(&mut self, corners: &[Corner]) {
        self.statistics.faces[corners.len().min(MOST_COUNTED + 1)] += 1;
        self.spans.begin_face(&self.triangles);
        if corners.iter().fold(false, |lacks, corner| lacks | corner.1.is_incomplete()) {
            self.count_lacking(corners);
        }
    }

    /// Counts corners without a texture coordinate or normal.
    fn count_lacking(&mut self, corners: &[Corner]) {
        let count =
            |lacks: fn(CornerAttributes) -> bool| corners.iter().filter(|corner| lacks(corner.1)).count() as u64;
        let lacking = [count(|kind| kind.tex_coord() == 0), count(|kind| kind.normal() == 0)];
        for (kind, (without, lacking)) in self.statistics.without.iter_mut().zip(lacking).enumerate() {
            if without.0 == 0 {
                without.1 = self.line;
            }
            // Invalid indices have a report of their own.
            without.0 += lacking - self.beyond.iter().filter(|beyond| beyond.kind == kind + 1).count() as u64;
        }
    }

    /// Adds a face of three or more corners.
    fn face(&mut self, corners: &[Corner]) -> Result<(), ReadError> {
        match *corners {
            [a, b, c] => self.triangle([a, b, c]),
            [a, b, c, d] => self.quadrilateral([a, b, c, d]),
            _ => self.polygon(corners),
        }
    }

    #[inline(never)]
    fn quadrilateral(&mut self, corners: [Corner; 4]) -> Result<(), ReadError> {
        let [a, b, c, d] = corners;
        let point = |corner: Corner| self.positions[corner.0 as usize];
        if !Triangulator::is_convex_quadrilateral([point(a), point(b), point(c), point(d)]) {
            return self.polygon(&corners);
        }
        self.begin_face(&corners);
        self.statistics.polygon_corners += 4;
        let mut vertex = |corner| self.vertices.of_corner(corner);
        let [a, b, c, d] = [vertex(a)?, vertex(b)?, vertex(c)?, vertex(d)?];
        self.triangles.push([a, b, c]);
        self.triangles.push([a, c, d]);
        Ok(())
    }

    /// Adds a face of any number of corners.
    #[inline(never)]
    fn polygon(&mut self, corners: &[Corner]) -> Result<(), ReadError> {
        self.find_polygon(corners);
        if self.polygon.len() < 3 {
            self.statistics.lost += 1;
            self.reports.add_loss("faces with fewer than 3 different corners", self.line, None, || {
                "f has fewer than 3 different corners: it is left out".to_owned()
            });
            return Ok(());
        }
        self.begin_face(corners);
        self.statistics.polygon_corners += corners.len() as u64;
        let cut = self.cut()?;
        match cut {
            Cut::Fan | Cut::Ears => {}
            Cut::NotSimple => self.statistics.cuts[0] += 1,
            Cut::TooLarge => self.statistics.cuts[1] += 1,
        }
        // Only polygons take much more memory than their text.
        if self.triangles.count() as u64 > self.most_triangles {
            return Err(too_many_triangles(self.most_triangles).at(self.line, None));
        }
        Ok(())
    }

    /// Triangulates the polygon.
    fn cut(&mut self) -> Result<Cut, ReadError> {
        let n = self.polygon.len();
        let mut few = ([[0.0; 3]; FEW], [NONE; FEW]);
        let (points, known) = if n <= FEW {
            (&mut few.0[..n], &mut few.1[..n])
        } else {
            self.polygon_points.resize(n, [0.0; 3]);
            self.polygon_vertices.clear();
            self.polygon_vertices.resize(n, NONE);
            (&mut self.polygon_points[..], &mut self.polygon_vertices[..])
        };
        for (point, corner) in points.iter_mut().zip(&self.polygon) {
            *point = self.positions[corner.0 as usize];
        }
        let mut error = None;
        // Vertices are numbered in the order of the triangles, the only order known where pieces are joined.
        let cut = self.triangulator.triangulate(points, |triangle| {
            for corner in triangle {
                if known[corner] == NONE {
                    match self.vertices.of_corner(self.polygon[corner]) {
                        Ok(vertex) => known[corner] = vertex,
                        Err(found) => error = Some(found),
                    }
                }
            }
            let [a, b, c] = triangle;
            self.triangles.push([known[a], known[b], known[c]]);
        });
        error.map_or(Ok(cut), Err)
    }

    /// Collects the corners of a polygon that differ from the previous one.
    fn find_polygon(&mut self, corners: &[Corner]) {
        self.polygon.clear();
        let mut previous = corners.last().map(|corner| corner.0);
        for &corner in corners {
            // A repeated corner counts once: some programs write triangles as `f 1 2 3 3`.
            if previous != Some(corner.0) {
                self.polygon.push(corner);
            }
            previous = Some(corner.0);
        }
    }

    /// Reads any statement, byte by byte; returns the start of the next one.
    #[inline(never)]
    fn statement(&mut self, at: usize) -> Result<usize, ReadError> {
        let mut cursor = Cursor::at_line(self.bytes, at, self.line);
        if cursor.next_word() {
            let line = cursor.line();
            self.line = line;
            let keyword = cursor.word();
            let is_understood = match keyword {
                b"v" => self.count(0),
                b"vt" => self.count(1),
                b"vn" => self.count(2),
                b"f" | b"fo" => self.any_face(&mut cursor)?,
                b"o" | b"g" => {
                    self.statistics.names[usize::from(keyword == b"g")] += 1;
                    self.spans.name_part(cursor.name());
                    true
                }
                b"s" => self.smoothing_group(&mut cursor),
                b"usemtl" => {
                    self.statistics.names[3] += 1;
                    self.spans.use_material(cursor.name(), line);
                    true
                }
                b"mtllib" => self.library(&mut cursor),
                _ => self.statistics.tallies.count(keyword, line),
            };
            self.statistics.statements += u64::from(is_understood);
        }
        cursor.next_line();
        self.line = cursor.line();
        Ok(cursor.position().min(self.bytes.len()))
    }

    /// Counts an attribute, which the first pass has read.
    fn count(&mut self, kind: usize) -> bool {
        self.counts[kind] += 1;
        false
    }

    fn library(&mut self, cursor: &mut Cursor<'_>) -> bool {
        self.statistics.names[4] += 1;
        let line = cursor.line();
        let name = cursor.name();
        if name.is_empty() {
            self.reports.add("mtllib without a name", Severity::Warning, line, None, || {
                "mtllib names no material library".to_owned()
            });
        } else {
            self.libraries.push((line, name));
        }
        true
    }

    fn smoothing_group(&mut self, cursor: &mut Cursor<'_>) -> bool {
        self.statistics.names[2] += 1;
        let group = SmoothingGroup::read(cursor);
        if let Some((line, column, message)) = group.problem {
            let kind = "smoothing groups that are not understood";
            self.reports.add(kind, Severity::Warning, line, Some(column), || message);
        }
        self.spans.smooth(self.triangles.count(), group.number);
        true
    }

    /// Reads an `f` in any form, and counts it.
    fn any_face(&mut self, cursor: &mut Cursor<'_>) -> Result<bool, ReadError> {
        let mut corners = mem::take(&mut self.corners);
        corners.clear();
        self.beyond.clear();
        let mut is_lost = false;
        while !is_lost && cursor.next_word() {
            match self.corner(cursor)? {
                Some(_) if corners.len() == MOST_CORNERS => {
                    return Err(too_many_corners("f").at(cursor.line(), Some(cursor.column())));
                }
                Some(corner) => corners.push(corner),
                None => is_lost = true,
            }
        }
        if !is_lost && corners.len() < 3 {
            is_lost = true;
            self.reports.add_loss("faces with fewer than 3 corners", self.line, None, || {
                let s = if corners.len() == 1 { "" } else { "s" };
                format!("f has {} corner{s}, too few for a triangle: it is left out", corners.len())
            });
        }
        if !is_lost {
            is_lost = self.report_beyond();
        }
        let result = if is_lost { Ok(()) } else { self.face(&corners) };
        self.beyond.clear();
        self.statistics.lost += u64::from(is_lost);
        self.corners = corners;
        result.map(|()| false)
    }

    /// Reports the face's out-of-range indices. Returns whether the face is lost because of them.
    fn report_beyond(&mut self) -> bool {
        let beyond = mem::take(&mut self.beyond);
        for &Beyond { kind, index, line, column } in &beyond {
            self.report_index(kind, index, line, column);
        }
        self.beyond = beyond;
        self.beyond.iter().any(|beyond| beyond.kind == 0)
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`. `None` drops the face.
    fn corner(&mut self, cursor: &mut Cursor<'_>) -> Result<Option<Corner>, ReadError> {
        let mut corner = [1, 0, 0];
        for (kind, place) in corner.iter_mut().enumerate() {
            let column = cursor.column();
            match cursor.integer() {
                Some(index) => match self.resolve(index, kind) {
                    Some(index) => *place = index,
                    None if index > 0 => self.beyond.push(Beyond { kind, index, line: cursor.line(), column }),
                    None => {
                        self.report_index(kind, index, cursor.line(), column);
                        if kind == 0 {
                            return Ok(None);
                        }
                    }
                },
                None if kind > 0 && (cursor.at_word_end() || cursor.peek() == Some(b'/')) => {}
                None => return Err(not_a_corner(cursor)),
            }
            if kind == 2 || cursor.peek() != Some(b'/') {
                break;
            }
            cursor.advance();
        }
        if !cursor.at_word_end() {
            return Err(not_a_corner(cursor));
        }
        Ok(Some(((corner[0] - 1) as u32, CornerAttributes::new(corner[1], corner[2]))))
    }

    /// Resolves an index, from 1 or negative; `None` if it is out of range.
    #[inline(always)]
    fn resolve(&self, index: i64, kind: usize) -> Option<u64> {
        let index = if index < 0 { self.counts[kind].checked_add_signed(index)? + 1 } else { index as u64 };
        (1..=self.totals[kind]).contains(&index).then_some(index)
    }

    /// Reports an out-of-range index: without a position the face is lost, the other attributes are optional.
    #[cold]
    fn report_index(&mut self, kind: usize, index: i64, line: u64, column: u64) {
        let total = self.totals[kind];
        if kind > 0 && index > 0 && total == 0 {
            self.statistics.without_any[kind - 1].get_or_insert(line);
            return;
        }
        const MORE: [&str; 3] =
            ["invalid vertex indices", "invalid texture coordinate indices", "invalid normal indices"];
        let (keyword, one, many, consequence) = match kind {
            0 => ("v", "vertex", "vertices", "the face is left out"),
            1 => ("vt", "texture coordinate", "texture coordinates", "using (0, 0)"),
            _ => ("vn", "normal", "normals", "using an averaged normal"),
        };
        let count = if index < 0 { self.counts[kind] } else { total };
        let message = || {
            let exist = if count == 1 { format!("is 1 {one}") } else { format!("are {count} {many}") };
            let problem = match index {
                0 => "but indices are counted from 1".to_owned(),
                _ if index < 0 => format!("but there {exist} before it"),
                _ => format!("but there {exist}"),
            };
            format!("f has the {keyword} index {index}, {problem}: {consequence}")
        };
        if kind == 0 {
            self.reports.add_loss(MORE[kind], line, Some(column), message);
        } else {
            self.reports.add(MORE[kind], Severity::Warning, line, Some(column), message);
        }
    }
}

/// An out-of-range index.
struct Beyond {
    /// 0 for position, 1 for texture coordinate, 2 for normal.
    kind: usize,
    index: i64,
    line: u64,
    column: u64,
}

#[cold]
fn not_a_corner(cursor: &Cursor<'_>) -> ReadError {
    let what = quote(cursor.offending_word());
    ReadError::new(format!("f: expected an index (v, v/vt, v//vn or v/vt/vn), found {what}"))
        .at(cursor.line(), Some(cursor.column()))
}
