//! Formats of vertex buffers: tells them apart, and reads raw floats. Text is read by `table`, JSON by `json`.

use super::buffer::{Buffer, BufferError, Data, WIDTHS};
use super::{json, table};
use gonio_language::tr;

/// Maximum size of a file, in bytes.
pub const MOST_BYTES: usize = 100 << 20;

/// Reads a vertex buffer: CSV (or semicolons, tabs, spaces), JSON or raw little-endian floats. The file's ending decides the
/// format, or its content if the ending is unknown. The endings `.raw8`, `.raw6`, `.raw5` and `.raw3` state the number of
/// floats per vertex.
pub fn read_buffer(name: &str, bytes: &[u8]) -> Result<Buffer, BufferError> {
    if bytes.len() > MOST_BYTES {
        let message = tr!("check-buffer-file-too-large", count = bytes.len() >> 20, most = MOST_BYTES >> 20);
        return Err(BufferError::new(message));
    }
    if bytes.is_empty() {
        return Err(BufferError::new(tr!("check-buffer-the-file-is-empty-was-it")));
    }
    let ending = name.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_ascii_lowercase());
    let is_text = looks_like_text(bytes);
    match ending.as_str() {
        "json" => json::read(bytes),
        "csv" | "tsv" | "txt" => table::read(bytes),
        "raw" | "bin" | "f32" | "dat" if !is_text => read_raw(bytes, None),
        "raw8" | "raw6" | "raw5" | "raw3" if !is_text => {
            read_raw(bytes, ending.bytes().last().map(|digit| usize::from(digit - b'0')))
        }
        _ if !is_text => read_raw(bytes, None),
        _ => match bytes.trim_ascii_start().first() {
            Some(b'[' | b'{') => json::read(bytes),
            _ => table::read(bytes),
        },
    }
}

/// Number of bytes that are examined to distinguish text from numbers.
const ENOUGH: usize = 4096;

/// Whether a file starts like text: without control characters except line ends and tabs.
fn looks_like_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(ENOUGH)];
    start.iter().all(|byte| matches!(byte, b'\t' | b'\n' | b'\r' | 0x0C | 0x20..=0x7E | 0x80..))
        && start.iter().filter(|byte| byte.is_ascii()).count() * 2 >= start.len()
}

/// Reads bytes as floats. `stride` is the number of floats per vertex, if the file's ending states it.
fn read_raw(bytes: &[u8], stride: Option<usize>) -> Result<Buffer, BufferError> {
    if !bytes.len().is_multiple_of(4) {
        let message = tr!("check-buffer-raw-floats-take-4-bytes-each", count = bytes.len());
        return Err(BufferError::new(message));
    }
    let floats = bytes.len() / 4;
    let fits = |width: &usize| floats.is_multiple_of(*width);
    match stride {
        Some(stride) if !fits(&stride) => {
            let message = tr!("check-buffer-floats-not-of-stride", floats = floats, stride = stride);
            return Err(BufferError::new(message));
        }
        None if !WIDTHS.iter().any(fits) => {
            let message = tr!("check-buffer-floats-not-whole-vertices", floats = floats);
            return Err(BufferError::new(message));
        }
        _ => {}
    }
    Ok(Buffer { data: Data::Raw { bytes: bytes.to_vec(), stride }, warnings: Vec::new() })
}
