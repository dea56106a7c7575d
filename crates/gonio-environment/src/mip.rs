//! Smaller and smaller copies of a cubemap.

use crate::Cubemap;
use crate::cubemap::solid_angle;
use crate::face::Face;
use glam::DVec3;

/// A cubemap and smaller copies of it: what a GPU calls its mip levels.
#[derive(Clone, Debug, PartialEq)]
pub struct CubeMips {
    /// The full one first; each next has half the size, rounded down, and the last is 1. Never empty.
    levels: Vec<Cubemap>,
}

impl CubeMips {
    /// Each texel of a level is the mean of those that it covers, by the solid angle of each: no light is lost. Where a
    /// size is odd, texels that lie in two are shared out.
    pub fn new(map: Cubemap) -> Self {
        let mut levels = vec![map];
        while let Some(last) = levels.last().filter(|l| l.size() > 1) {
            levels.push(halved(last));
        }
        CubeMips { levels }
    }

    /// Levels that were made some other way, the largest first; an empty list becomes one black texel.
    pub fn from_levels(mut levels: Vec<Cubemap>) -> Self {
        if levels.is_empty() {
            levels.push(Cubemap::new(1, [0.0, 0.0, 0.0, 1.0]));
        }
        CubeMips { levels }
    }

    /// The full one first. Never empty.
    pub fn levels(&self) -> &[Cubemap] {
        &self.levels
    }

    /// The full cubemap.
    pub fn full(&self) -> &Cubemap {
        &self.levels[0]
    }

    /// Linear radiance from a direction: bilinear in the two levels about `level`, and linear between them, as
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
    for face in Face::ALL {
        let pixels = half.face_mut(face);
        for y in 0..to {
            for x in 0..to {
                let (mut sum, mut weight) = ([0.0; 4], 0.0);
                for &(row, high) in &covered[y as usize] {
                    for &(column, wide) in &covered[x as usize] {
                        let w = wide * high * solid_angle(column, row, from);
                        let texel = map.at(face, column, row);
                        for (s, t) in sum.iter_mut().zip(texel) {
                            *s += w * f64::from(t);
                        }
                        weight += w;
                    }
                }
                pixels[(y * to + x) as usize] = sum.map(|s| (s / weight) as f32);
            }
        }
    }
    half
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
    fn between_levels_is_linear() {
        let mips = CubeMips::new(Cubemap::from_function(8, |d| DVec3::splat(1.0) + d * d));
        let d = DVec3::new(0.3, -0.5, 0.9);
        let at = |level| mips.sample(d, level);
        assert!(at(1.25).abs_diff_eq(at(1.0).lerp(at(2.0), 0.25), 1e-12));
        assert_eq!((at(-1.0), at(f64::NAN), at(9.0)), (at(0.0), at(0.0), at(3.0)));
    }
}
