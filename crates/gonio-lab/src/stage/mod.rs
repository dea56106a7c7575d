//! Where programs are tried: meshes, situations that tell mistakes apart, and the drawing of all of them at once.

mod mesh;
mod sheet;
pub mod situation;
mod sky;
mod values;

pub use mesh::{Shape, StageMesh};
pub use sheet::{Cast, Sheet, Stage, TILE};
pub use situation::{Light, Situation};
pub use values::numbers;
