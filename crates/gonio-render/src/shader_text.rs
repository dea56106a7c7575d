//! The text of shaders: on the web without comments and indentation, which are a quarter of it.

/// The text of the file at `$path`, relative to the source file. Its lines keep their numbers.
macro_rules! shader_text {
    ($path:literal) => {{
        const TEXT: &str = include_str!($path);
        #[cfg(not(target_family = "wasm"))]
        {
            TEXT
        }
        #[cfg(target_family = "wasm")]
        {
            const LENGTH: usize = $crate::shader_text::stripped::<{ TEXT.len() }>(TEXT).1;
            const BYTES: [u8; LENGTH] = *$crate::shader_text::stripped::<{ TEXT.len() }>(TEXT).0.first_chunk().unwrap();
            const STRIPPED: &str = match core::str::from_utf8(&BYTES) {
                Ok(text) => text,
                Err(_) => panic!("only whole comments and spaces are left out"),
            };
            STRIPPED
        }
    }};
}
pub(crate) use shader_text;

/// `text` without line comments and without spaces at the starts of lines: the bytes, padded, and their number.
#[cfg(any(test, target_family = "wasm"))]
pub(crate) const fn stripped<const N: usize>(text: &str) -> ([u8; N], usize) {
    let from = text.as_bytes();
    let mut to = [b' '; N];
    let (mut read, mut written, mut at_start) = (0, 0, true);
    while read < from.len() {
        let byte = from[read];
        if byte == b'/' && read + 1 < from.len() && from[read + 1] == b'/' {
            while read < from.len() && from[read] != b'\n' {
                read += 1;
            }
            continue;
        }
        read += 1;
        if at_start && byte == b' ' {
            continue;
        }
        at_start = byte == b'\n';
        to[written] = byte;
        written += 1;
    }
    (to, written)
}

#[cfg(test)]
mod tests {
    use super::stripped;

    #[test]
    fn comments_and_indentation_go_and_lines_stay() {
        const TEXT: &str = "// N, unit\nfloat f(float x) {\n    // half\n    return x / 2.0; // of x\n}\n";
        let (bytes, length) = stripped::<{ TEXT.len() }>(TEXT);
        assert_eq!(&bytes[..length], b"\nfloat f(float x) {\n\nreturn x / 2.0; \n}\n");
    }
}
