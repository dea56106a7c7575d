//! Output files: their paths and formats, and how they are written: completely or not at all.

pub mod animation;
pub mod atomic;
pub mod path;
pub mod plan;
pub mod set;

pub use path::{Content, OutputPath};
pub use plan::{Format, Plan, PlanRequest};
pub use set::FileSet;
