//! The panels that edit the scene: camera, picture, objects and lights.

use crate::Bench;
use egui::vec2;
use egui_kittest::kittest::Queryable;
use gonio_app::session::{Selection, Tab};
use gonio_light::Quantity;
use gonio_light::color::ToneMap;
use gonio_scene::ViewSpec;
use gonio_scene::scene_file::{LightSourceKind, MotionKind, Normals, Shading};

#[test]
fn yaw_and_pitch_turn_the_camera_in_place() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Camera);
    let before = bench.document().scene.camera.to_camera();
    bench.type_into("camera-yaw", "-90");
    bench.type_into("camera-pitch", "0");
    let after = bench.document().scene.camera.to_camera();
    assert_eq!(after.position, before.position);
    // Sines of degrees in f64.
    assert!((after.front - glam::DVec3::NEG_Z).length() < 1e-9, "{}", after.front);
}

#[test]
fn a_camera_always_looks_somewhere() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Camera);
    let [x, y, z] = bench.document().scene.camera.position;
    for (axis, value) in [("x", x), ("y", y), ("z", z)] {
        bench.type_into(&format!("camera-target-{axis}"), &value.to_string());
    }
    let camera = &bench.document().scene.camera;
    assert_ne!(Some(camera.position), camera.target());
    bench.type_into("camera-up-y", "0");
    assert_eq!(bench.document().scene.camera.up, [0.0, 1.0, 0.0]);
    let far = bench.document().scene.camera.far;
    bench.type_into("camera-near", "1e6");
    let camera = &bench.document().scene.camera;
    assert!(camera.near < camera.far && camera.far == far);
}

/// The rows of V are Right, Up and -Front, shown with their numbers.
#[test]
fn the_view_matrix_is_shown_row_by_row() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Camera);
    let camera = bench.document().scene.camera.to_camera();
    let names = ["Right", "Up", "\u{2212}Front"];
    let rows = [camera.right, camera.up, -camera.front];
    for (name, row) in names.into_iter().zip(rows) {
        assert!(bench.harness.query_all_by_label(name).count() > 0, "{name}");
        for entry in row.to_array() {
            let text = format!("{entry:8.3}").replace("  -0.000", "   0.000");
            let shown = if entry == 0.0 { "   0    ".to_owned() } else { text };
            assert!(bench.harness.query_all_by_label(&shown).count() > 0, "{name}: `{shown}`");
        }
    }
    bench.type_into("camera-fov", "90");
    // 1 / tan(45 degrees)
    assert!(bench.harness.query_all_by_label("   1.000").count() > 0);
}

#[test]
fn a_quantity_of_one_light_is_chosen() {
    let mut bench = Bench::new("builtin:light-kinds", Tab::Picture);
    bench.click("view");
    bench.click("view-vector-light-l");
    let view = |bench: &Bench| bench.document().panes.current().and_then(|pane| pane.view);
    assert_eq!(view(&bench).map(|v| (v.quantity, v.light)), Some((Quantity::Light, None)));
    let name = {
        let light = &bench.document().scene.lights[1];
        if light.name.is_empty() { format!("{} 1", light.kind) } else { light.name.clone() }
    };
    bench.click("view-light");
    bench.click(&format!("view-light-{}", name.to_lowercase().replace(' ', "-")));
    assert_eq!(view(&bench).and_then(|v| v.light), Some(1));
    bench.click("view");
    bench.click("view-the-picture");
    assert_eq!(view(&bench), None);
}

#[test]
fn an_environment_is_selected_rotated_and_removed() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Picture);
    assert!(bench.document().scene.environment.is_none());
    bench.click("environment");
    bench.click("environment-sky");
    assert_eq!(bench.document().scene.environment.as_ref().map(|e| e.image.as_str()), Some("sky"));
    assert!(bench.has("term-environment"), "the equation has a term for it");
    bench.type_into("environment-yaw", "45");
    assert_eq!(bench.document().scene.environment.as_ref().map(|e| e.rotate), Some([45.0, 0.0, 0.0]));
    bench.click("environment-light");
    assert_eq!(bench.document().scene.environment.as_ref().map(|e| e.light), Some(true));
    bench.click("term-environment");
    assert_eq!(bench.document().scene.environment.as_ref().map(|e| e.light), Some(false));
    bench.click("environment");
    bench.click("environment-none");
    assert!(bench.document().scene.environment.is_none());
}

