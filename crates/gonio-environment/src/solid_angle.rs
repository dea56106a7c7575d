//! A table of the solid angles of a face's texels.

use rayon::prelude::*;

/// The solid angle in steradians that a texel covers, seen from the cube's middle; all of a cubemap are `4 pi`.
pub fn solid_angle(x: u32, y: u32, size: u32) -> f64 {
    // Of the rectangle from the face's middle to (s, t): its corners' areas are added and subtracted.
    let corner = |s: f64, t: f64| (s * t).atan2((s * s + t * t + 1.0).sqrt());
    let edge = |v: u32| 2.0 * f64::from(v) / f64::from(size) - 1.0;
    let (s0, s1, t0, t1) = (edge(x), edge(x + 1), edge(y), edge(y + 1));
    corner(s0, t0) - corner(s0, t1) - corner(s1, t0) + corner(s1, t1)
}

/// [`solid_angle`] of every texel of a face, in steradians: a quarter of them, of which the others are mirror images.
///
/// An arc tangent per texel is expensive; a table of a quarter of one face serves all six.
#[derive(Clone, Debug)]
pub(crate) struct SolidAngles {
    size: usize,
    /// Columns (and rows) of the quarter: half of the size, rounded up.
    half: usize,
    /// `half * half`, rows from the top.
    quarter: Vec<f64>,
}

impl SolidAngles {
    /// Computes the table for faces of `size` texels an edge.
    pub fn new(size: u32) -> Self {
        let half = size.div_ceil(2);
        let row = |y: u32| (0..half).map(move |x| solid_angle(x, y, size));
        let quarter = (0..half).into_par_iter().flat_map_iter(row).collect();
        SolidAngles { size: size as usize, half: half as usize, quarter }
    }

    /// Returns the solid angles of row `y`, from the left.
    pub fn row(&self, y: usize) -> impl Iterator<Item = f64> + Clone + '_ {
        let held = y.min(self.size - 1 - y);
        let left = &self.quarter[held * self.half..][..self.half];
        left.iter().chain(left[..self.size - self.half].iter().rev()).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_texel_has_its_own() {
        for size in [1, 2, 5, 8] {
            let table = SolidAngles::new(size);
            for y in 0..size {
                let row: Vec<f64> = table.row(y as usize).collect();
                assert_eq!(row.len(), size as usize);
                for (x, got) in row.into_iter().enumerate() {
                    // The mirror image rounds differently in the last place.
                    assert!((got - solid_angle(x as u32, y, size)).abs() < 1e-15, "{size}: {x} {y}");
                }
            }
        }
    }
}
