//! Text for formats that would read more into it than a student's file says: escaping, and nothing invisible.

use super::visible::push_visible;
use gonio_check::verdict::Outcome;

/// More than this of one text is not shown.
const MOST_CHARACTERS: usize = 2000;

/// The text with hidden characters as escapes (`\x1b`, `\u{202e}`). Line breaks become `\n` and stay, and so do tabs. What is
/// too long is cut off.
pub fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len().min(MOST_CHARACTERS));
    let mut characters = text.chars().peekable();
    for _ in 0..MOST_CHARACTERS {
        let Some(c) = characters.next() else { return plain };
        match c {
            '\n' | '\t' => plain.push(c),
            '\r' => {
                if characters.peek() != Some(&'\n') {
                    plain.push('\n');
                }
            }
            c => push_visible(&mut plain, c),
        }
    }
    if characters.next().is_some() {
        plain.push('…');
    }
    plain
}

/// The same on one line.
pub fn line(text: &str) -> String {
    plain(text).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// For the text and the attributes of XML and HTML alike.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in plain(text).chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// The same on one line, which attributes of XML are.
pub fn escaped_line(text: &str) -> String {
    escaped(&line(text))
}

/// A share of 1 in percent: what is not the whole is never called 100 %.
pub fn percent(share: f64) -> String {
    if !share.is_finite() {
        return "? %".to_owned();
    }
    let tenths = (share.clamp(0.0, 1.0) * 1000.0).round() / 10.0;
    let tenths = if share < 1.0 { tenths.min(99.9) } else { tenths };
    if tenths.fract() == 0.0 { format!("{tenths:.0} %") } else { format!("{tenths:.1} %") }
}

/// So many of so many, in percent.
pub fn percent_of(number: usize, all: usize) -> String {
    format!("{:.0} %", 100.0 * number as f64 / all.max(1) as f64)
}

/// A number between 0 and 1 for machines: no number is 0, and six decimals are enough.
pub fn unit(number: f64) -> f64 {
    if number.is_finite() { (number.clamp(0.0, 1.0) * 1e6).round() / 1e6 } else { 0.0 }
}

/// For people: `does not compile`.
pub fn words(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Correct => "correct",
        Outcome::Wrong => "wrong",
        Outcome::DoesNotCompile => "does not compile",
        Outcome::Unsure => "could not be judged",
    }
}

/// For machines, as in the JSON of a verdict: `does-not-compile`.
pub fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Correct => "correct",
        Outcome::Wrong => "wrong",
        Outcome::DoesNotCompile => "does-not-compile",
        Outcome::Unsure => "unsure",
    }
}

/// `1 scene`, `2 scenes`.
pub fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

/// `lit.frag:14`, as far as it is known.
pub fn place(file: Option<&str>, line_number: Option<u32>) -> Option<String> {
    let file = line(file?);
    Some(match line_number {
        Some(number) => format!("{file}:{number}"),
        None => file,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_invisible_is_left() {
        assert_eq!(plain("a\0b\u{1b}[31m\u{7f}\u{85}"), r"a\x00b\x1b[31m\x7f\u{85}");
        assert_eq!(plain("x\u{202e}y\u{2066}\u{200b}\u{feff}"), r"x\u{202e}y\u{2066}\u{200b}\u{feff}");
        assert_eq!(plain("one\r\ntwo\rthree\tfour"), "one\ntwo\nthree\tfour");
        assert_eq!(plain("\u{ffff}\u{fffe}"), r"\u{ffff}\u{fffe}");
        assert_eq!(plain("Ünïcode 日本 العربية"), "Ünïcode 日本 العربية");
        assert_eq!(line("  a\n\tb\u{2029}c "), r"a b\u{2029}c");
    }

    #[test]
    fn what_is_too_long_is_cut_off() {
        let long = "é".repeat(MOST_CHARACTERS + 1);
        assert_eq!(plain(&long).chars().count(), MOST_CHARACTERS + 1);
        assert!(plain(&long).ends_with("é…"));
        assert_eq!(plain(&long[2..]), long[2..]);
    }

    #[test]
    fn a_part_is_never_called_the_whole() {
        assert_eq!(percent(0.997), "99.7 %");
        assert_eq!(percent(0.99999), "99.9 %");
        assert_eq!(percent(2.0 / 3.0), "66.7 %");
        assert_eq!(percent(1.0), "100 %");
        assert_eq!(percent_of(2, 3), "67 %");
        assert_eq!(percent_of(0, 0), "0 %");
        assert_eq!(percent(0.0), "0 %");
        assert_eq!(percent(f64::NAN), "? %");
        assert_eq!(unit(f64::INFINITY), 0.0);
        assert_eq!(unit(1.0 / 3.0), 0.333333);
    }
}
