//! Character encodings: text files that are not UTF-8 are converted to UTF-8 before they are parsed.
//!
//! | encoding | recognised by |
//! |---|---|
//! | UTF-16, UTF-32, either byte order | a byte order mark; UTF-16 also without one, where it begins with two ASCII characters |
//! | ISO-8859-1, Windows-1252 | the `encoding` of an XML declaration, or bytes that are not UTF-8 |
//!
//! Lines and columns of diagnostics refer to the converted text, as they would if the file were saved as UTF-8.

use crate::text::{LineIndex, quote};
use crate::{Diagnostic, Model, ReadError};
use std::borrow::Cow;

/// A Unicode encoding with code units of several bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wide {
    /// Size of a code unit in bytes: 2 for UTF-16, 4 for UTF-32.
    unit_size: usize,
    is_big_endian: bool,
    /// Size of the byte order mark in bytes; 0 without one.
    mark_size: usize,
}

/// Text as UTF-8, with diagnostics of the conversion.
pub struct Utf8Text<'a> {
    /// The file's own bytes if no conversion was needed.
    pub bytes: Cow<'a, [u8]>,
    /// Empty if the bytes are the file's own.
    pub diagnostics: Vec<Diagnostic>,
}

/// Converts text in UTF-16 or UTF-32 to UTF-8. Other bytes, binary data included, are returned as they are.
///
/// Invalid code units, such as half a surrogate pair, become U+FFFD; a warning gives their number and the position of
/// the first one.
pub fn to_utf8(bytes: &[u8]) -> Utf8Text<'_> {
    match Wide::detect(bytes) {
        Some(wide) => wide.convert(bytes),
        None => Utf8Text { bytes: Cow::Borrowed(bytes), diagnostics: Vec::new() },
    }
}

/// Returns about the first `size` bytes of a file as UTF-8, for detecting the format.
pub fn start_as_utf8(bytes: &[u8], size: usize) -> Cow<'_, [u8]> {
    let start = &bytes[..bytes.len().min(size)];
    match Wide::detect(start) {
        Some(wide) => wide.convert(&start[..start.len() - start.len() % wide.unit_size]).bytes,
        None => Cow::Borrowed(start),
    }
}

/// Whether the file is text in UTF-16 or UTF-32.
pub fn is_wide(bytes: &[u8]) -> bool {
    Wide::detect(bytes).is_some()
}

/// Reads a text format: calls `read` with the text as UTF-8 and adds the diagnostics of the conversion to its model.
pub(crate) fn read_as_utf8(
    bytes: &[u8],
    read: impl FnOnce(&[u8]) -> Result<Model, ReadError>,
) -> Result<Model, ReadError> {
    let text = to_utf8(bytes);
    let mut model = read(&text.bytes)?;
    model.diagnostics.splice(..0, text.diagnostics);
    Ok(model)
}

impl Wide {
    /// Detects the encoding by the byte order mark, or UTF-16 by two initial characters that are printable ASCII or
    /// blanks.
    fn detect(bytes: &[u8]) -> Option<Wide> {
        let wide = |unit_size, is_big_endian, mark_size| Some(Wide { unit_size, is_big_endian, mark_size });
        let is_text = |byte: u8| matches!(byte, b'\t' | b'\n' | b'\r' | b' '..=b'~');
        match *bytes.first_chunk::<4>()? {
            [0xFF, 0xFE, 0, 0] => wide(4, false, 4),
            [0, 0, 0xFE, 0xFF] => wide(4, true, 4),
            [0xFF, 0xFE, ..] => wide(2, false, 2),
            [0xFE, 0xFF, ..] => wide(2, true, 2),
            [a, 0, b, 0] if is_text(a) && is_text(b) => wide(2, false, 0),
            [0, a, 0, b] if is_text(a) && is_text(b) => wide(2, true, 0),
            _ => None,
        }
    }

