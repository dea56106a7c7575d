//! Built-in spheres of any number of triangles, and scenes in other details.

use gonio_mesh::simplify;
use gonio_scene::Scene;
use gonio_scene::detail::{self, Detail};
use gonio_scene::files::BuiltinOnly;
use gonio_scene::load;
use gonio_scene::scene_file::{Normals, ObjectSpec, SceneFile};
use std::path::Path;
use std::sync::Arc;

fn opened(model: &str, normals: Normals) -> Result<Scene, String> {
    let object = ObjectSpec { model: model.into(), normals, ..ObjectSpec::default() };
    let scene = SceneFile { objects: vec![object], ..SceneFile::default() };
    load::load(scene, Path::new(""), &BuiltinOnly).map_err(|e| e.to_string())
}

#[test]
fn a_sphere_has_as_many_triangles_as_it_says() {
    for (model, triangles) in [("builtin:sphere-8", 8), ("builtin:sphere_72", 72), ("builtin:sphere-4232", 4232)] {
        let loaded = opened(model, Normals::File).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(loaded.meshes[0].triangle_count(), triangles);
        assert!(loaded.objects[0].closed);
        // The material of the other spheres.
        let same = opened("builtin:sphere-smooth", Normals::File).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(loaded.materials, same.materials);
        for (p, n) in loaded.meshes[0].positions.iter().zip(&loaded.meshes[0].normals) {
            assert!(p.iter().zip(n).all(|(p, n)| (p - n).abs() < 1e-6), "{p:?} has the normal {n:?}");
        }
    }
}

#[test]
fn numbers_that_cannot_be_are_refused_with_those_that_can() {
    let why = opened("builtin:sphere-100", Normals::File).err().unwrap_or_default();
    assert!(why.contains("72") && why.contains("128"), "{why}");
    let why = opened("builtin:sphere-08", Normals::File).err().unwrap_or_default();
    assert!(why.contains("sphere-N"), "{why}");
}

#[test]
fn a_scene_in_another_detail_is_the_same_scene() {
    let loaded = opened("builtin:sphere-smooth", Normals::Flat).unwrap_or_else(|e| panic!("{e}"));
    let spec = &loaded.settings.objects[0];
    let sphere = Detail::Sphere(100).mesh_for(&loaded.meshes[0], spec).unwrap_or_else(|| panic!("it is a sphere"));
    // The next to 100 is 128; flat, as the object wants it.
    assert_eq!((sphere.triangle_count(), sphere.positions.len()), (128, 3 * 128));
    let coarse = detail::with_meshes(&loaded, &[Arc::new(sphere)]);
    let object = &coarse.objects[0];
    assert_eq!(coarse.meshes[object.mesh].triangle_count(), 128);
    assert_eq!(object.parts.iter().map(|part| part.triangle_count).sum::<usize>(), 128);
    assert_eq!(object.parts[0].material, loaded.objects[0].parts[0].material);
    assert!(object.closed);
    assert_eq!(coarse.settings, loaded.settings);

    let monkey = opened("builtin:suzanne", Normals::File).unwrap_or_else(|e| panic!("{e}"));
    let spec = &monkey.settings.objects[0];
    assert!(Detail::Sphere(100).mesh_for(&monkey.meshes[0], spec).is_none(), "no sphere");
    assert!(Detail::Share(1.0).mesh_for(&monkey.meshes[0], spec).is_none(), "all of it");
    let wanted = monkey.meshes[0].triangle_count() / 4;
    let mesh = Detail::Share(0.25).mesh_for(&monkey.meshes[0], spec).unwrap_or_else(|| panic!("fewer"));
    assert!(mesh.triangle_count() <= wanted + 1);
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    assert_eq!(mesh, simplify::simplify(&monkey.meshes[0], mesh.triangle_count()));
}
