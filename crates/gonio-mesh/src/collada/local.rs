//! Converts a geometry to an indexed mesh in its own space.

use super::document::Document;
use super::geometry::{Geometry, Primitive};
use super::source::{Input, Semantic};
use crate::input::{too_many_triangles, too_many_vertices};
use crate::polygon::{Cut, MOST_CORNERS, Triangulator, too_many_corners};
use crate::weld::Joiner;
use crate::{Cause, Limits, Mesh, NormalSource, Part, ReadError, Severity};
use glam::{DMat3, DMat4, DVec3};
use gonio_light::color::srgb_decode_f32;

const NONE: u32 = u32::MAX;

/// A geometry, ready to be placed. Per-vertex arrays are as long as `positions`, or empty.
#[derive(Default)]
pub(super) struct LocalMesh {
    pub(super) positions: Vec<[f32; 3]>,
    /// Unit vectors, or zero.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) tex_coords: Vec<[f32; 2]>,
    pub(super) colors: Vec<[f32; 4]>,
    pub(super) indices: Vec<u32>,
    pub(super) parts: Vec<LocalPart>,
}

pub(super) struct LocalPart {
    /// The index of the primitive in the geometry.
    pub(super) primitive: usize,
    /// The index of its first vertex index.
    pub(super) first: usize,
    pub(super) end: usize,
}

/// Numbers of polygons that could not be triangulated exactly.
#[derive(Default)]
pub(super) struct Cuts {
    pub(super) not_simple: u64,
    pub(super) too_large: u64,
}

/// Builds the mesh of a geometry. `sets` contains the set of texture coordinates that each primitive's material needs.
pub(super) fn build(
    document: &Document<'_>,
    geometry: &Geometry,
    sets: &[Option<u32>],
    cuts: &mut Cuts,
) -> Result<LocalMesh, ReadError> {
    let mut mesh = LocalMesh::default();
    let mut joiner: Option<(Layout, Joiner<3>, u32)> = None;
    let mut triangulator = Triangulator::default();
    for (index, primitive) in geometry.primitives.iter().enumerate() {
        let Some(inputs) = Inputs::from_primitive(primitive, sets.get(index).copied().flatten()) else { continue };
        let layout = inputs.layout();
        // Primitives with the same sources share vertices.
        let (_, joined, base) = match joiner.take() {
            Some(known) if known.0 == layout => joiner.insert(known),
            _ => joiner.insert((layout, Joiner::new(inputs.position.source.rows), mesh.positions.len() as u32)),
        };
        let first = mesh.indices.len();
        let mut assembler = Assembler { document, primitive, inputs, joiner: joined, base: *base, mesh: &mut mesh };
        assembler.polygons(&mut triangulator, cuts)?;
        let end = mesh.indices.len();
        if end > first {
            mesh.parts.push(LocalPart { primitive: index, first, end });
        }
    }
    Ok(mesh)
}

/// The sources that a vertex takes its attributes from.
type Layout = [Option<u32>; 4];

/// The inputs that are used.
struct Inputs<'a> {
    position: &'a Input,
    normal: Option<&'a Input>,
    tex_coord: Option<&'a Input>,
    color: Option<&'a Input>,
}

impl<'a> Inputs<'a> {
    fn from_primitive(primitive: &'a Primitive, set: Option<u32>) -> Option<Self> {
        Some(Inputs {
            position: primitive.input(Semantic::Position, None)?,
            normal: primitive.input(Semantic::Normal, None),
            tex_coord: primitive.input(Semantic::TexCoord, set),
            color: primitive.input(Semantic::Color, None),
        })
    }

    fn layout(&self) -> Layout {
        [Some(self.position), self.normal, self.tex_coord, self.color].map(|input| Some(input?.element))
    }
}

struct Assembler<'a, 't> {
    document: &'a Document<'t>,
    primitive: &'a Primitive,
    inputs: Inputs<'a>,
    joiner: &'a mut Joiner<3>,
    /// The index in the mesh of the joiner's first vertex.
    base: u32,
    mesh: &'a mut LocalMesh,
}

impl Assembler<'_, '_> {
    fn polygons(&mut self, triangulator: &mut Triangulator, cuts: &mut Cuts) -> Result<(), ReadError> {
        let width = self.primitive.width;
        let all = &self.primitive.indices;
        let mut vertices: Vec<u32> = Vec::new();
        let mut points: Vec<[f32; 3]> = Vec::new();
        let triangles = all.len() / width / 3;
        let sizes = self.primitive.sizes.as_deref();
        let mut first: usize = 0;
        let mut degenerate = 0;
        for polygon in 0..sizes.map_or(triangles, <[u32]>::len) {
            let size = sizes.map_or(3, |sizes| sizes[polygon] as usize);
            let end = first.saturating_add(size.saturating_mul(width));
            let Some(corners) = all.get(first..end) else { break };
            if size > MOST_CORNERS {
                return Err(too_many_corners(&format!("polygon {polygon}")));
            }
            if size < 3 {
                degenerate += 1;
            } else if self.are_positions_there(corners, first) {
                vertices.clear();
                for corner in corners.chunks_exact(width) {
                    vertices.push(self.vertex(corner, first)?);
                }
                let positions = &self.mesh.positions;
                points.clear();
                points.extend(vertices.iter().map(|&v| positions[v as usize]));
                let indices = &mut self.mesh.indices;
                match triangulator.triangulate(&points, |t| indices.extend(t.map(|i| vertices[i]))) {
                    Cut::Fan | Cut::Ears => {}
                    Cut::NotSimple => cuts.not_simple += 1,
                    Cut::TooLarge => cuts.too_large += 1,
                }
            }
            first = end;
        }
        if degenerate > 0 {
            let message = format!("{degenerate} polygons have fewer than three corners: they are left out");
            self.document.add_loss("polygons without area", self.primitive.at, || message);
        }
        Ok(())
    }

