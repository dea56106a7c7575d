//! JPEG, taken as sRGB.

use super::{Decoded, DecodedContent, FileFormat};
use crate::srgb::LINEAR_FROM_8;
use crate::{DecodeLimits, ImageError};
use rayon::prelude::*;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// The first bytes of a JPEG file.
pub(super) const MAGIC: &[u8] = &[0xFF, 0xD8, 0xFF];

/// The end marker, which other data may follow.
const END: [u8; 2] = [0xFF, 0xD9];

pub(super) fn decode(bytes: &[u8], limits: &DecodeLimits) -> Result<Decoded, ImageError> {
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        // What cannot be decoded is an error, not grey.
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(failed)?;
    let info = decoder.info().ok_or_else(cut_off)?;
    let mut image = limits.unfilled(info.width.into(), info.height.into())?;
    let mut notes = Vec::new();
    let mut warnings = Vec::new();
    if decoder.input_colorspace().is_some_and(|c| matches!(c, ColorSpace::CMYK | ColorSpace::YCCK)) {
        notes.push("the colours are CMYK and become RGB without a colour profile".to_owned());
    } else if decoder.icc_profile().is_some() {
        notes.push("the colour profile in the file is ignored; colours are read as sRGB".to_owned());
    }
    if let Some(turn) = decoder.exif().and_then(|e| orientation(e)).filter(|t| *t != 1) {
        warnings.push(format!(
            "the EXIF orientation {turn} of the camera is ignored; if the picture is not upright, rotate and save it"
        ));
    }
    // The codec fills in what a file lacks at its end; a whole file has its end marker.
    if !has_end(bytes) {
        return Err(cut_off());
    }
    let rgb = decoder.decode().map_err(failed)?;
    let width = usize::from(info.width);
    let height = usize::from(info.height);
    if decoder.output_colorspace() != Some(ColorSpace::RGB) || rgb.len() != 3 * width * height {
        return Err(ImageError::new("this JPEG's colours are of an unusual kind; save it again as RGB"));
    }
    let table = &*LINEAR_FROM_8;
    let light = |b: u8| table[usize::from(b)];
    // Written once, in place: a picture is more memory than all caches.
    image.pixels.par_extend(
        rgb.as_chunks::<3>().0.par_iter().with_min_len(1 << 13).map(|[r, g, b]| [light(*r), light(*g), light(*b), 1.0]),
    );
    Ok(Decoded {
        shape: DecodedContent::Picture(image),
        high_dynamic_range: false,
        format: FileFormat::Jpeg,
        notes,
        warnings,
    })
}

/// Whether the end marker comes after the beginning of the pixels. A small picture in the header has its own.
fn has_end(bytes: &[u8]) -> bool {
    let mut at = 2;
    // Segments have a marker of two bytes and a length that counts itself; the scan begins at FF DA.
    while let Some(&[0xFF, marker, high, low]) = bytes.get(at..at + 4) {
        if marker == 0xDA {
            return bytes[at..].windows(2).any(|w| w == END);
        }
        // FF may be repeated before a marker.
        at += if marker == 0xFF { 1 } else { 2 + usize::from(u16::from_be_bytes([high, low])) };
    }
    // No such chain of segments: the codec found its way all the same, so any end will do.
    bytes.windows(2).any(|w| w == END)
}

/// EXIF's orientation, 1 to 8: tag 0x0112 of the first directory (CIPA DC-008, 4.6.4). `None` where there is none.
fn orientation(exif: &[u8]) -> Option<u16> {
    let exif = exif.strip_prefix(b"Exif\0\0").unwrap_or(exif);
    let big = exif.starts_with(b"MM");
    let u16_at = |at: usize| -> Option<u16> {
        let two: [u8; 2] = exif.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if big { u16::from_be_bytes(two) } else { u16::from_le_bytes(two) })
    };
    let (a, b) = (usize::from(u16_at(4)?), usize::from(u16_at(6)?));
    let directory = if big { (a << 16) | b } else { (b << 16) | a };
    let count = usize::from(u16_at(directory)?);
    (0..count).map(|i| directory + 2 + 12 * i).find(|entry| u16_at(*entry) == Some(0x0112)).and_then(|e| u16_at(e + 8))
}

fn failed(error: DecodeErrors) -> ImageError {
    match error {
        DecodeErrors::ExhaustedData => cut_off(),
        error => ImageError::new(format!("this JPEG is damaged ({}); get it again", one_line(&format!("{error:?}")))),
    }
}

/// The codec's words without line breaks, which have no place in a sentence.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn cut_off() -> ImageError {
    ImageError::new("this JPEG ends before the picture is whole; get it again")
}
