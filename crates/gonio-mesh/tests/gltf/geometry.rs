//! Geometry and nodes of glTF files.

use crate::builder::{CORNERS, F32, File, Files, I8, I16, U8, U16, U32, assert_message, near};
use gonio_mesh::{Limits, ModelLightKind, NormalSource, gltf};
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

#[test]
fn a_triangle_in_every_packaging() {
    let file = File::triangle();
    let from_glb = file.quiet();
    assert_eq!(from_glb.mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(from_glb.mesh.indices, [0, 1, 2]);
    assert_eq!(from_glb.mesh.normal_source, NormalSource::None);
    assert!(from_glb.mesh.normals.is_empty() && from_glb.mesh.tex_coords.is_empty() && from_glb.mesh.colors.is_empty());
    let inside = gltf::read(&file.gltf(), &mut Files(Vec::new()), &Limits::default()).unwrap();
    assert_eq!(inside.mesh, from_glb.mesh);
    assert!(inside.sidecars.is_empty());
    // A file of its own, whose name has a blank and an umlaut, used by two buffers and asked for once.
    let mut outside = file.json.clone();
    let length = file.bytes.len();
    let buffer = json!({ "uri": "the%20d%C3%A4ta.bin", "byteLength": length });
    outside["buffers"] = json!([buffer, buffer]);
    outside["bufferViews"].as_array_mut().unwrap().push(json!({ "buffer": 1, "byteLength": 36 }));
    let second = json!({ "bufferView": 1, "componentType": F32, "type": "VEC3", "count": 3 });
    outside["accessors"].as_array_mut().unwrap().push(second);
    let more = json!({ "attributes": { "POSITION": 1 } });
    outside["meshes"][0]["primitives"].as_array_mut().unwrap().push(more);
    let mut files = Files(vec![("the d\u{e4}ta.bin", file.bytes.clone())]);
    let model = gltf::read(outside.to_string().as_bytes(), &mut files, &Limits::default()).unwrap();
    assert_eq!(model.mesh.positions[..3], from_glb.mesh.positions);
    assert_eq!(model.mesh.positions[3..], from_glb.mesh.positions);
    assert_eq!(model.sidecars.len(), 1);
    assert_eq!(model.sidecars[0].found.as_deref(), Some("models/the d\u{e4}ta.bin"));
}

/// Written by hand: bytes of three f32 triples in base64.
#[test]
fn a_file_as_a_person_would_write_it() {
    let bytes = include_bytes!("files/triangle.gltf");
    let model = gltf::read(bytes, &mut Files(Vec::new()), &Limits::default()).unwrap();
    assert_eq!(model.mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(model.mesh.parts[0].name, "Corner");
    let count = |what: &str| model.contents.iter().find(|(name, _)| name == what).map(|(_, count)| *count);
    assert_eq!(count("nodes"), Some(1));
    assert_eq!(count("primitives"), Some(1));
    assert_eq!(count("bufferViews"), Some(1));
    assert_eq!(count("skins"), None);
}

/// Corners 0 to 4 of a zigzag; by the specification's formulas.
#[test]
fn lists_strips_and_fans() {
    let zigzag: Vec<f32> = (0..5).flat_map(|i| [i as f32, (i % 2) as f32, 0.0]).collect();
    let read = |mode: u32, indices: Option<&[u16]>| {
        let mut file = File::empty();
        let positions = file.floats(&zigzag, "VEC3");
        let mut primitive = json!({ "attributes": { "POSITION": positions }, "mode": mode });
        if let Some(indices) = indices {
            primitive["indices"] = file.indices(indices).into();
        }
        file.of_primitive(primitive);
        file
    };
    // p_i = {v_i, v_(i+1+i%2), v_(i+2-i%2)}
    assert_eq!(read(5, None).quiet().mesh.indices, [0, 1, 2, 1, 3, 2, 2, 3, 4]);
    // p_i = {v_(i+1), v_(i+2), v_0}
    assert_eq!(read(6, None).quiet().mesh.indices, [1, 2, 0, 2, 3, 0, 3, 4, 0]);
    // Joints of strips are left out: 0 1 2 | 2 2 | 3 ...
    assert_eq!(read(5, Some(&[0, 1, 2, 2, 3, 3, 4, 0])).quiet().mesh.indices, [0, 1, 2, 3, 0, 4]);
    assert_eq!(read(4, Some(&[0, 1, 2, 2, 1, 3])).quiet().mesh.indices, [0, 1, 2, 2, 1, 3]);
    let (model, messages) = read(4, None).read_with_messages();
    assert_eq!(model.mesh.indices, [0, 1, 2]);
    assert_message(
        &messages,
        "warning: meshes[0].primitives[0] has 2 extra corners that do not form a triangle: left out",
    );
    let (model, messages) = read(4, Some(&[0, 1, 2, 0, 5, 1, 2, 3, 4])).read_with_messages();
    assert_eq!(model.mesh.indices, [0, 1, 2, 2, 3, 4]);
    assert_message(
        &messages,
        "warning: meshes[0].primitives[0]: 1 triangles are left out: an index is 5, but there are only 5 vertices",
    );
}

#[test]
fn indices_of_every_width() {
    let codes: [(u32, &[u8]); 3] =
        [(U8, &[2, 0, 1]), (U16, &[2, 0, 0, 0, 1, 0]), (U32, &[2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0])];
    for (component, bytes) in codes {
        let mut file = File::empty();
        let positions = file.floats(&CORNERS, "VEC3");
        let indices = file.accessor(bytes, component, "SCALAR", 3);
        file.of_primitive(json!({ "attributes": { "POSITION": positions }, "indices": indices }));
        assert_eq!(file.quiet().mesh.indices, [2, 0, 1], "{component}");
    }
}

#[test]
fn points_and_lines_are_counted() {
    let mut file = File::triangle();
    for mode in [0, 1, 2, 3] {
        file.of_primitive(json!({ "attributes": { "POSITION": 0 }, "mode": mode }));
    }
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.triangle_count(), 1);
    let count = |what: &str| model.contents.iter().find(|(name, _)| name == what).map(|(_, count)| *count);
    assert_eq!(count("primitives of points in the scene"), Some(1));
    assert_eq!(count("primitives of lines in the scene"), Some(3));
    assert_message(&messages, "warning: meshes[1].primitives[0] consists of points, not triangles: not drawn");
    assert_message(&messages, "warning: meshes[3].primitives[0] consists of lines, not triangles: not drawn");
}

#[test]
fn attributes_arrive_where_they_belong() {
    let mut file = File::empty();
    let positions = file.floats(&CORNERS, "VEC3");
    let normals = file.floats(&[0.0, 0.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0], "VEC3");
    let tangents = file.floats(&[2.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 1.0, -1.0], "VEC4");
    let tex_coords = file.floats(&[0.25, 0.75, 0.0, 0.0, 2.0, -1.0], "VEC2");
    let colors = file.accessor(&[255, 0, 51, 0, 255, 0, 0, 0, 102], U8, "VEC3", 3);
    file.set(&format!("/accessors/{colors}/normalized"), json!(true));
    file.of_primitive(json!({ "attributes": {
        "POSITION": positions, "NORMAL": normals, "TANGENT": tangents, "TEXCOORD_0": tex_coords, "COLOR_0": colors
    } }));
    let mesh = file.quiet().mesh;
    // Of unit length, or 0 where the file has none.
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.0, 0.0, 0.0]]);
    assert_eq!(mesh.normal_source, NormalSource::File);
    assert_eq!(mesh.tangents, [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0], [0.0, 0.0, 1.0, -1.0]]);
    assert_eq!(mesh.tex_coords, [[0.25, 0.25], [0.0, 1.0], [2.0, 2.0]]);
    assert_eq!(mesh.colors, [[1.0, 0.0, 0.2, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 0.4, 1.0]]);
    // Four components; not normalised floats above 1 stay.
    let colors = file.floats(&[0.5, 0.25, 4.0, 0.5, 0.0, 0.0, -1.0, 0.0, 1.0, 1.0, 1.0, 1.0], "VEC4");
    file.set("/meshes/0/primitives/0/attributes/COLOR_0", colors.into());
    let mesh = file.quiet().mesh;
    assert_eq!(mesh.colors, [[0.5, 0.25, 4.0, 0.5], [0.0, 0.0, 0.0, 0.0], [1.0; 4]]);
}

