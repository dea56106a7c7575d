//! OpenGL through glow.

mod error;
#[cfg(feature = "headless")]
pub mod headless;
pub mod renderer;

pub use error::GlError;
#[cfg(feature = "headless")]
pub use headless::HeadlessContext;
pub use renderer::{Drawn, DriverInfo, GpuScene, GpuStatistics, Renderer};
