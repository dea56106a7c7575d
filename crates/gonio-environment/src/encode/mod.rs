//! Pictures of linear light, and cubemaps, to files.
//!
//! | file | what is written |
//! |---|---|
//! | [`png`] | sRGB of 8 or 16 bits, after exposure and tone map |
//! | [`hdr`] | RGBE with adaptive run lengths: light up to 1.7e38, a hundredth of a pixel's brightest channel exact |
//! | [`exr`] | R, G and B as halves or floats, ZIP-compressed |
//! | [`ktx2`] | a cubemap with its mip levels, as a GPU takes it |
//!
//! What a format cannot hold is told in [`Encoded::warnings`].

pub mod exr;
pub mod hdr;
pub mod ktx2;
pub mod png;

use crate::Pixel;
use half::f16;
use rayon::prelude::*;

/// A file, and what it could not hold.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Encoded {
    /// The file.
    pub bytes: Vec<u8>,
    /// One sentence each, without final full stop.
    pub warnings: Vec<String>,
}

/// The half float nearest to light; beyond the largest it is that, and what is no light is 0.
fn half(light: f32) -> f16 {
    // Written so that NaN becomes 0.
    f16::from_f32(if light > 0.0 { light.min(f16::MAX.to_f32_const()) } else { 0.0 })
}

/// Says how many numbers are more than a half float holds.
fn beyond_half(pixels: &[Pixel], remedy: &str) -> Option<String> {
    let limit = f16::MAX.to_f32_const();
    let beyond = |p: &Pixel| p[..3].iter().filter(|x| **x > limit).count();
    let count: usize = pixels.par_iter().with_min_len(1 << 14).map(beyond).sum();
    (count > 0)
        .then(|| format!("{count} numbers are above {limit}, the largest half float, and are cut to it; {remedy}"))
}
