//! PNG: grey, palette and RGB of 1 to 16 bits, taken as sRGB.

use super::{Decoded, DecodedContent, FileFormat};
use crate::srgb::{LINEAR_FROM_8, LINEAR_FROM_16};
use crate::{DecodeLimits, ImageError, Pixel};
use png::{BitDepth, DecodingError, Transformations};
use rayon::prelude::*;
use std::io::Cursor;

/// The first bytes of a PNG file.
pub(super) const MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Rows that are decoded before they are converted: few enough to stay in a cache, enough for all threads.
const BATCH: usize = 64;

/// Memory that the codec may take in any case.
const CODEC_BYTES: usize = 64 << 20;

pub(super) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    // What the codec itself takes: a few rows, metadata. The pixels are ours, and have their own limit.
    let codec_limit = usize::try_from(limits.max_bytes).unwrap_or(usize::MAX).max(CODEC_BYTES);
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: codec_limit });
    let (width, height) = decoder.read_header_info().map_err(failed)?.size();
    limits.pixels(width.into(), height.into(), 1)?;
    // Palettes and small depths become 8 bits, transparent colours alpha.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let mut reader = decoder.read_info().map_err(failed)?;
    let mut image = limits.unfilled(width, height)?;
    let (color, depth) = reader.output_color_type();
    let (notes, warnings) = remarks(reader.info(), color.samples() > 3 || color.samples() == 2);
    let convert = Converter { samples: color.samples(), wide: depth == BitDepth::Sixteen };

    let row_bytes = reader.output_line_size(width).ok_or_else(|| ImageError::new("its rows are too long"))?;
    if reader.info().interlaced {
        // The rows of a pass are no rows of the picture: all of it first.
        let size = row_bytes.checked_mul(height as usize).ok_or_else(|| ImageError::new("it is too large"))?;
        let mut all = vec![0; size];
        reader.next_frame(&mut all).map_err(failed)?;
        convert.rows(&all, &mut image.pixels);
    } else {
        let mut batch = vec![0; row_bytes * BATCH.min(height as usize)];
        let mut left = height as usize;
        while left > 0 {
            let rows = left.min(BATCH);
            for row in batch.chunks_exact_mut(row_bytes).take(rows) {
                if reader.read_row(row).map_err(failed)?.is_none() {
                    return Err(cut_off());
                }
            }
            convert.rows(&batch[..rows * row_bytes], &mut image.pixels);
            left -= rows;
        }
    }
    // To the end: a file that lacks only its last chunk is a file cut off.
    reader.finish().map_err(failed)?;
    Ok(Decoded {
        shape: DecodedContent::Picture(image),
        high_dynamic_range: false,
        format: FileFormat::Png,
        notes,
        warnings,
    })
}

/// Notes and warnings about statements of the file that are ignored.
fn remarks(info: &png::Info<'_>, has_alpha: bool) -> (Vec<String>, Vec<String>) {
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    if has_alpha {
        notes.push(super::ALPHA_IGNORED.to_owned());
    }
    if info.animation_control.is_some() {
        notes.push("the file is animated; its first picture is read".to_owned());
    }
    if let Some(points) = info.coding_independent_code_points
        && !matches!(points.transfer_function, 1 | 6 | 13..=15)
    {
        let which = match points.transfer_function {
            8 => "linear light".to_owned(),
            16 => "PQ".to_owned(),
            18 => "HLG".to_owned(),
            other => format!("transfer function {other}"),
        };
        warnings.push(format!("the file is encoded as {which}; it is read as sRGB, so its light is wrong"));
    } else if info.srgb.is_none() && info.icc_profile.is_some() {
        notes.push("the colour profile in the file is ignored; colours are read as sRGB".to_owned());
    } else if let (None, Some(gamma)) = (info.srgb, info.gama_chunk) {
        // Writers use 1/2.2 for sRGB; a few percent beside it mean the same.
        let gamma = gamma.into_value();
        if (gamma - 0.45455).abs() > 0.02 {
            warnings.push(format!("the file has gamma {gamma:.3}; it is read as sRGB, so its light is wrong"));
        }
    }
    (notes, warnings)
}

struct Converter {
    /// 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA.
    samples: usize,
    /// 16 bits a sample, the high byte first.
    wide: bool,
}

impl Converter {
    /// Appends whole rows as linear pixels.
    fn rows(&self, bytes: &[u8], pixels: &mut Vec<Pixel>) {
        match (self.wide, self.samples) {
            (false, samples) => {
                let table = &*LINEAR_FROM_8;
                let light = |b: u8| table[usize::from(b)];
                match samples {
                    1 => append::<1>(bytes, pixels, |[v]| [light(v), light(v), light(v)]),
                    2 => append::<2>(bytes, pixels, |[v, _]| [light(v), light(v), light(v)]),
                    3 => append::<3>(bytes, pixels, |[r, g, b]| [light(r), light(g), light(b)]),
                    _ => append::<4>(bytes, pixels, |[r, g, b, _]| [light(r), light(g), light(b)]),
                }
            }
            (true, samples) => {
                let table = &**LINEAR_FROM_16;
                let light = |high: u8, low: u8| table[usize::from(u16::from_be_bytes([high, low]))];
                match samples {
                    1 => append::<2>(bytes, pixels, |[a, b]| [light(a, b); 3]),
                    2 => append::<4>(bytes, pixels, |[a, b, ..]| [light(a, b); 3]),
                    3 => append::<6>(bytes, pixels, |[a, b, c, d, e, f]| [light(a, b), light(c, d), light(e, f)]),
                    _ => append::<8>(bytes, pixels, |[a, b, c, d, e, f, ..]| [light(a, b), light(c, d), light(e, f)]),
                }
            }
        }
    }
}

/// Appends pixels of `N` bytes.
fn append<const N: usize>(bytes: &[u8], pixels: &mut Vec<Pixel>, convert: impl Fn([u8; N]) -> [f32; 3] + Sync + Send) {
    // Written once, in place: a picture is more memory than all caches.
    pixels.par_extend(bytes.as_chunks::<N>().0.par_iter().with_min_len(1 << 13).map(|from| {
        let [r, g, b] = convert(*from);
        [r, g, b, 1.0]
    }));
}

fn failed(error: DecodingError) -> ImageError {
    match error {
        DecodingError::IoError(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => cut_off(),
        DecodingError::LimitsExceeded => {
            ImageError::new("decoding this PNG takes more memory than the limit; make the picture smaller")
        }
        DecodingError::Format(e) if e.to_string().contains("nexpected end") => cut_off(),
        error => ImageError::new(format!("this PNG is damaged ({error}); get it again")),
    }
}

fn cut_off() -> ImageError {
    ImageError::new("this PNG ends before the picture is whole; get it again")
}
