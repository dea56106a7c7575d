//! Text for a terminal on which nothing in a file can act: styles are ours, and every other control character is shown as an
//! escape.
//!
//! A [`TerminalPage`] is built line by line. A line may quote anything: newlines in it do not end it, and escape sequences in it
//! are printed, not interpreted. [`Style`] writes a mark that no input contains, because part of it is a random number of this
//! process; only these marks become the terminal's sequences. JSON and TOML stay equivalent: hidden characters become their own
//! escapes.
#![allow(clippy::disallowed_types)]

use gonio_exercises::report::{is_hidden, push_visible};
use std::collections::hash_map::RandomState;
use std::fmt::{Display, Formatter, Result};
use std::hash::BuildHasher;
use std::sync::LazyLock;

/// The number of characters of a line that are printed; `--json` has the rest.
const LONGEST_LINE: usize = 2000;

/// The beginning of a style's mark: a noncharacter and 64 random bits, so that no file can contain it.
static MARK: LazyLock<String> = LazyLock::new(|| format!("\u{10ffff}{:016x}", RandomState::new().hash_one("style")));

/// A style within a line: `{Bold}text{Bold:#}`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Headings and places.
    Bold,
    /// Details.
    Dim,
    /// Correct results.
    Green,
    /// Errors.
    Red,
    /// Warnings.
    Yellow,
    /// Notes.
    Cyan,
}

impl Style {
    const ALL: [Style; 6] = [Style::Bold, Style::Dim, Style::Green, Style::Red, Style::Yellow, Style::Cyan];

    /// The letter in a mark.
    fn letter(self) -> char {
        match self {
            Style::Bold => 'b',
            Style::Dim => 'd',
            Style::Green => 'g',
            Style::Red => 'r',
            Style::Yellow => 'y',
            Style::Cyan => 'c',
        }
    }

    fn sequence(self) -> anstyle::Style {
        use anstyle::{AnsiColor, Style as Ansi};
        match self {
            Style::Bold => Ansi::new().bold(),
            Style::Dim => Ansi::new().dimmed(),
            Style::Green => AnsiColor::Green.on_default().bold(),
            Style::Red => AnsiColor::Red.on_default().bold(),
            Style::Yellow => AnsiColor::Yellow.on_default().bold(),
            Style::Cyan => AnsiColor::Cyan.on_default().bold(),
        }
    }
}

impl Display for Style {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let letter = if f.alternate() { '#' } else { self.letter() };
        write!(f, "{}{letter}", *MARK)
    }
}

/// Lines for a terminal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TerminalPage {
    /// Escaped text with newlines and the sequences of our styles.
    ready: String,
}

impl TerminalPage {
    pub fn new() -> Self {
        TerminalPage::default()
    }

    /// The lines of a text, with spaces for tabs.
    pub fn from_text(text: &str) -> Self {
        let mut page = TerminalPage::new();
        page.text(text);
        page
    }

    /// Appends one line, whatever it contains.
    pub fn line(&mut self, line: impl Display) {
        self.ready.push_str(&line_for_terminal(&line));
        self.ready.push('\n');
    }

    /// Appends an empty line.
    pub fn blank(&mut self) {
        self.ready.push('\n');
    }

    /// Appends a heading, after an empty line unless it is the first line.
    pub fn heading(&mut self, text: impl Display) {
        if !self.is_empty() {
            self.blank();
        }
        self.line(format_args!("{}{text}{:#}", Style::Bold, Style::Bold));
    }

    /// Appends the lines of a text, with spaces for tabs.
    pub fn text(&mut self, text: &str) {
        text.lines().for_each(|line| self.line(line.replace('\t', "    ")));
    }

    /// Whether it has no lines.
    pub fn is_empty(&self) -> bool {
        self.ready.is_empty()
    }

    /// The text for a terminal with colours; `anstream` removes them for others.
    pub fn for_terminal(&self) -> &str {
        &self.ready
    }
}

/// One line with our styles as the terminal's sequences, hidden characters as escapes, no commands of a build server, and a
/// limited length.
pub fn line_for_terminal(line: &impl Display) -> String {
    let line = line.to_string();
    let mut ready = String::with_capacity(line.len());
    let mut room = LONGEST_LINE;
    let mut left_out = 0;
    let mut styled = false;
    for (index, piece) in line.split(MARK.as_str()).enumerate() {
        let mut characters = piece.chars();
        if index > 0 {
            let letter = characters.next();
            let style = Style::ALL.into_iter().find(|style| Some(style.letter()) == letter);
            let sequence = style.map_or_else(|| format!("{:#}", Style::Bold.sequence()), |s| s.sequence().to_string());
            ready.push_str(&sequence);
            styled = style.is_some();
        }
        for c in characters {
            if room == 0 {
                left_out += 1;
            } else {
                room -= 1;
                push_visible(&mut ready, c);
            }
        }
    }
    if styled {
        ready.push_str(&format!("{:#}", Style::Bold.sequence()));
    }
    if left_out > 0 {
        ready.push_str(&format!("... ({left_out} characters more)"));
    }
    without_commands(ready)
}

