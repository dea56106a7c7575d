//! PNG and JPEG.

use crate::samples::{bright, jpeg, picture, read, refusal};
use gonio_image::decode::FileFormat;
use gonio_image::encode::png::{Depth, encode, rows8};
use gonio_image::{DecodeLimits, decode};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap, srgb_decode};
use image::{DynamicImage, ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

fn png(bytes: &[u8], (width, height): (u32, u32), color: ExtendedColorType) -> Vec<u8> {
    let mut file = Vec::new();
    PngEncoder::new(&mut file).write_image(bytes, width, height, color).unwrap_or_else(|e| panic!("{e}"));
    file
}

fn linear8(step: u8) -> f32 {
    srgb_decode(f64::from(step) / 255.0) as f32
}

#[test]
fn png_of_every_kind_is_decoded_to_linear_light() {
    let steps: Vec<u8> = (0..=255).collect();
    let check = |color, channels: usize, has_alpha: bool| {
        let file = png(&steps[..240], (240 / channels as u32 / 4, 4), color);
        let decoded = read(&file);
        assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Png, false));
        assert_eq!(decoded.notes.contains(&"alpha is ignored".to_owned()), has_alpha, "{color:?}");
        for (pixel, from) in picture(&decoded).pixels.iter().zip(steps.chunks_exact(channels)) {
            let expected = if channels < 3 { [from[0]; 3] } else { [from[0], from[1], from[2]] };
            assert_eq!(pixel[..3], expected.map(linear8), "{color:?}");
            assert_eq!(pixel[3], 1.0);
        }
    };
    check(ExtendedColorType::L8, 1, false);
    check(ExtendedColorType::La8, 2, true);
    check(ExtendedColorType::Rgb8, 3, false);
    check(ExtendedColorType::Rgba8, 4, true);
}

#[test]
fn png_of_16_bits_is_decoded_exactly() {
    let numbers: Vec<u16> = (0..96).map(|i| i * 677 + 3).collect();
    // The writer takes the machine's own order.
    let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_ne_bytes()).collect();
    for (color, channels) in
        [(ExtendedColorType::L16, 1), (ExtendedColorType::Rgb16, 3), (ExtendedColorType::Rgba16, 4)]
    {
        let decoded = read(&png(&bytes, (96 / channels as u32 / 2, 2), color));
        for (pixel, from) in picture(&decoded).pixels.iter().zip(numbers.chunks_exact(channels)) {
            let expected = if channels == 1 { [from[0]; 3] } else { [from[0], from[1], from[2]] };
            assert_eq!(pixel[..3], expected.map(|n| srgb_decode(f64::from(n) / 65535.0) as f32), "{color:?}");
        }
    }
}

#[test]
fn palettes_and_few_bits_become_colours() {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 4, 2);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Two);
    encoder.set_palette(vec![255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9]);
    let mut writer = encoder.write_header().unwrap_or_else(|e| panic!("{e}"));
    writer.write_image_data(&[0b00_01_10_11, 0b11_10_01_00]).unwrap_or_else(|e| panic!("{e}"));
    writer.finish().unwrap_or_else(|e| panic!("{e}"));
    let decoded = read(&file);
    let image = picture(&decoded);
    let nine = linear8(9);
    assert_eq!(image.row(0), [[1., 0., 0., 1.], [0., 1., 0., 1.], [0., 0., 1., 1.], [nine, nine, nine, 1.]]);
    assert_eq!(image.at(3, 1), [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn interlaced_png_is_put_together() {
    // 3 x 2 pixels of 10, 20, 30, ... in Adam7's passes, by Python's zlib.
    let mut file = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x03\0\0\0\x02\x08\x02\0\0\x01\x65\x11\xc1\xdb".to_vec();
    file.extend(b"\0\0\0\x1eIDAT\x78\xda\x63\xe0\x12\x91\x63\x70\x0b\x88\x62\xd0\x30\xb2\x61\x48\xc9\xab\x68\xea\x99");
    file.extend(b"\xb6\x60\xd5\x16\x00\x30\xd6\x06\xaf\xcc\x15\xef\x99\0\0\0\0IEND\xae\x42\x60\x82");
    let decoded = read(&file);
    let expected: Vec<f32> = (1..=18).map(|i| linear8(10 * i)).collect();
    let found: Vec<f32> = picture(&decoded).pixels.iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
    assert_eq!(found, expected);
}

#[test]
fn ignored_colour_metadata_of_a_png_is_reported() {
    let with = |set: fn(&mut png::Encoder<'_, &mut Vec<u8>>)| {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 1, 1);
        encoder.set_color(png::ColorType::Grayscale);
        set(&mut encoder);
        let mut writer = encoder.write_header().unwrap_or_else(|e| panic!("{e}"));
        writer.write_image_data(&[7]).unwrap_or_else(|e| panic!("{e}"));
        drop(writer);
        read(&file).warnings
    };
    assert!(with(|e| e.set_source_gamma(png::ScaledFloat::from_scaled(45455))).is_empty());
    let linear = with(|e| e.set_source_gamma(png::ScaledFloat::from_scaled(100_000)));
    assert_eq!(linear, ["the file has gamma 1.000; it is read as sRGB, so its light is wrong"]);
    assert!(with(|e| e.set_source_srgb(png::SrgbRenderingIntent::Perceptual)).is_empty());
}

#[test]
fn jpeg_is_decoded_to_linear_light() {
    let steps = |x: u32, y: u32| [(x * 6) as u8, (y * 9) as u8, 128];
    let color = image::RgbImage::from_fn(40, 24, |x, y| image::Rgb(steps(x, y)));
    let decoded = read(&jpeg(&DynamicImage::ImageRgb8(color)));
    assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Jpeg, false));
    let image = picture(&decoded);
    assert_eq!((image.width, image.height), (40, 24));
    for y in 0..24 {
        for x in 0..40 {
            for (found, expected) in image.at(x, y).iter().zip(steps(x, y)) {
                // Best quality: a few steps, set by the writer's rounding and the halved resolution of its chroma.
                let off = (gonio_light::color::srgb_encode((*found).into()) * 255.0 - f64::from(expected)).abs();
                assert!(off < 12.0, "{x} {y}: {off}");
            }
        }
    }
    let gray = image::GrayImage::from_fn(17, 9, |x, _| image::Luma([(x * 15) as u8]));
    let decoded = read(&jpeg(&DynamicImage::ImageLuma8(gray)));
    let pixel = picture(&decoded).at(16, 8);
    assert!(pixel[0] == pixel[2] && (pixel[0] - linear8(240)).abs() < 0.02, "{pixel:?}");
}

