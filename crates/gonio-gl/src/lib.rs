//! OpenGL: contexts, calls, objects that free themselves, records of frames.
//!
//! All calls go through [`Gl`], which tracks objects and bindings, so that [`trace`] can record a frame with everything that
//! its draws read. Contexts come from a window, from a web page, or from [`HeadlessContext`]. OpenGL 3.3 core, OpenGL ES 3 and
//! WebGL2 are supported. This crate does not depend on scenes, meshes or lights.

mod bounds;
mod call_table;
mod calls;
#[cfg(feature = "capture")]
pub mod capture;
mod deferred;
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
pub use deferred::DeferredGl;
pub use driver::{Dialect, DriverInfo};
pub use functions::Texels;
pub use gl::{Gl, GlError, Remedy};
#[cfg(feature = "headless")]
pub use headless::HeadlessContext;
pub use objects::GpuStatistics;
pub use saved_state::SavedState;

#[cfg(test)]
mod tests;
