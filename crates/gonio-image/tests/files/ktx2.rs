//! KTX2.

use crate::samples::{CubeLevel, chain, cube, faces, ktx2 as encode, picture, read, refusal};
use gonio_image::decode::FileFormat;
use gonio_image::encode::ktx2::Format;
use std::io::Write;

const FORMATS: [(Format, ktx2::Format); 3] = [
    (Format::Half, ktx2::Format::R16G16B16A16_SFLOAT),
    (Format::Float, ktx2::Format::R32G32B32A32_SFLOAT),
    (Format::Srgb8, ktx2::Format::R8G8B8A8_SRGB),
];

fn put(bytes: &mut [u8], at: usize, number: u32) {
    bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
}

fn one_level(level: CubeLevel) -> Vec<CubeLevel> {
    vec![level]
}

/// A file whose only level is packed: 2 Zstandard (stored, not squeezed), 3 zlib.
pub fn packed(scheme: u32) -> Vec<u8> {
    let mut bytes = encode(&one_level(cube(4)), Format::Half).bytes;
    let start = u64::from_le_bytes(bytes[80..88].try_into().unwrap_or_default()) as usize;
    let level = bytes.split_off(start);
    let packed = if scheme == 3 {
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(&level).and_then(|()| encoder.finish()).unwrap_or_else(|e| panic!("{e}"))
    } else {
        // RFC 8878: magic, a frame of one segment with 2 bytes of size less 256, one raw block, the last.
        let mut frame = vec![0x28, 0xB5, 0x2F, 0xFD, 0x60];
        frame.extend((level.len() as u16 - 256).to_le_bytes());
        frame.extend(&((level.len() as u32) << 3 | 1).to_le_bytes()[..3]);
        frame.extend(&level);
        frame
    };
    put(&mut bytes, 44, scheme);
    put(&mut bytes, 88, packed.len() as u32);
    bytes.extend(packed);
    bytes
}

#[test]
fn another_reader_finds_what_was_written() {
    let levels = chain(6);
    for (format, theirs) in FORMATS {
        let file = encode(&levels, format).bytes;
        let reader = ktx2::Reader::new(&file[..]).unwrap_or_else(|e| panic!("{e}"));
        let header = reader.header();
        assert_eq!(header.format, Some(theirs));
        assert_eq!((header.pixel_width, header.pixel_height, header.pixel_depth), (6, 6, 0));
        assert_eq!((header.layer_count, header.face_count, header.level_count), (0, 6, 3));
        assert_eq!(header.supercompression_scheme, None);
        // The descriptor is the one that the other has for this format, to the bit.
        let (descriptor, type_size) = ktx2::dfd::Basic::from_format(theirs).unwrap_or_else(|e| panic!("{e:?}"));
        assert_eq!(header.type_size, type_size);
        assert_eq!(reader.basic_dfd(), Some(&descriptor), "{format:?}");
        // The specification wants the 0 at the end, and the other reader does not take it away.
        assert_eq!(reader.writer(), Some("gonio\0"));
        let keys: Vec<_> = reader.key_value_data().collect();
        assert_eq!(keys[0], ("KTXorientation", &b"rd\0"[..]));
        // The smallest level first, each where its texels may be.
        let levels: Vec<_> = reader.levels().map(|l| l.data.len()).collect();
        let texel = [8, 16, 4][format as usize];
        assert_eq!(levels, [6 * 36 * texel, 6 * 9 * texel, 6 * texel]);
        let offset = |level: usize| {
            let at = 80 + 24 * level;
            u64::from_le_bytes(file[at..at + 8].try_into().unwrap_or_default()) as usize
        };
        assert!(offset(2) < offset(1) && offset(1) < offset(0));
        assert!((0..3).all(|l| offset(l).is_multiple_of(texel)));
    }
}