#[test]
fn exposure_and_tone_map() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Picture);
    bench.type_into("exposure", "-1.5 EV");
    assert_eq!(bench.document().scene.picture.exposure, -1.5);
    bench.click("tone-map-aces");
    assert_eq!(bench.document().scene.picture.tone_map, ToneMap::Aces);
    bench.double_click("tone-map-reinhard");
    assert_eq!(bench.document().scene.picture.tone_map, ToneMap::None);
    bench.double_click("exposure");
    assert_eq!(bench.document().scene.picture.exposure, 0.0);
}

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
    // A scale of 0 is refused.
    bench.type_into("object-0-scale-y", "0");
    assert_eq!(bench.document().scene.objects[0].scale, [1.0; 3]);
    assert_eq!(bench.app().file_edits, 0);
    bench.click("object-0-normals-flat");
    assert_eq!(bench.document().scene.objects[0].normals, Normals::Flat);
    // Other normals need the file.
    assert_eq!(bench.app().file_edits, 1);
}

#[test]
fn a_material_shows_the_files_values_until_changed_and_after_a_reset() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Objects);
    bench.click("object-0");
    let file = bench.app().session.loaded.as_ref().map(|l| f64::from(l.materials_in_file(0)[0].shininess));
    let shown: f64 = bench.widget("object-0-shininess").value.parse().unwrap_or(f64::NAN);
    // An f32 to six digits.
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
fn a_part_has_a_material_of_its_own() {
    let mut bench = Bench::new("builtin:still_life", Tab::Objects);
    bench.click("object-0");
    let parts = bench.app().session.loaded.as_ref().map_or(0, |loaded| loaded.objects[0].parts.len());
    assert!(parts > 4);
    bench.click("object-0-part-1");
    let wood = bench.widget("object-0-part-1");
    assert_eq!((wood.label.as_str(), wood.value.as_str()), ("Crate_Wood", "true"));
    let shininess = |bench: &mut Bench| -> Vec<f32> {
        let loaded = bench.app().session.loaded.clone();
        loaded
            .iter()
            .flat_map(|l| l.objects[0].parts.iter().map(|p| l.materials[p.material].material.shininess))
            .collect()
    };
    let before = shininess(&mut bench);
    let shown: f64 = bench.widget("object-0-shininess").value.parse().unwrap_or(f64::NAN);
    assert!((shown - f64::from(before[1])).abs() < 1e-3 * shown, "{shown} {before:?}");
    bench.type_into("object-0-shininess", "77");
    let mut expected = before.clone();
    expected[1] = 77.0;
    assert_eq!(shininess(&mut bench), expected);
    assert_eq!(bench.document().scene.objects[0].material.shininess, None);
    // All parts, apart from the one with a value of its own.
    bench.click("object-0-all-parts");
    bench.type_into("object-0-shininess", "5");
    assert_eq!(shininess(&mut bench), (0..parts).map(|i| if i == 1 { 77.0 } else { 5.0 }).collect::<Vec<f32>>());
    bench.click("object-0-part-1");
    bench.click("object-0-shininess-reset");
    assert!(bench.document().scene.objects[0].parts.is_empty());
    assert_eq!(shininess(&mut bench), vec![5.0; parts]);
    assert_eq!(bench.app().file_edits, 0);
}

#[test]
fn refraction_values_are_edited_and_reset() {
    let mut bench = Bench::new("builtin:glass-and-mirror", Tab::Objects);
    bench.click("object-0");
    bench.type_into("object-0-refraction-index", "1.2");
    assert_eq!(bench.document().scene.objects[0].material.refraction_index, Some(1.2));
    bench.double_click("object-0-reflectivity");
    assert_eq!(bench.document().scene.objects[0].material.reflectivity, None);
}

