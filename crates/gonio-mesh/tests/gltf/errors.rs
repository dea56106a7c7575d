//! glTF files that are refused, and limits.

use crate::builder::{File, Files, U8, glb, rich};
use gonio_mesh::{Limits, Model, NoSidecars, ReadError, gltf};
use serde_json::{Value, json};

fn error(bytes: &[u8]) -> String {
    gltf::read(bytes, &mut NoSidecars, &Limits::default()).unwrap_err().to_string()
}

#[test]
fn files_that_are_not_gltf() {
    let cases: [(&[u8], &str); 8] = [
        (b"", "the file is empty"),
        (b" \n", "the file is empty"),
        (b"{\n  \"asset\": }", "2:12: this is not valid JSON: expected value"),
        (b"{\n  \"asset\": {", "2:12: this is not valid JSON: EOF while parsing an object: the file is cut off"),
        (b"[]", "this is not a glTF 2.0 file: its JSON has no asset.version"),
        (b"{\"asset\": {}}", "this is not a glTF 2.0 file: its JSON has no asset.version"),
        (
            b"{\"asset\": {\"version\": \"1.0\"}}",
            "this is glTF 1.0, which is not supported: convert it to glTF 2.0, for example with gltf-pipeline",
        ),
        (
            b"{\"asset\": {\"version\": \"3.1\"}}",
            "this file needs glTF \"3.1\", but only 2.0 is supported: export it as glTF 2.0",
        ),
    ];
    for (bytes, expected) in cases {
        assert_eq!(error(bytes), expected);
    }
    let newer = File::triangle().with("/asset/minVersion", json!("2.1")).error();
    assert_eq!(newer, "this file needs glTF \"2.1\", but only 2.0 is supported: export it as glTF 2.0");
    assert_eq!(File::triangle().with("/asset/version", json!(2.0)).error(), "asset.version is 2.0, expected a string");
    // Early files of 1.0 have a number instead of a text.
    for version in [json!(1), json!(1.0), json!(0.8)] {
        let error = File::triangle().with("/asset/version", version).error();
        assert_eq!(
            error,
            "this is glTF 1.0, which is not supported: convert it to glTF 2.0, for example with gltf-pipeline"
        );
    }
    // A later 2.x that asks for no more than 2.0 is read.
    File::triangle().with("/asset/version", json!("2.1")).with("/asset/minVersion", json!("2.0")).quiet();
}

#[test]
fn broken_containers() {
    let good = File::triangle().glb();
    let change = |at: usize, bytes: &[u8]| {
        let mut changed = good.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        error(&changed)
    };
    let size = good.len();
    assert_eq!(error(&good[..7]), "is cut off after 7 bytes, within its header of 12");
    assert_eq!(error(&good[..20]), format!("is cut off: its header declares {size} bytes, but there are only 20"));
    assert_eq!(change(4, &[9, 0, 0, 0]), "byte 4: unknown container version 9: expected 2");
    assert!(change(4, &[1, 0, 0, 0]).starts_with("this is glTF 1.0"));
    assert_eq!(change(16, b"NOSJ"), "byte 12: the first chunk is not JSON");
    let left = size - 20;
    let most = format!("byte 12: a chunk declares 4294967295 bytes, but only {left} are left in the file");
    assert_eq!(change(12, &[255; 4]), most);
    assert_eq!(change(20, b"}"), "1:1: the JSON in this binary glTF is not valid JSON: expected value");
    assert_eq!(change(8, &[12, 0, 0, 0]), "contains no JSON: the file is cut off or empty");
    assert_eq!(change(8, &[15, 0, 0, 0]), "byte 12: a chunk's header is cut off");
}

#[test]
fn extensions_that_are_required() {
    let needs = |name: &str| File::triangle().with("/extensionsRequired", json!([name])).error();
    assert_eq!(
        needs("KHR_draco_mesh_compression"),
        "needs the extension \"KHR_draco_mesh_compression\", which is not supported: export it without Draco compression"
    );
    let advice = "export it without meshopt compression, or unpack it with gltf-transform";
    let meshopt = needs("EXT_meshopt_compression");
    assert_eq!(meshopt, format!("needs the extension \"EXT_meshopt_compression\", which is not supported: {advice}"));
    assert_eq!(
        needs("ACME_geometry"),
        "needs the extension \"ACME_geometry\", which is not supported: export it without that extension"
    );
    File::triangle().with("/extensionsRequired", json!(["KHR_mesh_quantization", "KHR_texture_transform"])).quiet();
}

