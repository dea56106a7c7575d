//! One place says what a file is: what `inspect` reads is described and loaded too, whatever its name and encoding.

use crate::memory::{Memory, TRIANGLE};
use gonio_mesh::Limits;
use gonio_scene::inspect;
use gonio_scene::load::{describe, load};
use std::path::Path;

/// A triangle whose `asset` is its last key, behind more than the first kilobytes.
fn gltf() -> String {
    let nodes = r#"{"name": "asset", "translation": [1, 2, 3]}, "#.repeat(500);
    format!(
        r#"{{"scene": 0, "scenes": [{{"nodes": [500]}}], "nodes": [{nodes}{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}}],
        "asset": {{"version": "2.0"}}}}"#
    )
}

fn collada() -> String {
    let comment = "-".repeat(5000).replace("--", "- ");
    format!(
        r##"<?xml version="1.0"?><!-- {comment} --><COLLADA version="1.4.1"><library_geometries><geometry id="g"><mesh>
        <source id="s"><float_array id="a">0 0 0 1 0 0 1 1 0</float_array><technique_common>
        <accessor source="#a" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
        <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
        </mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="w">
        <node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#w"/></scene></COLLADA>"##
    )
}

fn utf_16(text: &str) -> Vec<u8> {
    format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect()
}

#[test]
fn what_is_inspected_is_described_and_loaded() {
    let obj = format!("{}{TRIANGLE}", "# a comment\n".repeat(1000));
    for text in [gltf(), collada(), obj] {
        for content in [text.clone().into_bytes(), utf_16(&text)] {
            for name in ["a.gltf", "a.dae", "a.obj", "a.json", "a.txt", "-", "a"] {
                let files = Memory::default().with(name, content.clone());
                let inspected = inspect::inspect(name, &files, &Limits::default()).unwrap();
                assert_eq!(inspected.geometry.triangles, 1, "{name}");
                let scene = load(describe(&[name], &files).unwrap(), Path::new(""), &files).unwrap();
                assert_eq!(scene.settings.objects[0].model, name);
            }
        }
    }
}

/// The name decides what the content leaves open, for describing as for inspecting.
#[test]
fn errors_come_from_the_reader_that_the_name_asks_for() {
    for (name, content) in [("a.gltf", "{\"a\": 1}"), ("a.ply", "hello"), ("a.dae", "<?xml version='1.0'?>")] {
        let files = Memory::default().with(name, content);
        let inspected = inspect::inspect(name, &files, &Limits::default()).err().unwrap().to_string();
        let loaded = load(describe(&[name], &files).unwrap(), Path::new(""), &files).err().unwrap().to_string();
        assert_eq!(loaded, inspected);
    }
}

#[test]
fn scene_files_may_be_utf_16() {
    let text = "# ж\n[[object]]\nmodel = \"builtin:cube\"\nname = \"Würfel\"\n";
    for name in ["s.toml", "s", "-"] {
        let files = Memory::default().with(name, utf_16(text));
        assert_eq!(describe(&[name], &files).unwrap().objects[0].model, "builtin:cube", "{name}");
    }
    let wrong = utf_16("# ж\n[camera]\nfov_y = 200\n");
    let error = describe(&["s.toml"], &Memory::default().with("s.toml", wrong)).unwrap_err().to_string();
    assert_eq!(error, "s.toml:3:9: `fov_y` must be greater than 0 and less than 180 degrees, not 200");
    let mut damaged = utf_16("[camera]\n# ");
    damaged.extend([0x00, 0xD8]);
    let error = describe(&["s.toml"], &Memory::default().with("s.toml", damaged)).unwrap_err().to_string();
    assert_eq!(error, "s.toml:2:3: a scene file must be UTF-8 or UTF-16 text, and here it is neither");
}
