//! The testbench: meshes, test scenes that distinguish mistakes, and the drawing of all scenes at once.

mod atlas;
pub mod mesh;
pub mod scene;
pub mod sky;
mod surface;
mod units;
mod values;

pub use atlas::{Atlas, ProgramInputs, TILE, Testbench, stream_of};
pub use mesh::{Shape, TestMesh};
pub use scene::{Light, TestScene};
pub use sky::radiance;
pub use surface::Surface;
pub use units::{CUBEMAP_UNIT, WHITE_UNIT, samplers, unit};
pub use values::{numbers, numbers_of_array};

/// Our own programs are written as 330 core; as 300 es they are the same with another first line.
pub fn for_context(gl: &gonio_gl::Gl, source: &str) -> String {
    if gonio_render::user_program::is_embedded(gl) {
        source.replacen("#version 330 core\n", "#version 300 es\nprecision highp float;\nprecision highp int;\n", 1)
    } else {
        source.to_owned()
    }
}
