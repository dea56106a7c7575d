//! Textures, decoded.

use gonio_light::named_enum;

named_enum! {
    /// How textures are sampled.
    pub enum TextureFilter {
        /// The nearest texel.
        Nearest = "nearest",
        /// Four texels of the full picture, no mipmaps.
        Linear = "linear",
        /// Trilinear.
        Mipmap = "mipmap",
        /// Trilinear, up to 16 times along the footprint's longer axis.
        Anisotropic = "anisotropic",
    }
    default Anisotropic;
    what "texture filter";
}

/// What a texture's numbers mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorSpace {
    /// sRGB colours (alpha linear): decoded before filtering.
    Srgb,
    /// Data: taken as it is.
    Data,
}

/// A decoded picture: RGBA, 8 bits each.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The file it came from, for reports and debug labels.
    pub name: String,
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// `width * height * 4` bytes, first row is the picture's **top**.
    pub rgba: Vec<u8>,
    /// What the numbers mean.
    pub color_space: ColorSpace,
}
