//! Finds the keys of a JSON document's outermost object without parsing the document.

use memchr::memchr2;

/// Keys that distinguish a glTF document from other JSON.
const KEYS_OF_GLTF: [&[u8]; 3] = [b"asset", b"accessors", b"bufferViews"];

/// Whether the outermost object of `json`, which begins with its `{`, has one of glTF's keys.
///
/// The document is scanned up to the first such key, which may be the last one, after gigabytes of buffers; this takes
/// no memory. Invalid JSON is scanned as far as possible.
pub(super) fn is_gltf(json: &[u8]) -> bool {
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(offset) = json.get(at..).and_then(|rest| rest.iter().position(|byte| is_structure(*byte))) {
        at += offset + 1;
        match json[at - 1] {
            b'{' | b'[' => depth += 1,
            b'}' | b']' if depth <= 1 => return false,
            b'}' | b']' => depth -= 1,
            _ => {
                let Some(end) = end_of_string(json, at) else { return false };
                let is_key = || json[end + 1..].trim_ascii_start().first() == Some(&b':');
                if depth == 1 && KEYS_OF_GLTF.contains(&&json[at..end]) && is_key() {
                    return true;
                }
                at = end + 1;
            }
        }
    }
    false
}

fn is_structure(byte: u8) -> bool {
    matches!(byte, b'{' | b'}' | b'[' | b']' | b'"')
}

/// Returns the position of the `"` that ends the string whose text begins at `at`.
fn end_of_string(json: &[u8], mut at: usize) -> Option<usize> {
    loop {
        at += memchr2(b'"', b'\\', json.get(at..)?)?;
        if json[at] == b'"' {
            return Some(at);
        }
        at += 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_keys_of_the_outermost_object_count() {
        let gltf = [
            r#"{"asset": {"version": "2.0"}}"#,
            "{ \"nodes\" : [ { \"name\" : \"}]\\\"\" } ] , \"asset\"\n:\t{} }",
            r#"{"buffers": [{"uri": "data:;base64,AA==\\"}], "x": [[[]], {}], "asset": {}}"#,
            // Truncated or damaged: the reader reports where.
            r#"{"accessors": [{"count": 3"#,
            r#"{"scene": 0, "bufferViews": "#,
        ];
        for json in gltf {
            assert!(is_gltf(json.as_bytes()), "{json}");
        }
        let others = [
            "{}",
            "{",
            r#"{"a": "asset", "asset"}"#,
            r#"{"model": {"asset": {"version": "2.0"}}}"#,
            r#"{"models": [{"asset": 1}]}"#,
            r#"{"a": "\"asset\": 1, \"asset"#,
            r#"{"Asset": 1, "assets": 2}"#,
            r#"{"a": 1} {"asset": 2}"#,
            "{\"asset",
            "{\"a\\",
        ];
        for json in others {
            assert!(!is_gltf(json.as_bytes()), "{json}");
        }
    }
}
