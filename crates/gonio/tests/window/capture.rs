//! RenderDoc captures from the window: RenderDoc itself opens them, and the tests compare them with the window's own record.

use crate::driven::Window;
use crate::files::answer;
use crate::renderdoc;
use serde_json::Value;

/// A window with the recorded frame in its panel; RenderDoc is loaded if `preloaded`.
fn open(preloaded: bool) -> Window {
    let mut window = Window::open_with(1280, 800, &["builtin:still-life"], |command| {
        if preloaded {
            command.env("LD_PRELOAD", "librenderdoc.so");
        }
    });
    window.rest();
    window.click("tab-frame");
    window.wait("the record", |s| !s["recorded_frame"].is_null());
    window.rest();
    window
}

fn messages(state: &Value) -> Vec<&str> {
    state["messages"].as_array().unwrap().iter().map(|message| message["text"].as_str().unwrap()).collect()
}

/// The files in the window's folder, without those of every window.
fn files(window: &Window) -> Vec<String> {
    let entries = std::fs::read_dir(window.folder.path()).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name != "home" && !name.contains("state.json")).collect()
}

#[test]
fn renderdoc_opens_a_capture_of_the_window_and_finds_its_draws() {
    let mut window = open(true);
    window.click("capture");
    answer(&mut window, "the frame.rdc");
    let state = window.wait("a message", |s| s["messages"].as_array().is_some_and(|list| !list.is_empty()));
    let expected = "The capture is saved: `qrenderdoc \"the frame.rdc\"` opens it in RenderDoc";
    assert_eq!(messages(&state), [expected], "RenderDoc: {}", renderdoc::INSTALL);
    assert_eq!(state["error"], Value::Null);
    // The folder that RenderDoc wrote to is gone.
    assert_eq!(files(&window), ["the frame.rdc"]);

    let capture = renderdoc::read(&window.path("the frame.rdc"));
    assert_eq!(capture["driver"], "OpenGL");
    // One picture, and nothing of the window around it: each object once in its group, then the conversion for the display.
    let draws = capture["draws"].as_array().unwrap();
    let group = |draw: &Value| draw["groups"].as_array().unwrap().last().unwrap().as_str().unwrap().to_owned();
    assert!(draws.iter().all(|draw| draw["groups"][0] == "paint"), "{draws:?}");
    let (output, drawn) = draws.split_last().unwrap();
    assert_eq!(group(output), "output");
    let found: Vec<(String, u64)> = drawn.iter().map(|draw| (group(draw), draw["indices"].as_u64().unwrap())).collect();
    let recorded = state["recorded_frame"]["draws"].as_array().unwrap();
    let listed: Vec<(String, u64)> = recorded
        .iter()
        .filter(|draw| draw["title"] != "output")
        .map(|draw| (draw["title"].as_str().unwrap().to_owned(), draw["vertices"].as_u64().unwrap()))
        .collect();
    assert!(!listed.is_empty());
    assert_eq!(found, listed);
    // The shader that draws the window, with the scene's camera.
    let camera: Vec<f64> = serde_json::from_value(state["scene"]["camera"]["position"].clone()).unwrap();
    for draw in drawn {
        assert!(draw["program"].as_str().unwrap().starts_with("scene phong blinn_phong"), "{}", draw["program"]);
        let eye: Vec<f64> = serde_json::from_value(draw["uniforms"]["eye_in_world"].clone()).unwrap();
        // Uniforms are f32.
        assert!(eye.iter().zip(&camera).all(|(a, b)| (a - b).abs() < 1e-5), "{eye:?}, not {camera:?}");
    }

    // A second one replaces it, and the window goes on drawing.
    window.write("the frame.rdc", "old");
    window.click("capture");
    answer(&mut window, "the frame.rdc");
    window.wait("the message again", |s| s["messages"][0]["times"] == 2);
    assert!(std::fs::read(window.path("the frame.rdc")).unwrap().starts_with(b"RDOC"));
    let before = window.rest()["frame"]["pictures"].as_u64();
    window.click("term-diffuse");
    window.wait("another picture", |s| s["frame"]["pictures"].as_u64() > before);
}

#[test]
fn a_capture_that_cannot_be_written_is_one_sentence_and_leaves_nothing() {
    let mut window = open(true);
    std::fs::create_dir(window.path("taken")).unwrap();
    for (place, words) in [("nowhere/a.rdc", "no such folder"), ("taken", "this is a folder")] {
        window.click("capture");
        answer(&mut window, place);
        let state = window.wait(place, |s| s["error"].as_str().is_some_and(|error| error.contains(words)));
        assert!(state["error"].as_str().unwrap().starts_with(&format!("`{place}` could not be written: ")));
        window.rest();
    }
    assert_eq!(files(&window), ["taken"]);
}

#[test]
fn without_renderdoc_the_button_says_how_to_start_the_window() {
    let mut window = open(false);
    window.click("capture");
    let state = window.wait("a message", |s| s["messages"].as_array().is_some_and(|list| !list.is_empty()));
    let [message] = messages(&state)[..] else { panic!("{:?}", messages(&state)) };
    assert!(message.contains("`LD_PRELOAD=librenderdoc.so gonio view`"), "{message}");
    assert_eq!((&state["asking"], &state["error"]), (&Value::Null, &Value::Null));
}
