//! A material as a model file describes it, and the origin of each of its values.

use serde::Serialize;

/// The ambient coefficient `k_a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AmbientRule {
    /// `k_a = k_d`, texture included: for files without `Ka`, and for `Ka 1 1 1`, which Blender writes into every file.
    FollowsDiffuse,
    /// The value as written: linear RGB.
    Value([f32; 3]),
}

/// A material. Colours are linear RGB and not negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// `newmtl`
    pub name: String,
    /// `Ka`
    pub ambient: AmbientRule,
    /// `Kd`
    pub diffuse: [f32; 3],
    /// `Ks`
    pub specular: [f32; 3],
    /// `Ke`
    pub emitted: [f32; 3],
    /// `Ns`, at least 1.
    pub shininess: f32,
    /// `Ni`
    pub refraction_index: f32,
    /// `d`: from 1, opaque, to 0, invisible.
    pub opacity: f32,
    /// `illum`, if present.
    pub illumination_model: Option<u8>,
    /// `map_Kd`: colour.
    pub diffuse_map: Option<TextureMap>,
    /// `map_Ks`: colour.
    pub specular_map: Option<TextureMap>,
    /// `map_Ke`: colour.
    pub emitted_map: Option<TextureMap>,
    /// `map_Ns`: data; its red channel times `shininess`.
    pub shininess_map: Option<TextureMap>,
    /// `map_d`: data; its red channel (or alpha, if it has one) times `opacity`.
    pub opacity_map: Option<TextureMap>,
    /// `norm`, or a `map_Bump` that is a tangent-space normal map: data.
    pub normal_map: Option<TextureMap>,
    /// `map_Bump`/`bump` with heights: data; distinguished from a normal map by its colours when it is loaded.
    pub bump_map: Option<TextureMap>,
    /// The physically based parameters of the same surface, if the file has them: `diffuse`, `specular` and `shininess`
    /// are already derived from its numbers; its textures must still be applied.
    pub metallic_roughness: Option<MetallicRoughness>,
    /// Values of the file for which the light equation has no term: sheen, clearcoat, anisotropy.
    pub unused: Vec<PropertySource>,
    /// The origins of the values above, in the order of the fields.
    pub sources: Vec<PropertySource>,
    /// The file that defines it, as the user knows it, if that is not the model's own.
    pub file: Option<String>,
}

/// A surface in the parameters of physically based renderers.
///
/// In terms of the light equation: `k_d = base_color * (1 - metallic)`, `k_s = mix(0.04, base_color, metallic)` (glTF
/// 2.0, appendix B), and gamma by [`gonio_light::microfacet`]: `2 / roughness^4 - 2`, from 1 to 10,000.
#[derive(Clone, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// Linear RGB.
    pub base_color: [f32; 3],
    /// 0 to 1.
    pub metallic: f32,
    /// 0 to 1.
    pub roughness: f32,
    /// Data, multiplied by `metallic`.
    pub metallic_map: Option<TextureMap>,
    /// Data, multiplied by `roughness`.
    pub roughness_map: Option<TextureMap>,
}

impl MetallicRoughness {
    /// Reflectance of dielectrics at normal incidence: that of a refraction index of 1.5.
    pub const DIELECTRIC_SPECULAR: f32 = 0.04;

    /// Returns `k_d` for a base colour and a metalness.
    pub fn diffuse(base_color: [f32; 3], metallic: f32) -> [f32; 3] {
        base_color.map(|c| c * (1.0 - metallic))
    }

    /// Returns `k_s` for a base colour and a metalness.
    pub fn specular(base_color: [f32; 3], metallic: f32) -> [f32; 3] {
        base_color.map(|c| Self::DIELECTRIC_SPECULAR + (c - Self::DIELECTRIC_SPECULAR) * metallic)
    }

    /// Returns the exponent `gamma` for a roughness.
    pub fn shininess(roughness: f32) -> f32 {
        gonio_light::microfacet::shininess_of_roughness(roughness.into()) as f32
    }

