//! Pictures and cubemaps to files.
//!
//! | module | output |
//! |---|---|
//! | [`png`] | 8 or 16 bits, still or animated: encoded pictures, or linear light after exposure and tone map |
//! | [`hdr`] | RGBE with adaptive run lengths: light up to 1.7e38, exact to a hundredth of a pixel's brightest channel |
//! | [`exr`] | R, G and B as halves or floats, or layers of R, G, B and A as floats; ZIP-compressed |
//! | [`ktx2`] | a cubemap with its mip levels, ready for a GPU |
//!
//! [`Encoded::warnings`] lists the values that a format cannot represent.

pub mod exr;
pub mod hdr;
pub mod ktx2;
pub mod png;

use crate::Pixel;
use half::f16;
use rayon::prelude::*;

/// An encoded file, with warnings about values that it cannot represent.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Encoded {
    /// The file.
    pub bytes: Vec<u8>,
    /// One sentence each, without final full stop.
    pub warnings: Vec<String>,
}

/// Returns the half float nearest to light, clamped to the largest; negative numbers and NaN become 0.
fn half(light: f32) -> f16 {
    // Written so that NaN becomes 0.
    f16::from_f32(if light > 0.0 { light.min(f16::MAX.to_f32_const()) } else { 0.0 })
}

/// Warns about numbers above the largest half float.
fn beyond_half(pixels: &[Pixel], remedy: &str) -> Option<String> {
    let limit = f16::MAX.to_f32_const();
    let beyond = |p: &Pixel| p[..3].iter().filter(|x| **x > limit).count();
    let count: usize = pixels.par_iter().with_min_len(1 << 14).map(beyond).sum();
    (count > 0)
        .then(|| format!("{count} numbers are above {limit}, the largest half float, and are clamped to it; {remedy}"))
}
