//! 16-bit floats (IEEE 754 binary16), rounded here: drivers that are given 32 bits round in their own way, some of them
//! towards zero, which is twice the error.

/// The largest half: more light than this is as much as this.
pub const LARGEST: f32 = 65504.0;

/// The bits of the half that is nearest to `value`; halfway between two the even one. Beyond [`LARGEST`], either way,
/// that; 0 for what is not a number.
pub fn bits_of(value: f32) -> u16 {
    if value.is_nan() {
        return 0;
    }
    let sign = ((value.to_bits() >> 16) & 0x8000) as u16;
    let size = value.abs().min(LARGEST);
    // Below 2^-14 halves are the multiples of 2^-24.
    if size < 1.0 / 16384.0 {
        return sign | (size * 16_777_216.0).round_ties_even() as u16;
    }
    // 13 bits of the fraction go, and the exponent counts from -15 instead of from -127. What the fraction carries goes
    // into the exponent, as it should.
    let bits = size.to_bits();
    let rounded = bits + 0x0fff + ((bits >> 13) & 1);
    sign | ((rounded >> 13) - ((127 - 15) << 10)) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value of a half, by the definition.
    fn value_of(bits: u16) -> f32 {
        let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f32::from(bits & 0x3ff));
        let size = match exponent {
            0 => fraction * 2.0_f32.powi(-24),
            e => (1024.0 + fraction) * 2.0_f32.powi(e - 25),
        };
        if bits & 0x8000 == 0 { size } else { -size }
    }

    #[test]
    fn every_half_is_itself_and_between_two_the_nearer_one_counts() {
        for bits in (0..0x7c00_u16).chain(0x8000..0xfc00) {
            let value = value_of(bits);
            assert_eq!(bits_of(value), bits, "{value}");
            let next = value_of(bits.wrapping_add(1));
            if bits & 0x7fff == 0x7bff {
                continue;
            }
            let middle = 0.5 * (value + next);
            assert_eq!(bits_of(middle), if bits & 1 == 0 { bits } else { bits + 1 }, "the even one at {middle}");
            assert_eq!(bits_of(value + 0.49 * (next - value)), bits, "above {value}");
            assert_eq!(bits_of(value + 0.51 * (next - value)), bits + 1, "below {next}");
        }
    }

    #[test]
    fn what_no_half_holds() {
        for (value, wanted) in
            [(1e9, 0x7bff), (f32::INFINITY, 0x7bff), (-1e9, 0xfbff), (f32::NAN, 0), (65519.0, 0x7bff)]
        {
            assert_eq!(bits_of(value), wanted, "{value}");
        }
    }
}
