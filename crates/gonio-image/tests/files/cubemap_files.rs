//! DDS and KTX2.

use crate::samples::{CubeLevel, chain, cube, faces, ktx2 as encode, picture, read, refusal};
use ddsfile::{AlphaMode, Caps2, D3D10ResourceDimension, D3DFormat, Dds, DxgiFormat, NewD3dParams, NewDxgiParams};
use gonio_image::Image;
use gonio_image::decode::FileFormat;
use gonio_image::encode::ktx2::Ktx2Format;
use gonio_light::color::srgb_decode;
use std::io::Write;

fn written(mut dds: Dds, data: Vec<u8>) -> Vec<u8> {
    assert_eq!(dds.data.len(), data.len(), "the other writer wants another size");
    dds.data = data;
    let mut bytes = Vec::new();
    dds.write(&mut bytes).unwrap_or_else(|e| panic!("{e}"));
    bytes
}

fn dxgi(format: DxgiFormat, size: u32, levels: u32, is_cubemap: bool, data: Vec<u8>) -> Vec<u8> {
    let dds = Dds::new_dxgi(NewDxgiParams {
        height: size,
        width: size,
        depth: None,
        format,
        mipmap_levels: Some(levels),
        array_layers: is_cubemap.then_some(6),
        caps2: None,
        is_cubemap,
        resource_dimension: D3D10ResourceDimension::Texture2D,
        alpha_mode: AlphaMode::Opaque,
    });
    written(dds.unwrap_or_else(|e| panic!("{e}")), data)
}

fn d3d(format: D3DFormat, size: u32, levels: u32, caps2: Option<Caps2>, data: Vec<u8>) -> Vec<u8> {
    let dds = Dds::new_d3d(NewD3dParams {
        height: size,
        width: size,
        depth: None,
        format,
        mipmap_levels: Some(levels),
        caps2,
    });
    let mut dds = dds.unwrap_or_else(|e| panic!("{e}"));
    // The writer counts one face only, where the header says which six there are.
    dds.data.resize(data.len(), 0);
    written(dds, data)
}

/// A cubemap of so many bytes a face, each face of another byte.
pub fn cubemap(format: DxgiFormat, size: u32, face_bytes: usize) -> Vec<u8> {
    dxgi(format, size, 1, true, (0..6).flat_map(|face| vec![face * 40 + 3; face_bytes]).collect())
}

fn linear(step: u8) -> f32 {
    srgb_decode(f64::from(step) / 255.0) as f32
}

fn first(image: &Image) -> [f32; 3] {
    let [r, g, b, _] = image.at(0, 0);
    [r, g, b]
}

#[test]
fn cubemaps_of_both_headers_are_six_faces_without_their_mip_levels() {
    // 2 x 2 and 1 x 1 pixels a face: 20 bytes, of which each is the face's number.
    let data: Vec<u8> = (0..6).flat_map(|face| [[face * 40; 16].as_slice(), &[99; 4]].concat()).collect();
    for (file, name) in [
        (dxgi(DxgiFormat::R8G8B8A8_UNorm_sRGB, 2, 2, true, data.clone()), "DX10"),
        (d3d(D3DFormat::A8R8G8B8, 2, 2, Some(Caps2::CUBEMAP | Caps2::CUBEMAP_ALLFACES), data), "old"),
    ] {
        let decoded = read(&file);
        assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Dds, false));
        for (i, face) in faces(&decoded).iter().enumerate() {
            let light = linear(i as u8 * 40);
            assert_eq!(face.pixels, [[light, light, light, 1.0]; 4], "{name}");
        }
        assert!(decoded.notes.contains(&"of 2 mip levels the largest is read".to_owned()), "{:?}", decoded.notes);
        let unsaid = decoded.notes.iter().any(|n| n.contains("does not state how colours are encoded"));
        assert_eq!(unsaid, name == "old");
    }
}

#[test]
fn a_cubemap_without_all_faces_names_those_that_it_lacks() {
    let caps = Caps2::CUBEMAP | Caps2::CUBEMAP_POSITIVEX | Caps2::CUBEMAP_NEGATIVEZ;
    let file = d3d(D3DFormat::A8R8G8B8, 1, 1, Some(caps), vec![0; 8]);
    assert_eq!(refusal(&file), "the cubemap lacks negx, posy, negy, posz; save it with all six faces");
}

