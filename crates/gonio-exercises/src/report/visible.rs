//! Makes characters visible that a reader cannot see: control characters, marks of direction, characters without width.
//!
//! Everything that quotes a student's file goes through here: terminal, JSON, pages, test reports, graders' results.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character moves the cursor, reorders or hides text, or takes no place of its own: control characters (C0, C1,
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
/// turned back: a backslash of the text stays as it is.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut visible = String::with_capacity(text.len() + 16);
    text.chars().for_each(|c| push_visible(&mut visible, c));
    Cow::Owned(visible)
}

/// Appends a character, or its escape where it is hidden.
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
    fn whatever_stands_for_a_hidden_character_can_be_read() {
        for c in (0..=u32::from(char::MAX)).filter_map(char::from_u32) {
            let text = c.to_string();
            let shown = visible(&text);
            assert!(!shown.chars().any(is_hidden) && !shown.is_empty(), "{c:?}: {shown:?}");
            assert_eq!(is_hidden(c), shown != text, "{c:?}");
            assert!(!c.is_control() || is_hidden(c), "{c:?}");
        }
    }
}