    fn name(self) -> &'static str {
        match (self.unit_size, self.is_big_endian) {
            (2, false) => "UTF-16 (little-endian)",
            (2, true) => "UTF-16 (big-endian)",
            (_, false) => "UTF-32 (little-endian)",
            (_, true) => "UTF-32 (big-endian)",
        }
    }

    fn convert(self, bytes: &[u8]) -> Utf8Text<'_> {
        let mut text = Converted { text: String::with_capacity(bytes.len() / self.unit_size), invalid: 0, first: 0 };
        let bytes = &bytes[self.mark_size..];
        if self.unit_size == 2 {
            let (units, rest) = bytes.as_chunks::<2>();
            let order = if self.is_big_endian { u16::from_be_bytes } else { u16::from_le_bytes };
            char::decode_utf16(units.iter().map(|unit| order(*unit))).for_each(|c| text.push(c.ok()));
            text.push_rest(rest);
        } else {
            let (units, rest) = bytes.as_chunks::<4>();
            let order = if self.is_big_endian { u32::from_be_bytes } else { u32::from_le_bytes };
            units.iter().for_each(|unit| text.push(char::from_u32(order(*unit))));
            text.push_rest(rest);
        }
        text.finish(self.name())
    }
}

struct Converted {
    text: String,
    /// The number of invalid code units, and the position of the first one in the text.
    invalid: u64,
    first: usize,
}

impl Converted {
    fn push(&mut self, character: Option<char>) {
        if character.is_none() {
            if self.invalid == 0 {
                self.first = self.text.len();
            }
            self.invalid += 1;
        }
        self.text.push(character.unwrap_or(char::REPLACEMENT_CHARACTER));
    }

    /// Handles bytes at the end that do not form a complete code unit.
    fn push_rest(&mut self, rest: &[u8]) {
        if !rest.is_empty() {
            self.push(None);
        }
    }

    fn finish(self, encoding: &str) -> Utf8Text<'static> {
        let mut diagnostics = Vec::new();
        if self.invalid > 0 {
            let (line, column) = LineIndex::new(self.text.as_bytes()).place(self.first);
            let (count, units) = (self.invalid, if self.invalid == 1 { "code unit" } else { "code units" });
            let message = format!("{count} invalid {units} of {encoding}, replaced by U+FFFD: the file is damaged");
            diagnostics.push(Diagnostic::warning(message).at(line, Some(column)));
        }
        Utf8Text { bytes: Cow::Owned(self.text.into_bytes()), diagnostics }
    }
}

/// Returns an XML document as UTF-8, with a warning if its encoding was guessed.
///
/// A byte order mark decides first, then the `encoding` of the XML declaration. Encodings other than those in the table
/// above are read as UTF-8 if the bytes are valid UTF-8, and as Windows-1252 otherwise: names may then be wrong, but
/// all markup and numbers are ASCII.
pub(crate) fn xml_to_text(bytes: &[u8]) -> (Cow<'_, str>, Vec<Diagnostic>) {
    let utf8 = to_utf8(bytes);
    let is_marked = bytes.starts_with(b"\xEF\xBB\xBF");
    let bytes = match utf8.bytes {
        Cow::Owned(bytes) => return (Cow::Owned(into_string(bytes)), utf8.diagnostics),
        Cow::Borrowed(bytes) => bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes),
    };
    let declared = declared_encoding(bytes).filter(|_| !is_marked).unwrap_or(b"UTF-8");
    let is_declared = |names: &[&str]| names.iter().any(|name| declared.eq_ignore_ascii_case(name.as_bytes()));
    if is_declared(&["ISO-8859-1", "ISO_8859-1", "ISO8859-1", "Latin1", "Latin-1", "Windows-1252", "CP1252"]) {
        return (windows_1252(bytes), Vec::new());
    }
    let invalid = match std::str::from_utf8(bytes) {
        Ok(text) => return (Cow::Borrowed(text), Vec::new()),
        Err(invalid) => invalid,
    };
    let (line, column) = LineIndex::new(bytes).place(invalid.valid_up_to());
    let reason = if is_declared(&["UTF-8", "UTF8", "US-ASCII", "ASCII"]) {
        "is not UTF-8".to_owned()
    } else {
        format!("has the encoding {}, which is not supported", quote(declared))
    };
    let message = format!(
        "the text {reason}: characters beyond ASCII are read as Windows-1252; save it as UTF-8 if names are wrong"
    );
    (windows_1252(bytes), vec![Diagnostic::warning(message).at(line, Some(column))])
}

