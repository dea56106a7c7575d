//! The lights: rows of the sum.

use crate::bench::Bench;
use egui::vec2;
use gonio_app::session::{Selection, Tab};
use gonio_scene::ViewSpec;
use gonio_scene::scene_file::{LightSourceKind, MotionKind};

const SCENE: &str = "builtin:light-kinds";

#[test]
fn a_light_goes_off_and_the_frame_is_dark_of_it() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let index = bench.document().scene.lights.iter().position(|l| l.kind == LightSourceKind::Point).unwrap_or(0);
    bench.click(&format!("light-{index}-on"));
    assert_eq!(bench.document().scene.lights[index].enabled, false);
    let frame = bench.app().session.loaded.as_ref().map(|l| l.frame(0.0)).unwrap_or_else(|| panic!("no scene"));
    assert_eq!(frame.lights[index].color.to_array(), [0.0; 3]);
    bench.click(&format!("light-{index}-on"));
    assert_eq!(bench.document().scene.lights[index].enabled, true);
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
    // What is no number, and what is out of range.
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
fn every_kind_can_be_added_and_taken_out() {
    for kind in LightSourceKind::ALL {
        let mut bench = Bench::new("builtin:suzanne", Tab::Lights);
        let before = bench.document().scene.lights.len();
        bench.click(&format!("add-light-{kind}"));
        let lights = &bench.document().scene.lights;
        assert_eq!((lights.len(), lights[before].kind), (before + 1, *kind));
        assert_eq!(bench.app().session.selection, Selection::Light(before));
        // A second frame with it open: nothing is made up by showing it.
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
            // The scene that follows is checked as a file would be: keys of another kind are an error.
            assert_eq!(bench.document().scene.lights[index].kind, *to, "from {from}");
        }
    }
}

#[test]
fn what_is_looked_at_follows_its_light() {
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

/// Numbers that no light can have are not taken.
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