/// Interleaved, and beginning within a view.
#[test]
fn strides_and_offsets() {
    let mut file = File::empty();
    let mut bytes = vec![0xFF; 4];
    for corner in CORNERS.chunks(3) {
        corner.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        bytes.extend([0, 128, 255, 7]);
    }
    let view = file.view(&bytes);
    file.set(&format!("/bufferViews/{view}/byteStride"), json!(16));
    let accessor = |offset, component, kind| json!({ "bufferView": view, "byteOffset": offset, "componentType": component, "type": kind, "count": 3 });
    let positions = file.push("accessors", accessor(4, F32, "VEC3"));
    let mut color = accessor(16, U8, "VEC3");
    color["normalized"] = json!(true);
    let colors = file.push("accessors", color);
    file.of_primitive(json!({ "attributes": { "POSITION": positions, "COLOR_0": colors } }));
    let mesh = file.quiet().mesh;
    assert_eq!(mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(mesh.colors, [[0.0, 128.0 / 255.0, 1.0, 1.0]; 3]);
}

/// `KHR_mesh_quantization`; the values of section 3.6.2.2.
#[test]
fn quantized_attributes() {
    let read = |bytes: &[u8], component: u32, normalized: bool| {
        let mut file = File::empty();
        let positions = file.accessor(bytes, component, "VEC3", 3);
        file.set(&format!("/accessors/{positions}/normalized"), json!(normalized));
        file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
        file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        file.of_primitive(json!({ "attributes": { "POSITION": positions } }));
        file.quiet().mesh.positions.concat()
    };
    let bytes = [0_u8, 127, 128, 129, 255, 1, 0, 64, 2];
    assert_eq!(read(&bytes, U8, false), [0.0, 127.0, 128.0, 129.0, 255.0, 1.0, 0.0, 64.0, 2.0]);
    assert_eq!(read(&bytes, I8, false), [0.0, 127.0, -128.0, -127.0, -1.0, 1.0, 0.0, 64.0, 2.0]);
    near(&read(&bytes, U8, true)[..5], &[0.0, 127.0 / 255.0, 128.0 / 255.0, 129.0 / 255.0, 1.0]);
    near(&read(&bytes, I8, true)[..5], &[0.0, 1.0, -1.0, -1.0, -1.0 / 127.0]);
    let words: Vec<u8> = [0_u16, 32767, 32768, 32769, 65535, 1, 0, 0, 0].iter().flat_map(|w| w.to_le_bytes()).collect();
    assert_eq!(read(&words, U16, false)[..5], [0.0, 32767.0, 32768.0, 32769.0, 65535.0]);
    assert_eq!(read(&words, I16, false)[..5], [0.0, 32767.0, -32768.0, -32767.0, -1.0]);
    near(&read(&words, U16, true)[..5], &[0.0, 32767.0 / 65535.0, 32768.0 / 65535.0, 32769.0 / 65535.0, 1.0]);
    near(&read(&words, I16, true)[..5], &[0.0, 1.0, -1.0, -1.0, -1.0 / 32767.0]);
}

#[test]
fn sparse_accessors() {
    let sparse = |file: &mut File, index_bytes: &[u8], component: u32| {
        let indices = file.view(index_bytes);
        let values: Vec<u8> = [9.0_f32, 8.0, 7.0, 0.0, 5.0, 0.0].iter().flat_map(|n| n.to_le_bytes()).collect();
        let values = file.view(&values);
        json!({
            "count": 2,
            "indices": { "bufferView": indices, "componentType": component },
            "values": { "bufferView": values },
        })
    };
    let mut file = File::triangle();
    let replaced = sparse(&mut file, &[1, 2], U8);
    file.set("/accessors/0/sparse", replaced);
    assert_eq!(file.quiet().mesh.positions, [[0.0, 0.0, 0.0], [9.0, 8.0, 7.0], [0.0, 5.0, 0.0]]);
    // Without a view all others are 0; u16 and u32 indices.
    for (component, indices) in [(U16, &[0, 0, 2, 0][..]), (U32, &[0, 0, 0, 0, 2, 0, 0, 0][..])] {
        let mut file = File::triangle();
        let replaced = sparse(&mut file, indices, component);
        file.set("/accessors/0/sparse", replaced);
        file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
        assert_eq!(file.quiet().mesh.positions, [[9.0, 8.0, 7.0], [0.0, 0.0, 0.0], [0.0, 5.0, 0.0]]);
    }
    // Sparse indices: the last corner is another.
    let mut file = File::triangle();
    let indices = file.indices(&[0, 1, 1]);
    let (which, values) = (file.view(&[2]), file.view(&[2, 0]));
    file.json["accessors"][indices]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": which, "componentType": U8 }, "values": { "bufferView": values },
    });
    file.set("/meshes/0/primitives/0/indices", indices.into());
    assert_eq!(file.quiet().mesh.indices, [0, 1, 2]);
}

