//! Statements before a face that apply to it: its part, its material, its smoothing group.

use super::triangles::Triangles;
use crate::text::{Cursor, quote};
use std::mem;

/// Spans of triangles in a range of a file.
#[derive(Default)]
pub(super) struct PartSpans {
    pub(super) spans: Vec<PartSpan>,
    /// The first triangle of each smoothing group, and its number.
    pub(super) smoothing: Vec<(usize, u32)>,
    /// Settings since the last span.
    next: Option<PartSpan>,
    /// The last settings, if they are in this range.
    last: PartSpan,
}

/// A span of triangles with one name and material.
#[derive(Clone, Default)]
pub(super) struct PartSpan {
    pub(super) first_triangle: usize,
    /// The latest of `o` and `g`; `None` if it is that of the previous span.
    pub(super) part: Option<String>,
    /// `usemtl` (an empty name is no material) and its line; `None` if it is that of the previous span.
    pub(super) material: Option<(String, u64)>,
}

/// An `s` statement.
pub(crate) struct SmoothingGroup {
    /// The number of the group; 0 is off.
    pub(crate) number: u32,
    /// Line, column and problem if it cannot be read.
    pub(crate) problem: Option<(u64, u64, String)>,
}

impl SmoothingGroup {
    /// Reads the statement from after its keyword.
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
    /// Handles `o` and `g`.
    pub(super) fn name_part(&mut self, name: String) {
        if self.last.part.as_ref() != Some(&name) {
            self.last.part = Some(name.clone());
            self.next.get_or_insert_default().part = Some(name);
        }
    }

    /// Handles `usemtl`.
    pub(super) fn use_material(&mut self, name: String, line: u64) {
        if self.last.material.as_ref().is_none_or(|(last, _)| *last != name) {
            self.last.material = Some((name.clone(), line));
            self.next.get_or_insert_default().material = Some((name, line));
        }
    }

    /// Handles `s`.
    pub(super) fn smooth(&mut self, first_triangle: usize, group: u32) {
        match self.smoothing.last_mut() {
            // The previous group is empty.
            Some(last) if last.0 == first_triangle => last.1 = group,
            Some(last) if last.1 == group => {}
            _ => self.smoothing.push((first_triangle, group)),
        }
    }

    /// Called before a face is added: the current settings take effect.
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

    /// Ends the range: settings after its last face apply to the next range.
    pub(super) fn finish(&mut self, first_triangle: usize) {
        if self.next.is_some() {
            self.begin_span(first_triangle);
        }
    }
}
