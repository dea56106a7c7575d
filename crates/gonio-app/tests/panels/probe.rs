//! The probe of a traced pane: the pixel's light by the way it took.

use crate::Bench;
use egui_kittest::kittest::Queryable;
use glam::DVec3;
use gonio_app::action::Action;
use gonio_app::document::TruthSettings;
use gonio_app::session::Tab;
use gonio_app::truth::{PixelLight, TracedPane};

const HEADING: &str = "Traced light, by the way it took";

/// The probe of the middle of a 60x40 picture of a cube, whose only light is named `key`.
fn bench() -> Bench {
    let mut bench = Bench::new("builtin:cube", Tab::Probe);
    bench.app().document.scene.lights.truncate(1);
    bench.app().document.scene.lights[0].name = "key".to_owned();
    bench.settle();
    bench.app().session.probing.pinned = Some([0.5, 0.5]);
    while bench.app().session.probing.reading().is_none() {
        let ctx = bench.harness.ctx.clone();
        let session = &mut bench.app().session;
        let scene = session.loaded.clone().unwrap_or_else(|| panic!("the cube is loaded"));
        let frame = gonio_scene::Frame { width: 60, height: 40, ..scene.frame(0.0) };
        session.probing.update(&ctx, &scene, &frame, |_, _| None);
        bench.settle();
    }
    bench
}

fn count(bench: &Bench, text: &str) -> usize {
    bench.harness.query_all_by_label(text).count()
}

/// Each symbol stands above its number: their right edges agree, and the number is the next line.
#[test]
fn symbols_stand_above_their_numbers() {
    let mut bench = bench();
    let reading = bench.app().session.probing.reading().cloned().unwrap_or_else(|| panic!("a pixel is read"));
    let light = &reading.probe.as_ref().unwrap_or_else(|| panic!("the cube is there")).terms.lights[0];
    let factors = [
        ("<N.L>", light.cos_theta),
        ("att", light.attenuation),
        ("spot", light.spot),
        ("diff", light.diff),
        ("spec", light.spec),
    ];
    for (symbol, value) in factors {
        let value = match value.abs() {
            _ if gonio_light::is_noise(value) => "0".to_owned(),
            size if size < 1e-3 => format!("{value:.0e}"),
            _ => format!("{value:.4}"),
        };
        let above = bench.harness.get_by_label(symbol).rect();
        let is_below = |number: egui::Rect| {
            (number.right() - above.right()).abs() < 1.0
                && (0.0..30.0).contains(&(number.center().y - above.center().y))
        };
        let numbers: Vec<_> = bench.harness.query_all_by_label(&value).map(|node| node.rect()).collect();
        assert!(numbers.iter().any(|&number| is_below(number)), "{symbol} at {above:?}, {value} at {numbers:?}");
    }
}

#[test]
fn the_probe_of_a_traced_pane_lists_the_ways_of_light() {
    let mut bench = bench();
    assert_eq!(count(&bench, HEADING), 0, "OpenGL's picture has no paths");
    bench.app().document.panes.list[0].show_truth(Some(TruthSettings::default()));
    bench.settle();
    assert_eq!((count(&bench, HEADING), count(&bench, "The first paths are on their way.")), (1, 1));
    // Part, index, red, green, blue: emitted, a light, an object, environment, ambient, first bounce, rest, total, error.
    let parts = [
        [0.0, 0.0, 0.0101, 0.0, 0.0],
        [1.0, 0.0, 0.1202, 0.25, 0.5],
        [2.0, 0.0, 0.2303, 0.0, 0.0],
        [3.0, 0.0, 0.3404, 0.0, 0.0],
        [4.0, 0.0, 0.4505, 0.0, 0.0],
        [5.0, 0.0, 0.5606, 0.0, 0.0],
        [6.0, 0.0, 0.6707, 0.0, 0.0],
        [7.0, 0.0, 2.3828, 0.0, 0.0],
        [8.0, 0.0, 0.0909, 0.0, 0.0],
    ];
    let numbers = [&[4096.0][..], &parts.concat()].concat();
    let mut traced = TracedPane::default();
    traced.light = PixelLight::from_numbers([30, 20], &numbers);
    bench.app().session.traced = vec![traced];
    bench.settle();
    assert_eq!(bench.widget("probe-paths").value, "4096");
    let names =
        ["emitted", "object cube", "environment", "ambient", "first bounce", "the rest", "total", "standard error"];
    for name in names {
        // Some are legends elsewhere.
        assert!(count(&bench, name) >= 1, "{name}");
    }
    for value in ["0.0101", "0.1202", "0.2303", "0.3404", "0.4505", "0.5606", "0.6707", "0.0909"] {
        assert_eq!(count(&bench, value), 1, "{value}");
    }
    assert_eq!(count(&bench, "2.3828"), 2, "the total is also beside the values of CPU and OpenGL");
    assert_eq!((count(&bench, "traced"), count(&bench, "The light equation, by source")), (1, 1));
    bench.click("probe-copy-text");
    bench.click("probe-copy-json");
    let copied = |text: &str| {
        let is_in = |action: &Action| matches!(action, Action::CopyText(copied) if copied.contains(text));
        bench.harness.state().actions.iter().any(is_in)
    };
    assert!(copied("traced key       0.1202 0.2500 0.5000\n"), "{:?}", bench.harness.state().actions);
    assert!(copied("\"traced\": [") && copied("first bounce"));
    // Of another pixel it says nothing.
    let light = PixelLight { pixel: [31, 20], paths: 1.0, parts: vec![(7, 0, DVec3::ONE)] };
    bench.app().session.traced[0].light = Some(light);
    bench.settle();
    assert!(!bench.has("probe-paths") && count(&bench, "The first paths are on their way.") == 1);
    // Nothing is followed through a pixel that the pointer passes.
    let probing = &mut bench.app().session.probing;
    (probing.pinned, probing.hovered, probing.follows) = (None, Some([0.5, 0.5]), true);
    bench.settle();
    assert_eq!(count(&bench, "A click pins a pixel, and paths of light are followed through it."), 1);
}
