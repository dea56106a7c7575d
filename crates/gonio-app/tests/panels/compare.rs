//! Panes: presets, settings, arrangement.

use crate::Bench;
use egui_kittest::kittest::Queryable;
use gonio_app::document::{Pane, PaneArrangement};
use gonio_app::session::Tab;
use gonio_app::session::comparison::{CurvePoint, DifferenceFacts};
use gonio_light::{Convention, Specular};
use gonio_scene::detail::LevelOfDetail;
use gonio_scene::difference::of_bytes;
use gonio_scene::scene_file::Shading;

fn bench() -> Bench {
    Bench::new("builtin:sphere-smooth", Tab::Compare)
}

fn shows(bench: &Bench, text: &str) -> bool {
    bench.harness.query_all_by_label(text).count() > 0
}

/// Without a setting of the pane, the slider shows the scene's triangles.
#[test]
fn the_slider_starts_at_the_scenes_triangles() {
    for triangles in [128, 8192] {
        let bench = Bench::new(&format!("builtin:sphere-{triangles}"), Tab::Compare);
        assert_eq!(bench.widget("pane-sphere").value, triangles.to_string());
    }
}

#[test]
fn presets_create_their_panes() {
    let mut bench = bench();
    bench.click("preset-shadings");
    let shadings: Vec<_> = bench.document().panes.list.iter().map(|pane| pane.shading).collect();
    assert_eq!(shadings, [Some(Shading::Flat), Some(Shading::Gouraud), Some(Shading::Phong)]);
    bench.click("preset-speculars");
    let speculars: Vec<_> = bench.document().panes.list.iter().map(|pane| pane.specular).collect();
    assert_eq!(speculars, [Some(Specular::Phong), Some(Specular::BlinnPhong)]);
    bench.click("preset-conventions");
    let conventions: Vec<_> = bench.document().panes.list.iter().map(|pane| pane.convention).collect();
    assert_eq!(conventions, [Some(Convention::Lab), Some(Convention::Physical)]);
    bench.click("preset-details");
    let details: Vec<_> = bench.document().panes.list.iter().map(|pane| pane.detail).collect();
    assert_eq!(details, [Some(LevelOfDetail::Sphere(128)), Some(LevelOfDetail::Sphere(8192))]);
    bench.click("preset-one");
    assert_eq!(bench.document().panes.list, [Pane::default()]);
    bench.undo();
    assert_eq!(bench.document().panes.list.len(), 2, "the last preset is a step of the history");
}

#[test]
fn panes_are_added_selected_and_removed() {
    let mut bench = bench();
    bench.click("preset-speculars");
    bench.click("choose-pane-1");
    assert_eq!(bench.document().panes.current, 1);
    bench.click("add-pane");
    let panes = &bench.document().panes;
    assert_eq!((panes.list.len(), panes.current), (3, 2));
    assert_eq!(panes.list[2], panes.list[1], "a copy of the current pane");
    bench.click("copy-pane");
    assert!(bench.document().panes.list.iter().all(|pane| pane.specular == Some(Specular::BlinnPhong)));
    bench.click("remove-pane-0");
    assert_eq!(bench.document().panes.list.len(), 2);
}

#[test]
fn an_arrangement_is_chosen_and_its_numbers_are_shown() {
    let mut bench = bench();
    assert!(!bench.has("difference-mode"), "one pane is compared with nothing");
    bench.click("preset-shadings");
    bench.click("wipe-mode");
    assert_eq!(bench.document().panes.arrangement, PaneArrangement::Wipe(0.5));
    bench.click("difference-mode");
    assert_eq!(bench.document().panes.arrangement, PaneArrangement::Difference);
    bench.click("signed");
    assert!(bench.document().panes.difference.signed);
    let tally = of_bytes(&[0, 0, 0, 255, 9, 9, 9, 255], &[0, 7, 0, 255, 9, 9, 9, 255], 1.0);
    bench.app().session.comparison.difference = Some(DifferenceFacts::new(&tally, [2, 1]));
    bench.settle();
    assert!(shows(&bench, "1 pixels, 50.00 %") && shows(&bench, "7/255"));
    bench.click("side-by-side");
    assert_eq!(bench.document().panes.arrangement, PaneArrangement::SideBySide);
}

#[test]
fn the_curve_is_started_and_stopped() {
    let mut bench = bench();
    bench.click("curve");
    assert!(bench.app().session.comparison.curve.running);
    bench.click("curve");
    assert!(!bench.app().session.comparison.curve.running);
    let point = |triangles, rms| CurvePoint {
        shading: Shading::Flat,
        triangles,
        rms,
        vertices: Some(24),
        fragments: Some(31_000),
    };
    bench.app().session.comparison.curve.points = vec![point(8, 12.5), point(32, 3.25)];
    bench.settle();
    assert!(shows(&bench, "12.500") && shows(&bench, "31 000 fragments"));
}