/// Exporters let many primitives share one large array: only what is used becomes vertices.
#[test]
fn vertices_that_no_triangle_uses_are_left_out() {
    let numbers: Vec<f32> = (0..30).map(|i| i as f32).collect();
    let mut file = File::empty();
    let positions = file.floats(&numbers, "VEC3");
    let tex_coords = file.floats(&numbers[..20], "VEC2");
    for corners in [[7, 4, 9], [1, 0, 2]] {
        let indices = file.indices(&corners);
        let attributes = json!({ "POSITION": positions, "TEXCOORD_0": tex_coords });
        file.of_primitive(json!({ "attributes": attributes, "indices": indices }));
    }
    let mesh = file.quiet().mesh;
    let x: Vec<f32> = mesh.positions.iter().map(|p| p[0]).collect();
    assert_eq!(x, [12.0, 21.0, 27.0, 0.0, 3.0, 6.0]);
    assert_eq!(mesh.indices, [1, 0, 2, 4, 3, 5]);
    assert_eq!(mesh.tex_coords[..2], [[8.0, -8.0], [14.0, -14.0]]);
    assert_eq!(mesh.parts.len(), 2);
    assert_eq!((mesh.parts[1].first_triangle, mesh.parts[1].triangle_count), (1, 1));
}

/// Only some primitives have an attribute.
#[test]
fn attributes_of_some_primitives_only() {
    let mut file = File::triangle();
    let normals = file.floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0], "VEC3");
    let tangents = file.floats(&[1.0, 0.0, 0.0, 1.0].repeat(3), "VEC4");
    let tex_coords = file.floats(&[0.5; 6], "VEC2");
    let colors = file.floats(&[0.5; 9], "VEC3");
    file.of_primitive(json!({ "attributes": {
        "POSITION": 0, "NORMAL": normals, "TANGENT": tangents, "TEXCOORD_0": tex_coords, "COLOR_0": colors
    } }));
    file.of_primitive(json!({ "attributes": { "POSITION": 0 } }));
    let (model, messages) = file.read_with_messages();
    let mesh = model.mesh;
    assert_eq!(mesh.normals.len(), 9);
    assert_eq!((mesh.normals[0], mesh.normals[3], mesh.normals[8]), ([0.0; 3], [0.0, 0.0, 1.0], [0.0; 3]));
    assert_eq!((mesh.tex_coords[0], mesh.tex_coords[3], mesh.tex_coords[8]), ([0.0; 2], [0.5; 2], [0.0; 2]));
    assert_eq!((mesh.colors[0], mesh.colors[3], mesh.colors[8]), ([1.0; 4], [0.5, 0.5, 0.5, 1.0], [1.0; 4]));
    assert!(mesh.tangents.is_empty());
    assert_message(&messages, "note: only some primitives have tangents (TANGENT): those of the file are not used");
    assert_message(
        &messages,
        "note: meshes[0].primitives[0] has no normals: glTF specifies flat shading there; they are averaged for \
         smooth shading",
    );
    // Tangents without normals mean nothing.
    let mut file = File::triangle();
    let tangents = file.floats(&[1.0, 0.0, 0.0, 1.0].repeat(3), "VEC4");
    file.set("/meshes/0/primitives/0/attributes/TANGENT", tangents.into());
    assert!(file.quiet().mesh.tangents.is_empty());
}

