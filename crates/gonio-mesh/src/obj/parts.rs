//! Parts and smoothing groups of the mesh, from the statements between the faces.

use super::materials::MaterialTable;
use super::part_spans::PartSpans;
use crate::report::Reports;
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
