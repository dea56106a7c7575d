//! Texel formats of GPUs, as KTX2 and DDS have them, to linear light; block-compressed ones too.

use crate::image::Image;
use crate::srgb::{LINEAR_FROM_8, LINEAR_FROM_16};
use crate::{DecodeLimits, ImageError, Pixel};
use half::f16;
use rayon::prelude::*;

/// The storage format of texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Texel {
    /// Channels of 8 bits; which byte is red, green and blue.
    Bytes { size: usize, rgb: [usize; 3] },
    /// Channels of 16 bits, integers from 0 to 1; red first.
    Shorts { channels: usize },
    /// Half floats, red first.
    Halves { channels: usize },
    /// Floats, red first.
    Floats { channels: usize },
    /// Bits of a little-endian number of up to 4 bytes: a mask each for red, green and blue.
    Masks { size: usize, masks: [u32; 3] },
    /// Unsigned floats of 11, 11 and 10 bits, red lowest.
    R11G11B10,
    /// Three mantissas of 9 bits, red lowest, and an exponent of 5.
    R9G9B9E5,
    /// Blocks of 4 x 4 pixels.
    Block(Block),
}

/// The meaning of integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Transfer {
    /// Light itself.
    Linear,
    /// sRGB-encoded.
    Srgb,
}

impl Texel {
    /// Whether it holds light beyond 1.
    pub(super) fn is_high_dynamic_range(self) -> bool {
        match self {
            Texel::Halves { .. } | Texel::Floats { .. } | Texel::R11G11B10 | Texel::R9G9B9E5 => true,
            Texel::Block(block) => matches!(block, Block::Bc6h { .. }),
            Texel::Bytes { .. } | Texel::Shorts { .. } | Texel::Masks { .. } => false,
        }
    }

    /// Bytes of one pixel, or of one block.
    pub(super) fn size(self) -> u64 {
        match self {
            Texel::Bytes { size, .. } | Texel::Masks { size, .. } => size as u64,
            Texel::Shorts { channels } | Texel::Halves { channels } => 2 * channels as u64,
            Texel::Floats { channels } => 4 * channels as u64,
            Texel::R11G11B10 | Texel::R9G9B9E5 => 4,
            Texel::Block(block) => block.size() as u64,
        }
    }

    /// Bytes of a picture without gaps, if they can be counted.
    pub(super) fn bytes(self, width: u32, height: u32) -> Option<u64> {
        let (width, height) = (u64::from(width), u64::from(height));
        let texels = match self {
            Texel::Block(_) => width.div_ceil(4).checked_mul(height.div_ceil(4)),
            _ => width.checked_mul(height),
        };
        texels?.checked_mul(self.size())
    }

    /// A picture of exactly [`Self::bytes`] bytes.
    pub(super) fn decode(
        self,
        bytes: &[u8],
        (width, height): (u32, u32),
        transfer: Transfer,
        limits: &DecodeLimits,
    ) -> Result<Image, ImageError> {
        let mut image = limits.unfilled(width, height)?;
        image.pixels.resize(width as usize * height as usize, [0.0, 0.0, 0.0, 1.0]);
        if let Texel::Block(block) = self {
            block.decode(bytes, &mut image, transfer);
            return Ok(image);
        }
        let size = self.size() as usize;
        let rows = bytes.par_chunks_exact(width as usize * size);
        image.pixels.par_chunks_exact_mut(width as usize).zip(rows).with_min_len(8).for_each(|(to, from)| {
            for (to, from) in to.iter_mut().zip(from.chunks_exact(size)) {
                *to = self.pixel(from, transfer);
            }
        });
        Ok(image)
    }

