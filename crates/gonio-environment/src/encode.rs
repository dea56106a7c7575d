//! Environments as files: the containers and formats that they can be written to, and the bytes.

use crate::arrange::Arrangement;
use crate::{CubeMips, Cubemap, Layout};
use gonio_image::decode::{self, DecodedContent, FileFormat};
use gonio_image::encode::{Encoded, exr, hdr, ktx2, png};
use gonio_image::{DecodeLimits, Image, ImageError};
use gonio_light::color::OutputTransform;

/// The container that an environment is written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Container {
    /// Six files.
    Faces,
    /// The cube unfolded, 4 by 3, in one picture.
    Cross,
    /// The cube unfolded, 3 by 4, in one picture.
    VerticalCross,
    /// Six faces side by side in one picture.
    Strip,
    /// Six faces one below the other in one picture.
    VerticalStrip,
    /// A panorama.
    Equirectangular,
    /// A cubemap with its mip levels.
    Ktx2,
}

impl Container {
    /// All containers.
    pub const ALL: &'static [Self] = &[
        Self::Faces,
        Self::Cross,
        Self::VerticalCross,
        Self::Strip,
        Self::VerticalStrip,
        Self::Equirectangular,
        Self::Ktx2,
    ];

    /// The name: that of the arrangement, or `ktx2`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Faces => Arrangement::Faces.name(),
            Self::Cross => Arrangement::Cross.name(),
            Self::VerticalCross => Arrangement::VerticalCross.name(),
            Self::Strip => Arrangement::Strip.name(),
            Self::VerticalStrip => Arrangement::VerticalStrip.name(),
            Self::Equirectangular => Arrangement::Equirectangular.name(),
            Self::Ktx2 => "ktx2",
        }
    }

    /// Whether it consists of six faces.
    pub fn has_faces(self) -> bool {
        self != Self::Equirectangular
    }

    /// The arrangement of six faces in one picture; `None` for the others.
    pub fn arrangement(self) -> Option<Arrangement> {
        match self {
            Self::Cross => Some(Arrangement::Cross),
            Self::VerticalCross => Some(Arrangement::VerticalCross),
            Self::Strip => Some(Arrangement::Strip),
            Self::VerticalStrip => Some(Arrangement::VerticalStrip),
            Self::Faces | Self::Equirectangular | Self::Ktx2 => None,
        }
    }
}

impl std::fmt::Display for Container {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentFormat {
    /// PNG: 8 or 16 bits, displayed colours.
    Png,
    /// OpenEXR: half or single floats, linear light.
    Exr,
    /// Radiance's: 8 bits and a shared exponent, linear light.
    Hdr,
}

impl EnvironmentFormat {
    /// All formats.
    pub const ALL: [EnvironmentFormat; 3] = [EnvironmentFormat::Png, EnvironmentFormat::Exr, EnvironmentFormat::Hdr];

    /// The format of a file name extension in lower case, without the dot.
    pub fn from_extension(extension: &str) -> Option<EnvironmentFormat> {
        EnvironmentFormat::ALL.into_iter().find(|format| format.extension() == extension)
    }

    /// The format that preserves everything in a file of this format.
    pub fn that_preserves(source: FileFormat) -> EnvironmentFormat {
        match source {
            FileFormat::Png | FileFormat::Jpeg => EnvironmentFormat::Png,
            FileFormat::Hdr => EnvironmentFormat::Hdr,
            FileFormat::Exr | FileFormat::Ktx2 | FileFormat::Dds => EnvironmentFormat::Exr,
        }
    }

    /// The file name extension, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            EnvironmentFormat::Png => "png",
            EnvironmentFormat::Exr => "exr",
            EnvironmentFormat::Hdr => "hdr",
        }
    }
}

/// The encoding of the pixels.
#[derive(Clone, Copy, Debug)]
pub struct Appearance {
    /// The layout of faces.
    pub layout: Layout,
    /// The transform to displayed colours, for PNG.
    pub transform: OutputTransform,
    /// Whether the source has light above 1.
    pub high_dynamic_range: bool,
    /// Whether every number must be read back as it is, with as many bits as that takes.
    pub exact: bool,
}

