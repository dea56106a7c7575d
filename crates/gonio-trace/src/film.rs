//! The sums of a picture's samples, and the error that they leave.

use glam::DVec3;
use gonio_light::color::luminance;
use gonio_scene::Picture;

/// Sums of all samples of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    pub(crate) pixels: Vec<PixelSums>,
}

/// The sums of one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PixelSums {
    /// Linear RGB.
    pub light: DVec3,
    pub alpha: f64,
    /// Linear RGB of the samples in one half: see [`PixelSums::is_in_half`].
    pub half: DVec3,
    /// Second and fourth powers of the luminance.
    pub squares: f64,
    pub fourths: f64,
    /// Third powers.
    pub cubes: f64,
    pub samples: u32,
    /// Samples that were not finite, and so count as black.
    pub lost: u32,
}

/// Edge of the squares that [`Film::unfinished`] looks at, pixels.
pub const TILE: u32 = 16;

/// The error of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Root of the mean square error of a pixel's luminance, relative to the picture's mean luminance.
    pub relative: f64,
    /// The bound that the true value stays below with a probability of 95 %, as far as the samples tell.
    pub upper: f64,
}

impl PixelSums {
    pub(crate) fn add(&mut self, light: DVec3, alpha: f64) {
        let is_in_half = Self::is_in_half(self.samples);
        self.samples += 1;
        if !light.is_finite() {
            self.lost += 1;
            return;
        }
        let y = luminance(light);
        self.light += light;
        if is_in_half {
            self.half += light;
        }
        self.alpha += alpha;
        self.squares += y * y;
        self.cubes += y * y * y;
        self.fourths += y * y * y * y;
    }

    /// Whether a sample belongs to the first of two halves with independent noise. A half is made of runs of eight samples,
    /// each of them stratified; every second sample, say, would be all samples in the left half of the pixel.
    fn is_in_half(sample: u32) -> bool {
        sample & 8 == 0
    }

    /// The means of both halves, and their shares of the samples; none where one is empty.
    pub(crate) fn halves(&self) -> Option<[(DVec3, f64); 2]> {
        let n = self.samples;
        let first = n / 16 * 8 + (n % 16).min(8);
        let second = n - first;
        let mean = |sum: DVec3, count: u32| (sum / f64::from(count), f64::from(count) / f64::from(n));
        (first > 0 && second > 0).then(|| [mean(self.half, first), mean(self.light - self.half, second)])
    }

    /// The variance of the mean, and the variance of that estimate; 0 with fewer than two samples.
    pub(crate) fn variance(&self) -> (f64, f64) {
        let n = f64::from(self.samples);
        if self.samples < 2 {
            return (0.0, 0.0);
        }
        let mean = luminance(self.light) / n;
        let second = (self.squares / n - mean * mean).max(0.0);
        let fourth =
            self.fourths / n - 4.0 * mean * self.cubes / n + 6.0 * mean * mean * self.squares / n - 3.0 * mean.powi(4);
        let variance = second * n / (n - 1.0);
        // The variance of a sample variance (E. Cho and M. J. Cho, *Variance of Sample Variance*, 2008).
        let of_variance = (fourth.max(second * second) - second * second * (n - 3.0) / (n - 1.0)).max(0.0) / n;
        (variance / n, of_variance / (n * n))
    }
}

impl Film {
    /// No samples yet.
    pub fn new(width: u32, height: u32) -> Self {
        Film { width, height, pixels: vec![PixelSums::default(); width as usize * height as usize] }
    }

    /// The means of the samples: linear, premultiplied, nothing clamped.
    pub fn picture(&self) -> Picture {
        let pixel = |p: &PixelSums| {
            let scale = 1.0 / f64::from(p.samples.max(1));
            (p.light * scale).extend(p.alpha * scale).as_vec4().to_array()
        };
        Picture { width: self.width, height: self.height, pixels: self.pixels.iter().map(pixel).collect() }
    }

    /// The variance of each pixel's mean luminance, estimated from its samples; 0 with fewer than two. The points of a pixel
    /// are stratified, so this is more than the true one in the mean.
    pub fn variance(&self) -> Vec<f64> {
        self.pixels.iter().map(|p| p.variance().0).collect()
    }

    /// The error of the picture: infinite with fewer than two samples, 0 for a black picture.
    pub fn error(&self) -> ErrorEstimate {
        if self.pixels.iter().any(|p| p.samples < 2) {
            return ErrorEstimate { relative: f64::INFINITY, upper: f64::INFINITY };
        }
        self.error_of(self.pixels.iter(), self.mean_luminance())
    }

