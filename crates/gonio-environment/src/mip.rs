//! Mip levels of a cubemap.

use crate::Cubemap;
use crate::face::Face;
use crate::face::SolidAngles;
use glam::DVec3;
use gonio_image::Pixel;
use gonio_image::encode::Encoded;
use gonio_image::encode::ktx2::{self, Ktx2Format, Level};
use gonio_threads::prelude::*;

/// A cubemap and its mip levels.
#[derive(Clone, Debug, PartialEq)]
pub struct CubeMips {
    /// The full one first; each next has half the size, rounded down, and the last is 1. Never empty.
    levels: Vec<Cubemap>,
}

impl CubeMips {
    /// Computes the levels. Each texel is the mean of those that it covers, weighted by solid angle: no light is lost. If a
    /// size is odd, a texel that two others cover is shared between them.
    pub fn new(map: Cubemap) -> Self {
        let mut levels = vec![map];
        while let Some(last) = levels.last().filter(|l| l.size() > 1) {
            levels.push(halved(last));
        }
        CubeMips { levels }
    }

    /// Takes levels made in another way, the largest first; an empty list becomes one black texel.
    pub fn from_levels(mut levels: Vec<Cubemap>) -> Self {
        if levels.is_empty() {
            levels.push(Cubemap::new(1, [0.0, 0.0, 0.0, 1.0]));
        }
        CubeMips { levels }
    }

    /// Returns the levels, the full one first. Never empty.
    pub fn levels(&self) -> &[Cubemap] {
        &self.levels
    }

    /// Returns the full cubemap.
    pub fn full(&self) -> &Cubemap {
        &self.levels[0]
    }

    /// Encodes all levels as KTX2.
    pub fn to_ktx2(&self, format: Ktx2Format) -> Encoded {
        let levels: Vec<Level<'_>> =
            self.levels.iter().filter_map(|map| Level::new(map.size(), map.pixels())).collect();
        ktx2::encode(&levels, format)
    }

    /// Returns the linear radiance from a direction: bilinear in the two levels about `level`, and linear between them, as
    /// `textureLod` does. Levels beyond the ends count as the ends; NaN counts as 0.
    pub fn sample(&self, direction: DVec3, level: f64) -> DVec3 {
        let last = self.levels.len() - 1;
        let level = if level > 0.0 { level.min(last as f64) } else { 0.0 };
        let (below, share) = (level as usize, level.fract());
        let fine = self.levels[below].sample(direction);
        if share == 0.0 { fine } else { fine.lerp(self.levels[(below + 1).min(last)].sample(direction), share) }
    }
}

fn halved(map: &Cubemap) -> Cubemap {
    let (from, to) = (map.size(), map.size() / 2);
    let mut half = Cubemap::new(to, [0.0; 4]);
    // Which columns (or rows) a column of the half covers, and how much of each, in columns of the full one.
    let covered: Vec<Vec<(u32, f64)>> = (0..to)
        .map(|i| {
            let scale = f64::from(from) / f64::from(to);
            let (first, end) = (f64::from(i) * scale, f64::from(i + 1) * scale);
            (first as u32..(end.ceil() as u32).min(from))
                .map(|c| (c, end.min(f64::from(c) + 1.0) - first.max(f64::from(c))))
                .filter(|(_, share)| *share > 1e-9)
                .collect()
        })
        .collect();
    let angles = SolidAngles::new(from);
    let (width, full_width) = (to as usize, from as usize);
    half.pixels_mut().par_chunks_exact_mut(width).enumerate().for_each(|(index, pixels)| {
        let (face, y) = (map.face(Face::ALL[index / width]), index % width);
        // Sums of a row's texels, and of their weights: the rows that it covers are added one after the other.
        let mut sums = vec![([0.0_f64; 4], 0.0_f64); width];
        for &(row, high) in &covered[y] {
            let texels = &face[row as usize * full_width..][..full_width];
            let weights = angles.row(row as usize);
            if from.is_multiple_of(2) {
                add_pairs(&mut sums, texels, weights);
            } else {
                let weights: Vec<f64> = weights.collect();
                for ((sum, weight), columns) in sums.iter_mut().zip(&covered) {
                    for &(column, wide) in columns {
                        let w = wide * high * weights[column as usize];
                        add(sum, w, texels[column as usize]);
                        *weight += w;
                    }
                }
            }
        }
        for (pixel, (sum, weight)) in pixels.iter_mut().zip(sums) {
            *pixel = sum.map(|s| (s / weight) as f32);
        }
    });
    half
}

