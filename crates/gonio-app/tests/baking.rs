//! Baking in the window: settings, progress, the atlas, and the baked textures on the model.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;
#[path = "support/waiting.rs"]
mod waiting;

use egui::{Key, Modifiers, Pos2, pos2, vec2};
use gonio_app::baking::{BakeReply, BakeRequest};
use gonio_app::platform::{Event, Platform, SceneInput};
use gonio_bake::{BakeJob, MapKind};
use gonio_scene::files::{BuiltinOnly, FileSource};
use gonio_scene::load;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use support::{Here, Window};

impl Window {
    /// Opens a model in a window with the tab of baking, at a small size.
    fn to_bake(input: &str) -> Window {
        let mut window = Window::with(input, vec2(1280.0, 1400.0));
        window.until("the scene", |s| s["loaded"] == true && s["busy"].is_null());
        window.press(Modifiers::COMMAND, Key::B);
        assert_eq!(window.state()["tab"], "Bake");
        window.click("bake-size-256");
        window
    }

    fn bake(&mut self) -> Value {
        self.click("bake-start");
        self.until("the atlas", |s| s["bake"]["running"] == false && !s["bake"]["result"].is_null())
    }

    /// The place of texture coordinates in the window.
    fn in_atlas(&self, uv: [f64; 2]) -> Pos2 {
        let square = self.state()["bake"]["view"]["square"].clone();
        let [left, top, side] = [0, 1, 2].map(|i| square[i].as_f64().unwrap());
        pos2((left + uv[0] * side) as f32, (top + (1.0 - uv[1]) * side) as f32)
    }
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().unwrap_or_else(|| panic!("no numbers: {value}")))
}

#[test]
fn a_texel_is_marked_on_the_surface_and_back() {
    let mut window = Window::to_bake("builtin:suzanne");
    window.click("bake-map-normal");
    let state = window.bake();
    assert_eq!(state["bake"]["result"]["maps"], json!(["diffuse", "normal"]));
    assert_eq!(state["bake"]["result"]["overlaps"], 0);
    assert_eq!(state["messages"], json!([]));
    // A click on the surface: the atlas marks its texel.
    window.click_at(window.center("pane-0"));
    let state = window.until("the texel", |s| !s["bake"]["place"].is_null());
    assert_eq!(state["tab"], "Bake", "the probe's tab stays closed");
    let place = state["bake"]["place"].clone();
    // That texel in the atlas is the same place on the surface.
    let at = window.in_atlas(numbers(&place["uv"]));
    window.move_to(at);
    let state = window.until("the place", |s| s["bake"]["place"] != place);
    let (there, back): ([f64; 3], [f64; 3]) =
        (numbers(&place["position"]), numbers(&state["bake"]["place"]["position"]));
    let distance = there.iter().zip(back).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    // Half a point of the window, which shows the atlas at 500 points.
    assert!(distance < 0.02, "{distance}: {there:?} {back:?}");
    assert_eq!(state["bake"]["place"]["chart"], place["chart"]);
    // It stays when it is clicked, and Escape forgets it.
    window.click_at(at);
    window.move_to(pos2(2.0, 2.0));
    assert!(!window.state()["bake"]["place"].is_null());
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.state()["bake"]["place"], Value::Null);
}

#[test]
fn the_baked_model_looks_like_the_original() {
    let mut window = Window::to_bake("builtin:still-life");
    window.click("bake-size-1024");
    window.bake();
    window.click("bake-difference");
    let state = window.until("the difference", |s| !s["difference"].is_null());
    assert_eq!(state["pane_settings"][1]["baked"], "materials");
    // The textures are magnified here, and specular highlights are the materials' own.
    assert!(state["difference"]["psnr_db"].as_f64() > Some(35.0), "{:#}", state["difference"]);
    // Without light the map is brighter.
    window.click("bake-look-picture");
    let state = window.until("the picture", |s| s["difference"]["psnr_db"].as_f64() < Some(30.0));
    assert_eq!(state["pane_settings"][1]["baked"], "picture");
    // The light changes; the textures do not.
    assert_eq!(state["bake"]["result"]["stale"], false);
}