/// One change each to a file that can be read.
#[test]
fn broken_places_are_named() {
    let nested = |file: &mut File| {
        file.push("nodes", json!({ "children": [2] }));
        file.push("nodes", json!({ "children": [1] }));
        file.json["scenes"][0]["nodes"] = json!([0, 1]);
    };
    type Change = fn(&mut File);
    let set: [(&str, Value, &str); 20] = [
        ("/accessors/0/count", json!(-1), "accessors[0].count is -1, expected a non-negative integer"),
        ("/accessors/0/count", json!(2.5), "accessors[0].count is 2.5, expected a non-negative integer"),
        (
            "/accessors/0/count",
            json!(4),
            "accessors[0] reaches beyond its buffer view: 4 elements of 12 bytes, 12 apart, from byte 0 of 36",
        ),
        (
            "/accessors/0/count",
            json!(u64::MAX),
            "accessors[0] reaches beyond its buffer view: 18446744073709551615 elements of 12 bytes, 12 apart, from byte 0 of 36",
        ),
        (
            "/accessors/0/byteOffset",
            json!(4),
            "accessors[0] reaches beyond its buffer view: 3 elements of 12 bytes, 12 apart, from byte 4 of 36",
        ),
        (
            "/accessors/0/componentType",
            json!(5124),
            "accessors[0].componentType = 5124 is not one of 5120 (i8), 5121 (u8), 5122 (i16), 5123 (u16), 5125 (u32), 5126 (f32)",
        ),
        (
            "/accessors/0/type",
            json!("VEC2"),
            "accessors[0] has the type \"VEC2\", which meshes[0].primitives[0].attributes.POSITION cannot have",
        ),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(1),
            "meshes[0].primitives[0].attributes.POSITION = 1, but the file has 1 accessors",
        ),
        (
            "/meshes/0/primitives/0/mode",
            json!(7),
            "meshes[0].primitives[0].mode = 7, which is not a primitive mode (0 to 6)",
        ),
        (
            "/meshes/0/primitives/0/material",
            json!(0),
            "meshes[0].primitives[0].material = 0, but the file has 0 materials",
        ),
        ("/meshes/0/primitives", json!(3), "meshes[0].primitives is 3, expected an array"),
        ("/bufferViews/0/byteLength", json!(37), "bufferViews[0] is 37 bytes from byte 0, but its buffer has 36"),
        (
            "/bufferViews/0/byteOffset",
            json!(u64::MAX),
            "bufferViews[0] is 36 bytes from byte 18446744073709551615, but its buffer has 36",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(8),
            "accessors[0] has elements of 12 bytes, but its view's byteStride is 8",
        ),
        ("/bufferViews/0/buffer", json!(1), "bufferViews[0].buffer = 1, but the file has 1 buffers"),
        ("/nodes/0/mesh", json!(1), "nodes[0].mesh = 1, but the file has 1 meshes"),
        ("/nodes/0/scale", json!([1, 1]), "nodes[0].scale is [1, 1], expected 3 numbers"),
        ("/scenes/0/nodes", json!([4]), "scenes[0].nodes[0] = 4, but the file has 1 nodes"),
        ("/scene", json!(1), "scene = 1, but the file has 1 scenes"),
        (
            "/nodes/0/translation",
            json!([1e39, 0, 0]),
            "meshes[0].primitives[0] has a coordinate that is not finite: the file is damaged",
        ),
    ];
    for (pointer, value, expected) in set {
        assert_eq!(File::triangle().with(pointer, value).error(), expected, "{pointer}");
    }
    let change: [(Change, &str); 8] = [
        (
            |file| drop(file.json["accessors"][0].as_object_mut().unwrap().remove("count")),
            "accessors[0] has no count: the file is damaged or of another version",
        ),
        (
            |file| drop(file.json["bufferViews"][0].as_object_mut().unwrap().remove("byteLength")),
            "bufferViews[0] has no byteLength: the file is damaged or of another version",
        ),
        (
            |file| file.json["nodes"][0]["children"] = json!([0]),
            "nodes[0].children names node 0, which is its own ancestor: the nodes form a cycle",
        ),
        (
            |file| file.json["scenes"][0]["nodes"] = json!([0, 0]),
            "scenes[0].nodes names node 0, which is already a root of the scene: a node can have only one parent",
        ),
        (
            |file| {
                file.root_node(json!({ "children": [2] }));
                file.push("nodes", json!({}));
                file.root_node(json!({ "children": [2] }));
            },
            "nodes[3].children names node 2, which is already a child of nodes[1]: a node can have only one parent",
        ),
        (
            |file| {
                file.json.as_object_mut().unwrap().remove("scenes");
                file.json.as_object_mut().unwrap().remove("scene");
                file.json["nodes"][0]["children"] = json!([0]);
            },
            "nodes: every node is a child of another, so they form a cycle: the file is damaged",
        ),
        (
            |file| file.json["nodes"][0] = json!({}),
            "contains no triangles (nodes in the scene: 1, meshes: 1): nothing to draw",
        ),
        (
            |file| {
                let (indices, values) = (file.view(&[3]), file.view(&[0; 12]));
                file.json["accessors"][0]["sparse"] = json!({
                    "count": 1, "indices": { "bufferView": indices, "componentType": U8 }, "values": { "bufferView": values },
                });
            },
            "accessors[0].sparse replaces the element 3 of only 3",
        ),
    ];
    for (change, expected) in change {
        let mut file = File::triangle();
        change(&mut file);
        assert_eq!(file.error(), expected);
    }
    let mut file = File::triangle();
    nested(&mut file);
    assert_eq!(file.error(), "nodes[2].children names node 1, which is its own ancestor: the nodes form a cycle");
    let mut file = File::triangle();
    file.bytes[3] = 0x7F;
    file.bytes[2] = 0x80;
    assert_eq!(file.error(), "meshes[0].primitives[0] has a coordinate that is not finite: the file is damaged");
}

