//! The BRDF bench as a user works with it: the whole application, with OpenGL but without a window.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Vec2, pos2, vec2};
use gonio_app::platform::{Event as PlatformEvent, Purpose};
use serde_json::Value;
use support::Window;

const DESK: Vec2 = vec2(1280.0, 800.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

impl Window {
    fn bench(size: Vec2) -> Self {
        let mut window = Window::with("builtin:cube", size);
        if size.x < 560.0 {
            window.click("menu");
        }
        window.click("bench");
        window
    }

    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
        // A pause, so that the next click is not part of a double click.
        self.steps(30);
    }

    fn state(&self) -> Value {
        self.app().state(&self.harness.ctx)["bench"].clone()
    }

    fn names(&self) -> Vec<String> {
        let state = self.state();
        let functions = state["functions"].as_array().unwrap();
        functions.iter().map(|function| function["name"].as_str().unwrap().to_owned()).collect()
    }

    fn open(&mut self, name: &str, bytes: &[u8]) {
        self.here.coming.borrow_mut().push(PlatformEvent::BenchFiles(vec![(name.to_owned(), bytes.to_vec())]));
        self.steps(3);
    }

    fn messages(&self) -> Vec<String> {
        self.app().session().messages.list().iter().map(|message| message.text.clone()).collect()
    }

    /// Types a value into a number's field.
    fn type_number(&mut self, id: &str, text: &str) {
        self.click(id);
        self.press(egui::Modifiers::COMMAND, egui::Key::A);
        self.harness.event(egui::Event::Text(text.to_owned()));
        self.press(egui::Modifiers::NONE, egui::Key::Enter);
    }
}

#[test]
fn the_bench_opens_with_three_models_and_goes_back_to_the_scene() {
    let mut window = Window::bench(DESK);
    assert_eq!(window.names(), ["phong-normalised", "blinn-normalised:c=128", "ward-normalised:c=0.12"]);
    let state = window.state();
    assert_eq!((&state["open"], &state["plot"]["kind"]), (&true.into(), &"polar".into()));
    assert!(state["plot"]["error"].is_null() && state["plot"]["serial"].as_u64().unwrap() > 0);
    window.click("leave");
    assert_eq!(window.state()["open"], false);
    window.widget("exercises");
    // Its functions are kept.
    window.click("bench");
    assert_eq!(window.names().len(), 3);
}

#[test]
fn every_kind_of_plot_is_drawn_and_scales_change_it() {
    let mut window = Window::bench(DESK);
    window.click("plot-kind-fresnel");
    let error = window.state()["plot"]["error"].clone();
    assert_eq!(error, "No function has an index of refraction above 1, which Fresnel curves need.");
    window.click("add-model");
    window.click("model-ggx");
    for kind in ["cartesian", "lobe", "slice", "sphere", "albedo", "reciprocity", "fresnel", "samples", "polar"] {
        let before = window.state()["plot"]["serial"].as_u64().unwrap();
        window.click(&format!("plot-kind-{kind}"));
        let plot = window.state()["plot"].clone();
        assert_eq!((&plot["kind"], &plot["error"], &plot["running"]), (&kind.into(), &Value::Null, &false.into()));
        assert!(plot["serial"].as_u64().unwrap() > before, "{kind}");
        let [_, _, width, height] = window.widget("bench-plot").rect;
        assert!(width > 800.0 && height > 450.0, "{kind}: {width} x {height}");
    }
    let linear = window.state()["plot"]["serial"].as_u64().unwrap();
    window.click("plot-scale-cube-root");
    assert!(window.state()["plot"]["serial"].as_u64().unwrap() > linear);
}

#[test]
fn dragging_in_the_polar_plot_turns_the_light() {
    let mut window = Window::bench(DESK);
    let [left, top, ..] = window.widget("bench-plot").rect;
    let plot = window.state()["plot"].clone();
    let number = |value: &Value| value.as_f64().unwrap() as f32;
    let center = pos2(left + number(&plot["center"][0]), top + number(&plot["center"][1]));
    let radius = number(&plot["radius"]);
    let at = |degrees: f32| center + 0.8 * radius * vec2(-degrees.to_radians().sin(), -degrees.to_radians().cos());
    window.drag(at(45.0), at(70.0) - at(45.0));
    let theta = window.state()["plot"]["theta"].as_f64().unwrap();
    assert!((theta - 70.0).abs() < 0.3, "{theta}");
    // The plot is another one, and the slider shows the angle.
    assert!(window.state()["plot"]["serial"].as_u64() > plot["serial"].as_u64());
    assert_eq!(window.widget("theta").value, theta.to_string());
    // The mirror direction means the same light.
    window.click_at(at(-20.0));
    assert!((window.state()["plot"]["theta"].as_f64().unwrap() - 20.0).abs() < 0.3);
}

#[test]
fn sliders_change_a_model_and_its_label() {
    let mut window = Window::bench(DESK);
    let before = window.state()["plot"]["serial"].as_u64().unwrap();
    window.type_number("parameter-0-c", "64");
    assert_eq!(window.names()[0], "phong-normalised:c=64");
    assert!(window.state()["plot"]["serial"].as_u64().unwrap() > before);
    let [left, top, width, height] = window.widget("parameter-0-c-slider").rect;
    window.click_at(pos2(left + width - 8.0, top + 0.5 * height));
    let c: f64 = window.names()[0].rsplit('=').next().unwrap().parse().unwrap();
    assert!((600.0..=1000.0).contains(&c), "{c}");
}

