//! No display, and files that cannot be opened.

use crate::driven::{Window, without_display};

#[test]
fn without_a_display_it_says_so() {
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
fn alone_without_a_display_it_prints_its_help() {
    let (code, words) = without_display(&[], None);
    assert_eq!(code, 2);
    assert!(words.contains("Usage: gonio") && words.contains("\n  render "), "{words}");
    assert!(words.contains("there is no display for the window"), "{words}");
}

#[test]
fn a_file_that_cannot_be_opened_leaves_everything_as_it_was() {
    let mut window = Window::open(1024, 640, &["builtin:cube"]);
    let before = window.state();
    window.write("bad.obj", "this is no model\n");
    for (path, words) in [("none.obj", "there is no such file"), ("bad.obj", "bad.obj")] {
        window.key("ctrl+o");
        window.find("path");
        window.type_text(path);
        window.key("Return");
        let state = window.wait(path, |s| s["error"].as_str().is_some_and(|e| e.contains(words)));
        assert_eq!(state["title"], before["title"]);
        assert_eq!(state["scene"], before["scene"]);
    }
    // They stay until they are read.
    let state = window.rest();
    assert_eq!(state["messages"].as_array().unwrap().len(), 2);
    let id = state["messages"][0]["id"].as_u64().unwrap();
    window.click(&format!("dismiss-{id}"));
    window.wait("one message less", |s| s["messages"].as_array().unwrap().len() == 1);
}
