//! The unit sphere with a chosen number of triangles.

use crate::{Mesh, NormalSource, Part};
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// The highest frequency: 131,072 triangles.
pub const MOST_FREQUENCY: u32 = 128;

/// There is no sphere of this frequency: it is 0, or above [`MOST_FREQUENCY`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InvalidFrequency(pub u32);

impl std::fmt::Display for InvalidFrequency {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let most = triangle_count(MOST_FREQUENCY);
        write!(
            f,
            "invalid frequency {} of a sphere: expected 1 to {MOST_FREQUENCY}, which is 8 to {most} triangles",
            self.0
        )
    }
}

impl std::error::Error for InvalidFrequency {}

/// Returns the number of triangles of the sphere with a frequency: each of an octahedron's eight faces is divided into
/// `frequency`² of them.
pub fn triangle_count(frequency: u32) -> usize {
    8 * frequency as usize * frequency as usize
}

/// Returns the frequency, from 1 to [`MOST_FREQUENCY`], whose sphere has a number of triangles closest to `triangles`: the
/// highest one for all numbers above 131,072.
pub fn nearest_frequency(triangles: usize) -> u32 {
    let frequency = (triangles as f64 / 8.0).sqrt().round();
    (frequency as u32).clamp(1, MOST_FREQUENCY)
}

/// Returns the unit sphere around the origin: an octahedron whose edges are divided into `frequency` segments, from 1 to
/// [`MOST_FREQUENCY`], with all vertices on the sphere.
///
/// The vertex at the integer barycentric coordinates (i, j, k) of an octant, `i + j + k = frequency`, is the direction
/// (sin(pi i / 2 f), sin(pi j / 2 f), sin(pi k / 2 f)): angles are equal along the octahedron's edges, whereas plain
/// projection would crowd vertices at the corners. Normals are exact. Texture coordinates are longitude (u = 0.5 at +z,
/// growing towards +x) and latitude; vertices are duplicated along the meridian of -z, and there is one for each octant
/// at both poles. One part; closed, front faces outward.
///
/// # Errors
///
/// The frequency is 0, or above [`MOST_FREQUENCY`].
pub fn sphere(frequency: u32) -> Result<Mesh, InvalidFrequency> {
    if !(1..=MOST_FREQUENCY).contains(&frequency) {
        return Err(InvalidFrequency(frequency));
    }
    let f = frequency;
    let mut maker = Maker { f, ..Maker::default() };
    for octant in 0..8 {
        let signs = [0, 1, 2].map(|axis| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 });
        maker.octant(DVec3::from(signs));
    }
    let mut mesh = maker.mesh;
    mesh.normals = mesh.positions.clone();
    mesh.normal_source = NormalSource::File;
    let triangle_count = mesh.triangle_count();
    mesh.parts = vec![Part { name: "sphere".into(), material: 0, first_triangle: 0, triangle_count }];
    Ok(mesh)
}

#[derive(Default)]
struct Maker {
    f: u32,
    mesh: Mesh,
    /// Vertices by the bits of position and texture coordinates: octants share their edges.
    known: HashMap<[u32; 5], u32>,
}

impl Maker {
    fn octant(&mut self, signs: DVec3) {
        let f = self.f;
        // One or three mirrorings make a counter-clockwise triangle clockwise.
        let mirrored = signs.x * signs.y * signs.z < 0.0;
        for i in 0..f {
            for j in 0..f - i {
                let k = f - 1 - i - j;
                let up = [[i + 1, j, k], [i, j + 1, k], [i, j, k + 1]];
                self.triangle(up, signs, mirrored);
                if k > 0 {
                    let k = k - 1;
                    let down = [[i, j + 1, k + 1], [i + 1, j, k + 1], [i + 1, j + 1, k]];
                    self.triangle(down, signs, mirrored);
                }
            }
        }
    }

    fn triangle(&mut self, corners: [[u32; 3]; 3], signs: DVec3, mirrored: bool) {
        let [a, b, c] = corners.map(|corner| self.vertex(corner, signs));
        self.mesh.indices.extend(if mirrored { [a, c, b] } else { [a, b, c] });
    }

