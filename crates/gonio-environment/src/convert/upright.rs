//! From a panorama that is not turned to the four sides of a cubemap: there a column of texels looks along a meridian, so
//! that it has one place across the panorama, and its height follows from one arc tangent.

use super::lanes::{LANES, arc_tangent, fill_block};
use super::source::{PanoramaSource, Places};
use crate::face::{Face, Layout};
use crate::image::Pixel;
use crate::panorama::place;
use std::f32::consts::PI;
use wide::f32x8;

/// The columns of one side face.
pub(super) struct SideColumns {
    /// Where each looks across the panorama, in texels from the middle of the first one.
    x: Vec<f32>,
    /// One over the distance of the face from the vertical axis there, for a cube with half edge 1.
    nearness: Vec<f32>,
}

/// Whether a face is a side: its rows run downwards everywhere.
pub(super) fn is_side(face: Face) -> bool {
    !matches!(face, Face::PosY | Face::NegY)
}

impl SideColumns {
    /// Of a side face of `size` texels, in a panorama `width` wide. The rest of a last block of eight repeats its last
    /// column.
    pub fn new(face: Face, size: usize, width: u32) -> Self {
        let column = |i: usize| {
            let s = (2 * i.min(size - 1) + 1) as f64 / size as f64 - 1.0;
            let (u, _) = place(face.direction(s, 0.0, Layout::OpenGl));
            ((u * f64::from(width) - 0.5) as f32, (1.0 / s.hypot(1.0)) as f32)
        };
        let (x, nearness) = (0..size.next_multiple_of(LANES)).map(column).unzip();
        SideColumns { x, nearness }
    }

    /// Fills a row of the face with what `look_up` finds at eight places at a time.
    #[inline(always)]
    pub fn fill_row(
        &self,
        source: &PanoramaSource<'_>,
        row: usize,
        pixels: &mut [Pixel],
        look_up: impl Fn(Places, &mut [Pixel; LANES]),
    ) {
        let height = source.height() as f32;
        // Rows run downwards from t = -1 at the upper edge.
        let t = ((2 * row + 1) as f64 / pixels.len() as f64 - 1.0) as f32;
        let (columns, nearness) = (self.x.chunks_exact(LANES), self.nearness.chunks_exact(LANES));
        for ((pixels, x), nearness) in pixels.chunks_mut(LANES).zip(columns).zip(nearness) {
            let lanes = |v: &[f32]| f32x8::from(<[f32; LANES]>::try_from(v).unwrap_or([0.0; LANES]));
            // At most 45 degrees up or down.
            let below = arc_tangent(lanes(nearness) * t);
            let places = Places::on_one_plane(lanes(x), below * (height / PI) + (0.5 * height - 0.5));
            fill_block(pixels, |all| look_up(places, all));
        }
    }
}