/// Encodes a picture: a panorama, or faces in the layout of `appearance`. `bits` are those of a PNG's channels; `None` is 8, or
/// as many as an exact picture needs.
///
/// # Errors
///
/// A picture that the format cannot hold.
pub fn picture(
    image: &Image,
    format: EnvironmentFormat,
    bits: Option<u8>,
    appearance: &Appearance,
) -> Result<Encoded, ImageError> {
    match format {
        EnvironmentFormat::Png => {
            let encode = |depth: &png::Depth| {
                png::encode(image, &appearance.transform, *depth).map(|bytes| Encoded { bytes, ..Encoded::default() })
            };
            match (bits, appearance.exact) {
                (Some(16), _) => encode(&png::Depth::Sixteen),
                (Some(_), _) | (None, false) => encode(&png::Depth::Eight),
                (None, true) => {
                    first_exact(&[png::Depth::Eight, png::Depth::Sixteen], std::slice::from_ref(image), encode)
                }
            }
        }
        EnvironmentFormat::Exr => {
            let encode = |precision: &exr::ExrPrecision| exr::encode(image, *precision);
            if appearance.exact {
                first_exact(&[exr::ExrPrecision::Half, exr::ExrPrecision::Float], std::slice::from_ref(image), encode)
            } else {
                encode(&exr::ExrPrecision::Half)
            }
        }
        EnvironmentFormat::Hdr => hdr::encode(image),
    }
}

/// Encodes a cubemap with its mip levels as KTX2: sRGB of 8 bits, or half floats for light above 1; exact if `appearance`
/// requests it.
///
/// # Errors
///
/// None so far: every cubemap can be encoded.
pub fn cubemap_ktx2(map: Cubemap, appearance: &Appearance) -> Result<Encoded, ImageError> {
    let formats = [ktx2::Ktx2Format::Srgb8, ktx2::Ktx2Format::Half, ktx2::Ktx2Format::Float];
    let mips = CubeMips::new(map);
    let least = usize::from(appearance.high_dynamic_range);
    let encode = |format: &ktx2::Ktx2Format| Ok(mips.to_ktx2(*format));
    if appearance.exact {
        first_exact(&formats[least..], &mips.full().faces(Layout::OpenGl), encode)
    } else {
        encode(&formats[least])
    }
}

/// Encodes pictures in the first of these ways that preserves them exactly, or else in the last.
fn first_exact<T>(
    ways: &[T],
    pictures: &[Image],
    encode: impl Fn(&T) -> Result<Encoded, ImageError>,
) -> Result<Encoded, ImageError> {
    let (last, cheaper) = ways.split_last().ok_or_else(|| ImageError::new("no encoding is known for this"))?;
    for way in cheaper {
        let encoded = encode(way)?;
        let again = decode::decode("", &encoded.bytes, &DecodeLimits { max_bytes: u64::MAX })?;
        let same = match &again.shape {
            DecodedContent::Picture(image) => pictures == std::slice::from_ref(image),
            DecodedContent::Faces(faces) => pictures == faces.as_slice(),
        };
        if same {
            return Ok(encoded);
        }
    }
    encode(last)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_light::color::{ColorEncoding, ToneMap};

    fn appearance(high_dynamic_range: bool, exact: bool) -> Appearance {
        let transform = OutputTransform { exposure: 0.0, tone_map: ToneMap::None, encoding: ColorEncoding::Srgb };
        Appearance { layout: Layout::OpenGl, transform, high_dynamic_range, exact }
    }

    /// A thousandth more than a half float can tell apart from 1.
    fn fine() -> Image {
        Image { width: 2, height: 1, pixels: vec![[1.000_01, 0.5, 0.25, 1.0], [3.0, 0.0, 0.0, 1.0]] }
    }

    fn read_again(encoded: &Encoded) -> Image {
        match decode::decode("", &encoded.bytes, &DecodeLimits::default()).unwrap().shape {
            DecodedContent::Picture(image) => image,
            DecodedContent::Faces(_) => panic!("six faces"),
        }
    }

    #[test]
    fn an_exact_picture_takes_as_many_bits_as_it_needs() {
        let rounded = picture(&fine(), EnvironmentFormat::Exr, None, &appearance(true, false)).unwrap();
        let exact = picture(&fine(), EnvironmentFormat::Exr, None, &appearance(true, true)).unwrap();
        assert_ne!(read_again(&rounded), fine());
        assert_eq!(read_again(&exact), fine());
    }

    #[test]
    fn a_cubemap_with_light_above_1_keeps_it() {
        let bright = Cubemap::new(2, [2.0, 0.5, 0.25, 1.0]);
        let brightest = |high_dynamic_range| {
            let encoded = cubemap_ktx2(bright.clone(), &appearance(high_dynamic_range, false)).unwrap();
            match decode::decode("", &encoded.bytes, &DecodeLimits::default()).unwrap().shape {
                DecodedContent::Faces(faces) => faces[0].pixels[0][0],
                DecodedContent::Picture(_) => panic!("one picture"),
            }
        };
        assert_eq!([brightest(true), brightest(false)], [2.0, 1.0]);
    }
}