    /// Whether all corners have a position; reports the first one that has none.
    fn are_positions_there(&self, corners: &[u32], first: usize) -> bool {
        let Input { offset, source, .. } = self.inputs.position;
        let rows = source.rows;
        let index = |corner: &[u32]| corner.get(*offset).map_or(usize::MAX, |index| *index as usize);
        let Some(bad) = corners.chunks_exact(self.primitive.width).position(|corner| index(corner) >= rows) else {
            return true;
        };
        let number = bad * self.primitive.width + offset;
        let written = corners.get(number).copied().unwrap_or(NONE);
        self.report_index("polygons left out because of an invalid index", first + number, || {
            format!(
                "a polygon refers to {}, but there are only {rows} (from 0): it is left out",
                shown("position", written)
            )
        });
        false
    }

    fn report_index(&self, kind: &'static str, number: usize, message: impl FnOnce() -> String) {
        // Finding the position takes time proportional to the file, so only the first few are located.
        let at = if self.document.is_saturated(kind) {
            self.primitive.at
        } else {
            self.primitive.place(self.document, number)
        };
        self.document.add_loss(kind, at, message);
    }

    /// Returns the vertex of a corner whose position exists.
    fn vertex(&mut self, corner: &[u32], first: usize) -> Result<u32, ReadError> {
        let position = corner.get(self.inputs.position.offset).copied().unwrap_or(0);
        let attributes = [
            (self.inputs.normal, "normal"),
            (self.inputs.tex_coord, "texture coordinate"),
            (self.inputs.color, "color"),
        ];
        let rest = attributes.map(|(input, what)| {
            let Some(input) = input else { return NONE };
            let index = corner.get(input.offset).copied().unwrap_or(NONE);
            if (index as usize) < input.source.rows {
                return index;
            }
            self.document.add("invalid indices", Severity::Warning, self.primitive.at, || {
                let rows = input.source.rows;
                format!("a corner refers to {}, but there are only {rows} (from 0): ignored", shown(what, index))
            });
            NONE
        });
        let (vertex, is_new) = self.joiner.vertex(position, rest);
        let vertex = self.base + vertex;
        if is_new {
            if vertex >= NONE - 1 || u64::from(vertex) >= self.document.limits.max_vertices {
                return Err(too_many_vertices(self.document.limits.max_vertices.min(u64::from(u32::MAX))));
            }
            self.new_vertex(position, rest, first)?;
        }
        Ok(vertex)
    }

    fn new_vertex(
        &mut self,
        position: u32,
        [normal, tex_coord, color]: [u32; 3],
        first: usize,
    ) -> Result<(), ReadError> {
        let source = &self.inputs.position.source;
        let [x, y, z, _] = source.row(position as usize);
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            let at = source.place_of_not_finite(self.document, position as usize);
            let at = at.unwrap_or_else(|| self.primitive.place(self.document, first));
            return Err(self.document.error(at, format!("the position {position} is not finite: {x} {y} {z}")));
        }
        let made = self.mesh.positions.len();
        self.mesh.positions.push([x, y, z]);
        let finite = |value: f32| if value.is_finite() { value } else { 0.0 };
        let row = |input: Option<&Input>, index: u32| {
            let input = input.filter(|_| index != NONE)?;
            Some(input.source.row(index as usize).map(finite))
        };
        if self.inputs.normal.is_some() || !self.mesh.normals.is_empty() {
            let [x, y, z, _] = row(self.inputs.normal, normal).unwrap_or_default();
            let normal = glam::DVec3::new(x.into(), y.into(), z.into()).normalize_or_zero().as_vec3();
            self.mesh.normals.resize(made, [0.0; 3]);
            self.mesh.normals.push(normal.to_array());
        }
        if self.inputs.tex_coord.is_some() || !self.mesh.tex_coords.is_empty() {
            let [u, v, ..] = row(self.inputs.tex_coord, tex_coord).unwrap_or_default();
            self.mesh.tex_coords.resize(made, [0.0; 2]);
            self.mesh.tex_coords.push([u, v]);
        }
        if self.inputs.color.is_some() || !self.mesh.colors.is_empty() {
            let color = row(self.inputs.color, color).unwrap_or([1.0; 4]).map(|value| value.clamp(0.0, 1.0));
            self.mesh.colors.resize(made, [1.0; 4]);
            self.mesh.colors.push(if self.document.is_from_blender { decoded(color) } else { color });
        }
        Ok(())
    }
}

/// Describes an index for messages. `NONE` stands for values that are not 32-bit indices.
fn shown(what: &str, index: u32) -> String {
    if index == NONE { format!("a {what} that is negative or beyond 32 bits") } else { format!("the {what} {index}") }
}

/// Decodes the colour from sRGB and keeps the opacity.
fn decoded([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    [srgb_decode_f32(r), srgb_decode_f32(g), srgb_decode_f32(b), a]
}

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
