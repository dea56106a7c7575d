//! Coarse meshes with smooth normals, which show mistakes with interpolation.

use std::f32::consts::{PI, TAU};

/// The shape of a test mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TestShape {
    /// Radius 1 around the origin, 8 segments and 6 rings. Its normals are its positions.
    Sphere,
    /// Radii 0.7 and 0.3 around the y axis, 14 by 8. Its normals differ from its positions.
    Torus,
    /// A cube from -1 to 1, for skyboxes.
    Cube,
    /// A small pyramid with corners in five colours, as the first exercise draws it.
    Pyramid,
    /// The pyramid in a globe of many colours, so that the picture identifies every direction of the camera.
    Landmarks,
}

impl TestShape {
    /// All shapes, in the order of [`TestShape::index`].
    pub const ALL: [TestShape; 5] =
        [TestShape::Sphere, TestShape::Torus, TestShape::Cube, TestShape::Pyramid, TestShape::Landmarks];

    /// Returns its index in [`TestShape::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Whether the camera is inside it.
    pub fn is_around_the_eye(self) -> bool {
        matches!(self, TestShape::Cube | TestShape::Landmarks)
    }

    /// Returns its vertices and triangles.
    pub fn mesh(self) -> TestMesh {
        match self {
            TestShape::Sphere => sphere(8, 6),
            TestShape::Torus => torus(14, 8),
            TestShape::Cube => cube(),
            TestShape::Pyramid => pyramid(),
            TestShape::Landmarks => landmarks(),
        }
    }
}

/// A mesh for students' programs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TestMesh {
    /// Positions x, y, z in model space.
    pub positions: Vec<f32>,
    /// Unit normals.
    pub normals: Vec<f32>,
    /// Texture coordinates u, v.
    pub tex_coords: Vec<f32>,
    /// Linear RGB; white on lit meshes.
    pub colors: Vec<f32>,
    /// Three indices for each triangle.
    pub indices: Vec<u32>,
}

/// Creates a grid of `across + 1` by `down + 1` vertices, with two triangles in each cell.
fn grid(across: usize, down: usize, vertex: impl Fn(f32, f32) -> ([f32; 3], [f32; 3])) -> TestMesh {
    let mut mesh = TestMesh::default();
    for row in 0..=down {
        for column in 0..=across {
            let (u, v) = (column as f32 / across as f32, row as f32 / down as f32);
            let (position, normal) = vertex(u, v);
            mesh.positions.extend(position);
            mesh.normals.extend(normal);
            mesh.tex_coords.extend([u, v]);
            mesh.colors.extend([1.0; 3]);
        }
    }
    let at = |row: usize, column: usize| (row * (across + 1) + column) as u32;
    for row in 0..down {
        for column in 0..across {
            let [a, b, c, d] = [at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)];
            mesh.indices.extend([a, b, c, a, c, d]);
        }
    }
    mesh
}

/// Returns a sphere of radius 1 around the origin with smooth normals.
pub fn sphere(segments: usize, rings: usize) -> TestMesh {
    grid(segments, rings, |u, v| {
        let (longitude, colatitude) = (u * TAU, PI - v * PI);
        let p = [colatitude.sin() * longitude.cos(), colatitude.cos(), -colatitude.sin() * longitude.sin()];
        (p, p)
    })
}

/// Returns a torus of radii 0.7 and 0.3 around the y axis with smooth normals.
pub fn torus(around: usize, tube: usize) -> TestMesh {
    grid(around, tube, |u, v| {
        let (phi, theta) = (u * TAU, v * TAU);
        let normal = [theta.cos() * phi.cos(), theta.sin(), -theta.cos() * phi.sin()];
        let position = [0.7 * phi.cos() + 0.3 * normal[0], 0.3 * normal[1], -0.7 * phi.sin() + 0.3 * normal[2]];
        (position, normal)
    })
}

/// Creates a cube with eight shared corners and normals from its centre: only positions matter in a skybox.
fn cube() -> TestMesh {
    let mut mesh = TestMesh::default();
    for corner in 0..8_u32 {
        let side = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let position = [side(0), side(1), side(2)];
        mesh.positions.extend(position);
        mesh.normals.extend(position.map(|x| x / 3.0_f32.sqrt()));
        mesh.tex_coords.extend([position[0] * 0.5 + 0.5, position[1] * 0.5 + 0.5]);
        mesh.colors.extend([1.0; 3]);
    }
    for quad in [[1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]] {
        let [a, b, c, d] = quad;
        mesh.indices.extend([a, b, c, a, c, d]);
    }
    mesh
}

/// Creates a pyramid with shared corners and normals from its centre.
fn pyramid() -> TestMesh {
    let mut mesh = TestMesh::default();
    let corners = [
        ([-0.5, -0.4, 0.5], [0.9, 0.1, 0.1]),
        ([0.5, -0.4, 0.5], [0.1, 0.8, 0.2]),
        ([0.5, -0.4, -0.5], [0.1, 0.2, 0.9]),
        ([-0.5, -0.4, -0.5], [0.9, 0.8, 0.1]),
        ([0.0, 0.6, 0.0], [0.95, 0.9, 0.95]),
    ];
    for (position, color) in corners {
        let length = position.iter().map(|x: &f32| x * x).sum::<f32>().sqrt();
        mesh.positions.extend(position);
        mesh.normals.extend(position.map(|x| x / length));
        mesh.tex_coords.extend([position[0] + 0.5, position[2] + 0.5]);
        mesh.colors.extend::<[f32; 3]>(color);
    }
    for triangle in [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2], [0, 2, 1]] {
        mesh.indices.extend(triangle);
    }
    mesh
}

/// Creates the pyramid, and around it a globe of radius 3 in the colours of the environment.
fn landmarks() -> TestMesh {
    let (mut mesh, globe) = (pyramid(), sphere(12, 8));
    let first = (mesh.positions.len() / 3) as u32;
    mesh.positions.extend(globe.positions.iter().map(|x| 3.0 * x));
    mesh.normals.extend(&globe.normals);
    mesh.tex_coords.extend(&globe.tex_coords);
    for direction in globe.normals.chunks_exact(3) {
        mesh.colors.extend(super::sky::radiance(glam::Vec3::from_slice(direction)));
    }
    mesh.indices.extend(globe.indices.iter().map(|index| first + index));
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_unit_vectors_and_point_out_of_the_surface() {
        for shape in [TestShape::Sphere, TestShape::Torus] {
            let mesh = shape.mesh();
            for normal in mesh.normals.chunks_exact(3) {
                let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
                assert!((length - 1.0).abs() < 1e-5, "{shape:?}: {normal:?}");
            }
            let vector = |i: u32| glam::Vec3::from_slice(&mesh.positions[i as usize * 3..]);
            for triangle in mesh.indices.chunks_exact(3) {
                let [a, b, c] = [triangle[0], triangle[1], triangle[2]].map(vector);
                let face = (b - a).cross(c - a);
                let normal: glam::Vec3 =
                    triangle.iter().map(|&i| glam::Vec3::from_slice(&mesh.normals[i as usize * 3..])).sum();
                // The sphere's poles have triangles without area.
                assert!(face.length() < 1e-6 || face.dot(normal) > 0.0, "{shape:?}: {triangle:?}");
            }
        }
    }
}
