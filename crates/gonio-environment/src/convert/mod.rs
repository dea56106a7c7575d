//! From panoramas to cubemaps, back, and from each to its like: any size and rotation, without seams.
//!
//! For each pixel of the target its direction, turned into the source, is looked up there; eight pixels at a time, rows
//! shared out among all threads, with the fastest instructions that the CPU has ([`crate::simd`]). The result depends
//! neither on the number of threads nor on the instructions.
//!
//! | filter | a target pixel is |
//! |---|---|
//! | [`Filter::Nearest`] | the source's nearest texel |
//! | [`Filter::Bilinear`] | interpolated between the four about its middle |
//! | [`Filter::Bicubic`] | by Catmull and Rom's spline through sixteen; what comes out negative is 0 |
//! | [`Filter::Area`] | the mean of all that it covers: k x k bilinear lookups, no farther apart than texels are |
//!
//! Neighbouring texels are those on the sphere: across the edges of a cubemap's faces, across the +-180 degree meridian
//! of a panorama, and over its poles. Where lookups would be farther apart than a panorama's texels, near its poles, the
//! area filter takes them from rows that were averaged along themselves as far as the texels crowd there.

mod lanes;
mod lookup;
mod output_grid;
mod texel_source;
mod upright;

use crate::simd::{Kernel, SimdLevel};
use crate::{Cubemap, Panorama};
use fearless_simd::Simd;
use glam::{DMat3, DVec3, Mat3};
use gonio_image::{Image, Pixel};
use gonio_light::named_enum;
use gonio_threads::prelude::*;
pub use lanes::ARC_TANGENT;
use lanes::{first_eight, turned};
pub use lookup::MOST_ALONG;
use lookup::{Bicubic, Bilinear, Mix, Nearest, fill_row_by_area, fill_rows};
use output_grid::{CubeGrid, OutputGrid, PanoramaGrid};
pub use texel_source::{BORDER, TexelLayers};
use texel_source::{CubeSource, PanoramaSource, TexelSource};

named_enum! {
    /// The lookup of a conversion.
    pub enum Filter {
        /// The nearest texel.
        Nearest = "nearest",
        /// Between the four texels about a place.
        Bilinear = "bilinear",
        /// Catmull and Rom's spline through the sixteen texels about a place.
        Bicubic = "bicubic",
        /// The mean of all texels that a pixel covers.
        Area = "area",
    }
    default Bilinear;
    what "filter";
}

/// The settings of a conversion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conversion {
    /// The filter; without one [`Filter::Area`] where the target is clearly coarser than the source (one and a half
    /// texels to a pixel), else [`Filter::Bilinear`].
    pub filter: Option<Filter>,
    /// Carries directions of the target to directions of the source: a rotation.
    pub source_from_target: DMat3,
}

impl Default for Conversion {
    fn default() -> Self {
        Conversion { filter: None, source_from_target: DMat3::IDENTITY }
    }
}

/// The source of a conversion.
#[derive(Clone, Copy, Debug)]
pub enum EnvironmentRef<'a> {
    /// Six faces.
    Cubemap(&'a Cubemap),
    /// An equirectangular picture.
    Panorama(&'a Panorama),
}

impl EnvironmentRef<'_> {
    /// Returns the height of a texel in the middle of a face, or on the horizon, in radians.
    pub fn texel_angle(&self) -> f64 {
        match self {
            EnvironmentRef::Cubemap(map) => 2.0 / f64::from(map.size()),
            EnvironmentRef::Panorama(panorama) => std::f64::consts::PI / f64::from(panorama.image.height),
        }
    }

    /// Linear radiance from a direction, bilinear, in f64: the reference for conversions.
    pub fn sample(&self, direction: DVec3) -> DVec3 {
        match self {
            EnvironmentRef::Cubemap(map) => map.sample(direction),
            EnvironmentRef::Panorama(panorama) => panorama.sample(direction),
        }
    }

    /// The size of a cubemap that has about as many texels in the middle of a face as this has there: a multiple of 4.
    pub fn natural_cubemap_size(&self) -> u32 {
        match self {
            EnvironmentRef::Cubemap(map) => map.size(),
            EnvironmentRef::Panorama(panorama) => {
                let by_height = f64::from(panorama.image.height) / 2.0;
                let by_width = f64::from(panorama.image.width) / 4.0;
                ((by_height.max(by_width) / 4.0).round() as u32 * 4).max(1)
            }
        }
    }

    /// The height of a panorama (twice as wide) that has about as many pixels along the horizon as this has there.
    pub fn natural_panorama_height(&self) -> u32 {
        match self {
            EnvironmentRef::Cubemap(map) => map.size().saturating_mul(2),
            EnvironmentRef::Panorama(panorama) => panorama.image.height,
        }
    }
}

/// From this many texels to a pixel on, bilinear lookups leave texels out. (A panorama and the cubemap that is usual
/// for it, a quarter as wide, have 1.3 in the middle of a face and 0.6 at its corners.)
const COARSER: f64 = 1.5;

