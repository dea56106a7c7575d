//! Odd glTF files that are read: whole numbers in any spelling (JSON does not distinguish `1`, `1.0` and `1e0`), and files that
//! are read with a warning.

use crate::builder::{File, assert_message, glb, rich};
use gonio_mesh::{Limits, Model, NoSidecars, ReadError, gltf};
use serde_json::{Value, json};

fn read(json: &str) -> Result<Model, ReadError> {
    gltf::read(json.as_bytes(), &mut NoSidecars, &Limits::default())
}

fn text(file: &File) -> Value {
    serde_json::from_slice(&file.gltf()).unwrap()
}

/// A skinned triangle, a file with a bit of everything, and one without a scene.
fn files() -> Vec<Value> {
    let mut skinned = File::triangle();
    let matrix = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 2.0, 3.0, 4.0, 1.0];
    let matrices = skinned.floats(&matrix, "MAT4");
    let joint = skinned.root_node(json!({ "translation": [0, 0, 7] }));
    skinned.push("skins", json!({ "joints": [joint], "inverseBindMatrices": matrices }));
    skinned.set("/nodes/0/skin", 0.into());
    let mut rootless = rich();
    rootless.json.as_object_mut().unwrap().retain(|key, _| key != "scene" && key != "scenes");
    [skinned, rich(), rootless].iter().map(text).collect()
}

/// The document with every whole number written by `write`.
fn rewritten(value: &Value, write: &impl Fn(u64) -> String) -> String {
    match value {
        Value::Array(list) => format!("[{}]", list.iter().map(|v| rewritten(v, write)).collect::<Vec<_>>().join(",")),
        Value::Object(members) => {
            let member = |(key, value): (&String, &Value)| format!("{}:{}", json!(key), rewritten(value, write));
            format!("{{{}}}", members.iter().map(member).collect::<Vec<_>>().join(","))
        }
        _ => value.as_u64().map_or_else(|| value.to_string(), write),
    }
}

#[test]
fn whole_numbers_may_be_written_in_any_way() {
    for file in files() {
        let ways: [&dyn Fn(u64) -> String; 4] = [
            &|n| format!("{n}.0"),
            &|n| format!("{n}e0"),
            &|n| if n == 0 { "0.0E-1".to_owned() } else { format!("{n}0.0E-1") },
            &|n| format!("{n}.000e+00"),
        ];
        for way in ways {
            let json = rewritten(&file, &way);
            let summary = |json: &str| {
                let mut model = read(json).unwrap();
                // The sources of a material quote the file literally.
                model.materials.iter_mut().for_each(|material| material.sources.clear());
                let Model { mesh, materials, lights, cameras, contents, .. } = &model;
                format!("{mesh:?}{materials:?}{lights:?}{cameras:?}{contents:?}{}", model.images.len())
            };
            assert_eq!(summary(&json), summary(&file.to_string()), "{json}");
        }
    }
}

/// Keys whose values are indices, counts and codes, and arrays of indices.
const WHOLE: [&str; 24] = [
    "scene",
    "mesh",
    "camera",
    "skin",
    "indices",
    "material",
    "mode",
    "bufferView",
    "buffer",
    "byteOffset",
    "byteLength",
    "byteStride",
    "componentType",
    "count",
    "index",
    "source",
    "sampler",
    "wrapS",
    "wrapT",
    "light",
    "POSITION",
    "NORMAL",
    "TEXCOORD_0",
    "inverseBindMatrices",
];
const LISTS: [&str; 3] = ["nodes", "children", "joints"];

/// The places of whole numbers: as JSON pointers, and as messages name them.
fn places(value: &Value, pointer: &str, path: &str, found: &mut Vec<(String, String)>) {
    match value {
        Value::Object(members) => {
            for (key, value) in members {
                let (pointer, path) = (format!("{pointer}/{key}"), format!("{path}.{key}"));
                if WHOLE.contains(&key.as_str()) && value.is_u64() {
                    found.push((pointer.clone(), path.trim_start_matches('.').to_owned()));
                }
                if let Value::Array(list) = value
                    && LISTS.contains(&key.as_str())
                    && list.first().is_some_and(Value::is_u64)
                {
                    found.push((format!("{pointer}/0"), format!("{}[0]", path.trim_start_matches('.'))));
                }
                places(value, &pointer, &path, found);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                places(value, &format!("{pointer}/{index}"), &format!("{path}[{index}]"), found);
            }
        }
        _ => {}
    }
}

/// A wrong number at each place is named by an error, or by a warning if it can be left out.
#[test]
fn fractions_and_negative_numbers_are_named() {
    let mut tried = 0;
    for file in files() {
        let mut found = Vec::new();
        places(&file, "", "", &mut found);
        for (pointer, path) in found {
            for (wrong, shown) in [(json!(0.5), "0.5"), (json!(-1), "-1"), (json!(-1.0), "-1.0"), (json!("0"), "\"0\"")]
            {
                let mut broken = file.clone();
                *broken.pointer_mut(&pointer).unwrap() = wrong;
                let messages = match read(&broken.to_string()) {
                    Ok(model) => model.diagnostics.iter().map(ToString::to_string).collect(),
                    Err(error) => vec![error.to_string()],
                };
                let names_it = |messages: &String| messages.contains(&path) && messages.contains(shown);
                assert!(messages.iter().any(names_it), "{path} = {shown}: {messages:#?}");
                tried += 1;
            }
        }
    }
    assert!(tried > 200, "{tried}");
}

