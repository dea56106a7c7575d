//! Reads lines in plain form, as exporters write nearly all of them. Other lines return `None` and are read again byte
//! by byte, with exactly the same results for plain lines.

use super::scan::{self, WINDOW};
use std::num::NonZeroU64;

/// Bytes that must exist after the start of a line: the window, and eight more after its last byte.
pub(super) const REACH: usize = WINDOW + 16;

/// Most digits after the point; 10^digits is then an exact `f64`.
const MOST_PLACES: usize = 16;

/// Eight times `0`.
const ZEROS: u64 = 0x3030_3030_3030_3030;

/// 1 to 10^7 as `f32`s, which represent them exactly.
const EXACT_POWERS_OF_TEN: [f32; 8] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];

const POWERS_OF_TEN: [u64; MOST_PLACES + 1] = {
    let mut powers = [1; MOST_PLACES + 1];
    let mut i = 1;
    while i < powers.len() {
        powers[i] = 10 * powers[i - 1];
        i += 1;
    }
    powers
};

/// The start of a line, with a mask of the bytes that are not digits.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    bytes: &'a [u8; REACH],
    /// The mask from `at` on.
    non_digits: u64,
    at: usize,
}

impl<'a> Line<'a> {
    #[inline(always)]
    pub(super) fn new(bytes: &'a [u8; REACH]) -> Option<Self> {
        Some(Line { bytes, non_digits: scan::non_digits(bytes.first_chunk()?), at: 0 })
    }

    /// Returns the number of bytes read.
    #[inline(always)]
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Skips the keyword and the blanks after it.
    #[inline(always)]
    pub(super) fn after_keyword(mut self, length: usize) -> Option<Self> {
        self.at = length;
        while *self.bytes.get(self.at)? == b' ' {
            self.at += 1;
        }
        self.non_digits &= u64::MAX.checked_shl(self.at as u32)?;
        Some(self)
    }

    /// Returns eight bytes from a position on.
    #[inline(always)]
    fn word(&self, at: usize) -> Option<u64> {
        Some(u64::from_le_bytes(*self.bytes.get(at..)?.first_chunk()?))
    }

    /// Moves to the next byte that is not a digit and returns its position, which is below [`WINDOW`].
    #[inline(always)]
    fn next_non_digit(&mut self) -> Option<usize> {
        // For a non-zero number this is one instruction.
        let at = NonZeroU64::new(self.non_digits)?.trailing_zeros() as usize;
        self.non_digits &= self.non_digits.wrapping_sub(1);
        Some(at)
    }

    /// Reads digits with at most one point among them and perhaps a sign, and the byte after them.
    #[inline(always)]
    pub(super) fn number(&mut self) -> Option<(f32, u8)> {
        let minus = *self.bytes.get(self.at)? == b'-';
        // Signs are unpredictable, so avoid a branch.
        self.at += usize::from(minus);
        self.non_digits &= self.non_digits.wrapping_sub(u64::from(minus));
        let start = self.at;
        let mut end = self.next_non_digit()?;
        let whole = end - start;
        let mut places = 0;
        if self.bytes[end] == b'.' {
            let point = end;
            end = self.next_non_digit()?;
            places = end - point - 1;
        }
        let magnitude = if whole + places <= 7 && whole > 0 {
            // Both parts next to each other, as eight digits with leading zeros.
            let before = (self.word(start)? ^ ZEROS) << (64 - 8 * whole);
            let behind = ((self.word(end - places)? ^ ZEROS) << 8) << (56 - 8 * places);
            let mantissa = scan::aligned_digits(before >> (8 * places) | behind);
            // Below 2^24 this is exact, and so is the power of ten: the quotient is rounded once.
            mantissa as i32 as f32 / *EXACT_POWERS_OF_TEN.get(places)?
        } else {
            rounded(self.long_mantissa(start, whole, end, places)?, places)?
        };
        self.at = end + 1;
        Some((with_sign(magnitude, minus), self.bytes[end]))
    }

    fn long_mantissa(&self, start: usize, whole: usize, end: usize, places: usize) -> Option<u64> {
        if whole + places == 0 || whole > 8 || places > MOST_PLACES || whole + places > 17 {
            return None;
        }
        let before = if whole > 0 { scan::digits(self.word(start)?, whole) } else { 0 };
        let first = end - places;
        let behind = match places {
            0 => 0,
            1..=8 => scan::digits(self.word(first)?, places),
            _ => {
                let high = scan::digits(self.word(first)?, 8);
                high * POWERS_OF_TEN[places - 8] + scan::digits(self.word(first + 8)?, places - 8)
            }
        };
        Some(before * POWERS_OF_TEN[places] + behind)
    }

