//! Builds an indexed mesh from vertices and polygons.

use super::faces::{Faces, NO_TEXTURE};
use super::vertices::Vertices;
use crate::diagnostic::{Reports, Tally};
use crate::input::{too_many_triangles, too_many_vertices};
use crate::polygon::{Cut, MOST_CORNERS_FOR_EARS, Triangulator};
use crate::weld::Joiner;
use crate::{Diagnostic, Limits, Mesh, NormalSource, Part, ReadError, Severity};

/// Indices into the file's vertices, three for each triangle, and for each index its corner of a face.
struct Triangles {
    indices: Vec<u32>,
    /// Empty if corners and faces have no attributes.
    corners: Vec<usize>,
    parts: Vec<Part>,
}

/// Builds the mesh. Vertices without triangles are left out.
pub(super) fn mesh(
    vertices: Vertices,
    faces: &Faces,
    texture_count: usize,
    limits: &Limits,
    reports: &mut Reports,
) -> Result<Mesh, ReadError> {
    let triangles = cut(&vertices, faces, texture_count, limits, reports)?;
    let has_normals = !vertices.normals.is_empty();
    let whole = Mesh {
        positions: vertices.positions,
        normals: vertices.normals,
        tex_coords: vertices.tex_coords,
        colors: vertices.colors,
        indices: triangles.indices,
        parts: triangles.parts,
        normal_source: if has_normals { NormalSource::File } else { NormalSource::None },
        ..Mesh::default()
    };
    let colors: &[[f32; 4]] = if whole.colors.is_empty() { &faces.colors } else { &[] };
    if colors.is_empty() && faces.tex_coords.is_empty() {
        return Ok(without_unused(whole, reports));
    }
    split(whole, faces, colors, &triangles.corners, limits)
}

/// Triangulates all faces.
fn cut(
    vertices: &Vertices,
    faces: &Faces,
    texture_count: usize,
    limits: &Limits,
    reports: &mut Reports,
) -> Result<Triangles, ReadError> {
    let keeps_corners = !faces.tex_coords.is_empty() || !faces.colors.is_empty();
    let mut triangles =
        Triangles { indices: Vec::with_capacity(faces.corners.len()), corners: Vec::new(), parts: Vec::new() };
    let mut anomalies = Anomalies::default();
    let mut triangulator = Triangulator::default();
    let (mut polygon, mut points) = (Vec::new(), Vec::new());
    let mut first_corner = 0;
    for (face, &end) in faces.ends.iter().enumerate() {
        let corners = &faces.corners[first_corner..end];
        let first = std::mem::replace(&mut first_corner, end);
        polygon.clear();
        for (i, corner) in corners.iter().enumerate() {
            // A repeated corner counts once.
            if *corner != corners[i.checked_sub(1).unwrap_or(corners.len() - 1)] {
                polygon.push(first + i);
            }
        }
        points.clear();
        points.extend(polygon.iter().map(|&corner| vertices.positions[faces.corners[corner] as usize]));
        if vertices.not_finite > 0 && !points.iter().flatten().all(|c| c.is_finite()) {
            anomalies.not_finite += 1;
            continue;
        }
        let before = triangles.indices.len() / 3;
        let how = triangulator.triangulate(&points, |triangle| {
            let corners = triangle.map(|i| polygon[i]);
            triangles.indices.extend(corners.map(|corner| faces.corners[corner]));
            if keeps_corners {
                triangles.corners.extend(corners.map(|corner| if faces.tex_coords.is_empty() { face } else { corner }));
            }
        });
        anomalies.count(how);
        let after = triangles.indices.len() / 3;
        if after as u64 > limits.max_triangles {
            return Err(too_many_triangles(limits.max_triangles));
        }
        let material = anomalies.material(faces.textures.get(face).copied().unwrap_or(0), texture_count, face);
        extend_parts(&mut triangles.parts, material, before, after - before);
    }
    anomalies.report(reports);
    Ok(triangles)
}

fn extend_parts(parts: &mut Vec<Part>, material: usize, first_triangle: usize, triangle_count: usize) {
    match parts.last_mut() {
        _ if triangle_count == 0 => {}
        Some(last) if last.material == material => last.triangle_count += triangle_count,
        _ => parts.push(Part { name: String::new(), material, first_triangle, triangle_count }),
    }
}

/// Counts of oddities in faces.
#[derive(Default)]
struct Anomalies {
    not_finite: u64,
    not_simple: u64,
    too_large: u64,
    textures: Tally,
}