impl Conversion {
    /// The filter that is used from a source onto pixels that are `target_angle` radians high.
    pub fn filter_for(&self, from: &EnvironmentRef<'_>, target_angle: f64) -> Filter {
        let shrinks = target_angle > from.texel_angle() * COARSER;
        self.filter.unwrap_or(if shrinks { Filter::Area } else { Filter::Bilinear })
    }

    /// Whether the rotation is the identity.
    pub fn is_not_turned(&self) -> bool {
        self.source_from_target == DMat3::IDENTITY
    }

    /// A cubemap of `size` texels along an edge.
    pub fn cubemap(&self, from: EnvironmentRef<'_>, size: u32) -> Cubemap {
        self.cubemap_at(SimdLevel::detect(), from, size)
    }

    /// [`Self::cubemap`] with the instructions of this level, for tests and benchmarks: the result is the same.
    pub fn cubemap_at(&self, level: SimdLevel, from: EnvironmentRef<'_>, size: u32) -> Cubemap {
        let mut map = Cubemap::new(size, [0.0; 4]);
        self.fill_cubemap_at(level, from, &mut map);
        map
    }

    /// [`Self::cubemap_at`] into an existing cubemap.
    pub fn fill_cubemap_at(&self, level: SimdLevel, from: EnvironmentRef<'_>, map: &mut Cubemap) {
        if let EnvironmentRef::Cubemap(source) = from
            && source.size() == map.size()
            && self.is_not_turned()
        {
            map.pixels_mut().copy_from_slice(source.pixels());
            return;
        }
        let target = CubeGrid::new(map.size());
        self.fill(level, from, &target, map.pixels_mut());
    }

    /// A panorama of this size; 0 counts as 1.
    pub fn panorama(&self, from: EnvironmentRef<'_>, width: u32, height: u32) -> Panorama {
        self.panorama_at(SimdLevel::detect(), from, width, height)
    }

    /// [`Self::panorama`] with the instructions of this level, for tests and benchmarks: the result is the same.
    pub fn panorama_at(&self, level: SimdLevel, from: EnvironmentRef<'_>, width: u32, height: u32) -> Panorama {
        let mut image = Image::new(width.max(1), height.max(1), [0.0; 4]);
        if let EnvironmentRef::Panorama(source) = from
            && (source.image.width, source.image.height) == (image.width, image.height)
            && self.is_not_turned()
        {
            return source.clone();
        }
        let target = PanoramaGrid::new(image.width, image.height);
        self.fill(level, from, &target, &mut image.pixels);
        Panorama { image }
    }

    fn fill(&self, level: SimdLevel, from: EnvironmentRef<'_>, target: &impl OutputGrid, pixels: &mut [Pixel]) {
        let filter = self.filter_for(&from, target.pixel_angle());
        match from {
            EnvironmentRef::Cubemap(map) => self.fill_from(level, &CubeSource::new(map), filter, target, pixels),
            EnvironmentRef::Panorama(panorama) => {
                let source = PanoramaSource::new(panorama, filter);
                match target.sides().filter(|_| self.is_not_turned() && filter == Filter::Bilinear) {
                    Some(size) => upright::fill(level, &source, size, pixels),
                    None => self.fill_from(level, &source, filter, target, pixels),
                }
            }
        }
    }

    fn fill_from(
        &self,
        level: SimdLevel,
        source: &impl TexelSource,
        filter: Filter,
        target: &impl OutputGrid,
        pixels: &mut [Pixel],
    ) {
        let turn = self.source_from_target.as_mat3();
        let turn = (turn != Mat3::IDENTITY).then_some(turn);
        // Some rows at a time: one is too little work to hand to a thread.
        let rows = pixels.par_chunks_exact_mut(target.row_length()).enumerate().with_min_len(8);
        rows.for_each(|(row, pixels)| level.run(Row { source, filter, target, turn, row, pixels }));
    }
}

/// A row of a target to be filled.
struct Row<'a, F, T> {
    source: &'a F,
    filter: Filter,
    target: &'a T,
    turn: Option<Mat3>,
    row: usize,
    pixels: &'a mut [Pixel],
}

impl<F: TexelSource, T: OutputGrid> Kernel for Row<'_, F, T> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        match self.filter {
            Filter::Nearest => self.mix::<S, 1, Nearest>(simd),
            Filter::Bilinear => self.mix::<S, 2, Bilinear>(simd),
            Filter::Bicubic => self.mix::<S, 4, Bicubic>(simd),
            Filter::Area => fill_row_by_area(simd, self.source, self.target, self.row, self.turn, self.pixels),
        }
    }
}

impl<F: TexelSource, T: OutputGrid> Row<'_, F, T> {
    /// Fills the row by a filter with one lookup per pixel.
    #[inline(always)]
    fn mix<S: Simd, const N: usize, M: Mix<N>>(self, simd: S) {
        let Row { source, target, turn, row, pixels, .. } = self;
        let line = target.row(row);
        fill_rows::<S, N, M, 1>(
            simd,
            source,
            [pixels],
            #[inline(always)]
            |first| {
                let directions = target.directions(&line, first as f32, first_eight(simd), 0.0);
                [source.places(turned(directions, turn)).cells(M::SHIFT)]
            },
        );
    }
}
