//! OpenEXR.

use crate::samples::{bright, picture, read, refusal};
use exr::prelude::*;
use gonio_image::decode::FileFormat;
use gonio_image::encode::exr::{ExrPrecision, encode};
use std::io::Cursor;

/// A file of layers of flat channels.
fn file(layers: Vec<Layer<AnyChannels<FlatSamples>>>, window: IntegerBounds) -> Vec<u8> {
    let mut bytes = Vec::new();
    let image = FlatImage { attributes: ImageAttributes::new(window), layer_data: layers.into() };
    image.write().non_parallel().to_buffered(Cursor::new(&mut bytes)).unwrap_or_else(|e| panic!("{e}"));
    bytes
}

fn channels(list: &[(&str, FlatSamples)]) -> AnyChannels<FlatSamples> {
    AnyChannels::sort(list.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect())
}

fn layer(name: &str, size: (usize, usize), list: &[(&str, FlatSamples)]) -> Layer<AnyChannels<FlatSamples>> {
    Layer::new(size, LayerAttributes::named(name), Encoding::FAST_LOSSLESS, channels(list))
}

fn floats(values: &[f32]) -> FlatSamples {
    FlatSamples::F32(values.to_vec())
}

fn window(x: i32, y: i32, width: usize, height: usize) -> IntegerBounds {
    IntegerBounds::new((x, y), (width, height))
}

fn reds(bytes: &[u8]) -> Vec<f32> {
    picture(&read(bytes)).pixels.iter().map(|p| p[0]).collect()
}

#[test]
fn what_is_written_comes_back() {
    // More than one block of 16 lines.
    let image = bright(33, 40);
    let float = encode(&image, ExrPrecision::Float).unwrap_or_else(|e| panic!("{e}"));
    let decoded = read(&float.bytes);
    assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Exr, true));
    assert_eq!(picture(&decoded), &image);
    assert!(decoded.notes.is_empty() && decoded.warnings.is_empty(), "{decoded:?}");
    let half = encode(&image, ExrPrecision::Half).unwrap_or_else(|e| panic!("{e}"));
    for (found, expected) in picture(&read(&half.bytes)).pixels.iter().zip(&image.pixels) {
        for (found, expected) in found.iter().zip(expected) {
            // Half a step of 11 bits of mantissa.
            assert!((found - expected).abs() <= expected / 2048.0, "{found} is not {expected}");
        }
    }
}

#[test]
fn light_beyond_half_floats_is_clamped_and_reported() {
    let mut image = bright(4, 4);
    image.pixels[5] = [1e6, 70000.0, 1.0, 1.0];
    let half = encode(&image, ExrPrecision::Half).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        half.warnings,
        ["2 numbers are above 65504, the largest half float, and are clamped to it; write floats to keep them"]
    );
    assert_eq!(picture(&read(&half.bytes)).pixels[5], [65504.0, 65504.0, 1.0, 1.0]);
    let float = encode(&image, ExrPrecision::Float).unwrap_or_else(|e| panic!("{e}"));
    assert!(float.warnings.is_empty());
}

#[test]
fn every_kind_of_number_and_packing_is_read() {
    let halves = FlatSamples::F16([1.0, 2.0, 3.0, 4.0].map(f16::from_f32).to_vec());
    let list = [("R", halves), ("G", FlatSamples::U32(vec![5, 6, 7, 8])), ("B", floats(&[0.1, 0.2, 0.3, 0.4]))];
    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
    ] {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(1, 1))] {
            let mut layer = layer("", (2, 2), &list);
            layer.encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            let decoded = read(&file(vec![layer], window(0, 0, 2, 2)));
            let image = picture(&decoded);
            assert_eq!(image.at(0, 0)[..2], [1.0, 5.0], "{compression:?}");
            assert_eq!(image.at(1, 1)[..2], [4.0, 8.0], "{compression:?}");
            // PXR24 keeps 24 of 32 bits.
            assert!((image.at(1, 1)[2] - 0.4).abs() < 1e-5, "{compression:?}");
        }
    }
}

