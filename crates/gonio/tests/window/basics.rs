//! Undo, light and dark, small windows, idling, and no display at all.

use crate::driven::{Window, without_display};
use serde_json::Value;

#[test]
fn keys_undo_and_redo() {
    let mut window = Window::open(1024, 640, &["builtin:cube"]);
    let before = window.rest();
    assert_eq!(before["undo"], false);
    let (x, y) = window.find("pane-0");
    // In steps, as by hand: a drag begins with a press and a movement.
    let pause = || std::thread::sleep(std::time::Duration::from_millis(300));
    window.do_it(&["mousemove", &x.to_string(), &y.to_string()]);
    pause();
    window.do_it(&["mousedown", "1"]);
    for step in 1..=4 {
        pause();
        window.do_it(&["mousemove", &(x + 15 * step).to_string(), &(y + 5 * step).to_string()]);
    }
    pause();
    window.do_it(&["mouseup", "1"]);
    let turned = window.wait("a step to undo", |s| s["undo"] == true);
    assert_ne!(turned["scene"]["camera"], before["scene"]["camera"]);
    window.key("ctrl+z");
    let undone = window.wait("a step to redo", |s| s["redo"] == true);
    assert_eq!(undone["scene"], before["scene"]);
    window.key("ctrl+y");
    let again = window.wait("no step to redo", |s| s["redo"] == false);
    assert_eq!(again["scene"]["camera"], window.state()["scene"]["camera"]);
    assert_ne!(again["scene"]["camera"], before["scene"]["camera"]);
}

#[test]
fn the_theme_is_chosen_and_remembered() {
    let mut window = Window::open(1024, 640, &["builtin:cube"]);
    let dark = window.state()["dark"].as_bool().unwrap();
    window.click("theme");
    window.wait("the other theme", |s| s["dark"] == !dark);
    let kept = std::fs::read_to_string(window.path("home/gonio/window.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&kept).unwrap()["dark"], !dark);
}

#[test]
fn small_windows_clip_no_widget() {
    for (width, height) in [(1024, 640), (360, 740)] {
        let mut window = Window::open(width, height, &["builtin:cube"]);
        let state = window.rest();
        assert_eq!(state["size"], serde_json::json!([f64::from(width), f64::from(height)]));
        let widgets = state["widgets"].as_array().unwrap();
        // The bars only; widgets of the side panel can be scrolled to.
        for id in ["undo", "redo", "frame", "theme", "help", "pane-0", "tab-lights", "tab-frame"] {
            let widget = widgets.iter().find(|w| w["id"] == id).unwrap_or_else(|| panic!("{id} is missing"));
            let rect: Vec<f64> = widget["rect"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
            let inside = rect[0] >= 0.0
                && rect[1] >= 0.0
                && rect[0] + rect[2] <= f64::from(width) + 0.5
                && rect[1] + rect[3] <= f64::from(height) + 0.5;
            assert!(inside && rect[2] > 4.0 && rect[3] > 4.0, "{id} at {rect:?} in {width}x{height}");
        }
    }
}

#[test]
fn an_idle_window_uses_no_processor_time() {
    let mut window = Window::open(1024, 640, &["builtin:cube"]);
    let before = window.rest();
    let cpu = window.cpu_seconds();
    std::thread::sleep(std::time::Duration::from_secs(3));
    let after = window.state();
    assert_eq!(after["frame"]["frames"], before["frame"]["frames"], "frames were painted although nothing changed");
    // The file watcher checks two files twice a second; 0.02 s is the resolution of the system's clock.
    let used = window.cpu_seconds() - cpu;
    assert!(used <= 0.02, "{used} s of processor time in 3 s");
}

#[test]
fn without_a_display_view_reports_an_error() {
    let (code, words) = without_display(&["view"], None);
    assert_eq!(code, 2);
    assert!(words.contains("there is no display") && words.contains("gonio render"), "{words}");
    assert_eq!(words.lines().count(), 1, "{words}");

    let (code, words) = without_display(&["view"], Some(":987654"));
    assert_eq!(code, 2);
    assert!(words.contains("the display cannot be reached") && words.contains("DISPLAY"), "{words}");
    assert_eq!(words.lines().count(), 1, "{words}");
}

#[test]
fn gonio_alone_without_a_display_prints_its_help() {
    let (code, words) = without_display(&[], None);
    assert_eq!(code, 2);
    assert!(words.contains("Usage: gonio") && words.contains("\n  render "), "{words}");
    assert!(words.contains("there is no display for the window"), "{words}");
}
