//! Where programs are tried: meshes, situations that tell mistakes apart, and the drawing of all of them at once.

pub(crate) mod mesh;
mod sheet;
pub mod situation;
pub(crate) mod sky;
mod values;

pub use mesh::{Shape, StageMesh};
pub(crate) use sheet::stream_of;
pub use sheet::{Cast, Sheet, Stage, TILE};
pub use situation::{Light, Situation};
pub use values::numbers;