/// A quarter turn about z, as a quaternion.
fn quarter_turn() -> Value {
    json!([0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()])
}

/// Scale (2, 1, 1), then x to y, then (1, 2, 3) on top: (1, 0, 0) becomes (2, 0, 0), (0, 2, 0), (1, 4, 3).
#[test]
fn scale_then_rotation_then_translation() {
    let expected = [1.0, 2.0, 3.0, 1.0, 4.0, 3.0, 0.0, 2.0, 3.0];
    let mut file = File::triangle();
    file.set("/nodes/0/translation", json!([1, 2, 3]));
    file.set("/nodes/0/rotation", quarter_turn());
    file.set("/nodes/0/scale", json!([2, 1, 1]));
    near(&file.quiet().mesh.positions.concat(), &expected);
    // The same as a matrix, column by column.
    let matrix = json!([0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]);
    let file = File::triangle().with("/nodes/0/matrix", matrix);
    near(&file.quiet().mesh.positions.concat(), &expected);
    // The same as a chain of three nodes.
    let mut file = File::triangle();
    file.set("/nodes/0/scale", json!([2, 1, 1]));
    file.push("nodes", json!({ "rotation": quarter_turn(), "children": [0] }));
    file.push("nodes", json!({ "translation": [1, 2, 3], "children": [1] }));
    file.json["scenes"][0]["nodes"] = json!([2]);
    near(&file.quiet().mesh.positions.concat(), &expected);
}