    fn error_of<'p>(&self, pixels: impl Iterator<Item = &'p PixelSums>, mean: f64) -> ErrorEstimate {
        let (mut sum, mut of_sum, mut count) = (0.0, 0.0, 0.0);
        for (variance, of_variance) in pixels.map(PixelSums::variance) {
            sum += variance;
            of_sum += of_variance;
            count += 1.0;
        }
        let relative = |variance: f64| if mean > 0.0 { (variance / f64::max(count, 1.0)).sqrt() / mean } else { 0.0 };
        // 1.645 standard deviations: one-sided, 95 %.
        ErrorEstimate { relative: relative(sum), upper: relative(sum + 1.645 * of_sum.sqrt()) }
    }

    fn mean_luminance(&self) -> f64 {
        let sum: f64 = self.pixels.iter().map(|p| luminance(p.light) / f64::from(p.samples.max(1))).sum();
        sum / self.pixels.len().max(1) as f64
    }

    /// The tiles whose own error exceeds `error`, relative to the picture's mean luminance: where more samples are worth most.
    /// All tiles, if every one is below but the bound of the whole picture is not.
    pub fn unfinished(&self, error: f64) -> TileMask {
        let mean = self.mean_luminance();
        let columns = self.width.div_ceil(TILE).max(1);
        let rows = self.height.div_ceil(TILE).max(1);
        let tile = |index: u32| {
            let (left, top) = (index % columns * TILE, index / columns * TILE);
            let pixels = (top..(top + TILE).min(self.height))
                .flat_map(move |y| (left..(left + TILE).min(self.width)).map(move |x| (y * self.width + x) as usize));
            let estimate = self.error_of(pixels.map(|i| &self.pixels[i]), mean);
            estimate.upper.is_nan() || estimate.upper > error
        };
        let mut tiles: Vec<bool> = (0..columns * rows).map(tile).collect();
        if tiles.iter().all(|unfinished| !unfinished) && self.error().upper > error {
            tiles.fill(true);
        }
        TileMask { columns, tiles }
    }

    /// Samples of all pixels together.
    pub fn total_samples(&self) -> u64 {
        self.pixels.iter().map(|p| u64::from(p.samples)).sum()
    }

    /// The fewest samples of any pixel.
    pub fn least_samples(&self) -> u32 {
        self.pixels.iter().map(|p| p.samples).min().unwrap_or(0)
    }

    /// The most samples of any pixel.
    pub fn most_samples(&self) -> u32 {
        self.pixels.iter().map(|p| p.samples).max().unwrap_or(0)
    }

    /// Samples that count as black because they were not finite numbers.
    pub fn lost_samples(&self) -> u64 {
        self.pixels.iter().map(|p| u64::from(p.lost)).sum()
    }
}

/// A choice of tiles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TileMask {
    columns: u32,
    tiles: Vec<bool>,
}

impl TileMask {
    /// Whether the tile of a pixel is chosen.
    pub fn contains(&self, x: u32, y: u32) -> bool {
        self.tiles.get((y / TILE * self.columns + x / TILE) as usize).copied().unwrap_or(false)
    }

    /// Pixels of the chosen tiles, as if each were complete.
    pub fn pixels(&self) -> u32 {
        self.tiles.iter().filter(|&&chosen| chosen).count() as u32 * TILE * TILE
    }

    /// No tile is chosen.
    pub fn is_empty(&self) -> bool {
        !self.tiles.contains(&true)
    }
}

/// A checkpoint that cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointError {
    /// It is no checkpoint, or of another version of the format.
    Format,
    /// It belongs to another scene or other settings.
    Fingerprint,
    /// It ends too early or goes on too long.
    Length,
}

const MAGIC: &[u8; 8] = b"gonioTR2";
const PIXEL_BYTES: usize = 10 * 8 + 2 * 4;

