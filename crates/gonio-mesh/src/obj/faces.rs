//! Faces as they are read: corners, and which part, material and smoothing group they belong to.

use crate::report::Reports;
use crate::text::{Cursor, quote};
use crate::{ReadError, Severity};

/// No such index.
pub(super) const NONE: u32 = u32::MAX;

/// Position, texture coordinate, normal: indices from 0, the last two perhaps [`NONE`].
pub(super) type Corner = [u32; 3];

/// All faces of a file.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) corners: Vec<Corner>,
    /// Where each face's corners end.
    pub(super) ends: Vec<usize>,
    /// Faces with the same name and material.
    pub(super) runs: Vec<Run>,
    /// Where each smoothing group begins (a face), and its number; empty where the file says nothing.
    pub(super) smoothing: Vec<(usize, u32)>,
    /// Indices beyond what was there when their face was read; it may have come later.
    pub(super) suspects: Vec<Suspect>,
    /// Corners without texture coordinate, or normal; and the first line with one.
    pub(super) without: [(u64, u64); 2],
    /// How many `f` there were, dropped ones included.
    pub(super) count: u64,
    current: Names,
    is_current_run: bool,
}

/// A run of faces with one name and material.
pub(super) struct Run {
    pub(super) first_face: usize,
    pub(super) names: Names,
}

/// What the statements before a face named.
#[derive(Clone, Default, PartialEq)]
pub(super) struct Names {
    /// The latest of `o` and `g`.
    pub(super) part: String,
    /// `usemtl`, and its line.
    pub(super) material: Option<(String, u64)>,
}

/// An index that was too large when it was read.
pub(super) struct Suspect {
    pub(super) face: usize,
    pub(super) corner: usize,
    /// 0 position, 1 texture coordinate, 2 normal.
    pub(super) kind: usize,
    /// As written.
    pub(super) index: i64,
    pub(super) line: u64,
    pub(super) column: u64,
}

impl Faces {
    /// Room for so many triangles.
    pub(super) fn reserve(&mut self, triangles: usize) {
        self.corners.reserve(3 * triangles);
        self.ends.reserve(triangles);
    }

    /// `o` or `g`.
    pub(super) fn name_part(&mut self, name: String) {
        self.is_current_run &= self.current.part == name;
        self.current.part = name;
    }

    /// `usemtl`; an empty name is no material.
    pub(super) fn use_material(&mut self, name: String, line: u64) {
        let is_same = match &self.current.material {
            Some((current, _)) => *current == name,
            None => name.is_empty(),
        };
        if !is_same {
            self.is_current_run = false;
            self.current.material = (!name.is_empty()).then_some((name, line));
        }
    }

    /// `s`.
    pub(super) fn smooth(&mut self, group: u32) {
        if self.smoothing.is_empty() && !self.ends.is_empty() {
            self.smoothing.push((0, 0));
        }
        self.smoothing.push((self.ends.len(), group));
    }

    /// Reads the corners of an `f`. `counts` are those of the positions, texture coordinates and normals so far.
    pub(super) fn read(
        &mut self,
        cursor: &mut Cursor<'_>,
        counts: [usize; 3],
        reports: &mut Reports,
    ) -> Result<(), ReadError> {
        let first = self.corners.len();
        let first_suspect = self.suspects.len();
        let line = cursor.line();
        self.count += 1;
        while cursor.next_word() {
            match self.corner(cursor, counts, reports)? {
                Some(corner) => self.corners.push(corner),
                None => {
                    self.forget_face(first, first_suspect);
                    return Ok(());
                }
            }
        }
        let corners = self.corners.len() - first;
        if corners < 3 {
            reports.add_loss("faces with fewer than 3 corners", line, None, || {
                let corners = if corners == 1 { "1 corner".to_owned() } else { format!("{corners} corners") };
                format!("f has {corners}, too few for a triangle: it is left out")
            });
            self.forget_face(first, first_suspect);
            return Ok(());
        }
        for (kind, (count, first_line)) in self.without.iter_mut().enumerate() {
            let lacking = self.corners[first..].iter().filter(|corner| corner[kind + 1] == NONE).count() as u64;
            if *count == 0 && lacking > 0 {
                *first_line = line;
            }
            *count += lacking;
        }
        if !self.is_current_run {
            self.runs.push(Run { first_face: self.ends.len(), names: self.current.clone() });
            self.is_current_run = true;
        }
        self.ends.push(self.corners.len());
        Ok(())
    }

    fn forget_face(&mut self, first_corner: usize, first_suspect: usize) {
        self.corners.truncate(first_corner);
        self.suspects.truncate(first_suspect);
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`. `None` drops the face.
    #[inline]
    fn corner(
        &mut self,
        cursor: &mut Cursor<'_>,
        counts: [usize; 3],
        reports: &mut Reports,
    ) -> Result<Option<Corner>, ReadError> {
        let mut corner = [NONE; 3];
        for kind in 0..3 {
            let column = cursor.column();
            match cursor.integer() {
                Some(index) if index > 0 && index <= counts[kind] as i64 => corner[kind] = (index - 1) as u32,
                Some(index) if index < 0 && index >= -(counts[kind] as i64) => {
                    corner[kind] = (counts[kind] as i64 + index) as u32;
                }
                Some(index) if index > 0 && index < i64::from(NONE) => {
                    corner[kind] = (index - 1) as u32;
                    let (face, line) = (self.ends.len(), cursor.line());
                    self.suspects.push(Suspect { face, corner: self.corners.len(), kind, index, line, column });
                }
                Some(index) => {
                    report_index(reports, kind, index, counts[kind], cursor.line(), column);
                    if kind == 0 {
                        return Ok(None);
                    }
                }
                None if kind > 0 && (cursor.at_word_end() || cursor.peek() == Some(b'/')) => {}
                None => return Err(not_a_corner(cursor)),
            }
            if kind == 2 || cursor.peek() != Some(b'/') {
                break;
            }
            cursor.advance();
        }
        if cursor.at_word_end() { Ok(Some(corner)) } else { Err(not_a_corner(cursor)) }
    }
}

#[cold]
fn not_a_corner(cursor: &Cursor<'_>) -> ReadError {
    let what = quote(cursor.offending_word());
    ReadError::new(format!("f has {what} where an index should be (v, v/vt, v//vn or v/vt/vn)"))
        .at(cursor.line(), Some(cursor.column()))
}

/// Says that an index points at nothing: without a position the face is lost, the rest can be done without.
#[cold]
pub(super) fn report_index(reports: &mut Reports, kind: usize, index: i64, count: usize, line: u64, column: u64) {
    const MORE: [&str; 3] = [
        "indices of vertices that point at nothing",
        "indices of texture coordinates that point at nothing",
        "indices of normals that point at nothing",
    ];
    let (keyword, one, many, consequence) = match kind {
        0 => ("v", "vertex", "vertices", "the face is left out"),
        1 => ("vt", "texture coordinate", "texture coordinates", "(0, 0) is taken"),
        _ => ("vn", "normal", "normals", "it is averaged"),
    };
    let message = || {
        let exist = if count == 1 { format!("is 1 {one}") } else { format!("are {count} {many}") };
        let problem = match index {
            0 => "but indices count from 1".to_owned(),
            _ if index < 0 => format!("but there {exist} before it"),
            _ => format!("but there {exist}"),
        };
        format!("f has the {keyword} index {index}, {problem}: {consequence}")
    };
    if kind == 0 {
        reports.add_loss(MORE[kind], line, Some(column), message);
    } else {
        reports.add(MORE[kind], Severity::Warning, line, Some(column), message);
    }
}
