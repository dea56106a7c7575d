//! Where programs are tried: meshes, situations that tell mistakes apart, and the drawing of all of them at once.

pub(crate) mod mesh;
mod sheet;
pub mod situation;
pub(crate) mod sky;
mod surface;
mod units;
mod values;

pub use mesh::{Shape, StageMesh};
pub(crate) use sheet::stream_of;
pub use sheet::{Cast, Sheet, Stage, TILE};
pub use situation::{Light, Situation};
pub(crate) use sky::radiance;
pub use surface::Surface;
pub(crate) use units::{CUBEMAP_UNIT, WHITE_UNIT, samplers, unit};
pub use values::{numbers, numbers_of_array};

/// Our own programs are written as 330 core; as 300 es they are the same with another first line.
pub fn for_context(gl: &gonio_gl::Gl, source: &str) -> String {
    if gonio_render::user_program::is_embedded(gl) {
        source.replacen("#version 330 core\n", "#version 300 es\nprecision highp float;\nprecision highp int;\n", 1)
    } else {
        source.to_owned()
    }
}
