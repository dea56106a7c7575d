//! Objects and their materials.

use crate::bench::Bench;
use gonio_app::session::{Selection, Tab};
use gonio_scene::scene_file::{Normals, Shading};

#[test]
fn shading_and_place_are_edited() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Objects);
    bench.click("object-0");
    bench.click("object-0-shading-gouraud");
    assert_eq!(bench.document().scene.objects[0].shading, Shading::Gouraud);
    bench.type_into("object-0-translate-x", "1.5");
    assert_eq!(bench.document().scene.objects[0].translate, [1.5, 0.0, 0.0]);
    bench.double_click("object-0-translate-x");
    assert_eq!(bench.document().scene.objects[0].translate, [0.0; 3]);
    // A model without extent cannot be lit.
    bench.type_into("object-0-scale-y", "0");
    assert_eq!(bench.document().scene.objects[0].scale, [1.0; 3]);
    assert_eq!(bench.app().file_edits, 0);
    bench.click("object-0-normals-flat");
    assert_eq!(bench.document().scene.objects[0].normals, Normals::Flat);
    // Other normals are made from the file.
    assert_eq!(bench.app().file_edits, 1);
}

#[test]
fn a_material_shows_the_file_until_it_is_changed_and_goes_back() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Objects);
    bench.click("object-0");
    let file = bench.app().session.loaded.as_ref().map(|l| f64::from(l.materials_in_file(0)[0].shininess));
    let shown: f64 = bench.widget("object-0-shininess").value.parse().unwrap_or(f64::NAN);
    // The number of a file of 32 bits, to six digits.
    assert!((shown - file.unwrap_or(f64::NAN)).abs() < 1e-4 * shown, "{shown} {file:?}");
    assert!(!bench.widget("object-0-shininess-reset").enabled);
    bench.type_into("object-0-shininess", "77");
    assert_eq!(bench.document().scene.objects[0].material.shininess, Some(77.0));
    let drawn = bench.app().session.loaded.as_ref().map(|l| l.materials[0].material.shininess);
    assert_eq!(drawn, Some(77.0));
    bench.click("object-0-shininess-reset");
    assert!(bench.document().scene.objects[0].material.is_empty());
    let drawn = bench.app().session.loaded.as_ref().map(|l| f64::from(l.materials[0].material.shininess));
    assert_eq!(drawn, file);
}

#[test]
fn a_body_of_glass() {
    let mut bench = Bench::new("builtin:glass-and-mirror", Tab::Objects);
    bench.click("object-0");
    bench.type_into("object-0-refraction-index", "1.2");
    assert_eq!(bench.document().scene.objects[0].material.refraction_index, Some(1.2));
    bench.double_click("object-0-reflectivity");
    assert_eq!(bench.document().scene.objects[0].material.reflectivity, None);
}

#[test]
fn a_sample_is_added_copied_and_taken_out() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Objects);
    bench.click("add-object");
    assert!(!bench.has("add-object-lab-07"), "a scene is no model");
    bench.click("add-object-cube");
    assert_eq!(bench.document().scene.objects.len(), 2);
    assert_eq!(bench.document().scene.objects[1].name, "cube");
    assert_eq!(bench.app().session.selection, Selection::Object(1));
    bench.click("object-1-duplicate");
    assert_eq!(bench.document().scene.objects.len(), 3);
    // A copy of what is there needs no file.
    assert_eq!(bench.app().file_edits, 1);
    bench.click("object-2-remove");
    bench.click("object-0");
    bench.click("object-0-remove");
    assert_eq!(bench.document().scene.objects.len(), 1);
}

#[test]
fn an_object_is_looked_at() {
    let mut bench = Bench::new("builtin:three-spheres", Tab::Objects);
    bench.click("object-2");
    bench.click("object-2-frame");
    let loaded = bench.app().session.loaded.clone().unwrap_or_else(|| panic!("no scene"));
    let middle = loaded.objects[2].world_from_model.w_axis.truncate();
    let target = bench.document().scene.camera.target().map(glam::DVec3::from).unwrap_or_default();
    // A sphere's middle is its place; a coarse one is not quite symmetric.
    assert!((target - middle).length() < 0.05, "{target} {middle}");
}
