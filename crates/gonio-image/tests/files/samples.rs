//! Pictures to write, and small files of every kind.

use gonio_image::decode::{Decoded, DecodedContent};
use gonio_image::encode::exr::ExrPrecision;
use gonio_image::encode::ktx2::{Ktx2Format, Level};
use gonio_image::{DecodeLimits, Image, Pixel, decode, encode};
use gonio_light::color::OutputTransform;

/// A picture of which every pixel is another, with light from 0 to 12.
pub fn bright(width: u32, height: u32) -> Image {
    let mut image = Image::new(width, height, [0.0; 4]);
    for y in 0..height {
        for x in 0..width {
            let (x_share, y_share) = (x as f32 / width as f32, y as f32 / height as f32);
            image.pixels[(y * width + x) as usize] = [12.0 * x_share * x_share, y_share, 0.25 + x_share * y_share, 1.0];
        }
    }
    image
}

/// A level of a cubemap: six faces one after the other.
#[derive(Clone)]
pub struct CubeLevel {
    pub size: u32,
    pub pixels: Vec<Pixel>,
}

impl CubeLevel {
    /// The pixels of each face.
    pub fn faces(&self) -> impl Iterator<Item = &[Pixel]> {
        self.pixels.chunks_exact((self.size * self.size) as usize)
    }
}

/// A level of which every texel is another.
pub fn cube(size: u32) -> CubeLevel {
    let texels = (0..6_u8).flat_map(|face| (0..size * size).map(move |i| (f32::from(face), i as f32)));
    CubeLevel { size, pixels: texels.map(|(face, i)| [face * 0.1, i / 64.0, 0.5, 1.0]).collect() }
}

/// KTX2 of all levels of a cube: the first, and each next one half as large.
pub fn ktx2(levels: &[CubeLevel], format: Ktx2Format) -> encode::Encoded {
    let whole: Vec<Level<'_>> = levels.iter().filter_map(|level| Level::new(level.size, &level.pixels)).collect();
    assert_eq!(whole.len(), levels.len());
    encode::ktx2::encode(&whole, format)
}

/// A full chain of levels, down to one texel a face.
pub fn chain(size: u32) -> Vec<CubeLevel> {
    std::iter::successors(Some(size), |size| (*size > 1).then_some(size / 2)).map(cube).collect()
}

/// Reads, or fails with the error.
pub fn read(bytes: &[u8]) -> Decoded {
    decode::decode("test", bytes, &DecodeLimits::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// The error that reading gives, without the file's name.
pub fn refusal(bytes: &[u8]) -> String {
    match decode::decode("test", bytes, &DecodeLimits::default()) {
        Err(error) => {
            assert_eq!(error.file.as_deref(), Some("test"));
            error.message
        }
        Ok(decoded) => panic!("{:?} was read", decoded.format),
    }
}

/// The one picture of a file.
pub fn picture(decoded: &Decoded) -> &Image {
    match &decoded.shape {
        DecodedContent::Picture(image) => image,
        DecodedContent::Faces(_) => panic!("six faces, not one picture"),
    }
}

/// The six faces of a file.
pub fn faces(decoded: &Decoded) -> &[Image; 6] {
    match &decoded.shape {
        DecodedContent::Faces(faces) => faces,
        DecodedContent::Picture(_) => panic!("one picture, not six faces"),
    }
}

/// A JPEG, by another writer.
pub fn jpeg(image: &image::DynamicImage) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100);
    image.write_with_encoder(encoder).unwrap_or_else(|e| panic!("{e}"));
    bytes
}

/// Small valid files of every kind, by name.
pub fn every_kind() -> Vec<(&'static str, Vec<u8>)> {
    let image = bright(12, 10);
    let ok = |encoded: Result<encode::Encoded, _>| match encoded {
        Ok(encode::Encoded { bytes, .. }) => bytes,
        Err(error) => panic!("{error}"),
    };
    let png = |depth| encode::png::encode(&image, &OutputTransform::default(), depth).unwrap_or_else(|e| panic!("{e}"));
    let gray = image::GrayImage::from_fn(20, 17, |x, y| image::Luma([(x * y) as u8]));
    let levels = chain(4);
    let mut flat_hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 5 -X 3\n".to_vec();
    flat_hdr.extend((0..60).map(|i| i * 4 + 1));
    vec![
        ("png8", png(encode::png::Depth::Eight)),
        ("png16", png(encode::png::Depth::Sixteen)),
        ("jpeg", jpeg(&image::DynamicImage::ImageLuma8(gray))),
        ("hdr", ok(encode::hdr::encode(&image))),
        ("flat hdr", flat_hdr),
        ("exr half", ok(encode::exr::encode(&image, ExrPrecision::Half))),
        ("exr float", ok(encode::exr::encode(&image, ExrPrecision::Float))),
        ("ktx2 half", ktx2(&levels, Ktx2Format::Half).bytes),
        ("ktx2 float", ktx2(&levels, Ktx2Format::Float).bytes),
        ("ktx2 srgb", ktx2(&levels, Ktx2Format::Srgb8).bytes),
        ("ktx2 zstd", super::cubemap_files::packed(2)),
        ("ktx2 zlib", super::cubemap_files::packed(3)),
        ("dds bc1", super::cubemap_files::cubemap(ddsfile::DxgiFormat::BC1_UNorm_sRGB, 4, 8)),
        ("dds bc6h", super::cubemap_files::cubemap(ddsfile::DxgiFormat::BC6H_UF16, 4, 16)),
        ("dds bc7", super::cubemap_files::cubemap(ddsfile::DxgiFormat::BC7_UNorm, 4, 16)),
        ("dds half", super::cubemap_files::cubemap(ddsfile::DxgiFormat::R16G16B16A16_Float, 2, 8 * 4)),
    ]
}