    /// One pixel of [`Self::size`] bytes. One channel alone is grey; of two, which are no colour, the second counts as
    /// alpha.
    fn pixel(self, bytes: &[u8], transfer: Transfer) -> Pixel {
        let grey_or_rgb = |channels: usize, light: &dyn Fn(usize) -> f32| match channels {
            0..3 => [light(0), light(0), light(0), 1.0],
            _ => [light(0), light(1), light(2), 1.0],
        };
        let two = |i: usize| [bytes[2 * i], bytes[2 * i + 1]];
        let four = |i: usize| [bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]];
        match self {
            Texel::Bytes { rgb, .. } => {
                let [r, g, b] = rgb.map(|i| light8(bytes[i], transfer));
                [r, g, b, 1.0]
            }
            Texel::Shorts { channels } => grey_or_rgb(channels, &|i| light16(u16::from_le_bytes(two(i)), transfer)),
            Texel::Halves { channels } => grey_or_rgb(channels, &|i| f16::from_le_bytes(two(i)).to_f32()),
            Texel::Floats { channels } => grey_or_rgb(channels, &|i| f32::from_le_bytes(four(i))),
            Texel::Masks { size, masks } => {
                let number = (0..size).fold(0, |n, i| n | u32::from(bytes[i]) << (8 * i));
                let [r, g, b] = masks.map(|mask| masked(number, mask, transfer));
                [r, g, b, 1.0]
            }
            Texel::R11G11B10 => {
                let number = u32::from_le_bytes(four(0));
                [small_float(number, 6), small_float(number >> 11, 6), small_float(number >> 22, 5), 1.0]
            }
            Texel::R9G9B9E5 => {
                let number = u32::from_le_bytes(four(0));
                // The exponent's bias is 15, and the mantissas are ninths of bits behind the point.
                let scale = ((number >> 27) as f32 - 24.0).exp2();
                let light = |shift: u32| (number >> shift & 0x1FF) as f32 * scale;
                [light(0), light(9), light(18), 1.0]
            }
            // Decoded by blocks.
            Texel::Block(_) => [0.0, 0.0, 0.0, 1.0],
        }
    }
}

/// Linear light of an 8-bit number.
pub(super) fn light8(step: u8, transfer: Transfer) -> f32 {
    match transfer {
        Transfer::Linear => f32::from(step) / 255.0,
        Transfer::Srgb => LINEAR_FROM_8[usize::from(step)],
    }
}

fn light16(step: u16, transfer: Transfer) -> f32 {
    match transfer {
        Transfer::Linear => f32::from(step) / 65535.0,
        Transfer::Srgb => LINEAR_FROM_16[usize::from(step)],
    }
}

/// The number in a mask's bits, from 0 to 1. A mask without bits is 0.
fn masked(number: u32, mask: u32, transfer: Transfer) -> f32 {
    if mask == 0 {
        return 0.0;
    }
    let low = mask.trailing_zeros();
    let share = f64::from((number & mask) >> low) / f64::from(mask >> low);
    match transfer {
        Transfer::Linear => share as f32,
        Transfer::Srgb => gonio_light::color::srgb_decode(share) as f32,
    }
}

/// An unsigned float with 5 bits of exponent and so many of mantissa (OpenGL 4.6, 2.3.4.3): a half float's upper bits.
fn small_float(bits: u32, mantissa: u32) -> f32 {
    let bits = bits & ((1 << (mantissa + 5)) - 1);
    f16::from_bits((bits << (10 - mantissa)) as u16).to_f32()
}

/// Formats of 4 x 4 pixels in 8 or 16 bytes. BC5 has two channels and holds no colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Block {
    /// Two colours of 16 bits and four steps between them.
    Bc1,
    /// The same, and alpha of 4 bits.
    Bc2,
    /// The same, and alpha of 8 bits, interpolated.
    Bc3,
    /// Grey.
    Bc4,
    /// Light in half floats, with or without a sign.
    Bc6h {
        /// Whether it has a sign.
        signed: bool,
    },
    /// Colours and alpha in several modes.
    Bc7,
}

impl Block {
    /// Bytes of a block.
    pub(super) fn size(self) -> usize {
        match self {
            Block::Bc1 | Block::Bc4 => 8,
            Block::Bc2 | Block::Bc3 | Block::Bc6h { .. } | Block::Bc7 => 16,
        }
    }

    /// Decodes all blocks of a picture, whose size is given by `image`; blocks may extend beyond its edges.
    pub(super) fn decode(self, bytes: &[u8], image: &mut Image, transfer: Transfer) {
        let width = image.width as usize;
        let blocks_of_row = bytes.par_chunks_exact(width.div_ceil(4) * self.size());
        image.pixels.par_chunks_mut(4 * width).zip(blocks_of_row).for_each(|(pixels, blocks)| {
            for (column, block) in blocks.chunks_exact(self.size()).enumerate() {
                let decoded = self.decode_one(block, transfer);
                for (row, from) in pixels.chunks_exact_mut(width).zip(decoded.chunks_exact(4)) {
                    let to = &mut row[4 * column..(4 * column + 4).min(width)];
                    to.copy_from_slice(&from[..to.len()]);
                }
            }
        });
    }