#[test]
fn odd_containers() {
    let file = File::triangle();
    let messages = |bytes: &[u8]| {
        let model = gltf::read(bytes, &mut NoSidecars, &Limits::default()).unwrap();
        assert_eq!(model.mesh.triangle_count(), 1);
        model.diagnostics.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let mut trailing = file.glb();
    trailing.extend(b"more");
    assert_message(&messages(&trailing), "warning: 4 bytes after the end declared in the header are ignored");
    let mut chunk = file.glb();
    let at = chunk.len();
    chunk.extend(b"\x04\0\0\0ACMEabcd");
    let total = (chunk.len() as u32).to_le_bytes();
    chunk[8..12].copy_from_slice(&total);
    assert_message(&messages(&chunk), &format!("note: byte {at}: a chunk of the unknown type \"ACME\" is skipped"));
    let mut mark = b"\xEF\xBB\xBF".to_vec();
    mark.extend(file.gltf());
    assert_message(&messages(&mark), "note: begins with a byte order mark, which JSON does not allow: skipped");
    // A binary chunk may be up to three bytes longer than its buffer.
    let mut json = file.json.clone();
    json["buffers"] = json!([{ "byteLength": 36 }]);
    let mut longer = file.bytes.clone();
    longer.extend([1, 2, 3]);
    assert_eq!(messages(&glb(&json.to_string(), &longer)).len(), 2);
}

#[test]
fn extensions_that_are_used() {
    let mut file = File::triangle();
    file.json["extensionsUsed"] = json!([
        "KHR_materials_variants",
        "KHR_texture_basisu",
        "KHR_draco_mesh_compression",
        "ACME_smell",
        "KHR_materials_sheen",
        "KHR_lights_punctual",
        "ACME_smell",
    ]);
    file.json["extensionsRequired"] = json!(["KHR_texture_basisu", "KHR_materials_sheen", "KHR_techniques_webgl"]);
    let (_, messages) = file.read_with_messages();
    let warnings: Vec<&String> = messages.iter().filter(|s| s.starts_with("warning")).collect();
    let expected = [
        "warning: uses the extension \"KHR_materials_variants\", which is not supported: each part has its first material",
        "warning: uses the extension \"KHR_texture_basisu\", which is not supported: KTX2 images cannot be read",
        "warning: uses the extension \"KHR_draco_mesh_compression\", which is not supported: the rest of the file is shown",
        "warning: uses the extension \"ACME_smell\", which is not supported: its data is ignored",
    ];
    assert_eq!(warnings, expected);
}

#[test]
fn odd_primitives() {
    let mut file = File::triangle();
    file.of_primitive(json!({ "attributes": {} }));
    file.of_primitive(json!({ "attributes": { "POSITION": 0, "_TEMPERATURE": 0, "WARMTH": 0, "COLOR_1": 0 } }));
    let two = file.floats(&[0.0; 6], "VEC3");
    file.of_primitive(json!({ "attributes": { "POSITION": 0, "NORMAL": two } }));
    file.of_primitive(json!({ "attributes": { "POSITION": two } }));
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.triangle_count(), 3);
    assert_message(&messages, "warning: meshes[1].primitives[0] has no POSITION: it is not drawn");
    assert_message(&messages, "note: meshes[2].primitives[0].attributes.WARMTH is unknown: not used");
    assert_message(
        &messages,
        "note: meshes[2].primitives[0].attributes.COLOR_1 is an additional set of colors: not used",
    );
    assert!(!messages.iter().any(|s| s.contains("_TEMPERATURE")));
    assert_message(&messages, "warning: meshes[3].primitives[0]: NORMAL has 2 elements, but POSITION has 3: ignored");
    assert_message(&messages, "warning: meshes[4].primitives[0] has no triangles");
    let mut file = File::triangle();
    let normals = file.floats(&[f32::NAN, 0.0, 1.0, 0.0, f32::INFINITY, 1.0, 0.0, 0.0, 1.0], "VEC3");
    file.set("/meshes/0/primitives/0/attributes/NORMAL", normals.into());
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.normals, [[0.0, 0.0, 1.0]; 3]);
    assert_message(&messages, "warning: 2 numbers of normals are not finite: using 0 instead");
    assert!(!messages.iter().any(|s| s.contains("colors")), "{messages:?}");
    let mut file = File::triangle();
    let colors = file.floats(&[0.5, f32::NAN, 1.0].repeat(3), "VEC3");
    let tex_coords = file.floats(&[0.5, 0.5, f32::NEG_INFINITY, 0.5, 0.5, 0.5], "VEC2");
    file.set("/meshes/0/primitives/0/attributes/COLOR_0", colors.into());
    file.set("/meshes/0/primitives/0/attributes/TEXCOORD_0", tex_coords.into());
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.colors, [[0.5, 0.0, 1.0, 1.0]; 3]);
    assert_message(&messages, "warning: 3 numbers of colors are not finite: using 0 instead");
    assert_message(&messages, "warning: 1 number of texture coordinates is not finite: using 0 instead");
}

/// The same oddity at a thousand places is reported twenty times.
#[test]
fn many_of_a_kind_are_counted() {
    let mut file = File::triangle();
    for _ in 0..1000 {
        file.of_primitive(json!({ "attributes": { "POSITION": 0 }, "mode": 0 }));
    }
    let (_, messages) = file.read_with_messages();
    assert_eq!(messages.iter().filter(|s| s.ends_with("consists of points, not triangles: not drawn")).count(), 20);
    assert_message(&messages, "warning: and 980 more: primitives of points or lines");
}