#[test]
fn what_is_written_comes_back() {
    let levels = chain(5);
    for (format, _) in FORMATS {
        let encoded = encode(&levels, format);
        assert!(encoded.warnings.is_empty(), "{:?}", encoded.warnings);
        let decoded = read(&encoded.bytes);
        assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Ktx2, format != Format::Srgb8));
        assert_eq!(decoded.notes, ["of 3 mip levels the largest is read"]);
        for (found, wanted) in faces(&decoded).iter().zip(levels[0].faces()) {
            for (found, wanted) in found.pixels.iter().flatten().zip(wanted.iter().flatten()) {
                // Half a step of 11 bits, or of 255 steps where the curve is steepest (2.3 to 1).
                let tolerance = [wanted / 2048.0, 0.0, 2.3 / 510.0][format as usize];
                assert!((found - wanted).abs() <= tolerance, "{format:?}: {found} is not {wanted}");
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_told() {
    let mut map = cube(2);
    map.pixels[3] = [70000.0, 2.0, 0.0, 1.0];
    let warnings = |format| encode(&one_level(map.clone()), format).warnings;
    assert!(warnings(Format::Half)[0].starts_with("1 numbers are above 65504"), "{:?}", warnings(Format::Half));
    assert!(warnings(Format::Srgb8)[0].starts_with("2 numbers are above 1 "), "{:?}", warnings(Format::Srgb8));
    assert!(warnings(Format::Float).is_empty());
    let odd = [cube(4), cube(3)];
    assert!(encode(&odd, Format::Float).warnings[0].starts_with("of 2 mip levels 1 are written"));
}

#[test]
fn packed_levels_are_unpacked() {
    for scheme in [2, 3] {
        let decoded = read(&packed(scheme));
        for (found, wanted) in faces(&decoded).iter().zip(cube(4).faces()) {
            for (found, wanted) in found.pixels.iter().flatten().zip(wanted.iter().flatten()) {
                assert!((found - wanted).abs() <= wanted / 2048.0, "{scheme}: {found} is not {wanted}");
            }
        }
    }
}

#[test]
fn pictures_and_what_integers_mean_are_as_the_file_says() {
    // Six faces of 1 x 1 are read as one picture of 1 x 6 once the header says so.
    let mut map = cube(1);
    for (i, pixel) in map.pixels.iter_mut().enumerate() {
        *pixel = [gonio_light::color::srgb_decode(i as f64 / 255.0) as f32, 0.0, 0.0, 1.0];
    }
    let mut file = encode(&one_level(map.clone()), Format::Srgb8).bytes;
    put(&mut file, 24, 6);
    put(&mut file, 36, 1);
    let reds = |file: &[u8]| picture(&read(file)).pixels.iter().map(|p| p[0]).collect::<Vec<_>>();
    let wanted: Vec<f32> = map.pixels.iter().map(|p| p[0]).collect();
    assert_eq!(reds(&file), wanted);
    // Bottom up.
    let at = file.windows(3).position(|w| w == b"rd\0").unwrap_or_default();
    file[at + 1] = b'u';
    assert_eq!(reds(&file), wanted.iter().rev().copied().collect::<Vec<_>>());
    // R8G8B8A8_UNORM, which the descriptor calls linear (1) or sRGB (2).
    file[at + 1] = b'd';
    put(&mut file, 12, 37);
    assert_eq!(reds(&file), wanted);
    let transfer = 80 + 24 + 14;
    assert_eq!(file[transfer], 2);
    file[transfer] = 1;
    assert_eq!(reds(&file), (0..6).map(|i| i as f32 / 255.0).collect::<Vec<_>>());
    assert!(read(&file).notes[0].contains("linear light"));
}

#[test]
fn what_is_not_read_is_named() {
    let file = encode(&one_level(cube(2)), Format::Half).bytes;
    let with = |at: usize, number: u32| {
        let mut file = file.clone();
        put(&mut file, at, number);
        refusal(&file)
    };
    for (at, number, wanted) in [
        (12, 157, "its pixels are ASTC"),
        (12, 147, "its pixels are ETC2 or EAC"),
        (12, 141, "its pixels are BC5"),
        (12, 9999, "its pixels are in the Vulkan format 9999"),
        (20, 3, "its faces are 3 x 2 pixels"),
        (20, 0, "its faces are 0 x 2 pixels"),
        (28, 2, "it holds a volume"),
        (24, 0, "it holds one row of pixels"),
        (36, 5, "it says that it has 5 faces"),
        (44, 1, "its levels are packed with Basis LZ"),
        (44, 7, "its levels are packed in a way that is not known"),
        (44, 2, "its largest level is no Zstandard"),
        (44, 3, "its largest level cannot be unpacked"),
        (80, 1 << 20, "the largest level should be the 192 bytes from byte 1048576 on"),
        (88, 100, "its largest level is too short"),
    ] {
        let message = with(at, number);
        assert!(message.starts_with(wanted), "{at} {number}: {message}");
    }
    let huge = {
        let mut file = file.clone();
        put(&mut file, 20, 1 << 20);
        put(&mut file, 24, 1 << 20);
        refusal(&file)
    };
    assert!(huge.starts_with("6 times 1048576 x 1048576 pixels are"), "{huge}");
}
