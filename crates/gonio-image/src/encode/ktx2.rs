//! KTX2: a cubemap with mip levels.
//!
//! Source: Khronos, *KTX File Format Specification* 2.0, and *Khronos Data Format Specification* 1.3, section 5 (the
//! basic descriptor block). Faces lie in OpenGL's order and layout, as the specification demands.

use super::{Encoded, beyond_half, half};
use crate::Pixel;
use crate::srgb::ENCODER;
use rayon::prelude::*;

/// The number format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Ktx2Format {
    /// `R16G16B16A16_SFLOAT`: half floats, up to 65504.
    #[default]
    Half,
    /// `R32G32B32A32_SFLOAT`: as they are in memory.
    Float,
    /// `R8G8B8A8_SRGB`: 8 bits, clamped to 1.
    Srgb8,
}

/// One mip level of a cubemap.
#[derive(Clone, Copy, Debug)]
pub struct Level<'a> {
    size: u32,
    pixels: &'a [Pixel],
}

impl<'a> Level<'a> {
    /// Six square faces of `size * size` pixels, one after the other in the order +X, -X, +Y, -Y, +Z, -Z, in OpenGL's
    /// layout. `None` if `pixels` has another length.
    pub fn new(size: u32, pixels: &'a [Pixel]) -> Option<Self> {
        let expected = 6 * u64::from(size) * u64::from(size);
        (size > 0 && pixels.len() as u64 == expected).then_some(Level { size, pixels })
    }
}

/// The fields of the file that depend on the format.
struct Layout {
    vk_format: u32,
    /// Bytes of a number, which is what a machine of the other order would have to swap.
    type_size: u32,
    /// The qualifiers of a sample in the descriptor (signed 0x40, float 0x80), and the values that count as 0 and as 1.
    qualifiers: u32,
    lower: u32,
    upper: u32,
    /// KHR_DF_TRANSFER: 1 linear, 2 sRGB.
    transfer: u32,
}

impl Ktx2Format {
    fn layout(self) -> Layout {
        // Of floats the descriptor gives -1 and 1 as f32, whatever their own size.
        let float = |vk_format, type_size| Layout {
            vk_format,
            type_size,
            qualifiers: 0xC0,
            lower: (-1.0_f32).to_bits(),
            upper: 1.0_f32.to_bits(),
            transfer: 1,
        };
        match self {
            Ktx2Format::Half => float(97, 2),
            Ktx2Format::Float => float(109, 4),
            Ktx2Format::Srgb8 => {
                Layout { vk_format: 43, type_size: 1, qualifiers: 0, lower: 0, upper: 255, transfer: 2 }
            }
        }
    }
}

