//! KTX2: cubemaps and 2-D pictures as a GPU takes them.
//!
//! Source: Khronos, *KTX File Format Specification* 2.0. Faces are stored in the order +X -X +Y -Y +Z -Z in OpenGL's
//! layout ("cubemaps use a left-handed coordinate system"), the largest level is level 0.

use super::texel::{Block, Texel, Transfer};
use super::{Bytes, Decoded, DecodedContent, FileFormat, tidy};
use crate::image::Image;
use crate::{DecodeLimits, ImageError};
use std::borrow::Cow;
use std::io::Read;

/// The first bytes of a KTX2 file.
pub(crate) const MAGIC: &[u8] = b"\xABKTX 20\xBB\r\n\x1a\n";

/// Formats of Vulkan (registry `VkFormat`): number, storage, meaning of integers. `None`: the file states it.
const FORMATS: &[(u32, Texel, Option<Transfer>)] = &[
    (9, Texel::Bytes { size: 1, rgb: [0; 3] }, None),
    (15, Texel::Bytes { size: 1, rgb: [0; 3] }, Some(Transfer::Srgb)),
    (16, Texel::Bytes { size: 2, rgb: [0; 3] }, None),
    (22, Texel::Bytes { size: 2, rgb: [0; 3] }, Some(Transfer::Srgb)),
    (23, Texel::Bytes { size: 3, rgb: [0, 1, 2] }, None),
    (29, Texel::Bytes { size: 3, rgb: [0, 1, 2] }, Some(Transfer::Srgb)),
    (30, Texel::Bytes { size: 3, rgb: [2, 1, 0] }, None),
    (36, Texel::Bytes { size: 3, rgb: [2, 1, 0] }, Some(Transfer::Srgb)),
    (37, Texel::Bytes { size: 4, rgb: [0, 1, 2] }, None),
    (43, Texel::Bytes { size: 4, rgb: [0, 1, 2] }, Some(Transfer::Srgb)),
    (44, Texel::Bytes { size: 4, rgb: [2, 1, 0] }, None),
    (50, Texel::Bytes { size: 4, rgb: [2, 1, 0] }, Some(Transfer::Srgb)),
    (58, Texel::Masks { size: 4, masks: [0x3FF0_0000, 0xF_FC00, 0x3FF] }, None),
    (64, Texel::Masks { size: 4, masks: [0x3FF, 0xF_FC00, 0x3FF0_0000] }, None),
    (70, Texel::Shorts { channels: 1 }, None),
    (76, Texel::Halves { channels: 1 }, None),
    (84, Texel::Shorts { channels: 3 }, None),
    (90, Texel::Halves { channels: 3 }, None),
    (91, Texel::Shorts { channels: 4 }, None),
    (97, Texel::Halves { channels: 4 }, None),
    (100, Texel::Floats { channels: 1 }, None),
    (106, Texel::Floats { channels: 3 }, None),
    (109, Texel::Floats { channels: 4 }, None),
    (122, Texel::R11G11B10, None),
    (123, Texel::R9G9B9E5, None),
    (131, Texel::Block(Block::Bc1), None),
    (132, Texel::Block(Block::Bc1), Some(Transfer::Srgb)),
    (133, Texel::Block(Block::Bc1), None),
    (134, Texel::Block(Block::Bc1), Some(Transfer::Srgb)),
    (135, Texel::Block(Block::Bc2), None),
    (136, Texel::Block(Block::Bc2), Some(Transfer::Srgb)),
    (137, Texel::Block(Block::Bc3), None),
    (138, Texel::Block(Block::Bc3), Some(Transfer::Srgb)),
    (139, Texel::Block(Block::Bc4), None),
    (143, Texel::Block(Block::Bc6h { signed: false }), None),
    (144, Texel::Block(Block::Bc6h { signed: true }), None),
    (145, Texel::Block(Block::Bc7), None),
    (146, Texel::Block(Block::Bc7), Some(Transfer::Srgb)),
];

