//! Pictures of scenes by OpenGL.
//!
//! [`Renderer`] draws a loaded scene into a linear float picture and encodes it, on every context of `gonio-gl`: a
//! window's, a web page's, or one without a window. The GLSL is in `shaders/`; the pure functions in `shaders/light/`
//! are the twins of `gonio-light`'s.
#![forbid(unsafe_code)]

mod body;
pub mod conversion;
mod display;
mod environment_on_gpu;
mod geometry;
pub mod gl_program;
pub mod glsl;
mod light_table;
mod renderer;
mod scene_on_gpu;
mod shader_text;
mod shadow_map;
mod shadows_on_gpu;
mod textures;
pub mod user_program;

pub use display::{DisplayOptions, DisplayTexture, Presentation, Presenter, View};
pub use geometry::VertexData;
pub use glsl::OVERDRAW_SCALE;
pub use gonio_scene::{Overlays, SpecialView};
pub use renderer::{
    DifferenceScale, GroundLook, OutlinedPart, Painted, RenderedFrame, RenderedPicture, Renderer, SampledTexture,
    UniformValues, UserPass, displayed_environment, map_of, shown_unchanged,
};
pub use scene_on_gpu::{GpuScene, wants_unshared};

#[cfg(test)]
mod tests;
