//! DDS: cubemaps and 2-D pictures as DirectX takes them.
//!
//! Source: Microsoft, *DDS file layout for cubic environment maps* and *DDS_HEADER_DXT10*. Faces are stored in the order
//! +X -X +Y -Y +Z -Z, each followed by its mip levels; Direct3D's faces are laid as OpenGL's are.

use super::texel::{Block, Texel, Transfer};
use super::{Bytes, Decoded, DecodedContent, FileFormat, tidy};
use crate::image::Image;
use crate::{DecodeLimits, ImageError};

/// The first bytes of a DDS file.
pub(super) const MAGIC: &[u8] = b"DDS ";

// Flags of the pixel format and of `caps2`.
const ALPHA: u32 = 0x1;
const FOUR_CC: u32 = 0x4;
const LUMINANCE: u32 = 0x2_0000;
const RGB: u32 = 0x40;
const CUBEMAP: u32 = 0x200;
const FIRST_FACE: u32 = 0x400;
/// The faces in the order of their bits.
const FACE_NAMES: [&str; 6] = ["posx", "negx", "posy", "negy", "posz", "negz"];
const VOLUME: u32 = 0x20_0000;

/// A DX10 header: its dimension for pictures, its flag for cubemaps.
const TEXTURE_2D: u32 = 3;
const TEXTURE_CUBE: u32 = 0x4;

pub(super) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    let file = Bytes(bytes);
    let header = Header::read(file)?;
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let faces = if header.is_cubemap { 6 } else { 1 };
    limits.pixels(header.width.into(), header.height.into(), faces)?;
    let texel = header.texel;
    let size =
        |level: u32| texel.bytes((header.width >> level.min(31)).max(1), (header.height >> level.min(31)).max(1));
    let too_large = || ImageError::new("it is too large");
    let face_bytes = size(0).ok_or_else(too_large)?;
    // Where a face begins: after the one before it and all of its levels.
    let stride = (0..header.levels.clamp(1, 32)).try_fold(0_u64, |sum, level| sum.checked_add(size(level)?));
    let stride = stride.ok_or_else(too_large)?;
    let mut pictures = Vec::new();
    for i in 0..faces {
        let start = i.checked_mul(stride).and_then(|s| s.checked_add(header.data)).ok_or_else(too_large)?;
        let face = file.part(start, face_bytes, "the pixels")?;
        pictures.push(texel.decode(face, (header.width, header.height), Transfer::Srgb, limits)?);
    }
    if texel.is_high_dynamic_range() {
        let mut all: Vec<&mut [_]> = pictures.iter_mut().map(|p| &mut p.pixels[..]).collect();
        tidy(&mut all, &mut warnings);
    } else if !header.says_srgb {
        notes.push("the format does not state how colours are encoded; they are read as sRGB".to_owned());
    }
    if header.levels > 1 {
        notes.push(format!("of {} mip levels the largest is read", header.levels));
    }
    if header.has_alpha {
        notes.push(super::ALPHA_IGNORED.to_owned());
    }
    if header.layers > 1 {
        notes.push(format!("the file holds {} layers; the first is read", header.layers));
    }
    let shape = match <[Image; 6]>::try_from(pictures) {
        Ok(faces) => DecodedContent::Faces(Box::new(faces)),
        Err(pictures) => DecodedContent::Picture(pictures.into_iter().next().unwrap_or_default()),
    };
    Ok(Decoded { shape, high_dynamic_range: texel.is_high_dynamic_range(), format: FileFormat::Dds, notes, warnings })
}

struct Header {
    width: u32,
    height: u32,
    levels: u32,
    layers: u32,
    is_cubemap: bool,
    texel: Texel,
    says_srgb: bool,
    has_alpha: bool,
    /// The byte at which pixels begin.
    data: u64,
}

impl Header {
    fn read(file: Bytes<'_>) -> Result<Self, ImageError> {
        let (height, width, levels) = (file.u32(12)?, file.u32(16)?, file.u32(28)?);
        let (flags, four_cc) = (file.u32(80)?, file.u32(84)?.to_le_bytes());
        let caps2 = file.u32(112)?;
        let is_new = flags & FOUR_CC != 0 && four_cc == *b"DX10";
        let mut header = Header {
            width,
            height,
            levels: levels.max(1),
            layers: 1,
            is_cubemap: caps2 & CUBEMAP != 0,
            texel: Texel::R11G11B10,
            says_srgb: false,
            has_alpha: flags & ALPHA != 0,
            data: if is_new { 148 } else { 128 },
        };
        let is_picture = if is_new {
            let (format, dimension, misc, layers) = (file.u32(128)?, file.u32(132)?, file.u32(136)?, file.u32(140)?);
            header.layers = layers;
            header.is_cubemap = misc & TEXTURE_CUBE != 0;
            (header.texel, header.says_srgb) = dxgi(format)?;
            dimension == TEXTURE_2D
        } else {
            header.texel = legacy(file, flags, four_cc)?;
            caps2 & VOLUME == 0
        };
        if !is_picture {
            return Err(ImageError::new("it holds a volume or one row: expected a cubemap or a 2-D picture"));
        }
        if header.is_cubemap && width != height {
            return Err(ImageError::new(format!("its faces are {width} x {height} pixels; faces must be square")));
        }
        let missing: Vec<&str> = FACE_NAMES
            .into_iter()
            .enumerate()
            .filter(|(face, _)| !is_new && header.is_cubemap && caps2 & (FIRST_FACE << face) == 0)
            .map(|(_, name)| name)
            .collect();
        if !missing.is_empty() {
            return Err(ImageError::new(format!(
                "the cubemap lacks {}; save it with all six faces",
                missing.join(", ")
            )));
        }
        Ok(header)
    }
}

