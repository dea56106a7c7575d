//! Scenes, nodes, skins, lights, cameras.

use crate::builder::{File, near, says};
use gonio_mesh::ModelLightKind;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

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
    let (flat, said) = file.with("/nodes/0/scale", json!([0, 1, 1])).said();
    near(&flat.mesh.normals[0], &[1.0, 0.0, 0.0]);
    says(&said, "warning: nodes[0] flattens its mesh: a scale is 0");
}

#[test]
fn a_mesh_stands_once_for_each_node() {
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
    let (_, said) = file.said();
    says(&said, "note: contains 2 scenes: scenes[1] (\"Attic\") is shown");
    says(&said, "note: 1 of 2 nodes are not in the scene: left out");
    // No default: the first. No scenes: all roots, in order, not their children.
    file.json.as_object_mut().unwrap().remove("scene");
    assert_eq!(names(&file), [0.0, 1.0, 0.0]);
    file.json.as_object_mut().unwrap().remove("scenes");
    file.push("nodes", json!({ "children": [0] }));
    assert_eq!(names(&file), [7.0, 8.0, 7.0, 0.0, 1.0, 0.0]);
    // No nodes at all: the meshes as they are.
    file.json.as_object_mut().unwrap().remove("nodes");
    let (model, said) = file.said();
    assert_eq!(model.mesh.triangle_count(), 1);
    says(&said, "warning: has meshes but no nodes: each mesh is shown untransformed");
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
    let (_, said) = file.said();
    let range = "extensions.KHR_lights_punctual.lights[1] has a range of 10, which is ignored: it falls off with the square of the distance";
    says(&said, &format!("note: {range}"));
    file.set("/extensions/KHR_lights_punctual/lights/0/type", json!("area"));
    let (model, said) = file.said();
    assert_eq!(model.lights.len(), 3);
    says(
        &said,
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
    let (model, said) = file.said();
    let [eye, drawing] = &model.cameras[..] else { panic!("{:?}", model.cameras) };
    assert_eq!((eye.name.as_str(), eye.fov_y_rad, eye.clip), ("Eye", Some(0.5), [Some(0.1), None]));
    assert_eq!(eye.position, [5.0, 0.0, 1.0]);
    near(&eye.direction.map(|c| c as f32), &[-1.0, 0.0, 0.0]);
    near(&eye.up.map(|c| c as f32), &[0.0, 1.0, 0.0]);
    assert_eq!((drawing.fov_y_rad, drawing.clip), (None, [Some(0.0), Some(9.0)]));
    says(&said, "note: cameras[1] is an orthographic camera: its height (ymag) is ignored");
    file.set("/cameras/0/perspective/yfov", json!(2.0 * FRAC_PI_2));
    let (model, said) = file.said();
    assert_eq!(model.cameras.len(), 1);
    let sentence =
        "cameras[0].perspective.yfov = 3.141592653589793, which is not a valid field of view: the camera is left out";
    says(&said, &format!("warning: {sentence}"));
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
    let (model, said) = file.said();
    near(&model.mesh.positions.concat(), &[2.0, -2.0, 9.0, 2.0, -1.0, 9.0, 1.0, -2.0, 9.0]);
    says(&said, "warning: contains 1 skin: the model is shown at rest, in its bind pose");
    file.json["animations"] = json!([{ "channels": [], "samplers": [] }, {}]);
    file.set("/meshes/0/primitives/0/targets", json!([{ "POSITION": 0 }]));
    let (_, said) = file.said();
    says(&said, "warning: contains 2 animations: the model is shown at rest, in its bind pose");
    says(&said, "warning: meshes[0] has morph targets: its base shape is shown");
}

#[test]
fn odd_transforms_are_told() {
    let (model, said) = File::triangle().with("/nodes/0/rotation", json!([0, 0, 2_f64.sqrt(), 2_f64.sqrt()])).said();
    near(&model.mesh.positions[1], &[0.0, 1.0, 0.0]);
    says(&said, "warning: nodes[0].rotation is a quaternion of length 2.0000 instead of 1");
    let identity = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    let file = File::triangle().with("/nodes/0/matrix", identity).with("/nodes/0/scale", json!([3, 3, 3]));
    let (model, said) = file.said();
    assert_eq!(model.mesh.positions[1], [1.0, 0.0, 0.0]);
    says(&said, "warning: nodes[0] has both a matrix and other transforms: using the matrix");
    let perspective = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]);
    let (model, said) = File::triangle().with("/nodes/0/matrix", perspective).said();
    assert_eq!(model.mesh.positions[1], [1.0, 0.0, 0.0]);
    says(&said, "warning: nodes[0].matrix has a last row other than 0 0 0 1: it is ignored");
}
