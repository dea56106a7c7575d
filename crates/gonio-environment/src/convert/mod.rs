//! From panoramas to cubemaps, back, and from each to its like: any size, turned if wanted, without seams.
//!
//! For each pixel of the target its direction, turned into the source, is looked up there; eight pixels at a time, rows
//! shared out among all threads. The result does not depend on the number of threads.
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

mod area;
mod lanes;
mod sheets;
mod source;
mod target;
mod upright;

use crate::face::Face;
use crate::image::{Image, Pixel};
use crate::{Cubemap, Panorama};
pub use area::MOST_ALONG;
use glam::{DMat3, DVec3, Mat3};
use gonio_light::named_enum;
pub use lanes::ARC_TANGENT;
use lanes::LANES;
use rayon::prelude::*;
pub use sheets::Sheets;
pub use source::BORDER;
use source::{CubeSource, PanoramaSource, Places, Source};
use target::{CubeTarget, PanoramaTarget, Target};
use upright::{SideColumns, is_side};

named_enum! {
    /// How a conversion looks up its source.
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

/// How to convert.
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

/// What is converted from.
#[derive(Clone, Copy, Debug)]
pub enum From<'a> {
    /// Six faces.
    Cubemap(&'a Cubemap),
    /// An equirectangular picture.
    Panorama(&'a Panorama),
}

impl From<'_> {
    /// How many radians a texel in the middle of a face, or on the horizon, is high.
    pub fn texel_angle(&self) -> f64 {
        match self {
            From::Cubemap(map) => 2.0 / f64::from(map.size()),
            From::Panorama(panorama) => std::f64::consts::PI / f64::from(panorama.image.height),
        }
    }

    /// Linear radiance from a direction, bilinear, in f64: what a conversion is held against.
    pub fn sample(&self, direction: DVec3) -> DVec3 {
        match self {
            From::Cubemap(map) => map.sample(direction),
            From::Panorama(panorama) => panorama.sample(direction),
        }
    }

    /// The size of a cubemap that has about as many texels in the middle of a face as this has there: a multiple of 4.
    pub fn natural_cubemap_size(&self) -> u32 {
        match self {
            From::Cubemap(map) => map.size(),
            From::Panorama(panorama) => {
                let by_height = f64::from(panorama.image.height) / 2.0;
                let by_width = f64::from(panorama.image.width) / 4.0;
                ((by_height.max(by_width) / 4.0).round() as u32 * 4).max(1)
            }
        }
    }

    /// The height of a panorama (twice as wide) that has about as many pixels along the horizon as this has there.
    pub fn natural_panorama_height(&self) -> u32 {
        match self {
            From::Cubemap(map) => map.size().saturating_mul(2),
            From::Panorama(panorama) => panorama.image.height,
        }
    }
}

/// From this many texels to a pixel on, bilinear lookups leave texels out. (A panorama and the cubemap that is usual for
/// it, a quarter as wide, have 1.3 in the middle of a face and 0.6 at its corners.)
const COARSER: f64 = 1.5;

impl Conversion {
    /// The filter that is used from a source onto pixels that are `target_angle` radians high.
    pub fn filter_for(&self, from: &From<'_>, target_angle: f64) -> Filter {
        let shrinks = target_angle > from.texel_angle() * COARSER;
        self.filter.unwrap_or(if shrinks { Filter::Area } else { Filter::Bilinear })
    }

    /// Whether directions stay what they are.
    pub fn is_not_turned(&self) -> bool {
        self.source_from_target == DMat3::IDENTITY
    }

    /// A cubemap of `size` texels along an edge.
    pub fn cubemap(&self, from: From<'_>, size: u32) -> Cubemap {
        let mut map = Cubemap::new(size, [0.0; 4]);
        self.fill_cubemap(from, &mut map);
        map
    }

    /// [`Self::cubemap`] into one that is there already.
    pub fn fill_cubemap(&self, from: From<'_>, map: &mut Cubemap) {
        if let From::Cubemap(source) = from
            && source.size() == map.size()
            && self.is_not_turned()
        {
            map.pixels_mut().copy_from_slice(source.pixels());
            return;
        }
        let target = CubeTarget::new(map.size());
        self.fill(from, &target, map.pixels_mut());
    }

    /// A panorama of this size; 0 counts as 1.
    pub fn panorama(&self, from: From<'_>, width: u32, height: u32) -> Panorama {
        let mut image = Image::new(width.max(1), height.max(1), [0.0; 4]);
        if let From::Panorama(source) = from
            && (source.image.width, source.image.height) == (image.width, image.height)
            && self.is_not_turned()
        {
            return source.clone();
        }
        let target = PanoramaTarget::new(image.width, image.height);
        self.fill(from, &target, &mut image.pixels);
        Panorama { image }
    }

    fn fill(&self, from: From<'_>, target: &impl Target, pixels: &mut [Pixel]) {
        let filter = self.filter_for(&from, target.pixel_angle());
        match from {
            From::Cubemap(map) => self.fill_from(&CubeSource::new(map), filter, target, pixels),
            From::Panorama(panorama) => {
                let source = PanoramaSource::new(panorama, filter);
                match target.sides().filter(|_| self.is_not_turned() && filter != Filter::Area) {
                    Some(size) => self.fill_upright(&source, size, filter, target, pixels),
                    None => self.fill_from(&source, filter, target, pixels),
                }
            }
        }
    }

    fn fill_from(&self, source: &impl Source, filter: Filter, target: &impl Target, pixels: &mut [Pixel]) {
        // Some rows at a time: one is too little work to hand to a thread.
        let rows = pixels.par_chunks_exact_mut(target.row_length()).enumerate().with_min_len(8);
        rows.for_each(|(row, pixels)| self.fill_row(source, filter, target, row, pixels));
    }

    /// [`Self::fill_from`] for a cubemap of `size` from a panorama that is not turned.
    fn fill_upright(
        &self,
        source: &PanoramaSource<'_>,
        size: usize,
        filter: Filter,
        target: &impl Target,
        pixels: &mut [Pixel],
    ) {
        let columns = Face::ALL.map(|face| is_side(face).then(|| SideColumns::new(face, size, source.width())));
        let rows = pixels.par_chunks_exact_mut(size).enumerate().with_min_len(8);
        rows.for_each(|(row, pixels)| match &columns[(row / size).min(5)] {
            Some(columns) => columns.fill_row(source, row % size, pixels, |at, all| looked_up(source, filter, at, all)),
            None => self.fill_row(source, filter, target, row, pixels),
        });
    }

    #[inline(always)]
    fn fill_row(&self, source: &impl Source, filter: Filter, target: &impl Target, row: usize, pixels: &mut [Pixel]) {
        let turn = self.source_from_target.as_mat3();
        let turn = (turn != Mat3::IDENTITY).then_some(turn);
        match filter {
            Filter::Area => area::fill_row(source, target, row, turn, pixels),
            _ => lanes::fill_row(target, row, turn, pixels, |d, all| looked_up(source, filter, source.places(d), all)),
        }
    }
}

/// What a filter that takes one place finds at eight of them.
#[inline(always)]
fn looked_up(source: &impl Source, filter: Filter, at: Places, all: &mut [Pixel; LANES]) {
    match filter {
        Filter::Nearest => source.nearest(at, |i, value| all[i] = value.to_array()),
        Filter::Bicubic => source.bicubic(at, |i, value| all[i] = value.to_array()),
        Filter::Bilinear | Filter::Area => source.bilinear(at, |i, value| all[i] = value.to_array()),
    }
}
