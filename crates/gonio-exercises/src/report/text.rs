//! Text for formats with markup: escaping, and visible forms of hidden characters.

use gonio_check::verdict::{AwardedPoints, Outcome};
use gonio_language::tr;
use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character moves the cursor, reorders or hides text, or has no width: control characters (C0, C1,
/// delete), line and paragraph separators, Unicode's `Default_Ignorable_Code_Point` (marks of direction, joiners, fillers,
/// variation selectors, tags) and noncharacters. Newline and tab are among them.
pub fn is_hidden(c: char) -> bool {
    if c.is_ascii() {
        return c.is_ascii_control();
    }
    matches!(c,
        '\u{80}'..='\u{9f}' | '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
        | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
        | '\u{3164}' | '\u{fdd0}'..='\u{fdef}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{ffa0}'
        | '\u{fff0}'..='\u{fffb}' | '\u{13430}'..='\u{1343f}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}'
        | '\u{e0000}'..='\u{e0fff}')
        || u32::from(c) & 0xfffe == 0xfffe
}

/// The text with every hidden character as an escape: `\n`, `\x1b`, `\u{202e}`. The escapes are for reading and cannot be
/// reversed: a backslash in the text is unchanged.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut visible = String::with_capacity(text.len() + 16);
    text.chars().for_each(|c| push_visible(&mut visible, c));
    Cow::Owned(visible)
}

/// Appends a character, or its escape if it is hidden.
pub fn push_visible(text: &mut String, c: char) {
    // Writing into a String cannot fail.
    let _ = match c {
        c if !is_hidden(c) => {
            text.push(c);
            Ok(())
        }
        '\n' => text.write_str("\\n"),
        '\r' => text.write_str("\\r"),
        '\t' => text.write_str("\\t"),
        c if c.is_ascii() => write!(text, "\\x{:02x}", u32::from(c)),
        c => write!(text, "\\u{{{:x}}}", u32::from(c)),
    };
}

/// Maximum number of characters of a text that are shown.
const MOST_CHARACTERS: usize = 2000;

/// The text with hidden characters as escapes (`\x1b`, `\u{202e}`). Line breaks become `\n`; they and tabs are kept. Long texts
/// are truncated.
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

/// The result of [`plain`] on one line.
pub fn line(text: &str) -> String {
    plain(text).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Escapes text for the content and the attributes of XML and HTML.
pub fn escaped(text: &str) -> String {
    marked_up(&plain(text))
}

/// The text with references instead of characters that have a meaning in XML and HTML.
fn marked_up(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
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

/// The result of [`escaped`] on one line, for attributes of XML.
pub fn escaped_line(text: &str) -> String {
    escaped(&line(text))
}

/// A person's name on one line, as it is: characters that join or separate letters (in Persian and Indic scripts, and in emoji)
/// are kept after a letter or sign beyond ASCII; all other hidden characters become escapes as in [`plain`].
pub fn name(text: &str) -> String {
    let mut name = String::with_capacity(text.len().min(MOST_CHARACTERS));
    let mut before = ' ';
    for (index, c) in text.chars().enumerate() {
        if index == MOST_CHARACTERS {
            name.push('…');
            break;
        }
        match c {
            '\u{200c}' | '\u{200d}' | '\u{fe0f}' if !before.is_ascii() && !is_hidden(before) => name.push(c),
            c => push_visible(&mut name, c),
        }
        // A coloured heart, say, is joined to another sign after its variation selector.
        before = if c == '\u{fe0f}' { before } else { c };
    }
    name.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The result of [`name`], escaped for the content and the attributes of XML and HTML.
pub fn escaped_name(text: &str) -> String {
    marked_up(&name(text))
}

/// A share in percent. Only the whole is 100 %.
pub fn percent(share: f64) -> String {
    if !share.is_finite() {
        return "? %".to_owned();
    }
    let tenths = (share.clamp(0.0, 1.0) * 1000.0).round() / 10.0;
    let tenths = if share < 1.0 { tenths.min(99.9) } else { tenths };
    if tenths.fract() == 0.0 { format!("{tenths:.0} %") } else { format!("{tenths:.1} %") }
}

/// `number` of `all` in percent.
pub fn percent_of(number: usize, all: usize) -> String {
    format!("{:.0} %", 100.0 * number as f64 / all.max(1) as f64)
}

/// A number between 0 and 1 with six decimals, for machines; NaN and infinity are 0.
pub fn unit(number: f64) -> f64 {
    if number.is_finite() { (number.clamp(0.0, 1.0) * 1e6).round() / 1e6 } else { 0.0 }
}

/// The outcome in words: `does not compile`.
pub fn words(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Correct => tr!("report-correct"),
        Outcome::Wrong => tr!("report-wrong"),
        Outcome::DoesNotCompile => tr!("report-does-not-compile"),
        Outcome::Unsure => tr!("report-unsure"),
    }
}

/// The outcome for machines, as in the JSON of a verdict: `does-not-compile`.
pub fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Correct => "correct",
        Outcome::Wrong => "wrong",
        Outcome::DoesNotCompile => "does-not-compile",
        Outcome::Unsure => "unsure",
    }
}