#[test]
fn a_bake_is_cancelled_by_its_button_and_by_another_scene() {
    let mut window = Window::to_bake("builtin:suzanne");
    window.click("bake-size-4096");
    window.click("bake-samples-16");
    window.click("bake-map-ambient-occlusion");
    window.click("bake-start");
    window.until("a step", |s| s["bake"]["running"] == true && s["bake"]["share"].as_f64() > Some(0.0));
    window.click("bake-cancel");
    let state = window.until("the end", |s| s["bake"]["running"] == false);
    assert_eq!((&state["bake"]["result"], &state["announcement"]), (&Value::Null, &json!("baking was cancelled")));
    window.click("bake-start");
    window.until("a step", |s| s["bake"]["running"] == true);
    let files: Arc<dyn FileSource> = Arc::new(BuiltinOnly);
    let input = SceneInput {
        inputs: vec!["builtin:cube".into()],
        environment: None,
        shaders: None,
        names: Vec::new(),
        problem: None,
        files,
    };
    window.here.coming.borrow_mut().push(Event::Open(Box::new(input)));
    let state = window.until("the cube", |s| s["title"] == "cube" || s["title"] == "builtin:cube");
    assert_eq!(state["bake"]["running"], false);
    assert_eq!(state["messages"][0]["text"], "baking was cancelled, because another scene was opened");
    // The settings are kept.
    assert_eq!(state["bake"]["job"]["size"], 4096);
}

/// A bake that nobody waits for any more ends soon, also when every texel traces thousands of rays: the thread lets go of the scene.
#[test]
fn a_bake_ends_when_its_window_is_closed() {
    let mut window = Window::to_bake("builtin:suzanne");
    window.click("bake-size-4096");
    window.click("bake-map-ambient-occlusion");
    window.click("bake-start");
    window.until("a step", |s| s["bake"]["share"].as_f64() > Some(0.0));
    drop(window);
    let files: Arc<dyn FileSource> = Arc::new(BuiltinOnly);
    let scene = load::load(load::describe(&["builtin:suzanne"], &*files).unwrap(), Path::new(""), &*files).unwrap();
    let scene = Arc::new(scene);
    let still_held = Arc::downgrade(&scene);
    let job = BakeJob { maps: vec![MapKind::AmbientOcclusion], size: 4096, occlusion_rays: 4096, ..BakeJob::default() };
    let request = BakeRequest { scene, time: 0.0, job, stem: "suzanne".into(), files, paths: Vec::new() };
    let mut task = Here::default().bake(request, &egui::Context::default());
    let mut step = String::new();
    // Past the unwrapping, among the rays.
    while step.is_empty() || step == "unwrapping" {
        match task.poll() {
            Some(BakeReply::Progress(now, _)) => step = now,
            Some(_) => panic!("it ended by itself"),
            None => std::thread::sleep(std::time::Duration::from_millis(10)),
        }
    }
    drop(task);
    let mut waited = 0;
    while still_held.strong_count() > 0 {
        std::thread::sleep(std::time::Duration::from_millis(10));
        waited += 1;
        // A whole row of texels would take longer than this.
        assert!(waited < 1000, "the bake goes on");
    }
}

#[test]
fn odd_models_get_one_sentence() {
    let path = std::env::temp_dir().join(format!("gonio-bake-{}.obj", std::process::id()));
    let line = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n";
    std::fs::write(&path, line).unwrap();
    let mut window = Window::to_bake(&path.to_string_lossy());
    window.click("bake-start");
    let state = window.until("the error", |s| s["bake"]["failed"].is_string());
    let sentence = "the model has no triangle with an area, so there is nothing to unwrap";
    assert_eq!((&state["bake"]["failed"], &state["error"]), (&json!(sentence), &json!(sentence)));
    // Triangles with an area, and no texture coordinates to keep.
    std::fs::write(&path, format!("{line}v 0 1 0\nf 1 2 4\n")).unwrap();
    let mut window = Window::to_bake(&path.to_string_lossy());
    window.click("bake-layout-keep-uvs");
    window.click("bake-start");
    let state = window.until("the error", |s| s["bake"]["failed"].is_string());
    assert_eq!(state["bake"]["failed"], "the model has no texture coordinates to keep; make new ones instead");
    std::fs::remove_file(&path).unwrap();
}
