//! Equivalent JSON and TOML in which every hidden character is an escape, so that a terminal can show them.

use gonio_exercises::report::is_hidden;

/// JSON with hidden characters as `\uXXXX`. A second `#` is escaped too: build servers execute `##[` in a log.
pub fn json_for_terminal(json: &str) -> String {
    let mut ready = String::with_capacity(json.len());
    let mut last = '\n';
    for c in json.chars() {
        // Outside strings there are no such characters except newlines.
        let is_plain = c == '\n' || !(is_hidden(c) || (c == '#' && last == '#'));
        last = c;
        if is_plain {
            ready.push(c);
        } else {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| ready.push_str(&format!("\\u{unit:04x}")));
        }
    }
    ready
}

/// TOML with hidden characters, and each second `#`, within strings and quoted keys as `\uXXXX`; elsewhere TOML has none. A literal string that
/// contains one becomes a basic string.
pub fn toml_for_terminal(toml: &str) -> String {
    let mut ready = String::with_capacity(toml.len());
    let mut rest = toml;
    while let Some(start) = rest.find(['"', '\'', '#']) {
        ready.push_str(&rest[..start]);
        rest = &rest[start..];
        let Some(quotes) = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|quotes| rest.starts_with(quotes)) else {
            let comment = rest.find('\n').unwrap_or(rest.len());
            ready.push_str(&rest[..comment]);
            rest = &rest[comment..];
            continue;
        };
        let end = string_end(rest, quotes);
        ready.push_str(&toml_string(&rest[..end], quotes));
        rest = &rest[end..];
    }
    ready.push_str(rest);
    ready
}

/// The end of the string at the beginning of `text`, including its quotes.
fn string_end(text: &str, quotes: &str) -> usize {
    let mut at = quotes.len();
    while at < text.len() && !text[at..].starts_with(quotes) {
        let is_escape = quotes.starts_with('"') && text[at..].starts_with('\\');
        let skipped = text[at..].chars().take(if is_escape { 2 } else { 1 });
        at += skipped.map(char::len_utf8).sum::<usize>();
    }
    at = (at + quotes.len()).min(text.len());
    // One or two quotes of the string itself may precede the three that end it.
    while quotes.len() == 3 && text[at..].starts_with(&quotes[..1]) {
        at += 1;
    }
    at
}

/// Escapes a string with its quotes.
fn toml_string(string: &str, quotes: &str) -> String {
    let stays = |c: char| !is_hidden(c) || (c == '\n' && quotes.len() == 3);
    let body = string.strip_prefix(quotes).and_then(|body| body.strip_suffix(quotes));
    let Some(body) = body.filter(|body| !body.chars().all(stays) || body.contains("##")) else {
        return string.to_owned();
    };
    let is_literal = quotes.starts_with('\'');
    let quotes = quotes.replace('\'', "\"");
    let mut escaped = quotes.clone();
    for c in body.chars() {
        match c {
            '#' if escaped.ends_with('#') => escaped.push_str("\\u0023"),
            '"' | '\\' if is_literal => escaped.extend(['\\', c]),
            c if stays(c) => escaped.push(c),
            c if u32::from(c) > 0xffff => escaped.push_str(&format!("\\U{:08x}", u32::from(c))),
            c => escaped.push_str(&format!("\\u{:04x}", u32::from(c))),
        }
    }
    escaped + &quotes
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn json_stays_what_it_was() {
        let hostile = "\u{1b}\u{7f}\u{2028}\u{e0041}\u{ffff}\nü##[error]###";
        let value = serde_json::json!({ "a\u{9b}\u{202e}": hostile, "b": [1, "#\t"] });
        let text = json_for_terminal(&serde_json::to_string_pretty(&value).unwrap());
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), value);
        assert!(!text.chars().any(|c| is_hidden(c) && c != '\n') && !text.contains("##"), "{text}");
    }

    #[test]
    fn toml_says_the_same_in_every_kind_of_string() {
        for (toml, expected) in [
            ("a = \"x\u{202e}y\\\"\u{9b}\" # c", "a = \"x\\u202ey\\\"\\u009b\" # c"),
            ("a = 'x\u{202e}\"\\' # 'c'\nb = ''", "a = \"x\\u202e\\\"\\\\\" # 'c'\nb = ''"),
            ("a = \"\"\"x\n\u{feff}\"\"\"\"\"\nb = \"\"", "a = \"\"\"x\n\\ufeff\"\"\"\"\"\nb = \"\""),
            ("a = '''x\n\u{e0041}\\''''\n'k\u{202e}' = 1", "a = \"\"\"x\n\\U000e0041\\\\'\"\"\"\n\"k\\u202e\" = 1"),
            ("a = 'plain \\ \"' # it's\nb = '''\n'''", "a = 'plain \\ \"' # it's\nb = '''\n'''"),
            ("a = '##[x]' ## b", "a = \"#\\u0023[x]\" ## b"),
            ("a = \"\u{202e}", "a = \"\u{202e}"),
        ] {
            assert_eq!(toml_for_terminal(toml), expected);
        }
    }
}
