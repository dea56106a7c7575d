//! Bakes what a scene's surfaces show into textures for new texture coordinates.
//!
//! | module | content |
//! |---|---|
//! | [`surface`] | all objects of a scene as one mesh in world space, and its materials at any point |
//! | [`texels`] | the samples of each texel; texels beside a chart continue it |
//! | [`detail`] | the parts that need texels, and where charts end, for maps of materials |
//! | [`maps`] | the quantities that can be baked |
//! | [`model`] | the model with the baked textures in place of its own |
//! | [`job`] | all of it, from a scene to files, with progress |
//!
//! Nothing here opens a file or prints. The result does not depend on the number of threads.
#![forbid(unsafe_code)]

pub mod detail;
pub mod job;
pub mod maps;
pub mod model;
pub mod surface;
pub mod texels;

pub use detail::MaterialDetail;
pub use job::{BakeJob, BakeJobError, BakedAtlas, MapPicture};
pub use maps::{BakeSettings, BakedMap, Baker, LightAt, LitPoint, MapKind};
pub use surface::SceneSurface;