    fn decode_one(self, block: &[u8], transfer: Transfer) -> [Pixel; 16] {
        let rgba8 = |decode: fn(&[u8], &mut [u8], usize)| {
            let mut bytes = [0; 64];
            decode(block, &mut bytes, 16);
            std::array::from_fn(|i| {
                let light = |channel: usize| light8(bytes[4 * i + channel], transfer);
                [light(0), light(1), light(2), 1.0]
            })
        };
        match self {
            Block::Bc1 => rgba8(bcdec_rs::bc1),
            Block::Bc2 => rgba8(bcdec_rs::bc2),
            Block::Bc3 => rgba8(bcdec_rs::bc3),
            Block::Bc7 => rgba8(bcdec_rs::bc7),
            Block::Bc4 => {
                let mut bytes = [0; 16];
                bcdec_rs::bc4(block, &mut bytes, 4, false);
                bytes.map(|step| {
                    let light = light8(step, transfer);
                    [light, light, light, 1.0]
                })
            }
            Block::Bc6h { signed } => {
                let mut halves = [0; 48];
                bcdec_rs::bc6h_half(block, &mut halves, 12, signed);
                std::array::from_fn(|i| {
                    let light = |channel: usize| f16::from_bits(halves[3 * i + channel]).to_f32();
                    [light(0), light(1), light(2), 1.0]
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(texel: Texel, bytes: &[u8], transfer: Transfer) -> Pixel {
        let image = texel.decode(bytes, (1, 1), transfer, &DecodeLimits::default());
        image.map(|i| i.at(0, 0)).unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn each_format_gives_the_light_that_its_bits_mean() {
        use Transfer::{Linear, Srgb};
        let cases: &[(Texel, &[u8], Transfer, [f32; 3])] = &[
            (Texel::Bytes { size: 3, rgb: [0, 1, 2] }, &[255, 51, 0], Linear, [1.0, 0.2, 0.0]),
            (Texel::Bytes { size: 4, rgb: [2, 1, 0] }, &[255, 51, 0, 9], Linear, [0.0, 0.2, 1.0]),
            (Texel::Bytes { size: 1, rgb: [0; 3] }, &[188], Srgb, [LINEAR_FROM_8[188]; 3]),
            (Texel::Shorts { channels: 4 }, &[0xFF, 0xFF, 0x33, 0x33, 0, 0, 1, 1], Linear, [1.0, 0.2, 0.0]),
            // 0x3C00 is 1, 0x4200 3, 0x3800 one half.
            (Texel::Halves { channels: 4 }, &[0, 0x3C, 0, 0x42, 0, 0x38, 0, 0], Srgb, [1.0, 3.0, 0.5]),
            (Texel::Halves { channels: 1 }, &[0, 0x42], Linear, [3.0; 3]),
            // 5, 6 and 5 bits.
            (Texel::Masks { size: 2, masks: [0xF800, 0x7E0, 0x1F] }, &[0x1F, 0xF8], Linear, [1.0, 0.0, 1.0]),
            // Exponent 15 and no mantissa is 1; mantissa of one half more is 1.5; exponent 16 is 2.
            (
                Texel::R11G11B10,
                &(15 << 6 | (15 << 6 | 32) << 11 | (16_u32 << 5) << 22).to_le_bytes(),
                Linear,
                [1.0, 1.5, 2.0],
            ),
            // 256 / 512 * 2^(16 - 15).
            (Texel::R9G9B9E5, &(256 | 512_u32 >> 1 << 9 | 16 << 27).to_le_bytes(), Linear, [1.0, 1.0, 0.0]),
        ];
        for (texel, bytes, transfer, [r, g, b]) in cases {
            assert_eq!(one(*texel, bytes, *transfer), [*r, *g, *b, 1.0], "{texel:?}");
        }
    }

    #[test]
    fn sizes_count_whole_blocks() {
        assert_eq!(Texel::Block(Block::Bc1).bytes(5, 4), Some(16));
        assert_eq!(Texel::Floats { channels: 4 }.bytes(5, 4), Some(320));
        assert_eq!(Texel::Floats { channels: 4 }.bytes(u32::MAX, u32::MAX), None);
    }
}