#[test]
fn lobes_turn_under_the_pointer() {
    let mut window = Window::bench(DESK);
    window.click("plot-kind-lobe");
    let view = window.state()["plot"]["view"].clone();
    let middle = window.center("bench-plot");
    window.drag(middle, vec2(60.0, 20.0));
    let turned = window.state()["plot"]["view"].clone();
    assert_ne!(view, turned);
}

#[test]
fn the_chosen_function_is_checked() {
    let mut window = Window::bench(DESK);
    window.click("add-model");
    window.click("model-ward-printed");
    window.click("check-function");
    for _ in 0..20 {
        window.steps(1);
    }
    let checks = window.state()["checks"].clone();
    assert_eq!((&checks["of"], &checks["running"]), (&"ward-printed".into(), &false.into()));
    let found = checks["found"].as_array().unwrap();
    let named: Vec<&str> = found.iter().map(|property| property["property"].as_str().unwrap()).collect();
    assert!(named.starts_with(&["reciprocity", "energy", "positivity"]), "{named:?}");
    assert!(found.iter().any(|property| property["passed"] == false), "{found:?}");
    // The table says so in a word.
    let failed = found.iter().find(|property| property["passed"] == false).unwrap();
    assert_eq!(window.widget(&format!("check-{}", failed["property"].as_str().unwrap())).label, "fail");
}

const GLSL: &str = "vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)\n{\n    return vec3(pow(max(dot(N, normalize(L + V)), 0.0), 20.0));\n}\n";
const BRDF: &str = "analytic\n::begin parameters\nfloat gloss 1 200 30\nbool matte 0\n::end parameters\n::begin shader\n\
    vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)\n{\n    \
    return vec3(matte ? 0.3 : pow(max(dot(N, normalize(L + V)), 0.0), gloss));\n}\n::end shader\n";

#[test]
fn files_are_plotted_with_their_parameters() {
    let mut window = Window::bench(DESK);
    window.open("folder/mine.glsl", GLSL.as_bytes());
    window.open("gloss.brdf", BRDF.as_bytes());
    assert_eq!(window.names()[3..], ["mine.glsl", "gloss.brdf"]);
    let plot = window.state()["plot"].clone();
    assert!(plot["error"].is_null());
    window.type_number("parameter-4-gloss", "90");
    window.click("parameter-4-matte");
    assert_eq!(window.widget("parameter-4-gloss").value, "90");
    assert_eq!(window.widget("parameter-4-matte").value, "true");
    assert!(window.state()["plot"]["serial"].as_u64() > plot["serial"].as_u64());
    assert!(window.messages().is_empty(), "{:?}", window.messages());
}

#[test]
fn an_error_in_a_file_is_one_sentence_with_line_and_column() {
    let mut window = Window::bench(DESK);
    window.open("mine.glsl", GLSL.replace("20.0));", "20.0)").as_bytes());
    window.open("short.binary", &[1, 2, 3]);
    window.open("notes.txt", b"hello");
    let messages = window.messages();
    assert!(messages[0].starts_with("mine.glsl:3:62: "), "{messages:?}");
    assert!(messages[1].starts_with("short.binary: ") && messages[2].contains("unknown format"), "{messages:?}");
    assert_eq!(window.names().len(), 3);
}

#[test]
fn the_dialog_opens_functions_and_plots_are_saved() {
    let mut window = Window::bench(DESK);
    window.click("open-files");
    assert_eq!(*window.here.asked.borrow(), Some(Purpose::Bench));
    window.click("path-cancel");
    let path = std::env::temp_dir().join(format!("gonio-bench-{}.svg", std::process::id()));
    for (id, start) in [("save-plot-svg", &b"<svg "[..]), ("save-plot-png", b"\x89PNG")] {
        window.click("save");
        window.click(id);
        window.click("path");
        window.press(egui::Modifiers::COMMAND, egui::Key::A);
        window.harness.event(egui::Event::Text(path.to_string_lossy().into_owned()));
        window.press(egui::Modifiers::NONE, egui::Key::Enter);
        let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{error}: {:?}", window.messages()));
        assert!(bytes.starts_with(start), "{id}");
    }
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn without_a_function_the_bench_says_what_to_do() {
    let mut window = Window::bench(DESK);
    for _ in 0..3 {
        window.click("remove-0");
    }
    let error = window.state()["plot"]["error"].clone();
    assert!(error.as_str().unwrap().starts_with("No function is shown: add a model"), "{error}");
    window.click("add-model");
    window.click("model-lambert");
    assert!(window.state()["plot"]["error"].is_null());
}

#[test]
fn a_phone_shows_the_plot_above_its_settings() {
    let mut window = Window::bench(PHONE);
    let [left, top, width, height] = window.widget("bench-plot").rect;
    assert!(left >= 0.0 && left + width <= PHONE.x && height > 300.0, "{left} {width} {height}");
    for id in ["plot-kind-samples", "plot-scale-log", "theta"] {
        let [x, y, w, h] = window.widget(id).rect;
        assert!(x >= 0.0 && x + w <= PHONE.x && y > top + height && y + h < PHONE.y, "{id}: {x} {y} {w} {h}");
    }
    window.click("page-functions");
    let [x, _, w, _] = window.widget("parameter-0-c").rect;
    assert!(x + w <= PHONE.x);
    window.click("page-checks");
    window.widget("check-function");
    window.click("leave");
    window.widget("menu");
}
