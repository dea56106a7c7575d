//! The program that wrote a file, as the file itself states it.

use crate::Format;
use crate::encoding::to_utf8;
use crate::text::decode;
use memchr::memmem;

/// Bytes at the start of a file in which comments are searched.
const START: usize = 4096;
/// The longest name, in characters.
const LONGEST: usize = 200;
/// Size of the free text at the start of a binary STL file, in bytes.
const STL_HEADER: usize = 80;

/// Returns what a file in this format states about the program that wrote it:
///
/// | format | place |
/// |---|---|
/// | OBJ | the first comment before any statement |
/// | PLY | the first `comment` of the header |
/// | glTF | `asset.generator` |
/// | COLLADA | `authoring_tool` |
/// | STL, binary | the header |
///
/// Control characters are left out, and the text is cut after 200 characters.
pub fn exporter(bytes: &[u8], format: Format) -> Option<String> {
    let text = to_utf8(bytes);
    let text = text.bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&text.bytes);
    let start = text.get(..START).unwrap_or(text);
    let stated = match format {
        Format::Obj => {
            let lines = start.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
            lines.take_while(|line| line.is_empty() || line.starts_with(b"#")).find_map(comment)
        }
        Format::Ply => {
            let lines = start.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
            lines.take_while(|line| *line != b"end_header").find_map(|line| line.strip_prefix(b"comment "))
        }
        Format::Gltf | Format::Glb => return generator(text).and_then(|name| plain(&name)),
        Format::Collada => {
            let (open, close) = (b"<authoring_tool>", b"</authoring_tool>");
            let after = text.get(memmem::find(text, open)? + open.len()..)?;
            after.get(..memmem::find(after, close)?)
        }
        Format::Stl if !start.starts_with(b"solid") => {
            let header = start.get(..STL_HEADER)?;
            header.split(|byte| *byte == 0).next()
        }
        Format::Stl | Format::Medit | Format::MeditBinary => None,
    };
    plain(&decode(stated?))
}

/// The text of a comment with at least one letter: some are lines of dashes.
fn comment(line: &[u8]) -> Option<&[u8]> {
    line.iter().any(u8::is_ascii_alphabetic).then(|| line.trim_ascii_start()).and_then(|line| {
        let text = line.iter().position(|byte| *byte != b'#').and_then(|at| line.get(at..))?;
        Some(text.trim_ascii())
    })
}

/// The JSON string after the first key `generator`.
fn generator(text: &[u8]) -> Option<String> {
    let key = b"\"generator\"";
    let after = text.get(memmem::find(text, key)? + key.len()..)?.trim_ascii_start();
    let value = after.strip_prefix(b":")?;
    serde_json::Deserializer::from_slice(value).into_iter::<String>().next()?.ok()
}

fn plain(text: &str) -> Option<String> {
    let text: String = text.trim().chars().filter(|c| !c.is_control()).take(LONGEST).collect();
    (!text.is_empty()).then_some(text)
}
