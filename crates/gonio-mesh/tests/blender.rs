//! Files that Blender wrote: expected sizes, and agreement with a second reader (tobj).

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_mesh::{
    AmbientRule, Limits, MissingSidecar, Model, NormalSource, Severity, Sidecar, Sidecars, obj, topology,
};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/models")
}

struct Folder;

impl Sidecars for Folder {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        let missing = |_| MissingSidecar { tried: vec![name.to_owned()], refused: None };
        let bytes = std::fs::read(folder().join(name)).map_err(missing)?;
        Ok(Sidecar { path: name.to_owned(), bytes })
    }
}

fn read(name: &str) -> Model {
    let bytes = std::fs::read(folder().join(name)).unwrap();
    obj::read(&bytes, &mut Folder, &Limits::default()).unwrap()
}

/// Triangles as counted in the files: 3 corners are one, 4 two, the heptagon five. Closed: known from how they were made
/// (the monkey has holes for its eyes).
const FILES: [(&str, usize, bool); 5] = [
    ("cube.obj", 12, true),
    ("sphere_coarse.obj", 224, true),
    ("sphere_coarse_averaged.obj", 224, true),
    ("sphere_smooth.obj", 3968, true),
    ("suzanne.obj", 15744, false),
];

#[test]
fn sizes_and_silence() {
    for (name, triangles, closed) in FILES {
        let model = read(name);
        let mesh = &model.mesh;
        assert_eq!(mesh.triangle_count(), triangles, "{name}");
        assert_eq!(mesh.normal_source, NormalSource::File, "{name}");
        assert_eq!(mesh.tex_coords.len(), mesh.positions.len(), "{name}");
        assert_eq!(mesh.smoothing_groups.len(), triangles, "{name}");
        assert_eq!(topology::is_closed_outward(mesh), closed, "{name}");
        let warnings: Vec<_> = model.diagnostics.iter().filter(|d| d.severity > Severity::Note).collect();
        assert!(warnings.is_empty(), "{name}: {warnings:?}");
    }
    // The cube's corners have three normals each; a smooth sphere's vertices split at the seam only.
    assert_eq!(read("cube.obj").mesh.positions.len(), 24);
    assert_eq!(read("sphere_smooth.obj").mesh.positions.len(), 2143);
}

#[test]
fn the_still_life_has_its_parts_and_materials() {
    let model = read("still_life.obj");
    let parts: Vec<(&str, &str, usize)> = model
        .mesh
        .parts
        .iter()
        .map(|part| (part.name.as_str(), model.materials[part.material].name.as_str(), part.triangle_count))
        .collect();
    let expected = [
        ("Floor_Floor", "Floor", 2),
        ("Crate_Wood", "Wood", 12),
        ("Donut_Dough", "Dough", 1344),
        ("Donut_Icing", "Icing", 960),
        ("Ball_Glass", "Glass", 2208),
        ("Heptacone_Emerald", "Emerald", 12),
        ("Ember_Ember", "Ember", 80),
    ];
    assert_eq!(parts, expected);
    assert!(model.diagnostics.is_empty(), "{:?}", model.diagnostics);
    let material = |name: &str| model.materials.iter().find(|m| m.name == name).unwrap();
    let floor = material("Floor");
    // Blender leaves Kd out beside map_Kd, and writes Ka 1 1 1 whatever the material is.
    assert_eq!((floor.diffuse, floor.ambient), ([1.0; 3], AmbientRule::FollowsDiffuse));
    assert_eq!(floor.diffuse_map.as_ref().unwrap().path, "textures/checker.png");
    let ember = material("Ember");
    assert_eq!((ember.diffuse, ember.emitted), ([0.9, 0.3, 0.1], [2.0, 0.7, 0.1]));
    assert_eq!((ember.shininess, ember.refraction_index, ember.opacity), (360.0, 1.45, 1.0));
    assert_eq!((ember.specular, ember.illumination_model), ([0.5; 3], Some(2)));
}

/// Corner by corner, bit by bit: positions and texture coordinates are numbers of the file in both readers. tobj keeps
/// the file's four-digit normals, ours are of unit length: the tolerance is half of their last digit, with a margin.
#[test]
fn a_second_reader_agrees() {
    let names = FILES.iter().map(|file| file.0).chain(["still_life.obj"]);
    for name in names {
        let ours = read(name).mesh;
        let options = tobj::LoadOptions { single_index: true, triangulate: true, ..Default::default() };
        let (theirs, _) = tobj::load_obj(folder().join(name), &options).unwrap();
        let mut corner = 0;
        for mesh in theirs.iter().map(|model| &model.mesh) {
            for &i in &mesh.indices {
                let (i, o) = (i as usize, ours.indices[corner] as usize);
                assert_eq!(ours.positions[o][..], mesh.positions[3 * i..3 * i + 3], "{name}, corner {corner}");
                assert_eq!(ours.tex_coords[o][..], mesh.texcoords[2 * i..2 * i + 2], "{name}, corner {corner}");
                for (a, b) in ours.normals[o].iter().zip(&mesh.normals[3 * i..3 * i + 3]) {
                    assert!((a - b).abs() < 1.5e-4, "{name}, corner {corner}: {a} and {b}");
                }
                corner += 1;
            }
        }
        assert_eq!(corner, ours.indices.len(), "{name}");
    }
}
