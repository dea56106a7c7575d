//! Colour: sRGB, exposure, tone mapping.
//!
//! Everything takes and returns linear RGB with the sRGB primaries unless its name contains `encoded`.
//! Results are always finite: NaN and negative light count as 0, infinite light as
//! [`RADIANCE_CAP`].

use glam::{DMat3, DVec3};

named_enum! {
    /// The encoding of light in the picture's numbers.
    pub enum ColorEncoding {
        /// The sRGB transfer function, after exposure and tone mapping.
        Srgb = "srgb",
        /// The sum unencoded, clamped to [0, 1]: as the lab's programs do. Exposure and tone map still
        /// apply if they are asked for; only the sRGB curve is left out.
        Direct = "direct",
    }
    default Srgb;
    what "colour encoding";
}

named_enum! {
    /// The tone map, which brings radiance above 1 into the display's range.
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

/// Luminance of a colour (IEC 61966-2-1): 1 for white.
pub fn luminance(linear: DVec3) -> f64 {
    linear.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// The whole way from linear light to the picture: exposure in stops, tone map, encoding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutputTransform {
    /// Stops: light is multiplied by 2^exposure. Held in `[-EXPOSURE_LIMIT, EXPOSURE_LIMIT]`.
    pub exposure: f64,
    /// Applied after exposure.
    pub tone_map: ToneMap,
    /// Applied last.
    pub encoding: ColorEncoding,
}

impl OutputTransform {
    /// Linear radiance to the picture's numbers in `[0, 1]`: exposure, tone map, clamp, encoding.
    pub fn encode(&self, linear: DVec3) -> DVec3 {
        let display = self.tone_map.apply(exposed(linear, self.exposure));
        match self.encoding {
            ColorEncoding::Srgb => display.map(srgb_encode),
            ColorEncoding::Direct => display,
        }
    }
}

impl ToneMap {
    /// Linear radiance (each channel in `[0, RADIANCE_CAP]`) to linear display light in `[0, 1]`.
    pub fn apply(self, linear: DVec3) -> DVec3 {
        let display = match self {
            ToneMap::None => linear,
            ToneMap::Reinhard => reinhard(linear),
            ToneMap::Aces => aces(linear),
            ToneMap::Agx => agx(linear),
        };
        display.map(unit_interval)
    }
}

/// No light and no term of the equation is larger than this, per channel and light. It is far beyond
/// any display and any star, and `f32` still holds the sum of a hundred million of them.
pub const RADIANCE_CAP: f64 = 1e30;

/// Exposure is held within this many stops, up or down.
pub const EXPOSURE_LIMIT: f64 = 64.0;

/// A colour of light with each channel held in `[0, RADIANCE_CAP]`; NaN counts as 0. Colours that are in
/// their documented range are returned as they are.
pub fn capped(color: DVec3) -> DVec3 {
    // Written so that NaN becomes 0.
    color.map(|x| if x > 0.0 { x.min(RADIANCE_CAP) } else { 0.0 })
}

/// `linear * 2^stops`, each channel held in `[0, RADIANCE_CAP]`; stops that are NaN count as none.
pub fn exposed(linear: DVec3, stops: f64) -> DVec3 {
    let stops = if stops.is_nan() { 0.0 } else { stops.clamp(-EXPOSURE_LIMIT, EXPOSURE_LIMIT) };
    capped(capped(linear) * stops.exp2())
}

/// `x / (1 + x)` per channel, in `[0, 1]`.
///
/// Source: E. Reinhard et al., *Photographic Tone Reproduction for Digital Images*, SIGGRAPH 2002,
/// eq. (3), here on the channels instead of the luminance and without the scaling by the key.
pub fn reinhard(linear: DVec3) -> DVec3 {
    linear.map(|x| x / (1.0 + x))
}

/// `x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)` per channel; reaches 1 at `x = 7.24`, and values
/// above 1 are for the caller to clamp.
///
/// Source: K. Narkowicz, *ACES Filmic Tone Mapping Curve*, 2015: a fit of the ACES reference transform
/// for sRGB displays (its own exposure is 0.6 times darker; that factor is left to the exposure).
pub fn aces(linear: DVec3) -> DVec3 {
    linear.map(|x| {
        // Far above white already; its square would overflow f32 on the GPU for much more.
        let x = x.min(100.0);
        x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
    })
}

/// AgX's default look: into its working space, log2 over 16.5 stops, a sigmoid, and back.
///
/// The sigmoid's output is by AgX's convention encoded for a display of exponent 2.2; it is decoded
/// here, so that this gives linear light like the other tone maps and the sRGB encoding follows.
///
/// Source: T. Sobotka, *AgX*, 2022 (matrices, range); the polynomial of the sigmoid: B. Wrensch,
/// *Minimal AgX Implementation*, 2023 (6th order, mean squared error 3.7e-6). The polynomial ends at
/// -0.0023 and 0.9986 instead of 0 and 1: black is clamped, white stays at 0.997 of linear light.
pub fn agx(linear: DVec3) -> DVec3 {
    // 0 has no logarithm; everything below 2^AGX_MIN_EV is the same black.
    let log = (AGX_WORKING_FROM_SRGB * linear).map(|x| x.max(1e-10).log2().clamp(AGX_MIN_EV, AGX_MAX_EV));
    let display = AGX_SRGB_FROM_WORKING * log.map(|x| agx_contrast((x - AGX_MIN_EV) / (AGX_MAX_EV - AGX_MIN_EV)));
    display.map(|x| unit_interval(x).powf(2.2))
}

/// Stops below and above 1 that AgX's logarithm spans.
const AGX_MIN_EV: f64 = -12.47393;
const AGX_MAX_EV: f64 = 4.026069;

/// AgX's inset: pulls the primaries inwards, so that bright saturated light turns towards white.
const AGX_WORKING_FROM_SRGB: DMat3 = DMat3::from_cols(
    DVec3::new(0.842479062253094, 0.0423282422610123, 0.0423756549057051),
    DVec3::new(0.0784335999999992, 0.878468636469772, 0.0784336),
    DVec3::new(0.0792237451477643, 0.0791661274605434, 0.879142973793104),
);

/// AgX's outset: the inverse of the inset.
const AGX_SRGB_FROM_WORKING: DMat3 = DMat3::from_cols(
    DVec3::new(1.19687900512017, -0.0528968517574562, -0.0529716355144438),
    DVec3::new(-0.0980208811401368, 1.15190312990417, -0.0980434501171241),
    DVec3::new(-0.0990297440797205, -0.0989611768448433, 1.15107367264116),
);

/// The polynomial fit of AgX's sigmoid over `[0, 1]`, lowest power last.
fn agx_contrast(x: f64) -> f64 {
    [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232].iter().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// The sRGB transfer function: linear light in `[0, 1]` to an encoded channel in `[0, 1]`
/// (IEC 61966-2-1). Light outside of that range is clamped; NaN counts as 0.
pub fn srgb_encode(linear: f64) -> f64 {
    let linear = unit_interval(linear);
    if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The sRGB transfer function's inverse: an encoded channel in `[0, 1]` to linear light (IEC 61966-2-1).
/// Values outside of that range are clamped; NaN counts as 0.
pub fn srgb_decode(encoded: f64) -> f64 {
    let encoded = unit_interval(encoded);
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// [`srgb_decode`] in single precision, for readers that decode millions of channels.
pub fn srgb_decode_f32(encoded: f32) -> f32 {
    // Written so that NaN becomes 0.
    let encoded = if encoded > 0.0 { encoded.min(1.0) } else { 0.0 };
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// `x` held in `[0, 1]`; NaN counts as 0.
pub(crate) fn unit_interval(x: f64) -> f64 {
    // Written so that NaN becomes 0, which `clamp` would keep.
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that two numbers differ by at most `tolerance`, absolutely or relative to the larger.
    #[track_caller]
    fn assert_close(a: f64, b: f64, tolerance: f64) {
        let scale = a.abs().max(b.abs()).max(1.0);
        assert!((a - b).abs() <= tolerance * scale, "{a} and {b} differ by {:e}", (a - b).abs());
    }

    #[test]
    fn srgb_known_values() {
        // IEC 61966-2-1; 0.2158605 is 128/255 decoded, 0.7353570 is 0.5 encoded.
        assert_close(srgb_decode(128.0 / 255.0), 0.215_860_5, 1e-7);
        assert_close(srgb_encode(0.5), 0.735_357_0, 1e-7);
        assert_eq!((srgb_encode(0.0), srgb_decode(0.0)), (0.0, 0.0));
        assert_close(srgb_encode(1.0), 1.0, 1e-15);
        assert_close(srgb_decode(1.0), 1.0, 1e-15);
    }

    #[test]
    fn srgb_round_trip_of_all_bytes_and_the_joint_is_continuous() {
        for byte in 0..=255 {
            let encoded = f64::from(byte) / 255.0;
            assert_close(srgb_encode(srgb_decode(encoded)), encoded, 1e-12);
        }
        // The standard's constants are rounded: its two pieces meet within 4e-8 (set by the standard).
        assert!((srgb_encode(0.0031308) - srgb_encode(0.003_130_800_000_1)).abs() < 4e-8);
    }

    #[test]
    fn single_precision_decodes_the_same() {
        for step in 0..=1000 {
            let encoded = step as f32 / 1000.0;
            // A few units in the last place of f32: the rounding of its power.
            assert_close(srgb_decode_f32(encoded).into(), srgb_decode(encoded.into()), 5e-7);
        }
        assert_eq!([f32::NAN, -1.0, 2.0].map(srgb_decode_f32), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn one_stop_doubles() {
        let light = DVec3::new(0.25, 0.5, 3.0);
        assert_eq!(exposed(light, 1.0), light * 2.0);
        assert_eq!(exposed(light, -2.0), light / 4.0);
        assert_eq!(exposed(light, f64::NAN), light);
        assert_eq!(exposed(light, 1e300), exposed(light, EXPOSURE_LIMIT));
        assert_eq!(exposed(DVec3::ZERO, f64::INFINITY), DVec3::ZERO);
        let hostile = DVec3::new(f64::NAN, -1.0, f64::INFINITY);
        assert_eq!(exposed(hostile, 3.0), DVec3::new(0.0, 0.0, RADIANCE_CAP));
    }

    #[test]
    fn encode_is_exposure_then_tone_map_then_curve() {
        let gray = DVec3::splat(0.5);
        let encode = |tone_map, encoding, exposure| OutputTransform { exposure, tone_map, encoding }.encode(gray).x;
        assert_close(encode(ToneMap::None, ColorEncoding::Srgb, 0.0), srgb_encode(0.5), 1e-15);
        assert_eq!(encode(ToneMap::None, ColorEncoding::Direct, 0.0), 0.5);
        assert_eq!(encode(ToneMap::None, ColorEncoding::Direct, 4.0), 1.0);
        // Reinhard of 0.5 * 2 is 1/2.
        assert_eq!(encode(ToneMap::Reinhard, ColorEncoding::Direct, 1.0), 0.5);
        assert_close(encode(ToneMap::Reinhard, ColorEncoding::Srgb, 1.0), srgb_encode(0.5), 1e-15);
    }

    #[test]
    fn tone_maps_at_known_values() {
        let at = |tone_map: ToneMap, x: f64| tone_map.apply(DVec3::splat(x));
        assert_eq!(at(ToneMap::None, 0.3), DVec3::splat(0.3));
        assert_eq!(at(ToneMap::Reinhard, 3.0), DVec3::splat(0.75));
        // (2.51 + 0.03) / (2.43 + 0.59 + 0.14)
        assert_close(at(ToneMap::Aces, 1.0).y, 2.54 / 3.16, 1e-15);
        // The pivot of AgX's sigmoid: middle grey, 0.18, becomes 0.5 of the display's signal. The tolerance
        // is the polynomial fit's (root of its mean squared error: 0.002 of the signal).
        for channel in at(ToneMap::Agx, 0.18).to_array() {
            assert!((channel.powf(1.0 / 2.2) - 0.5).abs() < 0.004, "{channel}");
        }
    }

    #[test]
    fn tone_maps_rise_from_black_to_white_and_stay_in_range() {
        for &tone_map in ToneMap::ALL {
            assert_eq!(tone_map.apply(DVec3::ZERO), DVec3::ZERO, "{tone_map}");
            assert!(tone_map.apply(DVec3::splat(RADIANCE_CAP)).min_element() > 0.99, "{tone_map}");
            for hue in [DVec3::ONE, DVec3::new(1.0, 0.5, 0.1), DVec3::X] {
                let mut last = DVec3::ZERO;
                for step in -600..=600 {
                    let display = tone_map.apply(hue * (f64::from(step) / 30.0).exp2());
                    assert!(display.min_element() >= 0.0 && display.max_element() <= 1.0, "{tone_map}: {display}");
                    if hue == DVec3::ONE {
                        assert!((display - last).min_element() >= 0.0, "{tone_map} falls at 2^({step}/30)");
                    }
                    last = display;
                }
            }
        }
    }

    #[test]
    fn agx_turns_bright_red_towards_white_and_keeps_grey_grey() {
        let red = ToneMap::Agx.apply(DVec3::new(30.0, 0.0, 0.0));
        assert!(red.x > 0.9 && red.y > 0.1, "{red}");
        let grey = ToneMap::Agx.apply(DVec3::splat(0.4));
        // The matrices' rows sum to 1 within 3e-4 only.
        assert!(grey.max_element() - grey.min_element() < 1e-3, "{grey}");
    }

    #[test]
    fn nothing_gets_through_but_numbers_from_0_to_1() {
        let hostile = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, f64::MAX, f64::MIN, 1e-320, 0.0, 0.5];
        for &tone_map in ToneMap::ALL {
            for &encoding in ColorEncoding::ALL {
                for exposure in [0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 3.0] {
                    for x in hostile {
                        for y in hostile {
                            let out = OutputTransform { exposure, tone_map, encoding }.encode(DVec3::new(x, y, 0.5));
                            let range = 0.0..=1.0;
                            assert!(out.to_array().iter().all(|c| range.contains(c)), "{tone_map} {x} {y}: {out}");
                        }
                    }
                }
            }
        }
        for x in hostile {
            assert!((0.0..=1.0).contains(&srgb_encode(x)) && (0.0..=1.0).contains(&srgb_decode(x)), "{x}");
        }
        assert_eq!(capped(DVec3::new(f64::NAN, -2.0, f64::INFINITY)), DVec3::new(0.0, 0.0, RADIANCE_CAP));
        assert_eq!(capped(DVec3::new(0.1, 2.0, 1e29)), DVec3::new(0.1, 2.0, 1e29));
    }
}
