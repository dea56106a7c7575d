//! Builds the model's mesh from the geometries that nodes place.

use super::document::Document;
use super::geometry::Geometry;
use super::local::LocalMesh;
use crate::limits::{too_many_triangles, too_many_vertices};
use crate::{Cause, Limits, Mesh, NormalSource, Part, ReadError};
use glam::{DMat3, DMat4, DVec3};

pub(super) struct Builder<'a> {
    limits: &'a Limits,
    pub(super) mesh: Mesh,
}

/// Returns the material of a primitive of the geometry.
pub(super) type MaterialOf<'a> = &'a mut dyn FnMut(usize) -> usize;

impl<'a> Builder<'a> {
    pub(super) fn new(limits: &'a Limits) -> Self {
        Builder { limits, mesh: Mesh::default() }
    }

    /// Adds a geometry at `model_from_local`. `at` is the byte of the element that places it.
    pub(super) fn place(
        &mut self,
        document: &Document<'_>,
        local: &LocalMesh,
        model_from_local: DMat4,
        name: &str,
        at: usize,
        material_of: MaterialOf<'_>,
    ) -> Result<(), ReadError> {
        self.check_room(document, local, at)?;
        let base = self.mesh.positions.len();
        for &position in &local.positions {
            let placed = model_from_local.transform_point3(DVec3::from(position.map(f64::from))).as_vec3();
            if !placed.is_finite() {
                let message = format!("the transforms of {name:?} move a position out of range: {placed}");
                return Err(document.error(at, message));
            }
            self.mesh.positions.push(placed.to_array());
        }
        self.place_normals(local, model_from_local, base);
        append(&mut self.mesh.tex_coords, &local.tex_coords, [0.0; 2], base, local.positions.len());
        append(&mut self.mesh.colors, &local.colors, [1.0; 4], base, local.positions.len());
        // A mirror reverses the winding of triangles: reverse it again, so that front faces stay front faces.
        let is_mirrored = DMat3::from_mat4(model_from_local).determinant() < 0.0;
        for part in &local.parts {
            let first_triangle = self.mesh.triangle_count();
            for corners in local.indices[part.first..part.end].chunks_exact(3) {
                let [a, b, c] = [corners[0], corners[1], corners[2]].map(|vertex| vertex + base as u32);
                self.mesh.indices.extend(if is_mirrored { [a, c, b] } else { [a, b, c] });
            }
            self.part(name, material_of(part.primitive), first_triangle);
        }
        Ok(())
    }

    /// Normals are transformed by the inverse transpose.
    fn place_normals(&mut self, local: &LocalMesh, model_from_local: DMat4, base: usize) {
        if local.normals.is_empty() {
            append(&mut self.mesh.normals, &[], [0.0; 3], base, local.positions.len());
            return;
        }
        let m = DMat3::from_mat4(model_from_local);
        // The cofactors are the inverse transpose times the determinant; they also exist where there is no inverse.
        let cofactors = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
        let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
        self.mesh.normals.resize(base, [0.0; 3]);
        self.mesh.normals.extend(local.normals.iter().map(|normal| {
            let turned = cofactors * DVec3::from(normal.map(f64::from)) * sign;
            let turned = turned.normalize_or_zero().as_vec3();
            if turned.is_finite() { turned.to_array() } else { [0.0; 3] }
        }));
    }

    /// Checks the size before anything is allocated: a small file may place a geometry any number of times.
    fn check_room(&self, document: &Document<'_>, local: &LocalMesh, at: usize) -> Result<(), ReadError> {
        let vertices = (self.mesh.positions.len() + local.positions.len()) as u64;
        let triangles = (self.mesh.indices.len() + local.indices.len()) as u64 / 3;
        let most = self.limits.max_vertices.min(u64::from(u32::MAX));
        if vertices > most {
            return Err(too_many_vertices(most));
        }
        if triangles > self.limits.max_triangles {
            return Err(too_many_triangles(self.limits.max_triangles));
        }
        // Position, normal, texture coordinate and colour; three indices.
        if vertices.saturating_mul(48).saturating_add(triangles.saturating_mul(12)) > self.limits.max_bytes {
            let most = self.limits.max_bytes;
            let message = format!("the placed geometries take more than {most} bytes, which is the limit");
            return Err(document.error(at, message).caused_by(Cause::MemoryLimit));
        }
        Ok(())
    }

    /// Adds a part with the triangles from `first_triangle` on, or extends the previous part.
    fn part(&mut self, name: &str, material: usize, first_triangle: usize) {
        let triangle_count = self.mesh.triangle_count() - first_triangle;
        match self.mesh.parts.last_mut() {
            _ if triangle_count == 0 => {}
            Some(last) if last.name == name && last.material == material => last.triangle_count += triangle_count,
            _ => self.mesh.parts.push(Part { name: name.to_owned(), material, first_triangle, triangle_count }),
        }
    }

    pub(super) fn finish(mut self) -> Mesh {
        self.mesh.normal_source = if self.mesh.normals.is_empty() { NormalSource::None } else { NormalSource::File };
        self.mesh
    }
}

/// Appends the values of new vertices. Where only other vertices have values, `absent` fills the gap.
fn append<T: Copy>(all: &mut Vec<T>, values: &[T], absent: T, base: usize, count: usize) {
    if values.is_empty() && all.is_empty() {
        return;
    }
    all.resize(base, absent);
    all.extend_from_slice(values);
    all.resize(base + count, absent);
}

/// Whether a primitive's material needs texture coordinates that the geometry lacks.
pub(super) fn lacks_tex_coords(geometry: &Geometry, primitive: usize) -> bool {
    let primitive = geometry.primitives.get(primitive);
    primitive.is_some_and(|p| p.input(super::source::Semantic::TexCoord, None).is_none())
}
