//! Every text format in UTF-16 and UTF-32: the same model as in UTF-8, and the same diagnostics at the same places.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::{Format, Limits, MissingSidecar, Model, NoSidecars, ReadError, Sidecar, Sidecars, mtl};

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

fn told(model: &Model) -> Vec<String> {
    model.diagnostics.iter().map(ToString::to_string).collect()
}

#[test]
fn models_and_places_are_those_of_the_same_text_in_utf_8() {
    for (format, text) in ALL {
        let read = |bytes: &[u8], library: Vec<u8>| format.read(bytes, &mut Library(library), &Limits::default());
        let expected = read(text.as_bytes(), MTL.into()).unwrap();
        assert!(!told(&expected).is_empty(), "{format:?} has nothing to tell");
        for (bytes, library) in encoded(text).into_iter().zip(encoded(MTL)) {
            let model = read(&bytes, library).unwrap();
            assert_eq!(told(&model), told(&expected), "{format:?}");
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
        let expected = read(cut.as_bytes()).map(|model| told(&model)).map_err(|error| error.to_string());
        for bytes in encoded(&cut) {
            let found = read(&bytes).map(|model| told(&model)).map_err(|error| error.to_string());
            assert_eq!(found, expected, "{format:?}");
        }
    }
}

#[test]
fn material_libraries_are_read_in_every_encoding() {
    let (expected, said) = mtl::read(MTL.as_bytes());
    assert_eq!((expected[0].name.as_str(), said.len()), ("ж", 1));
    for bytes in encoded(MTL) {
        let (materials, diagnostics) = mtl::read(&bytes);
        assert_eq!(format!("{materials:?}"), format!("{expected:?}"));
        assert_eq!(diagnostics, said);
        let explained = gonio_mesh::explain::mtl_line(&bytes, 4).unwrap();
        assert_eq!(explained.text, "map_Kd ж.png");
    }
}

#[test]
fn damage_is_told_with_its_place() {
    for (format, text) in ALL {
        let mut bytes: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        // Half of a character, at the end.
        bytes.extend(b"\n\0 \0x");
        let line = text.matches('\n').count() + 2;
        let Ok(model) = format.read(&bytes, &mut Library(MTL.into()), &Limits::default()) else { continue };
        let said = &told(&model)[0];
        let what = "warning: 1 invalid code unit of UTF-16 (little-endian), replaced by U+FFFD: the file is damaged";
        assert_eq!(*said, format!("{line}:2: {what}"), "{format:?}");
    }
}
