//! Agreement with a second reader, corner by corner: the `gltf` crate.

use crate::builder::{File, near, rich};
use ::gltf::mesh::Mode;
use gonio_mesh::Model;
use serde_json::json;

type Matrix = [[f32; 4]; 4];

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    let element = |column: usize, row: usize| (0..4).map(|k| a[k][row] * b[column][k]).sum();
    [0, 1, 2, 3].map(|column| [0, 1, 2, 3].map(|row| element(column, row)))
}

/// A corner: position, normal's direction before it is of unit length, texture coordinate (v down), colour.
pub type Corner = ([f32; 3], Option<[f32; 3]>, Option<[f32; 2]>, Option<[f32; 4]>);

/// All corners of all triangles, in the scene's space.
pub fn corners(bytes: &[u8]) -> Vec<Corner> {
    let file = ::gltf::Gltf::from_slice(bytes).unwrap();
    let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let mut corners = Vec::new();
    for node in file.default_scene().unwrap().nodes() {
        visit(&node, &identity, file.blob.as_deref().unwrap_or_default(), &mut corners);
    }
    corners
}

fn visit(node: &::gltf::Node<'_>, parent: &Matrix, blob: &[u8], corners: &mut Vec<Corner>) {
    let matrix = times(parent, &node.transform().matrix());
    for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
        let reader = primitive.reader(|_| Some(blob));
        let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let tex_coords: Option<Vec<[f32; 2]>> = reader.read_tex_coords(0).map(|t| t.into_f32().collect());
        let colors: Option<Vec<[f32; 4]>> = reader.read_colors(0).map(|c| c.into_rgba_f32().collect());
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..positions.len() as u32).collect(),
        };
        let mut triangles: Vec<[u32; 3]> = match primitive.mode() {
            Mode::Triangles => indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
            Mode::TriangleStrip => {
                (2..indices.len()).map(|i| [indices[i - 2], indices[i - 1 + i % 2], indices[i - i % 2]]).collect()
            }
            Mode::TriangleFan => (2..indices.len()).map(|i| [indices[i - 1], indices[i], indices[0]]).collect(),
            _ => Vec::new(),
        };
        let [x, y, z] = [matrix[0], matrix[1], matrix[2]];
        let cross = |a: [f32; 4], b: [f32; 4]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let determinant: f32 = cross(x, y).iter().zip(z).map(|(a, b)| a * b).sum();
        if determinant < 0.0 {
            triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let point = |p: [f32; 3]| [0, 1, 2].map(|i| x[i] * p[0] + y[i] * p[1] + z[i] * p[2] + matrix[3][i]);
        corners.extend(triangles.iter().flatten().map(|&i| {
            let i = i as usize;
            // Normals are compared where they stand unturned only.
            let plain = primitive.get(&::gltf::Semantic::Normals).filter(|_| x[..3] == [1.0, 0.0, 0.0] && y[1] == 1.0);
            let normal = plain.and_then(|accessor| {
                let is_float = accessor.data_type() == ::gltf::accessor::DataType::F32;
                is_float.then(|| reader.read_normals().unwrap().nth(i).unwrap())
            });
            (point(positions[i]), normal, tex_coords.as_ref().map(|t| t[i]), colors.as_ref().map(|c| c[i]))
        }));
    }
    for child in node.children() {
        visit(&child, &matrix, blob, corners);
    }
}

/// Positions and colours to the rounding of an f32, as matrices are multiplied in another precision.
#[track_caller]
pub fn agree(model: &Model, theirs: &[Corner]) {
    let mesh = &model.mesh;
    assert_eq!(mesh.indices.len(), theirs.len());
    for (&index, (position, normal, tex_coord, color)) in mesh.indices.iter().zip(theirs) {
        let i = index as usize;
        let close = mesh.positions[i].iter().zip(position).all(|(a, b)| (a - b).abs() < 1e-5);
        assert!(close, "{:?} and {position:?}", mesh.positions[i]);
        if let Some(normal) = normal {
            near(&mesh.normals[i], normal);
        }
        if let Some([u, v]) = tex_coord {
            near(&mesh.tex_coords[i], &[*u, 1.0 - v]);
        }
        if let Some(color) = color {
            near(&mesh.colors[i], color);
        }
    }
}

#[test]
fn a_second_reader_agrees() {
    // It cannot read normals in 8 bits: those of the quantized extension are taken out.
    let mut file = rich();
    for primitive in file.json["meshes"][0]["primitives"].as_array_mut().unwrap() {
        primitive["attributes"].as_object_mut().unwrap().remove("NORMAL");
        primitive["attributes"].as_object_mut().unwrap().remove("TANGENT");
    }
    file.json["accessors"][0]["min"] = json!([0, 0, 0]);
    file.json["accessors"][0]["max"] = json!([3, 2, 1.5]);
    let model = file.quiet();
    let theirs = corners(&file.glb());
    assert_eq!(theirs.len(), 66);
    agree(&model, &theirs);
}

/// Random trees of nodes over random triangles.
#[test]
fn a_second_reader_agrees_on_random_files() {
    let mut state = 1_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 23) as f32 - 1.0
    };
    for _ in 0..50 {
        let mut file = File::empty();
        let corners_wanted = 30;
        let positions: Vec<f32> = (0..3 * corners_wanted).map(|_| random()).collect();
        let positions = file.floats(&positions, "VEC3");
        file.json["accessors"][positions]["min"] = json!([-1, -1, -1]);
        file.json["accessors"][positions]["max"] = json!([1, 1, 1]);
        let tex_coords: Vec<f32> = (0..2 * corners_wanted).map(|_| random()).collect();
        let tex_coords = file.floats(&tex_coords, "VEC2");
        let indices: Vec<u16> = (0..60).map(|_| ((random() + 1.0) * 14.99) as u16).collect();
        let indices = file.indices(&indices);
        let attributes = json!({ "POSITION": positions, "TEXCOORD_0": tex_coords });
        file.push("meshes", json!({ "primitives": [{ "attributes": attributes, "indices": indices }] }));
        for node in 0..6 {
            let turn = [random(), random(), random(), random()];
            let length = turn.iter().map(|c| c * c).sum::<f32>().sqrt();
            file.push(
                "nodes",
                json!({
                    "mesh": 0, "rotation": turn.map(|c| c / length), "scale": [random(), random(), random()],
                    "translation": [random(), random(), random()],
                    "children": if node % 3 == 0 { json!([node + 1, node + 2]) } else { json!([]) },
                }),
            );
            if node % 3 != 0 {
                file.json["nodes"][node].as_object_mut().unwrap().remove("children");
            }
        }
        file.json["scenes"][0]["nodes"] = json!([3, 0]);
        agree(&file.quiet(), &corners(&file.glb()));
    }
}
