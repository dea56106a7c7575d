//! Hostile submissions do not crash the window, and edited text survives its end.

use crate::driven::Window;
use crate::exercise::answered;
use serde_json::Value;
use std::path::Path;

/// The state of the file in the editor.
fn shown(state: &Value) -> Value {
    let exercise = &state["exercise"];
    let files = exercise["files"].as_array().unwrap();
    files.iter().find(|file| file["name"] == exercise["file"]).cloned().unwrap()
}

/// Waits until a draft that contains this text is on disk.
#[track_caller]
fn drafted(window: &mut Window, text: &str) {
    let folder = window.path("home/gonio/drafts");
    let files = |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    let holds = |path: &Path| std::fs::read_to_string(path).is_ok_and(|draft| draft.contains(text));
    window.wait("the draft", |_| files(&folder).flat_map(|window| files(&window)).any(|file| holds(&file)));
}

#[test]
fn hostile_shaders_are_reported_and_the_window_survives() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
    window.wait("the program", |s| s["exercise"]["drawn"] == true);
    let right = std::fs::read_to_string(window.path("mine/reference.frag")).unwrap();
    let long = format!("void main() {{\n    float x = 1.0{};", "+0.0".repeat(40_000));
    let doubling: String = (1..40).map(|n| format!("#define M{n} M{} M{}\n", n - 1, n - 1)).collect();
    let macros = format!("#define M0 x += 1.0;\n{doubling}void main() {{ float x = 0.0; M39");
    // The array is used, or the compiler would remove it.
    for hostile in [
        long.as_str(),
        "void main() {\n    int a[2147483647]; a[int(gl_FragCoord.x)] = 1; if (a[7] == 3) discard;",
        &macros,
    ] {
        window.write("mine/reference.frag", &right.replacen("void main() {", hostile, 1));
        let state = window.wait("a sentence", |s| s["exercise"]["older"] == true);
        let exercise = &state["exercise"];
        let errors = exercise["marks"].as_array().unwrap().iter().filter(|note| note["kind"] == "error").count();
        assert!(exercise["unusable"].is_string() || errors > 0, "{exercise}");
        assert_eq!(exercise["drawn"], true, "the last picture stays");
        // The text can be edited and fixed.
        window.click_corner("editor");
        window.key("ctrl+Home");
        window.type_text("// ");
        window.wait("a change", |s| shown(s)["changed"] == true);
        window.write("mine/reference.frag", &right);
        window.wait("the conflict", |s| shown(s)["conflict"] == true);
        window.click("take-other");
        window.wait("the picture", |s| s["exercise"]["older"] == false && shown(s)["changed"] == false);
    }
}

#[test]
fn unsaved_text_survives_a_killed_window() {
    let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
    window.wait("the program", |s| s["exercise"]["drawn"] == true);
    let path = window.path("mine/reference.frag");
    let right = std::fs::read_to_string(&path).unwrap();
    window.click("editor");
    window.key("ctrl+Home");
    window.type_text("// never saved ");
    window.key("ctrl+End");
    window.type_text("// at the end");
    drafted(&mut window, "// at the end");
    let folder = window.kill();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), right, "a draft must not be written to the file");

    let mut window = Window::exercise_in(folder, 1100, 700, &["ex04", "mine"]);
    let state = window.wait("the draft", |s| shown(s)["restored"] == true);
    assert_eq!((&shown(&state)["changed"], &shown(&state)["conflict"]), (&true.into(), &false.into()));
    window.find("restored");
    // Discarding removes the draft from disk, and undo restores it.
    window.click("discard-restored");
    window.wait("the saved text", |s| shown(s)["changed"] == false && s["exercise"]["drafts"] == 0);
    window.click("undo");
    drafted(&mut window, "// at the end");
    // Saving writes the text to its file and removes the draft.
    window.key("ctrl+s");
    window.wait("it to be saved", |s| shown(s)["changed"] == false && s["exercise"]["drafts"] == 0);
    let saved = std::fs::read_to_string(&path).unwrap();
    assert!(saved.starts_with("// never saved ") && saved.ends_with("// at the end"), "{saved}");
    let folder = window.kill();
    let mut window = Window::exercise_in(folder, 1100, 700, &["ex04", "mine"]);
    let state = window.wait("the program", |s| s["exercise"]["drawn"] == true);
    assert_eq!(shown(&state)["restored"], false);
}

#[test]
fn a_draft_and_a_changed_file_are_both_kept_until_one_is_chosen() {
    for choice in ["take-other", "keep-mine"] {
        let mut window = Window::exercise_in(answered(), 1100, 700, &["ex04", "mine"]);
        window.wait("the program", |s| s["exercise"]["drawn"] == true);
        window.click("editor");
        window.key("ctrl+Home");
        window.type_text("// typed ");
        drafted(&mut window, "// typed ");
        let path = window.path("mine/reference.frag");
        let folder = window.kill();
        let other = format!("// of another editor\n{}", std::fs::read_to_string(&path).unwrap());
        std::fs::write(&path, &other).unwrap();

        let mut window = Window::exercise_in(folder, 1100, 700, &["ex04", "mine"]);
        window.wait("both texts", |s| shown(s)["restored"] == true && shown(s)["conflict"] == true);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), other);
        window.click(choice);
        window.wait(choice, |s| {
            shown(s)["changed"] == false && shown(s)["conflict"] == false && s["exercise"]["drafts"] == 0
        });
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.starts_with("// typed "), choice == "keep-mine", "{choice}");
        assert_eq!(text == other, choice != "keep-mine", "{choice}");
    }
}
