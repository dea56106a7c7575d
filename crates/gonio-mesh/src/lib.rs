//! Models: the mesh type, its readers, its normals. Bytes in, model and diagnostics out.
//!
//! Readers open no files: what a model refers to (a material library, a buffer) is asked of a
//! [`Sidecars`], which the caller implements over a disk, an archive or a web page.

pub mod diagnostic;
pub mod material;
pub mod mesh;
pub mod mtl;
pub mod normals;
mod number;
pub mod obj;
mod polygon;
mod report;
mod split;
pub mod tangents;
mod text;
pub mod topology;
mod weld;

pub use diagnostic::{Diagnostic, ReadError, Severity};
pub use material::{AmbientRule, Material, TextureMap};
pub use mesh::{Bounds, Mesh, NormalSource, Part};

/// A model as a reader gives it.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// All geometry, in the file's own coordinates.
    pub mesh: Mesh,
    /// What [`Part::material`] indexes; never empty where the mesh has parts.
    pub materials: Vec<Material>,
    /// Everything odd that was survived, in file order.
    pub diagnostics: Vec<Diagnostic>,
}

/// Where a reader gets the files that a model file names.
pub trait Sidecars {
    /// The bytes of the file that a model calls `name` (as written there: relative, perhaps with
    /// backslashes or in the wrong case), or the places that were looked at in vain.
    fn read(&mut self, name: &str) -> Result<Vec<u8>, MissingSidecar>;
}

/// No such file; where it was sought.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingSidecar {
    /// Every place looked at, in order.
    pub tried: Vec<String>,
}

/// For models that stand alone, and for tests: nothing is found.
pub struct NoSidecars;

impl Sidecars for NoSidecars {
    fn read(&mut self, _name: &str) -> Result<Vec<u8>, MissingSidecar> {
        Err(MissingSidecar { tried: Vec::new() })
    }
}

/// How much a file may make a reader allocate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most vertices after splitting (`u32` indices set the default).
    pub max_vertices: u64,
    /// Most triangles.
    pub max_triangles: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { max_vertices: u32::MAX as u64, max_triangles: u32::MAX as u64 / 3 }
    }
}
