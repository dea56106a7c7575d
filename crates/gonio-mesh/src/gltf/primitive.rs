//! Geometry: primitives of meshes, once for every node that shows them.

use super::accessor::Accessor;
use super::buffer::Buffers;
use super::json::JsonRef;
use super::triangles::{self, Topology, Used};
use crate::diagnostic::Reports;
use crate::input::{too_many_triangles, too_many_vertices};
use crate::{Cause, Diagnostic, Limits, Mesh, NormalSource, Part, ReadError, Severity};
use glam::{DMat4, DVec3};

/// Most memory that a vertex and a triangle take.
const BYTES_PER_VERTEX: u64 = 12 + 12 + 8 + 16 + 16;
const BYTES_PER_TRIANGLE: u64 = 12;

/// The fixed cost of processing a primitive, as bytes that could be read in that time.
const BYTES_PER_PRIMITIVE: u64 = 4096;

/// How many times its own size a model may be read: many nodes may show one mesh in which every triangle is dropped.
const MOST_READINGS: u64 = 4;

/// The material of a primitive, and what it requires of the geometry.
#[derive(Clone, Copy)]
pub(super) struct MaterialUse {
    /// Index in the model's list.
    pub material: usize,
    /// The set TEXCOORD_n that its textures use; `None` without textures.
    pub tex_coord_set: Option<usize>,
}

/// The mesh while primitives are added.
pub(super) struct Geometry<'l> {
    mesh: Mesh,
    limits: &'l Limits,
    /// Upper bound of the mesh's size.
    bytes: u64,
    /// Bytes that were read for it.
    bytes_read: u64,
    pub counts: Counts,
    first_without_normals: Option<String>,
    all_have_tangents: bool,
    any_has_tangents: bool,
}

/// Numbers of primitives by kind.
#[derive(Default)]
pub(super) struct Counts {
    pub points: u64,
    pub lines: u64,
    pub out_of_range: u64,
    pub not_finite: NotFinite,
}

/// Numbers of non-finite values in optional attributes.
#[derive(Default)]
pub(super) struct NotFinite {
    normals: Zeroed,
    tangents: Zeroed,
    tex_coords: Zeroed,
    colors: Zeroed,
}

/// Replaces non-finite numbers by 0 and counts them.
#[derive(Default)]
struct Zeroed {
    count: u64,
}

impl Zeroed {
    fn finite<const N: usize>(&mut self, vector: [f32; N]) -> [f32; N] {
        vector.map(|value| {
            self.count += u64::from(!value.is_finite());
            if value.is_finite() { value } else { 0.0 }
        })
    }
}

/// The transform, name and material with which a primitive is added.
pub(super) struct Placement<'n> {
    pub name: &'n str,
    pub model_from_mesh: DMat4,
    pub user: MaterialUse,
}

impl<'l> Geometry<'l> {
    pub fn new(limits: &'l Limits) -> Self {
        Geometry {
            mesh: Mesh::default(),
            limits,
            bytes: 0,
            bytes_read: 0,
            counts: Counts::default(),
            first_without_normals: None,
            all_have_tangents: true,
            any_has_tangents: false,
        }
    }