    /// Returns the roughness for an exponent: the inverse of [`Self::shininess`].
    pub fn roughness(shininess: f32) -> f32 {
        gonio_light::microfacet::roughness_of_shininess(shininess.into()) as f32
    }
}

/// The origin of a value of a material.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PropertySource {
    /// The field's name: `diffuse`, `shininess`, `diffuse_map`.
    pub property: &'static str,
    /// The line that sets it, from 1; `None` if no line does, or if the format has no lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// The text in the file: `Kd 0 0 0`, `materials[1].emissiveFactor = [0, 0, 0]`; empty if the file does not set it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub written: String,
    /// The rule by which the value differs from the text: `black beside map_Kd: treated as 1 1 1`.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub rule: String,
}

/// The fields of a [`Material`] that [`PropertySource`] refers to, in order.
const PROPERTIES: [&str; 15] = [
    "ambient",
    "diffuse",
    "specular",
    "emitted",
    "shininess",
    "refraction_index",
    "opacity",
    "diffuse_map",
    "specular_map",
    "emitted_map",
    "shininess_map",
    "opacity_map",
    "normal_map",
    "bump_map",
    "metallic_roughness",
];

impl Material {
    /// Sorts the sources in the order of the fields.
    pub(crate) fn sort_sources(&mut self) {
        self.sources.sort_by_key(|source| PROPERTIES.iter().position(|property| *property == source.property));
    }

    /// Returns all textures of the material.
    pub fn textures(&self) -> impl Iterator<Item = &TextureMap> {
        let physical = self.metallic_roughness.as_ref().map(|m| [&m.metallic_map, &m.roughness_map]);
        let maps = [
            &self.diffuse_map,
            &self.specular_map,
            &self.emitted_map,
            &self.shininess_map,
            &self.opacity_map,
            &self.normal_map,
            &self.bump_map,
        ];
        maps.into_iter().chain(physical.into_iter().flatten()).flatten()
    }

    /// Removes all textures; numbers that they multiplied stay.
    pub fn drop_textures(&mut self) {
        self.diffuse_map = None;
        self.specular_map = None;
        self.emitted_map = None;
        self.shininess_map = None;
        self.opacity_map = None;
        self.normal_map = None;
        self.bump_map = None;
        if let Some(physical) = &mut self.metallic_roughness {
            physical.metallic_map = None;
            physical.roughness_map = None;
        }
    }

    /// Returns all textures of the material for modification.
    pub fn textures_mut(&mut self) -> impl Iterator<Item = &mut TextureMap> {
        let physical = self.metallic_roughness.as_mut().map(|m| [&mut m.metallic_map, &mut m.roughness_map]);
        let maps = [
            &mut self.diffuse_map,
            &mut self.specular_map,
            &mut self.emitted_map,
            &mut self.shininess_map,
            &mut self.opacity_map,
            &mut self.normal_map,
            &mut self.bump_map,
        ];
        maps.into_iter().chain(physical.into_iter().flatten()).flatten()
    }
}

impl Default for Material {
    /// A light, slightly glossy clay, used for models without materials.
    fn default() -> Self {
        Material {
            name: String::new(),
            ambient: AmbientRule::FollowsDiffuse,
            diffuse: [0.7, 0.7, 0.7],
            specular: [0.25, 0.25, 0.25],
            emitted: [0.0; 3],
            shininess: 64.0,
            refraction_index: 1.5,
            opacity: 1.0,
            illumination_model: None,
            diffuse_map: None,
            specular_map: None,
            emitted_map: None,
            shininess_map: None,
            opacity_map: None,
            normal_map: None,
            bump_map: None,
            metallic_roughness: None,
            unused: Vec::new(),
            sources: Vec::new(),
            file: None,
        }
    }
}

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
    /// It belongs to [`crate::Mesh::second_tex_coords`].
    pub on_second_set: bool,
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
            on_second_set: false,
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