/// Normals by the inverse transpose: (1, 1, 0) under scale (2, 1, 1) is (1/2, 1, 0), of unit length (1, 2, 0) / sqrt 5.
#[test]
fn normals_and_tangents_turn_as_they_must() {
    let half = 0.5_f32.sqrt();
    let mut file = File::triangle();
    let normals = file.floats(&[half, half, 0.0].repeat(3), "VEC3");
    let tangents = file.floats(&[half, -half, 0.0, 1.0].repeat(3), "VEC4");
    file.set("/meshes/0/primitives/0/attributes/NORMAL", normals.into());
    file.set("/meshes/0/primitives/0/attributes/TANGENT", tangents.into());
    let scaled = file.clone().with("/nodes/0/scale", json!([2, 1, 1])).quiet().mesh;
    let fifth = 0.2_f32.sqrt();
    near(&scaled.normals[0], &[fifth, 2.0 * fifth, 0.0]);
    near(&scaled.tangents[0], &[2.0 * fifth, -fifth, 0.0, 1.0]);
    assert_eq!(scaled.indices, [0, 1, 2]);
    // A mirror in x: the fronts stay in front, the bitangent changes its sign.
    let mirrored = file.clone().with("/nodes/0/scale", json!([-1, 1, 1])).quiet().mesh;
    assert_eq!(mirrored.indices, [0, 2, 1]);
    near(&mirrored.normals[0], &[-half, half, 0.0]);
    near(&mirrored.tangents[0], &[-half, -half, 0.0, -1.0]);
    // Two mirrors are none.
    let twice = file.clone().with("/nodes/0/scale", json!([-1, -1, 1])).quiet().mesh;
    assert_eq!(twice.indices, [0, 1, 2]);
    near(&twice.tangents[0], &[-half, half, 0.0, 1.0]);
    // Flattened along x: all normals point along x.
    let (flat, messages) = file.with("/nodes/0/scale", json!([0, 1, 1])).read_with_messages();
    near(&flat.mesh.normals[0], &[1.0, 0.0, 0.0]);
    assert_message(&messages, "warning: nodes[0] flattens its mesh: a scale is 0");
}

#[test]
fn each_node_has_its_own_copy_of_a_mesh() {
    let mut file = File::triangle();
    file.set("/meshes/0/name", json!("Tile"));
    file.root_node(json!({ "mesh": 0, "name": "Second", "translation": [0, 0, 5] }));
    let model = file.quiet();
    assert_eq!(model.mesh.positions.len(), 6);
    assert_eq!((model.mesh.positions[1], model.mesh.positions[4]), ([1.0, 0.0, 0.0], [1.0, 0.0, 5.0]));
    assert_eq!(model.mesh.indices, [0, 1, 2, 3, 4, 5]);
    let names: Vec<&str> = model.mesh.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["Tile", "Second"]);
}

