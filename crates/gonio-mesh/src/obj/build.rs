//! The second half of reading an OBJ: from faces to an indexed mesh.

use super::faces::{Corner, Faces, NONE, report_index};
use super::materials::MaterialTable;
use super::parse::Statements;
use crate::polygon::{Cut, Triangulator};
use crate::report::Reports;
use crate::{Diagnostic, Limits, Mesh, NormalSource, Part, ReadError};
use std::collections::HashMap;

/// Makes the mesh; what is odd goes into the statements' reports.
pub(super) fn mesh(
    statements: &mut Statements,
    materials: &mut MaterialTable,
    limits: &Limits,
) -> Result<Mesh, ReadError> {
    let counts = [statements.positions.len(), statements.tex_coords.len(), statements.normals.len()];
    let mut reports = std::mem::take(&mut statements.reports);
    let dropped = settle_suspects(&mut statements.faces, counts, &mut reports);
    let mut builder = Builder::new(statements, limits);
    let mut cuts = Cuts::default();
    let mut dropped = dropped.into_iter().peekable();
    let faces = &statements.faces;
    let mut smoothing = faces.smoothing.iter().copied().peekable();
    let mut group = 0;
    let mut first_corner = 0;
    for (run, next) in faces.runs.iter().zip(run_ends(faces)) {
        let material = materials.index_of(run.names.material.as_ref(), &mut reports);
        let first_triangle = builder.triangle_count();
        for face in run.first_face..next {
            let corners = &faces.corners[first_corner..faces.ends[face]];
            first_corner = faces.ends[face];
            while let Some((_, g)) = smoothing.next_if(|(first, _)| *first <= face) {
                group = g;
            }
            if dropped.next_if(|d| *d == face).is_some() {
                continue;
            }
            cuts.count(builder.face(corners)?);
            if !faces.smoothing.is_empty() {
                builder.mesh.smoothing_groups.resize(builder.mesh.indices.len() / 3, group);
            }
        }
        builder.part(&run.names.part, material, first_triangle);
    }
    cuts.report(&mut reports);
    report_missing(&statements.faces, &mut reports);
    let mesh = builder.finish();
    statements.reports = reports;
    Ok(mesh)
}

fn run_ends(faces: &Faces) -> impl Iterator<Item = usize> {
    faces.runs.iter().skip(1).map(|run| run.first_face).chain([faces.ends.len()])
}

/// Indices that pointed beyond the end when they were read: by now everything is there, or it is not. Returns the
/// faces that cannot be drawn, in order.
fn settle_suspects(faces: &mut Faces, counts: [usize; 3], reports: &mut Reports) -> Vec<usize> {
    let mut dropped: Vec<usize> = Vec::new();
    let mut without_any = [false; 3];
    for suspect in std::mem::take(&mut faces.suspects) {
        if suspect.index as u64 <= counts[suspect.kind] as u64 {
            continue;
        }
        let count = counts[suspect.kind];
        if suspect.kind == 0 || count > 0 {
            report_index(reports, suspect.kind, suspect.index, count, suspect.line, suspect.column);
        } else if !std::mem::replace(&mut without_any[suspect.kind], true) {
            let what = ["v", "texture coordinates (vt)", "normals (vn)"][suspect.kind];
            reports.warning(suspect.line, format!("faces have indices of {what}, but the file has none of them"));
        }
        if suspect.kind == 0 {
            if dropped.last() != Some(&suspect.face) {
                dropped.push(suspect.face);
            }
        } else {
            faces.corners[suspect.corner][suspect.kind] = NONE;
        }
    }
    dropped
}

/// Where only some corners have texture coordinates or normals, the picture shows it: say so.
fn report_missing(faces: &Faces, reports: &mut Reports) {
    let total = faces.corners.len() as u64;
    let [(no_tex_coord, tex_line), (no_normal, normal_line)] = faces.without;
    if no_tex_coord > 0 && no_tex_coord < total {
        let message = format!("{no_tex_coord} of {total} corners of faces have no texture coordinate: (0, 0) is taken");
        reports.warning(tex_line, message);
    }
    if no_normal > 0 && no_normal < total {
        let message = format!("{no_normal} of {total} corners of faces have no normal: they are averaged");
        reports.warning(normal_line, message);
    }
}

/// How polygons were cut, as far as it is odd.
#[derive(Default)]
struct Cuts {
    not_simple: u64,
    too_large: u64,
}

impl Cuts {
    fn count(&mut self, cut: Cut) {
        match cut {
            Cut::Fan | Cut::Ears => {}
            Cut::NotSimple => self.not_simple += 1,
            Cut::TooLarge => self.too_large += 1,
        }
    }

    fn report(self, reports: &mut Reports) {
        if self.not_simple > 0 {
            let message =
                format!("{} polygons cross or touch themselves: their triangles are guessed", self.not_simple);
            reports.push(u64::MAX, Diagnostic::warning(message));
        }
        if self.too_large > 0 {
            let most = crate::polygon::MOST_CORNERS_FOR_EARS;
            let message =
                format!("{} concave polygons have more than {most} corners: cut as if convex", self.too_large);
            reports.push(u64::MAX, Diagnostic::warning(message));
        }
    }
}

/// A mesh in the making.
struct Builder<'a> {
    statements: &'a Statements,
    limits: &'a Limits,
    mesh: Mesh,
    has_tex_coords: bool,
    has_normals: bool,
    /// For each position of the file the first vertex of the mesh made of it, ...
    first_vertex: Vec<u32>,
    /// ... for each vertex the next one of the same position, ...
    next_vertex: Vec<u32>,
    /// ... and what else it was made of.
    made_of: Vec<[u32; 2]>,
    /// For positions with many vertices.
    crowded: HashMap<Corner, u32>,
    triangulator: Triangulator,
    polygon_vertices: Vec<u32>,
    polygon_points: Vec<[f32; 3]>,
}

