//! The testbench: meshes, test scenes that distinguish mistakes, and the drawing of all scenes at once.

mod draw;
pub mod inputs;
pub mod mesh;
pub mod scene;
mod sky;

pub use draw::{Atlas, ProgramInputs, TILE, Testbench, stream_of};
use gonio_gl::{Dialect, Gl};
pub use inputs::{CUBEMAP_UNIT, WHITE_UNIT, numbers, numbers_of, samplers, uniform_bits, unit};
pub use mesh::{TestMesh, TestShape};
pub use scene::{TestLight, TestScene};
pub use sky::{SKY_SIDE, radiance, sky_faces};

/// Converts one of gonio's own shaders from 330 core to 300 es if the context needs it.
pub fn for_context(gl: &Gl, source: &str) -> String {
    for_dialect(gl.dialect(), source)
}

/// Converts one of gonio's own shaders from 330 core to a dialect.
pub fn for_dialect(dialect: Dialect, source: &str) -> String {
    source.replacen(Dialect::Core330.header(), dialect.header(), 1)
}
