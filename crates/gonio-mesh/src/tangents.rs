//! Tangents by MikkTSpace, the convention of programs that bake normal maps.
//!
//! M. S. Mikkelsen, 2008, "Simulation of wrinkled surfaces revisited". Texture coordinates have v up, so the bitangent
//! points up in the image, and normal maps have green up (as in OpenGL, glTF and Blender).

use crate::{Mesh, weld};
use bevy_mikktspace::{Geometry, TangentSpace};
use glam::Vec3;

/// Returns the mesh with tangents, splitting vertices where corners differ. `None` if it has no texture coordinates or
/// no normals.
///
/// Corners without a defined tangent (all their triangles are degenerate, in space or in the texture) get one
/// orthogonal to their normal.
pub fn with_tangents(mesh: &Mesh) -> Option<Mesh> {
    let count = mesh.positions.len();
    if mesh.indices.is_empty() || mesh.tex_coords.len() != count || mesh.normals.len() != count {
        return None;
    }
    let mut corners = Corners { mesh, tangents: vec![None; mesh.indices.len()] };
    // The error type has no values.
    bevy_mikktspace::generate_tangents(&mut corners).ok()?;
    let tangents: Vec<[f32; 4]> = corners
        .tangents
        .iter()
        .zip(&mesh.indices)
        .map(|(tangent, &vertex)| tangent.unwrap_or_else(|| any_tangent(mesh.normals[vertex as usize])))
        .collect();
    let bare = Mesh { tangents: Vec::new(), ..mesh.clone() };
    let (mut split, tangents) = weld::split_by_corner_values(&bare, &tangents);
    split.tangents = tangents;
    Some(split)
}

/// Returns some unit vector orthogonal to `normal`.
fn any_tangent(normal: [f32; 3]) -> [f32; 4] {
    let normal = Vec3::from(normal).try_normalize().unwrap_or(Vec3::Z);
    normal.any_orthonormal_vector().extend(1.0).to_array()
}

/// The mesh in the interface of MikkTSpace.
struct Corners<'a> {
    mesh: &'a Mesh,
    tangents: Vec<Option<[f32; 4]>>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.indices[3 * face + corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangle_count()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, corner)]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.normals[self.vertex(face, corner)]
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.mesh.tex_coords[self.vertex(face, corner)]
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        let usable = tangent.map(|space| space.tangent_encoded()).filter(|t| {
            let length = Vec3::new(t[0], t[1], t[2]).length();
            (length - 1.0).abs() < 1e-3
        });
        self.tangents[3 * face + corner] = usable;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// A square in the plane z = 0, seen from +z, with the picture upright or mirrored.
    fn square(u_sign: f32) -> Mesh {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        Mesh {
            positions: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
            normals: vec![[0.0, 0.0, 1.0]; 4],
            tex_coords: corners.map(|[u, v]| [u_sign * u, v]).to_vec(),
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Mesh::default()
        }
    }

    #[test]
    fn an_upright_picture_has_its_bitangent_up() {
        // Tangent along +u, bitangent w (n x t) along +v, exactly.
        let mesh = with_tangents(&square(1.0)).unwrap();
        assert_eq!(mesh.tangents, vec![[1.0, 0.0, 0.0, 1.0]; 4]);
        let mirrored = with_tangents(&square(-1.0)).unwrap();
        assert_eq!(mirrored.tangents, vec![[-1.0, 0.0, 0.0, -1.0]; 4]);
    }

    #[test]
    fn vertices_are_split_where_the_picture_turns() {
        // The second triangle has the picture mirrored: its shared vertices cannot have the same tangent.
        let mut mesh = square(1.0);
        mesh.tex_coords[3] = [1.0, 0.0];
        let with = with_tangents(&mesh).unwrap();
        assert_eq!(with.indices.len(), 6);
        assert_eq!(with.positions.len(), 6);
        assert!(with.tangents[..3].iter().all(|t| t[3] == 1.0));
        let second = &with.indices[3..];
        assert!(second.iter().all(|&i| with.tangents[i as usize][3] == -1.0), "{:?}", with.tangents);
    }

    #[test]
    fn no_picture_no_tangents_and_a_point_picture_any() {
        let mesh = Mesh { tex_coords: Vec::new(), ..square(1.0) };
        assert_eq!(with_tangents(&mesh), None);
        let mesh = Mesh { normals: Vec::new(), ..square(1.0) };
        assert_eq!(with_tangents(&mesh), None);
        let mesh = Mesh { tex_coords: vec![[0.5, 0.5]; 4], ..square(1.0) };
        for t in with_tangents(&mesh).unwrap().tangents {
            assert_eq!((t[2], Vec3::new(t[0], t[1], t[2]).length()), (0.0, 1.0));
        }
    }
}