fn into_string(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned())
}

/// Returns the `encoding` of the XML declaration at the start of a document.
fn declared_encoding(document: &[u8]) -> Option<&[u8]> {
    const LONGEST: usize = 256;
    let start = document.trim_ascii_start();
    let declaration = start[..start.len().min(LONGEST)].strip_prefix(b"<?xml")?;
    let end = declaration.windows(2).position(|end| end == b"?>")?;
    let declaration = &declaration[..end];
    let name = b"encoding";
    let at = declaration.windows(name.len()).position(|window| window == name)?;
    let value = declaration[at + name.len()..].trim_ascii_start().strip_prefix(b"=")?.trim_ascii_start();
    let (mark, value) = value.split_first().filter(|(mark, _)| matches!(mark, b'"' | b'\''))?;
    value.iter().position(|byte| byte == mark).map(|end| &value[..end])
}

/// The characters of Windows-1252 from 0x80 to 0x9F, where ISO-8859-1 has control characters. Five are unassigned.
const BEYOND_LATIN_1: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8D}', 'Ž', '\u{8F}', '\u{90}', '‘', '’',
    '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9D}', 'ž', 'Ÿ',
];

/// Decodes Windows-1252, a superset of ISO-8859-1 except for control characters.
pub(crate) fn windows_1252(bytes: &[u8]) -> Cow<'_, str> {
    if let Ok(text) = std::str::from_utf8(bytes)
        && text.is_ascii()
    {
        return Cow::Borrowed(text);
    }
    let character = |&byte: &u8| match byte {
        0x80..=0x9F => BEYOND_LATIN_1[usize::from(byte - 0x80)],
        _ => char::from(byte),
    };
    Cow::Owned(bytes.iter().map(character).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Encodes a text in each multi-byte encoding, with and without a byte order mark.
    fn encoded(text: &str) -> Vec<(Vec<u8>, bool)> {
        let mut all = Vec::new();
        for mark in ["\u{feff}", ""] {
            let text = format!("{mark}{text}");
            let utf16 = |order: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(order).collect::<Vec<u8>>();
            let utf32 = |order: fn(u32) -> [u8; 4]| text.chars().flat_map(|c| order(c.into())).collect::<Vec<u8>>();
            let has_mark = !mark.is_empty();
            all.push((utf16(u16::to_le_bytes), has_mark));
            all.push((utf16(u16::to_be_bytes), has_mark));
            if has_mark {
                all.push((utf32(u32::to_le_bytes), true));
                all.push((utf32(u32::to_be_bytes), true));
            }
        }
        all
    }

    #[test]
    fn wide_encodings_become_utf_8() {
        for text in ["o Würfel 🎲\nv 1 2 3\n", "<?xml version=\"1.0\"?>", "{\"asset\": {}}", "# Würfel\r\n"] {
            for (bytes, _) in encoded(text) {
                let converted = to_utf8(&bytes);
                assert_eq!(std::str::from_utf8(&converted.bytes), Ok(text), "{bytes:?}");
                assert_eq!(converted.diagnostics, []);
                // A prefix may end anywhere.
                for size in 8..bytes.len() {
                    let start = start_as_utf8(&bytes, size);
                    let start = String::from_utf8_lossy(&start);
                    assert!(text.starts_with(start.trim_end_matches('\u{fffd}')), "{size}: {start:?}");
                }
            }
        }
        // Without initial ASCII characters only the mark identifies the encoding.
        for (bytes, has_mark) in encoded("Ж = 1\n") {
            assert_eq!(is_wide(&bytes), has_mark, "{bytes:?}");
        }
    }

    #[test]
    fn other_bytes_stay_as_they_are() {
        let others: [&[u8]; 9] = [
            b"",
            b"v",
            b"v 1\0",
            b"\xEF\xBB\xBFv 1",
            b"\x01\0\0\0\x02\0\0\0",
            b"\0\0\0\x01",
            b"glTF\x02\0\0\0",
            b"a\0\0b",
            b"a\0\0\0",
        ];
        for bytes in others {
            assert!(matches!(to_utf8(bytes).bytes, Cow::Borrowed(same) if same == bytes), "{bytes:?}");
        }
    }

    #[test]
    fn invalid_code_units_are_replaced_and_reported() {
        let mut bytes: Vec<u8> = "o a\r\no b".encode_utf16().flat_map(u16::to_le_bytes).collect();
        // A lone low surrogate, a high one before an x, and half a code unit.
        bytes.extend([0x00, 0xDC, 0x00, 0xD8, b'x', 0, b'!']);
        let converted = to_utf8(&bytes);
        assert_eq!(String::from_utf8_lossy(&converted.bytes), "o a\r\no b\u{fffd}\u{fffd}x\u{fffd}");
        let messages: Vec<String> = converted.diagnostics.iter().map(ToString::to_string).collect();
        let expected =
            "2:4: warning: 3 invalid code units of UTF-16 (little-endian), replaced by U+FFFD: the file is damaged";
        assert_eq!(messages, [expected]);
        let beyond = [0xFF, 0xFE, 0, 0, b'a', 0, 0, 0, 0, 0, 0x11, 0];
        assert_eq!(&*to_utf8(&beyond).bytes, "a\u{fffd}".as_bytes());
    }

    #[test]
    fn xml_declares_its_encoding() {
        let text = |bytes: &[u8]| {
            let (text, diagnostics) = xml_to_text(bytes);
            let messages: Vec<String> = diagnostics.iter().map(ToString::to_string).collect();
            (text.into_owned(), messages.join("\n"))
        };
        let declared = |encoding: &str, rest: &[u8]| {
            [format!("<?xml version='1.0' encoding = '{encoding}'?>\n").as_bytes(), rest].concat()
        };
        for name in ["ISO-8859-1", "iso-8859-1", "windows-1252"] {
            let (found, messages) = text(&declared(name, b"<a>\x80\xE9</a>"));
            assert_eq!((found.lines().nth(1), messages.as_str()), (Some("<a>€é</a>"), ""), "{name}");
        }
        // A declaration is trusted even if the bytes happen to be UTF-8; but a mark overrides it.
        let utf8 = declared("ISO-8859-1", "é".as_bytes());
        assert!(text(&utf8).0.ends_with("Ã©"));
        let marked = [&b"\xEF\xBB\xBF"[..], &utf8].concat();
        assert!(text(&marked).0.ends_with("\né") && text(&marked).0.starts_with("<?xml"));
        // In an unknown encoding only ASCII is certain.
        assert_eq!(text(&declared("Shift_JIS", b"abc")).1, "");
        let messages = text(&declared("Shift_JIS", b"a\x83\x65")).1;
        assert!(
            messages.starts_with("2:2: warning: the text has the encoding \"Shift_JIS\", which is not supported"),
            "{messages}"
        );
        let (found, messages) = text(b"<a>\xFC</a>");
        assert_eq!(found, "<a>ü</a>");
        assert!(messages.starts_with("1:4: warning: the text is not UTF-8: "), "{messages}");
        // A document saved as UTF-8 that still declares UTF-16.
        assert_eq!(text("<?xml version='1.0' encoding='UTF-16'?>é".as_bytes()).1, "");
        for (bytes, _) in encoded("<?xml version='1.0' encoding='ISO-8859-1'?><é/>") {
            assert!(text(&bytes).0.ends_with("?><é/>"));
        }
    }
}