    /// Returns the end of the line if `end` is the byte just read and ends it, perhaps after blanks.
    #[inline(always)]
    pub(super) fn end(&self, end: u8) -> Option<usize> {
        let mut at = self.at;
        let mut end = end;
        while end == b' ' {
            end = *self.bytes.get(at)?;
            at += 1;
        }
        match end {
            b'\n' => Some(at),
            b'\r' if *self.bytes.get(at)? == b'\n' => Some(at + 1),
            _ => None,
        }
    }

    /// Reads one to eight digits, padded to eight with leading zeros (see [`scan::aligned_digits`]), and the byte after
    /// them.
    #[inline(always)]
    pub(super) fn index(&mut self) -> Option<(u64, u8)> {
        let start = self.at;
        let end = self.next_non_digit()?;
        let shift = 64u32.wrapping_sub(8 * (end - start) as u32);
        if shift >= 64 {
            return None;
        }
        self.at = end + 1;
        Some(((self.word(start)? ^ ZEROS) << shift, self.bytes[end]))
    }

    #[inline(always)]
    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Skips one byte, which must not be a digit.
    #[inline(always)]
    pub(super) fn step(&mut self) {
        self.at += 1;
        self.non_digits &= self.non_digits.wrapping_sub(1);
    }
}

/// Reads `N` numbers from `at` to the end of the line if all have the most common form of small numbers, `0.123456`,
/// separated by single blanks. Also returns the length of the line.
#[inline(always)]
pub(super) fn small_numbers<const N: usize>(bytes: &[u8; REACH], mut at: usize) -> Option<([f32; N], usize)> {
    /// Added to a byte, this makes it 128 or more unless it is a digit (or the point, in its place). Carries only reach
    /// bytes after such a byte.
    const BEYOND_DIGITS: u64 = 0x7676_7676_7676_7F76;
    const HIGH_BITS: u64 = 0x8080_8080_8080_8080;
    const LENGTH: usize = 8;
    let mut numbers = [0.0; N];
    for (i, number) in numbers.iter_mut().enumerate() {
        // Signs are unpredictable, so avoid a branch.
        let minus = *bytes.get(at)? == b'-';
        at += usize::from(minus);
        let word = u64::from_le_bytes(*bytes.get(at..)?.first_chunk()?) ^ u64::from_le_bytes(*b"0.000000");
        if (word.wrapping_add(BEYOND_DIGITS) | word) & HIGH_BITS != 0 {
            return None;
        }
        let end = *bytes.get(at + LENGTH)?;
        at += LENGTH + 1;
        if i + 1 < N && end != b' ' || i + 1 == N && end != b'\n' {
            // CR LF is the only other line end.
            if i + 1 < N || end != b'\r' || *bytes.get(at)? != b'\n' {
                return None;
            }
            at += 1;
        }
        // Move the digit before the point next to those after it.
        let mantissa = scan::aligned_digits(word & !0xFFFF | (word & 0xFF) << 8);
        *number = with_sign(mantissa as i32 as f32 / EXACT_POWERS_OF_TEN[6], minus);
    }
    Some((numbers, at))
}

#[inline(always)]
fn with_sign(magnitude: f32, minus: bool) -> f32 {
    f32::from_bits(magnitude.to_bits() ^ u32::from(minus) << 31)
}