/// The points for a share of the whole: at most two decimals; `most` only for the whole.
pub fn points(share: f64, most: f64) -> f64 {
    let (share, most) = (unit(share), if most.is_finite() { most.max(0.0) } else { 0.0 });
    let rounded = (share * most * 100.0).round() / 100.0;
    if share < 1.0 { rounded.min((most * 100.0).ceil() / 100.0 - 0.01).max(0.0) } else { most }
}

/// Awarded points in words: `17 of 20 points`.
pub fn points_line(points: &AwardedPoints) -> String {
    tr!("check-points", earned = points.earned, most = points.most)
}

/// Compares names without case, and with numbers by value: `group 9` comes before `group 10`.
pub fn by_name(a: &str, b: &str) -> std::cmp::Ordering {
    let key = |name: &str| {
        let mut key: Vec<(String, u64)> = Vec::new();
        let (mut word, mut number) = (String::new(), None::<u64>);
        for c in name.to_lowercase().chars() {
            match (c.to_digit(10), number) {
                (Some(digit), known) => {
                    number = Some(known.unwrap_or(0).saturating_mul(10).saturating_add(u64::from(digit)));
                }
                (None, Some(known)) => {
                    key.push((std::mem::take(&mut word), known));
                    number = None;
                    word.push(c);
                }
                (None, None) => word.push(c),
            }
        }
        key.push((word, number.unwrap_or(0)));
        key
    };
    key(a).cmp(&key(b)).then_with(|| a.cmp(b))
}

/// A place such as `lit.frag:14`, as far as it is known.
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
    fn hidden_characters_are_written_as_escapes() {
        assert_eq!(visible("a\0b\u{1b}[31m\u{7f}\u{9b}2J"), "a\\x00b\\x1b[31m\\x7f\\u{9b}2J");
        assert_eq!(visible("x\r\n\ty"), "x\\r\\n\\ty");
        assert_eq!(
            visible("x\u{202e}y\u{2066}\u{200b}\u{feff}\u{2028}"),
            "x\\u{202e}y\\u{2066}\\u{200b}\\u{feff}\\u{2028}"
        );
        assert_eq!(visible("\u{ffff}\u{10fffe}\u{fdd0}\u{e0041}"), "\\u{ffff}\\u{10fffe}\\u{fdd0}\\u{e0041}");
        assert!(matches!(visible("Ünïcode 日本 العربية \\x1b"), Cow::Borrowed(_)));
    }

    #[test]
    fn escapes_of_hidden_characters_are_visible() {
        for c in (0..=u32::from(char::MAX)).filter_map(char::from_u32) {
            let text = c.to_string();
            let shown = visible(&text);
            assert!(!shown.chars().any(is_hidden) && !shown.is_empty(), "{c:?}: {shown:?}");
            assert_eq!(is_hidden(c), shown != text, "{c:?}");
            assert!(!c.is_control() || is_hidden(c), "{c:?}");
        }
    }

    #[test]
    fn no_hidden_character_is_left() {
        assert_eq!(plain("a\0b\u{1b}[31m\u{7f}\u{85}"), r"a\x00b\x1b[31m\x7f\u{85}");
        assert_eq!(plain("x\u{202e}y\u{2066}\u{200b}\u{feff}"), r"x\u{202e}y\u{2066}\u{200b}\u{feff}");
        assert_eq!(plain("one\r\ntwo\rthree\tfour"), "one\ntwo\nthree\tfour");
        assert_eq!(plain("\u{ffff}\u{fffe}"), r"\u{ffff}\u{fffe}");
        assert_eq!(plain("Ünïcode 日本 العربية"), "Ünïcode 日本 العربية");
        assert_eq!(line("  a\n\tb\u{2029}c "), r"a b\u{2029}c");
    }

    #[test]
    fn names_are_kept_as_they_are() {
        for kept in [
            "Zoé Müller",
            "中村 健",
            "علی\u{200c}رضا",
            "क्\u{200d}ष",
            "👩\u{200d}🔬",
            "❤\u{fe0f}\u{200d}🔥",
            "=cmd",
            "O'Neill",
        ] {
            assert_eq!(name(kept), kept);
        }
        assert_eq!(
            name("a\u{200d}b\u{202e}c\0\r\nd é\u{200d}\u{200d}"),
            "a\\u{200d}b\\u{202e}c\\x00\\r\\nd é\u{200d}\\u{200d}"
        );
        assert_eq!(escaped_name("<b> & \"é\""), "&lt;b&gt; &amp; &quot;é&quot;");
    }

    #[test]
    fn only_the_whole_has_all_points() {
        assert_eq!([points(1.0, 20.0), points(0.5, 20.0), points(0.999_99, 20.0)], [20.0, 10.0, 19.99]);
        assert_eq!([points(f64::NAN, 5.0), points(1.0, f64::NAN), points(0.5, -3.0)], [0.0; 3]);
        assert_eq!(points(1.0 / 3.0, 100.0), 33.33);
    }

    #[test]
    fn long_texts_are_truncated() {
        let long = "é".repeat(MOST_CHARACTERS + 1);
        assert_eq!(plain(&long).chars().count(), MOST_CHARACTERS + 1);
        assert!(plain(&long).ends_with("é…"));
        assert_eq!(plain(&long[2..]), long[2..]);
    }

    #[test]
    fn only_the_whole_is_100_percent() {
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
