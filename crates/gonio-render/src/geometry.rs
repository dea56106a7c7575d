//! A mesh on the GPU: shared vertices for Phong and Gouraud, unshared ones for the flat shadings, lines for overlays.

use crate::glsl::ATTRIBUTES;
use glam::Vec3;
use gonio_gl::objects::{Buffer, VertexArray};
use gonio_gl::{Gl, GlError};
use gonio_mesh::Mesh;

/// The form of a mesh on the GPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// Vertices as the mesh shares them.
    Shared,
    /// Three vertices of its own for each triangle, with the triangle's normal and centroid.
    Unshared,
    /// The corners of each triangle, positions alone, in order: no indices.
    Corners,
    /// An instance for each vertex: its position and normal.
    VertexNormals,
    /// An instance for each triangle: its centroid and normal.
    FaceNormals,
    /// An instance for each edge of the bounding box: its start and its vector.
    Box,
}

/// A mesh's buffers. The vertex array names them all, so they live as long as it does.
pub struct MeshOnGpu {
    array: VertexArray,
    /// Each with the name of its attribute.
    buffers: Vec<(&'static str, Buffer)>,
    /// Bytes on the GPU.
    pub bytes: usize,
    /// Whether vertices have colours.
    pub has_colors: bool,
    /// Number of indices, or of vertices without indices, or of instances for lines.
    pub count: usize,
}

impl MeshOnGpu {
    /// Uploads a mesh in a form; `name` is its label in debuggers. The order of triangles is that of the mesh.
    pub fn new(gl: &Gl, mesh: &Mesh, form: Form, name: &str) -> Result<Self, GlError> {
        match form {
            Form::Shared => Self::upload(gl, mesh, None, name),
            Form::Unshared => Self::unshared(gl, mesh, &format!("{name} (flat)")),
            Form::Corners => Self::corners(gl, mesh, &format!("{name} (corners)")),
            Form::VertexNormals => Self::lines(gl, &mesh.positions, &mesh.normals, &format!("{name} (normals)")),
            Form::FaceNormals => {
                let triangles = (0..mesh.triangle_count()).map(|t| mesh.triangle_positions(t));
                let (centers, normals): (Vec<_>, Vec<_>) =
                    triangles.map(|[a, b, c]| (center(a, b, c).to_array(), face_normal(a, b, c).to_array())).unzip();
                Self::lines(gl, &centers, &normals, &format!("{name} (normals of triangles)"))
            }
            Form::Box => {
                let (starts, ways) = box_edges(mesh);
                Self::lines(gl, &starts, &ways, &format!("{name} (box)"))
            }
        }
    }

    /// Uploads lines, one instance each: start and vector, in model space.
    fn lines(gl: &Gl, starts: &[[f32; 3]], ways: &[[f32; 3]], name: &str) -> Result<Self, GlError> {
        let array = VertexArray::bound(gl, name)?;
        let mut buffers = Vec::new();
        for (attribute_name, data) in [("position", starts), ("normal", ways)] {
            let bytes: &[u8] = bytemuck::cast_slice(data);
            let label = format!("{name}: {attribute_name}");
            buffers
                .push((attribute_name, Buffer::with_bytes(gl, glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW, &label)?));
            attribute(gl, attribute_name, 3);
            gl.vertex_attrib_divisor(location(attribute_name), 1);
        }
        gl.bind_vertex_array(None);
        let count = starts.len().min(ways.len());
        Ok(MeshOnGpu { array, buffers, bytes: count * 24, has_colors: false, count })
    }

    fn corners(gl: &Gl, mesh: &Mesh, name: &str) -> Result<Self, GlError> {
        let position = |&index: &u32| mesh.positions.get(index as usize).copied().unwrap_or_default();
        let corners: Vec<[f32; 3]> = mesh.indices.iter().map(position).collect();
        let array = VertexArray::bound(gl, name)?;
        let bytes: &[u8] = bytemuck::cast_slice(&corners);
        let buffer = Buffer::with_bytes(gl, glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW, name)?;
        attribute(gl, "position", 3);
        gl.bind_vertex_array(None);
        let (bytes, count) = (bytes.len(), corners.len());
        Ok(MeshOnGpu { array, buffers: vec![("position", buffer)], bytes, has_colors: false, count })
    }

    fn unshared(gl: &Gl, mesh: &Mesh, name: &str) -> Result<Self, GlError> {
        let mut flat = mesh.unshared();
        let mut centers = Vec::with_capacity(flat.positions.len());
        let mut normals = Vec::with_capacity(flat.positions.len());
        for triangle in 0..flat.triangle_count() {
            let [a, b, c] = flat.triangle_positions(triangle);
            normals.extend([face_normal(a, b, c).to_array(); 3]);
            centers.extend([center(a, b, c).to_array(); 3]);
        }
        flat.normals = normals;
        Self::upload(gl, &flat, Some(&centers), name)
    }