#[test]
fn png_comes_back_to_the_step() {
    let image = bright(37, 21);
    let transform = OutputTransform { exposure: -3.0, ..OutputTransform::default() };
    let eight = encode(&image, &transform, Depth::Eight).unwrap_or_else(|e| panic!("{e}"));
    // Another reader finds the very bytes.
    let other = image::load_from_memory(&eight).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(other.as_bytes(), rows8(&image, &transform));
    let sixteen = encode(&image, &transform, Depth::Sixteen).unwrap_or_else(|e| panic!("{e}"));
    for (file, steps) in [(eight, 255.0), (sixteen, 65535.0)] {
        let decoded = read(&file);
        for (found, expected) in picture(&decoded).pixels.iter().zip(&image.pixels) {
            for (found, expected) in found.iter().zip(expected).take(3) {
                let step = |x: f32| gonio_light::color::srgb_encode(x.into()) * steps;
                // Half a step of rounding.
                assert!((step(*found) - step(expected / 8.0)).abs() < 0.51, "{found} is not {expected}");
            }
        }
    }
}

#[test]
fn tone_maps_and_direct_numbers_are_those_of_the_definition() {
    let image = bright(16, 16);
    for tone_map in ToneMap::ALL {
        for encoding in ColorEncoding::ALL {
            let transform = OutputTransform { exposure: 0.5, tone_map: *tone_map, encoding: *encoding };
            let bytes = rows8(&image, &transform);
            for (rgb, pixel) in bytes.chunks_exact(3).zip(&image.pixels) {
                let light = glam::DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into());
                for (found, expected) in rgb.iter().zip((transform.encode(light) * 255.0).to_array()) {
                    // Half a step, and where 2^0.5 is an f32 a little more.
                    assert!((f64::from(*found) - expected).abs() < 0.5001, "{tone_map} {encoding}");
                }
            }
        }
    }
}

#[test]
fn other_kinds_are_named() {
    for (bytes, what) in [
        (&b""[..], "the file is empty; get it again"),
        (b"hello", "this is not a known picture format"),
        (b"RIFF....WEBPVP8 ", "this is a WebP picture"),
        (b"II*\0....", "this is a TIFF picture"),
        (b"\xABKTX 11\xBB\r\n\x1a\n", "this is a KTX file of version 1"),
    ] {
        let message = refusal(bytes);
        assert!(message.starts_with(what), "{message}");
    }
}

#[test]
fn too_large_is_refused_by_the_header_alone() {
    let small = DecodeLimits { max_bytes: 16 * 100 };
    for (name, bytes) in crate::samples::every_kind() {
        let message = decode::decode(name, &bytes, &small).err().map(|e| e.to_string()).unwrap_or_default();
        let refused = message.contains("the limit is 1.6 KiB") && message.starts_with(name);
        // All but the smallest are larger than a hundred pixels.
        assert_eq!(refused, !["ktx2", "dds", "flat"].iter().any(|k| name.starts_with(k)), "{name}: {message}");
        let tiny = DecodeLimits { max_bytes: 16 };
        let message = decode::decode(name, &bytes, &tiny).err().map(|e| e.message).unwrap_or_default();
        assert!(message.contains("the limit is 16 bytes"), "{name}: {message}");
    }
}
