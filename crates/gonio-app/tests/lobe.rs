//! The lobe at a pinned pixel: the whole application, with OpenGL but without a window.
#![allow(clippy::unwrap_used)]

mod support;

use egui::{Key, Modifiers, Vec2, vec2};
use gonio_app::exported;
use std::time::Duration;
use support::Window;

impl Window {
    /// The middle of the sample is pinned.
    fn pinned(size: Vec2) -> Self {
        let mut window = Window::with("builtin:sphere-smooth", size);
        for _ in 0..600 {
            window.steps(1);
            if window.app().session().facts.pictures > 0 {
                break;
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        let middle = window.center("pane-0");
        window.move_to(middle);
        window.press(Modifiers::NONE, Key::P);
        let middle = window.center("pane-0");
        window.click_at(middle);
        while window.app().session().probing.reading().is_none() {
            window.steps(1);
            std::thread::yield_now();
        }
        window.steps(3);
        window
    }

    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
        // A pause, so that the next click is not part of a double click.
        self.steps(30);
    }

    fn lobe(&self, pane: usize) -> Option<f64> {
        let id = format!("lobe-{pane}");
        let widgets = exported::widgets(&self.harness.ctx);
        widgets.iter().find(|widget| widget.id == id).map(|widget| widget.value.parse().unwrap())
    }
}

#[test]
fn the_value_towards_the_eye_is_that_of_the_probe() {
    let mut window = Window::pinned(vec2(1280.0, 800.0));
    let reading = window.app().session().probing.reading().unwrap().clone();
    let lights = reading.probe.as_ref().unwrap().terms.lights.clone();
    let sent = lights.iter().map(|light| (light.diffuse + light.specular).element_sum() / 3.0);
    let expected = sent.fold(0.0, f64::max);
    let lobe = window.lobe(0).unwrap();
    assert!(expected > 0.0 && (lobe - expected).abs() < 1e-6, "{lobe} {expected}");
    window.click("probe-lobe");
    assert_eq!(window.lobe(0), None);
    window.click("probe-lobe");
    assert!(window.lobe(0).is_some());
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.lobe(0), None, "nothing is pinned");
}

#[test]
fn panes_side_by_side_show_the_lobes_of_their_brdfs() {
    let mut window = Window::pinned(vec2(1500.0, 800.0));
    window.click("tab-compare");
    window.click("add-pane");
    window.steps(5);
    window.click("pane-brdf");
    window.click("pane-brdf-ward");
    window.steps(5);
    let (first, second) = (window.lobe(0).unwrap(), window.lobe(1).unwrap());
    assert!((first - second).abs() > 1e-6, "{first} {second}");
}

/// Three panes side by side in a small window: each has its inset, smaller and within the pane.
#[test]
fn narrow_panes_have_insets_too() {
    let mut window = Window::pinned(vec2(1180.0, 800.0));
    window.click("tab-compare");
    for _ in 0..2 {
        window.click("add-pane");
        window.steps(5);
    }
    for pane in 0..3 {
        assert!(window.lobe(pane).is_some(), "pane {pane} has no inset");
        let [x, _, width, _] = window.widget(&format!("lobe-{pane}")).rect;
        let [left, _, whole, _] = window.widget(&format!("pane-{pane}")).rect;
        assert!(whole < 300.0 && x >= left && x + width <= left + whole, "{x} {width} in {left} {whole}");
    }
}
