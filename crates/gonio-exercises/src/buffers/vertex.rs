//! Vertices as every part of this module passes them on.

use serde::Serialize;

/// A vertex of a triangle list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Vertex {
    /// In the model's space and unit.
    pub position: [f32; 3],
    /// u to the right, v up; zero where there is none.
    pub tex_coord: [f32; 2],
    /// Of unit length; zero if absent.
    pub normal: [f32; 3],
}

/// Which attributes beside the position there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Attributes {
    /// Texture coordinates.
    pub tex_coords: bool,
    /// Normals.
    pub normals: bool,
}

impl Attributes {
    /// From 0 to 3, another one for each.
    pub(super) fn number(self) -> usize {
        usize::from(self.tex_coords) + 2 * usize::from(self.normals)
    }

    pub(super) fn and(self, other: Attributes) -> Attributes {
        Attributes { tex_coords: self.tex_coords && other.tex_coords, normals: self.normals && other.normals }
    }
}

/// Unit length, or zero where there is none; what is not finite stays.
pub(super) fn unit(normal: [f32; 3]) -> [f32; 3] {
    let wide = normal.map(f64::from);
    let length = wide.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_finite() && length > 1e-12 { wide.map(|x| (x / length) as f32) } else { normal }
}
