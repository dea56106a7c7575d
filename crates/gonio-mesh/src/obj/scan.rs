//! Finds the relevant bytes of a text, 64 at a time, as the bits of a number.
//!
//! Positions found this way do not depend on one another, so that a processor works on several numbers of a line at
//! once (after G. Langdale and D. Lemire, 2019, "Parsing gigabytes of JSON per second").

use wide::u8x16;

/// Number of bytes in a window.
pub(super) const WINDOW: usize = 64;

/// Bit `i` is set if byte `i` is not a decimal digit.
#[inline(always)]
pub(super) fn non_digits(window: &[u8; WINDOW]) -> u64 {
    bits(window, |bytes| {
        let digit = bytes - u8x16::splat(b'0');
        digit.max(u8x16::splat(10)).simd_eq(digit)
    })
}

/// Bit `i` is set if byte `i` ends a line or may join two: LF, CR, `\`.
#[inline(always)]
pub(super) fn line_ends(window: &[u8; WINDOW]) -> u64 {
    let is = |bytes: u8x16, byte: u8| bytes.simd_eq(u8x16::splat(byte));
    bits(window, |bytes| is(bytes, b'\n') | is(bytes, b'\r') | is(bytes, b'\\'))
}

/// Counts bytes that are blanks, line ends or other control characters.
pub(super) struct Blanks {
    /// Counts for each of 16 columns.
    columns: u8x16,
    /// Number of windows counted in them: after 63 of four rows a column might overflow.
    windows: u32,
    sum: usize,
}

impl Blanks {
    pub(super) fn new() -> Self {
        Blanks { columns: u8x16::splat(0), windows: 0, sum: 0 }
    }

    /// Counts the bytes of a window.
    #[inline(always)]
    pub(super) fn count(&mut self, window: &[u8; WINDOW]) {
        let blank = u8x16::splat(b' ');
        for q in 0..4 {
            let bytes = u8x16::new(std::array::from_fn(|i| window[16 * q + i]));
            // A match is -1.
            self.columns -= bytes.max(blank).simd_eq(blank);
        }
        self.windows += 1;
        if self.windows == 63 {
            self.add_columns();
        }
    }

    #[inline(never)]
    fn add_columns(&mut self) {
        self.sum += self.columns.to_array().into_iter().map(usize::from).sum::<usize>();
        self.columns = u8x16::splat(0);
        self.windows = 0;
    }

    /// Returns the count.
    pub(super) fn sum(mut self) -> usize {
        self.add_columns();
        self.sum
    }
}

#[inline(always)]
fn bits(window: &[u8; WINDOW], matches: impl Fn(u8x16) -> u8x16) -> u64 {
    let quarter = |q: usize| {
        let bytes: [u8; 16] = std::array::from_fn(|i| window[16 * q + i]);
        u64::from(matches(u8x16::new(bytes)).to_bitmask()) << (16 * q)
    };
    quarter(0) | quarter(1) | quarter(2) | quarter(3)
}

/// Returns the value of the `length` decimal digits, 1 to 8, at the start of `word` (eight bytes of text, the first one
/// lowest).
///
/// One multiplication each combines all pairs of digits, then of two-digit numbers, then of four-digit numbers.
#[inline(always)]
pub(super) fn digits(word: u64, length: usize) -> u64 {
    aligned_digits((word ^ 0x3030_3030_3030_3030) << (64 - 8 * length))
}

/// Returns the value of eight digits, each the value of a byte, the most significant one lowest.
#[inline(always)]
pub(super) fn aligned_digits(bytes: u64) -> u64 {
    const EACH_2ND: u64 = 0x00FF_00FF_00FF_00FF;
    const EACH_4TH: u64 = 0x0000_FFFF_0000_FFFF;
    // 10 a + b, then the same with 100, then with 10,000.
    let two = (bytes.wrapping_mul(1 + (10 << 8)) >> 8) & EACH_2ND;
    let four = (two.wrapping_mul(1 + (100 << 16)) >> 16) & EACH_4TH;
    four.wrapping_mul(1 + (10_000 << 32)) >> 32
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn bits_say_where_bytes_are() {
        let mut window = [b'5'; WINDOW];
        for (at, byte) in
            [(0, b'/'), (1, b'0'), (2, b'9'), (17, b':'), (33, b'\n'), (34, b'\\'), (62, 0xB5), (63, b'\r')]
        {
            window[at] = byte;
        }
        assert_eq!(non_digits(&window), 1 | 1 << 17 | 1 << 33 | 1 << 34 | 1 << 62 | 1 << 63);
        assert_eq!(line_ends(&window), 1 << 33 | 1 << 34 | 1 << 63);
        let count = |window: &[u8; WINDOW], times: usize| {
            let mut blanks = Blanks::new();
            (0..times).for_each(|_| blanks.count(window));
            blanks.sum()
        };
        assert_eq!([0, 1, 1000].map(|times| count(&window, times)), [0, 2, 2000]);
        assert_eq!((count(&[b' '; WINDOW], 200), count(&[b'!'; WINDOW], 200)), (200 * WINDOW, 0));
        // Each byte by itself.
        for byte in 0..=255 {
            assert_eq!(non_digits(&[byte; WINDOW]), if byte.is_ascii_digit() { 0 } else { u64::MAX }, "{byte}");
        }
    }

    #[test]
    fn digits_make_their_number() {
        for length in 1..=8 {
            for text in ["12345678", "99999999", "00000000", "10203040"] {
                let word = u64::from_le_bytes(text.as_bytes().try_into().unwrap());
                assert_eq!(digits(word, length), text[..length].parse::<u64>().unwrap());
            }
        }
        let word = u64::from_le_bytes(*b"12/34\n.x");
        assert_eq!(digits(word, 2), 12);
    }
}