    /// Appends a primitive.
    pub fn add<'v>(
        &mut self,
        at: JsonRef<'v>,
        placement: &Placement<'_>,
        root: JsonRef<'v>,
        buffers: &mut Buffers<'v, '_>,
        reports: &mut Reports,
    ) -> Result<(), ReadError> {
        self.check_work(BYTES_PER_PRIMITIVE, at)?;
        let topology = match at.unsigned("mode")?.unwrap_or(4) {
            0 => return self.not_drawn(at, true, reports),
            1..=3 => return self.not_drawn(at, false, reports),
            mode => Topology::of_mode(mode).ok_or_else(|| {
                ReadError::new(format!("{}, which is not a primitive mode (0 to 6)", at.written("mode")))
            })?,
        };
        let Some(attributes) = at.get("attributes") else { return Err(at.missing("attributes")) };
        let Some(positions) = Accessor::open(buffers, root, attributes, "POSITION", &[3])? else {
            let message = || format!("{} has no POSITION: it is not drawn", at.path());
            reports.add_without_line("primitives without positions", Severity::Warning, message);
            return Ok(());
        };
        if !positions.is_backed() {
            if at.extension("KHR_draco_mesh_compression").is_some() {
                let what = "holds its geometry in Draco compression, which is not supported: export it without";
                return Err(ReadError::new(format!("{} {what}", at.path())));
            }
            self.check_bytes((positions.count as u64).saturating_mul(BYTES_PER_VERTEX), at)?;
        }
        let indices = Accessor::open(buffers, root, at, "indices", &[1])?;
        let (mut corners, leftover) = self.corners(&positions, indices.as_ref(), topology)?;
        if leftover > 0 {
            let message =
                || format!("{} has {leftover} extra corners that do not form a triangle: left out", at.path());
            reports.add_without_line("primitives with extra corners", Severity::Warning, message);
        }
        self.drop_out_of_range(&mut corners, positions.count, at, reports);
        let Some(used) = Used::by_corners(&mut corners) else {
            let message = || format!("{} has no triangles", at.path());
            reports.add_without_line("primitives without triangles", Severity::Warning, message);
            return Ok(());
        };
        let mut attribute = |name: &'v str, widths: &[usize]| -> Result<Option<Accessor<'v>>, ReadError> {
            let opened = Accessor::open(buffers, root, attributes, name, widths)?;
            let (expected, path) = (positions.count, at.path());
            Ok(opened.filter(|accessor| {
                let fits = accessor.count == expected;
                if !fits {
                    let message = || {
                        format!("{path}: {name} has {} elements, but POSITION has {expected}: ignored", accessor.count)
                    };
                    reports.add_without_line("attributes of the wrong length", Severity::Warning, message);
                }
                fits
            }))
        };
        let set = tex_coord_name(placement.user.tex_coord_set.unwrap_or(0));
        let vertices = Attributes {
            normals: attribute("NORMAL", &[3])?,
            tangents: attribute("TANGENT", &[4])?,
            tex_coords: attribute(set, &[2])?,
            colors: attribute("COLOR_0", &[3, 4])?,
            positions,
        };
        if placement.user.tex_coord_set.is_some() && vertices.tex_coords.is_none() {
            let message = || format!("{} has textures but no {set}: using (0, 0)", at.path());
            reports.add_without_line("primitives without texture coordinates", Severity::Warning, message);
        }
        self.report_other_attributes(attributes, set, reports);
        self.reserve(&used, corners.len() as u64 / 3, at)?;
        self.append(&vertices, &used, &corners, placement, at)
    }

    fn not_drawn(&mut self, at: JsonRef<'_>, points: bool, reports: &mut Reports) -> Result<(), ReadError> {
        let (count, what) =
            if points { (&mut self.counts.points, "points") } else { (&mut self.counts.lines, "lines") };
        *count += 1;
        let message = || format!("{} consists of {what}, not triangles: not drawn", at.path());
        reports.add_without_line("primitives of points or lines", Severity::Warning, message);
        Ok(())
    }

    /// Returns three indices for each triangle, and the number of leftover corners.
    fn corners(
        &mut self,
        positions: &Accessor<'_>,
        indices: Option<&Accessor<'_>>,
        topology: Topology,
    ) -> Result<(Vec<u32>, usize), ReadError> {
        let list = indices.unwrap_or(positions);
        let triangles = topology.triangles(list.count) as u64;
        self.check_triangles(triangles)?;
        if indices.is_none() && positions.count as u64 > self.limits.max_vertices {
            return Err(self.too_many_vertices());
        }
        if !list.is_backed() {
            self.check_bytes((list.count as u64).saturating_mul(4), list.at)?;
        }
        self.check_bytes(triangles.saturating_mul(BYTES_PER_TRIANGLE), list.at)?;
        self.check_work((list.count as u64).saturating_mul(4), list.at)?;
        let list = match indices {
            Some(accessor) => accessor.indices()?,
            None => (0..u32::try_from(positions.count).map_err(|_| self.too_many_vertices())?).collect(),
        };
        Ok(triangles::corners(list, topology))
    }

    fn drop_out_of_range(&mut self, corners: &mut Vec<u32>, count: usize, at: JsonRef<'_>, reports: &mut Reports) {
        let is_there = |corner: &u32| (*corner as usize) < count;
        let before = corners.len();
        let Some(first) = corners.iter().copied().find(|corner| !is_there(corner)) else { return };
        let triangles = corners.as_chunks::<3>().0.iter().filter(|triangle| triangle.iter().all(is_there));
        *corners = triangles.flatten().copied().collect();
        let lost = (before - corners.len()) / 3;
        self.counts.out_of_range += lost as u64;
        let message = || {
            format!(
                "{}: {lost} triangles are left out: an index is {first}, but there are only {count} vertices",
                at.path()
            )
        };
        reports.add_without_line("primitives with an index out of range", Severity::Warning, message);
    }

    fn report_other_attributes(&mut self, attributes: JsonRef<'_>, set: &str, reports: &mut Reports) {
        for (name, at) in attributes.members() {
            let kind = match name {
                "POSITION" | "NORMAL" | "TANGENT" | "COLOR_0" => continue,
                _ if name == set || name.starts_with('_') => continue,
                // The skin itself is reported.
                _ if name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") => continue,
                _ if name.starts_with("TEXCOORD_") => "an additional set of texture coordinates",
                _ if name.starts_with("COLOR_") => "an additional set of colors",
                _ => "unknown",
            };
            let message = || format!("{} is {kind}: not used", at.path());
            reports.add_without_line("attributes that are not used", Severity::Note, message);
        }
    }

    /// Checks that the following allocations are within the limits.
    fn reserve(&mut self, used: &Used, triangles: u64, at: JsonRef<'_>) -> Result<(), ReadError> {
        let vertices = self.mesh.positions.len() as u64 + used.count as u64;
        if vertices > self.limits.max_vertices.min(u64::from(u32::MAX)) {
            return Err(self.too_many_vertices());
        }
        self.check_triangles(triangles)?;
        self.check_work(used.range.len() as u64 * BYTES_PER_VERTEX, at)?;
        let bytes = used.count as u64 * BYTES_PER_VERTEX + triangles * BYTES_PER_TRIANGLE;
        self.check_bytes(bytes, at)?;
        self.bytes += bytes;
        Ok(())
    }

    fn check_triangles(&self, more: u64) -> Result<(), ReadError> {
        let most = self.limits.max_triangles;
        if (self.mesh.triangle_count() as u64).saturating_add(more) <= most {
            return Ok(());
        }
        Err(too_many_triangles(most))
    }

    fn check_bytes(&self, more: u64, at: JsonRef<'_>) -> Result<(), ReadError> {
        let most = self.limits.max_bytes;
        if self.bytes.saturating_add(more) <= most {
            return Ok(());
        }
        Err(ReadError::new(format!("{} makes the model larger than {most} bytes, which is the limit", at.path()))
            .caused_by(Cause::MemoryLimit))
    }

    fn check_work(&mut self, bytes: u64, at: JsonRef<'_>) -> Result<(), ReadError> {
        self.bytes_read = self.bytes_read.saturating_add(bytes);
        if self.bytes_read <= self.limits.max_bytes.saturating_mul(MOST_READINGS) {
            return Ok(());
        }
        let (most, path) = (self.limits.max_bytes, at.path());
        Err(ReadError::new(format!(
            "{path} is instanced so often that more than {MOST_READINGS} times {most} bytes would be read, which is the limit"
        ))
        .caused_by(Cause::MemoryLimit))
    }

    #[cold]
    fn too_many_vertices(&self) -> ReadError {
        too_many_vertices(self.limits.max_vertices.min(u64::from(u32::MAX)))
    }

    /// Appends a primitive that has been checked.
    fn append(
        &mut self,
        from: &Attributes<'_>,
        used: &Used,
        corners: &[u32],
        placement: &Placement<'_>,
        at: JsonRef<'_>,
    ) -> Result<(), ReadError> {
        let map = Map::new(placement.model_from_mesh);
        let first = self.mesh.positions.len();
        let positions = used.gather(from.positions.vectors::<3>(used.range.clone(), 0.0));
        for position in positions {
            let position = map.point(position);
            if !position.iter().all(|c| c.is_finite()) {
                let path = at.path();
                return Err(ReadError::new(format!("{path} has a coordinate that is not finite: the file is damaged")));
            }
            self.mesh.positions.push(position);
        }
        let not_finite = &mut self.counts.not_finite;
        if let Some(normals) = &from.normals {
            self.mesh.normals.resize(first, [0.0; 3]);
            let normals = used.gather(normals.vectors::<3>(used.range.clone(), 0.0));
            self.mesh.normals.extend(normals.map(|n| map.normal(not_finite.normals.finite(n))));
        } else {
            self.first_without_normals.get_or_insert_with(|| at.path());
        }
        // Without normals the file's tangents must be ignored (glTF 2.0, section 3.7.2.1).
        if let (Some(tangents), Some(_)) = (&from.tangents, &from.normals) {
            self.mesh.tangents.resize(first, [0.0; 4]);
            let tangents = used.gather(tangents.vectors::<4>(used.range.clone(), 0.0));
            self.mesh.tangents.extend(tangents.map(|t| map.tangent(not_finite.tangents.finite(t))));
            self.any_has_tangents = true;
        } else {
            self.all_have_tangents = false;
        }
        if let Some(tex_coords) = &from.tex_coords {
            self.mesh.tex_coords.resize(first, [0.0; 2]);
            let tex_coords = used.gather(tex_coords.vectors::<2>(used.range.clone(), 0.0));
            let tex_coords = tex_coords.map(|t| not_finite.tex_coords.finite(t));
            self.mesh.tex_coords.extend(tex_coords.map(|[u, v]| [u, 1.0 - v]));
        }
        if let Some(colors) = &from.colors {
            self.mesh.colors.resize(first, [1.0; 4]);
            let colors = used.gather(colors.vectors::<4>(used.range.clone(), 1.0));
            let colors = colors.map(|c| not_finite.colors.finite(c));
            self.mesh.colors.extend(colors.map(|c| c.map(|v| v.max(0.0))));
        }
        self.append_triangles(first as u32, corners, placement, map.mirrors);
        Ok(())
    }

    fn append_triangles(&mut self, first: u32, corners: &[u32], placement: &Placement<'_>, mirrored: bool) {
        let first_triangle = self.mesh.triangle_count();
        for &[a, b, c] in corners.as_chunks::<3>().0 {
            // Mirroring turns front faces into back faces; the reverse order turns them back.
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            self.mesh.indices.extend([first + a, first + b, first + c]);
        }
        let triangle_count = self.mesh.triangle_count() - first_triangle;
        let (name, material) = (placement.name.to_owned(), placement.user.material);
        self.mesh.parts.push(Part { name, material, first_triangle, triangle_count });
    }

    /// Returns the mesh; reports incomplete normals and tangents.
    pub fn finish(mut self, reports: &mut Reports) -> Mesh {
        let count = self.mesh.positions.len();
        let mesh = &mut self.mesh;
        if self.any_has_tangents && !self.all_have_tangents {
            mesh.tangents = Vec::new();
            let note = "only some primitives have tangents (TANGENT): those of the file are not used";
            reports.push(0, Diagnostic::note(note));
        }
        if !mesh.normals.is_empty() {
            mesh.normals.resize(count, [0.0; 3]);
            mesh.normal_source = NormalSource::File;
        }
        if !mesh.tex_coords.is_empty() {
            mesh.tex_coords.resize(count, [0.0; 2]);
        }
        if !mesh.colors.is_empty() {
            mesh.colors.resize(count, [1.0; 4]);
        }
        if let Some(path) = &self.first_without_normals {
            let which = if mesh.normals.is_empty() {
                "nothing has normals".to_owned()
            } else {
                format!("{path} has no normals")
            };
            let note = format!("{which}: glTF specifies flat shading there; they are averaged for smooth shading");
            reports.push(0, Diagnostic::note(note));
        }
        let NotFinite { normals, tangents, tex_coords, colors } = &self.counts.not_finite;
        let kinds =
            [("normals", normals), ("tangents", tangents), ("texture coordinates", tex_coords), ("colors", colors)];
        for (kind, Zeroed { count }) in kinds {
            if *count > 0 {
                let numbers = if *count == 1 { "number" } else { "numbers" };
                let verb = if *count == 1 { "is" } else { "are" };
                let warning = format!("{count} {numbers} of {kind} {verb} not finite: using 0 instead");
                reports.push(0, Diagnostic::warning(warning));
            }
        }
        self.mesh
    }
}

