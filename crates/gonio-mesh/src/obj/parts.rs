//! Parts and smoothing groups of the mesh, from the statements between the faces.

use super::materials::MaterialTable;
use super::triangles::Triangles;
use crate::diagnostic::Reports;
use crate::text::{Cursor, quote};
use crate::{Mesh, Part};
use std::mem;

/// Spans of triangles in the whole file.
#[derive(Default)]
pub(super) struct Parts {
    /// Names and ranges, with materials from [`Parts::find_materials`] on.
    parts: Vec<Part>,
    /// The names of their materials, with the line, for each part; an empty name is no material.
    materials: Vec<Option<(String, u64)>>,
    /// The settings of the next span.
    name: String,
    material: Option<(String, u64)>,
    smoothing: Vec<(usize, u32)>,
    triangle_count: usize,
}

impl Parts {
    /// Appends the spans of a range with a number of triangles.
    pub(super) fn append(&mut self, part_spans: PartSpans, triangle_count: usize) {
        let first = self.triangle_count;
        for span in part_spans.spans {
            self.end_span(first + span.first_triangle);
            if let Some(name) = span.part {
                self.name = name;
            }
            if let Some((name, line)) = span.material {
                // Repeating the current name changes nothing.
                if self.material.as_ref().is_none_or(|(current, _)| *current != name) {
                    self.material = Some((name, line));
                }
            }
        }
        self.smoothing.extend(part_spans.smoothing.into_iter().map(|(triangle, group)| (first + triangle, group)));
        self.triangle_count += triangle_count;
    }

    /// Assigns the triangles up to this one to the current settings.
    fn end_span(&mut self, end: usize) {
        let first_triangle = self.parts.last().map_or(0, |part| part.first_triangle + part.triangle_count);
        if end > first_triangle {
            let (name, triangle_count) = (self.name.clone(), end - first_triangle);
            self.parts.push(Part { name, material: 0, first_triangle, triangle_count });
            self.materials.push(self.material.clone());
        }
    }

    /// Looks up the materials; merges adjacent spans that do not differ.
    pub(super) fn find_materials(&mut self, table: &mut MaterialTable, reports: &mut Reports) {
        self.end_span(self.triangle_count);
        let mut parts: Vec<Part> = Vec::new();
        for (part, named) in mem::take(&mut self.parts).into_iter().zip(mem::take(&mut self.materials)) {
            let material = table.index_of(named.filter(|(name, _)| !name.is_empty()));
            match parts.last_mut() {
                Some(last) if last.name == part.name && last.material == material => {
                    last.triangle_count += part.triangle_count;
                }
                _ => parts.push(Part { material, ..part }),
            }
        }
        table.report_unknown(reports);
        self.parts = parts;
    }

    /// Sets the mesh's parts, whose materials count from `offset`, and its smoothing groups.
    pub(super) fn finish(self, mesh: &mut Mesh, offset: usize) {
        mesh.parts = self.parts;
        mesh.parts.iter_mut().for_each(|part| part.material -= offset);
        if self.smoothing.is_empty() {
            return;
        }
        let mut groups = Vec::with_capacity(self.triangle_count);
        let mut group = 0;
        for (first, next) in self.smoothing {
            groups.resize(first, group);
            group = next;
        }
        groups.resize(self.triangle_count, group);
        mesh.smoothing_groups = groups;
    }
}

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