/// Encodes a cubemap as KTX2: all its mip levels, the largest first, or one level only.
///
/// Each level must be half as large as the one before it, rounded down. The first one that is not ends the chain, and a
/// warning reports it.
pub fn encode(levels: &[Level<'_>], format: Ktx2Format) -> Encoded {
    let mut warnings = Vec::new();
    let full_size = levels.first().map_or(0, |full| full.size);
    let fits = |(i, level): &(usize, &Level<'_>)| level.size == (full_size >> (*i).min(31)).max(1);
    let chain = levels.iter().enumerate().take_while(fits).count();
    if chain < levels.len() {
        warnings.push(format!(
            "of {} mip levels {chain} are written: the next is not half as large as the one before it",
            levels.len(),
        ));
    }
    let full = levels.first().map_or(&[][..], |full| full.pixels);
    match format {
        Ktx2Format::Half => warnings.extend(beyond_half(full, "write floats to keep them")),
        Ktx2Format::Srgb8 => {
            let count: usize =
                full.par_iter().with_min_len(1 << 14).map(|p| p[..3].iter().filter(|x| **x > 1.0).count()).sum();
            if count > 0 {
                warnings
                    .push(format!("{count} numbers are above 1 and are clamped to it; write half floats to keep them"));
            }
        }
        Ktx2Format::Float => {}
    }
    Encoded { bytes: file(&levels[..chain], format), warnings }
}

/// The bytes before the level index.
const HEADER: usize = 80;
/// An entry of the level index: offset, length, length when unpacked.
const ENTRY: usize = 24;

fn file(levels: &[Level<'_>], format: Ktx2Format) -> Vec<u8> {
    let layout = format.layout();
    let descriptor = descriptor(&layout);
    let metadata = metadata(&[("KTXorientation", "rd"), ("KTXwriter", "gonio")]);
    let index_end = HEADER + ENTRY * levels.len();
    let metadata_start = index_end + descriptor.len();
    let pixels_start = metadata_start + metadata.len();

    // The smallest level comes first, so that what streams in can be shown early.
    let encoded: Vec<Vec<u8>> = levels.iter().map(|level| pixels(level, format)).collect();
    let alignment = 4 * layout.type_size as usize;
    let mut index = vec![[0_u64; 3]; levels.len()];
    let mut at = pixels_start;
    for (entry, bytes) in index.iter_mut().zip(&encoded).rev() {
        at = at.next_multiple_of(alignment);
        *entry = [at as u64, bytes.len() as u64, bytes.len() as u64];
        at += bytes.len();
    }

    let mut file = Vec::with_capacity(at);
    file.extend(crate::decode::KTX2_MAGIC);
    let size = levels.first().map_or(0, |level| level.size);
    let numbers = [
        layout.vk_format,
        layout.type_size,
        size,
        size,
        0, // depth: not a volume
        0, // layers: not an array
        6,
        levels.len() as u32,
        0, // not packed
        index_end as u32,
        descriptor.len() as u32,
        metadata_start as u32,
        metadata.len() as u32,
        // No global data of a packing: two numbers of 64 bits.
        0,
        0,
        0,
        0,
    ];
    file.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
    file.extend(index.iter().flatten().flat_map(|n| n.to_le_bytes()));
    file.extend(descriptor);
    file.extend(metadata);
    for (entry, bytes) in index.iter().zip(&encoded).rev() {
        file.resize(entry[0] as usize, 0);
        file.extend_from_slice(bytes);
    }
    file
}

/// The data format descriptor: its length, and one basic block with a sample for each channel.
fn descriptor(layout: &Layout) -> Vec<u8> {
    const CHANNELS: u32 = 4;
    const BLOCK: u32 = 24 + 16 * CHANNELS;
    let bits = 8 * layout.type_size;
    // Words of 32 bits; in each the first field is lowest.
    let mut words = vec![
        BLOCK + 4,
        // Khronos's basic block, in version 2 of the specification's numbering (1.3).
        0,
        2 | BLOCK << 16,
        // Colour model RGBSDA, primaries BT.709, transfer function, alpha not multiplied in.
        1 | 1 << 8 | layout.transfer << 16,
        // Texel blocks of 1 x 1 x 1 x 1, which is written as 0.
        0,
        // Bytes of the first plane; the other planes have none.
        4 * layout.type_size,
        0,
    ];
    for (i, channel) in [0, 1, 2, 15].into_iter().enumerate() {
        // Alpha is never sRGB-encoded, which its qualifier `linear` (0x10) states if the others are.
        let linear = if channel == 15 && layout.transfer == 2 { 0x10 } else { 0 };
        words.push((bits * i as u32) | ((bits - 1) << 16) | ((channel | layout.qualifiers | linear) << 24));
        // Where in the block it is sampled.
        words.extend([0, layout.lower, layout.upper]);
    }
    words.iter().flat_map(|w| w.to_le_bytes()).collect()
}

/// Keys in their order, each with its value and both ended by a 0; each entry begins at a multiple of 4.
fn metadata(entries: &[(&str, &str)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (key, value) in entries {
        let length = key.len() + value.len() + 2;
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend(key.bytes().chain([0]).chain(value.bytes()).chain([0]));
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}

/// All faces of a level.
fn pixels(level: &Level<'_>, format: Ktx2Format) -> Vec<u8> {
    fn map<const N: usize>(level: &Level<'_>, encode: impl Fn([f32; 3]) -> [u8; N] + Sync) -> Vec<u8> {
        let mut bytes = vec![0; N * level.pixels.len()];
        bytes.par_chunks_mut(N << 13).zip(level.pixels.par_chunks(1 << 13)).for_each(|(to, from)| {
            for (to, [r, g, b, _]) in to.as_chunks_mut::<N>().0.iter_mut().zip(from) {
                *to = encode([*r, *g, *b]);
            }
        });
        bytes
    }
    let encoder = &*ENCODER;
    match format {
        Ktx2Format::Half => map::<8>(level, |rgb| {
            let [r, g, b] = rgb.map(|x| half(x).to_le_bytes());
            // 0x3C00 is 1.
            [r[0], r[1], g[0], g[1], b[0], b[1], 0, 0x3C]
        }),
        Ktx2Format::Float => map::<16>(level, |[r, g, b]| {
            let mut texel = [0; 16];
            for (to, x) in texel.as_chunks_mut::<4>().0.iter_mut().zip([r, g, b, 1.0]) {
                *to = x.to_le_bytes();
            }
            texel
        }),
        Ktx2Format::Srgb8 => {
            map::<4>(level, |[r, g, b]| [encoder.encode(r), encoder.encode(g), encoder.encode(b), 255])
        }
    }
}
