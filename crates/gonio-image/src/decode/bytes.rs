//! Numbers out of bytes, where a file may end too early.

use crate::ImageError;

/// A file's bytes; every access is checked.
#[derive(Clone, Copy)]
pub(super) struct Bytes<'a>(pub &'a [u8]);

impl<'a> Bytes<'a> {
    /// `length` bytes from `start` on, or an error that says which part of the file they would have been.
    pub(super) fn part(&self, start: u64, length: u64, what: &str) -> Result<&'a [u8], ImageError> {
        let range = usize::try_from(start).ok().zip(start.checked_add(length).and_then(|e| usize::try_from(e).ok()));
        range.and_then(|(start, end)| self.0.get(start..end)).ok_or_else(|| {
            ImageError::new(format!(
                "{what} should be the {length} bytes from byte {start} on, but the file has only {}; it is cut off or \
                 damaged, get it again",
                self.0.len()
            ))
        })
    }

    /// The little-endian 32-bit number at a byte.
    pub(super) fn u32(&self, at: usize) -> Result<u32, ImageError> {
        let part = self.part(at as u64, 4, "the header")?;
        Ok(u32::from_le_bytes(part.try_into().unwrap_or_default()))
    }

    /// The little-endian 64-bit number at a byte.
    pub(super) fn u64(&self, at: usize) -> Result<u64, ImageError> {
        let part = self.part(at as u64, 8, "the header")?;
        Ok(u64::from_le_bytes(part.try_into().unwrap_or_default()))
    }
}
