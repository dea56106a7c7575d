//! The sRGB transfer function by table: 8 and 16 bits to linear light and back.
//!
//! The curve itself is [`gonio_light::color`]'s; the tables are filled from it once. Encoding to 8 bits gives the
//! nearest step of the exact curve.

use gonio_light::color::{srgb_decode, srgb_encode};
use std::sync::LazyLock;

/// Linear light of each 8-bit step.
pub static EXACT_FROM_8: LazyLock<[f64; 256]> =
    LazyLock::new(|| std::array::from_fn(|i| srgb_decode(i as f64 / 255.0)));

/// Linear light of each 8-bit step, as the nearest f32.
pub static LINEAR_FROM_8: LazyLock<[f32; 256]> = LazyLock::new(|| EXACT_FROM_8.map(|light| light as f32));

/// Linear light of each 16-bit step, as the nearest f32.
pub static LINEAR_FROM_16: LazyLock<Vec<f32>> =
    LazyLock::new(|| (0..=u16::MAX).map(|i| srgb_decode(f64::from(i) / 65535.0) as f32).collect());

/// Encodes linear light to 8 bits.
pub struct Encoder {
    /// The step that linear light begins at whose f32 has these highest bits, counted from [`LOWEST`].
    first_step: Vec<u8>,
    /// Linear light at which each step ends and the next begins; the last never ends.
    borders: [f64; 256],
    /// The first f32 that belongs to the next step.
    ends: [f32; 256],
}

/// Mantissa bits that choose an entry. Between two entries light grows by at most 1/128, which on the steepest part of
/// the curve is 0.9 of a step: an entry holds at most two steps, and one comparison distinguishes them.
const BITS: u32 = 7;
const SHIFT: u32 = 23 - BITS;
/// Light below 2^-13 is less than half of the first step (1.5e-4).
const LOWEST: u32 = (127 - 13) << 23;

/// The encoder, filled once.
pub static ENCODER: LazyLock<Encoder> = LazyLock::new(|| {
    let borders: [f64; 256] = std::array::from_fn(|i| match i {
        255 => f64::INFINITY,
        i => srgb_decode((i as f64 + 0.5) / 255.0),
    });
    let ends = std::array::from_fn(|i| match borders[i] as f32 {
        nearly if srgb_encode(nearly.into()) * 255.0 >= i as f64 + 0.5 => nearly,
        nearly => nearly.next_up(),
    });
    let first_step = (0..=(1.0_f32.to_bits() - LOWEST) >> SHIFT)
        .map(|i| (srgb_encode(f32::from_bits(LOWEST + (i << SHIFT)).into()) * 255.0).round() as u8)
        .collect();
    Encoder { first_step, borders, ends }
});

impl Encoder {
    /// The 8-bit step nearest to linear light; light below 0 and NaN are 0, above 1 are 255.
    pub fn encode(&self, linear: f32) -> u8 {
        // Written so that NaN becomes 0.
        let bits = if linear > 0.0 { linear.min(1.0).to_bits() } else { 0 };
        let step = self.first_step[((bits.saturating_sub(LOWEST)) >> SHIFT) as usize];
        step + u8::from(f32::from_bits(bits) >= self.ends[usize::from(step)])
    }

    /// [`Self::encode`] with the precision of f64.
    pub fn encode_f64(&self, linear: f64) -> u8 {
        let step = self.encode(linear as f32);
        // Rounding to f32 may have crossed a border.
        match usize::from(step) {
            i if i < 255 && linear >= self.borders[i] => step + 1,
            i if i > 0 && linear < self.borders[i - 1] => step - 1,
            _ => step,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_comes_back() {
        for i in 0..=255 {
            assert_eq!(ENCODER.encode(LINEAR_FROM_8[usize::from(i)]), i);
        }
    }

    #[test]
    fn encoding_is_the_curve_rounded() {
        let exact = |x: f32| (srgb_encode(x.into()) * 255.0).round() as u8;
        // Numbers on both sides of every border of a step, and a walk over all magnitudes.
        for i in 0..255 {
            let border = srgb_decode((f64::from(i) + 0.5) / 255.0) as f32;
            for x in [border.next_down().next_down(), border.next_down(), border, border.next_up()] {
                assert_eq!(ENCODER.encode(x), exact(x), "{x}");
            }
        }
        let mut x = 1e-8_f32;
        while x < 10.0 {
            assert_eq!(ENCODER.encode(x), exact(x), "{x}");
            x *= 1.0003;
        }
        for (x, expected) in [(f32::NAN, 0), (-1.0, 0), (f32::INFINITY, 255), (0.0, 0), (1.0, 255)] {
            assert_eq!(ENCODER.encode(x), expected, "{x}");
            assert_eq!(ENCODER.encode_f64(x.into()), expected, "{x}");
        }
    }

    #[test]
    fn borders_are_exact_in_f64() {
        for i in 0..255_u8 {
            let border = srgb_decode((f64::from(i) + 0.5) / 255.0);
            assert_eq!(ENCODER.encode_f64(border), i + 1, "{border}");
            assert_eq!(ENCODER.encode_f64(border.next_down()), i, "{border}");
        }
    }
}