    fn vertex(&mut self, corner: [u32; 3], signs: DVec3) -> u32 {
        let sine = |n: u32| (FRAC_PI_2 * f64::from(n) / f64::from(self.f)).sin();
        let direction = DVec3::from(corner.map(sine)).normalize();
        // Adding 0 removes negative zeros: the octants' edges must be equal bit by bit.
        let position = (direction * signs).as_vec3().to_array().map(|v| v + 0.0);
        // From +z towards +x in the first octant; at the poles the middle of the octant.
        let at_pole = corner[0] == 0 && corner[2] == 0;
        let within = if at_pole { FRAC_PI_4 } else { direction.x.atan2(direction.z) };
        let ahead = if signs.z > 0.0 { within } else { PI - within };
        let longitude = ahead * signs.x;
        let latitude = direction.y.asin() * signs.y;
        let tex_coord = [(0.5 + longitude / TAU) as f32, (0.5 + latitude / PI) as f32];
        let [x, y, z] = position.map(f32::to_bits);
        let key = [x, y, z, tex_coord[0].to_bits(), tex_coord[1].to_bits()];
        let mesh = &mut self.mesh;
        *self.known.entry(key).or_insert_with(|| {
            mesh.positions.push(position);
            mesh.tex_coords.push(tex_coord);
            (mesh.positions.len() - 1) as u32
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::topology;
    use glam::Vec3;

    #[test]
    fn spheres_are_round_closed_and_counted() {
        for frequency in [1, 2, 3, 8, 23] {
            let mesh = sphere(frequency).unwrap();
            assert_eq!(mesh.triangle_count(), triangle_count(frequency));
            assert_eq!(mesh.positions.len(), mesh.tex_coords.len());
            for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
                // Three roundings to f32.
                assert!((Vec3::from(*p).length() - 1.0).abs() < 1e-6, "{p:?}");
                assert_eq!(p, n);
            }
            assert!(topology::is_closed_outward(&mesh), "frequency {frequency}");
            let used = mesh.indices.iter().map(|&i| i as usize).max();
            assert_eq!(used, Some(mesh.positions.len() - 1));
        }
    }

    /// Euler: V - E + F = 2 with E = 3/2 F, so V = F / 2 + 2 places.
    #[test]
    fn places_are_as_many_as_euler_says() {
        for frequency in [1, 4, 9] {
            let mesh = sphere(frequency).unwrap();
            let (_, places) = crate::weld::places(&mesh.positions);
            assert_eq!(places, mesh.triangle_count() / 2 + 2);
        }
    }

    /// No triangle reaches around the sphere in its texture: the meridian's vertices are double.
    #[test]
    fn textures_have_their_seam() {
        let mesh = sphere(6).unwrap();
        for t in 0..mesh.triangle_count() {
            let u = mesh.triangle(t).map(|v| mesh.tex_coords[v][0]);
            let spread = u.iter().fold(0.0_f32, |m, v| m.max(*v)) - u.iter().fold(1.0_f32, |m, v| m.min(*v));
            assert!(spread <= 0.25 + 1e-6, "triangle {t}: {u:?}");
        }
        let at = |p: [f32; 3]| mesh.positions.iter().position(|q| *q == p).map(|v| mesh.tex_coords[v]);
        assert_eq!(at([0.0, 0.0, 1.0]), Some([0.5, 0.5]));
        assert_eq!(at([1.0, 0.0, 0.0]), Some([0.75, 0.5]));
    }

    #[test]
    fn other_frequencies_are_refused() {
        assert_eq!(sphere(0), Err(InvalidFrequency(0)));
        let error = sphere(MOST_FREQUENCY + 1).unwrap_err().to_string();
        assert!(error.contains("129") && error.contains("131072"), "{error}");
        assert_eq!(sphere(MOST_FREQUENCY).unwrap().triangle_count(), 131_072);
    }

    #[test]
    fn the_nearest_count_is_found() {
        assert_eq!([0, 8, 20, 32, 4096, usize::MAX].map(nearest_frequency), [1, 1, 2, 2, 23, MOST_FREQUENCY]);
        assert!((1..=MOST_FREQUENCY).all(|f| nearest_frequency(triangle_count(f)) == f));
    }
}
