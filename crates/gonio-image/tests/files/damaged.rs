//! Files cut off, with single bits changed, and with false numbers: errors, never panics.

use crate::samples::{every_kind, faces, read};
use gonio_image::decode::{Decoded, DecodedContent};
use gonio_image::{DecodeLimits, decode};

/// Small, so that a false header allocates little.
const LIMITS: DecodeLimits = DecodeLimits { max_bytes: 1 << 20 };

fn check(decoded: &Decoded) {
    let images = match &decoded.shape {
        DecodedContent::Picture(image) => std::slice::from_ref(image),
        DecodedContent::Faces(faces) => &faces[..],
    };
    for image in images {
        assert_eq!(image.pixels.len(), image.width as usize * image.height as usize);
        assert!(image.pixels.iter().all(|p| p[..3].iter().all(|x| *x >= 0.0 && x.is_finite()) && p[3] == 1.0));
    }
}

#[test]
fn every_kind_is_read_whole() {
    for (name, bytes) in every_kind() {
        match decode::decode(name, &bytes, &LIMITS) {
            Ok(decoded) => check(&decoded),
            Err(error) => panic!("{error}"),
        }
    }
}

/// The files that fuzzing begins with are whole, of every kind, and read.
#[test]
fn every_seed_is_read() {
    let table = gonio_fixtures::FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/seeds.txt"));
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    let mut names = Vec::new();
    for file in table.files() {
        let name = file.path.trim_end_matches(".bin").replace('_', " ");
        match decode::decode(&name, &file.bytes, &LIMITS) {
            Ok(decoded) => check(&decoded),
            Err(error) => panic!("{error}"),
        }
        names.push(name);
    }
    assert!(every_kind().iter().all(|(kind, _)| names.iter().any(|n| n == kind)), "{names:?}");
}

#[test]
fn a_file_cut_off_is_an_error_wherever_it_is_cut() {
    for (name, bytes) in every_kind() {
        for length in 0..bytes.len() {
            if let Ok(decoded) = decode::decode(name, &bytes[..length], &LIMITS) {
                check(&decoded);
                panic!("{name}: {length} of {} bytes were read", bytes.len());
            }
        }
    }
}

#[test]
fn a_changed_bit_does_no_harm() {
    let (mut read, mut refused) = (0, 0);
    for (name, bytes) in every_kind() {
        // Headers bit by bit, pixels now and then.
        for at in (0..bytes.len()).filter(|at| *at < 400 || at % 7 == 0) {
            for bit in 0..8 {
                let mut bytes = bytes.clone();
                bytes[at] ^= 1 << bit;
                match decode::decode(name, &bytes, &LIMITS) {
                    Ok(decoded) => {
                        check(&decoded);
                        read += 1;
                    }
                    Err(error) => {
                        assert!(!error.message.is_empty() && !error.message.ends_with('.'), "{error}");
                        assert!(!error.message.contains('\n'), "{error}");
                        refused += 1;
                    }
                }
            }
        }
    }
    // Both happen often: checksums refuse, pixels change.
    assert!(read > 1000 && refused > 1000, "{read} {refused}");
}

#[test]
fn extreme_numbers_in_headers_do_no_harm() {
    for (name, bytes) in every_kind() {
        for at in 0..bytes.len().min(200) {
            for number in [0, 1, 0x7FFF_FFFF, 0x8000_0000, u32::MAX, u32::MAX - 7] {
                for four in [u32::to_le_bytes(number), u32::to_be_bytes(number)] {
                    let mut bytes = bytes.clone();
                    let end = (at + 4).min(bytes.len());
                    bytes[at..end].copy_from_slice(&four[..end - at]);
                    if let Ok(decoded) = decode::decode(name, &bytes, &LIMITS) {
                        check(&decoded);
                    }
                }
            }
        }
    }
}

#[test]
fn faces_lie_in_the_order_of_the_file() {
    let (_, bytes) = every_kind().swap_remove(7);
    let decoded = read(&bytes);
    let reds: Vec<f32> = faces(&decoded).iter().map(|f| (f.at(0, 0)[0] * 10.0).round()).collect();
    assert_eq!(reds, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
}