#[test]
fn which_scene_is_shown() {
    let mut file = File::triangle();
    file.push("nodes", json!({ "mesh": 0, "translation": [7, 0, 0], "name": "Other" }));
    file.push("scenes", json!({ "nodes": [1], "name": "Attic" }));
    let names = |file: &File| -> Vec<f32> { file.quiet().mesh.positions.iter().map(|p| p[0]).collect() };
    assert_eq!(names(&file), [0.0, 1.0, 0.0]);
    file.json["scene"] = json!(1);
    assert_eq!(names(&file), [7.0, 8.0, 7.0]);
    let (_, messages) = file.read_with_messages();
    assert_message(&messages, "note: contains 2 scenes: scenes[1] (\"Attic\") is shown");
    assert_message(&messages, "note: 1 of 2 nodes are not in the scene: left out");
    // No default: the first. No scenes: all roots, in order, not their children.
    file.json.as_object_mut().unwrap().remove("scene");
    assert_eq!(names(&file), [0.0, 1.0, 0.0]);
    file.json.as_object_mut().unwrap().remove("scenes");
    file.push("nodes", json!({ "children": [0] }));
    assert_eq!(names(&file), [7.0, 8.0, 7.0, 0.0, 1.0, 0.0]);
    // No nodes at all: the meshes as they are.
    file.json.as_object_mut().unwrap().remove("nodes");
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.triangle_count(), 1);
    assert_message(&messages, "warning: has meshes but no nodes: each mesh is shown untransformed");
}

#[test]
fn lights_stand_at_their_nodes() {
    let mut file = File::triangle();
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "directional", "name": "Sun", "intensity": 3, "color": [1, 0.5, 0] },
        { "type": "point", "range": 10 },
        { "type": "spot", "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
        { "type": "spot" },
    ] } });
    let light = |light: u32| json!({ "KHR_lights_punctual": { "light": light } });
    // A quarter turn about x takes -z to +y.
    let half = 0.5_f64.sqrt();
    file.root_node(json!({ "extensions": light(0), "rotation": [half, 0, 0, half] }));
    file.root_node(json!({ "extensions": light(1), "translation": [1, 2, 3], "name": "Bulb" }));
    file.root_node(json!({ "extensions": light(2), "scale": [2, 2, 2] }));
    file.root_node(json!({ "extensions": light(3) }));
    let model = file.quiet();
    let [sun, bulb, spot, wide] = &model.lights[..] else { panic!("{:?}", model.lights) };
    assert_eq!((sun.name.as_str(), sun.kind, sun.intensity), ("Sun", ModelLightKind::Directional, 3.0));
    assert_eq!(sun.color, [1.0, 0.5, 0.0]);
    near(&sun.direction.map(|c| c as f32), &[0.0, 1.0, 0.0]);
    assert_eq!((bulb.name.as_str(), bulb.kind, bulb.position), ("Bulb", ModelLightKind::Point, [1.0, 2.0, 3.0]));
    assert_eq!((bulb.color, bulb.intensity, bulb.attenuation), ([1.0; 3], 1.0, [0.0, 0.0, 1.0]));
    assert_eq!(spot.kind, ModelLightKind::Spot { inner_angle_rad: 0.25, outer_angle_rad: 0.5 });
    assert_eq!(spot.direction, [0.0, 0.0, -1.0]);
    assert_eq!(wide.kind, ModelLightKind::Spot { inner_angle_rad: 0.0, outer_angle_rad: FRAC_PI_4 as f32 });
    let (_, messages) = file.read_with_messages();
    let range = "extensions.KHR_lights_punctual.lights[1] has a range of 10, which is ignored: it falls off with the square of the distance";
    assert_message(&messages, &format!("note: {range}"));
    file.set("/extensions/KHR_lights_punctual/lights/0/type", json!("area"));
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.lights.len(), 3);
    assert_message(
        &messages,
        "warning: extensions.KHR_lights_punctual.lights[0] (\"Sun\") has the unknown type \"area\": the light is left out",
    );
}