#[test]
fn a_mirror_without_an_environment_says_so_and_offers_one() {
    let mut bench = Bench::new("builtin:cube", Tab::Objects);
    bench.click("object-0");
    assert!(bench.document().scene.environment.is_none() && !bench.has("object-0-no-environment"));
    bench.type_into("object-0-reflectivity", "0.5");
    assert!(bench.has("object-0-no-environment"));
    bench.click("object-0-add-sky");
    assert_eq!(bench.document().scene.environment.as_ref().map(|e| e.image.as_str()), Some("sky"));
    assert!(!bench.has("object-0-no-environment"));
    bench.undo();
    assert!(bench.document().scene.environment.is_none());
}

#[test]
fn sample_models_are_added_duplicated_and_removed() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Objects);
    bench.click("add-object");
    assert!(!bench.has("add-object-lab-07"), "a scene is not a model");
    bench.click("add-object-cube");
    assert_eq!(bench.document().scene.objects.len(), 2);
    assert_eq!(bench.document().scene.objects[1].name, "cube");
    assert_eq!(bench.app().session.selection, Selection::Object(1));
    bench.click("object-1-duplicate");
    assert_eq!(bench.document().scene.objects.len(), 3);
    // A copy of an object needs no file.
    assert_eq!(bench.app().file_edits, 1);
    bench.click("object-2-remove");
    bench.click("object-0");
    bench.click("object-0-remove");
    assert_eq!(bench.document().scene.objects.len(), 1);
}

#[test]
fn framing_an_object_targets_its_centre() {
    let mut bench = Bench::new("builtin:three-spheres", Tab::Objects);
    bench.click("object-2");
    bench.click("object-2-frame");
    let loaded = bench.app().session.loaded.clone().unwrap_or_else(|| panic!("no scene"));
    let middle = loaded.objects[2].world_from_model.w_axis.truncate();
    let target = bench.document().scene.camera.target().map(glam::DVec3::from).unwrap_or_default();
    // A sphere's centre is its position; a coarse one is not quite symmetric.
    assert!((target - middle).length() < 0.05, "{target} {middle}");
}

const SCENE: &str = "builtin:light-kinds";

#[test]
fn a_light_that_is_switched_off_is_black_in_the_frame() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let index = bench.document().scene.lights.iter().position(|l| l.kind == LightSourceKind::Point).unwrap_or(0);
    bench.click(&format!("light-{index}-on"));
    assert!(!bench.document().scene.lights[index].enabled);
    let frame = bench.app().session.loaded.as_ref().map(|l| l.frame(0.0)).unwrap_or_else(|| panic!("no scene"));
    assert_eq!(frame.lights[index].color.to_array(), [0.0; 3]);
    bench.click(&format!("light-{index}-on"));
    assert!(bench.document().scene.lights[index].enabled);
}

#[test]
fn a_light_alone_and_all_again() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let on = |bench: &Bench| bench.document().scene.lights.iter().map(|l| l.enabled).collect::<Vec<_>>();
    let count = on(&bench).len();
    assert!(count > 2);
    bench.click("light-1-alone");
    assert_eq!(on(&bench), (0..count).map(|i| i == 1).collect::<Vec<_>>());
    bench.click("light-1-alone");
    assert_eq!(on(&bench), vec![true; count]);
}

#[test]
fn a_number_is_typed_dragged_and_reset() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let intensity = |bench: &Bench| bench.document().scene.lights[0].intensity;
    let first = intensity(&bench);
    bench.type_into("light-0-intensity", "2,5");
    assert_eq!(intensity(&bench), 2.5);
    bench.drag("light-0-intensity", vec2(20.0, 0.0));
    let dragged = intensity(&bench);
    assert!(dragged > 2.5, "{dragged}");
    bench.double_click("light-0-intensity");
    assert_eq!(intensity(&bench), 1.0);
    // Invalid text, and a number out of range.
    bench.type_into("light-0-intensity", "bright");
    assert_eq!(intensity(&bench), 1.0);
    bench.type_into("light-0-intensity", "-3");
    assert_eq!(intensity(&bench), 0.0);
    for expected in [1.0, dragged, 2.5, first] {
        bench.undo();
        assert_eq!(intensity(&bench), expected);
    }
}

