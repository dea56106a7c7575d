//! Exercises: a student's files, broken and fixed in another editor and in gonio's own.

use crate::driven::Window;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// A folder `mine` with the reference solution of exercise 04.
pub fn answered() -> tempfile::TempDir {
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
    let notes = state["exercise"]["marks"].as_array().unwrap();
    notes.iter().map(|n| (word(&n["file"]), n["line"].as_u64().unwrap_or(0), word(&n["kind"]))).collect()
}

#[test]
fn a_file_broken_on_disk_keeps_the_last_picture_and_is_reported_with_its_line() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
    let state = window.wait("the program", |s| s["exercise"]["drawn"] == true);
    assert_eq!((said(&state).len(), &state["exercise"]["older"]), (0, &Value::Bool(false)));
    let path = window.path("mine/reference.frag");
    let right = std::fs::read_to_string(&path).unwrap();
    let line = right.lines().position(|line| line.contains("normalize(v_normal)")).unwrap();
    std::fs::write(&path, right.replace("normalize(v_normal)", "normalise(v_normal)")).unwrap();
    let state = window.wait("the error", |s| s["exercise"]["older"] == true);
    assert_eq!(state["exercise"]["drawn"], true);
    assert_eq!(said(&state)[0], ("reference.frag".into(), line as u64 + 1, "error".into()));
    window.find("older-program");
    std::fs::write(&path, &right).unwrap();
    window
        .wait("it to be mended", |s| s["exercise"]["older"] == false && s["exercise"]["marks"] == Value::Array(vec![]));
    window.key("ctrl+Return");
    let state = window.wait("a verdict", |s| s["exercise"]["verdict"].is_object());
    assert_eq!(state["exercise"]["verdict"]["word"], "correct", "{}", state["exercise"]["verdict"]);
    // A mistake that compiles is named with its line, and the earlier verdict is marked as outdated.
    let vertex = window.path("mine/reference.vert");
    let text = std::fs::read_to_string(&vertex).unwrap();
    std::fs::write(&vertex, text.replace("mat3(itM)", "mat3(M)")).unwrap();
    window.wait("it to be read again", |s| s["exercise"]["verdict"]["stale"] == true);
    window.key("ctrl+Return");
    let state = window
        .wait("another verdict", |s| s["exercise"]["verdict"]["stale"] == false && s["exercise"]["checking"] == false);
    assert_eq!(state["exercise"]["verdict"]["mistakes"][0], "normal-by-model-matrix");
    assert!(
        said(&state).iter().any(|(file, _, kind)| file == "reference.vert" && kind == "mistake"),
        "{:?}",
        said(&state)
    );
}

#[test]
fn edited_text_is_undone_saved_and_never_lost() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
    window.wait("the program", |s| s["exercise"]["drawn"] == true);
    let path = window.path("mine/reference.frag");
    let right = std::fs::read_to_string(&path).unwrap();
    window.click("editor");
    window.key("ctrl+Home");
    window.type_text("oops ");
    window.wait("the error", |s| s["exercise"]["older"] == true && s["exercise"]["files"][0]["changed"] == true);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), right, "nothing is saved that nobody asked for");
    // Another editor writes meanwhile: the edited text stays, and the user is asked.
    std::fs::write(&path, format!("{right}\n// of another editor\n")).unwrap();
    let state = window.wait("the conflict", |s| s["exercise"]["files"][0]["conflict"] == true);
    assert_eq!(state["exercise"]["files"][0]["changed"], true);
    window.click("take-other");
    window.wait("what is on the disk", |s| {
        s["exercise"]["files"][0]["changed"] == false && s["exercise"]["older"] == false
    });
    window.click("editor");
    window.key("ctrl+End");
    window.type_text("// mine");
    window.wait("a change", |s| s["exercise"]["files"][0]["changed"] == true);
    window.key("ctrl+s");
    window.wait("it to be saved", |s| s["exercise"]["files"][0]["changed"] == false);
    assert!(std::fs::read_to_string(&path).unwrap().ends_with("// of another editor\n// mine"));
    window.key("ctrl+z");
    window.wait("a step back", |s| s["exercise"]["files"][0]["changed"] == true);
}

