//! Texture atlases: unwraps a mesh into charts that do not overlap, and packs them into the unit square.
//!
//! | module | step |
//! |---|---|
//! | `faces` | neighbours of triangles by position |
//! | `charts` | connected groups of triangles within an angle of an axis |
//! | `flatten`, `solver`, `multigrid` | least-squares conformal maps, then as rigid as possible |
//! | `crossing` | charts that overlap themselves are found, and divided |
//! | `pack`, `bitmap` | all charts in one square, with a margin |
//! | [`report`] | coverage, stretch, density, overlaps, of any texture coordinates |
//! | [`raster`] | the texels of a triangle |
//! | [`layout`] | a picture of the atlas |
//!
//! Nothing here opens a file or prints. The result does not depend on the number of threads.
#![forbid(unsafe_code)]

mod bitmap;
mod charts;
mod crossing;
mod faces;
mod flatten;
pub mod layout;
mod multigrid;
mod pack;
pub mod raster;
pub mod report;
mod solver;
mod unwrap;

pub use report::{UvReport, uv_report};
pub use unwrap::{AtlasUv, UnwrapError, UnwrapSettings, UvSource, unwrap};
