//! Writing minimal zip archives.

use flate2::{Compression, Crc, write::DeflateEncoder};
use std::io::Write;

/// A zip of these files, deflated.
pub fn pack(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(content).unwrap();
        let packed = encoder.finish().unwrap();
        let mut sum = Crc::new();
        sum.update(content);
        let offset = zip.len() as u32;
        // Version, flags (names are UTF-8), method, time, date; then sums and sizes, and the lengths of name and extra.
        let mut fields: Vec<u8> = [20_u16, 0x800, 8, 0, 0x21].into_iter().flat_map(u16::to_le_bytes).collect();
        for number in [sum.sum(), packed.len() as u32, content.len() as u32] {
            fields.extend(number.to_le_bytes());
        }
        fields.extend([name.len() as u16, 0].into_iter().flat_map(u16::to_le_bytes));
        zip.extend([b"PK\x03\x04", fields.as_slice(), name.as_bytes(), &packed].concat());
        directory.extend(
            [b"PK\x01\x02\x14\x00", fields.as_slice(), &[0; 10], &offset.to_le_bytes(), name.as_bytes()].concat(),
        );
    }
    let (count, start) = (files.len() as u16, zip.len() as u32);
    zip.extend_from_slice(&directory);
    zip.extend(b"PK\x05\x06\0\0\0\0");
    zip.extend([count, count].into_iter().flat_map(u16::to_le_bytes));
    zip.extend([directory.len() as u32, start].into_iter().flat_map(u32::to_le_bytes));
    zip.extend([0, 0]);
    zip
}

/// The same archive with other sizes of the files in its directory.
pub fn with_sizes(zip: &[u8], size: u32) -> Vec<u8> {
    let mut zip = zip.to_vec();
    let starts: Vec<usize> = (0..zip.len()).filter(|&at| zip[at..].starts_with(b"PK\x01\x02")).collect();
    for start in starts {
        zip[start + 24..start + 28].copy_from_slice(&size.to_le_bytes());
    }
    zip
}
