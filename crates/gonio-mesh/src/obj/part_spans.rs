//! What the statements before a face say of it: its part, its material, its smoothing group.

use super::triangles::Triangles;
use crate::text::{Cursor, quote};
use std::mem;

/// Runs of triangles in a stretch of a file.
#[derive(Default)]
pub(super) struct PartSpans {
    pub(super) spans: Vec<PartSpan>,
    /// Where each smoothing group begins (a triangle), and its number.
    pub(super) smoothing: Vec<(usize, u32)>,
    /// What has been said since the last span.
    next: Option<PartSpan>,
    /// What was said last, perhaps in this stretch.
    last: PartSpan,
}

/// A span of triangles with one name and material.
#[derive(Clone, Default)]
pub(super) struct PartSpan {
    pub(super) first_triangle: usize,
    /// The latest of `o` and `g`; `None` where it is that of the span before.
    pub(super) part: Option<String>,
    /// `usemtl` (an empty name is no material) and its line; `None` where it is that of the span before.
    pub(super) material: Option<(String, u64)>,
}

/// What an `s` says.
pub(crate) struct SmoothingGroup {
    /// 0 is off.
    pub(crate) number: u32,
    /// Line, column and what is wrong, where it cannot be read.
    pub(crate) problem: Option<(u64, u64, String)>,
}

impl SmoothingGroup {
    /// From behind the keyword on.
    pub(crate) fn read(cursor: &mut Cursor<'_>) -> Self {
        let has_word = cursor.next_word();
        let (line, column) = (cursor.line(), cursor.column());
        let word = if has_word { cursor.word() } else { b"" };
        let number = match word {
            b"off" => Some(0),
            b"on" => Some(1),
            _ => std::str::from_utf8(word).ok().and_then(|text| text.parse::<u32>().ok()),
        };
        let problem = number.is_none().then(|| {
            let what = quote(word);
            (line, column, format!("s is followed by {what} instead of a number or off: treated as off"))
        });
        SmoothingGroup { number: number.unwrap_or(0), problem }
    }
}

impl PartSpans {
    /// `o` or `g`.
    pub(super) fn name_part(&mut self, name: String) {
        if self.last.part.as_ref() != Some(&name) {
            self.last.part = Some(name.clone());
            self.next.get_or_insert_default().part = Some(name);
        }
    }

    /// `usemtl`.
    pub(super) fn use_material(&mut self, name: String, line: u64) {
        if self.last.material.as_ref().is_none_or(|(last, _)| *last != name) {
            self.last.material = Some((name.clone(), line));
            self.next.get_or_insert_default().material = Some((name, line));
        }
    }

    /// `s`.
    pub(super) fn smooth(&mut self, first_triangle: usize, group: u32) {
        match self.smoothing.last_mut() {
            // Nothing came of the one before.
            Some(last) if last.0 == first_triangle => last.1 = group,
            Some(last) if last.1 == group => {}
            _ => self.smoothing.push((first_triangle, group)),
        }
    }

    /// Before a face is taken, behind these triangles: what has been said begins to count.
    #[inline(always)]
    pub(super) fn begin_face(&mut self, before: &Triangles<'_>) {
        if self.next.is_some() {
            self.begin_span(before.count());
        }
    }

    #[cold]
    fn begin_span(&mut self, first_triangle: usize) {
        let span = mem::take(&mut self.next).unwrap_or_default();
        self.spans.push(PartSpan { first_triangle, ..span });
    }

    /// The stretch is over: what was said after its last face is for the one after it.
    pub(super) fn finish(&mut self, first_triangle: usize) {
        if self.next.is_some() {
            self.begin_span(first_triangle);
        }
    }
}