#[test]
fn buffers_that_cannot_be_read() {
    let with = |buffer: Value| {
        let mut json = File::triangle().json;
        json["buffers"] = json!([buffer]);
        json.to_string()
    };
    let read = |json: &str| {
        let mut files = Files(vec![("short.bin", vec![0; 20])]);
        gltf::read(json.as_bytes(), &mut files, &Limits::default()).unwrap_err().to_string()
    };
    let missing = "\"gone.bin\", which buffers[0] names, was not found: put it beside the model";
    assert_eq!(
        read(&with(json!({ "uri": "gone.bin", "byteLength": 36 }))),
        format!("{missing}; tried models/gone.bin, textures/gone.bin")
    );
    assert_eq!(
        read(&with(json!({ "uri": "short.bin", "byteLength": 36 }))),
        "buffers[0] is cut off: it declares 36 bytes, but there are only 20"
    );
    assert_eq!(
        read(&with(json!({ "uri": "data:x;base64,AAA=!", "byteLength": 36 }))),
        "invalid data in buffers[0].uri: its character 4 is not base64"
    );
    assert_eq!(
        read(&with(json!({ "uri": "https://example.org/a.bin", "byteLength": 36 }))),
        "buffers[0].uri = \"https://example.org/a.bin\" is not fetched: put the file beside the model and its name into the uri"
    );
    assert_eq!(
        read(&with(json!({ "byteLength": 36 }))),
        "buffers[0] has no uri, and there is no binary chunk for it: the file is damaged"
    );
    let longer = with(json!({ "byteLength": 40 }));
    assert_eq!(error(&glb(&longer, &[0; 36])), "buffers[0] is cut off: it declares 40 bytes, but there are only 36");
}

#[test]
fn geometry_only_in_draco_compression() {
    let mut file = File::triangle();
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let draco = json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } });
    file.json["meshes"][0]["primitives"][0]["extensions"] = draco;
    let holds = "holds its geometry in Draco compression, which is not supported: export it without";
    assert_eq!(file.error(), format!("meshes[0].primitives[0] {holds}"));
}

/// Small, so that changes that enlarge a model are refused early.
const SMALL: Limits = Limits { max_vertices: 10_000, max_triangles: 10_000, max_bytes: 1 << 20 };

fn read(bytes: &[u8], limits: &Limits) -> Result<Model, ReadError> {
    let model = gltf::read(bytes, &mut NoSidecars, limits)?;
    let mesh = &model.mesh;
    let count = mesh.positions.len();
    assert!(mesh.indices.iter().all(|i| (*i as usize) < count));
    for length in [mesh.normals.len(), mesh.tex_coords.len(), mesh.tangents.len(), mesh.colors.len()] {
        assert!(length == 0 || length == count);
    }
    let mut triangles = 0;
    for part in &mesh.parts {
        assert_eq!(part.first_triangle, triangles);
        assert!(part.material < model.materials.len());
        triangles += part.triangle_count;
    }
    assert_eq!(triangles, mesh.triangle_count());
    assert!(mesh.positions.iter().flatten().all(|c| c.is_finite()));
    Ok(model)
}

fn message(file: &File, limits: &Limits) -> String {
    read(&file.glb(), limits).unwrap_err().message
}

#[test]
fn every_prefix_is_refused() {
    for bytes in [rich().glb(), rich().gltf()] {
        assert!(read(&bytes, &SMALL).is_ok());
        for length in 0..bytes.len() {
            assert!(read(&bytes[..length], &SMALL).is_err(), "{length}");
        }
    }
}

