//! OpenGL objects that free themselves, with labels for debuggers; counters of the GPU.

use crate::calls::native_name;
use crate::driver::DriverInfo;
use crate::functions::{FRAGMENT_SHADER_INVOCATIONS, VERTEX_SHADER_INVOCATIONS};
use crate::{Gl, GlError};

/// Labels an object for RenderDoc and driver messages, if the driver supports it (KHR_debug).
fn label(gl: &Gl, kind: u32, name: u32, text: &str) {
    if gl.functions().supports_debug() {
        gl.object_label(kind, name, Some(text));
    }
}

/// Groups commands under one name in debuggers and records, until it is dropped.
pub struct DebugGroup<'a> {
    gl: &'a Gl,
}

impl<'a> DebugGroup<'a> {
    /// Opens the group.
    pub fn new(gl: &'a Gl, name: &str) -> Self {
        gl.group_opened(name);
        if gl.functions().supports_debug() {
            gl.push_debug_group(glow::DEBUG_SOURCE_APPLICATION, 0, name);
        }
        DebugGroup { gl }
    }
}

impl Drop for DebugGroup<'_> {
    fn drop(&mut self) {
        self.gl.group_closed();
        if self.gl.functions().supports_debug() {
            self.gl.pop_debug_group();
        }
    }
}

macro_rules! object {
    ($(#[$doc:meta])* $Object:ident, $Handle:ident, $create:ident, $delete:ident) => {
        $(#[$doc])*
        pub struct $Object {
            gl: Gl,
            handle: glow::$Handle,
        }

        impl $Object {
            /// Creates an object that is not bound.
            pub fn create(gl: &Gl) -> Result<Self, GlError> {
                let handle = gl.$create()
                    .map_err(|error| GlError::new(format!(concat!("OpenGL did not create a ", stringify!($Object), ": {}"), error)))?;
                Ok($Object { gl: gl.clone(), handle })
            }

            /// OpenGL's name for it.
            pub fn handle(&self) -> glow::$Handle {
                self.handle
            }
        }

        impl Drop for $Object {
            fn drop(&mut self) {
                self.gl.$delete(self.handle);
            }
        }
    };
}

object!(
    /// A buffer of vertices or indices.
    Buffer, Buffer, create_buffer, delete_buffer
);
object!(
    /// A vertex array: the buffers of the attributes.
    VertexArray, VertexArray, create_vertex_array, delete_vertex_array
);
object!(
    /// A texture.
    TextureObject, Texture, create_texture, delete_texture
);
object!(
    /// A renderbuffer: an attachment that is never sampled.
    Renderbuffer, Renderbuffer, create_renderbuffer, delete_renderbuffer
);
object!(
    /// A framebuffer.
    Framebuffer, Framebuffer, create_framebuffer, delete_framebuffer
);
object!(
    /// A counter of the GPU.
    Query, Query, create_query, delete_query
);

impl Buffer {
    /// A buffer with `bytes` in it. `target` is where it is bound to be filled: an index buffer must be
    /// made while its vertex array is bound.
    pub fn with_bytes(gl: &Gl, target: u32, bytes: &[u8], usage: u32, name: &str) -> Result<Self, GlError> {
        let buffer = Buffer::create(gl)?;
        gl.bind_buffer(target, Some(buffer.handle));
        gl.buffer_data(target, bytes, usage);
        gl.name_buffer(buffer.handle, name);
        label(gl, glow::BUFFER, native_name!(buffer.handle), name);
        Ok(buffer)
    }
}

impl VertexArray {
    /// A vertex array, bound.
    pub fn bound(gl: &Gl, name: &str) -> Result<Self, GlError> {
        let array = VertexArray::create(gl)?;
        gl.bind_vertex_array(Some(array.handle));
        gl.name_vertex_array(array.handle, name);
        label(gl, glow::VERTEX_ARRAY, native_name!(array.handle), name);
        Ok(array)
    }
}

impl TextureObject {
    /// A 2-D texture, bound to the active unit.
    pub fn bound(gl: &Gl, name: &str) -> Result<Self, GlError> {
        let texture = TextureObject::create(gl)?;
        gl.bind_texture(glow::TEXTURE_2D, Some(texture.handle));
        gl.name_texture(texture.handle, name);
        label(gl, glow::TEXTURE, native_name!(texture.handle), name);
        Ok(texture)
    }
}

impl TextureObject {
    /// An array of 2-D textures, bound to the active unit.
    pub fn array(gl: &Gl, name: &str) -> Result<Self, GlError> {
        let texture = TextureObject::create(gl)?;
        gl.bind_texture(glow::TEXTURE_2D_ARRAY, Some(texture.handle));
        gl.name_texture(texture.handle, name);
        label(gl, glow::TEXTURE, native_name!(texture.handle), name);
        Ok(texture)
    }
}

impl TextureObject {
    /// A cubemap, bound to the active unit.
    pub fn cube(gl: &Gl, name: &str) -> Result<Self, GlError> {
        let texture = TextureObject::create(gl)?;
        gl.bind_texture(glow::TEXTURE_CUBE_MAP, Some(texture.handle));
        gl.name_texture(texture.handle, name);
        label(gl, glow::TEXTURE, native_name!(texture.handle), name);
        Ok(texture)
    }
}

impl TextureObject {
    /// A texture of `samples` samples per texel, bound to the active unit. OpenGL only.
    pub fn multisampled(gl: &Gl, format: u32, size: [i32; 2], samples: i32, name: &str) -> Result<Self, GlError> {
        let texture = TextureObject::create(gl)?;
        gl.bind_texture(glow::TEXTURE_2D_MULTISAMPLE, Some(texture.handle));
        gl.tex_image_2d_multisample(glow::TEXTURE_2D_MULTISAMPLE, samples, format as i32, size[0], size[1], true);
        gl.name_texture(texture.handle, name);
        label(gl, glow::TEXTURE, native_name!(texture.handle), name);
        Ok(texture)
    }
}

impl Renderbuffer {
    /// Storage of `samples` samples per pixel (0: not multisampled).
    pub fn new(gl: &Gl, format: u32, size: [i32; 2], samples: i32, name: &str) -> Result<Self, GlError> {
        let buffer = Renderbuffer::create(gl)?;
        gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer.handle));
        gl.renderbuffer_storage_multisample(glow::RENDERBUFFER, samples, format, size[0], size[1]);
        gl.name_renderbuffer(buffer.handle, name);
        label(gl, glow::RENDERBUFFER, native_name!(buffer.handle), name);
        Ok(buffer)
    }
}

