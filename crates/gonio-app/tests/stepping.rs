//! Steps through shaders at a pixel, as a student uses them: the whole application, with OpenGL but without a window.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Key, Modifiers, Vec2, pos2, vec2};
use gonio_app::exercise::Start;
use gonio_app::exported;
use gonio_app::files::{ExerciseFile, GatheredInputs, MemoryFiles, gather};
use gonio_app::platform::{Event as PlatformEvent, SceneInput};
use gonio_exercises::exercise;
use serde_json::Value;
use std::sync::Arc;
use std::time::Duration;
use support::Window;

const DESK: Vec2 = vec2(1280.0, 800.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

/// Exercise 07 with the model solution, and a change of its fragment shader.
fn open(size: Vec2, from: &str, to: &str) -> Window {
    let of = exercise::find("ex07").unwrap();
    let file = |(name, text): (&'static str, &'static str)| {
        assert!(!name.ends_with(".frag") || text.contains(from), "{from}");
        let text = if name.ends_with(".frag") { text.replacen(from, to, 1) } else { text.to_owned() };
        ExerciseFile { name: name.to_owned(), path: None, bytes: text.into_bytes() }
    };
    let start = Start { exercise: "ex07".to_owned(), files: of.reference_files().unwrap().map(file).collect() };
    let mut window = Window::with("builtin:cube", size);
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, start);
    window.steps(4);
    wait(&mut window, "the program", |s| s["drawn"] == true);
    window
}

fn state(window: &Window) -> Value {
    window.app().state(&window.harness.ctx)["exercise"].clone()
}