#[test]
fn every_changed_byte_is_survived() {
    let good = rich().glb();
    let mut read_all_the_same = 0;
    for at in 0..good.len() {
        // The least and the largest bit, a digit, a sign, a bracket.
        for change in [good[at] ^ 1, good[at] ^ 0x80, b'9', b'-', b'['] {
            let mut changed = good.clone();
            changed[at] = change;
            read_all_the_same += usize::from(read(&changed, &SMALL).is_ok());
        }
    }
    // Most of the file is numbers and names, which may change.
    assert!(read_all_the_same > good.len());
}

/// A chain of nodes longer than any stack would bear.
#[test]
fn deep_hierarchies() {
    let mut file = File::triangle();
    let depth = 200_000;
    file.json["nodes"] =
        (0..depth).map(|i| if i + 1 < depth { json!({ "children": [i + 1] }) } else { json!({ "mesh": 0 }) }).collect();
    assert_eq!(read(&file.glb(), &SMALL).unwrap().mesh.triangle_count(), 1);
    file.json["nodes"][depth - 1]["children"] = json!([0]);
    let circle =
        format!("nodes[{}].children names node 0, which is its own ancestor: the nodes form a cycle", depth - 1);
    assert_eq!(message(&file, &SMALL), circle);
}

#[test]
fn deep_json() {
    let nested = "[".repeat(1_000_000);
    let error = read(nested.as_bytes(), &SMALL).unwrap_err();
    assert_eq!(error.message, "this is not valid JSON: recursion limit exceeded");
}

#[test]
fn limits_hold() {
    let file = rich();
    // List 4, strip 4, fan 3 triangles, on 6, 6 and 5 vertices, twice.
    let read_with = |limits: Limits| read(&file.glb(), &limits);
    let enough = Limits { max_vertices: 34, max_triangles: 22, max_bytes: 1 << 20 };
    let mesh = read_with(enough).unwrap().mesh;
    assert_eq!((mesh.positions.len(), mesh.triangle_count()), (34, 22));
    let few = read_with(Limits { max_vertices: 33, ..enough }).unwrap_err().message;
    assert_eq!(few, "needs more than 33 vertices, which is the limit");
    let few = read_with(Limits { max_triangles: 21, ..enough }).unwrap_err().message;
    assert_eq!(few, "contains more than 21 triangles, which is the limit");
}

/// Numbers that only claim: nothing is allocated for them.
#[test]
fn claims_without_bytes() {
    let mut file = File::triangle();
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    for count in [1_000_000_u64, 1 << 40, u64::MAX] {
        file.json["accessors"][0]["count"] = json!(count);
        let message = message(&file, &Limits { max_vertices: u64::MAX, max_triangles: u64::MAX, ..SMALL });
        assert_eq!(message, "meshes[0].primitives[0] makes the model larger than 1048576 bytes, which is the limit");
    }
    // Indices without bytes.
    let mut file = File::triangle();
    let accessor = json!({ "componentType": U8, "type": "SCALAR", "count": 1_u64 << 40 });
    let indices = file.push("accessors", accessor);
    file.json["meshes"][0]["primitives"][0]["indices"] = indices.into();
    let message = message(&file, &Limits { max_triangles: u64::MAX, ..SMALL });
    assert_eq!(message, "accessors[1] makes the model larger than 1048576 bytes, which is the limit");
}

/// A small mesh in very many places; and one of which nothing is left, in as many.
#[test]
fn many_copies() {
    let copies = 100_000;
    let mut file = File::empty();
    let positions = file.floats(&[0.0; 3000], "VEC3");
    file.push("meshes", json!({ "primitives": [{ "attributes": { "POSITION": positions } }] }));
    file.json["nodes"] = (0..copies).map(|_| json!({ "mesh": 0 })).collect();
    file.json["scenes"][0]["nodes"] = (0..copies).collect();
    let limits = Limits { max_bytes: 1 << 20, ..Limits::default() };
    assert_eq!(
        message(&file, &limits),
        "meshes[0].primitives[0] makes the model larger than 1048576 bytes, which is the limit"
    );
    let indices = file.accessor(&[255; 3000], U8, "SCALAR", 3000);
    file.json["accessors"][positions]["count"] = json!(3);
    file.json["meshes"][0]["primitives"][0]["indices"] = indices.into();
    assert_eq!(
        message(&file, &limits),
        "accessors[1] is instanced so often that more than 4 times 1048576 bytes would be read, which is the limit"
    );
    file.json["meshes"][0]["primitives"][0]["attributes"] = json!({});
    assert_eq!(
        message(&file, &limits),
        "meshes[0].primitives[0] is instanced so often that more than 4 times 1048576 bytes would be read, which is the limit"
    );
}

#[test]
fn very_many_materials() {
    let mut file = File::triangle();
    file.json["materials"] = (0..100_000).map(|_| json!({})).collect();
    let materials = "its 100000 materials take more than 1048576 bytes, which is the limit";
    assert_eq!(message(&file, &SMALL), materials);
}
