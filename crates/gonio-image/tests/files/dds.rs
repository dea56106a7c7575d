//! DDS, by another writer.

use crate::samples::{faces, picture, read, refusal};
use ddsfile::{AlphaMode, Caps2, D3D10ResourceDimension, D3DFormat, Dds, DxgiFormat, NewD3dParams, NewDxgiParams};
use gonio_image::Image;
use gonio_image::decode::FileFormat;
use gonio_light::color::srgb_decode;

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
        let unsaid = decoded.notes.iter().any(|n| n.contains("does not say how colours are encoded"));
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
fn uncompressed_pixels_have_the_colours_that_the_header_says() {
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
fn what_is_not_read_is_named() {
    let file = dxgi(DxgiFormat::R8G8B8A8_UNorm, 2, 1, true, vec![0; 96]);
    let with = |changes: &[(usize, u32)]| {
        let mut file = file.clone();
        for (at, number) in changes {
            file[*at..at + 4].copy_from_slice(&number.to_le_bytes());
        }
        refusal(&file)
    };
    for (changes, wanted) in [
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
        assert!(message.starts_with(wanted), "{changes:?}: {message}");
    }
}