impl Film {
    /// All sums, bit for bit. `fingerprint` identifies scene and settings.
    pub fn to_checkpoint(&self, fingerprint: u64) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(24 + self.pixels.len() * PIXEL_BYTES);
        bytes.extend(MAGIC);
        bytes.extend(fingerprint.to_le_bytes());
        bytes.extend(self.width.to_le_bytes());
        bytes.extend(self.height.to_le_bytes());
        for p in &self.pixels {
            let sums = [p.alpha, p.squares, p.cubes, p.fourths];
            p.light
                .to_array()
                .iter()
                .chain(&p.half.to_array())
                .chain(&sums)
                .for_each(|v| bytes.extend(v.to_le_bytes()));
            bytes.extend(p.samples.to_le_bytes());
            bytes.extend(p.lost.to_le_bytes());
        }
        bytes
    }

    /// The film of a checkpoint of `width` x `height` pixels with this fingerprint.
    pub fn from_checkpoint(bytes: &[u8], fingerprint: u64, width: u32, height: u32) -> Result<Self, CheckpointError> {
        let (head, body) = bytes.split_at_checked(24).ok_or(CheckpointError::Format)?;
        if &head[..8] != MAGIC {
            return Err(CheckpointError::Format);
        }
        let expected = [&fingerprint.to_le_bytes()[..], &width.to_le_bytes(), &height.to_le_bytes()].concat();
        if head[8..] != expected {
            return Err(CheckpointError::Fingerprint);
        }
        if body.len() != width as usize * height as usize * PIXEL_BYTES {
            return Err(CheckpointError::Length);
        }
        let pixel = |bytes: &[u8; PIXEL_BYTES]| {
            let sum = |i: usize| f64::from_le_bytes(std::array::from_fn(|k| bytes[8 * i + k]));
            let count = |i: usize| u32::from_le_bytes(std::array::from_fn(|k| bytes[80 + 4 * i + k]));
            PixelSums {
                light: DVec3::new(sum(0), sum(1), sum(2)),
                half: DVec3::new(sum(3), sum(4), sum(5)),
                alpha: sum(6),
                squares: sum(7),
                cubes: sum(8),
                fourths: sum(9),
                samples: count(0),
                lost: count(1),
            }
        };
        Ok(Film { width, height, pixels: body.as_chunks::<PIXEL_BYTES>().0.iter().map(pixel).collect() })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn film() -> Film {
        let mut film = Film::new(40, 20);
        for (i, p) in film.pixels.iter_mut().enumerate() {
            for k in 0..64_u32 {
                // Uniform in [0, 2) on the left, constant on the right.
                let v = if i % 40 < 16 { f64::from(k) / 32.0 } else { 1.0 };
                p.add(DVec3::splat(v), 1.0);
            }
        }
        film
    }

    #[test]
    fn the_error_is_that_of_the_samples() {
        let film = film();
        // Variance of uniform numbers of width 2: 1/3, over 64 samples, in 16 of 40 columns; the mean is 1.
        let expected = (1.0 / 3.0 / 64.0 * 0.4_f64).sqrt();
        let error = film.error();
        // The 64 values are evenly spaced, not continuous.
        assert!((error.relative / expected - 1.0).abs() < 0.02, "{} instead of {expected}", error.relative);
        // 320 pixels of 64 samples tell the variance to about half a percent.
        assert!(error.upper > error.relative && error.upper < 1.02 * error.relative, "{error:?}");
        assert_eq!(Film::new(2, 2).error().upper, f64::INFINITY);
    }

    #[test]
    fn halves_have_every_sample_once() {
        let mut sums = PixelSums::default();
        for k in 0..24 {
            assert_eq!(sums.halves().is_some(), k > 8, "{k} samples");
            sums.add(DVec3::splat(if (8..16).contains(&k) { 3.0 } else { f64::from(k < 8) }), 1.0);
        }
        // 0 to 7 and 16 to 23; 8 to 15.
        let [(first, share), (second, rest)] = sums.halves().unwrap();
        assert_eq!((first.x, share, second.x, rest), (0.5, 16.0 / 24.0, 3.0, 8.0 / 24.0));
    }

    #[test]
    fn unfinished_tiles_are_those_with_noise() {
        let film = film();
        let mask = film.unfinished(0.05);
        assert_eq!(mask.pixels(), 2 * TILE * TILE);
        assert!(mask.contains(0, 0) && mask.contains(15, 19) && !mask.contains(16, 0) && !mask.contains(39, 19));
        assert!(film.unfinished(0.5).is_empty());
    }

    #[test]
    fn checkpoints_keep_every_bit() {
        let mut film = film();
        assert_ne!(film.pixels[0].half, film.pixels[0].light);
        film.pixels[3].add(DVec3::new(f64::NAN, 0.1, 0.2), 1.0);
        assert_eq!(film.lost_samples(), 1);
        let bytes = film.to_checkpoint(77);
        assert_eq!(Film::from_checkpoint(&bytes, 77, 40, 20).as_ref(), Ok(&film));
        assert_eq!(Film::from_checkpoint(&bytes, 78, 40, 20), Err(CheckpointError::Fingerprint));
        assert_eq!(Film::from_checkpoint(&bytes, 77, 20, 40), Err(CheckpointError::Fingerprint));
        assert_eq!(Film::from_checkpoint(&bytes[..bytes.len() - 1], 77, 40, 20), Err(CheckpointError::Length));
        for length in 0..40 {
            assert!(Film::from_checkpoint(&bytes[..length], 77, 40, 20).is_err());
        }
        assert_eq!(Film::from_checkpoint(&[0; 100], 77, 40, 20), Err(CheckpointError::Format));
    }
}
