//! The numbers of a comparison.

use super::read::Pixels;
use crate::error::CliError;
use gonio_image::flip::{self, PIXELS_PER_DEGREE};
use gonio_light::color::srgb_decode;
use gonio_scene::difference::DifferenceStatistics;
pub use gonio_scene::difference::{Spread, within};
use image_compare::Algorithm;
use rayon::prelude::*;
use serde::Serialize;

/// All numbers of a comparison.
#[derive(Clone, Debug, Serialize)]
pub struct PictureDifference {
    pub width: u32,
    pub height: u32,
    pub pixels: u64,
    /// 3, or 4 if alpha counts.
    pub channels: usize,
    /// Differences of encoded values, times 255.
    pub steps: Spread,
    /// Differences of linear light.
    pub linear: Spread,
    /// The largest `|a - b| / max(1, |a|, |b|)` of linear light.
    pub linear_absolute_or_relative: f64,
    /// The tolerance in 8-bit steps.
    pub tolerance: f64,
    /// Pixels with a channel that differs by more than the tolerance.
    pub differing_pixels: u64,
    /// Their share of all pixels.
    pub differing_percent: f64,
    /// Structural similarity (Wang et al. 2004) in windows of 8x8 pixels, the least of R, G and B; 1 for equal pictures.
    pub ssim: f64,
    /// How different they look (FLIP, Andersson et al. 2020), the mean of all pixels, over black; 0 for equal pictures, 1 at most.
    pub flip: f64,
    /// The pixel with `steps.max`, if that is not 0.
    pub worst: Option<Worst>,
    /// Pixels that are NaN or infinite in only one picture. They count as differing and are in none of the sums.
    pub not_finite: u64,
}

/// The pixel with the largest difference. Colours are displayed ones, `#rrggbb`.
#[derive(Clone, Debug, Serialize)]
pub struct Worst {
    pub x: u32,
    pub y: u32,
    pub a: String,
    pub b: String,
}

/// The sums of one row.
#[derive(Clone, Copy, Default)]
struct Row {
    steps: DifferenceStatistics,
    linear_sum: f64,
    linear_squares: f64,
    linear_max: f64,
    relative_max: f64,
    not_finite: u64,
}

/// Compares pictures of the same size.
pub fn measure(a: &Pixels, b: &Pixels, tolerance: f64) -> Result<PictureDifference, CliError> {
    let channels = if a.has_alpha() || b.has_alpha() { 4 } else { 3 };
    let width = a.width as usize;
    let rows: Vec<Row> = (0..a.height as usize)
        .into_par_iter()
        .map(|y| {
            let mut row = Row::default();
            (y * width..(y + 1) * width).for_each(|i| row.add(a, b, i, channels, tolerance));
            row
        })
        .collect();
    // In the order of the rows, so that the sums do not depend on the threads.
    let total = rows.into_iter().fold(Row::default(), Row::with);
    let pixels = a.len() as u64;
    let values = ((pixels - total.not_finite) * channels as u64).max(1) as f64;
    let hex = |p: [u8; 3]| format!("#{:02x}{:02x}{:02x}", p[0], p[1], p[2]);
    let worst = total.steps.worst().map(|index| Worst {
        x: (index % width) as u32,
        y: (index / width) as u32,
        a: hex(a.displayed(index)),
        b: hex(b.displayed(index)),
    });
    let differing = total.steps.differing() + total.not_finite;
    Ok(PictureDifference {
        width: a.width,
        height: a.height,
        pixels,
        channels,
        steps: total.steps.spread(),
        linear: Spread {
            mean: total.linear_sum / values,
            rms: (total.linear_squares / values).sqrt(),
            max: total.linear_max,
        },
        linear_absolute_or_relative: total.relative_max,
        tolerance,
        differing_pixels: differing,
        differing_percent: 100.0 * differing as f64 / pixels.max(1) as f64,
        ssim: ssim(a, b)?,
        flip: flip(a, b),
        worst,
        not_finite: total.not_finite,
    })
}

impl Row {
    fn add(&mut self, a: &Pixels, b: &Pixels, i: usize, channels: usize, tolerance: f64) {
        let (la, lb) = (a.linear(i), b.linear(i));
        let finite = |p: &[f64; 4]| p.iter().all(|v| v.is_finite());
        if !finite(&la) || !finite(&lb) {
            let same = |(x, y): (&f64, &f64)| x == y || (x.is_nan() && y.is_nan());
            if !la.iter().zip(&lb).all(same) {
                self.not_finite += 1;
            }
            return;
        }
        let (ea, eb) = (a.encoded(i), b.encoded(i));
        self.steps.add(i, &ea[..channels], &eb[..channels], tolerance);
        for c in 0..channels {
            let linear = (la[c] - lb[c]).abs();
            self.linear_sum += linear;
            self.linear_squares += linear * linear;
            self.linear_max = self.linear_max.max(linear);
            self.relative_max = self.relative_max.max(linear / la[c].abs().max(lb[c].abs()).max(1.0));
        }
    }

    fn with(self, next: Row) -> Row {
        Row {
            steps: self.steps.with(next.steps),
            linear_sum: self.linear_sum + next.linear_sum,
            linear_squares: self.linear_squares + next.linear_squares,
            linear_max: self.linear_max.max(next.linear_max),
            relative_max: self.relative_max.max(next.relative_max),
            not_finite: self.not_finite + next.not_finite,
        }
    }
}

fn flip(a: &Pixels, b: &Pixels) -> f64 {
    let displayed = |p: &Pixels| -> Vec<[f32; 3]> {
        (0..p.len()).map(|i| [0, 1, 2].map(|c| srgb_decode(p.encoded(i)[c]) as f32)).collect()
    };
    flip::mean(&flip::flip(a.width as usize, &displayed(a), &displayed(b), PIXELS_PER_DEGREE))
}

fn ssim(a: &Pixels, b: &Pixels) -> Result<f64, CliError> {
    let image = |p: &Pixels| {
        let bytes = (0..p.len()).flat_map(|i| p.displayed(i)).collect();
        image::RgbImage::from_raw(p.width, p.height, bytes)
    };
    let failed = || CliError::new("the structural similarity could not be computed");
    let (a, b) = (image(a).ok_or_else(failed)?, image(b).ok_or_else(failed)?);
    image_compare::rgb_similarity_structure(&Algorithm::MSSIMSimple, &a, &b).map(|s| s.score).map_err(|_| failed())
}
