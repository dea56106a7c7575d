//! The environment of the test scenes with mirrors and skies: a smooth function of the direction.

use glam::Vec3;
use gonio_environment::{Face, Layout};

/// Side length of a face in texels.
pub const SKY_SIDE: usize = 32;

/// Returns the light from a direction, linear RGB, each between 0.05 and 0.95. It is smooth and has no symmetry, so
/// that each direction looks different.
pub fn radiance(direction: Vec3) -> [f32; 3] {
    let d = direction.normalize();
    let wave = |frequency: Vec3, phase: f32| 0.5 + 0.45 * (d.dot(frequency) + phase).sin();
    [wave(Vec3::new(1.9, 0.7, 0.4), 0.3), wave(Vec3::new(-0.5, 2.1, 0.8), 1.1), wave(Vec3::new(0.6, -0.9, 2.3), -0.7)]
}

/// Returns the six faces in OpenGL's layout, rows from t = 0.
pub fn sky_faces() -> [Vec<[f32; 4]>; 6] {
    Face::ALL.map(|face| {
        let texel = |index: usize| {
            let along = |i: usize| (i as f64 + 0.5) / SKY_SIDE as f64 * 2.0 - 1.0;
            let direction = face.direction(along(index % SKY_SIDE), along(index / SKY_SIDE), Layout::OpenGl);
            let [r, g, b] = radiance(direction.as_vec3());
            [r, g, b, 1.0]
        };
        (0..SKY_SIDE * SKY_SIDE).map(texel).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_environment_has_no_symmetry() {
        let directions: Vec<Vec3> = (0..200)
            .map(|i| Vec3::new((i as f32 * 0.7).sin(), (i as f32 * 1.3).cos(), (i as f32 * 2.1).sin()))
            .collect();
        let axes = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        for axes in axes {
            for signs in 0..8_u32 {
                let sign = |bit: usize| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 };
                if axes == [0, 1, 2] && signs == 0 {
                    continue;
                }
                let moved = |d: &Vec3| Vec3::new(d[axes[0]] * sign(0), d[axes[1]] * sign(1), d[axes[2]] * sign(2));
                let worst = directions
                    .iter()
                    .flat_map(|d| (0..3).map(|c| (radiance(*d)[c] - radiance(moved(d))[c]).abs()))
                    .fold(0.0, f32::max);
                assert!(worst > 0.3, "{axes:?} {signs}: {worst}");
            }
        }
    }
}
