//! A texture as a material uses it: which picture, where on the model, and what its numbers mean.

use serde::Serialize;

/// A texture that a material names.
///
/// The picture is looked at, at texture coordinates (v up), at `R(rotation) * (scale * uv) + offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureMap {
    /// As written in the file; of an embedded picture its name, for messages.
    pub path: String,
    /// Index into [`crate::Model::images`] of a picture inside the model's file.
    pub embedded: Option<usize>,
    /// `-s`: texture coordinates are multiplied by this, ...
    pub scale: [f32; 2],
    /// ... turned by this (radians, counter-clockwise with v up; only glTF has it), ...
    pub rotation: f32,
    /// `-o`: ... then this is added.
    pub offset: [f32; 2],
    /// What is beyond the picture's edges: along u, along v. `-clamp on` is both.
    pub wrap: [Wrap; 2],
    /// What is made of its numbers.
    pub texel: TexelRule,
    /// `-bm`: strength of a normal or bump map.
    pub bump_multiplier: f32,
    /// The line in the material file that names it, from 1.
    pub line: Option<u64>,
}

impl TextureMap {
    /// A texture without options.
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

/// What is beyond a picture's edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// Its last texel.
    Clamp,
    /// The picture again, every other one mirrored.
    Mirror,
}

/// A channel of a picture.
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

/// What is made of a texel before it is used: a channel is chosen, then `base + gain * value`, then, with a cutoff, 1
/// where that is at least the cutoff and else 0. Applied to the numbers of the file (before sRGB is decoded).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelRule {
    /// Which channel a scalar is read from; `None`: red, and of opacities alpha where the picture has one.
    pub channel: Option<Channel>,
    /// `-mm base gain`
    pub base: f32,
    /// `-mm base gain`; -1 with a base of 1 inverts, as `map_Tr` does.
    pub gain: f32,
    /// Only all or nothing: glTF's `alphaCutoff`.
    pub cutoff: Option<f32>,
}

impl Default for TexelRule {
    fn default() -> Self {
        TexelRule { channel: None, base: 0.0, gain: 1.0, cutoff: None }
    }
}
