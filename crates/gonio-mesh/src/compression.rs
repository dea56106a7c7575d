//! Decompresses files: `.gz` (RFC 1952), `.zst` (RFC 8878).

use crate::{Cause, Limits, ReadError};
use flate2::bufread::GzDecoder;
use ruzstd::decoding::errors::FrameDecoderError;
use ruzstd::decoding::{DEFAULT_MAX_WINDOW_SIZE, StreamingDecoder};
use std::error::Error;
use std::io::{self, Read};

/// The start of a gzip member; deflate is the only compression method.
const GZIP: &[u8] = &[0x1F, 0x8B];
/// The start of a zstd frame.
const ZSTD: &[u8] = &[0x28, 0xB5, 0x2F, 0xFD];
/// The bytes after the first one (0x50 to 0x5F) of a zstd frame that decoders skip.
const ZSTD_SKIPPABLE: &[u8] = &[0x2A, 0x4D, 0x18];

/// A file may unpack to this many times its size. Models consist of numbers, whose text shrinks to a fifth or a tenth.
/// Data that shrinks a hundredfold was made to fill the memory.
const MOST_RATIO: u64 = 100;
/// A file may always unpack to this many bytes: small repetitive models are harmless.
const HARMLESS_BYTES: u64 = 256 << 20;
/// Zstd windows up to this size are common, even in frames with less content: `zstd -19` uses them.
const USUAL_WINDOW: u64 = 8 << 20;

/// Whether a file that begins with `start` (four bytes are enough) is one that [`unpack`] unpacks.
pub fn is_compressed(start: &[u8]) -> bool {
    start.starts_with(GZIP) || start.starts_with(ZSTD) || is_skippable(start)
}

/// Unpacks a compressed file; returns `None` if the file is not compressed.
///
/// Several members (gzip) or frames (zstd) in a row are one file, as for `gzip` and `zstd`; zeros after the last one
/// are padding. Checksums are verified.
///
/// # Errors
///
/// Unpacked data larger than `limits.max_bytes`, or larger than 256 MiB and a hundred times the size of the file (both
/// are detected while unpacking, not after); a window larger than that; data that ends early, is damaged, or is
/// followed by other data.
pub fn unpack(bytes: &[u8], limits: &Limits) -> Result<Option<Vec<u8>>, ReadError> {
    if !is_compressed(bytes) {
        return Ok(None);
    }
    let plausible = (bytes.len() as u64).saturating_mul(MOST_RATIO).max(HARMLESS_BYTES);
    let mut unpacked = Unpacked { bytes: Vec::new(), limit: limits.max_bytes, plausible };
    let mut rest = bytes;
    while !rest.is_empty() {
        let at = bytes.len() - rest.len();
        rest = if rest.starts_with(GZIP) {
            unpacked.gzip_member(rest)?
        } else if rest.starts_with(ZSTD) {
            unpacked.zstd_frame(rest)?
        } else if is_skippable(rest) {
            step_over(rest)?
        } else if rest.iter().all(|&byte| byte == 0) {
            break;
        } else {
            let count = rest.len();
            let message = format!("compressed data ends at byte {at}, and {count} bytes of other data follow");
            return Err(ReadError::new(message + ": the file is damaged"));
        };
    }
    Ok(Some(unpacked.bytes))
}

fn is_skippable(start: &[u8]) -> bool {
    matches!(start, [0x50..=0x5F, rest @ ..] if rest.starts_with(ZSTD_SKIPPABLE))
}

/// Skips a frame: four bytes, its length, and that many bytes.
fn step_over(frame: &[u8]) -> Result<&[u8], ReadError> {
    let length = frame.get(4..8).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let rest = length.and_then(|length| frame.get(8..)?.get(length as usize..));
    rest.ok_or_else(|| cut_off("zstd", 0))
}

struct Unpacked {
    bytes: Vec<u8>,
    limit: u64,
    /// Largest plausible size of a model in a file of this size.
    plausible: u64,
}

impl Unpacked {
    /// Unpacks one member; returns the remaining bytes.
    fn gzip_member<'a>(&mut self, packed: &'a [u8]) -> Result<&'a [u8], ReadError> {
        let mut decoder = GzDecoder::new(packed);
        self.take(&mut decoder).map_err(|error| self.explain("gzip", &error))?;
        self.check_size()?;
        Ok(decoder.into_inner())
    }

    /// Unpacks one frame; returns the remaining bytes.
    fn zstd_frame<'a>(&mut self, packed: &'a [u8]) -> Result<&'a [u8], ReadError> {
        // The decoder allocates the window before it reads any content.
        let window = self.left().clamp(USUAL_WINDOW, DEFAULT_MAX_WINDOW_SIZE);
        let mut decoder = StreamingDecoder::new_with_max_window_size(packed, window).map_err(|error| match error {
            FrameDecoderError::DictNotProvided { .. } => {
                ReadError::new("the zstd data was made with a dictionary: unpack it with the program that made it")
            }
            FrameDecoderError::WindowSizeTooBig { requested, max } => ReadError::new(format!(
                "the zstd data needs a window of {requested} bytes, more than {max}: compress it without --long"
            )),
            error => self.explain("zstd", &error),
        })?;
        self.take(&mut decoder).map_err(|error| self.explain("zstd", &error))?;
        self.check_size()?;
        let (rest, decoder) = decoder.into_parts();
        if let Some(written) = decoder.get_checksum_from_data()
            && decoder.get_calculated_checksum() != Some(written)
        {
            return Err(ReadError::new("the zstd data is damaged (its checksum is wrong): get the file again"));
        }
        Ok(rest)
    }

    /// Reads everything, but at most one byte more than allowed, which is enough to detect the excess.
    fn take(&mut self, decoder: &mut impl Read) -> io::Result<()> {
        let allowed = self.left().saturating_add(1);
        decoder.by_ref().take(allowed).read_to_end(&mut self.bytes).map(drop)
    }

    fn left(&self) -> u64 {
        self.limit.min(self.plausible).saturating_sub(self.bytes.len() as u64)
    }

    fn check_size(&self) -> Result<(), ReadError> {
        let (size, limit, plausible) = (self.bytes.len() as u64, self.limit, self.plausible);
        if size > limit {
            let message = format!("unpacks to more than {limit} bytes, which is the limit");
            return Err(ReadError::new(message).caused_by(Cause::MemoryLimit));
        }
        if size > plausible {
            return Err(ReadError::new(format!(
                "unpacks to more than {} MiB, more than a model of this size can hold: unpack it with the program that \
                 made it if it is really a model",
                plausible >> 20
            )));
        }
        Ok(())
    }

    fn explain(&self, method: &str, error: &(dyn Error + 'static)) -> ReadError {
        if is_end_of_data(error) {
            return cut_off(method, self.bytes.len());
        }
        ReadError::new(format!("the {method} data is damaged ({error}): get the file again"))
    }
}

fn cut_off(method: &str, unpacked: usize) -> ReadError {
    let message = format!("the {method} data ends early, after {unpacked} bytes were unpacked");
    ReadError::new(message + ": the file is cut off, get it again")
}

/// Whether an error was caused, directly or indirectly, by the end of the data.
fn is_end_of_data(error: &(dyn Error + 'static)) -> bool {
    let mut reason = Some(error);
    while let Some(error) = reason {
        reason = match error.downcast_ref::<io::Error>() {
            Some(io_error) if io_error.kind() == io::ErrorKind::UnexpectedEof => return true,
            Some(io_error) => io_error.get_ref().map(|inner| inner as &(dyn Error + 'static)),
            None => error.source(),
        };
    }
    false
}