/// Escapes what build servers execute in the lines of a log: GitHub lines that begin with `::`, and `##[` anywhere; Azure
/// `##vso[`, TeamCity `##teamcity[`.
fn without_commands(line: String) -> String {
    let mut ready = String::with_capacity(line.len());
    for (index, piece) in line.split("##").enumerate() {
        if index > 0 {
            let is_command = piece.trim_start_matches(|c: char| c.is_ascii_alphabetic()).starts_with('[');
            ready.push_str(if is_command { "#\\x23" } else { "##" });
        }
        ready.push_str(piece);
    }
    let start = ready.len() - ready.trim_start().len();
    if ready[start..].starts_with("::") {
        ready.replace_range(start..=start, "\\x3a");
    }
    ready
}

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

/// TOML with hidden characters, and each second `#`, within strings and quoted keys as `\uXXXX`; elsewhere TOML has none. A
/// literal string that contains one becomes a basic string.
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

    fn one(line: impl Display) -> String {
        line_for_terminal(&line)
    }

    #[test]
    fn styles_cannot_be_forged() {
        let forged = "\u{1b}[32mcorrect\u{1b}[0m\u{9b}2K\rx";
        let (bold, end) = (Style::Bold, Style::Bold);
        assert_eq!(
            one(format_args!("{bold}{forged}{end:#}")),
            "\u{1b}[1m\\x1b[32mcorrect\\x1b[0m\\u{9b}2K\\rx\u{1b}[0m"
        );
        // A mark of another process is text.
        let old = MARK.replace(|c: char| c.is_ascii_hexdigit(), "0");
        assert_eq!(one(format!("{old}gright")), format!("\\u{{10ffff}}{}gright", &old[4..]));
        // An open style ends with its line.
        assert_eq!(one(format_args!("{}x", Style::Dim)), "\u{1b}[2mx\u{1b}[0m");
    }

    #[test]
    fn a_line_stays_a_line() {
        let mut page = TerminalPage::new();
        page.line("a\nex04  correct: all of it\u{2028}b\tc");
        page.text("a\tb\n\nc\r\nd\re");
        assert_eq!(page.for_terminal(), "a\\nex04  correct: all of it\\u{2028}b\\tc\na    b\n\nc\nd\\re\n");
    }

    #[test]
    fn a_long_line_is_cut_with_a_remark() {
        let line = one(format_args!("{}{}{:#}", Style::Red, "é".repeat(LONGEST_LINE + 3), Style::Red));
        assert!(
            line.starts_with("\u{1b}[1m\u{1b}[31mé") && line.ends_with("é\u{1b}[0m... (3 characters more)"),
            "{line}"
        );
        assert_eq!(one("x".repeat(LONGEST_LINE)).len(), LONGEST_LINE);
    }

    #[test]
    fn commands_of_build_servers_are_escaped() {
        assert_eq!(one("  ::error file=a::b"), "  \\x3a:error file=a::b");
        assert_eq!(one("::stop-commands::x"), "\\x3a:stop-commands::x");
        assert_eq!(one("##[error]b ###vso[task.complete]"), "#\\x23[error]b ###vso[task.complete]");
        assert_eq!(one("a ##teamcity["), "a #\\x23teamcity[");
        assert_eq!(one("a::b ## heading, x##y[1]"), "a::b ## heading, x#\\x23y[1]");
    }

    #[test]
    fn json_stays_equivalent() {
        let hostile = "\u{1b}\u{7f}\u{2028}\u{e0041}\u{ffff}\nü##[error]###";
        let value = serde_json::json!({ "a\u{9b}\u{202e}": hostile, "b": [1, "#\t"] });
        let text = json_for_terminal(&serde_json::to_string_pretty(&value).unwrap());
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), value);
        assert!(!text.chars().any(|c| is_hidden(c) && c != '\n') && !text.contains("##"), "{text}");
    }

    #[test]
    fn toml_stays_equivalent_in_every_kind_of_string() {
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
