//! The testbench: meshes, test scenes that distinguish mistakes, and the drawing of all scenes at once.

mod draw;
pub mod inputs;
pub mod mesh;
pub mod scene;
mod sky;

pub use draw::{Atlas, ProgramInputs, TILE, Testbench, stream_of};
pub use inputs::{CUBEMAP_UNIT, WHITE_UNIT, numbers, numbers_of_array, samplers, uniform_bits, unit};
pub use mesh::{TestMesh, TestShape};
pub use scene::{TestLight, TestScene};
pub use sky::{SKY_SIDE, radiance, sky_faces};

/// Converts one of gonio's own shaders from 330 core to 300 es if the context needs it.
pub fn for_context(gl: &gonio_gl::Gl, source: &str) -> String {
    if gonio_render::user_program::is_embedded(gl) {
        source.replacen("#version 330 core\n", "#version 300 es\nprecision highp float;\nprecision highp int;\n", 1)
    } else {
        source.to_owned()
    }
}
