//! Checks that a program prints hostile text harmlessly.
#![allow(dead_code)]

/// Everything that moves the cursor, recolours, hides or reorders text, begins a line of its own, or commands a build server.
/// It can stand in a file's name.
pub const EVIL: &str = "\u{1b}[2K\u{1b}[1A\rex07  \u{1b}[1m\u{1b}[32mcorrect\u{1b}[0m\u{8}\u{7}\u{1b}]8;;x\u{7}\u{9b}2J\u{202e}\u{2066}\u{200f}\u{2028}\u{feff}\u{7f}\n::error::x\n##[error]y";

/// [`EVIL`] for a place within a line.
pub fn evil_line() -> String {
    EVIL.replace(['\n', '\r'], " ")
}

/// The faults of an output. With `styled`, it may contain our own sequences for colours and weights.
pub fn faults(output: &[u8], styled: bool) -> Vec<String> {
    let Ok(text) = std::str::from_utf8(output) else { return vec!["it is not UTF-8".to_owned()] };
    let mut faults = Vec::new();
    for line in text.split('\n') {
        let bare = if styled { without_styles(line) } else { line.to_owned() };
        // Checked apart from the program's own table: Unicode's control characters, and what turns text around.
        let acts = |c: char| {
            c.is_control()
                || matches!(c, '\u{ad}' | '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
                || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff0}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}' | '\u{e0000}'..='\u{e0fff}')
        };
        if let Some(c) = bare.chars().find(|&c| acts(c)) {
            faults.push(format!("{c:?} in {bare:?}"));
        }
        if bare.trim_start().starts_with("::") || bare.contains("##[") || bare.trim_start().starts_with("ex07  correct")
        {
            faults.push(format!("a forged line: {bare:?}"));
        }
    }
    faults
}

/// A line without the sequences that the program and its option parser write: weights, underlines and plain colours. A style
/// that is begun ends in its line.
fn without_styles(line: &str) -> String {
    let mut bare = String::new();
    let mut rest = line;
    let mut is_styled = false;
    while let Some(start) = rest.find("\u{1b}[") {
        let (before, sequence) = rest.split_at(start);
        bare.push_str(before);
        let end = sequence.find('m').unwrap_or(0);
        let codes = sequence.get(2..end).unwrap_or("x");
        if !matches!(codes, "0" | "1" | "2" | "4" | "31" | "32" | "33" | "36") {
            break;
        }
        is_styled = codes != "0";
        rest = &sequence[end + 1..];
    }
    assert!(!is_styled || !rest.is_empty(), "a style does not end: {line:?}");
    bare + rest
}