#[test]
fn uncompressed_pixels_have_the_colours_of_the_header() {
    let one = |format, bytes: &[u8]| first(picture(&read(&d3d(format, 1, 1, None, bytes.to_vec()))));
    assert_eq!(one(D3DFormat::R8G8B8, &[1, 2, 3]), [3, 2, 1].map(linear));
    assert_eq!(one(D3DFormat::X8R8G8B8, &[1, 2, 3, 0]), [3, 2, 1].map(linear));
    assert_eq!(one(D3DFormat::A8B8G8R8, &[1, 2, 3, 0]), [1, 2, 3].map(linear));
    assert_eq!(one(D3DFormat::R5G6B5, &[0x1F, 0xF8]), [1.0, 0.0, 1.0]);
    assert_eq!(one(D3DFormat::L8, &[188]), [linear(188); 3]);
    // The other writer gives floats no number of their own (113 is A16B16G16R16F).
    let mut halves = d3d(D3DFormat::A16B16G16R16F, 1, 1, None, vec![0, 0x3C, 0, 0x42, 0, 0x38, 0, 0]);
    halves[80..88].copy_from_slice(&[4, 0, 0, 0, 113, 0, 0, 0]);
    assert_eq!(first(picture(&read(&halves))), [1.0, 3.0, 0.5]);
    let modern = |format, bytes: &[u8]| first(picture(&read(&dxgi(format, 1, 1, false, bytes.to_vec()))));
    assert_eq!(modern(DxgiFormat::B8G8R8A8_UNorm_sRGB, &[1, 2, 3, 0]), [3, 2, 1].map(linear));
    assert_eq!(modern(DxgiFormat::R9G9B9E5_SharedExp, &(256_u32 | 16 << 27).to_le_bytes()), [1.0, 0.0, 0.0]);
    assert_eq!(modern(DxgiFormat::R11G11B10_Float, &(15_u32 << 6).to_le_bytes()), [1.0, 0.0, 0.0]);
    let floats: Vec<u8> = [1.5_f32, 0.25, 7.0, 1.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(modern(DxgiFormat::R32G32B32A32_Float, &floats), [1.5, 0.25, 7.0]);
}

#[test]
fn blocks_are_decoded_and_cut_at_the_edge() {
    // BC1: white and black, indices 0 (white) but in the second row, which is 1 (black).
    let block = [0xFF, 0xFF, 0, 0, 0, 0b0101_0101, 0, 0];
    let decoded = read(&d3d(D3DFormat::DXT1, 4, 1, None, block.to_vec()));
    let image = picture(&decoded);
    for x in 0..4 {
        let rows: Vec<f32> = (0..4).map(|y| image.at(x, y)[0]).collect();
        assert_eq!(rows, [1.0, 0.0, 1.0, 1.0], "column {x}");
    }
    // Of a picture of 5 x 5 there are four blocks; the second's first column is the picture's last.
    let mut data = [block; 4].concat();
    data[8..16].copy_from_slice(&[0, 0xF8, 0, 0, 0, 0, 0, 0]);
    let decoded = read(&d3d(D3DFormat::DXT1, 5, 1, None, data));
    assert_eq!((picture(&decoded).at(4, 1), picture(&decoded).at(3, 1)), ([1., 0., 0., 1.], [0., 0., 0., 1.]));
    // BC2, BC3: the colours stand behind 8 bytes of alpha.
    for format in [D3DFormat::DXT3, D3DFormat::DXT5] {
        let decoded = read(&d3d(format, 4, 1, None, [[0; 8], block].concat()));
        assert_eq!(first(picture(&decoded)), [1.0; 3]);
    }
    // BC4: first end 255, all indices 0.
    assert_eq!(
        first(picture(&read(&dxgi(DxgiFormat::BC4_UNorm, 4, 1, false, vec![255, 0, 0, 0, 0, 0, 0, 0])))),
        [1.0; 3]
    );
    // BC7, mode 5 (bit 5): colours of 7 bits, all ends white; BC6H, mode 3 (0b00011): ends of 10 bits.
    let mut bc7 = 0x20_u128;
    bc7 |= ((1 << 42) - 1) << 8;
    let decoded = read(&dxgi(DxgiFormat::BC7_UNorm, 4, 1, false, bc7.to_le_bytes().to_vec()));
    assert_eq!(first(picture(&decoded)), [1.0; 3]);
    let mut bc6h = 0b00011_u128;
    // Red ends 512 of 1023: (512 * 65536 + 32768) >> 10 = 32800, times 31 / 64 = 15887 as the bits of a half.
    bc6h |= 512 << 5 | 512 << 35;
    let decoded = read(&dxgi(DxgiFormat::BC6H_UF16, 4, 1, false, bc6h.to_le_bytes().to_vec()));
    assert!(decoded.high_dynamic_range);
    assert_eq!(first(picture(&decoded)), [half::f16::from_bits(15887).to_f32(), 0.0, 0.0]);
}

#[test]
fn unsupported_dds_is_named() {
    let file = dxgi(DxgiFormat::R8G8B8A8_UNorm, 2, 1, true, vec![0; 96]);
    let with = |changes: &[(usize, u32)]| {
        let mut file = file.clone();
        for (at, number) in changes {
            file[*at..at + 4].copy_from_slice(&number.to_le_bytes());
        }
        refusal(&file)
    };
    for (changes, expected) in [
        (&[(128, 83)][..], "its pixels are BC5"),
        (&[(128, 9999)], "its pixels are in the DXGI format 9999"),
        (&[(132, 4)], "it holds a volume"),
        (&[(16, 3)], "its faces are 3 x 2 pixels"),
        (&[(12, 0), (16, 0)], "the picture is 0 x 0 pixels"),
        (&[(12, u32::MAX), (16, u32::MAX)], "6 times 4294967295 x 4294967295 pixels are more than"),
        (&[(12, 4), (16, 4)], "the pixels should be the 64 bytes from byte"),
        (&[(84, u32::from_le_bytes(*b"ETC2"))], "its pixels are `ETC2`"),
    ] {
        let message = with(changes);
        assert!(message.starts_with(expected), "{changes:?}: {message}");
    }
}

const FORMATS: [(Ktx2Format, ktx2::Format); 3] = [
    (Ktx2Format::Half, ktx2::Format::R16G16B16A16_SFLOAT),
    (Ktx2Format::Float, ktx2::Format::R32G32B32A32_SFLOAT),
    (Ktx2Format::Srgb8, ktx2::Format::R8G8B8A8_SRGB),
];

fn put(bytes: &mut [u8], at: usize, number: u32) {
    bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
}

fn one_level(level: CubeLevel) -> Vec<CubeLevel> {
    vec![level]
}

/// A file whose only level is packed: 2 Zstandard (stored, not squeezed), 3 zlib.
pub fn packed(scheme: u32) -> Vec<u8> {
    let mut bytes = encode(&one_level(cube(4)), Ktx2Format::Half).bytes;
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
        assert_eq!((decoded.format, decoded.high_dynamic_range), (FileFormat::Ktx2, format != Ktx2Format::Srgb8));
        assert_eq!(decoded.notes, ["of 3 mip levels the largest is read"]);
        for (found, expected) in faces(&decoded).iter().zip(levels[0].faces()) {
            for (found, expected) in found.pixels.iter().flatten().zip(expected.iter().flatten()) {
                // Half a step of 11 bits, or of 255 steps where the curve is steepest (2.3 to 1).
                let tolerance = [expected / 2048.0, 0.0, 2.3 / 510.0][format as usize];
                assert!((found - expected).abs() <= tolerance, "{format:?}: {found} is not {expected}");
            }
        }
    }
}

