//! Large counts that can be read.

/// A space that lines may be broken at.
pub const SPACE: char = ' ';
/// A space that keeps a number on one line, where text wraps.
pub const NO_BREAK: char = '\u{a0}';

/// A count with `gap` between groups of three digits.
pub fn grouped(number: u64, gap: char) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3 * gap.len_utf8());
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(gap);
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_stand_in_groups_of_three() {
        let numbers = [(0, "0"), (999, "999"), (1000, "1 000"), (12345, "12 345"), (1_234_567, "1 234 567")];
        for (number, text) in numbers {
            assert_eq!(grouped(number, SPACE), text);
        }
        for (number, text) in [(0, "0"), (999, "999"), (1000, "1\u{a0}000"), (1_234_567, "1\u{a0}234\u{a0}567")] {
            assert_eq!(grouped(number, NO_BREAK), text);
        }
    }
}