/// Returns the name of a set, for the first eight sets.
fn tex_coord_name(set: usize) -> &'static str {
    const NAMES: [&str; 8] = [
        "TEXCOORD_0",
        "TEXCOORD_1",
        "TEXCOORD_2",
        "TEXCOORD_3",
        "TEXCOORD_4",
        "TEXCOORD_5",
        "TEXCOORD_6",
        "TEXCOORD_7",
    ];
    NAMES.get(set).copied().unwrap_or("such TEXCOORD")
}

struct Attributes<'v> {
    positions: Accessor<'v>,
    normals: Option<Accessor<'v>>,
    tangents: Option<Accessor<'v>>,
    tex_coords: Option<Accessor<'v>>,
    colors: Option<Accessor<'v>>,
}

/// The transform from a mesh's own space to the model's.
struct Map {
    model_from_mesh: DMat4,
    /// Columns that transform normals: the cofactors, which are the inverse transpose times the determinant. They also
    /// exist if a scale is 0.
    normal_columns: [DVec3; 3],
    is_identity: bool,
    mirrors: bool,
}

impl Map {
    fn new(model_from_mesh: DMat4) -> Self {
        let [x, y, z] = [model_from_mesh.x_axis, model_from_mesh.y_axis, model_from_mesh.z_axis].map(|c| c.truncate());
        let mirrors = x.dot(y.cross(z)) < 0.0;
        let sign = if mirrors { -1.0 } else { 1.0 };
        Map {
            model_from_mesh,
            normal_columns: [y.cross(z), z.cross(x), x.cross(y)].map(|c| sign * c),
            is_identity: model_from_mesh == DMat4::IDENTITY,
            mirrors,
        }
    }

    fn point(&self, point: [f32; 3]) -> [f32; 3] {
        if self.is_identity {
            return point;
        }
        self.model_from_mesh.transform_point3(vector(point)).as_vec3().to_array()
    }

    /// Transforms a normal; the result has length 1 or 0.
    fn normal(&self, normal: [f32; 3]) -> [f32; 3] {
        let [x, y, z] = normal.map(f64::from);
        let [a, b, c] = self.normal_columns;
        (a * x + b * y + c * z).normalize_or_zero().as_vec3().to_array()
    }

    /// Transforms a tangent; the result has length 1 or 0, and a handedness of 1 or -1.
    fn tangent(&self, [x, y, z, w]: [f32; 4]) -> [f32; 4] {
        let turned = self.model_from_mesh.transform_vector3(vector([x, y, z])).normalize_or_zero().as_vec3();
        // Mirroring reverses cross(normal, tangent) while the normal keeps pointing outwards: the bitangent's sign
        // changes.
        let handedness = if (w < 0.0) != self.mirrors { -1.0 } else { 1.0 };
        turned.extend(handedness).to_array()
    }
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}
