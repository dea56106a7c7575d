//! Zip files: read with stored and deflated entries, and written without compression.
//!
//! After PKWARE, *.ZIP File Format Specification (APPNOTE 6.3), sections 4.3.6 to 4.3.16. The central directory is
//! authoritative, as in other programs; its sizes are compared with the limits before anything is allocated.
//! Encrypted, split and 64-bit zip files are refused; none of these is written.

use super::MemoryFiles;
use flate2::Crc;
use flate2::read::DeflateDecoder;
use gonio_language::tr;
use std::io::Read;

/// Limits on what a zip may unpack to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ZipLimits {
    /// Most files.
    pub files: usize,
    /// Most bytes of one file.
    pub file_bytes: u64,
    /// Most bytes of all files together.
    pub bytes: u64,
}

impl ZipLimits {
    /// Limits for models with their textures, or an environment.
    pub const MODELS: ZipLimits = ZipLimits { files: 10_000, file_bytes: 1 << 30, bytes: 1 << 30 };
    /// Limits for a student's files.
    pub const SUBMISSION: ZipLimits = ZipLimits { files: 2000, file_bytes: 64 << 20, bytes: 256 << 20 };

    /// The same, but at most `bytes` for all files together.
    pub fn within(self, bytes: u64) -> ZipLimits {
        ZipLimits { file_bytes: self.file_bytes.min(bytes), bytes: self.bytes.min(bytes), ..self }
    }
}

const END: [u8; 4] = *b"PK\x05\x06";
const ENTRY: [u8; 4] = *b"PK\x01\x02";
const LOCAL: [u8; 4] = *b"PK\x03\x04";
const END_SIZE: usize = 22;
const ENTRY_SIZE: usize = 46;
const LOCAL_SIZE: usize = 30;

/// Whether these are the first bytes of a zip file.
pub fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(&LOCAL) || bytes.starts_with(&END)
}

/// A file in a zip, as the zip's directory describes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ZipEntry {
    /// Its name in the directory: usually UTF-8, with `/` between folders; names of folders end with `/`.
    pub name: Vec<u8>,
    /// Unpacked size in bytes, as stated by the directory.
    pub size: u64,
    method: u64,
    is_encrypted: bool,
    /// Offset of its local header.
    local: usize,
    packed: usize,
}

/// Reads the directory of a zip file with at most `most_files` files. Nothing is unpacked. An error is one sentence.
pub fn entries(bytes: &[u8], most_files: usize) -> Result<Vec<ZipEntry>, String> {
    let end = find_end(bytes).ok_or(tr!("window-the-zip-file-is-truncated-or-2"))?;
    let count = number(bytes, end + 10, 2)? as usize;
    let mut at = number(bytes, end + 16, 4)? as usize;
    if count == 0xffff || at == 0xffff_ffff {
        return Err(tr!("window-zip64-files-are-not-supported-unpack").into());
    }
    if count > most_files {
        return Err(tr!("window-the-zip-file-holds-files-more", count = count, most_files = most_files));
    }
    let mut entries = Vec::new();
    for _ in 0..count {
        if part(bytes, at, 4)? != ENTRY {
            return Err(damaged());
        }
        let [name_len, extra_len, comment_len] = [28, 30, 32].map(|offset| number(bytes, at + offset, 2));
        let (name_len, extra_len, comment_len) = (name_len? as usize, extra_len? as usize, comment_len? as usize);
        entries.push(ZipEntry {
            name: part(bytes, at + ENTRY_SIZE, name_len)?.to_vec(),
            size: number(bytes, at + 24, 4)?,
            method: number(bytes, at + 10, 2)?,
            is_encrypted: number(bytes, at + 8, 2)? & 1 != 0,
            local: number(bytes, at + 42, 4)? as usize,
            packed: number(bytes, at + 20, 4)? as usize,
        });
        at += ENTRY_SIZE + name_len + extra_len + comment_len;
    }
    Ok(entries)
}

impl ZipEntry {
    /// Unpacks its content from `zip`, at most [`Self::size`] bytes. An error is one sentence.
    pub fn unpack(&self, zip: &[u8]) -> Result<Vec<u8>, String> {
        let name = String::from_utf8_lossy(&self.name);
        if self.is_encrypted {
            return Err(tr!("window-in-the-zip-file-is-encrypted", name = name));
        }
        if part(zip, self.local, 4)? != LOCAL {
            return Err(damaged());
        }
        let [name_len, extra_len] = [26, 28].map(|offset| number(zip, self.local + offset, 2));
        let content = part(zip, self.local + LOCAL_SIZE + name_len? as usize + extra_len? as usize, self.packed)?;
        inflate(content, self.method, self.size, &name)
    }
}

