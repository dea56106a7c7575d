//! Textures, decoded.

use crate::mip::{self, MipLevel};
use gonio_light::named_enum;
use std::sync::OnceLock;

named_enum! {
    /// The filter of textures.
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

/// The meaning of a texture's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColorSpace {
    /// sRGB colours (alpha linear): decoded before filtering.
    Srgb,
    /// Data: taken as it is.
    Data,
}

/// A decoded picture: RGBA, 8 bits each. Made by [`Texture::new`].
#[derive(Clone, Debug)]
pub struct Texture {
    /// The file it came from, for reports and debug labels.
    pub name: String,
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// `width * height * 4` bytes, first row is the picture's **top**.
    pub rgba: Vec<u8>,
    /// The meaning of the numbers.
    pub color_space: ColorSpace,
    /// The smaller levels, made when they are first asked for.
    levels: OnceLock<Vec<MipLevel>>,
}

impl PartialEq for Texture {
    /// The smaller levels follow from the rest.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && (self.width, self.height, self.color_space) == (other.width, other.height, other.color_space)
            && self.rgba == other.rgba
    }
}

impl Texture {
    /// A texture of `width * height * 4` bytes, first row the top one. What is missing of `rgba` is
    /// taken as 0, what is too much is cut; an empty texture becomes one texel.
    pub fn new(name: impl Into<String>, width: u32, height: u32, mut rgba: Vec<u8>, color_space: ColorSpace) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        rgba.resize(width as usize * height as usize * 4, 0);
        Texture { name: name.into(), width, height, rgba, color_space, levels: OnceLock::new() }
    }

    /// A picture file's texels, as colours: PNG, JPEG, BMP, TGA or GIF by its content. An error says what is wrong with
    /// the file, without its name.
    pub fn decode(name: impl Into<String>, bytes: &[u8]) -> Result<Self, String> {
        let name = name.into();
        let picture = crate::image_file::decode(bytes, &name)?;
        Ok(Texture::new(name, picture.width, picture.height, picture.rgba, ColorSpace::Srgb))
    }

    /// The levels below the full picture, halving down to one texel: level 1 first.
    ///
    /// Each texel is the mean, in linear light, of the texels it covers, rounded to 8 bits. A GPU
    /// that is given these levels filters what the CPU filters.
    pub fn mip_levels(&self) -> &[MipLevel] {
        self.levels.get_or_init(|| mip::chain(self))
    }
}
