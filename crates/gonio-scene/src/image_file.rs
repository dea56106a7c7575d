//! Picture files, decoded to RGBA bytes.

use image::{ColorType, DynamicImage, ImageDecoder, ImageReader, Limits};
use std::io::Cursor;

/// Most texels along one side of a texture: what OpenGL drivers commonly have.
pub const MAX_TEXTURE_SIDE: u32 = 16384;
/// Most bytes that decoding one picture may take.
const MAX_DECODED_BYTES: u64 = 1 << 30;

/// A decoded picture, first row the top one.
#[derive(Clone, Debug)]
pub(crate) struct Decoded {
    pub width: u32,
    pub height: u32,
    pub rgba: Vec<u8>,
    /// Whether the file has an alpha channel (and not only 255 in it).
    pub has_alpha: bool,
}

/// A reader for the format that the content shows, or the name's extension if the content shows none (TGA).
fn reader<'a>(bytes: &'a [u8], name: &str) -> Result<ImageReader<Cursor<&'a [u8]>>, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|e| e.to_string())?;
    if reader.format().is_none()
        && let Ok(format) = image::ImageFormat::from_path(name)
    {
        reader.set_format(format);
    }
    Ok(reader)
}

/// Bytes that decoding takes according to the file's header, both during decoding and afterwards; `None` if the header
/// cannot be read, or exceeds what [`decode`] accepts from any file.
pub(crate) fn memory(bytes: &[u8], name: &str) -> Option<u64> {
    let decoder = reader(bytes, name).ok()?.into_decoder().ok()?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > MAX_TEXTURE_SIDE || decoder.total_bytes() > MAX_DECODED_BYTES {
        return None;
    }
    let rgba = 4 * u64::from(width) * u64::from(height);
    // Other pixels are decoded first, and then turned into RGBA.
    Some(if decoder.color_type() == ColorType::Rgba8 { rgba } else { decoder.total_bytes() + rgba })
}

/// Width and height of a picture file by its header; `None` if that cannot be read.
pub fn picture_size(bytes: &[u8], name: &str) -> Option<[u32; 2]> {
    let (width, height) = reader(bytes, name).ok()?.into_decoder().ok()?.dimensions();
    Some([width, height])
}

/// Decodes a picture in the format that its content shows, or its name's extension if the content shows none (TGA).
pub(crate) fn decode(bytes: &[u8], name: &str) -> Result<Decoded, String> {
    if bytes.is_empty() {
        return Err("the file is empty".into());
    }
    let mut reader = reader(bytes, name)?;
    if reader.format().is_none() {
        return Err("unknown picture format; PNG, JPEG, BMP, TGA and GIF can be read".into());
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_TEXTURE_SIDE);
    limits.max_image_height = Some(MAX_TEXTURE_SIDE);
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(sentence)?;
    let color = decoder.color_type();
    let picture = DynamicImage::from_decoder(decoder).map_err(sentence)?;
    let (width, height) = (picture.width(), picture.height());
    if width == 0 || height == 0 {
        return Err("the picture has no texels".into());
    }
    let rgba = picture.into_rgba8().into_raw();
    let has_alpha = color.has_alpha() && rgba.as_chunks::<4>().0.iter().any(|t| t[3] != 255);
    Ok(Decoded { width, height, rgba, has_alpha })
}

fn sentence(error: image::ImageError) -> String {
    match error {
        image::ImageError::Limits(_) => format!(
            "the picture is too large; at most {MAX_TEXTURE_SIDE} x {MAX_TEXTURE_SIDE} texels and \
             {} MiB are read",
            MAX_DECODED_BYTES >> 20
        ),
        image::ImageError::Unsupported(e) => format!("this picture cannot be read: {e}"),
        other => format!("the picture is damaged: {other}"),
    }
}
