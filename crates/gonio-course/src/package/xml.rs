//! Moodle's XML: text, files and questions.

/// A text as character data.
pub(super) fn cdata(text: &str) -> String {
    // XML has no way to write most control characters.
    let plain: String = text.chars().filter(|c| !c.is_control() || matches!(c, '\n' | '\t')).collect();
    format!("<![CDATA[{}]]>", plain.replace("]]>", "]]]]><![CDATA[>"))
}

/// A text for the content of an element or an attribute.
pub(super) fn escaped(text: &str) -> String {
    let plain = text.chars().filter(|c| !c.is_control() || matches!(c, '\n' | '\t'));
    plain.fold(String::new(), |mut escaped, c| {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
        escaped
    })
}

/// A file within a question.
pub(super) fn file(name: &str, bytes: &[u8]) -> String {
    format!("<file name=\"{}\" path=\"/\" encoding=\"base64\">{}</file>\n", escaped(name), base64(bytes))
}

/// Bytes in base64 (RFC 4648, section 4).
pub(super) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|at| part.get(at).copied().unwrap_or(0));
        let all = u32::from(a) << 16 | u32::from(b) << 8 | u32::from(c);
        for digit in 0..4 {
            let is_padding = digit > part.len();
            let index = (all >> (18 - 6 * digit) & 63) as usize;
            text.push(if is_padding { '=' } else { DIGITS[index] as char });
        }
    }
    text
}

/// The text of an exercise with links to the pictures that are within the question, and those pictures.
pub(super) fn question_text(markdown: &str, pictures: &[(String, Vec<u8>)]) -> String {
    let mut text = markdown.to_owned();
    for (name, _) in pictures {
        text = text.replace(&format!("]({name})"), &format!("](@@PLUGINFILE@@/{name})"));
    }
    let files: String = pictures.iter().map(|(name, bytes)| file(name, bytes)).collect();
    format!("<questiontext format=\"markdown\">\n<text>{}</text>\n{files}</questiontext>\n", cdata(&text))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// RFC 4648, section 10.
    #[test]
    fn base64_has_the_values_of_the_standard() {
        for (text, expected) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(text.as_bytes()), expected);
        }
    }

    #[test]
    fn character_data_ends_where_it_should() {
        assert_eq!(cdata("a ]]> b\u{1b}"), "<![CDATA[a ]]]]><![CDATA[> b]]>");
        assert_eq!(escaped("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
    }
}
