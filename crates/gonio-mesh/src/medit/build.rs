//! Builds an indexed mesh from faces, with a part for each reference.

use super::content::{Content, Locator};
use super::surface::Face;
use crate::diagnostic::Reports;
use crate::input::{too_many_triangles, too_many_vertices};
use crate::polygon::{Cut, Triangulator};
use crate::weld::Joiner;
use crate::{Diagnostic, Limits, Material, Mesh, NormalSource, Part, ReadError, Severity};
use gonio_light::color::srgb_decode;

/// Most references that get a part of their own.
const MOST_REFERENCES: usize = 1024;

pub(super) fn build(
    content: &Content,
    mut faces: Vec<Face>,
    locator: &Locator<'_>,
    limits: &Limits,
    reports: &mut Reports,
) -> Result<(Mesh, Vec<Material>), ReadError> {
    let triangles: u64 = faces.iter().map(|face| face.vertices().len() as u64 - 2).sum();
    if triangles > limits.max_triangles {
        return Err(too_many_triangles(limits.max_triangles));
    }
    faces.sort_by_key(|face| face.reference);
    let distinct = 1 + faces.windows(2).filter(|pair| pair[0].reference != pair[1].reference).count();
    let are_too_many = distinct > MOST_REFERENCES;
    if are_too_many {
        let message =
            format!("there are {distinct} different references, more than {MOST_REFERENCES}: merged into one part");
        reports.push(u64::MAX, Diagnostic::warning(message));
    }
    let normals = Normals::new(content, locator, reports);
    let mut builder = Builder::new(content, normals, limits, triangles as usize);
    let mut materials: Vec<Material> = Vec::new();
    let mut latest = None;
    for face in &faces {
        if latest != Some(face.reference) && (latest.is_none() || !are_too_many) {
            latest = Some(face.reference);
            builder.begin_part(materials.len());
            materials.push(if are_too_many { Material::default() } else { material_of(face.reference) });
        }
        builder.face(face)?;
    }
    Ok((builder.finish(reports), materials))
}

/// Returns the material `ref N`: 0 is clay. The hues of the others differ as much as possible: each is one golden
/// section of the circle on from the one before (R. Jain's multiplicative hashing of Knuth's constant, as M. Ankerl
/// uses it for colours), with saturation 0.55 and value 0.85 (in sRGB).
fn material_of(reference: i64) -> Material {
    let name = format!("ref {reference}");
    if reference == 0 {
        return Material { name, ..Material::default() };
    }
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let hue = (reference as f64 * GOLDEN).rem_euclid(1.0) * 6.0;
    let diffuse = [5.0, 3.0, 1.0].map(|shift| {
        let k = (shift + hue) % 6.0;
        let encoded = 0.85 - 0.85 * 0.55 * k.min(4.0 - k).clamp(0.0, 1.0);
        srgb_decode(encoded) as f32
    });
    Material { name, diffuse, ..Material::default() }
}

/// Normals of vertices and of corners, as indices from 1; 0 is none.
struct Normals<'a> {
    of_vertices: Vec<u32>,
    of_corners: Vec<(usize, &'a [i64])>,
    count: usize,
}

impl<'a> Normals<'a> {
    fn new(content: &'a Content, locator: &Locator<'_>, reports: &mut Reports) -> Self {
        let count = content.normals.len();
        let mut normals = Normals { of_vertices: Vec::new(), of_corners: Vec::new(), count };
        let mut lost = 0;
        if !content.normal_at_vertices.is_empty() {
            normals.of_vertices = vec![0; content.vertices.len()];
        }
        for [vertex, normal] in &content.normal_at_vertices {
            let place = usize::try_from(*vertex).ok().and_then(|v| normals.of_vertices.get_mut(v.checked_sub(1)?));
            match place {
                Some(place) if (1..=count as i64).contains(normal) => *place = *normal as u32,
                _ => lost += 1,
            }
        }
        for (corners, list) in &content.normal_at_corners {
            let elements = content.elements.iter().find(|e| !e.is_volume && e.corners == *corners);
            let expected = elements.map_or(0, |e| e.references.len() * corners);
            if list.len() == expected {
                // Some files write 0 for none.
                lost += list.iter().filter(|normal| !(0..=count as i64).contains(normal)).count();
                normals.of_corners.push((*corners, list));
            } else {
                lost += list.len();
            }
        }
        if lost > 0 {
            let what = |name: &str| name.starts_with("NormalAt");
            let at = content.counts.iter().find(|(keyword, ..)| what(keyword.name)).map_or(0, |(.., at)| *at);
            let message =
                format!("{lost} normals are missing or belong to no vertex ({count} Normals): using averaged normals");
            locator.report(Severity::Warning, at, reports, message);
        }
        normals
    }

