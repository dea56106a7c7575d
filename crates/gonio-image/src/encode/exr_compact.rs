//! OpenEXR by a writer of its own: scan lines of 32-bit floats, ZIP-compressed, alpha premultiplied as the format has it.
//!
//! The writer of the crate `exr`, which [`super::exr`] uses, would add more to a web page than all other code that saves
//! files. Source: *Technical Introduction to OpenEXR* and *OpenEXR File Layout* (Kainz, Bogart, Stanczyk, Hillman;
//! Academy Software Foundation), with their ZIP compression: blocks of 16 lines, bytes split into first and second
//! halves, differences, zlib.

use crate::{ImageError, Pixel};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

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
pub fn encode(size: [u32; 2], pixels: &[Pixel]) -> Result<Vec<u8>, ImageError> {
    let [width, height] = size.map(|side| side as usize);
    if width == 0 || height == 0 || pixels.len() != width * height {
        return Err(ImageError::new("a picture without pixels cannot be written as OpenEXR"));
    }
    let mut file = header(size[0], size[1]);
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

fn header(width: u32, height: u32) -> Vec<u8> {
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
    // What packing makes larger is stored as it is, unsplit: so readers tell by the size.
    if zipped.is_empty() || zipped.len() >= plain.len() { plain } else { zipped }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decode::{Shape, decode};
    use crate::{Image, Limits};

    fn encoded(image: &Image) -> Result<Vec<u8>, ImageError> {
        encode([image.width, image.height], &image.pixels)
    }

    fn round_trip(image: &Image) {
        let file = encoded(image).unwrap_or_else(|e| panic!("{e}"));
        // Read by the crate `exr`.
        let read = decode("a.exr", &file, &Limits { max_bytes: 1 << 24 }).unwrap_or_else(|e| panic!("{}", e.message));
        let Shape::Picture(read) = read.shape else { panic!("not one picture") };
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
    fn what_cannot_be_packed_is_stored() {
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