/// The pixels of a header without DX10's extension.
fn legacy(file: Bytes<'_>, flags: u32, four_cc: [u8; 4]) -> Result<Texel, ImageError> {
    if flags & FOUR_CC != 0 {
        return Ok(match &four_cc {
            b"DXT1" => Texel::Block(Block::Bc1),
            // The even ones differ in colours that are multiplied by alpha already.
            b"DXT2" | b"DXT3" => Texel::Block(Block::Bc2),
            b"DXT4" | b"DXT5" => Texel::Block(Block::Bc3),
            b"ATI1" | b"BC4U" => Texel::Block(Block::Bc4),
            // Numbers of Direct3D 9's formats.
            &[36, 0, 0, 0] => Texel::Shorts { channels: 4 },
            &[111, 0, 0, 0] => Texel::Halves { channels: 1 },
            &[113, 0, 0, 0] => Texel::Halves { channels: 4 },
            &[114, 0, 0, 0] => Texel::Floats { channels: 1 },
            &[116, 0, 0, 0] => Texel::Floats { channels: 4 },
            other => {
                let name: String = other.iter().map(|b| if b.is_ascii_graphic() { *b as char } else { '?' }).collect();
                let number = u32::from_le_bytes(*other);
                return Err(not_decoded(&format!("`{name}` (format {number})")));
            }
        });
    }
    let bits = file.u32(88)?;
    let masks = [file.u32(92)?, file.u32(96)?, file.u32(100)?];
    let size = match bits {
        8 | 16 | 24 | 32 => bits as usize / 8,
        _ => return Err(not_decoded(&format!("{bits} bits a pixel"))),
    };
    if masks == [0xFF, 0xFF00, 0xFF_0000] && size >= 3 {
        return Ok(Texel::Bytes { size, rgb: [0, 1, 2] });
    }
    if masks == [0xFF_0000, 0xFF00, 0xFF] && size >= 3 {
        return Ok(Texel::Bytes { size, rgb: [2, 1, 0] });
    }
    // One channel alone is grey, whether the flags call it luminance or (as some writers do) colour.
    if flags & (RGB | LUMINANCE) != 0 && masks[0] != 0 && masks[1..] == [0, 0] {
        return Ok(Texel::Masks { size, masks: [masks[0]; 3] });
    }
    if flags & RGB != 0 && masks.iter().any(|m| *m != 0) {
        return Ok(Texel::Masks { size, masks });
    }
    Err(not_decoded("neither colours nor grey (YUV, alpha alone, bumps?)"))
}

/// A format of DXGI, and whether it is an sRGB format.
fn dxgi(format: u32) -> Result<(Texel, bool), ImageError> {
    let rgba = |rgb| Texel::Bytes { size: 4, rgb };
    let texel = match format {
        2 => Texel::Floats { channels: 4 },
        6 => Texel::Floats { channels: 3 },
        10 => Texel::Halves { channels: 4 },
        11 => Texel::Shorts { channels: 4 },
        24 => Texel::Masks { size: 4, masks: [0x3FF, 0xF_FC00, 0x3FF0_0000] },
        26 => Texel::R11G11B10,
        28 | 29 => rgba([0, 1, 2]),
        41 => Texel::Floats { channels: 1 },
        54 => Texel::Halves { channels: 1 },
        56 => Texel::Shorts { channels: 1 },
        61 => Texel::Bytes { size: 1, rgb: [0; 3] },
        67 => Texel::R9G9B9E5,
        71 | 72 => Texel::Block(Block::Bc1),
        74 | 75 => Texel::Block(Block::Bc2),
        77 | 78 => Texel::Block(Block::Bc3),
        80 => Texel::Block(Block::Bc4),
        85 => Texel::Masks { size: 2, masks: [0xF800, 0x7E0, 0x1F] },
        86 => Texel::Masks { size: 2, masks: [0x7C00, 0x3E0, 0x1F] },
        87 | 88 | 91 | 93 => rgba([2, 1, 0]),
        95 => Texel::Block(Block::Bc6h { signed: false }),
        96 => Texel::Block(Block::Bc6h { signed: true }),
        98 | 99 => Texel::Block(Block::Bc7),
        115 => Texel::Masks { size: 2, masks: [0xF00, 0xF0, 0xF] },
        83 | 84 => return Err(not_decoded("BC5 (two channels)")),
        other => return Err(not_decoded(&format!("in the DXGI format {other}"))),
    };
    Ok((texel, matches!(format, 29 | 72 | 75 | 78 | 91 | 93 | 99)))
}

fn not_decoded(what: &str) -> ImageError {
    ImageError::new(format!(
        "its pixels are {what}, which is not decoded; convert it to R16G16B16A16_FLOAT, BC7 or uncompressed RGBA"
    ))
}
