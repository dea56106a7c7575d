//! Encodings of text, detection of formats, and compressed files.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::{Format, Limits, MissingSidecar, Model, NoSidecars, ReadError, Sidecar, Sidecars, compression, mtl};
use std::path::Path;

const OBJ: &str = "# ж\no Würfel 🎲\nmtllib ж.mtl\nusemtl ж\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n";
const GLTF: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "name": "Würfel 🎲", "scale": [1, 1, 0]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
const COLLADA: &str = r##"<?xml version="1.0" encoding="UTF-8"?>
<!-- ж --><COLLADA version="1.9"><library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a">0 0 0 1 0 0 1 1 0</float_array><technique_common><accessor source="#a" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 1 9</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="w">
<node name="Würfel 🎲"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>"##;
const PLY: &str = "ply\nformat ascii 1.0\ncomment TextureFile ж.png\nelement vertex 3\nproperty float x\nproperty float y\n\
                   property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n\
                   0 1 0\n3 0 1 2\n3 0 1 9\n";
const STL: &str = "solid Würfel 🎲\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
                   endfacet\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
                   endfacet\nendsolid\n";
const MEDIT: &str = "MeshVersionFormatted 1 # ж\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles 2\n\
                     1 2 3 0\n1 2 9 0\nEnd\n";
const MTL: &str = "# ж\nnewmtl ж\nKd 1 0 0\nmap_Kd ж.png\nunknown\n";

const ALL: [(Format, &str); 6] = [
    (Format::Obj, OBJ),
    (Format::Gltf, GLTF),
    (Format::Collada, COLLADA),
    (Format::Ply, PLY),
    (Format::Stl, STL),
    (Format::Medit, MEDIT),
];

fn encoded(text: &str) -> Vec<Vec<u8>> {
    let marked = format!("\u{feff}{text}");
    let utf_16 = |text: &str, order: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(order).collect::<Vec<u8>>();
    let utf_32 = |order: fn(u32) -> [u8; 4]| marked.chars().flat_map(|c| order(c.into())).collect::<Vec<u8>>();
    vec![
        utf_16(&marked, u16::to_le_bytes),
        utf_16(&marked, u16::to_be_bytes),
        utf_16(text, u16::to_le_bytes),
        utf_16(text, u16::to_be_bytes),
        utf_32(u32::to_le_bytes),
        utf_32(u32::to_be_bytes),
    ]
}

/// A material library in the same encoding.
struct Library(Vec<u8>);

impl Sidecars for Library {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        assert_eq!(name, "ж.mtl");
        Ok(Sidecar { path: name.to_owned(), bytes: self.0.clone() })
    }
}

fn messages_of(model: &Model) -> Vec<String> {
    model.diagnostics.iter().map(ToString::to_string).collect()
}

#[test]
fn models_and_places_are_those_of_the_same_text_in_utf_8() {
    for (format, text) in ALL {
        let read = |bytes: &[u8], library: Vec<u8>| format.read(bytes, &mut Library(library), &Limits::default());
        let expected = read(text.as_bytes(), MTL.into()).unwrap();
        assert!(!messages_of(&expected).is_empty(), "{format:?} has no messages");
        for (bytes, library) in encoded(text).into_iter().zip(encoded(MTL)) {
            let model = read(&bytes, library).unwrap();
            assert_eq!(messages_of(&model), messages_of(&expected), "{format:?}");
            assert_eq!(format!("{:?}", model.mesh.parts), format!("{:?}", expected.mesh.parts));
            assert_eq!(format!("{:?}", model.materials), format!("{:?}", expected.materials));
            assert_eq!(
                (&model.mesh.positions, &model.mesh.indices),
                (&expected.mesh.positions, &expected.mesh.indices)
            );
            assert_eq!(Format::detect(&bytes, ""), Ok(format));
        }
        let names: Vec<&str> = expected.mesh.parts.iter().map(|part| part.name.as_str()).collect();
        let has_names = !matches!(format, Format::Ply | Format::Medit);
        assert_eq!(names.contains(&"Würfel 🎲"), has_names, "{format:?}: {names:?}");
    }
}

#[test]
fn errors_are_those_of_the_same_text_in_utf_8() {
    for (format, text) in ALL {
        // Cut off within the last third.
        let cut: String = text.chars().take(text.chars().count() * 7 / 10).collect();
        let read =
            |bytes: &[u8]| -> Result<Model, ReadError> { format.read(bytes, &mut NoSidecars, &Limits::default()) };
        let expected = read(cut.as_bytes()).map(|model| messages_of(&model)).map_err(|error| error.to_string());
        for bytes in encoded(&cut) {
            let found = read(&bytes).map(|model| messages_of(&model)).map_err(|error| error.to_string());
            assert_eq!(found, expected, "{format:?}");
        }
    }
}