    /// Uploads each attribute to its own buffer, as it is stored in the mesh: interleaving would need a copy.
    fn upload(gl: &Gl, mesh: &Mesh, centers: Option<&[[f32; 3]]>, name: &str) -> Result<Self, GlError> {
        let array = VertexArray::bound(gl, name)?;
        let mut buffers = Vec::new();
        let mut bytes = 0;
        let mut fill = |data: &[u8], target: u32, what: &'static str| -> Result<(), GlError> {
            bytes += data.len();
            let label = format!("{name}: {what}");
            buffers.push((what, Buffer::with_bytes(gl, target, data, glow::STATIC_DRAW, &label)?));
            Ok(())
        };
        let attributes: [(&'static str, i32, &[u8]); 6] = [
            ("position", 3, bytemuck::cast_slice(&mesh.positions)),
            ("normal", 3, bytemuck::cast_slice(&mesh.normals)),
            ("tex_coord", 2, bytemuck::cast_slice(&mesh.tex_coords)),
            ("tangent", 4, bytemuck::cast_slice(&mesh.tangents)),
            ("color", 4, bytemuck::cast_slice(&mesh.colors)),
            ("face_center", 3, bytemuck::cast_slice(centers.unwrap_or_default())),
        ];
        for (attribute_name, components, data) in attributes.into_iter().filter(|(.., data)| !data.is_empty()) {
            fill(data, glow::ARRAY_BUFFER, attribute_name)?;
            attribute(gl, attribute_name, components);
        }
        fill(bytemuck::cast_slice(&mesh.indices), glow::ELEMENT_ARRAY_BUFFER, INDICES)?;
        gl.bind_vertex_array(None);
        Ok(MeshOnGpu { array, buffers, bytes, has_colors: !mesh.colors.is_empty(), count: mesh.indices.len() })
    }

    /// Binds it for the next draws. Sets the constants of missing attributes, which are state of the context, not of the
    /// array.
    pub fn bind(&self, gl: &Gl) {
        gl.bind_vertex_array(Some(self.array.handle()));
        constant(gl, "normal", [0.0; 4]);
        constant(gl, "tex_coord", [0.0; 4]);
        constant(gl, "tangent", [0.0, 0.0, 0.0, 1.0]);
    }

    /// Makes the bound vertex array read the vertex data of this mesh at other locations than gonio's own programs. Data that
    /// the mesh does not have becomes a constant.
    pub fn feed(&self, gl: &Gl, attributes: &[(u32, VertexData)]) {
        for &(location, data) in attributes {
            let (name, components, missing) = data.layout();
            match self.buffers.iter().find(|(what, _)| *what == name) {
                Some((_, buffer)) => {
                    gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer.handle()));
                    gl.enable_vertex_attrib_array(location);
                    gl.vertex_attrib_pointer_f32(location, components, glow::FLOAT, false, 0, 0);
                }
                None => {
                    let [x, y, z, w] = missing;
                    gl.disable_vertex_attrib_array(location);
                    gl.vertex_attrib_4_f32(location, x, y, z, w);
                }
            }
        }
        if let Some((_, buffer)) = self.buffers.iter().find(|(what, _)| *what == INDICES) {
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(buffer.handle()));
        }
    }
}

/// The name of the buffer of indices.
const INDICES: &str = "indices";

/// The data of a vertex that an attribute of a user's shader can read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexData {
    /// The position, in model space.
    Position,
    /// The unit normal, in model space; with flat shading that of the triangle.
    Normal,
    /// Texture coordinates, v upwards; 0 if the mesh has none.
    TexCoord,
    /// The linear colour; white if the mesh has none.
    Color,
    /// The unit tangent along u, in model space, and the sign of the bitangent; +X if the mesh has none.
    Tangent,
}

impl VertexData {
    /// The name of its buffer, the numbers of a vertex, and the value where a mesh does not have it.
    pub fn layout(self) -> (&'static str, i32, [f32; 4]) {
        match self {
            VertexData::Position => ("position", 3, [0.0, 0.0, 0.0, 1.0]),
            VertexData::Normal => ("normal", 3, [0.0, 0.0, 1.0, 0.0]),
            VertexData::TexCoord => ("tex_coord", 2, [0.0, 0.0, 0.0, 1.0]),
            VertexData::Color => ("color", 4, [1.0; 4]),
            VertexData::Tangent => ("tangent", 4, [1.0, 0.0, 0.0, 1.0]),
        }
    }
}

/// The unit normal of a triangle, counter-clockwise from the front; zero if it has no area.
pub fn face_normal(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero().as_vec3()
}

fn center(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3()
}

/// Starts and vectors of the twelve edges of the bounding box of a mesh, along the axes of the model; empty without
/// vertices.
fn box_edges(mesh: &Mesh) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let mut points = mesh.positions.iter().map(|&p| Vec3::from(p)).filter(|p| p.is_finite());
    let Some(first) = points.next() else { return (Vec::new(), Vec::new()) };
    let (low, high) = points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    let mut edges = (Vec::new(), Vec::new());
    for along in 0..3 {
        for corner in 0..4 {
            let (second, third) = ((along + 1) % 3, (along + 2) % 3);
            let mut start = low;
            start[second] = if corner & 1 == 0 { low[second] } else { high[second] };
            start[third] = if corner & 2 == 0 { low[third] } else { high[third] };
            let mut way = Vec3::ZERO;
            way[along] = high[along] - low[along];
            edges.0.push(start.to_array());
            edges.1.push(way.to_array());
        }
    }
    edges
}

fn location(name: &str) -> u32 {
    ATTRIBUTES.iter().find(|(_, n)| *n == name).map_or(0, |(location, _)| *location)
}

fn attribute(gl: &Gl, name: &str, components: i32) {
    gl.enable_vertex_attrib_array(location(name));
    gl.vertex_attrib_pointer_f32(location(name), components, glow::FLOAT, false, 0, 0);
}

fn constant(gl: &Gl, name: &str, [x, y, z, w]: [f32; 4]) {
    gl.vertex_attrib_4_f32(location(name), x, y, z, w);
}
