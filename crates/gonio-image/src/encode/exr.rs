//! OpenEXR, ZIP-compressed in blocks of 16 scan lines.
//!
//! [`encode`] and [`encode_layers`] use the crate `exr`, which would add more to a web page than all other code that
//! saves files. [`encode_compact`] is a writer of our own, for 32-bit floats with premultiplied alpha. Source:
//! *Technical Introduction to OpenEXR* and *OpenEXR File Layout* (Kainz, Bogart, Stanczyk, Hillman; Academy Software
//! Foundation), with their ZIP compression: blocks of 16 lines, bytes split into first and second halves, differences,
//! zlib.

use super::{Encoded, beyond_half, half};
use crate::image::Image;
use crate::{ImageError, Pixel};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image as Exr, ImageAttributes, IntegerBounds, Layer as ExrLayer,
    LayerAttributes, Layers, SpecificChannels, Text, Vec2, WritableImage,
};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::{Cursor, Write};

/// The number format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ExrPrecision {
    /// 16 bits: three decimal digits, up to 65504.
    #[default]
    Half,
    /// 32 bits: as they are in memory.
    Float,
}

/// Encodes R, G and B of an image.
///
/// # Errors
///
/// An image without pixels.
pub fn encode(image: &Image, precision: ExrPrecision) -> Result<Encoded, ImageError> {
    let size = (image.width as usize, image.height as usize);
    if image.pixels.is_empty() {
        return Err(ImageError::new("a picture without pixels cannot be written as OpenEXR"));
    }
    let at = |x: usize, y: usize| {
        let [r, g, b, _] = image.pixels[y * size.0 + x];
        (r, g, b)
    };
    let encoding = Encoding::SMALL_LOSSLESS;
    let mut bytes = Vec::new();
    let to = Cursor::new(&mut bytes);
    let (done, warnings) = match precision {
        ExrPrecision::Float => {
            let mut file = Exr::from_channels(size, SpecificChannels::rgb(|Vec2(x, y)| at(x, y)));
            file.layer_data.encoding = encoding;
            (file.write().to_buffered(to), Vec::new())
        }
        ExrPrecision::Half => {
            let channels = SpecificChannels::rgb(|Vec2(x, y)| {
                let (r, g, b) = at(x, y);
                (half(r), half(g), half(b))
            });
            let mut file = Exr::from_channels(size, channels);
            file.layer_data.encoding = encoding;
            let warnings = beyond_half(&image.pixels, "write floats to keep them").into_iter().collect();
            (file.write().to_buffered(to), warnings)
        }
    };
    done.map_err(|e| failed(size, &e))?;
    Ok(Encoded { bytes, warnings })
}

fn failed((width, height): (usize, usize), error: &exr::error::Error) -> ImageError {
    ImageError::new(format!("a picture of {width} x {height} pixels cannot be written as OpenEXR: {error}"))
}

/// A layer: linear RGBA, alpha premultiplied as the format has it.
pub struct Layer<'a> {
    /// The layer's name in the file.
    pub name: &'a str,
    /// `width * height` pixels, first row the top one.
    pub pixels: &'a [Pixel],
}

/// Encodes layers of one size as 32-bit floats. Viewers that do not know layers show the first.
///
/// # Errors
///
/// No layers, layers without pixels, or layers of another size.
pub fn encode_layers([width, height]: [u32; 2], layers: &[Layer<'_>]) -> Result<Vec<u8>, ImageError> {
    let size = Vec2(width as usize, height as usize);
    if layers.is_empty() {
        return Err(ImageError::new("an OpenEXR file needs at least one layer"));
    }
    if size.area() == 0 || layers.iter().any(|layer| layer.pixels.len() != size.area()) {
        return Err(ImageError::new(format!(
            "a layer of an OpenEXR file does not have the {width} x {height} pixels of the picture"
        )));
    }
    let layers: Layers<AnyChannels<FlatSamples>> = layers.iter().map(|layer| float_layer(layer, size)).collect();
    let mut attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    attributes.pixel_aspect = 1.0;
    let mut file = Cursor::new(Vec::new());
    let done = Exr { attributes, layer_data: layers }.write().to_buffered(&mut file);
    done.map_err(|e| failed((size.0, size.1), &e))?;
    Ok(file.into_inner())
}

fn float_layer(layer: &Layer<'_>, size: Vec2<usize>) -> ExrLayer<AnyChannels<FlatSamples>> {
    let channel = |index: usize, name: &str| {
        AnyChannel::new(name, FlatSamples::F32(layer.pixels.iter().map(|p| p[index]).collect()))
    };
    let channels = [channel(0, "R"), channel(1, "G"), channel(2, "B"), channel(3, "A")];
    let mut attributes = LayerAttributes::named(layer.name);
    attributes.software_name = Some(Text::from("gonio"));
    ExrLayer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels.into_iter().collect()))
}

const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
/// Version 2, one part of scan lines, short names.
const VERSION: u32 = 2;
const ZIP: u8 = 3;
const LINES: usize = 16;
/// Channels in the order of the alphabet, as the format wants, and where each is in a pixel.
const CHANNELS: [(&[u8], usize); 4] = [(b"A", 3), (b"B", 2), (b"G", 1), (b"R", 0)];

