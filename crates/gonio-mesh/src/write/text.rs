//! Formats numbers and names.

use std::io::Write as _;

#[derive(Default)]
pub(super) struct Text {
    pub(super) bytes: Vec<u8>,
}

impl Text {
    pub(super) fn push(&mut self, text: &str) {
        self.bytes.extend_from_slice(text.as_bytes());
    }

    pub(super) fn byte(&mut self, byte: u8) {
        self.bytes.push(byte);
    }

    /// Writes a number: the shortest text that is read as the same `f32`.
    pub(super) fn number(&mut self, value: f32) {
        let size = value.abs();
        // Without an exponent if that is short; writing to memory cannot fail.
        let _ = if size == 0.0 || (1e-5..1e9).contains(&size) {
            write!(self.bytes, "{value}")
        } else {
            write!(self.bytes, "{value:e}")
        };
    }

    /// Writes numbers, each after a blank.
    pub(super) fn numbers(&mut self, values: &[f32]) {
        for &value in values {
            self.byte(b' ');
            self.number(value);
        }
    }

    /// Writes an unsigned integer.
    pub(super) fn integer(&mut self, mut value: u64) {
        let mut digits = [0; 20];
        let mut first = digits.len();
        loop {
            first -= 1;
            digits[first] = b'0' + (value % 10) as u8;
            value /= 10;
            if value == 0 {
                break;
            }
        }
        self.bytes.extend_from_slice(&digits[first..]);
    }

    /// Writes `KEYWORD 1 2 3` and a line end.
    pub(super) fn statement(&mut self, keyword: &str, values: &[f32]) {
        self.push(keyword);
        self.numbers(values);
        self.byte(b'\n');
    }

    /// Writes `KEYWORD NAME` and a line end.
    pub(super) fn named(&mut self, keyword: &str, name: &str) {
        self.push(keyword);
        self.push(" ");
        self.push(name);
        self.push("\n");
    }
}

/// Changes a name so that OBJ and MTL read it as one: removes line ends and other control characters, surrounding
/// blanks, a final `\`, and a `#` between blanks, which would start a comment.
pub(super) fn plain_name(name: &str) -> String {
    let characters: Vec<char> = name.trim().chars().collect();
    let is_blank = |c: Option<&char>| c.is_none_or(|c| c.is_whitespace() || *c == '#');
    let plain = characters.iter().enumerate().map(|(i, &c)| match c {
        '#' if is_blank(i.checked_sub(1).and_then(|i| characters.get(i))) && is_blank(characters.get(i + 1)) => '_',
        '\\' if i + 1 == characters.len() => '_',
        c if c.is_control() => '_',
        c => c,
    });
    plain.collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn numbers_are_short_and_come_back() {
        let mut text = Text::default();
        text.numbers(&[0.0, -0.0, 1.0, -0.1, 16_777_216.0, 1e-5, 9.9e-6, 1e9, f32::MAX, f32::from_bits(1)]);
        let written = String::from_utf8(text.bytes).unwrap();
        assert_eq!(written, " 0 -0 1 -0.1 16777216 0.00001 9.9e-6 1e9 3.4028235e38 1e-45");
        let mut bits = 1_u32;
        for _ in 0..20_000 {
            bits = bits.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let value = f32::from_bits(bits);
            if value.is_finite() {
                let mut text = Text::default();
                text.number(value);
                let written = String::from_utf8(text.bytes).unwrap();
                assert_eq!(written.parse::<f32>().unwrap().to_bits(), bits, "{written}");
            }
        }
        let mut text = Text::default();
        [0, 7, 10, 4_294_967_296, u64::MAX].into_iter().for_each(|value| text.integer(value));
        assert_eq!(text.bytes, b"0710429496729618446744073709551615");
    }

    #[test]
    fn names_stay_names() {
        for name in ["red", "Material #25", "#25", "a#b\\c", "light blue"] {
            assert_eq!(plain_name(name), name);
        }
        let changed = [(" a ", "a"), ("a\nb", "a_b"), ("a # b", "a _ b"), ("#", "_"), ("a\\", "a_"), ("a ##", "a __")];
        for (name, plain) in changed {
            assert_eq!(plain_name(name), plain);
        }
    }
}
