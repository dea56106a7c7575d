//! Environment, background, output, debug views.

use crate::bench::Bench;
use gonio_app::session::Tab;
use gonio_light::Quantity;
use gonio_light::color::ToneMap;

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
fn an_environment_comes_is_turned_and_goes() {
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
