//! Compressed files: what unpacks, what does not, and that no bomb goes off.
//!
//! The packed bytes were made by gzip 1.12 and zstd 1.5.4; what is in them is known from how they were made.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::{Limits, compression};
use std::path::Path;

const TEXT: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn packed(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/compression").join(name)).unwrap()
}

fn unpack(bytes: &[u8]) -> Result<Option<Vec<u8>>, String> {
    compression::unpack(bytes, &Limits::default()).map_err(|error| error.to_string())
}

#[test]
fn what_is_not_compressed_is_left_alone() {
    for bytes in [&b""[..], b"v 0 0 0\n", b"\x1F", b"(\xB5/", b"PL*M\x18"] {
        assert!(!compression::is_compressed(bytes));
        assert_eq!(unpack(bytes), Ok(None));
    }
}

#[test]
fn both_methods_give_what_was_packed() {
    for name in ["triangle.obj.gz", "triangle.obj.zst"] {
        let bytes = packed(name);
        assert!(compression::is_compressed(&bytes[..4]), "{name}");
        assert_eq!(unpack(&bytes), Ok(Some(TEXT.to_vec())), "{name}");
    }
}

#[test]
fn members_frames_and_padding_are_one_file() {
    let (gz, zst) = (packed("triangle.obj.gz"), packed("triangle.obj.zst"));
    let twice = Ok(Some([TEXT, TEXT].concat()));
    assert_eq!(unpack(&[&gz[..], &gz].concat()), twice);
    assert_eq!(unpack(&[&gz[..], &gz, &[0; 512]].concat()), twice);
    assert_eq!(unpack(&[&zst[..], &zst].concat()), twice);
    let skipped = b"\x5A\x2A\x4D\x18\x03\0\0\0abc";
    assert_eq!(unpack(&[skipped, &zst[..], skipped, &zst[..]].concat()), twice);
}

#[test]
fn every_cut_is_told() {
    for (name, method) in [("triangle.obj.gz", "gzip"), ("triangle.obj.zst", "zstd")] {
        let bytes = packed(name);
        for length in 4..bytes.len() {
            let error = unpack(&bytes[..length]).unwrap_err();
            assert!(error.starts_with(&format!("the {method} data ends early, after ")), "{name} {length}: {error}");
            assert!(error.ends_with(" bytes were unpacked: the file is cut off, get it again"), "{name}: {error}");
        }
    }
    let error = unpack(b"\x50\x2A\x4D\x18\xFF\xFF\xFF\xFFabc").unwrap_err();
    assert_eq!(error, "the zstd data ends early, after 0 bytes were unpacked: the file is cut off, get it again");
}

/// Both files carry a checksum: no changed byte of the data goes unnoticed. (The headers hold times and names, and
/// of zstd's a flag that says that there is a checksum.)
#[test]
fn every_changed_byte_is_survived_and_those_of_data_are_noticed() {
    for (name, data_from) in [("triangle.obj.gz", 23), ("triangle.obj.zst", 6)] {
        let bytes = packed(name);
        for at in 0..bytes.len() {
            for bit in 0..8 {
                let mut changed = bytes.clone();
                changed[at] ^= 1 << bit;
                let result = unpack(&changed);
                assert!(at < data_from || result.is_err() || result == Ok(Some(TEXT.to_vec())), "{name} {at} {bit}");
            }
        }
    }
    let mut gz = packed("triangle.obj.gz");
    let crc = gz.len() - 8;
    gz[crc] ^= 1;
    assert!(unpack(&gz).unwrap_err().starts_with("the gzip data is damaged ("), "{:?}", unpack(&gz));
    let mut zst = packed("triangle.obj.zst");
    *zst.last_mut().unwrap() ^= 1;
    let expected = "the zstd data is damaged (its checksum is wrong): get the file again";
    assert_eq!(unpack(&zst), Err(expected.to_owned()));
}

#[test]
fn rubbish_behind_the_data_is_told() {
    let gz = packed("triangle.obj.gz");
    let expected =
        format!("compressed data ends at byte {}, and 3 bytes of other data follow: the file is damaged", gz.len());
    assert_eq!(unpack(&[&gz[..], b"abc"].concat()), Err(expected));
}

/// Ten million zeros in some ten thousand and some hundred bytes.
#[test]
fn bombs_end_at_the_limit() {
    for name in ["zeros.gz", "zeros.zst"] {
        let bytes = packed(name);
        let limits = |max_bytes| Limits { max_bytes, ..Limits::default() };
        let error = compression::unpack(&bytes, &limits(1_000_000)).unwrap_err();
        assert_eq!(error.to_string(), "unpacks to more than 1000000 bytes, which is the limit", "{name}");
        // That is found out before the end is reached: an end that is not there is not missed. (The decoder of zstd
        // holds the last 8 MiB back.)
        let error = compression::unpack(&bytes[..bytes.len() * 19 / 20], &limits(1_000_000)).unwrap_err();
        assert_eq!(error.to_string(), "unpacks to more than 1000000 bytes, which is the limit", "{name}");
        let all = compression::unpack(&bytes, &limits(10_000_000)).unwrap().unwrap();
        assert!(all.len() == 10_000_000 && all.iter().all(|&byte| byte == 0), "{name}");
    }
}

/// A zstd frame of `blocks` blocks of 128 KiB of zeros, four bytes each, with this window descriptor.
fn zeros(blocks: usize, window: u8) -> Vec<u8> {
    const RLE_OF_128_KIB: u32 = 1 << 1 | (128 << 10) << 3;
    let mut frame = vec![0x28, 0xB5, 0x2F, 0xFD, 0, window];
    for block in 1..=blocks {
        let is_last = u32::from(block == blocks);
        frame.extend(&(RLE_OF_128_KIB | is_last).to_le_bytes()[..3]);
        frame.push(0);
    }
    frame
}

#[test]
fn what_no_model_can_shrink_to_is_not_unpacked() {
    const WINDOW_8_MIB: u8 = 13 << 3;
    let enough = Limits { max_bytes: u64::MAX, ..Limits::default() };
    let whole = compression::unpack(&zeros(8, WINDOW_8_MIB), &enough).unwrap().unwrap();
    assert_eq!(whole.len(), 1 << 20);
    // 5 GiB in 160 kB: stopped at 256 MiB, whatever the limit.
    let error = compression::unpack(&zeros(40_960, WINDOW_8_MIB), &enough).unwrap_err().to_string();
    assert!(error.starts_with("unpacks to more than 256 MiB, more than a model of this size can hold"), "{error}");
}

#[test]
fn a_window_that_the_limit_does_not_allow_is_refused() {
    // The exponent of the window is the descriptor's upper five bits, from 1 KiB.
    for (exponent, limit) in [(31, u64::MAX), (18, u64::MAX), (14, 9 << 20), (14, 1)] {
        let limits = Limits { max_bytes: limit, ..Limits::default() };
        let error = compression::unpack(&zeros(1, exponent << 3), &limits).unwrap_err().to_string();
        assert!(error.contains(&format!("needs a window of {} bytes", 1_u64 << (10 + exponent))), "{error}");
    }
    let limits = Limits { max_bytes: 128 << 10, ..Limits::default() };
    assert!(compression::unpack(&zeros(1, 13 << 3), &limits).is_ok(), "8 MiB are usual, also for little");
}
