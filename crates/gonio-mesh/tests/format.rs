//! Files are what their content says, whatever their name is and wherever in them it says so.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::Format;

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
fn gltf_says_what_it_is_anywhere() {
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
fn collada_stands_behind_any_prolog() {
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
fn the_name_decides_about_text_that_says_nothing() {
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
fn the_header_of_a_binary_stl_is_no_text() {
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
