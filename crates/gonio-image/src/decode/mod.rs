//! Decoding of image files to linear light.
//!
//! The format of a file is detected by its content, never by its name. Colours of 8 and 16 bits are sRGB and are decoded;
//! floats are linear light, in which NaN and negative numbers become 0 and infinite ones 65504. Alpha is ignored.
//!
//! | format | supported |
//! |---|---|
//! | PNG, JPEG | everything that the formats hold, as sRGB |
//! | Radiance `.hdr` | RGBE in all packings and all eight orders of pixels; exposure and colour correction taken back |
//! | OpenEXR | half, float and integer; scan lines and tiles, the largest level; R G B, a layer's, or Y |
//! | KTX2 | cubemaps and 2-D; 8 and 16 bits, half, float, R11G11B10, RGB9E5, BC1 to BC4, BC6H, BC7; zlib, Zstandard |
//! | DDS | cubemaps and 2-D, old and DX10 headers; the same, and colours by masks |

mod dds;
mod exr;
mod hdr;
mod jpeg;
mod ktx2;
mod png;
mod texel;

use crate::{DecodeLimits, Image, ImageError, Pixel};
pub(crate) use ktx2::MAGIC as KTX2_MAGIC;
use rayon::prelude::*;

/// The note about every file with alpha.
const ALPHA_IGNORED: &str = "alpha is ignored";

/// The content of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum DecodedContent {
    /// One picture: a face, a panorama, a cross, a strip.
    Picture(Image),
    /// The six faces of a cubemap in the order +X, -X, +Y, -Y, +Z, -Z: square, of one size, and by the formats'
    /// specifications in OpenGL's layout.
    Faces(Box<[Image; 6]>),
}

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// PNG.
    Png,
    /// JPEG.
    Jpeg,
    /// Radiance's `.hdr`.
    Hdr,
    /// OpenEXR.
    Exr,
    /// Khronos's KTX, version 2.
    Ktx2,
    /// Microsoft's DirectDraw surface.
    Dds,
}

impl FileFormat {
    /// Returns the name for reports.
    pub fn name(self) -> &'static str {
        match self {
            FileFormat::Png => "PNG",
            FileFormat::Jpeg => "JPEG",
            FileFormat::Hdr => "Radiance HDR",
            FileFormat::Exr => "OpenEXR",
            FileFormat::Ktx2 => "KTX2",
            FileFormat::Dds => "DDS",
        }
    }

    /// Detects the format by the first bytes of a file; `None` for unsupported formats.
    pub fn detect(bytes: &[u8]) -> Option<FileFormat> {
        let kinds = [
            (png::MAGIC, FileFormat::Png),
            (jpeg::MAGIC, FileFormat::Jpeg),
            (hdr::MAGIC, FileFormat::Hdr),
            (exr::MAGIC, FileFormat::Exr),
            (ktx2::MAGIC, FileFormat::Ktx2),
            (dds::MAGIC, FileFormat::Dds),
        ];
        kinds.into_iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, format)| format)
    }
}

/// A decoded file.
#[derive(Clone, Debug, PartialEq)]
pub struct Decoded {
    /// Linear light; every number is finite and at least 0, and the fourth of every pixel is 1.
    pub shape: DecodedContent,
    /// Whether the file can hold light beyond 1: floats, half floats, RGBE.
    pub high_dynamic_range: bool,
    /// The format of the file.
    pub format: FileFormat,
    /// Notes on choices that do not change the light. Sentences without final full stop.
    pub notes: Vec<String>,
    /// Warnings about light that may differ from what was meant.
    pub warnings: Vec<String>,
}

/// Decodes a file. `name` is its name in errors; its format is detected by its content.
///
/// # Errors
///
/// An unsupported format or variant (the message names a format to convert it to); a file that is cut off or damaged; a
/// size beyond `limits`, before anything is allocated.
pub fn decode(name: &str, bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    let decode = match FileFormat::detect(bytes) {
        Some(FileFormat::Png) => png::decode,
        Some(FileFormat::Jpeg) => jpeg::decode,
        Some(FileFormat::Hdr) => hdr::decode,
        Some(FileFormat::Exr) => exr::decode,
        Some(FileFormat::Ktx2) => ktx2::decode,
        Some(FileFormat::Dds) => dds::decode,
        None => return Err(unknown(bytes).in_file(name)),
    };
    decode(bytes, limits).map_err(|e| e.in_file(name))
}

