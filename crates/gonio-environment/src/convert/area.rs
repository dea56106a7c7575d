//! The mean of all that a pixel covers.

use super::lanes::{Directions, FIRST_EIGHT, LANES, turned};
use super::source::Source;
use super::target::Target;
use crate::image::Pixel;
use glam::Mat3;
use wide::{f32x4, f32x8};

/// Fills a row: each pixel is the mean of k x k bilinear lookups, spread evenly over it, where k is such that they are no
/// farther apart than the source's texels are there. Eight pixels together have the largest k of theirs.
pub(super) fn fill_row(
    source: &impl Source,
    target: &impl Target,
    row: usize,
    turn: Option<Mat3>,
    pixels: &mut [Pixel],
) {
    let line = target.row(row);
    for (block, pixels) in pixels.chunks_mut(LANES).enumerate() {
        let first = (block * LANES) as f32;
        let at = |right: f32, down: f32| turned(target.directions(&line, first + right, FIRST_EIGHT, down), turn);
        let k = lookups_along(source, at);
        let step = 1.0 / k as f32;
        let place = |i: usize| (i as f32 + 0.5) * step - 0.5;
        let mut sums = [f32x4::ZERO; LANES];
        for j in 0..k {
            for i in 0..k {
                source.bilinear(source.places(at(place(i), place(j))), |lane, value| sums[lane] += value);
            }
        }
        let mean = sums.map(|sum| (sum * (step * step)).to_array());
        pixels.copy_from_slice(&mean[..pixels.len()]);
    }
}

/// `k`: from the distances between the edges of the pixels, and of the source's texels in their middles.
fn lookups_along(source: &impl Source, at: impl Fn(f32, f32) -> Directions) -> usize {
    let distance = |a: Directions, b: Directions| {
        let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        length(d)
    };
    let wide = distance(unit(at(-0.5, 0.0)), unit(at(0.5, 0.0)));
    let high = distance(unit(at(0.0, -0.5)), unit(at(0.0, 0.5)));
    let k = wide.max(high) / source.spacing(unit(at(0.0, 0.0)));
    let most = k.to_array().into_iter().fold(1.0, f32::max);
    // A place between two numbers of lookups is not worth the larger one for rounding alone.
    ((most - 1e-3).ceil() as usize).clamp(1, MOST_ALONG)
}

#[inline(always)]
fn length([x, y, z]: Directions) -> f32x8 {
    (x * x + y * y + z * z).sqrt()
}

#[inline(always)]
fn unit(d: Directions) -> Directions {
    let scale = f32x8::ONE / length(d);
    d.map(|c| c * scale)
}

/// More than that along a pixel are not made: a million lookups.
pub const MOST_ALONG: usize = 1024;