#[test]
fn material_libraries_are_read_in_every_encoding() {
    let (expected, messages) = mtl::read(MTL.as_bytes());
    assert_eq!((expected[0].name.as_str(), messages.len()), ("ж", 1));
    for bytes in encoded(MTL) {
        let (materials, diagnostics) = mtl::read(&bytes);
        assert_eq!(format!("{materials:?}"), format!("{expected:?}"));
        assert_eq!(diagnostics, messages);
        let explained = gonio_mesh::explain::mtl_line(&bytes, 4).unwrap();
        assert_eq!(explained.text, "map_Kd ж.png");
    }
}

#[test]
fn damage_is_reported_with_its_place() {
    for (format, text) in ALL {
        let mut bytes: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        // Half of a character, at the end.
        bytes.extend(b"\n\0 \0x");
        let line = text.matches('\n').count() + 2;
        let Ok(model) = format.read(&bytes, &mut Library(MTL.into()), &Limits::default()) else { continue };
        let message = &messages_of(&model)[0];
        let what = "warning: 1 invalid code unit of UTF-16 (little-endian), replaced by U+FFFD: the file is damaged";
        assert_eq!(*message, format!("{line}:2: {what}"), "{format:?}");
    }
}

/// Longer than what is looked at of a text.
const LONG: usize = 100_000;

fn utf_16(text: &str) -> [Vec<u8>; 4] {
    let encode = |mark: &str, order: fn(u16) -> [u8; 2]| -> Vec<u8> {
        format!("{mark}{text}").encode_utf16().flat_map(order).collect()
    };
    [
        encode("\u{feff}", u16::to_le_bytes),
        encode("\u{feff}", u16::to_be_bytes),
        encode("", u16::to_le_bytes),
        encode("", u16::to_be_bytes),
    ]
}

/// A text in UTF-8 without and with a byte order mark, and in UTF-16, under any name.
#[track_caller]
fn is_always(format: Format, text: &str) {
    let names =
        ["", "-", "model", "model.txt", "model.json", "model.xml", "model.OBJ", "model.gltf", "a.dae.gz", "a.stl"];
    let encoded = [text.as_bytes().to_vec(), format!("\u{feff}{text}").into_bytes()].into_iter().chain(utf_16(text));
    for content in encoded {
        for name in names {
            let start = String::from_utf8_lossy(&content[..content.len().min(60)]).into_owned();
            assert_eq!(Format::detect(&content, name), Ok(format), "{name:?}: {start}");
        }
    }
}

