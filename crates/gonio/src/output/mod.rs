//! Pictures into files: which files, in which formats, and never half of one.

pub mod animation;
pub mod atomic;
pub mod plan;
pub mod set;

pub use plan::{Format, Plan, PlanRequest, Target};
pub use set::FileSet;
