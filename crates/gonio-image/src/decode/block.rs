//! Block compression of DirectX: BC1 to BC7.

use super::texel::{Transfer, light8};
use crate::Pixel;
use crate::image::Image;
use half::f16;
use rayon::prelude::*;

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

    /// Decodes all blocks of a picture, whose size is given by `image`; blocks may stand over its edges.
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