#[test]
fn the_layer_with_colours_is_found() {
    let one = |x: f32| floats(&[x]);
    let rgb = |prefix: &str, x: f32| ["R", "G", "B"].map(|c| (format!("{prefix}{c}"), one(x)));
    let with = |sets: &[[(String, FlatSamples); 3]], more: &[(&str, FlatSamples)]| {
        let mut list: Vec<(&str, FlatSamples)> = more.to_vec();
        list.extend(sets.iter().flatten().map(|(n, s)| (n.as_str(), s.clone())));
        file(vec![layer("", (1, 1), &list)], window(0, 0, 1, 1))
    };
    let plain_too = with(&[rgb("diffuse.", 2.0), rgb("", 1.0)], &[("Z", one(9.0))]);
    assert_eq!(reds(&plain_too), [1.0]);
    assert_eq!(read(&plain_too).notes, ["4 further channels are ignored"]);
    let layer_only = with(&[rgb("diffuse.", 2.0)], &[("Z", one(9.0))]);
    assert_eq!(reds(&layer_only), [2.0]);
    assert!(read(&layer_only).notes.contains(&"the colours are those of `diffuse`".to_owned()));
    assert_eq!(reds(&with(&[], &[("Y", one(3.0))])), [3.0]);
    assert_eq!(read(&with(&[rgb("", 1.0)], &[("A", one(0.5))])).notes, ["alpha is ignored"]);
    let message = refusal(&with(&[], &[("Z", one(3.0)), ("N.x", one(1.0))]));
    assert!(message.starts_with("no channels R, G and B, nor Y, are among `N.x`, `Z`"), "{message}");
    let parts = vec![
        layer("depth", (1, 1), &[("Z", one(5.0))]),
        layer("beauty", (1, 1), &[("R", one(4.0)), ("G", one(4.0)), ("B", one(4.0))]),
    ];
    assert_eq!(reds(&file(parts, window(0, 0, 1, 1))), [4.0]);
}

#[test]
fn the_picture_is_the_display_window() {
    let list = [("Y", floats(&[1.0, 2.0, 3.0, 4.0]))];
    let read_at = |x: i32, y: i32, window: IntegerBounds| {
        let mut layer = layer("", (2, 2), &list);
        layer.attributes.layer_position = Vec2(x, y);
        let decoded = read(&file(vec![layer], window));
        let values: Vec<f32> = picture(&decoded).pixels.iter().map(|p| p[0]).collect();
        (picture(&decoded).width, values, decoded.warnings)
    };
    // The same window somewhere else.
    let (width, values, warnings) = read_at(-7, 3, window(-7, 3, 2, 2));
    assert_eq!((width, values, warnings.len()), (2, vec![1.0, 2.0, 3.0, 4.0], 0));
    // Pixels are missing on the left and above.
    let (width, values, warnings) = read_at(1, 1, window(0, 0, 3, 3));
    assert_eq!((width, values), (3, vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 0.0, 3.0, 4.0]));
    assert!(warnings[0].starts_with("the pixels (2 x 2) do not cover the picture (3 x 3)"), "{warnings:?}");
    // Pixels stand over on the left and above.
    let (width, values, warnings) = read_at(-1, -1, window(0, 0, 1, 1));
    assert_eq!((width, values), (1, vec![4.0]));
    assert!(warnings[0].starts_with("the pixels (2 x 2) go beyond the picture (1 x 1)"), "{warnings:?}");
}

#[test]
fn numbers_that_are_not_light_are_reported_and_replaced() {
    let list = [
        ("R", floats(&[f32::NAN, 1.0, -1.0])),
        ("G", floats(&[f32::INFINITY, 1e30, -2.0])),
        ("B", floats(&[0.0, f32::NEG_INFINITY, 1e-45])),
    ];
    let decoded = read(&file(vec![layer("", (3, 1), &list)], window(0, 0, 3, 1)));
    let expected = [[0.0, 65504.0, 0.0, 1.0], [1.0, 1e30, 0.0, 1.0], [0.0, 0.0, 1e-45, 1.0]];
    assert_eq!(picture(&decoded).pixels, expected);
    assert_eq!(
        decoded.warnings,
        [
            "one number is NaN and counts as 0",
            "one number is infinite and counts as 65504",
            "3 numbers are negative and count as 0"
        ]
    );
}

#[test]
fn chroma_of_fewer_pixels_is_refused() {
    let mut chroma = AnyChannel::new("RY", floats(&[1.0]));
    chroma.sampling = Vec2(2, 2);
    let list = [AnyChannel::new("Y", floats(&[1.0, 2.0, 3.0, 4.0])), chroma];
    let layer = Layer::new(
        (2, 2),
        LayerAttributes::named(""),
        Encoding::UNCOMPRESSED,
        AnyChannels::sort(list.into_iter().collect()),
    );
    let mut bytes = Vec::new();
    let image = FlatImage { attributes: ImageAttributes::new(window(0, 0, 2, 2)), layer_data: vec![layer].into() };
    // The writer may refuse to write them; then there is nothing to read.
    if image.write().non_parallel().to_buffered(Cursor::new(&mut bytes)).is_ok() {
        assert!(refusal(&bytes).contains("fewer pixels"), "{}", refusal(&bytes));
    }
}
