//! Textures, which the caller samples.

/// How a lookup chooses its level of detail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TextureDetail {
    /// The base level: there are no derivatives.
    Base,
    /// From the derivatives of the coordinates along x and y of the picture, plus a bias.
    Implicit {
        /// The derivatives along x.
        dx: [f32; 3],
        /// The derivatives along y.
        dy: [f32; 3],
        /// Added to the level.
        bias: f32,
    },
    /// This level.
    Level(f32),
}

/// A lookup for one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureLookup {
    /// The point.
    pub point: usize,
    /// The value of the sampler: the number that the caller gave to the uniform.
    pub sampler: u32,
    /// The number of coordinates: 2 for `sampler2D`, 3 for `samplerCube`.
    pub dims: u8,
    /// The coordinates, after division by the last one in `textureProj`; texels for `texelFetch`.
    pub coordinates: [f32; 4],
    /// The level of detail.
    pub detail: TextureDetail,
    /// Added to the coordinates, in texels.
    pub offset: [i32; 3],
    /// The depth that a shadow lookup compares with.
    pub compare: Option<f32>,
    /// Whether the coordinates are texels (`texelFetch`).
    pub is_fetch: bool,
    /// The component of the four texels that `textureGather` returns.
    pub gather: Option<u8>,
}

/// Samples textures for the interpreter.
pub trait TextureSource: Sync {
    /// Returns red, green, blue and alpha; for samplers of integers, integers. Shadow lookups return the result of the
    /// comparison in all four.
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4];

    /// Returns the width, height and depth of a level in texels.
    fn size(&self, sampler: u32, level: i32) -> [u32; 3];

    /// Returns the number of levels.
    fn levels(&self, sampler: u32) -> u32 {
        let _ = sampler;
        1
    }
}

/// No textures: every lookup is black and opaque, as that of an incomplete texture in OpenGL.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NoTexture;

impl TextureSource for NoTexture {
    fn look_up(&self, _lookup: &TextureLookup) -> [f32; 4] {
        [0.0, 0.0, 0.0, 1.0]
    }

    fn size(&self, _sampler: u32, _level: i32) -> [u32; 3] {
        [0; 3]
    }
}
