//! Differences of two pictures, as numbers and as a map in colours.
//!
//! `gonio diff` and the application report the same numbers, because both use this module.

/// Black, violet, red, orange, yellow, white, in 8-bit steps, at equal distances and interpolated linearly. The larger
/// the difference, the brighter: it is readable without colour vision.
pub const HEAT: [[f64; 3]; 7] = [
    [0.0, 0.0, 0.0],
    [48.0, 10.0, 92.0],
    [125.0, 24.0, 110.0],
    [196.0, 52.0, 72.0],
    [240.0, 112.0, 32.0],
    [250.0, 194.0, 44.0],
    [255.0, 255.0, 235.0],
];

/// The colour of a share in [0, 1] of the full scale, sRGB; shares beyond count as the nearer end.
pub fn heat(share: f64) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (HEAT.len() - 1) as f64;
    let low = (place as usize).min(HEAT.len() - 2);
    let t = place - low as f64;
    [0, 1, 2].map(|c| (HEAT[low][c] * (1.0 - t) + HEAT[low + 1][c] * t).round() as u8)
}

/// The colour of a signed share in [-1, 1]: blue where the first is brighter, grey where both are equal, orange where
/// the second is. sRGB.
pub fn signed(share: f64) -> [u8; 3] {
    let share = share.clamp(-1.0, 1.0);
    let end = if share < 0.0 { SIGNED[0] } else { SIGNED[2] };
    let t = share.abs();
    [0, 1, 2].map(|c| (SIGNED[1][c] * (1.0 - t) + end[c] * t).round() as u8)
}

/// The ends and the middle of [`signed`]'s scale, 8-bit steps.
pub const SIGNED: [[f64; 3]; 3] = [[58.0, 150.0, 255.0], [30.0, 30.0, 34.0], [255.0, 150.0, 40.0]];

/// Mean, root of the mean square, largest: over all pixels and channels.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Spread {
    /// Mean of the absolute differences.
    pub mean: f64,
    /// Root of the mean of the squares.
    pub rms: f64,
    /// The largest.
    pub max: f64,
}

/// Whether a value is at most its limit, up to rounding (1e-12, relative): 102 / 255 - 100 / 255 is not exactly two
/// steps.
pub fn within(value: f64, limit: f64) -> bool {
    value <= limit * (1.0 + 1e-12)
}

/// Statistics of the differences of encoded values, in 8-bit steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DifferenceStatistics {
    sum: f64,
    squares: f64,
    max: f64,
    worst: usize,
    values: u64,
    differing: u64,
}

impl DifferenceStatistics {
    /// Adds a pixel, whose number is `index`: encoded values from 0 to 1. It counts as differing where a value differs
    /// by more than `tolerance` steps.
    pub fn add(&mut self, index: usize, a: &[f64], b: &[f64], tolerance: f64) {
        let mut largest = 0.0f64;
        for (a, b) in a.iter().zip(b) {
            let step = 255.0 * (a - b).abs();
            self.sum += step;
            self.squares += step * step;
            self.values += 1;
            largest = largest.max(step);
        }
        if largest > self.max {
            (self.max, self.worst) = (largest, index);
        }
        if !within(largest, tolerance) {
            self.differing += 1;
        }
    }

    /// The statistics of this part of a picture and the next one.
    pub fn with(self, next: DifferenceStatistics) -> DifferenceStatistics {
        DifferenceStatistics {
            sum: self.sum + next.sum,
            squares: self.squares + next.squares,
            max: self.max.max(next.max),
            worst: if next.max > self.max { next.worst } else { self.worst },
            values: self.values + next.values,
            differing: self.differing + next.differing,
        }
    }

    /// Mean, RMS and largest, 8-bit steps; 0 of no pixels.
    pub fn spread(&self) -> Spread {
        let values = self.values.max(1) as f64;
        Spread { mean: self.sum / values, rms: (self.squares / values).sqrt(), max: self.max }
    }

    /// The number of the pixel that differs most, the first of them; `None` where none differs.
    pub fn worst(&self) -> Option<usize> {
        (self.max > 0.0).then_some(self.worst)
    }

    /// The number of pixels that differ by more than the tolerance.
    pub fn differing(&self) -> u64 {
        self.differing
    }

    /// The ratio of the largest possible square to the mean of the squares, decibels; `None` where nothing differs.
    pub fn psnr_db(&self) -> Option<f64> {
        let rms = self.spread().rms;
        (rms > 0.0).then(|| 20.0 * (255.0 / rms).log10())
    }
}

/// Compares pictures of four bytes per pixel by their colours, as displayed; the longer one is cut off.
pub fn of_bytes(a: &[u8], b: &[u8], tolerance: f64) -> DifferenceStatistics {
    let mut tally = DifferenceStatistics::default();
    let scaled = |p: &[u8]| [p[0], p[1], p[2]].map(|v| f64::from(v) / 255.0);
    for (index, (a, b)) in a.chunks_exact(4).zip(b.chunks_exact(4)).enumerate() {
        tally.add(index, &scaled(a), &scaled(b), tolerance);
    }
    tally
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_grows_brighter_from_black_to_nearly_white() {
        assert_eq!(heat(0.0), [0, 0, 0]);
        assert_eq!(heat(1.0), [255, 255, 235]);
        assert_eq!(heat(7.0), heat(1.0));
        let luma = |s: f64| {
            let [r, g, b] = heat(s).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((0..100).all(|i| luma(f64::from(i + 1) / 100.0) > luma(f64::from(i) / 100.0)));
    }

    #[test]
    fn signs_have_colours_of_their_own() {
        assert_eq!([-1.0, 0.0, 1.0].map(signed), [[58, 150, 255], [30, 30, 34], [255, 150, 40]]);
        assert_eq!(signed(-9.0), signed(-1.0));
    }

    /// Two pixels: 3, 0, 0 and 0, 4, 0 steps apart.
    #[test]
    fn numbers_are_those_of_paper() {
        let a = [10, 20, 30, 255, 40, 50, 60, 255];
        let b = [13, 20, 30, 255, 40, 46, 60, 255];
        let tally = of_bytes(&a, &b, 3.0);
        let spread = tally.spread();
        // Rounding of 1/255.
        assert!((spread.mean - 7.0 / 6.0).abs() < 1e-9);
        assert!((spread.rms - (25.0_f64 / 6.0).sqrt()).abs() < 1e-9);
        assert!((spread.max - 4.0).abs() < 1e-9);
        assert_eq!((tally.worst(), tally.differing()), (Some(1), 1));
        let psnr = tally.psnr_db().unwrap_or_default();
        assert!((psnr - 20.0 * (255.0 / (25.0_f64 / 6.0).sqrt()).log10()).abs() < 1e-9);
        let halves =
            of_bytes(&a[..4], &b[..4], 3.0).with(DifferenceStatistics { worst: 1, ..of_bytes(&a[4..], &b[4..], 3.0) });
        assert_eq!(halves, tally);
        assert_eq!(of_bytes(&a, &a, 0.0).psnr_db(), None);
        assert_eq!(of_bytes(&a, &a, 0.0).worst(), None);
    }
}