impl Anomalies {
    fn count(&mut self, cut: Cut) {
        match cut {
            Cut::Fan | Cut::Ears => {}
            Cut::NotSimple => self.not_simple += 1,
            Cut::TooLarge => self.too_large += 1,
        }
    }

    /// Returns the material of a face: that of its texture if it exists; after these, that of no texture.
    fn material(&mut self, number: i64, count: usize, face: usize) -> usize {
        if number == NO_TEXTURE {
            return count;
        }
        if let Some(number) = usize::try_from(number).ok().filter(|&number| number < count.max(1)) {
            return number;
        }
        if count > 0 {
            self.textures.add(None, || format!("the first is face {face}"));
        }
        0
    }

    fn report(&self, reports: &mut Reports) {
        let mut warn = |count: u64, message: String| {
            if count > 0 {
                reports.push(u64::MAX, Diagnostic::warning(message));
            }
        };
        let count = self.not_finite;
        warn(count, format!("{count} polygons have corners whose position is not finite: left out"));
        let count = self.not_simple;
        warn(count, format!("{count} polygons cross or touch themselves: their triangles are guessed"));
        let (count, most) = (self.too_large, MOST_CORNERS_FOR_EARS);
        warn(count, format!("{count} concave polygons have more than {most} corners: triangulated as if convex"));
        self.textures.report(Severity::Warning, reports, |tally| {
            let faces = tally.counted("face has", "faces have");
            format!("{faces} a texnumber without a comment TextureFile ({}): using the first texture", tally.first)
        });
    }
}

/// Splits vertices where corners have texture coordinates or a colour of their own.
fn split(
    whole: Mesh,
    faces: &Faces,
    colors: &[[f32; 4]],
    corners: &[usize],
    limits: &Limits,
) -> Result<Mesh, ReadError> {
    let mut joiner = Joiner::new(whole.positions.len());
    let mut mesh = Mesh { normal_source: whole.normal_source, parts: whole.parts, ..Mesh::default() };
    let by_corner = !faces.tex_coords.is_empty();
    for (&vertex, &corner) in whole.indices.iter().zip(corners) {
        let tex_coord = if by_corner { faces.tex_coords.get(corner).copied() } else { None };
        let face = |corner| if by_corner { faces.ends.partition_point(|&end| end <= corner) } else { corner };
        let color = if colors.is_empty() { None } else { colors.get(face(corner)).copied() };
        let [u, v] = tex_coord.unwrap_or_default().map(f32::to_bits);
        let [r, g, b, a] = color.unwrap_or_default().map(f32::to_bits);
        let (index, is_new) = joiner.vertex(vertex, [u, v, r, g, b, a]);
        if is_new {
            let old = vertex as usize;
            mesh.positions.push(whole.positions[old]);
            mesh.normals.extend(whole.normals.get(old));
            mesh.tex_coords.extend(tex_coord.or(whole.tex_coords.get(old).copied()));
            mesh.colors.extend(color.or(whole.colors.get(old).copied()));
            if mesh.positions.len() as u64 > limits.max_vertices {
                return Err(too_many_vertices(limits.max_vertices));
            }
        }
        mesh.indices.push(index);
    }
    Ok(mesh)
}

/// Removes vertices without triangles, keeping the order.
fn without_unused(mesh: Mesh, reports: &mut Reports) -> Mesh {
    let mut is_used = vec![false; mesh.positions.len()];
    mesh.indices.iter().for_each(|&vertex| is_used[vertex as usize] = true);
    let unused = is_used.iter().filter(|used| !**used).count();
    if unused == 0 {
        return mesh;
    }
    let vertices = if unused == 1 { "vertex is" } else { "vertices are" };
    let message = format!("{unused} {vertices} unused: left out");
    reports.push(u64::MAX, Diagnostic::note(message));
    let mut next_index = 0;
    let mut new_index = Vec::with_capacity(is_used.len());
    for &used in &is_used {
        new_index.push(next_index);
        next_index += u32::from(used);
    }
    fn keep<T>(values: Vec<T>, is_used: &[bool]) -> Vec<T> {
        values.into_iter().zip(is_used).filter_map(|(value, used)| used.then_some(value)).collect()
    }
    Mesh {
        positions: keep(mesh.positions, &is_used),
        normals: keep(mesh.normals, &is_used),
        tex_coords: keep(mesh.tex_coords, &is_used),
        colors: keep(mesh.colors, &is_used),
        indices: mesh.indices.iter().map(|&vertex| new_index[vertex as usize]).collect(),
        ..mesh
    }
}