pub(super) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    let file = Bytes(bytes);
    let header = Header::read(file)?;
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let (texel, transfer) = header.texel(file, &mut notes)?;
    let faces = header.pictures(&mut notes)?;
    limits.pixels(header.width.into(), header.height.into(), faces as u64)?;
    let face_bytes = texel.bytes(header.width, header.height).ok_or_else(|| ImageError::new("it is too large"))?;
    let level = header.largest_level(file, face_bytes.saturating_mul(faces as u64))?;
    let read = |i: usize| {
        let face = usize::try_from(face_bytes).ok().and_then(|n| level.get(i.checked_mul(n)?..(i + 1).checked_mul(n)?));
        let face = face.ok_or_else(|| ImageError::new("its largest level is too short; the file is damaged"))?;
        texel.decode(face, (header.width, header.height), transfer, limits)
    };
    let mut pictures = (0..faces).map(read).collect::<Result<Vec<Image>, _>>()?;
    if texel.is_high_dynamic_range() {
        let mut all: Vec<&mut [_]> = pictures.iter_mut().map(|p| &mut p.pixels[..]).collect();
        tidy(&mut all, &mut warnings);
    }
    let shape = match <[Image; 6]>::try_from(pictures) {
        Ok(faces) => DecodedContent::Faces(Box::new(faces)),
        Err(pictures) => {
            let mut picture = pictures.into_iter().next().unwrap_or_default();
            header.put_upright(file, &mut picture, &mut notes)?;
            DecodedContent::Picture(picture)
        }
    };
    Ok(Decoded { shape, high_dynamic_range: texel.is_high_dynamic_range(), format: FileFormat::Ktx2, notes, warnings })
}

/// The numbers of the header that matter here.
struct Header {
    format: u32,
    width: u32,
    height: u32,
    depth: u32,
    layers: u32,
    faces: u32,
    levels: u32,
    packing: u32,
    /// The byte at which the data format descriptor begins.
    descriptor: usize,
    /// The position and length of keys and values, in bytes.
    key_values: (u32, u32),
}

impl Header {
    fn read(file: Bytes<'_>) -> Result<Self, ImageError> {
        Ok(Header {
            format: file.u32(12)?,
            width: file.u32(20)?,
            height: file.u32(24)?,
            depth: file.u32(28)?,
            layers: file.u32(32)?,
            faces: file.u32(36)?,
            levels: file.u32(40)?,
            packing: file.u32(44)?,
            descriptor: file.u32(48)? as usize,
            key_values: (file.u32(56)?, file.u32(60)?),
        })
    }

    /// Returns the texel format and the meaning of integers.
    fn texel(&self, file: Bytes<'_>, notes: &mut Vec<String>) -> Result<(Texel, Transfer), ImageError> {
        let known = FORMATS.iter().find(|(number, ..)| *number == self.format);
        let Some((_, texel, transfer)) = known else {
            return Err(ImageError::new(format!(
                "its pixels are {}, which is not decoded; convert it to R16G16B16A16_SFLOAT or R8G8B8A8_SRGB",
                self.format_name(file)
            )));
        };
        if let Some(transfer) = transfer {
            return Ok((*texel, *transfer));
        }
        // The descriptor's first block: the transfer function is its eleventh byte, after the total length.
        let stated = file.0.get(self.descriptor.saturating_add(14)).copied().unwrap_or(1);
        let transfer = if stated == 2 { Transfer::Srgb } else { Transfer::Linear };
        if transfer == Transfer::Linear && !texel.is_high_dynamic_range() {
            notes.push("the file declares its integers as linear light, and they are read as linear light".to_owned());
        }
        Ok((*texel, transfer))
    }

    fn format_name(&self, file: Bytes<'_>) -> String {
        match self.format {
            0 => match file.0.get(self.descriptor.saturating_add(12)) {
                Some(163) => "Basis Universal ETC1S".to_owned(),
                Some(166) => "Basis Universal UASTC".to_owned(),
                _ => "of no format that Vulkan knows".to_owned(),
            },
            141 | 142 => "BC5 (two channels)".to_owned(),
            147..=156 => "ETC2 or EAC".to_owned(),
            157..=184 | 1_000_066_000..=1_000_066_013 => "ASTC".to_owned(),
            other => format!("in the Vulkan format {other}"),
        }
    }