#[test]
fn cameras_stand_at_their_nodes() {
    let mut file = File::triangle();
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 }, "name": "Eye" }));
    let parallel = json!({ "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "znear": 0, "zfar": 9 } });
    file.push("cameras", parallel);
    let half = 0.5_f64.sqrt();
    // A quarter turn about y takes -z to -x.
    file.root_node(json!({ "camera": 0, "translation": [5, 0, 1], "rotation": [0, half, 0, half] }));
    file.root_node(json!({ "camera": 1 }));
    let (model, messages) = file.read_with_messages();
    let [eye, drawing] = &model.cameras[..] else { panic!("{:?}", model.cameras) };
    assert_eq!((eye.name.as_str(), eye.fov_y_rad, eye.clip), ("Eye", Some(0.5), [Some(0.1), None]));
    assert_eq!(eye.position, [5.0, 0.0, 1.0]);
    near(&eye.direction.map(|c| c as f32), &[-1.0, 0.0, 0.0]);
    near(&eye.up.map(|c| c as f32), &[0.0, 1.0, 0.0]);
    assert_eq!((drawing.fov_y_rad, drawing.clip), (None, [Some(0.0), Some(9.0)]));
    assert_message(&messages, "note: cameras[1] is an orthographic camera: its height (ymag) is ignored");
    file.set("/cameras/0/perspective/yfov", json!(2.0 * FRAC_PI_2));
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.cameras.len(), 1);
    let sentence =
        "cameras[0].perspective.yfov = 3.141592653589793, which is not a valid field of view: the camera is left out";
    assert_message(&messages, &format!("warning: {sentence}"));
}

/// The node of a skinned mesh does not move it; its joints do.
#[test]
fn skins_stand_as_they_were_bound() {
    let mut file = File::triangle();
    let mut matrix = [0.0_f32; 16];
    (matrix[0], matrix[5], matrix[10], matrix[15]) = (1.0, 1.0, 1.0, 1.0);
    matrix[12] = -2.0;
    let matrices = file.floats(&matrix, "MAT4");
    file.push("skins", json!({ "joints": [1], "inverseBindMatrices": matrices }));
    // To (x - 2, y, z), then a quarter turn, then on to the joint: (1, 0, 0), (-1, 0, 0), (0, -1, 0), (2, -1, 9).
    file.root_node(json!({ "translation": [2, 0, 9], "rotation": quarter_turn() }));
    file.set("/nodes/0/skin", json!(0));
    file.set("/nodes/0/translation", json!([100, 100, 100]));
    let (model, messages) = file.read_with_messages();
    near(&model.mesh.positions.concat(), &[2.0, -2.0, 9.0, 2.0, -1.0, 9.0, 1.0, -2.0, 9.0]);
    assert_message(&messages, "warning: contains 1 skin: the model is shown at rest, in its bind pose");
    file.json["animations"] = json!([{ "channels": [], "samplers": [] }, {}]);
    file.set("/meshes/0/primitives/0/targets", json!([{ "POSITION": 0 }]));
    let (_, messages) = file.read_with_messages();
    assert_message(&messages, "warning: contains 2 animations: the model is shown at rest, in its bind pose");
    assert_message(&messages, "warning: meshes[0] has morph targets: its base shape is shown");
}

#[test]
fn odd_transforms_are_reported() {
    let (model, messages) =
        File::triangle().with("/nodes/0/rotation", json!([0, 0, 2_f64.sqrt(), 2_f64.sqrt()])).read_with_messages();
    near(&model.mesh.positions[1], &[0.0, 1.0, 0.0]);
    assert_message(&messages, "warning: nodes[0].rotation is a quaternion of length 2.0000 instead of 1");
    let identity = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    let file = File::triangle().with("/nodes/0/matrix", identity).with("/nodes/0/scale", json!([3, 3, 3]));
    let (model, messages) = file.read_with_messages();
    assert_eq!(model.mesh.positions[1], [1.0, 0.0, 0.0]);
    assert_message(&messages, "warning: nodes[0] has both a matrix and other transforms: using the matrix");
    let perspective = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]);
    let (model, messages) = File::triangle().with("/nodes/0/matrix", perspective).read_with_messages();
    assert_eq!(model.mesh.positions[1], [1.0, 0.0, 0.0]);
    assert_message(&messages, "warning: nodes[0].matrix has a last row other than 0 0 0 1: it is ignored");
}
