//! Raw floats: the bytes of an array as a program has it in memory.

use super::buffer::{Buffer, Data, Reading, WIDTHS, by_width};
use super::error::BufferError;

/// Bytes that are looked at to tell text from numbers.
const ENOUGH: usize = 4096;

/// Whether a file starts like text: no control characters but line ends and tabs.
pub(super) fn looks_like_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(ENOUGH)];
    start.iter().all(|byte| matches!(byte, b'\t' | b'\n' | b'\r' | 0x0C | 0x20..=0x7E | 0x80..))
        && start.iter().filter(|byte| byte.is_ascii()).count() * 2 >= start.len()
}

/// Takes bytes for floats, `stride` of them a vertex where the name says so.
pub(super) fn read(bytes: &[u8], stride: Option<usize>) -> Result<Buffer, BufferError> {
    if !bytes.len().is_multiple_of(4) {
        let message = format!(
            "raw floats take 4 bytes each, but the file has {} bytes: was it opened as text (\"w\" instead of \"wb\", \
             without std::ios::binary)?",
            bytes.len()
        );
        return Err(BufferError::new(message));
    }
    let floats = bytes.len() / 4;
    let fits = |width: &usize| floats.is_multiple_of(*width);
    match stride {
        Some(stride) if !fits(&stride) => {
            let message =
                format!("the file has {floats} floats, which is not a multiple of the {stride} that its name states");
            return Err(BufferError::new(message));
        }
        None if !WIDTHS.iter().any(fits) => {
            let message =
                format!("the file has {floats} floats, which is not a multiple of 3, 5, 6 or 8: not whole vertices");
            return Err(BufferError::new(message));
        }
        _ => {}
    }
    Ok(Buffer { data: Data::Raw { bytes: bytes.to_vec(), stride }, warnings: Vec::new() })
}

/// As 32-bit floats, then as 64-bit ones: what NumPy and JavaScript's arrays hold unless told.
pub(super) fn readings(bytes: &[u8], stride: Option<usize>) -> Vec<Reading> {
    const DOUBLES: &str = "the numbers are 64-bit floats; expected 32-bit ones (float, np.float32, Float32Array)";
    let singles: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let doubles = bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
    let doubles: Vec<f32> = doubles.map(|x| x as f32).collect();
    let mut readings = Vec::new();
    for (values, remark) in [(&singles, None), (&doubles, Some(DOUBLES))] {
        for width in WIDTHS.iter().rev().filter(|width| stride.is_none_or(|stride| stride == **width)) {
            if !values.is_empty() && values.len().is_multiple_of(*width) {
                readings.extend(by_width(values, *width, remark));
            }
        }
    }
    readings
}
