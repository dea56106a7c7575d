//! Looking up a source at many places.
//!
//! A lookup waits for memory far longer than it computes: neighbouring pixels of a target are often rows of texels
//! apart. So a row is filled in runs of a few blocks: the places of the next run are found, and their texels asked for,
//! before the texels of the present run are mixed.

use super::lanes::{Directions, LANES, first_eight, turned};
use super::output_grid::OutputGrid;
use super::texel_source::TexelSource;
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, i32x8};
use glam::Mat3;
use gonio_image::Pixel;

/// Eight places: the texel to the left of and above each, in a plane (a cubemap's face), and how far beyond it the
/// place is, in [0, 1).
#[derive(Clone, Copy)]
pub(super) struct Cells<S: Simd> {
    pub plane: i32x8<S>,
    pub left: i32x8<S>,
    pub top: i32x8<S>,
    pub right_share: f32x8<S>,
    pub lower_share: f32x8<S>,
}

/// A place in texels, from -1.5 on, as the texel before it and how far beyond that it is, in [0, 1).
#[inline(always)]
pub(super) fn split<S: Simd>(place: f32x8<S>) -> (i32x8<S>, f32x8<S>) {
    // With 4 added all are positive, so cutting off is rounding down.
    let shifted = place + 4.0;
    let whole: i32x8<S> = shifted.to_int();
    let share = shifted - whole.to_float::<f32x8<S>>();
    (whole - 4, share)
}

/// Eight lookups, ready to be made. Aligned so that no vector of them lies across two lines of the cache.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Block {
    /// The first texel of each window in the piece. Not set without one.
    first: [u32; LANES],
    /// The windows where they go over an edge: plane, column and row of the first texel. Not set with a piece.
    plane: [i32; LANES],
    left: [i32; LANES],
    top: [i32; LANES],
    right_share: [f32; LANES],
    lower_share: [f32; LANES],
    /// The piece of the source's memory that contains all windows; `None` if a window crosses an edge.
    piece: Option<u8>,
}

impl Block {
    const EMPTY: Block = Block {
        piece: None,
        first: [0; LANES],
        plane: [0; LANES],
        left: [0; LANES],
        top: [0; LANES],
        right_share: [0.0; LANES],
        lower_share: [0.0; LANES],
    };

    /// Sets the block to what `F` looks up in these cells.
    #[inline(always)]
    pub fn set<S: Simd, const N: usize, F: Mix<N>>(&mut self, source: &impl TexelSource, cells: Cells<S>) {
        let (left, top) = (cells.left - F::BEFORE, cells.top - F::BEFORE);
        cells.right_share.store_slice(&mut self.right_share);
        cells.lower_share.store_slice(&mut self.lower_share);
        match source.piece::<S, N>(cells.plane, left, top) {
            Some((piece, first)) => {
                self.piece = Some(piece);
                first.store_slice(&mut self.first);
            }
            None => {
                self.piece = None;
                cells.plane.store_slice(&mut self.plane);
                left.store_slice(&mut self.left);
                top.store_slice(&mut self.top);
            }
        }
    }

    /// A block of these cells.
    #[inline(always)]
    pub fn new<S: Simd, const N: usize, F: Mix<N>>(source: &impl TexelSource, cells: Cells<S>) -> Block {
        let mut block = Block::EMPTY;
        block.set::<S, N, F>(source, cells);
        block
    }

    /// Asks for the texels of all windows, so that they are in the cache when they are looked up.
    #[inline(always)]
    fn prefetch<const N: usize>(&self, source: &impl TexelSource) {
        let Some(piece) = self.piece else { return };
        let texels = source.texels(piece);
        if texels.len() < WORTH_PREFETCHING {
            return;
        }
        for first in self.first {
            for row in 0..N {
                prefetch(texels, first as usize + row * source.stride());
            }
        }
    }

    /// Asks for the texels that lie `rows` further down than these, if the windows are next to each other.
    #[inline(always)]
    fn prefetch_below(&self, source: &impl TexelSource, rows: usize) {
        let Some(piece) = self.piece else { return };
        let texels = source.texels(piece);
        // Four texels share a line of the cache.
        prefetch(texels, self.first[0] as usize + rows * source.stride());
        prefetch(texels, self.first[LANES / 2] as usize + rows * source.stride());
    }

