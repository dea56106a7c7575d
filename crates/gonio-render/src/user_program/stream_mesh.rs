//! A mesh whose streams are given to attributes by whoever draws.

use super::UserProgram;
use gonio_gl::objects::{Buffer, VertexArray};
use gonio_gl::{Gl, GlError};

/// Numbers for each vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream<'a> {
    /// For debuggers.
    pub name: &'a str,
    /// A vertex' numbers, 1 to 4.
    pub components: usize,
    /// All vertices' numbers.
    pub numbers: &'a [f32],
}

/// Triangles on the GPU.
pub struct StreamMesh {
    gl: Gl,
    array: VertexArray,
    streams: Vec<(i32, Buffer)>,
    _indices: Buffer,
    count: i32,
}

impl StreamMesh {
    /// Every index must be below the number of vertices of every stream; those that are not are an error.
    pub fn new(gl: &Gl, streams: &[Stream<'_>], indices: &[u32], name: &str) -> Result<Self, GlError> {
        let array = VertexArray::bound(gl, name)?;
        let last = indices.iter().copied().max().unwrap_or(0) as usize;
        let mut buffers = Vec::new();
        for stream in streams {
            if !(1..=4).contains(&stream.components) || (last + 1) * stream.components > stream.numbers.len() {
                return Err(GlError::new(format!("{name}: the stream `{}` has too few vertices", stream.name)));
            }
            let bytes: &[u8] = bytemuck::cast_slice(stream.numbers);
            let label = format!("{name}: {}", stream.name);
            let buffer = Buffer::with_bytes(gl, glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW, &label)?;
            buffers.push((stream.components as i32, buffer));
        }
        let bytes: &[u8] = bytemuck::cast_slice(indices);
        let indices_buffer = Buffer::with_bytes(gl, glow::ELEMENT_ARRAY_BUFFER, bytes, glow::STATIC_DRAW, name)?;
        gl.bind_vertex_array(None);
        let count = indices.len() as i32;
        Ok(StreamMesh { gl: gl.clone(), array, streams: buffers, _indices: indices_buffer, count })
    }

    /// Draws it with the bound program: attributes by location, each with the number of its stream; those that are not named
    /// read (0, 0, 0, 1).
    pub fn draw(&self, program: &UserProgram, feed: &[(u32, usize)]) {
        let gl = &self.gl;
        gl.bind_vertex_array(Some(self.array.handle()));
        for location in program.locations() {
            gl.disable_vertex_attrib_array(location);
            gl.vertex_attrib_4_f32(location, 0.0, 0.0, 0.0, 1.0);
        }
        for &(location, stream) in feed {
            let Some((components, buffer)) = self.streams.get(stream) else { continue };
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer.handle()));
            gl.enable_vertex_attrib_array(location);
            gl.vertex_attrib_pointer_f32(location, *components, glow::FLOAT, false, 0, 0);
        }
        gl.draw_elements(glow::TRIANGLES, self.count, glow::UNSIGNED_INT, 0);
        gl.bind_vertex_array(None);
    }
}
