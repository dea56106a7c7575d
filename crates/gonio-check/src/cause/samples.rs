//! The points at which values are compared: places on the surfaces of the test scenes, and the vertices around them.

use super::values::Values;
use crate::testbench::{TestMesh, TestScene, TestShape};
use glam::{Mat3, Mat4, Vec3, Vec4};
use gonio_interpreter::Fragment;

/// Places on the surface in each test scene: as many as the interpreter computes together.
pub const PLACES: usize = gonio_interpreter::LANES;

/// The points of one test scene.
#[derive(Clone, Debug)]
pub struct SceneSamples {
    /// The scene.
    pub scene: TestScene,
    /// Its mesh, reduced to the vertices around the places; indices count these.
    pub mesh: TestMesh,
    /// The places, at most as many as the interpreter computes together.
    pub places: Vec<Fragment>,
}

/// The fractional part of multiples of an irrational number: evenly distributed in 0 to 1.
fn spread(index: usize, step: f64) -> f64 {
    (0.5 + index as f64 * step).fract()
}

impl SceneSamples {
    /// Chooses places on the triangles that face the camera, evenly over the surface. In a sky, all triangles count.
    #[must_use]
    pub fn new(scene: TestScene) -> Self {
        let whole = scene.shape.mesh();
        let at = |all: &[f32], vertex: u32| Vec3::from_slice(&all[vertex as usize * 3..][..3]);
        let view = match scene.shape {
            // A sky moves with the camera.
            TestShape::Cube => Mat4::from_mat3(Mat3::from_mat4(scene.view_from_world())),
            _ => scene.view_from_world(),
        };
        let clip_from_model = scene.clip_from_view() * view * scene.world_from_model;
        let world = |vertex: u32| scene.world_from_model.transform_point3(at(&whole.positions, vertex));
        // The area of each triangle as the camera sees it.
        let seen = |corners: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|corner| world(corners[corner]));
            let area = (b - a).cross(c - a);
            let to_eye = (scene.eye - (a + b + c) / 3.0).normalize_or_zero();
            let normal: Vec3 = [0, 1, 2].map(|corner| at(&whole.normals, corners[corner])).iter().sum();
            let outwards = scene.normal_matrix().transform_vector3(normal);
            let facing = area.dot(to_eye) * area.dot(outwards).signum();
            if scene.shape.is_around_the_eye() { area.length() } else { facing.max(0.0) }
        };
        let triangles: Vec<&[u32]> = whole.indices.chunks_exact(3).collect();
        let mut sums = Vec::with_capacity(triangles.len());
        let mut total = 0.0_f64;
        for corners in &triangles {
            total += f64::from(seen(corners));
            sums.push(total);
        }
        let mut mesh = TestMesh::default();
        let mut known: Vec<Option<u32>> = vec![None; whole.positions.len() / 3];
        let mut places = Vec::with_capacity(PLACES);
        for index in 0..PLACES * 16 {
            if places.len() == PLACES || total <= 0.0 {
                break;
            }
            let wanted = spread(index, 0.618_033_988_749_895) * total;
            let triangle = sums.partition_point(|sum| *sum <= wanted).min(triangles.len() - 1);
            let corners: [u32; 3] = [0, 1, 2].map(|corner| triangles[triangle][corner]);
            let (mut u, mut v) = (spread(index, 0.754_877_666_246_693), spread(index, 0.569_840_290_998_053));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let weights = [(1.0 - u - v) as f32, u as f32, v as f32];
            let clip = corners.map(|corner| clip_from_model * at(&whole.positions, corner).extend(1.0));
            let place: Vec4 = clip.iter().zip(weights).map(|(corner, weight)| *corner * weight).sum();
            if place.w <= 1e-3 || place.x.abs() > place.w || place.y.abs() > place.w {
                continue;
            }
            let shares: [f32; 3] = std::array::from_fn(|corner| weights[corner] * clip[corner].w);
            let sum: f32 = shares.iter().sum();
            let corners = corners.map(|corner| {
                *known[corner as usize].get_or_insert_with(|| {
                    let (from, size) = (corner as usize, mesh.positions.len() / 3);
                    mesh.positions.extend(&whole.positions[from * 3..][..3]);
                    mesh.normals.extend(&whole.normals[from * 3..][..3]);
                    mesh.tex_coords.extend(&whole.tex_coords[from * 2..][..2]);
                    mesh.colors.extend(&whole.colors[from * 3..][..3]);
                    size as u32
                })
            });
            places.push(Fragment { corners, screen: shares.map(|share| share / sum), weights });
        }
        SceneSamples { scene, mesh, places }
    }

    /// Some of the places, and the vertices around them, by their numbers here.
    #[must_use]
    pub fn some(&self, places: &[usize]) -> (Self, Vec<usize>) {
        let mut vertices: Vec<usize> = Vec::new();
        let mut chosen: Vec<Fragment> = places.iter().map(|place| self.places[*place]).collect();
        for corner in chosen.iter_mut().flat_map(|place| &mut place.corners) {
            let known = vertices.iter().position(|vertex| *vertex == *corner as usize);
            *corner = known.unwrap_or_else(|| {
                vertices.push(*corner as usize);
                vertices.len() - 1
            }) as u32;
        }
        let of = |all: &[f32], size: usize| -> Vec<f32> {
            vertices.iter().flat_map(|vertex| &all[vertex * size..][..size]).copied().collect()
        };
        let mesh = TestMesh {
            positions: of(&self.mesh.positions, 3),
            normals: of(&self.mesh.normals, 3),
            tex_coords: of(&self.mesh.tex_coords, 2),
            colors: of(&self.mesh.colors, 3),
            ..TestMesh::default()
        };
        (SceneSamples { scene: self.scene.clone(), mesh, places: chosen }, vertices)
    }

    /// The first places, with the vertices around them.
    #[must_use]
    pub fn few(&self, count: usize) -> Self {
        let places: Vec<usize> = (0..count.min(self.places.len())).collect();
        self.some(&places).0
    }

    /// The number of vertices.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.mesh.positions.len() / 3
    }
}

/// Interpolates values of vertices.
pub(super) fn interpolated(values: &Values, samples: &[SceneSamples]) -> Values {
    let places = samples.iter().map(|samples| samples.places.len()).sum();
    let mut made = Values::absent(values.size, places);
    let (mut first, mut point) = (0, 0);
    for samples in samples {
        for place in &samples.places {
            let corners = place.corners.map(|corner| first + corner as usize);
            made.present[point] = corners.iter().all(|corner| values.present[*corner]);
            for component in 0..values.size {
                let sum = (0..3).map(|c| values.at(corners[c])[component] * place.weights[c]).sum();
                made.numbers[point * values.size + component] = sum;
            }
            point += 1;
        }
        first += samples.vertices();
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testbench::scene;

    #[test]
    fn places_face_the_camera_and_are_weighted_in_space() {
        for scene in scene::lit().into_iter().chain(scene::skies()).chain(scene::mirrored()) {
            let samples = SceneSamples::new(scene.clone());
            assert_eq!(samples.places.len(), PLACES, "{}", scene.name);
            for place in &samples.places {
                assert!((place.weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
                assert!((place.screen.iter().sum::<f32>() - 1.0).abs() < 1e-5);
                assert!(place.corners.iter().all(|corner| (*corner as usize) < samples.vertices()));
            }
            assert!(samples.vertices() >= 4 && samples.vertices() <= 3 * PLACES, "{}", samples.vertices());
        }
    }
}