    /// Makes the lookups: `found` gets each lane and its pixel.
    #[inline(always)]
    pub fn look_up<S: Simd, const N: usize, F: Mix<N>>(
        &self,
        simd: S,
        source: &impl TexelSource,
        mut found: impl FnMut(usize, f32x4<S>),
    ) {
        let stride = source.stride();
        match self.piece {
            Some(piece) => {
                let texels = source.texels(piece);
                for lane in 0..LANES {
                    let first = self.first[lane] as usize;
                    if let Some(window) = texels.get(first..first + (N - 1) * stride + N) {
                        let mixed = F::mix(simd, window, stride, self.right_share[lane], self.lower_share[lane]);
                        found(lane, mixed);
                    }
                }
            }
            None => {
                for lane in 0..LANES {
                    let window = source.window::<N>(self.plane[lane], self.left[lane], self.top[lane]);
                    let mixed = F::mix(simd, window.as_flattened(), N, self.right_share[lane], self.lower_share[lane]);
                    found(lane, mixed);
                }
            }
        }
    }
}

/// Sources with fewer texels stay in the caches of a core anyway.
const WORTH_PREFETCHING: usize = 1 << 15;

#[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse"))]
#[inline(always)]
fn prefetch(texels: &[Pixel], i: usize) {
    if let Some(texel) = texels.get(i) {
        safe_arch::prefetch_t0(texel);
    }
}

/// There is no safe way to ask for it here.
#[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse")))]
#[inline(always)]
fn prefetch(_: &[Pixel], _: usize) {}

/// Blocks in a run.
const RUN: usize = 8;

/// Fills `K` rows of one length from as many rows of places: `locate` gives the cells of eight columns from a first one
/// on, of each row.
#[inline(always)]
pub(super) fn fill_rows<S: Simd, const N: usize, F: Mix<N>, const K: usize>(
    simd: S,
    source: &impl TexelSource,
    mut rows: [&mut [Pixel]; K],
    locate: impl Fn(usize) -> [Cells<S>; K],
) {
    let columns = rows.iter().map(|row| row.len()).min().unwrap_or(0);
    let blocks = columns.div_ceil(LANES);
    let mut runs = [[[Block::EMPTY; K]; RUN]; 2];
    let [coming, present] = &mut runs;
    let (mut coming, mut present) = (coming, present);
    let mut located = 0;
    let mut done = 0;
    while done < blocks {
        let next = (located + RUN).min(blocks);
        for (block, coming) in (located..next).zip(coming.iter_mut()) {
            let cells = locate(block * LANES);
            for k in 0..K {
                coming[k].set::<S, N, F>(source, cells[k]);
                coming[k].prefetch::<N>(source);
            }
        }
        for (k, row) in rows.iter_mut().enumerate() {
            let pixels = row.chunks_mut(LANES).skip(done);
            for (pixels, block) in pixels.zip(&present[..located - done]) {
                fill_block(
                    pixels,
                    #[inline(always)]
                    |all| {
                        block[k].look_up::<S, N, F>(
                            simd,
                            source,
                            #[inline(always)]
                            |lane, value| all[lane] = value.into(),
                        );
                    },
                );
            }
        }
        done = located;
        located = next;
        std::mem::swap(&mut coming, &mut present);
    }
}

/// Fills `K` rows as [`fill_rows`] does, where the rows below them look `rows_ahead` rows further down in the source:
/// one prefetch loads a line of the cache for eight lookups, and long before it is used.
#[inline(always)]
pub(super) fn fill_rows_downwards<S: Simd, const N: usize, F: Mix<N>, const K: usize>(
    simd: S,
    source: &impl TexelSource,
    rows_ahead: usize,
    rows: [&mut [Pixel]; K],
    locate: impl Fn(usize) -> [Cells<S>; K],
) {
    let columns = rows.iter().map(|row| row.len()).min().unwrap_or(0);
    for first in (0..columns).step_by(LANES) {
        let cells = locate(first);
        let end = columns.min(first + LANES);
        for k in 0..K {
            let block = Block::new::<S, N, F>(source, cells[k]);
            block.prefetch_below(source, rows_ahead);
            fill_block(
                &mut rows[k][first..end],
                #[inline(always)]
                |all| {
                    block.look_up::<S, N, F>(
                        simd,
                        source,
                        #[inline(always)]
                        |lane, value| all[lane] = value.into(),
                    );
                },
            );
        }
    }
}

