//! Models: the mesh type, its readers, its normals. Bytes in, model and diagnostics out.
//!
//! Readers open no files: what a model refers to (a material library, a buffer) is asked of a
//! [`Sidecars`], which the caller implements over a disk, an archive or a web page.

pub mod collada;
pub mod compression;
pub mod diagnostic;
pub mod encoding;
pub mod explain;
pub mod format;
pub mod gltf;
mod join;
pub mod limits;
mod line_index;
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
mod report;
pub mod sidecar;
pub mod simplify;
pub mod sphere;
mod split;
pub mod stl;
mod tally;
pub mod tangents;
mod text;
pub mod texture_map;
pub mod topology;
mod weld;
pub mod write;

pub use diagnostic::{Cause, Diagnostic, ReadError, Severity};
pub use format::Format;
pub use limits::Limits;
pub use material::{AmbientRule, Material, MetallicRoughness, PropertySource};
pub use mesh::{Bounds, Mesh, NormalSource, Part};
pub use model_scene::{EmbeddedImage, ModelCamera, ModelLight, ModelLightKind};
pub use sidecar::{MissingSidecar, NoSidecars, Sidecar, SidecarUse, Sidecars};
pub use texture_map::{Channel, TexelRule, TextureMap, Wrap};

/// A model as a reader gives it.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// All geometry, in the file's own coordinates.
    pub mesh: Mesh,
    /// What [`Part::material`] indexes; never empty where the mesh has parts.
    pub materials: Vec<Material>,
    /// Pictures inside the file.
    pub images: Vec<EmbeddedImage>,
    /// Lights of the file.
    pub lights: Vec<ModelLight>,
    /// Cameras of the file.
    pub cameras: Vec<ModelCamera>,
    /// What the file holds, counted in its own words (`v`, `faces of 4 corners`, `nodes`), in an order of the
    /// reader's.
    pub contents: Vec<(String, u64)>,
    /// The files that the model named (textures apart), and what became of them.
    pub sidecars: Vec<SidecarUse>,
    /// Everything odd that was survived, in file order.
    pub diagnostics: Vec<Diagnostic>,
}