    fn are_any(&self) -> bool {
        self.count > 0 && !(self.of_vertices.is_empty() && self.of_corners.is_empty())
    }

    fn at(&self, face: &Face, corner: usize, vertex: u32) -> u32 {
        let of_corner = face.element.and_then(|(corners, index)| {
            let (_, list) = self.of_corners.iter().find(|(c, _)| *c == corners)?;
            list.get(index * corners + corner).filter(|normal| (1..=self.count as i64).contains(normal))
        });
        let of_vertex = || self.of_vertices.get(vertex as usize).copied().unwrap_or(0);
        of_corner.map_or_else(of_vertex, |normal| *normal as u32)
    }
}

struct Builder<'a> {
    content: &'a Content,
    normals: Normals<'a>,
    has_normals: bool,
    limits: &'a Limits,
    joiner: Joiner<1>,
    mesh: Mesh,
    triangulator: Triangulator,
    not_simple: u64,
}

impl<'a> Builder<'a> {
    fn new(content: &'a Content, normals: Normals<'a>, limits: &'a Limits, triangles: usize) -> Self {
        let mut mesh = Mesh::default();
        mesh.indices.reserve(3 * triangles);
        Builder {
            content,
            has_normals: normals.are_any(),
            normals,
            limits,
            joiner: Joiner::new(content.vertices.len()),
            mesh,
            triangulator: Triangulator::default(),
            not_simple: 0,
        }
    }

    fn begin_part(&mut self, material: usize) {
        let first_triangle = self.mesh.triangle_count();
        self.mesh.parts.push(Part { material, first_triangle, ..Part::default() });
    }

    fn face(&mut self, face: &Face) -> Result<(), ReadError> {
        let mut vertices = [0; 4];
        let mut points = [[0.0; 3]; 4];
        let corners = face.vertices().len();
        for (corner, &vertex) in face.vertices().iter().enumerate() {
            vertices[corner] = self.vertex(face, corner, vertex)?;
            points[corner] = self.content.vertices[vertex as usize];
        }
        let indices = &mut self.mesh.indices;
        let cut = self.triangulator.triangulate(&points[..corners], |t| indices.extend(t.map(|i| vertices[i])));
        self.not_simple += u64::from(cut == Cut::NotSimple);
        if let Some(part) = self.mesh.parts.last_mut() {
            part.triangle_count += corners - 2;
        }
        Ok(())
    }

    fn vertex(&mut self, face: &Face, corner: usize, vertex: u32) -> Result<u32, ReadError> {
        let normal = if self.has_normals { self.normals.at(face, corner, vertex) } else { 0 };
        let (made, is_new) = self.joiner.vertex(vertex, [normal]);
        if is_new {
            let most = self.limits.max_vertices.min(u64::from(u32::MAX) - 1);
            if u64::from(made) >= most {
                return Err(too_many_vertices(most));
            }
            self.mesh.positions.push(self.content.vertices[vertex as usize]);
            if self.has_normals {
                let normal = (normal as usize).checked_sub(1).and_then(|n| self.content.normals.get(n));
                self.mesh.normals.push(normal.copied().unwrap_or_default());
            }
        }
        Ok(made)
    }

    fn finish(mut self, reports: &mut Reports) -> Mesh {
        if self.not_simple > 0 {
            let message = format!("{} quadrilaterals cross themselves: their triangles are guessed", self.not_simple);
            reports.push(u64::MAX, Diagnostic::warning(message));
        }
        self.mesh.normal_source = if self.has_normals { NormalSource::File } else { NormalSource::None };
        self.mesh
    }
}
