//! Parts and smoothing groups of the mesh, out of what was said between the faces.

use super::materials::MaterialTable;
use super::part_spans::PartSpans;
use crate::report::Reports;
use crate::{Mesh, Part};
use std::mem;

/// Runs of triangles of all the file.
#[derive(Default)]
pub(super) struct Parts {
    /// Their names, where they begin, and from [`Parts::find_materials`] on the materials.
    parts: Vec<Part>,
    /// The names of their materials, with the line; an empty name is no material. As many as there are parts.
    materials: Vec<Option<(String, u64)>>,
    /// What the next run has.
    name: String,
    material: Option<(String, u64)>,
    smoothing: Vec<(usize, u32)>,
    triangle_count: usize,
}

impl Parts {
    /// The runs of a stretch of so many triangles, which follows those before.
    pub(super) fn append(&mut self, part_spans: PartSpans, triangle_count: usize) {
        let first = self.triangle_count;
        for span in part_spans.spans {
            self.end_span(first + span.first_triangle);
            if let Some(name) = span.part {
                self.name = name;
            }
            if let Some((name, line)) = span.material {
                // The same again is as if it had not been said.
                if self.material.as_ref().is_none_or(|(current, _)| *current != name) {
                    self.material = Some((name, line));
                }
            }
        }
        self.smoothing.extend(part_spans.smoothing.into_iter().map(|(triangle, group)| (first + triangle, group)));
        self.triangle_count += triangle_count;
    }

    /// The triangles up to this one belong to what has been said so far.
    fn end_span(&mut self, end: usize) {
        let first_triangle = self.parts.last().map_or(0, |part| part.first_triangle + part.triangle_count);
        if end > first_triangle {
            let (name, triangle_count) = (self.name.clone(), end - first_triangle);
            self.parts.push(Part { name, material: 0, first_triangle, triangle_count });
            self.materials.push(self.material.clone());
        }
    }

    /// Looks the materials up; runs that do not differ become one.
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

    /// Gives the mesh its parts, whose materials count from `offset`, and smoothing groups.
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