#[track_caller]
fn wait(window: &mut Window, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
    for _ in 0..600 {
        window.steps(1);
        let state = state(window);
        if expected(&state) {
            return state;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    panic!("timed out waiting for {what}: {:#}", state(window));
}

/// Waits until the values are those of the pinned pixel.
#[track_caller]
fn settled(window: &mut Window) -> Value {
    wait(window, "the values", |s| s["step"]["busy"] == false)["step"].clone()
}

fn click(window: &mut Window, id: &str) -> Value {
    let at = window.center(id);
    window.click_at(at);
    window.steps(30);
    settled(window)
}

/// The components of a vector.
fn numbers(vector: &str) -> Vec<f32> {
    vector.trim_matches(['(', ')']).split(", ").map(|number| number.parse().unwrap()).collect()
}

/// The text beside the first line that contains `code`.
fn beside(window: &Window, step: &Value, code: &str) -> String {
    let work = window.app().exercise().work.as_ref().unwrap();
    let line = work.files[work.current].text.lines().position(|line| line.contains(code)).unwrap() as u64 + 1;
    let values = step["values"].as_array().unwrap();
    values.iter().find(|value| value["line"] == line).unwrap_or_else(|| panic!("{values:?}"))["text"]
        .as_str()
        .unwrap()
        .to_owned()
}

/// Puts the editor's cursor before a character of the first line that contains `code`.
fn put_cursor(window: &mut Window, code: &str, offset: usize) {
    let work = window.app().exercise().work.as_ref().unwrap();
    let text = &work.files[work.current].text;
    let line = text.lines().position(|line| line.contains(code)).unwrap();
    let column = text.lines().nth(line).unwrap().find(code).unwrap() + offset;
    click(window, "editor");
    window.press(Modifiers::CTRL, Key::Home);
    (0..line).for_each(|_| window.press(Modifiers::NONE, Key::ArrowDown));
    window.press(Modifiers::NONE, Key::Home);
    (0..column).for_each(|_| window.press(Modifiers::NONE, Key::ArrowRight));
}

#[test]
fn a_click_on_the_picture_shows_each_lines_values() {
    let mut window = open(DESK, "", "");
    assert!(state(&window)["step"].is_null());
    let middle = window.center("picture-yours");
    window.click_at(middle);
    let step = settled(&mut window);
    assert!(step["message"].is_null() && step["stage"] == "fragment", "{step:#}");
    let work = window.app().exercise().work.as_ref().unwrap();
    assert!(!work.clock.playing, "the values are those of one moment");
    // The nearest point of the sphere is seen there, whose normal points to the eye.
    let n = numbers(&beside(&window, &step, "vec3 N ="));
    assert!(n[0].abs() < 0.05 && n[1].abs() < 0.05 && (n[2] - 1.0).abs() < 0.01, "{n:?}");
    assert_eq!(step["step"], step["steps"]);
    // The picture is not a square; up and to the right are where they are seen.
    let [.., width, height] = window.widget("picture-yours").rect;
    assert!((width - height).abs() > 5.0, "{width} {height}");
    window.click_at(middle + vec2(60.0, -60.0));
    let step = settled(&mut window);
    let n = numbers(&beside(&window, &step, "vec3 N ="));
    assert!(n[0] > 0.2 && (n[0] - n[1]).abs() < 0.02, "{n:?}");
    // The values follow the camera.
    window.drag(middle, vec2(40.0, 0.0));
    let turned = settled(&mut window);
    assert_ne!(beside(&window, &turned, "vec3 V ="), beside(&window, &step, "vec3 V ="));
    // Beside the sphere nothing is drawn.
    let [left, top, ..] = window.widget("picture-yours").rect;
    window.click_at(pos2(left + 3.0, top + 3.0));
    let step = settled(&mut window);
    assert_eq!(step["message"], "Nothing is drawn at this pixel: click on an object.");
    let pin = window.center("step-pin");
    window.click_at(pin);
    assert!(state(&window)["step"].is_null());
}

#[test]
fn steps_go_by_buttons_and_keys_through_calls_and_iterations() {
    let looping = "float twice(float x) {\n    return 2.0 * x;\n}\n\nvoid main() {\n    float total = 0.0;\n    for (int i = 0; i < 3; i++) {\n        total += twice(float(i));\n    }\n";
    let mut window = open(DESK, "void main() {\n", looping);
    window.press(Modifiers::NONE, Key::F9);
    let end = settled(&mut window);
    assert_eq!(beside(&window, &end, "total +="), "6   (3 times)");
    let first = click(&mut window, "step-first");
    assert_eq!((&first["step"], &first["function"]), (&1.into(), &"main".into()));
    // Over: never inside of the function. Into: inside of it, in each iteration.
    let mut seen = Vec::new();
    for _ in 0..40 {
        window.press(Modifiers::NONE, Key::F11);
        let step = settled(&mut window);
        if step["function"] == "twice" {
            seen.push(step["iterations"][0].as_u64().unwrap());
            let of_caller = step["variables"].as_array().unwrap().iter().any(|v| v["name"] == "total");
            assert!(of_caller, "{step:#}");
        }
        if step["line"].as_u64() > first["line"].as_u64().map(|line| line + 4) {
            break;
        }
    }
    seen.dedup();
    assert_eq!(seen, [1, 2, 3]);
    click(&mut window, "step-first");
    for _ in 0..10 {
        window.press(Modifiers::ALT, Key::ArrowDown);
        assert_eq!(settled(&mut window)["function"], "main");
    }
    let before = settled(&mut window)["step"].clone();
    let back = click(&mut window, "step-back-into");
    assert_eq!(back["step"].as_u64().unwrap() + 1, before.as_u64().unwrap());
    // While a step is shown, later lines have no values yet.
    let first = click(&mut window, "step-first");
    let values = first["values"].as_array().unwrap();
    assert!(values.iter().all(|value| value["line"].as_u64() <= first["line"].as_u64()), "{values:?}");
}

#[test]
fn the_vertex_shader_is_stepped_through_at_the_corners() {
    let mut window = open(DESK, "", "");
    window.press(Modifiers::NONE, Key::F9);
    settled(&mut window);
    let step = click(&mut window, "step-stage-vertex");
    assert_eq!((&step["stage"], &state(&window)["file"]), (&"vertex".into(), &"reference.vert".into()));
    let positions: Vec<String> = ["1", "2", "3"]
        .iter()
        .map(|corner| {
            let step = click(&mut window, &format!("step-corner-corner-{corner}"));
            beside(&window, &step, "in vec3 position")
        })
        .collect();
    assert!(positions[0] != positions[1] && positions[1] != positions[2], "{positions:?}");
    // The tab of the other file changes the shader.
    let fragment = state(&window)["files"].as_array().unwrap().iter().position(|f| f["name"] == "reference.frag");
    let step = click(&mut window, &format!("file-{}", fragment.unwrap()));
    assert_eq!(step["stage"], "fragment");
}

#[test]
fn nan_and_unwritten_values_are_named_with_their_line() {
    let broken =
        "void main() {\n    vec3 never;\n    vec3 zero = v_normal * 0.0;\n    vec3 unit = normalize(zero) + never;\n";
    let mut window = open(DESK, "void main() {\n", broken);
    window.press(Modifiers::NONE, Key::F9);
    let step = settled(&mut window);
    assert!(
        beside(&window, &step, "vec3 unit").contains("NaN") || beside(&window, &step, "vec3 unit") == "never written"
    );
    let nan = window.widget("step-nan");
    assert!(nan.label.contains("normalize(zero) = (NaN, NaN, NaN)"), "{}", nan.label);
    assert!(window.widget("step-unwritten").label.ends_with(": never"));
    let step = click(&mut window, "step-nan");
    assert_eq!(step["line"].to_string(), nan.value);
}

#[test]
fn the_expression_at_the_cursor_has_a_value_and_a_picture() {
    let mut window = open(DESK, "", "");
    window.press(Modifiers::NONE, Key::F9);
    settled(&mut window);
    put_cursor(&mut window, "float d = length(", 12);
    window.press(Modifiers::ALT, Key::Enter);
    let expected = "length(light.light_pos - v_frag_coord)";
    wait(&mut window, "the expression", |s| s["step"]["expression"] == expected);
    window.steps(2);
    let shown = window.widget("expression");
    // The light is at (1, 2, 1.5) plus its swing.
    assert!((3.0..6.0).contains(&shown.value.parse::<f32>().unwrap()), "{shown:?}");
    assert!(shown.rect[3] > 100.0, "there is a picture: {shown:?}");
}

#[test]
fn on_a_phone_everything_fits_and_edits_hide_the_values() {
    let mut window = open(PHONE, "", "");
    click_page(&mut window);
    window.press(Modifiers::NONE, Key::F9);
    let step = settled(&mut window);
    assert!(step["message"].is_null(), "{step:#}");
    window.steps(2);
    for widget in exported::widgets(&window.harness.ctx) {
        let [left, _, width, _] = widget.rect;
        let is_scrolled = widget.id == "editor" || widget.id.starts_with("variable-");
        assert!(is_scrolled || (left >= 0.0 && left + width <= PHONE.x + 1.0), "{widget:?}");
    }
    window.widget("step-into");
}

fn click_page(window: &mut Window) {
    let at = window.center("page-files");
    window.click_at(at);
    window.steps(30);
}

/// A cube that the user's own shaders draw, opened as files are dropped on a page.
fn with_shaders(size: Vec2, files: &[(&str, &str)]) -> Window {
    let mut window = Window::with("builtin:cube", size);
    window.steps(4);
    drop_files(&mut window, files);
    window
}

fn drop_files(window: &mut Window, files: &[(&str, &str)]) {
    let mut memory = MemoryFiles::default();
    files.iter().for_each(|(name, text)| memory.insert(name, text.as_bytes().to_vec()));
    let GatheredInputs { inputs, environment, shaders } = gather(&memory.names(), &memory).unwrap();
    let input = SceneInput { inputs, environment, shaders, names: Vec::new(), problem: None, files: Arc::new(memory) };
    window.here.coming.borrow_mut().push(PlatformEvent::Open(Box::new(input)));
    window.steps(3);
}

/// Waits until the state of the user's own shaders is as expected.
#[track_caller]
fn wait_own(window: &mut Window, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
    for _ in 0..600 {
        window.steps(1);
        let state = window.app().state(&window.harness.ctx)["shaders"].clone();
        if expected(&state) {
            // The result may have come after this frame's widgets.
            window.steps(1);
            return state;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    panic!("timed out waiting for {what}: {:#}", window.app().state(&window.harness.ctx)["shaders"]);
}

fn listed(state: &Value) -> bool {
    state["step"]["busy"] == false && (state["step"]["values"].is_array() || state["step"]["message"].is_string())
}

const OWN: &str = "#version 330 core\nin vec3 normal;\nuniform float gain;\nout vec4 c;\nvoid main() {\n    vec3 n = \
                   normalize(normal);\n    c = vec4(gain * n, 1.0);\n}\n";

#[test]
fn dropped_shaders_draw_the_scene_and_are_stepped_through() {
    for size in [DESK, PHONE] {
        let mut window = with_shaders(size, &[("own.frag", OWN), ("names.toml", "[names]\ngain = 0.25\n")]);
        let state = wait_own(&mut window, "the program", |s| s["compiled"] == true);
        assert_eq!((&state["failed"], &state["uniforms"][0]["origin"]), (&false.into(), &"names.toml".into()));
        window.press(Modifiers::NONE, Key::F9);
        let state = wait_own(&mut window, "the values", listed);
        assert_eq!((&state["text"], &state["step"]["message"]), (&"own.frag".into(), &Value::Null));
        let values = state["step"]["values"].as_array().unwrap();
        let of = |line: u64| {
            let found = values.iter().find(|value| value["line"] == line);
            numbers(found.unwrap_or_else(|| panic!("{values:?}"))["text"].as_str().unwrap())
        };
        let (n, colour) = (of(6), of(7));
        assert!((0..3).all(|at| (colour[at] - 0.25 * n[at]).abs() < 1e-3), "{n:?} {colour:?}");
        let back = window.center("step-back-over");
        window.click_at(back);
        assert_eq!(wait_own(&mut window, "a step back", listed)["step"]["line"], 6);
        for widget in exported::widgets(&window.harness.ctx) {
            let [left, _, width, _] = widget.rect;
            let is_scrolled = widget.id == "editor" || widget.id.starts_with("variable-");
            assert!(is_scrolled || (left >= -1.0 && left + width <= size.x + 1.0), "{size} {widget:?}");
        }
        // An error is marked at its line, and the last good program stays.
        drop_files(&mut window, &[("own.frag", &OWN.replace("gain * n", "gian * n"))]);
        let state = wait_own(&mut window, "the error", |s| s["failed"] == true);
        assert_eq!(state["compiled"], true);
        window.steps(2);
        assert_eq!(window.widget("note-0").value, "7");
        if size == PHONE {
            // The message is over the texts.
            continue;
        }
        let close = window.center("close-texts");
        window.click_at(close);
        window.steps(2);
        let close = window.center("close-shaders");
        window.click_at(close);
        window.steps(2);
        assert!(window.app().session().shaders.is_none());
        let state = window.app().state(&window.harness.ctx);
        assert!(state["messages"].as_array().unwrap().is_empty(), "{}", state["messages"]);
    }
}

#[test]
fn a_pinned_place_stays_when_its_values_take_room_from_the_picture() {
    let place = "#version 330 core\nuniform vec2 resolution;\nout vec4 c;\nvoid main() {\n    vec2 from_middle = \
                 (gl_FragCoord.xy - 0.5 * resolution) / resolution.y;\n    c = vec4(from_middle, 0.0, 1.0);\n}\n";
    let mut window = with_shaders(DESK, &[("own.frag", place)]);
    wait_own(&mut window, "the program", |s| s["compiled"] == true);
    let [left, top, width, height] = window.widget("pane-0").rect;
    let at = pos2(left + 0.5 * width - 60.0, top + 0.5 * height - 30.0);
    window.click_at(at);
    window.steps(4);
    let state = wait_own(&mut window, "the values", listed);
    assert!(window.widget("pane-0").rect[2] < 0.7 * width, "the texts take room");
    let values = state["step"]["values"].as_array().unwrap();
    let found = values.iter().find(|value| value["line"] == 5).unwrap_or_else(|| panic!("{state:#}"));
    let seen = numbers(found["text"].as_str().unwrap());
    assert!((seen[0] + 60.0 / height).abs() < 0.01 && (seen[1] - 30.0 / height).abs() < 0.01, "{seen:?} {height}");
}

#[test]
fn dropped_shaders_whose_loop_never_ends_are_not_drawn() {
    let endless = OWN.replace("    c = vec4(", "    while (n.x > -2.0) n.y += 0.1;\n    c = vec4(");
    let mut window = with_shaders(DESK, &[("own.frag", &endless)]);
    let state = wait_own(&mut window, "a refusal", |s| s["failed"] == true);
    let remark = state["remarks"][0].as_str().unwrap();
    assert!(state["compiled"] == false && remark.starts_with("own.frag:7: the shader does not end"), "{remark}");
    // One that ends takes its place.
    let ending = OWN.replace("    c = vec4(", "    for (int i = 0; i < 50; i++) n.y += 0.1;\n    c = vec4(");
    drop_files(&mut window, &[("own.frag", &ending)]);
    wait_own(&mut window, "a program", |s| s["failed"] == false && s["compiled"] == true);
}

#[test]
fn no_pixel_and_no_size_of_the_window_makes_own_shaders_fail() {
    let odd = "#version 330 core\nin vec3 normal;\nout vec4 c;\nfloat a[3];\nvoid main() {\n    if (normal.x > 0.5) \
               discard;\n    c = vec4(a[int(normal.y * 9.0)], sqrt(-1.0), 1.0 / 0.0, dFdx(normal.z));\n}\n";
    let mut window = with_shaders(DESK, &[("odd.frag", odd)]);
    wait_own(&mut window, "the program", |s| s["compiled"] == true);
    for size in [DESK, vec2(320.0, 420.0), PHONE, vec2(900.0, 430.0)] {
        window.harness.set_size(size);
        window.steps(3);
        let [left, top, width, height] = window.widget("pane-0").rect;
        for (x, y) in [(0.5, 0.5), (0.01, 0.01), (0.99, 0.99), (0.4, 0.6)] {
            window.click_at(pos2(left + x * width, top + y * height));
            wait_own(&mut window, "an answer", |s| s["step"].is_null() || listed(s));
        }
        for key in [Key::F10, Key::F11, Key::F9, Key::F9] {
            window.press(Modifiers::SHIFT, key);
        }
        window.press(Modifiers { shift: true, ..Modifiers::ALT }, Key::ArrowLeft);
        wait_own(&mut window, "an answer", |s| s["step"].is_null() || listed(s));
    }
}