#[test]
fn an_endless_shader_does_not_block_the_window() {
    let folder = answered();
    let path = folder.path().join("mine/reference.frag");
    let text = std::fs::read_to_string(&path).unwrap();
    let endless =
        text.replacen("void main() {", "void main() {\n    float z = 1.0;\n    while (z > 0.0) { z += 1e-9; }", 1);
    std::fs::write(&path, endless).unwrap();
    let mut window = Window::exercise_in(folder, 1000, 640, &["ex04", "mine"]);
    // Not `tried`: a driver that limits loops itself may have finished already.
    window.wait("it to be tried elsewhere", |s| s["exercise"]["trials"] == 1);
    // The window stays responsive meanwhile.
    window.click("page-variables");
    window.wait("another page", |s| s["exercise"]["page"] == "variables");
    window.write("mine/reference.frag", &text);
    window.wait("the one that ends", |s| s["exercise"]["drawn"] == true && s["exercise"]["tried"] == false);
}

/// Opens files by the path field, which replaces a missing file dialog.
fn open(window: &mut Window, path: &str) {
    window.key("ctrl+o");
    window.find("path");
    window.type_text(path);
    window.key("Return");
}

#[test]
fn files_of_the_user_are_opened_watched_and_saved_in_place() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04"]);
    window.wait("the program", |s| s["exercise"]["drawn"] == true && s["exercise"]["file"] == "start.frag");
    window.click("editor");
    window.key("ctrl+Home");
    window.type_text("// not saved yet ");
    window.wait("a change", |s| {
        s["exercise"]["files"].as_array().is_some_and(|f| f.iter().any(|f| f["changed"] == true))
    });
    open(&mut window, "mine");
    let state = window.wait("the files", |s| s["exercise"]["file"] == "reference.frag");
    assert_eq!((&state["exercise"]["before"], &state["error"]), (&1.into(), &Value::Null));
    window.wait("the picture", |s| s["exercise"]["drawn"] == true && s["exercise"]["older"] == false);
    // They are the files on disk: changes by another editor are loaded, and edits are saved to them.
    let path = window.path("mine/reference.frag");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replacen("void main()", "void mian()", 1)).unwrap();
    window.wait("the error", |s| s["exercise"]["older"] == true);
    std::fs::write(&path, &text).unwrap();
    window.wait("it to be mended", |s| s["exercise"]["older"] == false);
    window.click("editor");
    window.key("ctrl+End");
    window.type_text("// mine");
    window.key("ctrl+s");
    window.wait("it to be saved", |s| {
        s["exercise"]["files"].as_array().is_some_and(|f| f.iter().all(|f| f["changed"] == false))
    });
    assert!(std::fs::read_to_string(&path).unwrap().ends_with("// mine"));
    // The earlier text is still there.
    window.click("put-back");
    let state = window.wait("what was before", |s| s["exercise"]["file"] == "start.frag");
    assert!(state["exercise"]["files"].as_array().unwrap().iter().any(|f| f["changed"] == true));
    // A file that does not fit the exercise is reported in one sentence and changes nothing.
    window.write("photo.dat", "\u{0}\u{1}");
    open(&mut window, "photo.dat");
    let state = window.wait("the sentence", |s| s["error"].is_string());
    assert!(state["error"].as_str().unwrap().starts_with("ex04 does not read photo.dat"), "{}", state["error"]);
    assert_eq!(state["exercise"]["file"], "start.frag");
}

#[test]
fn six_faces_are_loaded_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let panorama = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../exercises/s1-panorama-to-cubemap/panorama.png");
    let status = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args(["environment", "convert", &panorama.to_string_lossy(), "faces", "--quiet"])
        .current_dir(folder.path())
        .status()
        .unwrap();
    assert!(status.success());
    let mut window = Window::exercise_in(folder, 1100, 700, &["s1"]);
    window.wait("the exercise", |s| s["exercise"]["file"] == "start.frag");
    open(&mut window, "faces");
    let state = window.wait("the faces", |s| s["exercise"]["before"] == 1);
    let shown = state["exercise"]["files"].as_array().unwrap().iter().filter(|file| file["shown"] == true).count();
    assert_eq!(shown, 6, "{}", state["exercise"]["files"]);
    window.key("ctrl+Return");
    let state = window.wait("a verdict", |s| s["exercise"]["verdict"].is_object());
    assert_eq!(state["exercise"]["verdict"]["word"], "correct", "{}", state["exercise"]["verdict"]);
}