/// [`unpack_within`] with the limits for models.
pub fn unpack(bytes: &[u8]) -> Result<MemoryFiles, String> {
    unpack_within(bytes, &ZipLimits::MODELS)
}

/// Unpacks all files, except folders and files that systems add (`__MACOSX/`, names that begin with a dot). An error is one
/// sentence. It is an error if the directory states more than the limits allow, which is found before anything is unpacked, or
/// if a file unpacks to more than the directory states.
pub fn unpack_within(bytes: &[u8], limits: &ZipLimits) -> Result<MemoryFiles, String> {
    let mut requested = Vec::new();
    let mut total = 0;
    for entry in entries(bytes, limits.files)? {
        let name = String::from_utf8_lossy(&entry.name).into_owned();
        if is_left_out(&name) {
            continue;
        }
        if entry.size > limits.file_bytes {
            let most = limits.file_bytes >> 20;
            return Err(tr!("window-in-the-zip-file-is-larger", name = name, most = most));
        }
        total += entry.size;
        if total > limits.bytes {
            return Err(tr!("window-the-zip-file-holds-more-than", bytes = limits.bytes >> 20));
        }
        requested.push((name, entry));
    }
    let mut files = MemoryFiles::default();
    for (name, entry) in requested {
        files.insert(&name, entry.unpack(bytes)?);
    }
    Ok(files)
}

fn inflate(content: &[u8], method: u64, size: u64, name: &str) -> Result<Vec<u8>, String> {
    let wrong = || tr!("window-in-the-zip-file-is-damaged-2", name = name);
    let bytes = match method {
        0 if content.len() as u64 != size => return Err(wrong()),
        0 => content.to_vec(),
        8 => {
            // One byte more than stated shows that the stated size is wrong.
            let mut bytes = Vec::new();
            DeflateDecoder::new(content)
                .take(size + 1)
                .read_to_end(&mut bytes)
                .map_err(|_| tr!("window-in-the-zip-file-is-damaged", name = name))?;
            bytes
        }
        _ => {
            return Err(tr!("window-in-the-zip-file-uses-an", name = name));
        }
    };
    if bytes.len() as u64 != size { Err(wrong()) } else { Ok(bytes) }
}

fn is_left_out(name: &str) -> bool {
    name.ends_with('/') || name.split('/').any(|part| part.starts_with('.') || part == "__MACOSX")
}

/// Offset of the end of central directory record, which a comment may follow.
fn find_end(bytes: &[u8]) -> Option<usize> {
    let last = bytes.len().checked_sub(END_SIZE)?;
    let first = last.saturating_sub(0xffff);
    (first..=last).rev().find(|&at| bytes.get(at..at + 4) == Some(&END))
}

fn part(bytes: &[u8], at: usize, len: usize) -> Result<&[u8], String> {
    at.checked_add(len).and_then(|end| bytes.get(at..end)).ok_or_else(damaged)
}

/// A little-endian number of `len` bytes, at most four.
fn number(bytes: &[u8], at: usize, len: usize) -> Result<u64, String> {
    Ok(part(bytes, at, len)?.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte)))
}

fn damaged() -> String {
    tr!("window-the-zip-file-is-truncated-or").into()
}

/// Version needed to extract: 2.0, for folders.
const VERSION: u16 = 20;
/// Names are UTF-8.
const FLAGS: u16 = 1 << 11;
/// The first date that zip files can state, so that packed files are the same in every build.
const DATE: u16 = 1 << 5 | 1;

/// The system that made the file, in the upper byte: Unix, whose permissions are in the external attributes.
const MADE_BY: u16 = 3 << 8 | VERSION;

/// A file to pack.
#[derive(Clone, Copy, Debug)]
pub struct PackedFile<'a> {
    /// Its name, with `/` between folders.
    pub name: &'a str,
    /// Its content.
    pub bytes: &'a [u8],
    /// Whether it is a program.
    pub is_executable: bool,
}

