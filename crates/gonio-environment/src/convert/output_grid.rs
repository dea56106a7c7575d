//! The outputs of a conversion: the directions of their pixels, row by row.

use super::lanes::{Directions, sin_cos};
use crate::face::{Face, Layout};
use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use std::f64::consts::PI;

/// A picture to be filled, row by row.
pub(super) trait OutputGrid: Sync {
    /// The values that all pixels of a row share.
    type Row: Copy;

    /// Pixels in a row.
    fn row_length(&self) -> usize;

    /// Returns the height of a pixel in the middle, in radians.
    fn pixel_angle(&self) -> f64;

    /// The size of the faces of a cubemap; `None` for a panorama.
    fn sides(&self) -> Option<usize> {
        None
    }

    /// A row; those of a cubemap continue from face to face.
    fn row(&self, row: usize) -> Self::Row;

    /// The directions, of any length, of eight places in a row: at the columns `first` + `across`, where 0 is the
    /// middle of the first pixel, and `down` pixels below the row's middle.
    fn directions<S: Simd>(&self, row: &Self::Row, first: f32, across: f32x8<S>, down: f32) -> Directions<S>;
}

/// The six faces of a cubemap, OpenGL's layout.
pub(super) struct CubeGrid {
    size: usize,
    /// The width of a texel, where the face is from -1 to 1.
    step: f32,
}

/// A row of a face.
#[derive(Clone, Copy)]
pub(super) struct CubeRow {
    middle: [f32; 3],
    along_s: [f32; 3],
    along_t: [f32; 3],
    t: f32,
}

impl CubeGrid {
    pub fn new(size: u32) -> Self {
        CubeGrid { size: size as usize, step: 2.0 / size as f32 }
    }
}

impl OutputGrid for CubeGrid {
    type Row = CubeRow;

    fn row_length(&self) -> usize {
        self.size
    }

    fn pixel_angle(&self) -> f64 {
        2.0 / self.size as f64
    }

    fn sides(&self) -> Option<usize> {
        Some(self.size)
    }

    fn row(&self, row: usize) -> CubeRow {
        let face = Face::ALL[(row / self.size).min(5)];
        let axis = |d: glam::DVec3| d.as_vec3().to_array();
        CubeRow {
            middle: axis(face.direction(0.0, 0.0, Layout::OpenGl)),
            along_s: axis(face.along_s()),
            along_t: axis(face.along_t()),
            t: (row % self.size) as f32,
        }
    }

    #[inline(always)]
    fn directions<S: Simd>(&self, row: &CubeRow, first: f32, across: f32x8<S>, down: f32) -> Directions<S> {
        let s = (across + (first + 0.5)) * self.step - 1.0;
        let t = (row.t + down + 0.5) * self.step - 1.0;
        let component = |i: usize| s * row.along_s[i] + (row.middle[i] + t * row.along_t[i]);
        [component(0), component(1), component(2)]
    }
}

/// An equirectangular picture.
pub(super) struct PanoramaGrid {
    width: usize,
    height: usize,
}

impl PanoramaGrid {
    pub fn new(width: u32, height: u32) -> Self {
        PanoramaGrid { width: width as usize, height: height as usize }
    }
}

/// A row of a panorama.
#[derive(Clone, Copy)]
pub(super) struct PanoramaRow {
    /// The distance from the top, in rows.
    row: f32,
    /// The sine and the cosine of the angle between the row's middle and the upper pole.
    polar: [f32; 2],
}

impl PanoramaGrid {
    /// The sine and the cosine of the angle from the upper pole, `rows` below the top.
    fn polar(&self, rows: f32) -> [f32; 2] {
        let (sin, cos) = (f64::from(rows) * PI / self.height as f64).sin_cos();
        [sin as f32, cos as f32]
    }
}

impl OutputGrid for PanoramaGrid {
    type Row = PanoramaRow;

    fn row_length(&self) -> usize {
        self.width
    }

    fn pixel_angle(&self) -> f64 {
        PI / self.height as f64
    }

    fn row(&self, row: usize) -> PanoramaRow {
        let row = row as f32;
        PanoramaRow { row, polar: self.polar(row + 0.5) }
    }

    #[inline(always)]
    fn directions<S: Simd>(&self, row: &PanoramaRow, first: f32, across: f32x8<S>, down: f32) -> Directions<S> {
        // From the middle column: angles near 0 keep their digits where most pictures have their motif.
        let from_middle = across + (first + 0.5 - 0.5 * self.width as f32);
        let (sin_lon, cos_lon) = sin_cos(from_middle * (2.0 * PI / self.width as f64) as f32);
        let [sin_polar, cos_polar] = if down == 0.0 { row.polar } else { self.polar(row.row + down + 0.5) };
        [sin_lon * sin_polar, f32x8::splat(across.simd, cos_polar), -cos_lon * sin_polar]
    }
}
