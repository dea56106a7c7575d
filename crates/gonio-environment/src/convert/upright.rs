//! Bilinear lookups from a panorama that is not turned to a cubemap. Faces share their places then:
//!
//! - On the four sides a column of texels looks along a meridian, so that it has one place across the panorama. How far
//!   down it looks is the same on all four, and follows from one arc tangent.
//! - A row of the upper face and its mirror image on the lower one look at the same longitudes, as far above the horizon
//!   as below it.

use super::lanes::{LANES, angle, arc_tangent, first_eight};
use super::lookup::{Bilinear, Cells, fill_rows, fill_rows_downwards, split};
use super::texel_source::PanoramaSource;
use crate::face::{Face, Layout};
use crate::panorama::place;
use crate::simd::{Kernel, SimdLevel};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, i32x8};
use gonio_image::Pixel;
use gonio_threads::prelude::*;
use std::f32::consts::PI;

/// Fills six faces of `size` texels, in the order of [`Face::ALL`].
pub(super) fn fill(level: SimdLevel, source: &PanoramaSource<'_>, size: usize, pixels: &mut [Pixel]) {
    let mut faces = pixels.chunks_exact_mut(size * size);
    let Some([pos_x, neg_x, pos_y, neg_y, pos_z, neg_z]) = next_six(&mut faces) else { return };
    let columns = SideColumns::new(size, source.width());
    let [pos_x, neg_x, pos_y, neg_y, pos_z, neg_z] =
        [pos_x, neg_x, pos_y, neg_y, pos_z, neg_z].map(|face| face.par_chunks_exact_mut(size));
    // Some rows at a time: one is too little work to hand to a thread.
    let sides = pos_x.zip(neg_x).zip(pos_z.zip(neg_z)).enumerate().with_min_len(8);
    sides.for_each(|(row, ((pos_x, neg_x), (pos_z, neg_z)))| {
        level.run(SideRows { source, columns: &columns, row, pixels: [pos_x, neg_x, pos_z, neg_z] });
    });
    let caps = pos_y.zip(neg_y.rev()).enumerate().with_min_len(8);
    caps.for_each(|(row, (upper, lower))| level.run(CapRows { source, row, pixels: [upper, lower] }));
}

fn next_six<T>(all: &mut impl Iterator<Item = T>) -> Option<[T; 6]> {
    let mut next = || all.next();
    Some([next()?, next()?, next()?, next()?, next()?, next()?])
}

/// The sides in the order of [`Face::ALL`].
const SIDES: [Face; 4] = [Face::PosX, Face::NegX, Face::PosZ, Face::NegZ];

/// The columns of the sides, eight at a time. The last eight repeat the last column where fewer are left.
struct SideColumns {
    /// The column of the panorama to the left of each place, for each side.
    left: [Vec<[i32; LANES]>; 4],
    /// The distance of each place from that column, in columns, for each side.
    right_share: [Vec<[f32; LANES]>; 4],
    /// One over the distance of the side from the vertical axis there, for a cube with half edge 1.
    nearness: Vec<[f32; LANES]>,
}

impl SideColumns {
    /// The columns for sides of `size` texels and a panorama `width` wide.
    fn new(size: usize, width: u32) -> Self {
        let blocks = size.div_ceil(LANES);
        let s = |i: usize| (2 * i.min(size - 1) + 1) as f64 / size as f64 - 1.0;
        let mut columns = SideColumns {
            left: [const { Vec::new() }; 4],
            right_share: [const { Vec::new() }; 4],
            nearness: Vec::with_capacity(blocks),
        };
        for block in 0..blocks {
            let s: [f64; LANES] = std::array::from_fn(|lane| s(block * LANES + lane));
            columns.nearness.push(s.map(|s| (1.0 / s.hypot(1.0)) as f32));
            for (side, face) in SIDES.into_iter().enumerate() {
                let across = s.map(|s| place(face.direction(s, 0.0, Layout::OpenGl)).0 * f64::from(width) - 0.5);
                columns.left[side].push(across.map(|x| x.floor() as i32));
                columns.right_share[side].push(across.map(|x| (x - x.floor()) as f32));
            }
        }
        columns
    }

    /// The cells of a block of eight columns of a side, in rows of the panorama that are known already.
    #[inline(always)]
    fn cells<S: Simd>(&self, side: usize, block: usize, top: i32x8<S>, lower_share: f32x8<S>) -> Cells<S> {
        let simd = top.simd;
        let left = i32x8::from_slice(simd, &self.left[side][block]);
        let right_share = f32x8::from_slice(simd, &self.right_share[side][block]);
        Cells { plane: i32x8::splat(simd, 0), left, top, right_share, lower_share }
    }
}

/// One row of each side.
struct SideRows<'a> {
    source: &'a PanoramaSource<'a>,
    columns: &'a SideColumns,
    row: usize,
    pixels: [&'a mut [Pixel]; 4],
}

impl Kernel for SideRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let SideRows { source, columns, row, pixels } = self;
        // Rows run downwards from t = -1 at the upper edge.
        let t = ((2 * row + 1) as f64 / pixels[0].len() as f64 - 1.0) as f32;
        // Three rows of the side: in its middle a row of texels is 2 / size high.
        let rows_ahead = (6.0 / PI * source.height() as f32 / pixels[0].len() as f32).ceil() as usize;
        fill_rows_downwards::<S, 2, Bilinear, 4>(
            simd,
            source,
            rows_ahead,
            pixels,
            #[inline(always)]
            |first| {
                let block = first / LANES;
                // At most 45 degrees up or down.
                let below = arc_tangent(f32x8::from_slice(simd, &columns.nearness[block]) * t);
                let (top, lower_share) = split(source.down(below));
                [
                    columns.cells(0, block, top, lower_share),
                    columns.cells(1, block, top, lower_share),
                    columns.cells(2, block, top, lower_share),
                    columns.cells(3, block, top, lower_share),
                ]
            },
        );
    }
}

/// A row of the upper face, and its mirror image on the lower one: as far from the bottom as the first from the top.
struct CapRows<'a> {
    source: &'a PanoramaSource<'a>,
    row: usize,
    pixels: [&'a mut [Pixel]; 2],
}

impl Kernel for CapRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let CapRows { source, row, pixels } = self;
        let step = 2.0 / pixels[0].len() as f32;
        // OpenGL's layout: in both rows x grows to the right, and z is t of the upper face.
        let z = f32x8::splat(simd, (row as f32 + 0.5) * step - 1.0);
        fill_rows::<S, 2, Bilinear, 2>(
            simd,
            source,
            pixels,
            #[inline(always)]
            |first| {
                let x = (first_eight(simd) + (first as f32 + 0.5)) * step - 1.0;
                let (left, right_share) = split(source.across(angle(x, -z)));
                let height = angle(f32x8::splat(simd, 1.0), (x * x + z * z).sqrt());
                let plane = i32x8::splat(simd, 0);
                let (top, lower_share) = split(source.down(-height));
                let above = Cells { plane, left, top, right_share, lower_share };
                let (top, lower_share) = split(source.down(height));
                [above, Cells { plane, left, top, right_share, lower_share }]
            },
        );
    }
}