/// The error for an unsupported format.
fn unknown(bytes: &[u8]) -> ImageError {
    const READ: &str = "PNG, JPEG, Radiance .hdr, OpenEXR, KTX2 and DDS are read";
    if bytes.is_empty() {
        return ImageError::new("the file is empty; get it again");
    }
    // (offset, bytes, description)
    const OTHERS: &[(usize, &[u8], &str)] = &[
        (0, b"\xABKTX 11\xBB", "a KTX file of version 1"),
        (8, b"WEBP", "a WebP picture"),
        (0, b"GIF8", "a GIF"),
        (0, b"BM", "a Windows bitmap"),
        (0, b"II*\0", "a TIFF picture"),
        (0, b"MM\0*", "a TIFF picture"),
        (4, b"ftypavif", "an AVIF picture"),
        (4, b"ftyphei", "a HEIF picture"),
        (4, b"JXL ", "a JPEG XL picture"),
        (0, b"\xFF\x0A", "a JPEG XL picture"),
        (4, b"jP  ", "a JPEG 2000 picture"),
        (0, b"8BPS", "a Photoshop document"),
        (0, b"PF\n", "a portable float map"),
        (0, b"Pf\n", "a portable float map"),
        (0, b"P6", "a portable pixmap"),
        (0, b"version https://git-lfs", "a pointer of Git LFS and not the file itself (type: git lfs pull)"),
    ];
    let other = OTHERS.iter().find(|(at, magic, _)| bytes.get(*at..).is_some_and(|b| b.starts_with(magic)));
    match other {
        Some((_, _, description)) => ImageError::new(format!("this is {description}; {READ}")),
        None => ImageError::new(format!("this is not a known picture format; {READ}")),
    }
}

/// A file's bytes; every access is checked.
#[derive(Clone, Copy)]
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    /// `length` bytes from `start` on, or an error that names the missing part of the file.
    fn part(&self, start: u64, length: u64, what: &str) -> Result<&'a [u8], ImageError> {
        let range = usize::try_from(start).ok().zip(start.checked_add(length).and_then(|e| usize::try_from(e).ok()));
        range.and_then(|(start, end)| self.0.get(start..end)).ok_or_else(|| {
            ImageError::new(format!(
                "{what} should be the {length} bytes from byte {start} on, but the file has only {}; it is cut off or \
                 damaged, get it again",
                self.0.len()
            ))
        })
    }

    /// The little-endian 32-bit number at a byte.
    fn u32(&self, at: usize) -> Result<u32, ImageError> {
        let part = self.part(at as u64, 4, "the header")?;
        Ok(u32::from_le_bytes(part.try_into().unwrap_or_default()))
    }

    /// The little-endian 64-bit number at a byte.
    fn u64(&self, at: usize) -> Result<u64, ImageError> {
        let part = self.part(at as u64, 8, "the header")?;
        Ok(u64::from_le_bytes(part.try_into().unwrap_or_default()))
    }
}

/// Infinite light becomes this: the largest half float, which every GPU holds.
pub const INFINITE_LIGHT: f32 = 65504.0;

/// Makes NaN and negative numbers 0 and infinite ones [`INFINITE_LIGHT`], sets the fourth number of every pixel to 1,
/// and counts them in one warning each.
fn tidy(pictures: &mut [&mut [Pixel]], warnings: &mut Vec<String>) {
    let mut counts = [0_usize; 3];
    for pixels in pictures {
        let add = |a: [usize; 3], b: [usize; 3]| std::array::from_fn(|i| a[i] + b[i]);
        let here = pixels.par_chunks_mut(1 << 14).map(tidy_chunk).reduce(|| [0; 3], add);
        counts = add(counts, here);
    }
    let [nan, infinite, negative] = counts;
    let mut warn = |count: usize, what: &str, now: &str| match count {
        0 => {}
        1 => warnings.push(format!("one number is {what} and counts as {now}")),
        n => warnings.push(format!("{n} numbers are {what} and count as {now}")),
    };
    warn(nan, "NaN", "0");
    warn(infinite, "infinite", &INFINITE_LIGHT.to_string());
    warn(negative, "negative", "0");
}

fn tidy_chunk(pixels: &mut [Pixel]) -> [usize; 3] {
    let [mut nan, mut infinite, mut negative] = [0; 3];
    for pixel in pixels {
        for x in &mut pixel[..3] {
            // One comparison for almost every number; -0 is as good as 0.
            if *x >= 0.0 && *x < f32::INFINITY {
                continue;
            }
            if x.is_nan() {
                nan += 1;
                *x = 0.0;
            } else if *x > 0.0 {
                infinite += 1;
                *x = INFINITE_LIGHT;
            } else {
                negative += 1;
                *x = 0.0;
            }
        }
        pixel[3] = 1.0;
    }
    [nan, infinite, negative]
}
