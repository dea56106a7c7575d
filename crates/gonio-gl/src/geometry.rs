//! A mesh on the GPU: shared vertices for Phong and Gouraud, unshared ones for the flat shadings.

use crate::glsl::ATTRIBUTES;
use crate::objects::{Buffer, VertexArray};
use crate::{Gl, GlError};
use glam::Vec3;
use glow::HasContext;
use gonio_mesh::Mesh;

/// A mesh's buffers. The vertex array names them all, so they live as long as it does.
pub struct Geometry {
    array: VertexArray,
    _buffers: Vec<Buffer>,
    /// Bytes on the GPU.
    pub bytes: usize,
    /// Whether vertices have colours.
    pub has_colors: bool,
}

impl Geometry {
    /// Vertices as the mesh shares them.
    pub fn shared(gl: &Gl, mesh: &Mesh, name: &str) -> Result<Self, GlError> {
        Self::upload(gl, mesh, None, name)
    }

    /// Three vertices of its own for each triangle, with the triangle's normal and centroid. The order
    /// of triangles is the mesh's.
    pub fn unshared(gl: &Gl, mesh: &Mesh, name: &str) -> Result<Self, GlError> {
        let mut flat = mesh.unshared();
        let mut centers = Vec::with_capacity(flat.positions.len());
        let mut normals = Vec::with_capacity(flat.positions.len());
        for triangle in 0..flat.triangle_count() {
            let [a, b, c] = flat.triangle_positions(triangle);
            let center = ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3();
            normals.extend([face_normal(a, b, c).to_array(); 3]);
            centers.extend([center.to_array(); 3]);
        }
        flat.normals = normals;
        Self::upload(gl, &flat, Some(&centers), name)
    }

    /// Each attribute in a buffer of its own, as it lies in the mesh: a copy less than interleaved.
    fn upload(gl: &Gl, mesh: &Mesh, centers: Option<&[[f32; 3]]>, name: &str) -> Result<Self, GlError> {
        let array = VertexArray::bound(gl, name)?;
        let mut buffers = Vec::new();
        let mut bytes = 0;
        let mut fill = |data: &[u8], target: u32, what: &str| -> Result<(), GlError> {
            bytes += data.len();
            buffers.push(Buffer::with_bytes(gl, target, data, glow::STATIC_DRAW, &format!("{name}: {what}"))?);
            Ok(())
        };
        let attributes: [(&str, i32, &[u8]); 6] = [
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
        fill(bytemuck::cast_slice(&mesh.indices), glow::ELEMENT_ARRAY_BUFFER, "indices")?;
        // SAFETY: unbinding has no precondition; later bindings cannot change this array any more.
        unsafe { gl.bind_vertex_array(None) };
        Ok(Geometry { array, _buffers: buffers, bytes, has_colors: !mesh.colors.is_empty() })
    }

    /// Makes it what the next draws read. Attributes that the mesh lacks get their constants, which
    /// are the context's state, not the array's.
    pub fn bind(&self, gl: &Gl) {
        // SAFETY: the array is this context's.
        unsafe { gl.bind_vertex_array(Some(self.array.handle())) };
        constant(gl, "normal", [0.0; 4]);
        constant(gl, "tex_coord", [0.0; 4]);
        constant(gl, "tangent", [0.0, 0.0, 0.0, 1.0]);
    }
}

/// The unit normal of a triangle, counter-clockwise from the front; zero where it has no area.
pub fn face_normal(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero().as_vec3()
}

fn location(name: &str) -> u32 {
    ATTRIBUTES.iter().find(|(_, n)| *n == name).map_or(0, |(location, _)| *location)
}

fn attribute(gl: &Gl, name: &str, components: i32) {
    // SAFETY: a vertex array and the buffer that holds this attribute, tightly packed, are bound.
    unsafe {
        gl.enable_vertex_attrib_array(location(name));
        gl.vertex_attrib_pointer_f32(location(name), components, glow::FLOAT, false, 0, 0);
    }
}

fn constant(gl: &Gl, name: &str, [x, y, z, w]: [f32; 4]) {
    // SAFETY: sets the context's current value of an attribute, which reads no memory.
    unsafe { gl.vertex_attrib_4_f32(location(name), x, y, z, w) };
}
