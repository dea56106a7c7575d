//! Cubemaps with a margin of their neighbours' texels, for very many lookups.

use crate::Cubemap;
use crate::face::Face;
use glam::{Vec3A, Vec4};

/// A cubemap whose faces have a margin of one texel, so that a bilinear lookup never crosses an edge. The result is
/// that of [`Cubemap::sample`], in `f32`.
pub(crate) struct Padded {
    size: f32,
    /// Texels from row to row: the size and two.
    stride: usize,
    /// Texels from face to face.
    area: usize,
    pixels: Vec<Vec4>,
}

impl Padded {
    pub fn new(map: &Cubemap) -> Self {
        let size = i64::from(map.size());
        let stride = map.size() as usize + 2;
        let mut pixels = Vec::with_capacity(6 * stride * stride);
        for face in Face::ALL {
            let beyond = |x: i64, y: i64| map.texel(face, x, y).as_vec3().extend(1.0);
            pixels.extend((-1..=size).map(|x| beyond(x, -1)));
            for (y, row) in (0..size).zip(map.face(face).chunks_exact(size as usize)) {
                pixels.push(beyond(-1, y));
                pixels.extend(row.iter().map(|p| Vec4::from_array(*p)));
                pixels.push(beyond(size, y));
            }
            pixels.extend((-1..=size).map(|x| beyond(x, size)));
        }
        Padded { size: size as f32, stride, area: stride * stride, pixels }
    }

    /// Looks up trilinearly between the levels about `level`, which is within them.
    pub fn sample(levels: &[Padded], direction: Vec3A, level: f32) -> Vec4 {
        let place = place(direction);
        let fine = level as usize;
        let near = levels[fine].bilinear(place);
        match levels.get(fine + 1) {
            Some(far) if level > fine as f32 => near.lerp(far.bilinear(place), level - fine as f32),
            _ => near,
        }
    }

    fn bilinear(&self, (face, s, t): (usize, f32, f32)) -> Vec4 {
        // In the padded face, whose first texel's middle is 0; never negative.
        let (x, y) = (0.5 * (s + 1.0) * self.size + 0.5, 0.5 * (t + 1.0) * self.size + 0.5);
        let (left, top) = (x as usize, y as usize);
        let (right_share, lower_share) = (x - left as f32, y - top as f32);
        let at = face * self.area + top * self.stride + left;
        let texels = &self.pixels[at..at + self.stride + 2];
        let upper = texels[0] + right_share * (texels[1] - texels[0]);
        let [.., left, right] = texels else { return upper };
        let lower = left + right_share * (right - left);
        upper + lower_share * (lower - upper)
    }
}

/// The face's index in [`Face::ALL`] and the place on it from -1 to 1: [`Face::from_direction`] in OpenGL's layout, in `f32`.
fn place(d: Vec3A) -> (usize, f32, f32) {
    let size = d.abs();
    let (face, s, t, largest) = if size.x >= size.y && size.x >= size.z {
        if d.x > 0.0 { (0, -d.z, -d.y, size.x) } else { (1, d.z, -d.y, size.x) }
    } else if size.y >= size.z {
        if d.y > 0.0 { (2, d.x, d.z, size.y) } else { (3, d.x, -d.z, size.y) }
    } else if d.z > 0.0 {
        (4, d.x, -d.y, size.z)
    } else {
        (5, -d.x, -d.y, size.z)
    };
    (face, s / largest, t / largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CubeMips, Layout};
    use glam::DVec3;

    #[test]
    fn lookups_are_those_of_the_cubemap() {
        let map = Cubemap::from_function(16, |d| DVec3::new(1.5 + d.x, 1.5 + d.y * d.z, 1.5 + d.z));
        let mips = CubeMips::new(map);
        let padded: Vec<Padded> = mips.levels().iter().map(Padded::new).collect();
        for i in 0..3000 {
            // All over the sphere, and often exactly on edges and corners.
            let at = |k: u32| f64::from((i * k) % 17) / 8.0 - 1.0;
            let d = DVec3::new(at(1), at(5), at(11));
            let Some((face, s, t)) = Face::from_direction(d, Layout::OpenGl) else { continue };
            let (there, there_s, there_t) = place(d.as_vec3a());
            assert_eq!(there, face as usize, "{d}");
            assert!((f64::from(there_s) - s).abs() < 1e-6 && (f64::from(there_t) - t).abs() < 1e-6, "{d}");
            let level = f64::from(i % 9) / 2.0;
            let got = Padded::sample(&padded, d.as_vec3a(), level as f32).truncate().as_dvec3();
            // f32 along the way.
            assert!(got.abs_diff_eq(mips.sample(d, level), 3e-6), "{d} {level}: {got}");
        }
    }
}