/// Fills up to eight pixels, the last ones of a row, from eight.
#[inline(always)]
pub(super) fn fill_block(pixels: &mut [Pixel], look_up: impl FnOnce(&mut [Pixel; LANES])) {
    match <&mut [Pixel; LANES]>::try_from(&mut *pixels) {
        Ok(all) => look_up(all),
        Err(_) => {
            let mut all = [[0.0; 4]; LANES];
            look_up(&mut all);
            pixels.copy_from_slice(&all[..pixels.len()]);
        }
    }
}

/// A filter over a window of `N` x `N` texels.
pub(super) trait Mix<const N: usize> {
    /// The number of columns and rows of the window before the texel to the left of and above a place.
    const BEFORE: i32;
    /// The offset that is added to places first.
    const SHIFT: f32;

    /// A pixel from a window whose rows begin `stride` texels apart.
    fn mix<S: Simd>(simd: S, window: &[Pixel], stride: usize, right_share: f32, lower_share: f32) -> f32x4<S>;
}

/// The nearest texel.
pub(super) struct Nearest;

impl Mix<1> for Nearest {
    const BEFORE: i32 = 0;
    const SHIFT: f32 = 0.5;

    #[inline(always)]
    fn mix<S: Simd>(simd: S, window: &[Pixel], _: usize, _: f32, _: f32) -> f32x4<S> {
        f32x4::from_slice(simd, &window[0])
    }
}

/// Between four texels: down first, both columns at once, then across.
pub(super) struct Bilinear;

impl Mix<2> for Bilinear {
    const BEFORE: i32 = 0;
    const SHIFT: f32 = 0.0;

    #[inline(always)]
    fn mix<S: Simd>(simd: S, window: &[Pixel], stride: usize, right_share: f32, lower_share: f32) -> f32x4<S> {
        let upper = f32x8::from_slice(simd, window[..2].as_flattened());
        let lower = f32x8::from_slice(simd, window[stride..stride + 2].as_flattened());
        let (left, right) = (upper + (lower - upper) * lower_share).split();
        left + (right - left) * right_share
    }
}

/// The spline through sixteen texels; what comes out negative is 0.
pub(super) struct Bicubic;

impl Mix<4> for Bicubic {
    const BEFORE: i32 = 1;
    const SHIFT: f32 = 0.0;

    #[inline(always)]
    fn mix<S: Simd>(simd: S, window: &[Pixel], stride: usize, right_share: f32, lower_share: f32) -> f32x4<S> {
        let (along, down) = (catmull_rom(right_share), catmull_rom(lower_share));
        let mut sum = f32x4::splat(simd, 0.0);
        for (row, high) in down.into_iter().enumerate() {
            let texels = &window[row * stride..row * stride + 4];
            let a = f32x4::from_slice(simd, &texels[0]);
            let b = f32x4::from_slice(simd, &texels[1]);
            let c = f32x4::from_slice(simd, &texels[2]);
            let d = f32x4::from_slice(simd, &texels[3]);
            sum += (a * along[0] + b * along[1] + c * along[2] + d * along[3]) * high;
        }
        sum.simd_gt(0.0).select(sum, f32x4::splat(simd, 0.0))
    }
}

/// The weights of four values in a row for a place between the second and the third: the cardinal spline of
/// E. Catmull and R. Rom, "A class of local interpolating splines", 1974.
#[inline(always)]
fn catmull_rom(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)]
}

/// Fills a row: each pixel is the mean of k x k bilinear lookups, spread evenly over it, where k is such that they are
/// no farther apart than the source's texels are there. Eight pixels together have the largest k of theirs.
#[inline(always)]
pub(super) fn fill_row_by_area<S: Simd>(
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

/// The most lookups along a side of a pixel, of which there are then a million.
pub const MOST_ALONG: usize = 1024;
