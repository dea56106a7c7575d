//! Programs with any attributes and uniforms, drawn into float targets: students' shaders and their references.
//!
//! Nothing is known of them but what OpenGL tells after linking: which attributes and uniforms there are, by name and type.
//! Who draws decides which stream of a mesh feeds which attribute, and what every uniform holds.

mod float_texture;
mod program;
mod stream_mesh;
mod tiles;

pub use float_texture::FloatTexture;
pub use program::{BrokenProgram, ProgramVariable, UserProgram};
pub use stream_mesh::{Stream, StreamMesh};
pub use tiles::{NOT_DRAWN, TileTarget};

/// Whether a context speaks OpenGL ES (WebGL2 is one of those), whose shaders begin with `#version 300 es`.
pub fn is_embedded(gl: &gonio_gl::Gl) -> bool {
    gl.is_embedded()
}
