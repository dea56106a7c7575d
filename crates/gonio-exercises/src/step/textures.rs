//! The textures of previews on the CPU: the sky as a cubemap, and white.

use glam::Vec3;
use gonio_check::testbench::{CUBEMAP_UNIT, SKY_SIDE, WHITE_UNIT, sky_faces};
use gonio_environment::{Face, Layout};
use gonio_interpreter::{TextureLookup, TextureSource};

/// The textures of the units that samplers are set to; other units are empty, which is black.
pub(super) struct PreviewTextures {
    sky: [Vec<[f32; 4]>; 6],
}

impl PreviewTextures {
    pub fn new() -> Self {
        Self { sky: sky_faces() }
    }

    /// Linear filtering within a face, whose edges are repeated.
    fn sky(&self, direction: Vec3) -> [f32; 4] {
        let (face, [s, t]) = face(direction);
        let last = SKY_SIDE - 1;
        let along = |x: f32| {
            let place = (x * SKY_SIDE as f32 - 0.5).clamp(0.0, last as f32);
            (place as usize, (place as usize + 1).min(last), place.fract())
        };
        let ((left, right, across), (top, bottom, down)) = (along(s), along(t));
        let texel = |x: usize, y: usize| self.sky[face].get(y * SKY_SIDE + x).copied().unwrap_or([0.0; 4]);
        let mix = |a: [f32; 4], b: [f32; 4], t: f32| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t);
        mix(
            mix(texel(left, top), texel(right, top), across),
            mix(texel(left, bottom), texel(right, bottom), across),
            down,
        )
    }
}

/// The number of the face that a direction meets and the coordinates in it, 0 to 1; NaN for a direction that meets none.
fn face(direction: Vec3) -> (usize, [f32; 2]) {
    let found = Face::from_direction(direction.as_dvec3(), Layout::OpenGl);
    let share = |place: f64| ((place + 1.0) * 0.5) as f32;
    found.map_or((0, [f32::NAN; 2]), |(face, s, t)| (face as usize, [share(s), share(t)]))
}

impl TextureSource for PreviewTextures {
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4] {
        let [x, y, z, _] = lookup.coordinates;
        match lookup.sampler {
            CUBEMAP_UNIT => self.sky(Vec3::new(x, y, z)),
            WHITE_UNIT => [1.0; 4],
            _ => [0.0, 0.0, 0.0, 1.0],
        }
    }

    fn size(&self, sampler: u32, _level: i32) -> [u32; 3] {
        match sampler {
            CUBEMAP_UNIT => [SKY_SIDE as u32, SKY_SIDE as u32, 1],
            WHITE_UNIT => [1; 3],
            _ => [0; 3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_check::testbench::radiance;

    #[test]
    fn the_sky_is_the_smooth_function_that_its_texels_sample() {
        let textures = PreviewTextures::new();
        for i in 0..500 {
            let i = i as f32;
            let direction = Vec3::new((i * 0.7).sin(), (i * 1.3).cos(), (i * 2.1).sin());
            let (found, expected) = (textures.sky(direction), radiance(direction));
            for channel in 0..3 {
                // At edges of faces, the last texel is repeated over half a texel: 0.07 of a radian times the slope.
                assert!((found[channel] - expected[channel]).abs() < 0.05, "{direction}: {found:?}, {expected:?}");
            }
        }
    }
}