impl Framebuffer {
    /// A framebuffer, bound for drawing and reading.
    pub fn bound(gl: &Gl, name: &str) -> Result<Self, GlError> {
        let framebuffer = Framebuffer::create(gl)?;
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer.handle));
        gl.name_framebuffer(framebuffer.handle, name);
        label(gl, glow::FRAMEBUFFER, native_name!(framebuffer.handle), name);
        Ok(framebuffer)
    }
}

impl Query {
    /// A query.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        Query::create(gl)
    }
}

/// Counts of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuStatistics {
    /// Vertex shader invocations; `None` where the driver cannot count them.
    pub vertices: Option<u64>,
    /// Fragment shader invocations, whole 2x2 blocks included; `None` where the driver cannot count.
    pub fragments: Option<u64>,
    /// Draw calls.
    pub draw_calls: u32,
}

/// Counters that run.
pub struct StatisticsQueries {
    queries: Option<[Query; 2]>,
}

/// Counters that have stopped; reading them waits for the GPU.
pub struct StoppedQueries {
    gl: Gl,
    queries: Option<[Query; 2]>,
    draw_calls: u32,
}

impl StatisticsQueries {
    /// Begins to count, where the driver can.
    pub fn begin(gl: &Gl, info: &DriverInfo) -> Result<Self, GlError> {
        if !info.pipeline_statistics {
            return Ok(StatisticsQueries { queries: None });
        }
        let queries = [Query::new(gl)?, Query::new(gl)?];
        gl.begin_query(VERTEX_SHADER_INVOCATIONS, queries[0].handle());
        gl.begin_query(FRAGMENT_SHADER_INVOCATIONS, queries[1].handle());
        Ok(StatisticsQueries { queries: Some(queries) })
    }

    /// Ends counting.
    pub fn end(self, gl: &Gl, draw_calls: u32) -> StoppedQueries {
        if self.queries.is_some() {
            gl.end_query(FRAGMENT_SHADER_INVOCATIONS);
            gl.end_query(VERTEX_SHADER_INVOCATIONS);
        }
        StoppedQueries { gl: gl.clone(), queries: self.queries, draw_calls }
    }
}

impl StoppedQueries {
    /// Reads the counters, which waits for the GPU.
    pub fn read(&self) -> GpuStatistics {
        let count = |query: &Query| u64::from(self.gl.get_query_parameter_u32(query.handle(), glow::QUERY_RESULT));
        GpuStatistics {
            vertices: self.queries.as_ref().map(|q| count(&q[0])),
            fragments: self.queries.as_ref().map(|q| count(&q[1])),
            draw_calls: self.draw_calls,
        }
    }
}