#[test]
fn gltf_is_detected_by_keys_in_any_order() {
    let buffers = format!(r#""buffers": [{{"byteLength": 1, "uri": "data:,{}"}}]"#, "A".repeat(LONG));
    let nodes = format!(r#""nodes": [{}{{}}]"#, r#"{"name": "\"}", "translation": [1, 2, 3]}, "#.repeat(3_000));
    is_always(Format::Gltf, r#"{"asset":{"version":"2.0"}}"#);
    is_always(Format::Gltf, &format!("\n {{ {buffers}, {nodes}, \"asset\" : {{\"version\": \"2.0\"}} }}"));
    is_always(Format::Gltf, &format!("{{ {nodes}, \"accessors\": [] }}"));
}

#[test]
fn json_that_is_not_gltf_is_read_as_gltf_by_its_name_only() {
    let others = [
        format!(r#"{{"assets": ["{}"], "asset_list": {{"asset": 1}}}}"#, "asset".repeat(LONG / 5)),
        r#"{"name": "package", "version": "2.0"}"#.to_owned(),
        r#"{"a": "#.repeat(LONG),
    ];
    for json in others {
        for name in ["", "package.json", "model.obj", "model.glb"] {
            assert_eq!(Format::detect(json.as_bytes(), name), Err(Some("a JSON file that is not glTF")), "{name}");
        }
        // The reader says what it lacks.
        for name in ["model.gltf", "MODEL.GLTF", "model.gltf.zst"] {
            assert_eq!(Format::detect(json.as_bytes(), name), Ok(Format::Gltf), "{name}");
        }
    }
}

#[test]
fn collada_is_detected_after_any_prolog() {
    let comment = format!("<!-- {} -->", "<html> ".repeat(LONG / 7));
    is_always(Format::Collada, "<COLLADA version=\"1.4.1\"/>");
    is_always(Format::Collada, &format!("<?xml version=\"1.0\"?>\n{comment}<c:COLLADA>"));
    is_always(
        Format::Collada,
        &format!("{comment}<?p q?>\r\n<!DOCTYPE COLLADA [<!-- ]> --> <!ENTITY a \">\">]><COLLADA>"),
    );
    for xml in [format!("<?xml version='1.0'?>{comment}<svg a='COLLADA'>"), "<!DOCTYPE html><html>COLLADA".to_owned()] {
        for name in ["", "a.dae", "a.html"] {
            assert_eq!(Format::detect(xml.as_bytes(), name), Err(Some("an XML or HTML file")), "{name}");
        }
    }
    // Broken off before its root: the reader says where, if the name calls it COLLADA.
    assert_eq!(Format::detect(b"<?xml version='1.0'?><!-- a", "a.dae"), Ok(Format::Collada));
    assert_eq!(Format::detect(b"<?xml version='1.0'?><!-- a", "a"), Err(Some("an XML or HTML file")));
}

#[test]
fn comments_of_any_length_may_stand_first() {
    let comments = format!("\n# {}\r\n\r#\n{}", "v".repeat(LONG), "# facet solid\n".repeat(1_000));
    is_always(Format::Obj, &format!("{comments}\n  v 1 2 3\n"));
    is_always(Format::Medit, &format!("{comments}MeshVersionFormatted 2\n"));
    is_always(Format::Medit, "meshversionformatted 1 dimension 3");
    is_always(Format::Stl, "solid a\n  facet normal 0 0 1\n");
    is_always(Format::Stl, "SOLID\nENDSOLID");
    is_always(Format::Ply, "ply\r\nformat ascii 1.0\n");
    is_always(Format::Ply, "ply \nformat ascii 1.0\n");
}

#[test]
fn the_name_decides_about_ambiguous_text() {
    let texts = ["hello\n", "# nothing\n", "plywood\n", "solid gold\n", "# v 1 2 3"];
    let names = [
        ("a.obj", Format::Obj),
        ("A.PLY", Format::Ply),
        ("a.b.stl.gz", Format::Stl),
        ("a.mesh", Format::Medit),
        ("a.dae", Format::Collada),
    ];
    for text in texts {
        for (name, format) in names {
            assert_eq!(Format::detect(text.as_bytes(), name), Ok(format), "{text}");
        }
        assert_eq!(Format::detect(text.as_bytes(), "a.txt"), Err(None), "{text}");
    }
    let ogre = b"\0\x10[MeshSerializer_v1.8]\n";
    assert_eq!(Format::detect(ogre, "a.mesh"), Err(Some("an Ogre mesh (export it as OBJ or glTF)")));
}

/// The 80 bytes before a binary STL may be anything, text in UTF-16 too.
#[test]
fn the_header_of_a_binary_stl_is_not_read_as_text() {
    for text in ["solid a facet", "v 1 2 3", "\u{feff}v 1 2 3", "{\"asset\":1}", "<COLLADA>"] {
        let mut stl: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        stl.resize(80, 0);
        stl.extend(1_u32.to_le_bytes());
        stl.extend(
            [0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|c| c.to_le_bytes()),
        );
        stl.extend([0, 0]);
        assert_eq!(Format::detect(&stl, ""), Ok(Format::Stl), "{text}");
        let limits = gonio_mesh::Limits::default();
        let model = gonio_mesh::stl::read(&stl, &mut gonio_mesh::NoSidecars, &limits).unwrap();
        assert_eq!(model.mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    }
}

const TEXT: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn packed(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/compression").join(name)).unwrap()
}

fn unpack(bytes: &[u8]) -> Result<Option<Vec<u8>>, String> {
    compression::unpack(bytes, &Limits::default()).map_err(|error| error.to_string())
}

#[test]
fn uncompressed_files_are_unchanged() {
    for bytes in [&b""[..], b"v 0 0 0\n", b"\x1F", b"(\xB5/", b"PL*M\x18"] {
        assert!(!compression::is_compressed(bytes));
        assert_eq!(unpack(bytes), Ok(None));
    }
}

#[test]
fn both_methods_unpack_the_original() {
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
fn every_cut_is_reported() {
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
fn rubbish_behind_the_data_is_reported() {
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
fn impossible_compression_ratios_are_refused() {
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
