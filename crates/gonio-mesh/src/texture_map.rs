//! A texture as a material uses it: its image, its transform, and the meaning of its values.

use serde::Serialize;

/// A texture of a material.
///
/// The image is sampled at `R(rotation) * (scale * uv) + offset`, with v up.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureMap {
    /// The path as written in the file; for an embedded image its name, for messages.
    pub path: String,
    /// Index into [`crate::Model::images`] for an image inside the model's file.
    pub embedded: Option<usize>,
    /// `-s`: the factor for texture coordinates, which is applied first.
    pub scale: [f32; 2],
    /// The rotation in radians, counter-clockwise with v up, which is applied second (only in glTF).
    pub rotation: f32,
    /// `-o`: the offset, which is added last.
    pub offset: [f32; 2],
    /// The wrap mode along u and along v. `-clamp on` sets both.
    pub wrap: [Wrap; 2],
    /// The rule for its values.
    pub texel: TexelRule,
    /// `-bm`: the strength of a normal or bump map.
    pub bump_multiplier: f32,
    /// The line in the material file that refers to it, from 1.
    pub line: Option<u64>,
}

impl TextureMap {
    /// Creates a texture without options.
    pub fn new(path: impl Into<String>) -> Self {
        TextureMap {
            path: path.into(),
            embedded: None,
            scale: [1.0, 1.0],
            rotation: 0.0,
            offset: [0.0, 0.0],
            wrap: [Wrap::Repeat; 2],
            texel: TexelRule::default(),
            bump_multiplier: 1.0,
            line: None,
        }
    }
}

/// The sampling of an image outside of [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// Repeats the image.
    #[default]
    Repeat,
    /// Extends the edge texels.
    Clamp,
    /// Repeats the image, mirroring every other copy.
    Mirror,
}

/// A channel of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Channel {
    /// `-imfchan r`
    Red,
    /// `-imfchan g`
    Green,
    /// `-imfchan b`
    Blue,
    /// `-imfchan m`: opacity.
    Alpha,
    /// `-imfchan l`: brightness.
    Luminance,
}

/// Converts a texel before it is used: selects a channel, computes `base + gain * value`, and with a cutoff replaces
/// that by 1 if it is at least the cutoff, else by 0. Applied to the numbers in the file (before decoding sRGB).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelRule {
    /// The channel of a scalar; `None`: red, but alpha for opacities if the image has one.
    pub channel: Option<Channel>,
    /// `-mm base gain`
    pub base: f32,
    /// `-mm base gain`; -1 with a base of 1 inverts, as `map_Tr` does.
    pub gain: f32,
    /// The threshold of binary opacity: glTF's `alphaCutoff`.
    pub cutoff: Option<f32>,
}

impl Default for TexelRule {
    fn default() -> Self {
        TexelRule { channel: None, base: 0.0, gain: 1.0, cutoff: None }
    }
}
