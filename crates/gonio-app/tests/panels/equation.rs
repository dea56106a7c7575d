//! The equation: its terms are switches.

use crate::Bench;
use egui::{Modifiers, vec2};
use gonio_app::document::Document;
use gonio_app::session::Tab;
use gonio_light::brdf::BrdfKind;
use gonio_light::{Convention, Specular};
use gonio_scene::scene_file::LightSourceKind;
use gonio_scene::settings::EnvironmentSettings;

const SCENE: &str = "builtin:light-kinds";

#[test]
fn each_term_is_a_switch_and_can_be_undone() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    type Switch = (&'static str, fn(&Document) -> bool);
    let read: [Switch; 6] = [
        ("ambient", |d| d.scene.equation.ambient),
        ("emitted", |d| d.scene.equation.emitted),
        ("diffuse", |d| d.scene.equation.diffuse),
        ("specular", |d| d.scene.equation.specular_term),
        ("attenuation", |d| d.scene.equation.attenuation),
        ("spot", |d| d.scene.equation.spot),
    ];
    for (term, is_on) in read {
        let before = bench.document().clone();
        bench.click(&format!("term-{term}"));
        assert!(!is_on(bench.document()), "{term} is still on");
        assert_eq!(bench.widget(&format!("term-{term}")).value, "off");
        let others_off = read.iter().filter(|(other, on)| *other != term && !on(bench.document())).count();
        assert_eq!(others_off, 0, "{term} switched others off");
        bench.undo();
        assert_eq!(*bench.document(), before);
        assert_eq!(bench.widget(&format!("term-{term}")).value, "on");
    }
}

#[test]
fn a_term_alone_and_all_again() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let before = bench.document().scene.equation.clone();
    bench.click_with("term-specular", Modifiers::SHIFT);
    let e = &bench.document().scene.equation;
    assert_eq!([e.ambient, e.emitted, e.diffuse, e.specular_term], [false, false, false, true]);
    // Factors are not summands.
    assert!(e.attenuation && e.spot);
    bench.click_with("term-specular", Modifiers::SHIFT);
    assert_eq!(bench.document().scene.equation, before);
    bench.double_click("term-diffuse");
    let e = &bench.document().scene.equation;
    assert_eq!([e.ambient, e.emitted, e.diffuse, e.specular_term], [false, false, true, false]);
    bench.click("terms-all");
    assert_eq!(bench.document().scene.equation, before);
}

#[test]
fn a_button_shows_a_term_alone_and_all_again() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    let before = bench.document().scene.equation.clone();
    for term in ["ambient", "emitted", "diffuse", "specular"] {
        let id = format!("solo-{term}");
        assert_eq!(bench.widget(&id).value, "false");
        bench.click(&id);
        let e = &bench.document().scene.equation;
        let on =
            [("ambient", e.ambient), ("emitted", e.emitted), ("diffuse", e.diffuse), ("specular", e.specular_term)];
        assert!(on.iter().all(|(other, on)| *on == (*other == term)), "{term}: {on:?}");
        assert_eq!(bench.widget(&id).value, "true");
        bench.click(&id);
        assert_eq!(bench.document().scene.equation, before, "{term}");
    }
}

/// A term that was off before another one was shown alone is off afterwards.
#[test]
fn leaving_a_term_alone_restores_the_switches() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    bench.click("term-emitted");
    bench.click_with("term-diffuse", Modifiers::ALT);
    bench.click_with("term-diffuse", Modifiers::ALT);
    let e = &bench.document().scene.equation;
    assert_eq!([e.ambient, e.emitted, e.diffuse, e.specular_term], [true, false, true, true]);
}

