//! Geometry that is kept from one scene to the next gives the very pictures of a scene made afresh.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::*;
use glam::{DMat4, DVec3};
use gonio_mesh::Material;
use gonio_reference::{ReferenceGeometry, ReferenceScene};
use gonio_scene::Scene;
use gonio_scene::scene_file::Shading;
use std::sync::Arc;

fn lab() -> Lab {
    Lab::new()
        .object(sphere(6, 8), Shading::Phong, Material::default())
        .object(square(0.5, 1.5), Shading::Flat, Material { opacity: 0.5, ..Material::default() })
        .light(directional([-1.0, -0.5, -1.0], 0.7))
}

fn changed(scene: &Scene, change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = scene.clone();
    change(&mut scene);
    scene
}

#[test]
fn a_kept_geometry_draws_other_colours_and_lights() {
    let lab = lab();
    let geometry = Arc::new(ReferenceGeometry::new(&lab.scene));
    let before = ReferenceScene::with_geometry(&lab.scene, geometry.clone()).unwrap();
    let edited = changed(&lab.scene, |s| {
        s.materials[0].material.diffuse = [0.9, 0.1, 0.2];
        s.materials[1].material.opacity = 0.25;
        s.objects[0].shading = Shading::Gouraud;
    });
    let mut frame = lab.frame.clone();
    frame.lights.push(ambient(0.3));
    let kept = ReferenceScene::with_geometry(&edited, geometry).unwrap();
    let drawn = kept.render(&frame, None, &|_| ());
    assert!(drawn == ReferenceScene::new(&edited).render(&frame, None, &|_| ()), "not one bit differs");
    assert!(drawn.picture != before.render(&frame, None, &|_| ()).picture, "it shows");
    assert!(kept.probe(&frame, 16, 16) == ReferenceScene::new(&edited).probe(&frame, 16, 16));
}

#[test]
fn what_moves_triangles_wants_another_geometry() {
    let scene = lab().scene;
    let geometry = Arc::new(ReferenceGeometry::new(&scene));
    type Change = fn(&mut Scene);
    let changes: [(&str, Change); 8] = [
        ("moved", |s| s.objects[0].world_from_model = DMat4::from_translation(DVec3::X)),
        ("removed", |s| drop(s.objects.pop())),
        ("a copy", |s| s.objects.push(s.objects[0].clone())),
        ("another mesh", |s| s.meshes[0] = Arc::new(sphere(6, 8))),
        ("made opaque", |s| s.materials[1].material.opacity = 1.0),
        ("made closed", |s| s.objects[0].closed = true),
        ("another material's number", |s| s.objects[0].parts[0].material = 1),
        ("looked through", |s| {
            (s.materials[0].optics.transmission, s.materials[0].optics.surfaces) = (1.0, gonio_light::Surfaces::Two);
        }),
    ];
    assert!(geometry.fits(&scene.clone()), "a clone is the same scene");
    for (what, change) in changes {
        let other = changed(&scene, change);
        assert!(!geometry.fits(&other), "{what}");
        assert!(ReferenceScene::with_geometry(&other, geometry.clone()).is_none(), "{what}");
    }
}

/// A window builds it beside itself, and forgets the scene meanwhile.
#[test]
fn it_goes_to_another_thread_and_outlives_its_scene() {
    let lab = lab();
    let here = lab.draw();
    let (scene, frame) = (lab.scene, lab.frame);
    let reference = std::thread::spawn(move || ReferenceScene::new(&scene)).join().unwrap();
    assert!(reference.render(&frame, None, &|_| ()) == here);
    assert!(reference.geometry().fits(reference.scene()));
    // Meshes count by what they are, not by what is in them.
    assert!(!reference.geometry().fits(&self::lab().scene));
}
