//! Edits of a scene that were not saved are kept for the next window.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod support;
#[path = "support/waiting.rs"]
mod waiting;

use egui::{Key, Modifiers, vec2};
use serde_json::Value;
use support::{Here, Window};

const SIZE: egui::Vec2 = vec2(1280.0, 800.0);

fn open(here: &Here, input: &str) -> Window {
    let mut window = Window::on(here.clone(), input, SIZE);
    window.until("the scene", |state| state["loaded"] == true && state["busy"].is_null());
    window.steps(3);
    window
}

fn messages(state: &Value) -> Vec<String> {
    state["messages"].as_array().unwrap().iter().map(|message| message["text"].as_str().unwrap().to_owned()).collect()
}

/// Drags the first light, and waits until that is kept.
fn edit(window: &mut Window) {
    let before = window.here.drafts.borrow().clone();
    window.drag(window.center("light-0-handle"), vec2(-30.0, 20.0));
    let here = window.here.clone();
    window.until("the draft", move |_| *here.drafts.borrow() != before);
}

#[test]
fn edits_are_offered_in_the_next_window_and_restoring_them_is_a_step() {
    let here = Here::default();
    let mut first = open(&here, "builtin:three-spheres");
    let original = first.app().document().scene.clone();
    edit(&mut first);
    let edited = first.app().document().scene.clone();
    assert_ne!(edited.lights, original.lights);
    drop(first);

    // Another scene has nothing to do with them.
    assert_eq!(messages(&open(&here, "builtin:cube").state()), [""; 0]);
    let mut next = open(&here, "builtin:three-spheres");
    let kept = "Unsaved changes to three-spheres from less than a minute ago were kept";
    assert_eq!(messages(&next.state()), [kept]);
    assert_eq!(next.app().document().scene.lights, original.lights, "nothing is restored unasked");
    next.click("restore-draft");
    next.until("the lights", |state| messages(state).is_empty() && state["busy"].is_null());
    assert_eq!(next.app().document().scene.lights, edited.lights);
    next.steps(3);
    // What is undone needs no draft.
    next.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(next.app().document().scene.lights, original.lights);
    next.steps(3);
    assert_eq!(here.drafts.borrow().len(), 0);
}

#[test]
fn a_draft_stays_until_it_is_discarded_and_new_edits_do_not_replace_it() {
    let here = Here::default();
    edit(&mut open(&here, "builtin:three-spheres"));
    let kept = here.drafts.borrow().clone();
    let mut next = open(&here, "builtin:three-spheres");
    edit(&mut next);
    let drafts = here.drafts.borrow().clone();
    assert_eq!(drafts.len(), 2);
    assert!(kept.iter().all(|(key, text)| drafts.get(key) == Some(text)), "the offered one is as it was");
    // Dismissing the message is no decision about the draft.
    let id = next.state()["messages"][0]["id"].as_u64().unwrap();
    next.click(&format!("dismiss-{id}"));
    next.steps(3);
    assert_eq!(here.drafts.borrow().len(), 2);
    drop(next);
    let mut last = open(&here, "builtin:three-spheres");
    last.click("discard-draft");
    last.until("no message", |state| messages(state).is_empty());
    assert!(kept.keys().all(|key| !here.drafts.borrow().contains_key(key)));
}

#[test]
fn a_damaged_draft_is_reported() {
    let here = Here::default();
    edit(&mut open(&here, "builtin:three-spheres"));
    here.drafts.borrow_mut().values_mut().for_each(|text| *text = "{".into());
    let told = messages(&open(&here, "builtin:three-spheres").state());
    assert!(told.len() == 1 && told[0].starts_with("the draft of three-spheres is damaged"), "{told:?}");
}