/// The environment's light is reflected by the diffuse and the specular term, which stay on; the lights are switched off.
#[test]
fn the_environment_is_alone_without_lights() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    bench.app().document.scene.environment =
        Some(EnvironmentSettings { image: "room".into(), light: true, ..EnvironmentSettings::default() });
    if let Some(light) = bench.app().document.scene.lights.first_mut() {
        light.enabled = false;
    }
    bench.settle();
    let before = bench.document().scene.clone();
    bench.click_with("term-environment", Modifiers::SHIFT);
    let (e, lights) = (&bench.document().scene.equation, &bench.document().scene.lights);
    assert_eq!([e.ambient, e.emitted, e.diffuse, e.specular_term], [false, false, true, true]);
    assert!(lights.len() > 1 && lights.iter().all(|light| !light.enabled));
    bench.click_with("term-environment", Modifiers::SHIFT);
    assert_eq!(bench.document().scene, before);
}

#[test]
fn the_equation_follows_the_settings() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    // Inside the brackets with the diffuse term, or behind them for both terms.
    let cosine_is_last = |bench: &Bench| bench.rect("term-cosine").left() > bench.rect("term-attenuation").right();
    bench.click("term-specular");
    bench.click("term-specular");
    bench.click("specular-phong");
    assert_eq!(bench.document().scene.equation.specular, Specular::Phong);
    assert!(!cosine_is_last(&bench));
    bench.click("cosine-weighted");
    assert!(bench.document().scene.equation.cosine_weighted);
    assert!(cosine_is_last(&bench));
    bench.app().document.scene.equation.brdf = Some(BrdfKind::Ward);
    bench.settle();
    assert!(!bench.has("term-ambient"), "a BRDF has no ambient term");
    assert!(cosine_is_last(&bench));
}

/// The equation is the same as that of the probe, whatever lights there are.
#[test]
fn every_factor_is_shown_without_a_spot_light() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    bench.app().document.scene.lights.retain(|light| light.kind != LightSourceKind::Spot);
    bench.settle();
    for term in ["light", "attenuation", "spot", "cosine"] {
        assert!(bench.has(&format!("term-{term}")), "{term}");
    }
}

#[test]
fn a_pane_with_its_own_model_does_not_change_the_scenes() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    if let Some(pane) = bench.app().document.panes.current_mut() {
        pane.specular = Some(Specular::Phong);
    }
    bench.settle();
    let scenes = bench.document().scene.equation.specular;
    bench.click("specular-none");
    assert_eq!(bench.document().scene.equation.specular, scenes);
    assert_eq!(bench.document().panes.current().and_then(|pane| pane.specular), Some(Specular::None));
    assert_eq!(bench.widget("term-specular").value, "off");
}

#[test]
fn the_convention_brings_its_cosine() {
    let mut bench = Bench::new(SCENE, Tab::Lights);
    bench.click("term-diffuse");
    bench.click("term-diffuse");
    bench.click("convention-physical");
    let e = &bench.document().scene.equation;
    assert_eq!((e.convention, e.cosine_weighted, e.shadows), (Convention::Physical, true, true));
}

/// All terms stay within the window, apart from each other, from a wide one to a phone.
#[test]
fn nothing_is_cut_off_at_any_width() {
    for width in [1280.0, 1024.0, 800.0, 400.0, 360.0] {
        let mut bench = Bench::sized("builtin:glass-and-mirror", Tab::Lights, vec2(width, 800.0));
        bench.click("definitions");
        let terms: Vec<_> = bench.widgets().into_iter().filter(|w| w.id.starts_with("term-")).collect();
        assert!(terms.len() >= 7, "{width}: {}", terms.len());
        for (i, a) in terms.iter().enumerate() {
            let [x, y, w, h] = a.rect;
            assert!(x >= 0.0 && x + w <= width && w > 4.0 && h > 8.0, "{width}: {} at {:?}", a.id, a.rect);
            for b in &terms[i + 1..] {
                let [bx, by, bw, bh] = b.rect;
                // Both are widened by two points to be hit more easily.
                let apart = x + w - 4.0 <= bx || bx + bw - 4.0 <= x || y + h <= by + 1.0 || by + bh <= y + 1.0;
                assert!(apart, "{width}: {} at {:?} on {} at {:?}", a.id, a.rect, b.id, b.rect);
            }
        }
    }
}
