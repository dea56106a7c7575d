//! Models: the mesh type, its readers and writers, its normals.
//!
//! Readers take bytes and return a model with diagnostics. They open no files: files that a model refers to (a material
//! library, a buffer) are requested from a [`Sidecars`], which the caller implements for a disk, an archive or a web
//! page.

mod by_cost;
pub mod collada;
pub mod compression;
pub mod diagnostic;
pub mod encoding;
pub mod explain;
mod exporter;
pub mod format;
pub mod gltf;
pub mod input;
pub mod material;
pub mod medit;
pub mod mesh;
pub mod model_scene;
pub mod mtl;
pub mod normals;
mod number;
pub mod obj;
pub mod ply;
mod polygon;
pub mod simplify;
pub mod sphere;
pub mod stl;
pub mod tangents;
mod text;
pub mod topology;
mod weld;
pub mod write;

pub use by_cost::ByCost;
pub use diagnostic::{Cause, Diagnostic, FilePlace, ReadError, Severity};
pub use exporter::exporter;
pub use format::Format;
pub use input::{Limits, MissingSidecar, NoSidecars, Sidecar, SidecarUse, Sidecars};
pub use material::{AmbientRule, Channel, Material, MetallicRoughness, PropertySource, TexelRule, TextureMap, Wrap};
pub use mesh::{Bounds, Mesh, NormalSource, Part};
pub use model_scene::{EmbeddedImage, ModelCamera, ModelLight, ModelLightKind};

/// A model read from a file.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// All geometry, in the file's own coordinates.
    pub mesh: Mesh,
    /// The materials, indexed by [`Part::material`]; never empty if the mesh has parts.
    pub materials: Vec<Material>,
    /// Images inside the file.
    pub images: Vec<EmbeddedImage>,
    /// Lights in the file.
    pub lights: Vec<ModelLight>,
    /// Cameras in the file.
    pub cameras: Vec<ModelCamera>,
    /// Counts of the file's elements under the format's own names (`v`, `faces of 4 corners`, `nodes`).
    pub contents: Vec<(String, u64)>,
    /// The files that the model refers to, except textures, and whether they were found.
    pub sidecars: Vec<SidecarUse>,
    /// Warnings and notes in file order.
    pub diagnostics: Vec<Diagnostic>,
}
