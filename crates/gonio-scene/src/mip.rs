//! The smaller levels of a texture.

use crate::texture::{ColorSpace, Texture};
use gonio_light::color::srgb_decode;
use std::sync::LazyLock;

/// One level, made as [`Texture`]'s own: RGBA, 8 bits, first row the picture's top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipLevel {
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

/// Linear light of the 256 sRGB bytes.
pub static SRGB_TO_LINEAR: LazyLock<[f64; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| srgb_decode(byte as f64 / 255.0)));

/// Each byte's sRGB value reaches up to here: linear light of byte + 1/2.
static SRGB_UPPER: LazyLock<[f64; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| srgb_decode((byte as f64 + 0.5) / 255.0)));

/// The smallest byte that a value in `[i / 4096, (i + 1) / 4096)` can round to.
static SRGB_START: LazyLock<Vec<u8>> = LazyLock::new(|| {
    (0..=4096)
        .map(|i| {
            let light = f64::from(i) / 4096.0;
            SRGB_UPPER.iter().position(|&upper| light < upper).unwrap_or(255) as u8
        })
        .collect()
});

/// The sRGB byte nearest to linear light `light`; NaN gives 0.
pub fn srgb_byte(light: f64) -> u8 {
    if light.is_nan() || light <= 0.0 {
        return 0;
    }
    let light = light.min(1.0);
    let mut byte = SRGB_START[(light * 4096.0) as usize];
    while byte < 255 && light >= SRGB_UPPER[byte as usize] {
        byte += 1;
    }
    byte
}

/// RGBA bytes as linear numbers in [0, 1]; alpha is never encoded.
pub fn decode(texel: [u8; 4], color_space: ColorSpace) -> [f64; 4] {
    let plain = |byte: u8| f64::from(byte) / 255.0;
    match color_space {
        ColorSpace::Data => texel.map(plain),
        ColorSpace::Srgb => {
            let table = &*SRGB_TO_LINEAR;
            let [r, g, b, a] = texel;
            [table[r as usize], table[g as usize], table[b as usize], plain(a)]
        }
    }
}

fn encode(value: [f32; 4], color_space: ColorSpace) -> [u8; 4] {
    let plain = |v: f32| (v * 255.0 + 0.5) as u8;
    match color_space {
        ColorSpace::Data => value.map(plain),
        ColorSpace::Srgb => {
            [srgb_byte(value[0].into()), srgb_byte(value[1].into()), srgb_byte(value[2].into()), plain(value[3])]
        }
    }
}

/// A level that is not yet rounded, so that errors do not add up from level to level.
struct LinearLevel {
    width: u32,
    height: u32,
    texels: Vec<[f32; 4]>,
}

/// All levels below the full picture.
pub(crate) fn chain(texture: &Texture) -> Vec<MipLevel> {
    let texels = texture.rgba.as_chunks::<4>().0.iter();
    let mut level = LinearLevel {
        width: texture.width,
        height: texture.height,
        texels: texels.map(|&t| decode(t, texture.color_space).map(|v| v as f32)).collect(),
    };
    let mut levels = Vec::new();
    while level.width > 1 || level.height > 1 {
        level = halve(&level);
        let rgba = level.texels.iter().flat_map(|&t| encode(t, texture.color_space)).collect();
        levels.push(MipLevel { width: level.width, height: level.height, rgba });
    }
    levels
}

/// Half the size, rounded down, at least 1: the mean over each texel's area. Where a side is odd the
/// areas cut through texels, and those count by their share.
fn halve(from: &LinearLevel) -> LinearLevel {
    let (width, height) = ((from.width / 2).max(1), (from.height / 2).max(1));
    let columns: Vec<_> = (0..width).map(|x| cover(x, width, from.width)).collect();
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let rows = cover(y, height, from.height);
        for column in &columns {
            let mut sum = [0.0f32; 4];
            for &(row, row_share) in &rows {
                for &(x, share) in column {
                    let texel = from.texels[row as usize * from.width as usize + x as usize];
                    for (s, t) in sum.iter_mut().zip(texel) {
                        *s += t * share * row_share;
                    }
                }
            }
            texels.push(sum);
        }
    }
    LinearLevel { width, height, texels }
}

/// The texels that texel `i` of `size` covers in a side of `from` texels, with their shares.
fn cover(i: u32, size: u32, from: u32) -> Vec<(u32, f32)> {
    let extent = f64::from(from) / f64::from(size);
    let (start, end) = (f64::from(i) * extent, f64::from(i + 1) * extent);
    (start as u32..from)
        .map(|t| (t, (end.min(f64::from(t + 1)) - start.max(f64::from(t))) / extent))
        .take_while(|(_, share)| *share > 1e-9)
        .map(|(t, share)| (t, share as f32))
        .collect()
}