/// Returns `mantissa / 10^places`, rounded once; see [`crate::number::f32_prefix`].
#[inline(always)]
fn rounded(mantissa: u64, places: usize) -> Option<f32> {
    const POWERS: [f64; MOST_PLACES + 1] = {
        let mut powers = [1.0; MOST_PLACES + 1];
        let mut i = 1;
        while i < powers.len() {
            powers[i] = 10.0 * powers[i - 1];
            i += 1;
        }
        powers
    };
    // Converting from signed integers is one instruction.
    let quotient = mantissa as i64 as f64 / POWERS.get(places)?;
    let is_half_way = quotient.to_bits() & 0x1FFF_FFFF == 0x1000_0000;
    (mantissa <= 1 << 53 && !is_half_way).then_some(quotient as f32)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::weld::mix;
    use std::fmt::Write;

    /// Pads a line to the required length.
    fn padded(line: &str) -> [u8; REACH] {
        let mut bytes = [b'9'; REACH];
        bytes[..line.len()].copy_from_slice(line.as_bytes());
        bytes
    }

    /// Reads the numbers of a line on the fast path.
    fn numbers(line: &str) -> Option<[f32; 3]> {
        let bytes = padded(line);
        if let Some((numbers, length)) = small_numbers(&bytes, 2) {
            assert_eq!(length, line.len(), "{line}");
            return Some(numbers);
        }
        let mut line = Line::new(&bytes)?.after_keyword(2)?;
        let mut numbers = [0.0; 3];
        for (i, number) in numbers.iter_mut().enumerate() {
            let (value, end) = line.number()?;
            assert_eq!(end, if i < 2 { b' ' } else { b'\n' });
            *number = value;
        }
        Some(numbers)
    }

    /// Compares two million numbers with any number of places with the standard library.
    #[test]
    fn rounds_as_the_standard_library_does() {
        let (mut line, mut texts) = (String::new(), [const { String::new() }; 3]);
        let mut read = 0;
        for seed in 0..700_000_u64 {
            line.clear();
            line.push_str("v ");
            for (i, text) in texts.iter_mut().enumerate() {
                let bits = mix(3 * seed + i as u64);
                text.clear();
                if bits & 1 != 0 {
                    text.push('-');
                }
                let digits = bits >> (4 + bits % 60);
                match bits >> 1 & 7 {
                    0..3 => write!(text, "{}.{:06}", digits % 10, bits >> 20 & 0xF_FFFF),
                    3 => write!(text, "{}.{:03}", digits % 10_000, digits >> 40),
                    4 => write!(text, "{}", digits % 10_000_000),
                    5 => write!(text, ".{}", digits % 10_000_000_000_000_000),
                    6 => write!(text, "0.{:015}", digits % 1_000_000_000_000_000),
                    _ => write!(text, "{}.{}", digits % 100_000, digits >> 32),
                }
                .unwrap();
                line.push_str(text);
                line.push(if i < 2 { ' ' } else { '\n' });
            }
            if let Some(found) = numbers(&line) {
                for (text, found) in texts.iter().zip(found) {
                    let expected: f32 = text.parse().unwrap();
                    assert_eq!(found.to_bits(), expected.to_bits(), "{text}");
                    read += 1;
                }
            }
        }
        // The fast path leaves little to the slow one.
        assert!(read > 1_900_000, "{read}");
    }

    /// Above the middle between 0.5 and the next `f32` by less than an `f64` can represent: rounded twice, it would be
    /// 0.5.
    #[test]
    fn nothing_is_rounded_twice() {
        let text = "0.5000000298023224";
        assert_eq!(text.parse::<f32>().unwrap(), 0.500_000_06);
        assert_eq!(numbers(&format!("v 1 1 {text}\n")), None);
        assert_eq!(numbers("v 1 1 0.5000000298023225\n").unwrap()[2], 0.500_000_06);
    }

    #[test]
    fn every_wrong_byte_is_seen() {
        let line = *b"v 1.234567 0.987654\n";
        assert_eq!(small_numbers(&padded(std::str::from_utf8(&line).unwrap()), 2), Some(([1.234567, 0.987654], 20)));
        for at in 2..line.len() {
            for byte in 0..=255_u8 {
                let is_alike = byte == line[at] || byte.is_ascii_digit() && line[at].is_ascii_digit();
                let mut bytes = [b'9'; REACH];
                bytes[..line.len()].copy_from_slice(&line);
                bytes[at] = byte;
                assert_eq!(small_numbers::<2>(&bytes, 2).is_some(), is_alike, "{byte} at {at}");
            }
        }
    }

    #[test]
    fn what_is_not_plain_is_left_alone() {
        for line in [
            "v 1 2 nan\n",
            "v 1 2 -\n",
            "v 1 2 .\n",
            "v 1 2 +3\n",
            "v 1 2 3e5\n",
            "v 1 2 --3\n",
            "v 1 2 123456789\n",
            "v 1  2 3\n",
            "v 0.123456 0.123456 0.1234:6\n",
            "v 0.123456 0.123456 0/123456\n",
            "v 0.123456 0.123456 :.123456\n",
        ] {
            let bytes = padded(line);
            assert!(small_numbers::<3>(&bytes, 2).is_none(), "{line}");
            let mut rest = Line::new(&bytes).unwrap().after_keyword(2).unwrap();
            let read = (0..3).all(|i| {
                rest.number().is_some_and(|(_, end)| if i < 2 { end == b' ' } else { rest.end(end).is_some() })
            });
            assert!(!read, "{line}");
        }
        assert_eq!(numbers("v -0.000000 1.5 7.\n").unwrap().map(f32::to_bits), [-0.0, 1.5, 7.0].map(f32::to_bits));
    }

    #[test]
    fn indices_are_read_with_what_is_behind() {
        let bytes = padded("1/23456789//-4 \r\n");
        let mut line = Line::new(&bytes).unwrap();
        let index = |line: &mut Line<'_>| line.index().map(|(digits, end)| (scan::aligned_digits(digits), end));
        assert_eq!(index(&mut line), Some((1, b'/')));
        assert_eq!(index(&mut line), Some((23_456_789, b'/')));
        assert_eq!(line.peek(), Some(b'/'));
        line.step();
        assert_eq!(line.peek(), Some(b'-'));
        assert_eq!(index(&mut line.clone()), None);
        line.step();
        assert_eq!(index(&mut line), Some((4, b' ')));
        assert_eq!((line.end(b' '), line.at()), (Some(17), 15));
        // Nine digits are too many.
        assert_eq!(index(&mut Line::new(&padded("123456789 ")).unwrap()), None);
    }
}