#[test]
fn pictures_that_do_not_fit_are_reported() {
    let mut map = cube(2);
    map.pixels[3] = [70000.0, 2.0, 0.0, 1.0];
    let warnings = |format| encode(&one_level(map.clone()), format).warnings;
    assert!(warnings(Ktx2Format::Half)[0].starts_with("1 numbers are above 65504"), "{:?}", warnings(Ktx2Format::Half));
    assert!(warnings(Ktx2Format::Srgb8)[0].starts_with("2 numbers are above 1 "), "{:?}", warnings(Ktx2Format::Srgb8));
    assert!(warnings(Ktx2Format::Float).is_empty());
    let odd = [cube(4), cube(3)];
    assert!(encode(&odd, Ktx2Format::Float).warnings[0].starts_with("of 2 mip levels 1 are written"));
}

#[test]
fn packed_levels_are_unpacked() {
    for scheme in [2, 3] {
        let decoded = read(&packed(scheme));
        for (found, expected) in faces(&decoded).iter().zip(cube(4).faces()) {
            for (found, expected) in found.pixels.iter().flatten().zip(expected.iter().flatten()) {
                assert!((found - expected).abs() <= expected / 2048.0, "{scheme}: {found} is not {expected}");
            }
        }
    }
}

#[test]
fn pictures_and_integers_follow_the_metadata() {
    // Six faces of 1 x 1 are read as one picture of 1 x 6 once the header says so.
    let mut map = cube(1);
    for (i, pixel) in map.pixels.iter_mut().enumerate() {
        *pixel = [gonio_light::color::srgb_decode(i as f64 / 255.0) as f32, 0.0, 0.0, 1.0];
    }
    let mut file = encode(&one_level(map.clone()), Ktx2Format::Srgb8).bytes;
    put(&mut file, 24, 6);
    put(&mut file, 36, 1);
    let reds = |file: &[u8]| picture(&read(file)).pixels.iter().map(|p| p[0]).collect::<Vec<_>>();
    let expected: Vec<f32> = map.pixels.iter().map(|p| p[0]).collect();
    assert_eq!(reds(&file), expected);
    // Bottom up.
    let at = file.windows(3).position(|w| w == b"rd\0").unwrap_or_default();
    file[at + 1] = b'u';
    assert_eq!(reds(&file), expected.iter().rev().copied().collect::<Vec<_>>());
    // R8G8B8A8_UNORM, which the descriptor calls linear (1) or sRGB (2).
    file[at + 1] = b'd';
    put(&mut file, 12, 37);
    assert_eq!(reds(&file), expected);
    let transfer = 80 + 24 + 14;
    assert_eq!(file[transfer], 2);
    file[transfer] = 1;
    assert_eq!(reds(&file), (0..6).map(|i| i as f32 / 255.0).collect::<Vec<_>>());
    assert!(read(&file).notes[0].contains("linear light"));
}

