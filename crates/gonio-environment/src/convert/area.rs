//! The mean of all that a pixel covers.

use super::lanes::{Directions, LANES, first_eight, turned};
use super::lookup::{Bilinear, Block, Mix, fill_block};
use super::output_grid::OutputGrid;
use super::texel_source::TexelSource;
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8};
use glam::Mat3;
use gonio_image::Pixel;

/// Fills a row: each pixel is the mean of k x k bilinear lookups, spread evenly over it, where k is such that they are no
/// farther apart than the source's texels are there. Eight pixels together have the largest k of theirs.
#[inline(always)]
pub(super) fn fill_row<S: Simd>(
    simd: S,
    source: &impl TexelSource,
    target: &impl OutputGrid,
    row: usize,
    turn: Option<Mat3>,
    pixels: &mut [Pixel],
) {
    let line = target.row(row);
    for (block, pixels) in pixels.chunks_mut(LANES).enumerate() {
        let first = (block * LANES) as f32;
        let k = lookups_along(
            source,
            #[inline(always)]
            |right, down| turned(target.directions(&line, first + right, first_eight(simd), down), turn),
        );
        let step = 1.0 / k as f32;
        let place = |i: usize| (i as f32 + 0.5) * step - 0.5;
        let mut sums = [f32x4::splat(simd, 0.0); LANES];
        for j in 0..k {
            for i in 0..k {
                let directions = target.directions(&line, first + place(i), first_eight(simd), place(j));
                let cells = source.places(turned(directions, turn)).cells(Bilinear::SHIFT);
                let block = Block::new::<S, 2, Bilinear>(source, cells);
                block.look_up::<S, 2, Bilinear>(
                    simd,
                    source,
                    #[inline(always)]
                    |lane, value| sums[lane] += value,
                );
            }
        }
        fill_block(
            pixels,
            #[inline(always)]
            |all| {
                for (pixel, sum) in all.iter_mut().zip(sums) {
                    *pixel = (sum * (step * step)).into();
                }
            },
        );
    }
}

/// `k`: from the distances between the edges of the pixels, and of the source's texels in their middles.
#[inline(always)]
fn lookups_along<S: Simd>(source: &impl TexelSource, at: impl Fn(f32, f32) -> Directions<S>) -> usize {
    let wide = distance(unit(at(-0.5, 0.0)), unit(at(0.5, 0.0)));
    let high = distance(unit(at(0.0, -0.5)), unit(at(0.0, 0.5)));
    let k: [f32; LANES] = (wide.max(high) / source.spacing(unit(at(0.0, 0.0)))).into();
    let most = k.into_iter().fold(1.0, f32::max);
    // A place between two numbers of lookups is not worth the larger one for rounding alone.
    ((most - 1e-3).ceil() as usize).clamp(1, MOST_ALONG)
}

#[inline(always)]
fn distance<S: Simd>(a: Directions<S>, b: Directions<S>) -> f32x8<S> {
    length([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
}

#[inline(always)]
fn length<S: Simd>([x, y, z]: Directions<S>) -> f32x8<S> {
    (x * x + y * y + z * z).sqrt()
}

#[inline(always)]
fn unit<S: Simd>([x, y, z]: Directions<S>) -> Directions<S> {
    let scale = f32x8::splat(x.simd, 1.0) / length([x, y, z]);
    [x * scale, y * scale, z * scale]
}

/// More than that along a pixel are not made: a million lookups.
pub const MOST_ALONG: usize = 1024;
