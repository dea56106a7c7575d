//! Radiance's `.hdr`.

use crate::samples::{bright, picture, read, refusal};
use gonio_image::Image;
use gonio_image::decode::FileFormat;
use gonio_image::encode::hdr::encode;

fn file(header: &str, pixels: &[u8]) -> Vec<u8> {
    [header.as_bytes(), pixels].concat()
}

/// Light of 1, 2, 3, ... in red only.
fn flat(count: u8) -> Vec<u8> {
    (1..=count).flat_map(|i| [i, 0, 0, 136]).collect()
}

fn reds(image: &Image) -> Vec<f32> {
    image.pixels.iter().map(|p| p[0]).collect()
}

#[test]
fn another_reader_reads_written_files_alike() {
    // 7 is too narrow for run lengths, the others are not; 300 has runs and pieces longer than 127.
    for width in [7, 8, 61, 300] {
        let mut image = bright(width, 11);
        image.pixels[width as usize..2 * width as usize].fill([0.5, 0.5, 0.5, 1.0]);
        let encoded = encode(&image).unwrap_or_else(|e| panic!("{e}"));
        assert!(encoded.warnings.is_empty());
        let other = image::load_from_memory(&encoded.bytes).unwrap_or_else(|e| panic!("{e}")).into_rgb32f();
        let decoded = read(&encoded.bytes);
        assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Hdr, true));
        let ours = picture(&decoded);
        for ((ours, other), expected) in ours.pixels.iter().zip(other.pixels()).zip(&image.pixels) {
            assert_eq!(ours[..3], other.0);
            let brightest = expected[..3].iter().copied().fold(0.0, f32::max);
            for (found, expected) in ours.iter().zip(expected) {
                // Half a step of a mantissa of 8 bits whose first is set.
                assert!((found - expected).abs() <= brightest / 256.0, "{ours:?} is not {expected:?}");
            }
        }
        // What was read is written as it was.
        assert_eq!(encode(ours).map(|e| e.bytes), Ok(encoded.bytes));
    }
}

#[test]
fn all_eight_orders_are_put_upright() {
    // 1 2 3
    // 4 5 6
    let rows = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    for (size, stored) in [
        ("-Y 2 +X 3", [1, 2, 3, 4, 5, 6]),
        ("-Y 2 -X 3", [3, 2, 1, 6, 5, 4]),
        ("+Y 2 +X 3", [4, 5, 6, 1, 2, 3]),
        ("+Y 2 -X 3", [6, 5, 4, 3, 2, 1]),
        ("+X 3 -Y 2", [1, 4, 2, 5, 3, 6]),
        ("+X 3 +Y 2", [4, 1, 5, 2, 6, 3]),
        ("-X 3 -Y 2", [3, 6, 2, 5, 1, 4]),
        ("-X 3 +Y 2", [6, 3, 5, 2, 4, 1]),
    ] {
        let pixels: Vec<u8> = stored.iter().flat_map(|i| [*i, 0, 0, 136]).collect();
        let decoded = read(&file(&format!("#?RGBE\n\n{size}\n"), &pixels));
        let image = picture(&decoded);
        assert_eq!((image.width, image.height, reds(image)), (3, 2, rows.to_vec()), "{size}");
    }
}

#[test]
fn exposure_and_colour_correction_are_taken_back() {
    let header = "#?RADIANCE\nEXPOSURE=2\nEXPOSURE= 0.25\nCOLORCORR=2 1 1\nCOLORCORR= 1 0.5 1\n\n-Y 1 +X 1\n";
    let decoded = read(&file(header, &[128, 128, 128, 129]));
    // 1 in the file; exposures multiply to 0.5.
    assert_eq!(picture(&decoded).at(0, 0), [1.0, 4.0, 2.0, 1.0]);
    assert_eq!(decoded.notes.len(), 2);
}

#[test]
fn old_run_lengths_repeat_the_last_pixel() {
    // One pixel, 3 times more, another, then 2 + 256 times more: two repetitions in a row are digits.
    let mut pixels = flat(1);
    pixels.extend([1, 1, 1, 3, 9, 0, 0, 136, 1, 1, 1, 2, 1, 1, 1, 1]);
    let decoded = read(&file("#?RADIANCE\n\n-Y 1 +X 263\n", &pixels));
    let reds = reds(picture(&decoded));
    assert_eq!((reds[..4].to_vec(), reds[4..].iter().all(|r| *r == 9.0)), (vec![1.0; 4], true));
}

#[test]
fn ignored_metadata_is_reported() {
    let header = "#?RADIANCE\nGAMMA=2.2\nPRIMARIES=0.7 0.3 0.2 0.7 0.1 0.1 0.3 0.3\nPIXASPECT=2\n\n-Y 1 +X 1\n";
    let decoded = read(&file(header, &[1, 2, 3, 136, 0]));
    assert_eq!(decoded.warnings.len(), 2, "{:?}", decoded.warnings);
    assert_eq!(decoded.notes.len(), 2, "{:?}", decoded.notes);
    let usual = "#?RADIANCE\nVIEW=-vtv\nPRIMARIES= 0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\n\n-Y 1 +X 1\n";
    let decoded = read(&file(usual, &[1, 2, 3, 136]));
    assert!(decoded.warnings.is_empty() && decoded.notes.is_empty());
}

#[test]
fn meaningless_headers_are_refused() {
    let one = &[1, 2, 3, 136];
    for (header, pixels, expected) in [
        ("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", &one[..], "the colours are CIE XYZ"),
        ("#?RADIANCE\nFORMAT=other\n\n-Y 1 +X 1\n", one, "unsupported pixel format `other`"),
        ("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n", one, "invalid EXPOSURE `0` in the header"),
        ("#?RADIANCE\nCOLORCORR=1 1\n\n-Y 1 +X 1\n", one, "invalid COLORCORR `` in the header"),
        ("#?RADIANCE\n\n-Y 1 +Y 1\n", one, "the line with the size reads `-Y 1 +Y 1`"),
        ("#?RADIANCE\n\n-Y -1 +X 1\n", one, "the line with the size"),
        ("#?RADIANCE\n\n-Y 0 +X 1\n", one, "the picture is 1 x 0 pixels"),
        ("#?RADIANCE\n\n-Y 99999999 +X 99999999\n", one, "99999999 x 99999999 pixels are"),
        ("#?RADIANCE\nno end", &[], "the header of this .hdr does not end"),
        ("#?RADIANCE\n\n-Y 2 +X 1\n", one, "this .hdr ends before"),
        ("#?RADIANCE\n\n-Y 1 +X 9\n", &[2, 2, 0, 9, 255, 1], "a run of this .hdr is longer"),
        ("#?RADIANCE\n\n-Y 1 +X 9\n", &[2, 2, 0, 9, 0, 1], "a run of this .hdr has no length"),
        ("#?RADIANCE\n\n-Y 1 +X 2\n", &[9, 0, 0, 136, 1, 1, 1, 5], "a run of this .hdr is longer"),
    ] {
        let message = refusal(&file(header, pixels));
        assert!(message.starts_with(expected), "{message}");
    }
}

#[test]
fn light_too_dark_for_the_format_is_reported() {
    let encoded = encode(&Image::new(3, 1, [1e-40, 0.0, 0.0, 1.0])).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(encoded.warnings, ["3 pixels are darker than the darkest value of .hdr (3e-39) and become black"]);
}
