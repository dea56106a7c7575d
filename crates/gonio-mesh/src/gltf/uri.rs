//! URIs: data inside them (RFC 2397), base64 (RFC 4648, section 4), escapes (RFC 3986, section 2.1).

use std::borrow::Cow;

/// The resource that a `uri` refers to.
pub(super) enum Uri<'a> {
    /// Embedded data: the bytes, or why they are invalid.
    Data(Result<Vec<u8>, String>),
    /// A file beside the model, with escapes resolved.
    File(Cow<'a, str>),
    /// A resource with a scheme such as `http:`.
    Elsewhere,
}

impl<'a> Uri<'a> {
    pub fn parse(uri: &'a str) -> Self {
        if let Some(data) = uri.strip_prefix("data:") {
            return Uri::Data(data_of(data));
        }
        // One letter before a colon is a Windows drive.
        match uri.split_once("://") {
            Some((scheme, _)) if scheme.len() > 1 && scheme.bytes().all(|b| b.is_ascii_alphanumeric()) => {
                Uri::Elsewhere
            }
            _ => Uri::File(unescaped(uri)),
        }
    }
}

fn data_of(data: &str) -> Result<Vec<u8>, String> {
    let (kind, content) = data.split_once(',').ok_or("it has no comma before the data")?;
    if kind.ends_with(";base64") { base64(content) } else { Ok(unescaped_bytes(content)) }
}

/// Decodes base64; line breaks and blanks are skipped, padding at the end may be missing.
fn base64(text: &str) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 3);
    let (mut bits, mut count) = (0_u32, 0_u32);
    for (at, letter) in text.bytes().enumerate() {
        let value = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b' ' | b'\t' | b'\r' | b'\n' => continue,
            b'=' if text[at..].bytes().all(|b| matches!(b, b'=' | b' ' | b'\t' | b'\r' | b'\n')) => break,
            _ => return Err(format!("its character {} is not base64", at + 1)),
        };
        bits = bits << 6 | u32::from(value);
        count += 1;
        if count == 4 {
            bytes.extend(&bits.to_be_bytes()[1..]);
            (bits, count) = (0, 0);
        }
    }
    match count {
        0 => {}
        2 => bytes.push((bits >> 4) as u8),
        3 => bytes.extend([(bits >> 10) as u8, (bits >> 2) as u8]),
        _ => return Err("its base64 is cut off".to_owned()),
    }
    Ok(bytes)
}

fn unescaped(text: &str) -> Cow<'_, str> {
    if !text.contains('%') {
        return Cow::Borrowed(text);
    }
    Cow::Owned(String::from_utf8_lossy(&unescaped_bytes(text)).into_owned())
}

/// Resolves escapes; a `%` without two hexadecimal digits stays as it is.
fn unescaped_bytes(text: &str) -> Vec<u8> {
    let digit = |byte: Option<&u8>| byte.and_then(|b| (*b as char).to_digit(16));
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut i = 0;
    while let Some(&byte) = bytes.get(i) {
        match (byte, digit(bytes.get(i + 1)), digit(bytes.get(i + 2))) {
            (b'%', Some(high), Some(low)) => {
                out.push((high * 16 + low) as u8);
                i += 3;
            }
            _ => {
                out.push(byte);
                i += 1;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// The examples of RFC 4648, section 10.
    #[test]
    fn base64_as_its_definition_has_it() {
        let cases =
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYg==", "foob"), ("Zm9vYmE=", "fooba")];
        for (encoded, plain) in cases {
            assert_eq!(base64(encoded).unwrap(), plain.as_bytes());
            assert_eq!(base64(encoded.trim_end_matches('=')).unwrap(), plain.as_bytes());
        }
        assert_eq!(base64("Zm9v\r\nYmFy").unwrap(), b"foobar");
        assert_eq!(base64("+/8A").unwrap(), [0xFB, 0xFF, 0x00]);
        assert_eq!(base64("Zm9v!").unwrap_err(), "its character 5 is not base64");
        assert_eq!(base64("Zg==Zg").unwrap_err(), "its character 3 is not base64");
        assert_eq!(base64("Zm9vY").unwrap_err(), "its base64 is cut off");
    }

    #[test]
    fn escapes() {
        assert_eq!(unescaped("a%20b%C3%A4.bin"), "a b\u{e4}.bin");
        assert_eq!(unescaped("100%"), "100%");
        assert_eq!(unescaped("100%zz%4"), "100%zz%4");
    }

    #[test]
    fn kinds_of_uris() {
        assert!(matches!(Uri::parse("https://a.org/b.bin"), Uri::Elsewhere));
        assert!(matches!(Uri::parse("C://a.bin"), Uri::File(name) if name == "C://a.bin"));
        assert!(matches!(Uri::parse("data:,a%20b"), Uri::Data(Ok(bytes)) if bytes == b"a b"));
        assert!(
            matches!(Uri::parse("data:x;base64"), Uri::Data(Err(reason)) if reason == "it has no comma before the data")
        );
    }
}
