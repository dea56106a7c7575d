//! The binary container: a header of 12 bytes, a chunk of JSON, a chunk of binary data (glTF 2.0, section 4).

use crate::report::Reports;
use crate::{Diagnostic, ReadError};

const HEADER: usize = 12;
const JSON_CHUNK: [u8; 4] = *b"JSON";
const BINARY_CHUNK: [u8; 4] = *b"BIN\0";

/// The contents of a file.
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    /// The contents of the buffer without a `uri`.
    pub binary: Option<&'a [u8]>,
    pub is_binary: bool,
}

/// Splits a `.glb` into its chunks; a `.gltf` is all JSON.
pub(super) fn open<'a>(bytes: &'a [u8], reports: &mut Reports) -> Result<Container<'a>, ReadError> {
    if bytes.starts_with(b"glTF") {
        return open_binary(bytes, reports);
    }
    let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if json.trim_ascii().is_empty() {
        return Err(ReadError::new("the file is empty"));
    }
    if json.len() < bytes.len() {
        reports.push(0, Diagnostic::note("begins with a byte order mark, which JSON does not allow: skipped"));
    }
    Ok(Container { json, binary: None, is_binary: false })
}

fn open_binary<'a>(bytes: &'a [u8], reports: &mut Reports) -> Result<Container<'a>, ReadError> {
    let (Some(version), Some(length)) = (u32_at(bytes, 4), u32_at(bytes, 8)) else {
        let message = format!("is cut off after {} bytes, within its header of {HEADER}", bytes.len());
        return Err(ReadError::new(message));
    };
    match version {
        2 => {}
        1 => return Err(super::version_1()),
        _ => {
            return Err(ReadError::new(format!("byte 4: unknown container version {version}: expected 2")));
        }
    }
    let length = length as usize;
    if length > bytes.len() {
        let message = format!("is cut off: its header declares {length} bytes, but there are only {}", bytes.len());
        return Err(ReadError::new(message));
    }
    if length < bytes.len() {
        let message = format!("{} bytes after the end declared in the header are ignored", bytes.len() - length);
        reports.push(0, Diagnostic::warning(message));
    }
    let bytes = &bytes[..length];
    let mut container = Container { json: &[], binary: None, is_binary: true };
    let mut at = HEADER;
    let mut number = 0_usize;
    while at < length {
        let (kind, content) = chunk(bytes, at)?;
        match (number, kind) {
            (0, JSON_CHUNK) => container.json = content,
            (0, _) => return Err(ReadError::new(format!("byte {at}: the first chunk is not JSON"))),
            (_, BINARY_CHUNK) if container.binary.is_none() => container.binary = Some(content),
            _ => {
                let name = kind.escape_ascii();
                let message = || format!("byte {at}: a chunk of the unknown type \"{name}\" is skipped");
                reports.add_without_line("unknown chunks", crate::Severity::Note, message);
            }
        }
        number += 1;
        at += 8 + content.len();
    }
    if container.json.is_empty() {
        return Err(ReadError::new("contains no JSON: the file is cut off or empty"));
    }
    Ok(container)
}

/// Returns the type and content of the chunk at a byte.
fn chunk(bytes: &[u8], at: usize) -> Result<([u8; 4], &[u8]), ReadError> {
    let kind = bytes.get(at..).and_then(|rest| rest.get(4..8)?.try_into().ok());
    let (Some(length), Some(kind)) = (u32_at(bytes, at), kind) else {
        return Err(ReadError::new(format!("byte {at}: a chunk's header is cut off")));
    };
    let rest = &bytes[at + 8..];
    match rest.get(..length as usize) {
        Some(content) => Ok((kind, content)),
        None => {
            let there = rest.len();
            Err(ReadError::new(format!(
                "byte {at}: a chunk declares {length} bytes, but only {there} are left in the file"
            )))
        }
    }
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|word| u32::from_le_bytes(*word))
}
