//! File names of pages, and addresses of pages and of places in them.

use crate::content_hash;
use std::fmt::Write as _;

/// Maximum size of a page's name in bytes, without its ending. File systems allow 255, and other names are derived from it.
const MAX_NAME_BYTES: usize = 120;

/// The file name of a submission's page, `NAME.html`: the label, with characters that are special in file systems or addresses
/// written as `~`, their number in hexadecimal, and `~`. Long names are truncated and end with a hash of the label, so that
/// different labels have different names. `index` is reserved for the overview.
pub fn page_name(label: &str) -> String {
    let mut name = String::new();
    for (at, c) in label.chars().enumerate() {
        let is_safe = c.is_alphanumeric() || matches!(c, '_' | '-' | ' ' | '+' | ',') || (c == '.' && at > 0);
        if is_safe {
            name.push(c);
        } else {
            // Writing into a String cannot fail.
            let _ = write!(name, "~{:x}~", u32::from(c));
        }
        if name.len() > MAX_NAME_BYTES {
            break;
        }
    }
    if name.len() > MAX_NAME_BYTES {
        let hash = format!("~{:016x}", content_hash(std::iter::once(label.as_bytes())));
        name.truncate(name.floor_char_boundary(MAX_NAME_BYTES - hash.len()));
        name.push_str(&hash);
    }
    if is_reserved(&name) {
        name.insert(0, '~');
    }
    name.push_str(".html");
    name
}

/// Whether a name is reserved: that of the overview, or of a device on Windows.
fn is_reserved(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    let is_port = |port: &str| stem.strip_prefix(port).is_some_and(|rest| rest.len() == 1 && rest != "0");
    name.is_empty()
        || matches!(stem.as_str(), "index" | "con" | "prn" | "aux" | "nul")
        || is_port("com")
        || is_port("lpt")
}

/// The URI of a path: relative, or `file://` of an absolute path. Also those of Windows, whose separators become `/`.
#[must_use]
pub fn uri_of(path: &str) -> String {
    let path = if cfg!(windows) { path.replace('\\', "/") } else { path.to_owned() };
    let has_drive = cfg!(windows) && path.as_bytes().get(1) == Some(&b':');
    let mut uri = String::new();
    match (path.starts_with('/'), has_drive) {
        (true, _) => uri.push_str("file://"),
        (false, true) => uri.push_str("file:///"),
        // A colon in the first part would end a scheme.
        (false, false) if path.split('/').next().is_some_and(|first| first.contains(':')) => uri.push_str("./"),
        (false, false) => {}
    }
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'.' | b'_' | b'-' | b'~' | b'/' => uri.push(char::from(byte)),
            byte => {
                let _ = write!(uri, "%{byte:02X}");
            }
        }
    }
    uri
}

/// The relative address of a submission's page.
pub fn page_address(label: &str) -> String {
    let mut address = String::from("./");
    for byte in page_name(label).bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'.' | b'_' | b'-' | b'~' => address.push(char::from(byte)),
            byte => {
                let _ = write!(address, "%{byte:02X}");
            }
        }
    }
    address
}

/// The address of the overview from a submission's page.
pub const OVERVIEW: &str = "./index.html";

/// The name of a finding's place in its page, by its number from 0: mistakes first, then messages of the compiler.
pub fn finding_anchor(number: usize) -> String {
    format!("finding-{}", number + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn different_labels_have_different_pages() {
        let labels = [
            "ada",
            "Ada L.",
            "a/b",
            "a~2f~b",
            "a\\b",
            "..",
            ".",
            "",
            "index",
            "INDEX",
            "a\0b",
            "a\u{202e}b",
            "é",
            "a?b#c",
            "CON",
            "lpt1.x",
            &"\u{1f600}".repeat(60),
            &"\u{1f600}".repeat(61),
            &"é".repeat(200),
        ];
        let names: std::collections::BTreeSet<String> = labels.iter().map(|label| page_name(label)).collect();
        assert_eq!(names.len(), labels.len(), "{names:?}");
        assert!(names.iter().all(|name| name.len() <= 125 && name.ends_with(".html")), "{names:?}");
        assert!(!names.contains("CON.html") && !names.contains("lpt1.x.html"));
        for name in &names {
            assert!(!name.contains(['/', '\\', '\0', '?', '#', '\u{202e}']) && !name.starts_with('.'), "{name}");
        }
        assert_eq!(page_name("ada"), "ada.html");
        assert!(!names.contains("index.html") && !names.contains("INDEX.html"));
        assert_eq!(page_address("Zoé K"), "./Zo%C3%A9%20K.html");
        assert_eq!(page_address("javascript:alert(1)"), "./javascript~3a~alert~28~1~29~.html");
    }
}
