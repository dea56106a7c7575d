//! Packs files into an uncompressed zip file.
//!
//! After PKWARE, *.ZIP File Format Specification (APPNOTE 6.3), sections 4.3.7, 4.3.12 and 4.3.16. Small files are meant: no
//! 64-bit sizes.

use flate2::Crc;

/// Version needed to extract: 2.0, for folders.
const VERSION: u16 = 20;
/// Names are UTF-8.
const FLAGS: u16 = 1 << 11;
/// The first day that a zip can name: files that are the same in every build have no other.
const DATE: u16 = 1 << 5 | 1;

/// A zip of these files, by their names with `/` between folders.
pub fn pack(files: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in files {
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
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&common);
        directory.extend([0; 12]);
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
    use crate::files::zip;
    use gonio_scene::files::FileSource;
    use std::path::Path;

    #[test]
    fn what_is_packed_is_unpacked_and_has_its_checksum() {
        let files = [("text.md", &b"123456789"[..]), ("host/one.txt", b""), ("\u{e9}.bin", &[0, 255, 10])];
        let packed = pack(&files);
        let unpacked = zip::unpack(&packed).unwrap_or_else(|why| panic!("{why}"));
        assert_eq!(unpacked.names().len(), 3);
        for (name, bytes) in files {
            assert_eq!(unpacked.read(Path::new(name)).map(|b| b.into_vec()).ok().as_deref(), Some(bytes), "{name}");
        }
        // The checksum of these nine letters is in every description of CRC-32.
        assert_eq!(packed.get(14..18), Some(&0xcbf4_3926_u32.to_le_bytes()[..]));
    }
}