/// How many vertices of one position are looked through one by one.
const MOST_IN_A_CHAIN: usize = 16;

impl<'a> Builder<'a> {
    fn new(statements: &'a Statements, limits: &'a Limits) -> Self {
        let faces = &statements.faces;
        let has = |kind: usize| faces.corners.iter().any(|corner| corner[kind] != NONE);
        let positions = statements.positions.len();
        let mut mesh = Mesh::default();
        let expected = positions.max(statements.tex_coords.len()).min(faces.corners.len());
        mesh.positions.reserve(expected);
        mesh.indices.reserve(faces.corners.len());
        Builder {
            statements,
            limits,
            mesh,
            has_tex_coords: has(1),
            has_normals: has(2),
            first_vertex: vec![NONE; positions],
            next_vertex: Vec::with_capacity(expected),
            made_of: Vec::with_capacity(expected),
            crowded: HashMap::new(),
            triangulator: Triangulator::default(),
            polygon_vertices: Vec::new(),
            polygon_points: Vec::new(),
        }
    }

    fn triangle_count(&self) -> usize {
        self.mesh.indices.len() / 3
    }

    fn face(&mut self, corners: &[Corner]) -> Result<Cut, ReadError> {
        if let [a, b, c] = corners {
            let triangle = [self.vertex(a)?, self.vertex(b)?, self.vertex(c)?];
            self.mesh.indices.extend(triangle);
            self.check_triangles()?;
            return Ok(Cut::Fan);
        }
        self.polygon_vertices.clear();
        for (i, corner) in corners.iter().enumerate() {
            // A corner written twice in a row is one: `f 1 2 3 3` is how some programs write triangles.
            let previous = corners[i.checked_sub(1).unwrap_or(corners.len() - 1)];
            if corner[0] != previous[0] {
                let vertex = self.vertex(corner)?;
                self.polygon_vertices.push(vertex);
            }
        }
        let (positions, vertices) = (&self.mesh.positions, &self.polygon_vertices);
        self.polygon_points.clear();
        self.polygon_points.extend(vertices.iter().map(|&v| positions[v as usize]));
        let indices = &mut self.mesh.indices;
        let cut = self.triangulator.triangulate(&self.polygon_points, |triangle| {
            indices.extend(triangle.map(|i| vertices[i]));
        });
        self.check_triangles()?;
        Ok(cut)
    }

    fn check_triangles(&self) -> Result<(), ReadError> {
        let most = self.limits.max_triangles;
        if self.triangle_count() as u64 <= most {
            return Ok(());
        }
        Err(ReadError::new(format!("holds more than {most} triangles, which is the limit")))
    }

    /// The vertex with this position, texture coordinate and normal: an earlier one, or a new one.
    #[inline]
    fn vertex(&mut self, corner: &Corner) -> Result<u32, ReadError> {
        let rest = [corner[1], corner[2]];
        let position = corner[0] as usize;
        let first = self.first_vertex[position];
        let mut vertex = first;
        let mut steps = 0;
        while vertex != NONE && steps < MOST_IN_A_CHAIN {
            if self.made_of[vertex as usize] == rest {
                return Ok(vertex);
            }
            vertex = self.next_vertex[vertex as usize];
            steps += 1;
        }
        let is_crowded = steps == MOST_IN_A_CHAIN;
        if is_crowded && let Some(&vertex) = self.crowded.get(corner) {
            return Ok(vertex);
        }
        let made = self.new_vertex(corner)?;
        if is_crowded {
            self.crowded.insert(*corner, made);
        } else {
            self.next_vertex[made as usize] = first;
            self.first_vertex[position] = made;
        }
        Ok(made)
    }

    fn new_vertex(&mut self, corner: &Corner) -> Result<u32, ReadError> {
        let statements = self.statements;
        let made = self.mesh.positions.len();
        if made as u64 >= self.limits.max_vertices.min(u64::from(NONE)) {
            let most = self.limits.max_vertices.min(u64::from(NONE));
            return Err(ReadError::new(format!("needs more than {most} vertices, which is the limit")));
        }
        let [position, tex_coord, normal] = corner.map(|index| index as usize);
        self.mesh.positions.push(statements.positions[position]);
        if self.has_tex_coords {
            self.mesh.tex_coords.push(statements.tex_coords.get(tex_coord).copied().unwrap_or_default());
        }
        if self.has_normals {
            self.mesh.normals.push(statements.normals.get(normal).copied().unwrap_or_default());
        }
        if !statements.colors.is_empty() {
            let [r, g, b] = statements.colors.get(position).copied().unwrap_or([1.0; 3]);
            self.mesh.colors.push([r, g, b, 1.0]);
        }
        self.next_vertex.push(NONE);
        self.made_of.push([corner[1], corner[2]]);
        Ok(made as u32)
    }

    /// Ends a part with the triangles since `first_triangle`, or makes the one before longer.
    fn part(&mut self, name: &str, material: usize, first_triangle: usize) {
        let triangle_count = self.triangle_count() - first_triangle;
        match self.mesh.parts.last_mut() {
            _ if triangle_count == 0 => {}
            Some(last) if last.name == name && last.material == material => last.triangle_count += triangle_count,
            _ => self.mesh.parts.push(Part { name: name.to_owned(), material, first_triangle, triangle_count }),
        }
    }

    fn finish(mut self) -> Mesh {
        self.mesh.normal_source = if self.has_normals { NormalSource::File } else { NormalSource::None };
        self.mesh
    }
}
