//! How triangles hang together.

use crate::Mesh;

/// Whether the surface is closed (every edge, by position, is passed as often one way as the other)
/// and its outside is the front (the enclosed volume is positive): then back faces are never seen
/// from outside.
pub fn is_closed_outward(mesh: &Mesh) -> bool {
    let _ = mesh;
    false
}