/// Encodes linear RGBA, first row the top one.
///
/// # Errors
///
/// A picture without pixels, or with another number of pixels than its size needs.
pub fn encode_compact(size: [u32; 2], pixels: &[Pixel]) -> Result<Vec<u8>, ImageError> {
    let [width, height] = size.map(|side| side as usize);
    if width == 0 || height == 0 || pixels.len() != width * height {
        return Err(ImageError::new("a picture without pixels cannot be written as OpenEXR"));
    }
    let mut file = compact_header(size[0], size[1]);
    let blocks: Vec<Vec<u8>> = pixels.chunks(width * LINES).map(|lines| packed(lines, width)).collect();
    // Where each block begins, counted from the beginning of the file.
    let mut at = (file.len() + 8 * blocks.len()) as u64;
    for block in &blocks {
        file.extend(at.to_le_bytes());
        at += 8 + block.len() as u64;
    }
    for (index, block) in blocks.iter().enumerate() {
        file.extend(((index * LINES) as i32).to_le_bytes());
        file.extend((block.len() as i32).to_le_bytes());
        file.extend(block);
    }
    Ok(file)
}

fn compact_header(width: u32, height: u32) -> Vec<u8> {
    let mut file = MAGIC.to_vec();
    file.extend(VERSION.to_le_bytes());
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        file.extend(name.as_bytes());
        file.push(0);
        file.extend(kind.as_bytes());
        file.push(0);
        file.extend((value.len() as i32).to_le_bytes());
        file.extend(value);
    };
    let mut channels = Vec::new();
    for (name, _) in CHANNELS {
        channels.extend(name);
        channels.push(0);
        // FLOAT; not perceptually linear; a sample for every pixel.
        channels.extend(2_i32.to_le_bytes());
        channels.extend([0; 4]);
        channels.extend([1_i32.to_le_bytes(), 1_i32.to_le_bytes()].concat());
    }
    channels.push(0);
    let corner = |x: u32, y: u32| [(x as i32).to_le_bytes(), (y as i32).to_le_bytes()].concat();
    let window = [corner(0, 0), corner(width - 1, height - 1)].concat();
    attribute("channels", "chlist", &channels);
    attribute("compression", "compression", &[ZIP]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1_f32.to_le_bytes());
    attribute("software", "string", b"gonio");
    file.push(0);
    file
}

/// A block of lines, each channel of a line in one piece.
fn packed(lines: &[[f32; 4]], width: usize) -> Vec<u8> {
    let mut plain = Vec::with_capacity(lines.len() * 16);
    for line in lines.chunks(width) {
        for (_, channel) in CHANNELS {
            plain.extend(line.iter().flat_map(|pixel| pixel[channel].to_le_bytes()));
        }
    }
    let mut split: Vec<u8> = plain.iter().step_by(2).chain(plain.iter().skip(1).step_by(2)).copied().collect();
    let mut before = split.first().copied().unwrap_or(0);
    for byte in split.iter_mut().skip(1) {
        let difference = byte.wrapping_sub(before).wrapping_add(128);
        before = std::mem::replace(byte, difference);
    }
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    let zipped = encoder.write_all(&split).and_then(|()| encoder.finish()).unwrap_or_default();
    // A block that compression would enlarge is stored unchanged, which readers see by its size.
    if zipped.is_empty() || zipped.len() >= plain.len() { plain } else { zipped }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decode::{DecodedContent, decode};
    use crate::{DecodeLimits, Image};

    fn encoded(image: &Image) -> Result<Vec<u8>, ImageError> {
        encode_compact([image.width, image.height], &image.pixels)
    }

    fn round_trip(image: &Image) {
        let file = encoded(image).unwrap_or_else(|e| panic!("{e}"));
        // Read by the crate `exr`.
        let read =
            decode("a.exr", &file, &DecodeLimits { max_bytes: 1 << 24 }).unwrap_or_else(|e| panic!("{}", e.message));
        let DecodedContent::Picture(read) = read.shape else { panic!("not one picture") };
        assert_eq!((read.width, read.height), (image.width, image.height));
        for (read, written) in read.pixels.iter().zip(&image.pixels) {
            assert_eq!(read[..3], written[..3]);
        }
    }

    #[test]
    fn another_reader_reads_the_same_numbers() {
        // More than two blocks, the last not full.
        let mut image = Image::new(37, 40, [0.0; 4]);
        for (i, pixel) in image.pixels.iter_mut().enumerate() {
            *pixel = [i as f32 * 0.37, 1.0 / (1.0 + i as f32), if i % 7 == 0 { 30_000.0 } else { 0.125 }, 1.0];
        }
        round_trip(&image);
    }

    #[test]
    fn incompressible_pixels_are_stored() {
        let mut image = Image::new(16, 16, [0.0; 4]);
        let mut state = 1_u32;
        for value in image.pixels.iter_mut().flatten() {
            // The generator of Numerical Recipes: bits that no compression makes smaller.
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *value = f32::from_bits(state >> 2 & 0x3fff_ffff);
        }
        image.pixels.iter_mut().for_each(|pixel| pixel[3] = 1.0);
        round_trip(&image);
    }

    #[test]
    fn flat_pictures_are_small_and_empty_ones_an_error() {
        let flat = encoded(&Image::new(256, 256, [0.5, 0.25, 2.0, 1.0])).unwrap_or_else(|e| panic!("{e}"));
        // A megabyte of floats.
        assert!(flat.len() < 1 << 15, "{} bytes", flat.len());
        assert!(encoded(&Image::new(0, 4, [0.0; 4])).is_err());
    }
}
