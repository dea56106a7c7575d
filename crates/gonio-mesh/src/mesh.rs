//! The mesh: indexed triangles, ready for a GPU.

use glam::{DVec3, Vec3};
use gonio_threads::prelude::*;

/// Indexed triangles. All per-vertex arrays are as long as `positions`, or empty if the file has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions in the model's own space and unit; finite.
    pub positions: Vec<[f32; 3]>,
    /// Unit vectors; empty until they are read from the file or computed by [`crate::normals`].
    pub normals: Vec<[f32; 3]>,
    /// Coordinates with u to the right and v **up** (0 is the last row of the image), as in OBJ and OpenGL.
    pub tex_coords: Vec<[f32; 2]>,
    /// A second set, which only glTF stores and no reader fills: a reader's set is the one that the material's textures use.
    pub second_tex_coords: Vec<[f32; 2]>,
    /// Unit tangent and handedness (+1 or -1): bitangent = w * cross(normal, tangent).
    pub tangents: Vec<[f32; 4]>,
    /// Linear RGBA.
    pub colors: Vec<[f32; 4]>,
    /// Three per triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// Smoothing group of each triangle, 0 for "off"; empty if the file has none.
    pub smoothing_groups: Vec<u32>,
    /// Consecutive ranges of triangles that cover all of `indices`.
    pub parts: Vec<Part>,
    /// The origin of `normals`.
    pub normal_source: NormalSource,
}

/// A range of triangles with one material.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// The object or group it belongs to; empty if it has no name.
    pub name: String,
    /// Index into [`crate::Model::materials`].
    pub material: usize,
    /// First triangle.
    pub first_triangle: usize,
    /// Number of triangles.
    pub triangle_count: usize,
}

/// The origin of a mesh's normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalSource {
    /// No normals.
    #[default]
    None,
    /// The normals in the file.
    File,
    /// The normals in the file, and averaged ones where it has none.
    FileAndAveraged,
    /// One normal per triangle.
    Flat,
    /// The angle-weighted mean over adjacent faces.
    Averaged,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates.
    pub min: Vec3,
    /// Largest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// Returns the box around some points; `None` without points.
    pub fn of_points(points: impl IntoIterator<Item = Vec3>) -> Option<Bounds> {
        points.into_iter().fold(None, |bounds, p| match bounds {
            None => Some(Bounds { min: p, max: p }),
            Some(b) => Some(Bounds { min: b.min.min(p), max: b.max.max(p) }),
        })
    }

    /// Returns the centre.
    pub fn center(&self) -> Vec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns the edge lengths.
    pub fn size(&self) -> Vec3 {
        self.max - self.min
    }
}

impl Mesh {
    /// Returns the number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// Returns the box around all vertices.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of_points(self.positions.iter().map(|&p| Vec3::from(p)))
    }

    /// Returns for each direction (of any length) the largest `direction . p` over all vertices `p`; negative infinity
    /// without vertices.
    pub fn reach(&self, directions: &[DVec3]) -> Vec<f64> {
        let none = || vec![f64::NEG_INFINITY; directions.len()];
        let of_chunk = |points: &[[f32; 3]]| {
            let mut reach = none();
            for p in points {
                let p = Vec3::from(*p).as_dvec3();
                for (r, d) in reach.iter_mut().zip(directions) {
                    *r = r.max(d.dot(p));
                }
            }
            reach
        };
        let farther = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a.max(b)).collect();
        self.positions.par_chunks(65536).map(of_chunk).reduce(none, farther)
    }

    /// Returns the vertex indices of triangle `t`.
    pub fn triangle(&self, t: usize) -> [usize; 3] {
        let i = 3 * t;
        [self.indices[i] as usize, self.indices[i + 1] as usize, self.indices[i + 2] as usize]
    }

    /// Returns the corner positions of triangle `t`.
    pub fn triangle_positions(&self, t: usize) -> [Vec3; 3] {
        self.triangle(t).map(|i| Vec3::from(self.positions[i]))
    }

    /// Returns a place for each vertex, equal for equal positions (0 and -0 are equal), numbered from 0 in the order of
    /// their first vertices; and the number of places.
    pub fn places(&self) -> (Vec<u32>, usize) {
        crate::weld::places(&self.positions)
    }

    /// Returns the mesh with new texture coordinates, one for each index; vertices whose corners differ are split.
    /// Tangents are dropped, because they belong to the old coordinates. Missing coordinates are 0.
    pub fn with_corner_tex_coords(&self, tex_coords: &[[f32; 2]]) -> Mesh {
        let bare = Mesh { tex_coords: Vec::new(), tangents: Vec::new(), ..self.clone() };
        let (mesh, tex_coords) = bare.split_by_tex_coords(tex_coords);
        Mesh { tex_coords, ..mesh }
    }

    /// Returns the mesh with a second set of texture coordinates, one for each index; vertices whose corners differ are split.
    /// Missing coordinates are 0.
    pub fn with_second_corner_tex_coords(&self, tex_coords: &[[f32; 2]]) -> Mesh {
        let (mesh, second_tex_coords) = self.split_by_tex_coords(tex_coords);
        Mesh { second_tex_coords, ..mesh }
    }

    fn split_by_tex_coords(&self, of_corner: &[[f32; 2]]) -> (Mesh, Vec<[f32; 2]>) {
        let mut of_corner = of_corner.to_vec();
        of_corner.resize(self.indices.len(), [0.0; 2]);
        crate::weld::split_by_corner_values(self, &of_corner)
    }

    /// Returns the mesh with three separate vertices for each triangle, in the order of the indices.
    pub fn unshared(&self) -> Mesh {
        fn gather<T: Copy>(values: &[T], indices: &[u32]) -> Vec<T> {
            if values.is_empty() { Vec::new() } else { indices.iter().map(|&i| values[i as usize]).collect() }
        }
        Mesh {
            positions: gather(&self.positions, &self.indices),
            normals: gather(&self.normals, &self.indices),
            tex_coords: gather(&self.tex_coords, &self.indices),
            second_tex_coords: gather(&self.second_tex_coords, &self.indices),
            tangents: gather(&self.tangents, &self.indices),
            colors: gather(&self.colors, &self.indices),
            indices: (0..self.indices.len() as u32).collect(),
            smoothing_groups: self.smoothing_groups.clone(),
            parts: self.parts.clone(),
            normal_source: self.normal_source,
        }
    }
}
