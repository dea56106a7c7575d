//! JSON makes no difference between `1`, `1.0` and `1e0`: neither does a file's index, count or code.

use crate::builder::{File, rich};
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
                // What a material quotes of the file is as it is written there.
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

/// Where whole numbers stand: as JSON pointers, and as messages name them.
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

/// Each place in turn: an error or, of what can be left out, a warning names it.
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
                let said = match read(&broken.to_string()) {
                    Ok(model) => model.diagnostics.iter().map(ToString::to_string).collect(),
                    Err(error) => vec![error.to_string()],
                };
                let names_it = |said: &String| said.contains(&path) && said.contains(shown);
                assert!(said.iter().any(names_it), "{path} = {shown}: {said:#?}");
                tried += 1;
            }
        }
    }
    assert!(tried > 200, "{tried}");
}
