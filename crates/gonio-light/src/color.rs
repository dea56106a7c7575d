//! Colour: sRGB, exposure, tone mapping.

use glam::DVec3;

named_enum! {
    /// How light becomes the picture's numbers.
    pub enum ColorEncoding {
        /// The sRGB transfer function, after exposure and tone mapping.
        Srgb = "srgb",
        /// The sum unencoded, clamped to [0, 1]: as the lab's programs do.
        Direct = "direct",
    }
    default Srgb;
    what "colour encoding";
}

named_enum! {
    /// How radiance above 1 is brought into the display's range.
    pub enum ToneMap {
        /// Clamped.
        None = "none",
        /// `x / (1 + x)` per channel (Reinhard et al. 2002).
        Reinhard = "reinhard",
        /// A rational fit of the ACES filmic curve (Narkowicz 2015).
        Aces = "aces",
        /// AgX, polynomial fit of its default look (Sobotka 2022, fitted by Wrensch 2023).
        Agx = "agx",
    }
    default None;
    what "tone map";
}

/// The whole way from linear light to the picture: exposure in stops, tone map, encoding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutputTransform {
    /// Stops: light is multiplied by 2^exposure.
    pub exposure: f64,
    /// Applied after exposure.
    pub tone_map: ToneMap,
    /// Applied last.
    pub encoding: ColorEncoding,
}

impl OutputTransform {
    /// Linear radiance to the picture's numbers in `[0, 1]`.
    pub fn encode(&self, linear: DVec3) -> DVec3 {
        let _ = linear;
        DVec3::ZERO
    }
}

/// GLSL's `smoothstep`; where both edges are equal, a step (GLSL leaves that undefined).
pub fn smoothstep(edge0: f64, edge1: f64, x: f64) -> f64 {
    if edge0 >= edge1 {
        return if x < edge0 { 0.0 } else { 1.0 };
    }
    let t = ((x - edge0) / (edge1 - edge0)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The sRGB transfer function's inverse: an encoded channel in [0, 1] to linear light (IEC 61966-2-1).
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