#[test]
fn lights_of_every_kind_are_added_and_removed() {
    for kind in LightSourceKind::ALL {
        let mut bench = Bench::new("builtin:suzanne", Tab::Lights);
        let before = bench.document().scene.lights.len();
        bench.click(&format!("add-light-{kind}"));
        let lights = &bench.document().scene.lights;
        assert_eq!((lights.len(), lights[before].kind), (before + 1, *kind));
        assert_eq!(bench.app().session.selection, Selection::Light(before));
        // Showing its parameters changes nothing.
        let shown = bench.document().clone();
        bench.settle();
        assert_eq!(*bench.document(), shown);
        bench.click(&format!("light-{before}-duplicate"));
        assert_eq!(bench.document().scene.lights.len(), before + 2);
        bench.click(&format!("light-{}-remove", before + 1));
        assert_eq!(bench.document().scene.lights.len(), before + 1);
    }
}

#[test]
fn a_light_becomes_each_kind_from_each_kind() {
    for from in LightSourceKind::ALL {
        for to in LightSourceKind::ALL {
            let mut bench = Bench::new("builtin:suzanne", Tab::Lights);
            let index = bench.document().scene.lights.len();
            bench.click(&format!("add-light-{from}"));
            bench.click(&format!("light-{index}-kind"));
            bench.click(&format!("light-{index}-kind-{to}"));
            // The resulting scene is validated like a file; keys of another kind would be an error.
            assert_eq!(bench.document().scene.lights[index].kind, *to, "from {from}");
        }
    }
}

#[test]
fn debug_views_follow_their_light() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let quantity = gonio_light::Quantity::Attenuation;
    if let Some(pane) = bench.app().document.panes.current_mut() {
        pane.view = Some(ViewSpec { quantity, light: Some(1) });
    }
    let second = bench.document().scene.lights[1].clone();
    bench.click("light-1");
    bench.click("light-1-up");
    assert_eq!(bench.document().scene.lights[0], second);
    assert_eq!(bench.app().session.selection, Selection::Light(0));
    let light = |bench: &Bench| bench.document().panes.current().and_then(|pane| pane.view).and_then(|view| view.light);
    assert_eq!(light(&bench), Some(0));
    bench.click("light-0-remove");
    assert_eq!(light(&bench), None);
}

#[test]
fn a_light_that_moves_brings_time_along() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Lights);
    assert!(!bench.has("play"));
    for kind in MotionKind::ALL {
        let index = bench.document().scene.lights.len();
        bench.click("add-light-point");
        bench.click(&format!("light-{index}-motion"));
        bench.click(&format!("light-{index}-motion-{kind}"));
        let motion = bench.document().scene.lights[index].motion.clone();
        assert_eq!(motion.map(|m| m.path.kind()), Some(*kind));
        assert!(bench.has("play") && bench.has("time"));
    }
    bench.click("play");
    assert!(bench.app().session.clock.playing);
}

/// Invalid values of a light are refused.
#[test]
fn a_light_stays_possible() {
    let mut bench = Bench::new("builtin:suzanne", Tab::Lights);
    let index = bench.document().scene.lights.len();
    bench.click("add-light-spot");
    bench.type_into(&format!("light-{index}-kc"), "0");
    assert_eq!(bench.document().scene.lights[index].constant, 1.0);
    bench.type_into(&format!("light-{index}-inner-angle"), "60");
    let light = &bench.document().scene.lights[index];
    assert_eq!((light.inner_angle, light.outer_angle), (60.0, 60.0));
    bench.type_into(&format!("light-{index}-outer-angle"), "40");
    let light = &bench.document().scene.lights[index];
    assert_eq!((light.inner_angle, light.outer_angle), (40.0, 40.0));
}

#[test]
fn a_colour_is_typed() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    bench.click("light-0");
    bench.type_into("light-0-color-text", "0.5,2,1");
    assert_eq!(bench.document().scene.lights[0].color.0, [0.5, 2.0, 1.0]);
    bench.type_into("light-0-color-text", "no colour");
    assert_eq!(bench.document().scene.lights[0].color.0, [0.5, 2.0, 1.0]);
}