#[test]
fn unsupported_ktx2_is_named() {
    let file = encode(&one_level(cube(2)), Ktx2Format::Half).bytes;
    let with = |at: usize, number: u32| {
        let mut file = file.clone();
        put(&mut file, at, number);
        refusal(&file)
    };
    for (at, number, expected) in [
        (12, 157, "its pixels are ASTC"),
        (12, 147, "its pixels are ETC2 or EAC"),
        (12, 141, "its pixels are BC5"),
        (12, 9999, "its pixels are in the Vulkan format 9999"),
        (20, 3, "its faces are 3 x 2 pixels"),
        (20, 0, "its faces are 0 x 2 pixels"),
        (28, 2, "it holds a volume"),
        (24, 0, "it holds one row of pixels"),
        (36, 5, "invalid number of faces 5"),
        (44, 1, "its levels are compressed with Basis LZ"),
        (44, 7, "its levels have the unknown supercompression scheme 7"),
        (44, 2, "its largest level is not valid Zstandard"),
        (44, 3, "its largest level cannot be unpacked"),
        (80, 1 << 20, "the largest level should be the 192 bytes from byte 1048576 on"),
        (88, 100, "its largest level is too short"),
    ] {
        let message = with(at, number);
        assert!(message.starts_with(expected), "{at} {number}: {message}");
    }
    let huge = {
        let mut file = file.clone();
        put(&mut file, 20, 1 << 20);
        put(&mut file, 24, 1 << 20);
        refusal(&file)
    };
    assert!(huge.starts_with("6 times 1048576 x 1048576 pixels are"), "{huge}");
}
