//! A mesh on the GPU: shared vertices for Phong and Gouraud, unshared ones for the flat shadings.

use crate::glsl::ATTRIBUTES;
use crate::objects::{Buffer, VertexArray};
use crate::{Gl, GlError};
use glam::Vec3;
use glow::HasContext;
use gonio_mesh::Mesh;

/// Position, normal, texture coordinates, interleaved: 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
    tex_coord: [f32; 2],
}

/// A mesh's buffers. The vertex array names them all, so they live as long as it does.
pub struct Geometry {
    array: VertexArray,
    _buffers: Vec<Buffer>,
    /// Bytes on the GPU.
    pub bytes: usize,
}

impl Geometry {
    /// Vertices as the mesh shares them.
    pub fn shared(gl: &Gl, mesh: &Mesh, name: &str) -> Result<Self, GlError> {
        let vertices: Vec<Vertex> = (0..mesh.positions.len())
            .map(|i| Vertex {
                position: mesh.positions[i],
                normal: mesh.normals.get(i).copied().unwrap_or_default(),
                tex_coord: mesh.tex_coords.get(i).copied().unwrap_or_default(),
            })
            .collect();
        Self::upload(gl, &vertices, &mesh.tangents, &mesh.colors, None, &mesh.indices, name)
    }

    /// Three vertices of its own for each triangle, with the triangle's normal and centroid. The order
    /// of triangles is the mesh's.
    pub fn unshared(gl: &Gl, mesh: &Mesh, name: &str) -> Result<Self, GlError> {
        let flat = mesh.unshared();
        let mut vertices = Vec::with_capacity(flat.positions.len());
        let mut centers = Vec::with_capacity(flat.positions.len());
        for triangle in 0..flat.triangle_count() {
            let [a, b, c] = flat.triangle_positions(triangle);
            let normal = face_normal(a, b, c);
            let center = ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3();
            for index in flat.triangle(triangle) {
                vertices.push(Vertex {
                    position: flat.positions[index],
                    normal: normal.to_array(),
                    tex_coord: flat.tex_coords.get(index).copied().unwrap_or_default(),
                });
                centers.push(center.to_array());
            }
        }
        Self::upload(gl, &vertices, &flat.tangents, &flat.colors, Some(&centers), &flat.indices, name)
    }

    fn upload(
        gl: &Gl,
        vertices: &[Vertex],
        tangents: &[[f32; 4]],
        colors: &[[f32; 4]],
        centers: Option<&[[f32; 3]]>,
        indices: &[u32],
        name: &str,
    ) -> Result<Self, GlError> {
        let array = VertexArray::bound(gl, name)?;
        let mut buffers = Vec::new();
        let mut bytes = 0;
        let mut fill = |data: &[u8], target: u32, what: &str| -> Result<(), GlError> {
            bytes += data.len();
            buffers.push(Buffer::with_bytes(gl, target, data, glow::STATIC_DRAW, &format!("{name}: {what}"))?);
            Ok(())
        };
        fill(bytemuck::cast_slice(vertices), glow::ARRAY_BUFFER, "vertices")?;
        let stride = size_of::<Vertex>() as i32;
        attribute(gl, "position", 3, stride, 0);
        attribute(gl, "normal", 3, stride, 12);
        attribute(gl, "tex_coord", 2, stride, 24);
        if tangents.is_empty() {
            constant(gl, "tangent", [0.0, 0.0, 0.0, 1.0]);
        } else {
            fill(bytemuck::cast_slice(tangents), glow::ARRAY_BUFFER, "tangents")?;
            attribute(gl, "tangent", 4, 0, 0);
        }
        if colors.is_empty() {
            constant(gl, "color", [1.0; 4]);
        } else {
            fill(bytemuck::cast_slice(colors), glow::ARRAY_BUFFER, "colors")?;
            attribute(gl, "color", 4, 0, 0);
        }
        if let Some(centers) = centers {
            fill(bytemuck::cast_slice(centers), glow::ARRAY_BUFFER, "face centres")?;
            attribute(gl, "face_center", 3, 0, 0);
        }
        fill(bytemuck::cast_slice(indices), glow::ELEMENT_ARRAY_BUFFER, "indices")?;
        // SAFETY: unbinding has no precondition; later bindings cannot change this array any more.
        unsafe { gl.bind_vertex_array(None) };
        Ok(Geometry { array, _buffers: buffers, bytes })
    }

    /// Makes it what the next draws read. Attributes that the mesh lacks get their constants, which
    /// are the context's state, not the array's.
    pub fn bind(&self, gl: &Gl) {
        // SAFETY: the array is this context's.
        unsafe { gl.bind_vertex_array(Some(self.array.handle())) };
        constant(gl, "tangent", [0.0, 0.0, 0.0, 1.0]);
        constant(gl, "color", [1.0; 4]);
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

fn attribute(gl: &Gl, name: &str, components: i32, stride: i32, offset: i32) {
    // SAFETY: a vertex array and the buffer that holds this attribute are bound; offsets and strides
    // are those of `Vertex`, or of a tightly packed array of as many vertices.
    unsafe {
        gl.enable_vertex_attrib_array(location(name));
        gl.vertex_attrib_pointer_f32(location(name), components, glow::FLOAT, false, stride, offset);
    }
}

fn constant(gl: &Gl, name: &str, [x, y, z, w]: [f32; 4]) {
    // SAFETY: sets the context's current value of an attribute, which reads no memory.
    unsafe { gl.vertex_attrib_4_f32(location(name), x, y, z, w) };
}
