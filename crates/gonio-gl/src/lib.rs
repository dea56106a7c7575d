//! OpenGL through glow: contexts, GLSL, targets, draws, counters. The only crate with `unsafe` code.
//!
//! [`Renderer`] draws a loaded scene into a linear float picture and encodes it; it runs on OpenGL 3.3
//! core and on OpenGL ES 3 / WebGL2 alike, in a window or without one ([`HeadlessContext`]). The GLSL
//! stands in `shaders/`: `shaders/light/` are pure functions, the twins of `gonio-light`'s.
#![allow(unsafe_code)]

mod body_on_gpu;
mod body_tree;
mod canvas;
#[cfg(all(feature = "headless", any(windows, target_os = "linux")))]
pub mod capture;
#[cfg(all(feature = "headless", not(any(windows, target_os = "linux"))))]
#[path = "capture_unsupported.rs"]
pub mod capture;
pub mod conversion;
mod driver;
mod environment_on_gpu;
mod error;
pub mod foreign;
mod geometry;
mod gl;
pub mod glsl;
mod half;
#[cfg(feature = "headless")]
pub mod headless;
pub mod host;
mod light_table;
mod objects;
mod presenter;
mod program;
pub mod record;
mod renderer;
mod scene_on_gpu;
mod show;
mod statistics;
mod store;
mod target;
mod textures;

pub use canvas::Canvas;
pub use driver::DriverInfo;
pub use error::GlError;
pub use gl::Gl;
pub use glsl::OVERDRAW_SCALE;
pub use gonio_scene::{Overlays, SpecialView};
#[cfg(feature = "headless")]
pub use headless::HeadlessContext;
pub use presenter::{Presentation, Presenter};
pub use renderer::{DifferenceScale, Drawn, Drawn8, Painted, Renderer};
pub use scene_on_gpu::GpuScene;
pub use show::{Show, View};
pub use statistics::GpuStatistics;

#[cfg(test)]
mod tests;
