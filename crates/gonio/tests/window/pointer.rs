//! Dragging a light and probing a point with a real pointer.

use crate::driven::Window;
use serde_json::Value;

const SCENE: &str = r#"
[camera]
position = [0.0, 0.0, 6.0]
target = [0.0, 0.0, 0.0]
[[object]]
model = "builtin:sphere-smooth"
[[light]]
kind = "point"
name = "lamp"
position = [1.3, 1.2, 1.0]
"#;

/// A window with the scene above, after the first frames, in which the layout still changes.
fn open() -> Window {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let mut window = Window::open_in(folder, 1280, 800, &["scene.toml"]);
    window.rest();
    window
}

/// Does something with the pointer, and waits until the window has painted a frame since.
fn noticed(window: &mut Window, args: &[&str]) {
    let before = window.state()["frame"]["frames"].as_u64();
    window.do_it(args);
    window.wait("the pointer to be noticed", |s| s["frame"]["frames"].as_u64() > before);
}

fn move_to(window: &mut Window, (x, y): (i64, i64)) {
    noticed(window, &["mousemove", &x.to_string(), &y.to_string()]);
}

#[test]
fn a_light_is_dragged_with_a_real_pointer() {
    let mut window = open();
    let (x, y) = window.find("light-0-handle");
    let before = window.state();
    move_to(&mut window, (x, y));
    // The frame that was noticed may be an earlier one, in which the pointer was not over the handle yet.
    window.rest();
    noticed(&mut window, &["mousedown", "1"]);
    for step in 1..=4 {
        move_to(&mut window, (x - 20 * step, y + 10 * step));
    }
    noticed(&mut window, &["mouseup", "1"]);
    let position = |state: &Value| state["scene"]["light"][0]["position"].clone();
    let after = window
        .wait("the light to have moved, and a step to undo", |s| position(s) != position(&before) && s["undo"] == true);
    let drawn = |state: &Value| state["frame"]["pictures"].as_u64();
    assert!(drawn(&after) > drawn(&before), "the picture was not drawn again");
    assert_eq!(after["scene"]["camera"], before["scene"]["camera"]);
    assert_eq!(after["selection"]["light"], 0);
    // One pixel for each rounding: of the pointer, of the light's numbers and of the handle's middle.
    window.rest();
    let (to_x, to_y) = window.find("light-0-handle");
    assert!(
        (to_x - (x - 80)).abs() <= 3 && (to_y - (y + 40)).abs() <= 3,
        "it is at {to_x}, {to_y}; it was at {x}, {y}"
    );
    window.key("ctrl+z");
    window.wait("undone", |s| position(s) == position(&before));
}

#[test]
fn a_click_in_the_picture_probes_it() {
    let mut window = open();
    let (x, y) = window.find("pane-0");
    move_to(&mut window, (x + 25, y - 30));
    window.do_it(&["click", "1"]);
    let state = window.wait("the probe to have read", |s| s["probe"]["gpu"].is_object());
    assert_eq!(state["tab"], "Probe");
    assert_eq!(state["probe"]["pinned"], true);
    let difference = state["probe"]["gpu"]["difference"].as_f64();
    // The project's tolerance for the GPU against the reference.
    assert!(difference.is_some_and(|d| d < 1e-3), "{}", state["probe"]);
    assert!(state["probe"]["triangle"].is_u64());
    window.key("Escape");
    window.wait("the point to be let go", |s| s["probe"].is_null() || s["probe"]["pinned"] == false);
}
