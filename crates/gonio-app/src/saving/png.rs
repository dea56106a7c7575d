//! A picture as PNG, 8 bits a channel.

use gonio_image::encode::png::{self, ColorTag};
use gonio_image::{EncodedPicture, ImageError};

/// A picture in the numbers of a screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DisplayedPicture {
    /// Pixels: width and height.
    pub size: [u32; 2],
    /// `width * height * 4` bytes, the top row first; where there is no background, colours are premultiplied by alpha.
    pub rgba: Vec<u8>,
    /// Whether the numbers are sRGB: not so where they are light unencoded, or a quantity.
    pub is_srgb: bool,
}

/// The file. Opaque pictures have three channels; in others colours are divided by alpha, as the format has them.
pub fn encode(picture: &DisplayedPicture) -> Result<Vec<u8>, ImageError> {
    let [width, height] = picture.size;
    let rgba = picture.rgba.as_chunks::<4>().0.iter().flat_map(|&pixel| straight(pixel)).collect();
    let tag = if picture.is_srgb { ColorTag::Srgb } else { ColorTag::Untagged };
    png::encode8(&EncodedPicture { width, height, rgba }, tag)
}

/// Divides colours by alpha.
fn straight([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let divided = |c: u8| match a {
        0 => 0,
        u8::MAX => c,
        _ => ((u32::from(c) * 255 + u32::from(a) / 2) / u32::from(a)).min(255) as u8,
    };
    [divided(r), divided(g), divided(b), a]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alpha_is_divided_out_of_the_colours() {
        assert_eq!(straight([64, 32, 0, 128]), [128, 64, 0, 128]);
        assert_eq!(straight([0, 0, 0, 0]), [0, 0, 0, 0]);
        assert_eq!(straight([7, 200, 255, 255]), [7, 200, 255, 255]);
    }

    #[test]
    fn too_few_bytes_are_an_error() {
        assert!(encode(&DisplayedPicture { size: [3, 2], rgba: vec![255; 4], is_srgb: true }).is_err());
    }
}
