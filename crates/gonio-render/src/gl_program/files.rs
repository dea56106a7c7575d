//! The files of an OpenGL program: shaders and decoded images.

use gonio_scene::Texture;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Most texels along a side of an image.
pub const MOST_TEXELS: u32 = 2048;

/// Files by their names in the program.
#[derive(Clone, Debug, Default)]
pub struct GlProgramFiles {
    /// GLSL, for the context that draws.
    pub shaders: BTreeMap<String, String>,
    /// Images.
    pub images: BTreeMap<String, Arc<GlProgramImage>>,
}

impl GlProgramFiles {
    /// A shader's text.
    pub fn shader(&self, name: &str) -> Option<&str> {
        self.shaders.get(bare(name)).map(String::as_str)
    }

    /// An image.
    pub fn image(&self, name: &str) -> Option<&Arc<GlProgramImage>> {
        self.images.get(bare(name))
    }
}

/// A file is found by its last component: a program may use `../start.vert`.
fn bare(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// An image: RGBA, 8 bits each, the file's first row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GlProgramImage {
    size: [u32; 2],
    rgba: Vec<u8>,
}

impl GlProgramImage {
    /// An image of `width * height * 4` bytes. Any other number of bytes, and more than [`MOST_TEXELS`] along a side, is an
    /// error.
    pub fn new(size: [u32; 2], rgba: Vec<u8>) -> Result<Self, String> {
        if size.into_iter().any(|side| side == 0 || side > MOST_TEXELS) {
            return Err(format!(
                "invalid size {} x {}: expected 1 to {MOST_TEXELS} texels along a side",
                size[0], size[1]
            ));
        }
        if rgba.len() != size[0] as usize * size[1] as usize * 4 {
            return Err(format!("{} bytes are not {} x {} texels of 4 bytes", rgba.len(), size[0], size[1]));
        }
        Ok(GlProgramImage { size, rgba })
    }

    /// Decodes a picture file: PNG, JPEG, BMP, TGA or GIF.
    pub fn decode(name: &str, bytes: &[u8]) -> Result<Self, String> {
        let texture = Texture::decode(name, bytes)?;
        Self::new([texture.width, texture.height], texture.rgba)
    }

    /// One of the images that gonio ships: `checker.png`, `planks.png`, `tiles.png`. `None` for others, and on the web,
    /// where they are fetched.
    pub fn built_in(name: &str) -> Option<Self> {
        let bytes = gonio_scene::files::builtin(&format!("models/textures/{name}"))?;
        Self::decode(name, bytes).ok()
    }

    /// Texels along x and y.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The texels with their first `channels` (1 to 4) alone.
    pub(super) fn texels(&self, channels: usize) -> Vec<u8> {
        self.rgba.chunks_exact(4).flat_map(|texel| &texel[..channels.clamp(1, 4)]).copied().collect()
    }
}
