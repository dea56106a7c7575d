//! Parses numbers: as fast as a loop, as exact as the standard library.

/// `10^0` to `10^22`: the powers of ten that an `f64` represents exactly.
const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// Parses the decimal number at the start of `bytes`, correctly rounded (to infinity if it is too large); also returns
/// its length.
///
/// Up to 2^53 and with at most 22 places, the digits as an integer and the power of ten are exact `f64`s, and their
/// product or quotient is rounded once (W. D. Clinger, 1990, "How to read floating point numbers accurately").
/// Rounding that to `f32` is a second rounding, which goes wrong only where the first one ends exactly half-way
/// between two `f32`s: then, and wherever the digits do not fit, the standard library does it.
#[inline]
pub(crate) fn f32_prefix(bytes: &[u8]) -> Option<(f32, usize)> {
    let negative = bytes.first() == Some(&b'-');
    let first = usize::from(negative || bytes.first() == Some(&b'+'));
    let mut i = first;
    let mut digits: u64 = 0;
    i += take_digits(&bytes[i..], &mut digits);
    let mut digit_count = i - first;
    let mut exponent: i64 = 0;
    if bytes.get(i) == Some(&b'.') {
        let places = take_digits(&bytes[i + 1..], &mut digits);
        i += 1 + places;
        digit_count += places;
        exponent = -(places as i64);
    }
    if digit_count == 0 {
        return None;
    }
    if let Some(b'e' | b'E') = bytes.get(i) {
        let (written, length) = integer_prefix(&bytes[i + 1..])?;
        exponent = exponent.saturating_add(written);
        i += 1 + length;
    }
    let fits = digit_count <= 19 && digits <= 1 << 53;
    let power = POWERS_OF_TEN.get(exponent.unsigned_abs() as usize).filter(|_| fits);
    let magnitude = power.and_then(|&power| {
        let rounded = if exponent < 0 { digits as f64 / power } else { digits as f64 * power };
        // From 1e-22 to 1e38 every f32 is normal: it lacks 29 bits of an f64, of which 100...0 is half-way.
        let is_half_way = rounded.to_bits() & 0x1FFF_FFFF == 0x1000_0000;
        (!is_half_way).then_some(rounded as f32)
    });
    let value = match magnitude {
        Some(magnitude) if negative => -magnitude,
        Some(magnitude) => magnitude,
        None => std::str::from_utf8(&bytes[..i]).ok()?.parse().ok()?,
    };
    Some((value, i))
}

/// Appends the decimal digits at the start of `bytes` to `value` (which may wrap: count them); returns their number.
#[inline]
fn take_digits(bytes: &[u8], value: &mut u64) -> usize {
    let mut count = 0;
    for &byte in bytes {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        *value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        count += 1;
    }
    count
}

/// Parses the integer at the start of `bytes`, saturating at the limits of `i64`; also returns its length.
#[inline]
pub(crate) fn integer_prefix(bytes: &[u8]) -> Option<(i64, usize)> {
    let negative = bytes.first() == Some(&b'-');
    let first = usize::from(negative || bytes.first() == Some(&b'+'));
    let mut magnitude: u64 = 0;
    let count = take_digits(&bytes[first..], &mut magnitude);
    if count == 0 {
        return None;
    }
    if count > 18 {
        // Leading zeros are rare enough for a slow path.
        let text = std::str::from_utf8(&bytes[first..first + count]).ok()?;
        magnitude = text.parse().unwrap_or(u64::MAX);
    }
    let magnitude = i64::try_from(magnitude).unwrap_or(i64::MAX);
    Some((if negative { -magnitude } else { magnitude }, first + count))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// A small generator (Steele, Lea, Flood, 2014: SplitMix64), so that every run tries the same numbers.
    struct SplitMix(u64);

    impl SplitMix {
        fn next(&mut self) -> u64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            z ^ (z >> 31)
        }
    }

    fn check(text: &str) {
        let expected: f32 = text.parse().unwrap();
        let (value, length) = f32_prefix(text.as_bytes()).unwrap_or_else(|| panic!("{text} was not read"));
        assert_eq!(length, text.len(), "{text}");
        assert_eq!(value.to_bits(), expected.to_bits(), "{text}: {value} instead of {expected}");
    }

    #[test]
    fn rounds_as_the_standard_library_does() {
        let mut random = SplitMix(1);
        for _ in 0..400_000 {
            let bits = random.next();
            // Numbers as exporters write them: six places; a handful of digits with an exponent; whole f32s and halves between.
            check(&format!("{:.6}", (bits as i64 >> 30) as f64 / 65_536.0));
            check(&format!("{}{}e{}", if bits & 1 == 0 { "-" } else { "+" }, bits >> 37, (bits % 90) as i64 - 45));
            check(&format!("{}.{}", bits >> 54, bits & 0xFFFF_FFFF));
            let value = f32::from_bits(bits as u32);
            if value.is_finite() {
                check(&format!("{value}"));
                check(&format!("{value:e}"));
                let half_way = 0.5 * (f64::from(value) + f64::from(f32::from_bits(bits as u32 ^ 1)));
                check(&format!("{half_way}"));
            }
        }
    }

    #[test]
    fn edges_of_the_format() {
        let cases = "0 -0 +0 1. .5 -.5e+2 .8e-001 16777217 16777219 1e22 1e23 1e-22 3.4028235e38 3.4028236e38 1e39 \
             -1e400 1e-45 7e-46 1.1754942e-38 1.17549435e-38 9007199254740993 00000000000000000000001.5 \
             0.00000000000000000000000000000001 123456789012345678901234567890 1e99999999999999999999 \
             1.00000017881393432617187499 1.00000017881393421514957253748434595763683319091796875001";
        for case in cases.split_ascii_whitespace() {
            check(case);
        }
        for case in ["", "-", ".", "e5", "1e", "1e+", "x", "-.", "nan", "inf"] {
            assert_eq!(f32_prefix(case.as_bytes()), None, "{case}");
        }
        assert_eq!(f32_prefix(b"1.5/2"), Some((1.5, 3)));
    }

    #[test]
    fn integers_stay_at_the_edge() {
        assert_eq!(integer_prefix(b"-12/3"), Some((-12, 3)));
        assert_eq!(integer_prefix(b"+7"), Some((7, 2)));
        assert_eq!(integer_prefix(b"99999999999999999999999"), Some((i64::MAX, 23)));
        assert_eq!(integer_prefix(b"-99999999999999999999999"), Some((-i64::MAX, 24)));
        assert_eq!(integer_prefix(b"000000000000000000000000012"), Some((12, 27)));
        assert_eq!(integer_prefix(b"-"), None);
    }
}
