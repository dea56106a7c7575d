//! OpenGL: contexts, calls, objects that free themselves, records of frames.
//!
//! [`Gl`] is the only way to OpenGL: it knows what exists and what is bound, so that [`trace`] can record a frame with
//! all that its draws read. Contexts come from a window, from a web page, or from [`HeadlessContext`]. OpenGL 3.3 core
//! and OpenGL ES 3 / WebGL2 are spoken alike. Nothing here knows scenes, meshes or lights.

mod bounds;
mod call_table;
mod calls;
#[cfg(all(feature = "headless", any(windows, target_os = "linux")))]
pub mod capture;
#[cfg(all(feature = "headless", not(any(windows, target_os = "linux"))))]
#[path = "capture_unsupported.rs"]
pub mod capture;
mod dialect;
mod driver;
mod error;
mod functions;
mod gl;
#[cfg(feature = "headless")]
pub mod headless;
mod memory;
pub mod objects;
pub mod program;
mod saved_state;
pub mod statistics;
pub mod target;
pub mod trace;

pub use calls::Drawing;
pub use dialect::Dialect;
pub use driver::DriverInfo;
pub use error::{GlError, Remedy};
pub use gl::Gl;
#[cfg(feature = "headless")]
pub use headless::HeadlessContext;
pub use memory::Texels;
pub use saved_state::SavedState;
pub use statistics::GpuStatistics;

#[cfg(test)]
mod tests;