/// Adds pairs of columns, each with its full weight.
fn add_pairs(sums: &mut [([f64; 4], f64)], texels: &[Pixel], weights: impl Iterator<Item = f64>) {
    let mut weights = weights;
    for ((sum, weight), pair) in sums.iter_mut().zip(texels.chunks_exact(2)) {
        for (texel, w) in pair.iter().zip(weights.by_ref()) {
            add(sum, w, *texel);
            *weight += w;
        }
    }
}

fn add(sum: &mut [f64; 4], weight: f64, texel: Pixel) {
    for (s, t) in sum.iter_mut().zip(texel) {
        *s += weight * f64::from(t);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_light_is_lost_on_the_way_down() {
        for size in [16, 13] {
            let mips =
                CubeMips::new(Cubemap::from_function(size, |d| DVec3::new(1.0 + d.x, 2.0 + d.y * d.z, d.z * d.z)));
            let sizes: Vec<u32> = mips.levels().iter().map(Cubemap::size).collect();
            assert_eq!(sizes, if size == 16 { vec![16, 8, 4, 2, 1] } else { vec![13, 6, 3, 1] });
            let full = mips.full().mean_radiance();
            for level in mips.levels() {
                let mean = level.mean_radiance();
                // Of odd sizes the texels' shares are those of their columns, not exactly of their solid angles.
                let tolerance = if size == 16 { 1e-6 } else { 0.02 };
                assert!(mean.abs_diff_eq(full, tolerance), "{size} -> {}: {mean} is not {full}", level.size());
            }
        }
    }

    #[test]
    fn texels_are_means_by_solid_angle() {
        for size in [12_u32, 13] {
            let map = Cubemap::from_function(size, |d| DVec3::new(1.0 + d.x, 2.0 + d.y * d.z, (3.0 * d.z).exp()));
            let mips = CubeMips::new(map.clone());
            let half = &mips.levels()[1];
            let scale = f64::from(size) / f64::from(half.size());
            for face in Face::ALL {
                for i in 0..half.size() * half.size() {
                    let (x, y) = (i % half.size(), i / half.size());
                    // Every texel of the full one, by how much of it lies under this one.
                    let share = |at: u32, full: u32| {
                        let (first, end) = (f64::from(at) * scale, f64::from(at + 1) * scale);
                        (end.min(f64::from(full) + 1.0) - first.max(f64::from(full))).max(0.0)
                    };
                    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
                    for j in 0..size * size {
                        let (column, row) = (j % size, j / size);
                        let weight = share(x, column) * share(y, row) * crate::cubemap::solid_angle(column, row, size);
                        sum += weight * crate::panorama::color(map.at(face, column, row));
                        weights += weight;
                    }
                    let got = crate::panorama::color(half.at(face, x, y));
                    // Stored as f32, up to 20.
                    assert!(
                        got.abs_diff_eq(sum / weights, 2e-6),
                        "{size} {face:?} {x} {y}: {got} is not {}",
                        sum / weights
                    );
                }
            }
        }
    }

    #[test]
    fn between_levels_is_linear() {
        let mips = CubeMips::new(Cubemap::from_function(8, |d| DVec3::splat(1.0) + d * d));
        let d = DVec3::new(0.3, -0.5, 0.9);
        let at = |level| mips.sample(d, level);
        assert!(at(1.25).abs_diff_eq(at(1.0).lerp(at(2.0), 0.25), 1e-12));
        assert_eq!((at(-1.0), at(f64::NAN), at(9.0)), (at(0.0), at(0.0), at(3.0)));
    }
}
