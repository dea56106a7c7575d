//! OpenGL: contexts, calls, objects that free themselves, records of frames.
//!
//! [`Gl`] is the only way to OpenGL: it knows what exists and what is bound, so that [`trace`] can record a frame with
//! all that its draws read. Contexts come from a window, from a web page, or from [`HeadlessContext`]. OpenGL 3.3 core
//! and OpenGL ES 3 / WebGL2 are spoken alike. Nothing here knows scenes, meshes or lights.

mod bounds;
mod call_table;
mod calls;
#[cfg(feature = "headless")]
pub mod capture;
mod driver;
mod functions;
mod gl;
#[cfg(feature = "headless")]
pub mod headless;
pub mod objects;
pub mod program;
mod saved_state;
pub mod target;
pub mod trace;

pub use calls::Drawing;
pub use driver::{Dialect, DriverInfo};
pub use functions::Texels;
pub use gl::{Gl, GlError, Remedy};
#[cfg(feature = "headless")]
pub use headless::HeadlessContext;
pub use objects::GpuStatistics;
pub use saved_state::SavedState;

#[cfg(test)]
mod tests;
