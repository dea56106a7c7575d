//! Broken and hostile files: an error or a sound model, in bounded time and memory.

use crate::builder::{File, U8, rich};
use gonio_mesh::{Limits, Model, NoSidecars, ReadError, gltf};
use serde_json::json;

/// So that what a change blows up is refused early.
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