    /// Returns the number of pictures to read: 6, or 1 for a 2-D file.
    fn pictures(&self, notes: &mut Vec<String>) -> Result<usize, ImageError> {
        if self.depth > 0 || self.height == 0 {
            let kind = if self.depth > 0 { "a volume" } else { "one row of pixels (1-D)" };
            return Err(ImageError::new(format!("it holds {kind}: expected a cubemap or a 2-D picture")));
        }
        if self.layers > 1 {
            notes.push(format!("the file holds {} layers; the first is read", self.layers));
        }
        if self.levels > 1 {
            notes.push(format!("of {} mip levels the largest is read", self.levels));
        }
        match self.faces {
            1 => Ok(1),
            6 if self.width == self.height => Ok(6),
            6 => Err(ImageError::new(format!(
                "its faces are {} x {} pixels; faces must be square",
                self.width, self.height
            ))),
            n => Err(ImageError::new(format!("invalid number of faces {n}: expected 6 or 1"))),
        }
    }

    /// The largest level's first `needed` bytes or more, unpacked.
    fn largest_level<'a>(&self, file: Bytes<'a>, needed: u64) -> Result<Cow<'a, [u8]>, ImageError> {
        let part = "the largest level";
        let packed = file.part(file.u64(80)?, file.u64(88)?, part)?;
        let unpack = |reader: &mut dyn Read, how: &str| {
            // No more than is needed is unpacked, whatever the file states.
            let mut level = Vec::new();
            reader.take(needed).read_to_end(&mut level).map_err(|e| {
                ImageError::new(format!("its largest level cannot be unpacked ({how}: {e}); the file is damaged"))
            })?;
            Ok(Cow::Owned(level))
        };
        match self.packing {
            0 => Ok(Cow::Borrowed(packed)),
            2 => {
                let mut decoder = ruzstd::decoding::StreamingDecoder::new(packed).map_err(|e| {
                    ImageError::new(format!("its largest level is not valid Zstandard ({e}); the file is damaged"))
                })?;
                unpack(&mut decoder, "Zstandard")
            }
            3 => unpack(&mut flate2::read::ZlibDecoder::new(packed), "zlib"),
            1 => Err(ImageError::new(
                "its levels are compressed with Basis LZ, which is not supported; convert it with `ktx transcode`",
            )),
            n => Err(ImageError::new(format!(
                "its levels have the unknown supercompression scheme {n}; save it uncompressed or with Zstandard"
            ))),
        }
    }

    /// The value of a key among the metadata: each entry is its length, key, 0, value, and zeros up to a multiple of 4.
    fn value<'a>(&self, file: Bytes<'a>, key: &str) -> Result<Option<&'a [u8]>, ImageError> {
        let (start, length) = self.key_values;
        let mut rest = if length == 0 { &[][..] } else { file.part(start.into(), length.into(), "the metadata")? };
        while let Some((count, after)) = rest.split_first_chunk::<4>() {
            let count = u32::from_le_bytes(*count) as usize;
            let Some(entry) = after.get(..count) else { break };
            let mut halves = entry.splitn(2, |b| *b == 0);
            if halves.next() == Some(key.as_bytes()) {
                return Ok(halves.next());
            }
            rest = count.checked_next_multiple_of(4).and_then(|n| after.get(n..)).unwrap_or_default();
        }
        Ok(None)
    }

    /// A 2-D picture may be stored bottom up or right to left, as its metadata states; a cubemap may not.
    fn put_upright(&self, file: Bytes<'_>, image: &mut Image, notes: &mut Vec<String>) -> Result<(), ImageError> {
        let orientation = self.value(file, "KTXorientation")?.unwrap_or(b"rd");
        let width = image.width as usize;
        if orientation.first() == Some(&b'l') {
            image.pixels.chunks_exact_mut(width).for_each(<[_]>::reverse);
        }
        if orientation.get(1) == Some(&b'u') {
            let rows: Vec<_> = image.pixels.chunks_exact(width).rev().flatten().copied().collect();
            image.pixels = rows;
        }
        if orientation.first() == Some(&b'l') || orientation.get(1) == Some(&b'u') {
            notes.push("the pixels are stored in an unusual order and are put upright".to_owned());
        }
        Ok(())
    }
}
