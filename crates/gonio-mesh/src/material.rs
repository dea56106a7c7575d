//! A material as a model file describes it.

/// A texture that a material names.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureMap {
    /// As written in the file.
    pub path: String,
    /// `-s`: texture coordinates are multiplied by this, ...
    pub scale: [f32; 2],
    /// `-o`: ... then this is added.
    pub offset: [f32; 2],
    /// `-clamp on`: clamped to the edge instead of repeated.
    pub clamp: bool,
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
            scale: [1.0, 1.0],
            offset: [0.0, 0.0],
            clamp: false,
            bump_multiplier: 1.0,
            line: None,
        }
    }
}

/// What `k_a` is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AmbientRule {
    /// `k_a = k_d`, texture included. For files that say nothing of `Ka`, and for `Ka 1 1 1`, which
    /// Blender writes into every file whatever the material is.
    FollowsDiffuse,
    /// As written: linear RGB.
    Value([f32; 3]),
}

/// A material. Colours are linear RGB, not negative.
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
    /// `d`: 1 opaque, 0 invisible.
    pub opacity: f32,
    /// `illum`, where given.
    pub illumination_model: Option<u8>,
    /// `map_Kd`: colour.
    pub diffuse_map: Option<TextureMap>,
    /// `map_Ks`: colour.
    pub specular_map: Option<TextureMap>,
    /// `map_Ke`: colour.
    pub emitted_map: Option<TextureMap>,
    /// `map_Ns`: data; its red channel times `shininess`.
    pub shininess_map: Option<TextureMap>,
    /// `map_d`: data; its red channel (or alpha where it has one) times `opacity`.
    pub opacity_map: Option<TextureMap>,
    /// `norm`, or a `map_Bump` that is a tangent-space normal map: data.
    pub normal_map: Option<TextureMap>,
    /// `map_Bump`/`bump` with heights: data; told from a normal map by its colours when it is loaded.
    pub bump_map: Option<TextureMap>,
}

impl Default for Material {
    /// A light, slightly glossy clay: what a model without materials is made of.
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
        }
    }
}
