//! Decodes a file's bytes to text, with a warning where they had to be corrected.

use super::error::IntakeError;

/// The largest file that is read, in bytes.
pub(super) const LARGEST: usize = 10 * 1024 * 1024;

/// The file's text with lines ending in `\n`, and what had to be done to get it.
pub(super) fn decode(file: &str, bytes: &[u8]) -> Result<(String, Option<String>), IntakeError> {
    let file_owned = || file.to_owned();
    if bytes.len() > LARGEST {
        return Err(IntakeError::TooLarge { file: file_owned(), bytes: bytes.len() });
    }
    let (text, warning) = match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => (
            utf8_or_latin1(file, rest)?.0,
            Some(format!(
                "{file} begins with a byte order mark, which some compilers reject; gonio ignored it. Save the file \
                 as UTF-8 without BOM."
            )),
        ),
        [0xFF, 0xFE, rest @ ..] => (utf16(file, rest, u16::from_le_bytes)?, Some(utf16_warning(file))),
        [0xFE, 0xFF, rest @ ..] => (utf16(file, rest, u16::from_be_bytes)?, Some(utf16_warning(file))),
        _ => utf8_or_latin1(file, bytes)?,
    };
    if text.trim().is_empty() {
        return Err(IntakeError::Empty { file: file_owned() });
    }
    if text.trim_start().starts_with("{\\rtf") {
        return Err(IntakeError::RichText { file: file_owned() });
    }
    Ok((if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n") } else { text }, warning))
}

fn utf16_warning(file: &str) -> String {
    format!("{file} is UTF-16, which no GLSL compiler reads; gonio converted it. Save the file as UTF-8.")
}

fn utf16(file: &str, bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, IntakeError> {
    let binary = |because: &str| IntakeError::Binary { file: file.to_owned(), because: because.to_owned() };
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    let text: String = char::decode_utf16(units).collect::<Result<_, _>>().map_err(|_| binary("broken UTF-16"))?;
    if text.contains('\0') { Err(binary("zeros in UTF-16 text")) } else { Ok(text) }
}

fn utf8_or_latin1(file: &str, bytes: &[u8]) -> Result<(String, Option<String>), IntakeError> {
    let binary = |because: String| Err(IntakeError::Binary { file: file.to_owned(), because });
    if let Some(offset) = bytes.iter().position(|&b| b == 0) {
        return binary(format!("a zero byte at offset {offset}"));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok((text.to_owned(), None)),
        Err(error) => {
            // Latin-1 is text with an accent here and there: mostly ASCII, and no control characters but white space.
            let controls = bytes.iter().filter(|b| b.is_ascii_control() && !b.is_ascii_whitespace()).count();
            let foreign = bytes.iter().filter(|b| !b.is_ascii()).count();
            if controls > 0 || foreign * 5 > bytes.len() {
                return binary(format!("invalid UTF-8 at offset {}", error.valid_up_to()));
            }
            let warning = format!(
                "{file} is not UTF-8; gonio read it as Latin-1. Save the file as UTF-8, or write comments without \
                 accents."
            );
            Ok((bytes.iter().map(|&b| char::from(b)).collect(), Some(warning)))
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn text_in_the_usual_codings() {
        let utf16 = |swap: bool| -> Vec<u8> {
            "\u{FEFF}void é\r\n"
                .encode_utf16()
                .flat_map(|u| if swap { u.to_be_bytes() } else { u.to_le_bytes() })
                .collect()
        };
        for (bytes, text, warned) in [
            (b"a\r\nb\rc\n".to_vec(), "a\nb\nc\n", None),
            ("é".as_bytes().to_vec(), "é", None),
            (b"\xEF\xBB\xBF#version".to_vec(), "#version", Some("byte order mark")),
            (b"// lumi\xE8re de c\xF4t\xE9".to_vec(), "// lumière de côté", Some("Latin-1")),
            (utf16(false), "void é\n", Some("UTF-16")),
            (utf16(true), "void é\n", Some("UTF-16")),
        ] {
            let (read, warning) = decode("f", &bytes).unwrap();
            assert_eq!(read, text);
            assert_eq!(warning.is_some(), warned.is_some(), "{warning:?}");
            assert!(warning.unwrap_or_default().contains(warned.unwrap_or_default()));
        }
    }

    #[test]
    fn what_is_not_text_is_refused() {
        for (bytes, says) in [
            (b"".to_vec(), "f is empty"),
            (b" \r\n\t".to_vec(), "f is empty"),
            (b"\xEF\xBB\xBF".to_vec(), "f is empty"),
            (b"void main\0".to_vec(), "a zero byte at offset 9"),
            (b"\x89PNG\r\n\x1A\n".to_vec(), "invalid UTF-8 at offset 0"),
            (vec![0xE9; 40], "invalid UTF-8 at offset 0"),
            (b"\xFF\xFE\x00\xD8a\x00".to_vec(), "broken UTF-16"),
            (b"\xFF\xFEa\x00\x00\x00".to_vec(), "zeros in UTF-16"),
            (b"{\\rtf1\\ansi void main}".to_vec(), "word processor"),
            (vec![b'a'; LARGEST + 1], "has 10485761 bytes"),
        ] {
            let message = decode("f", &bytes).unwrap_err().to_string();
            assert!(message.contains(says), "{message}");
        }
    }
}
