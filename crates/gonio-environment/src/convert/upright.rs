//! Bilinear lookups from a panorama that is not turned to a cubemap. Faces share their places then:
//!
//! - On the four sides a column of texels looks along a meridian, so that it has one place across the panorama. How far
//!   down it looks is the same on all four, and follows from one arc tangent.
//! - A row of the upper face and its mirror image on the lower one look at the same longitudes, as far above the horizon
//!   as below it.

use super::lanes::{LANES, angle, arc_tangent, first_eight};
use super::lookup::{Bilinear, Cells, fill_rows, split};
use super::source::PanoramaSource;
use crate::face::{Face, Layout};
use crate::image::Pixel;
use crate::panorama::place;
use crate::simd::{Kernel, SimdLevel};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, i32x8};
use rayon::prelude::*;

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
    /// Of each side the column of the panorama to the left of where each looks.
    left: [Vec<[i32; LANES]>; 4],
    /// Of each side how far beyond that column each looks, in columns.
    right_share: [Vec<[f32; LANES]>; 4],
    /// One over the distance of the side from the vertical axis there, for a cube with half edge 1.
    nearness: Vec<[f32; LANES]>,
}

impl SideColumns {
    /// Of sides of `size` texels, in a panorama `width` wide.
    fn new(size: usize, width: u32) -> Self {
        let blocks = size.div_ceil(LANES);
        let s = |i: usize| (2 * i.min(size - 1) + 1) as f64 / size as f64 - 1.0;
        let across = |face: Face, i: usize| {
            let (u, _) = place(face.direction(s(i), 0.0, Layout::OpenGl));
            u * f64::from(width) - 0.5
        };
        // A share that f32 rounds up to 1 is still a place in this cell, its right edge.
        let share = |face: Face, i: usize| (across(face, i) - across(face, i).floor()) as f32;
        let eight = |block: usize| std::array::from_fn::<usize, LANES, _>(|lane| block * LANES + lane);
        SideColumns {
            left: SIDES.map(|face| (0..blocks).map(|b| eight(b).map(|i| across(face, i).floor() as i32)).collect()),
            right_share: SIDES.map(|face| (0..blocks).map(|b| eight(b).map(|i| share(face, i))).collect()),
            nearness: (0..blocks).map(|b| eight(b).map(|i| (1.0 / s(i).hypot(1.0)) as f32)).collect(),
        }
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
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let SideRows { source, columns, row, pixels } = self;
        // Rows run downwards from t = -1 at the upper edge.
        let t = ((2 * row + 1) as f64 / pixels[0].len() as f64 - 1.0) as f32;
        fill_rows::<S, 2, Bilinear, 4>(
            simd,
            source,
            pixels,
            #[inline(always)]
            |first| {
                let block = first / LANES;
                // At most 45 degrees up or down.
                let below = arc_tangent(f32x8::from_slice(simd, &columns.nearness[block]) * t);
                let (top, lower_share) = split(source.down(below));
                let plane = i32x8::splat(simd, 0);
                [0, 1, 2, 3].map(
                    #[inline(always)]
                    |side| {
                        let left = i32x8::from_slice(simd, &columns.left[side][block]);
                        let right_share = f32x8::from_slice(simd, &columns.right_share[side][block]);
                        Cells { plane, left, top, right_share, lower_share }
                    },
                )
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
                [-height, height].map(
                    #[inline(always)]
                    |below| {
                        let (top, lower_share) = split(source.down(below));
                        Cells { plane, left, top, right_share, lower_share }
                    },
                )
            },
        );
    }
}