/// Packs files into an uncompressed zip file; names have `/` between folders. Files are small: there are no 64-bit sizes.
pub fn pack(files: &[(&str, &[u8])]) -> Vec<u8> {
    let files = files.iter().map(|&(name, bytes)| PackedFile { name, bytes, is_executable: false });
    pack_all(&files.collect::<Vec<_>>())
}

/// [`pack`] with permissions.
pub fn pack_all(files: &[PackedFile<'_>]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for PackedFile { name, bytes, is_executable } in files {
        let at = zip.len() as u32;
        let mut common = Vec::new();
        for number in [VERSION, FLAGS, 0, 0, DATE] {
            common.extend(number.to_le_bytes());
        }
        let mut crc = Crc::new();
        crc.update(bytes);
        for number in [crc.sum(), bytes.len() as u32, bytes.len() as u32] {
            common.extend(number.to_le_bytes());
        }
        common.extend((name.len() as u16).to_le_bytes());
        zip.extend(b"PK\x03\x04");
        zip.extend(&common);
        zip.extend([0; 2]);
        zip.extend(name.as_bytes());
        zip.extend(*bytes);
        directory.extend(b"PK\x01\x02");
        directory.extend(MADE_BY.to_le_bytes());
        directory.extend(&common);
        directory.extend([0; 8]);
        let permissions: u32 = if *is_executable { 0o100_755 } else { 0o100_644 };
        directory.extend((permissions << 16).to_le_bytes());
        directory.extend(at.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let (at, count) = (zip.len() as u32, files.len() as u16);
    zip.extend(&directory);
    zip.extend(b"PK\x05\x06\0\0\0\0");
    zip.extend([count, count].map(u16::to_le_bytes).concat());
    zip.extend([directory.len() as u32, at].map(u32::to_le_bytes).concat());
    zip.extend([0; 2]);
    zip
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::DeflateEncoder;
    use gonio_scene::files::FileSource;
    use std::io::Write;
    use std::path::Path;

    /// A zip file of (name, content, whether deflated), as other programs write it.
    fn zip_of(files: &[(&str, &[u8], bool)]) -> Vec<u8> {
        let (mut zip, mut directory) = (Vec::new(), Vec::new());
        for (name, content, deflated) in files {
            let mut packed = content.to_vec();
            if *deflated {
                let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
                encoder.write_all(content).unwrap_or_else(|e| panic!("{e}"));
                packed = encoder.finish().unwrap_or_else(|e| panic!("{e}"));
            }
            let method = if *deflated { 8_u16 } else { 0 };
            let mut common = Vec::new();
            common.extend([20, 0, 0, 0]);
            common.extend(method.to_le_bytes());
            common.extend([0; 8]);
            common.extend((packed.len() as u32).to_le_bytes());
            common.extend((content.len() as u32).to_le_bytes());
            common.extend((name.len() as u16).to_le_bytes());
            let local = zip.len() as u32;
            zip.extend(LOCAL);
            zip.extend(&common);
            zip.extend([0, 0]);
            zip.extend(name.as_bytes());
            zip.extend(packed);
            directory.extend(ENTRY);
            directory.extend([20, 0]);
            directory.extend(&common);
            directory.extend([0; 12]);
            directory.extend(local.to_le_bytes());
            directory.extend(name.as_bytes());
        }
        let at = zip.len() as u32;
        zip.extend(&directory);
        zip.extend(END);
        zip.extend([0; 4]);
        zip.extend((files.len() as u16).to_le_bytes());
        zip.extend((files.len() as u16).to_le_bytes());
        zip.extend((directory.len() as u32).to_le_bytes());
        zip.extend(at.to_le_bytes());
        zip.extend([0, 0]);
        zip
    }

    fn example() -> Vec<u8> {
        let long = b"v 0 0 0\n".repeat(500);
        zip_of(&[
            ("model/", b"", false),
            ("model/a.obj", &long, true),
            ("model/a.mtl", b"newmtl a", false),
            ("__MACOSX/model/._a.obj", b"x", false),
            ("model/.DS_Store", b"x", false),
        ])
    }

    #[test]
    fn stored_and_deflated_files_are_read() {
        let zip = example();
        assert!(is_zip(&zip) && !is_zip(b"v 0 0 0"));
        let files = unpack(&zip).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(files.names(), ["model/a.mtl", "model/a.obj"]);
        let read = |name: &str| files.read(Path::new(name)).map(|b| b.into_vec()).unwrap_or_default();
        assert_eq!(read("model/a.obj"), b"v 0 0 0\n".repeat(500));
        assert_eq!(read("model/a.mtl"), b"newmtl a");
    }

    #[test]
    fn a_comment_at_the_end_is_skipped() {
        let mut zip = example();
        zip.extend(b"made by hand");
        assert!(unpack(&zip).is_ok_and(|files| files.names().len() == 2));
    }

    #[test]
    fn truncated_and_flipped_zip_files_never_panic() {
        let zip = example();
        for length in 0..zip.len() - 1 {
            assert!(unpack(&zip[..length]).is_err(), "cut at {length}");
        }
        for at in 0..zip.len() {
            let mut flipped = zip.clone();
            flipped[at] ^= 0xff;
            // A damaged zip file never yields more files than it states.
            if let Ok(files) = unpack(&flipped) {
                assert!(files.names().len() <= 5, "flipped at {at}");
            }
        }
    }

    #[test]
    fn no_more_is_unpacked_than_the_directory_states() {
        let mut zip = zip_of(&[("a.obj", &[0; 100_000], true)]);
        let directory = zip.windows(4).position(|w| w == ENTRY).unwrap_or_default();
        zip[directory + 24..directory + 28].copy_from_slice(&10_u32.to_le_bytes());
        assert!(unpack(&zip).is_err_and(|error| error.contains("its size differs")));
        zip[directory + 24..directory + 28].copy_from_slice(&0xf000_0000_u32.to_le_bytes());
        assert!(unpack(&zip).is_err_and(|error| error.contains("1024 MiB")));
    }

    #[test]
    fn sizes_are_limited_for_each_file_and_for_all_together() {
        const MIB: usize = 1 << 20;
        let two = zip_of(&[("a.obj", &vec![0; 2 * MIB], true), ("b.obj", &vec![0; MIB], true)]);
        assert!(two.len() < 10_000, "{}", two.len());
        let refused = |files, file, all| {
            let limits = ZipLimits { files, file_bytes: (file * MIB) as u64, bytes: (all * MIB) as u64 };
            unpack_within(&two, &limits).err()
        };
        assert_eq!(refused(2, 2, 3), None);
        let file = "`a.obj` in the zip file is larger than 1 MiB, the limit for one file";
        assert_eq!(refused(2, 1, 3).as_deref(), Some(file));
        let all = "the zip file holds more than 2 MiB: unpack it and open its contents";
        assert_eq!(refused(2, 2, 2).as_deref(), Some(all));
        let files = "the zip file holds 2 files, more than 1: unpack it and open only those that you need";
        assert_eq!(refused(1, 2, 3).as_deref(), Some(files));
    }

    /// All entries may refer to the same bytes, so that a small zip file unpacks to a large size.
    #[test]
    fn overlapping_entries_are_counted_separately() {
        let one = zip_of(&[("a.obj", &[0; 1 << 20], true)]);
        let [directory, end] = [ENTRY, END].map(|magic| one.windows(4).position(|w| w == magic).unwrap_or_default());
        let entry = &one[directory..end];
        let mut zip = one[..directory].to_vec();
        (0..300).for_each(|_| zip.extend(entry));
        zip.extend(&one[end..]);
        let end = zip.len() - END_SIZE;
        zip[end + 10..end + 12].copy_from_slice(&300_u16.to_le_bytes());
        let refused = unpack_within(&zip, &ZipLimits::SUBMISSION).err();
        assert_eq!(refused.as_deref(), Some("the zip file holds more than 256 MiB: unpack it and open its contents"));
    }

    #[test]
    fn packed_files_can_be_unpacked_and_have_checksums() {
        let files = [("text.md", &b"123456789"[..]), ("host/one.txt", b""), ("\u{e9}.bin", &[0, 255, 10])];
        let packed = pack(&files);
        let unpacked = unpack(&packed).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(unpacked.names().len(), 3);
        for (name, bytes) in files {
            assert_eq!(unpacked.read(Path::new(name)).map(|b| b.into_vec()).ok().as_deref(), Some(bytes), "{name}");
        }
        // The check value of CRC-32.
        assert_eq!(packed.get(14..18), Some(&0xcbf4_3926_u32.to_le_bytes()[..]));
    }
}
