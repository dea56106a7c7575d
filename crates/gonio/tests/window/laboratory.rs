//! The laboratory: a student's files, broken and mended in another editor and in gonio's own.

use crate::driven::Window;
use serde_json::Value;
use std::process::Command;

/// A folder `mine` with exercise 04's right answer.
fn answered() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args(["lab", "reference", "ex04", "-o", "mine", "--quiet"])
        .current_dir(folder.path())
        .status()
        .unwrap();
    assert!(status.success());
    folder
}

fn said(state: &Value) -> Vec<(String, u64, String)> {
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let notes = state["laboratory"]["said"].as_array().unwrap();
    notes.iter().map(|n| (word(&n["file"]), n["line"].as_u64().unwrap_or(0), word(&n["kind"]))).collect()
}

#[test]
fn what_is_broken_on_disk_keeps_the_last_picture_and_is_said_at_its_line() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
    let state = window.wait("the program", |s| s["laboratory"]["drawn"] == true);
    assert_eq!((said(&state).len(), &state["laboratory"]["older"]), (0, &Value::Bool(false)));
    let path = window.path("mine/reference.frag");
    let right = std::fs::read_to_string(&path).unwrap();
    let line = right.lines().position(|line| line.contains("normalize(v_normal)")).unwrap();
    std::fs::write(&path, right.replace("normalize(v_normal)", "normalise(v_normal)")).unwrap();
    let state = window.wait("the error", |s| s["laboratory"]["older"] == true);
    assert_eq!(state["laboratory"]["drawn"], true);
    assert_eq!(said(&state)[0], ("reference.frag".into(), line as u64 + 1, "error".into()));
    window.find("older-program");
    std::fs::write(&path, &right).unwrap();
    window.wait("it to be mended", |s| {
        s["laboratory"]["older"] == false && s["laboratory"]["said"] == Value::Array(vec![])
    });
    window.key("ctrl+Return");
    let state = window.wait("a verdict", |s| s["laboratory"]["verdict"].is_object());
    assert_eq!(state["laboratory"]["verdict"]["word"], "correct", "{}", state["laboratory"]["verdict"]);
    // A mistake that compiles is named with its line, and the verdict of before is told to be of other texts.
    let vertex = window.path("mine/reference.vert");
    let text = std::fs::read_to_string(&vertex).unwrap();
    std::fs::write(&vertex, text.replace("mat3(itM)", "mat3(M)")).unwrap();
    window.wait("it to be read again", |s| s["laboratory"]["verdict"]["stale"] == true);
    window.key("ctrl+Return");
    let state = window.wait("another verdict", |s| {
        s["laboratory"]["verdict"]["stale"] == false && s["laboratory"]["checking"] == false
    });
    assert_eq!(state["laboratory"]["verdict"]["mistakes"][0], "normal-by-model-matrix");
    assert!(
        said(&state).iter().any(|(file, _, kind)| file == "reference.vert" && kind == "mistake"),
        "{:?}",
        said(&state)
    );
}

#[test]
fn what_is_written_here_is_undone_and_saved_and_never_lost() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
    window.wait("the program", |s| s["laboratory"]["drawn"] == true);
    let path = window.path("mine/reference.frag");
    let right = std::fs::read_to_string(&path).unwrap();
    window.click("editor");
    window.key("ctrl+Home");
    window.type_text("oops ");
    window.wait("the error", |s| s["laboratory"]["older"] == true && s["laboratory"]["files"][0]["changed"] == true);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), right, "nothing is saved that nobody asked for");
    // Another editor writes meanwhile: what was written here stays, and the person is asked.
    std::fs::write(&path, format!("{right}\n// of another editor\n")).unwrap();
    let state = window.wait("the conflict", |s| s["laboratory"]["files"][0]["conflict"] == true);
    assert_eq!(state["laboratory"]["files"][0]["changed"], true);
    window.click("take-other");
    window.wait("what is on the disk", |s| {
        s["laboratory"]["files"][0]["changed"] == false && s["laboratory"]["older"] == false
    });
    window.click("editor");
    window.key("ctrl+End");
    window.type_text("// mine");
    window.wait("a change", |s| s["laboratory"]["files"][0]["changed"] == true);
    window.key("ctrl+s");
    window.wait("it to be saved", |s| s["laboratory"]["files"][0]["changed"] == false);
    assert!(std::fs::read_to_string(&path).unwrap().ends_with("// of another editor\n// mine"));
    window.key("ctrl+z");
    window.wait("a step back", |s| s["laboratory"]["files"][0]["changed"] == true);
}

#[test]
fn a_shader_that_never_ends_does_not_hold_up_the_window() {
    let folder = answered();
    let path = folder.path().join("mine/reference.frag");
    let text = std::fs::read_to_string(&path).unwrap();
    let endless =
        text.replacen("void main() {", "void main() {\n    float z = 1.0;\n    while (z > 0.0) { z += 1e-9; }", 1);
    std::fs::write(&path, endless).unwrap();
    let mut window = Window::exercise_in(folder, 1000, 640, &["ex04", "mine"]);
    // Not `tried`: a driver with a bound of its own on loops may be done before this first asks.
    window.wait("it to be tried elsewhere", |s| s["laboratory"]["trials"] == 1);
    // The window goes on meanwhile.
    window.click("page-given");
    window.wait("another page", |s| s["laboratory"]["page"] == "given");
    window.write("mine/reference.frag", &text);
    window.wait("the one that ends", |s| s["laboratory"]["drawn"] == true && s["laboratory"]["tried"] == false);
}
