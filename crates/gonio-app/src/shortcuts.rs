//! Keyboard shortcuts, and their list.

use crate::action::Action;
use crate::document::{Document, PaneOverlay, VIEW_KEYS};
use crate::saving::Product;
use crate::scene_view::navigation;
use crate::session::Session;
use egui::{Event, Key, KeyboardShortcut, Modifiers, Ui};
use gonio_scene::{SpecialView, ViewSpec};

/// A row of the table: a key, its action, and its description.
struct Shortcut {
    /// The heading in the list.
    group: &'static str,
    /// The key in the list; empty if another row lists it.
    written: &'static str,
    /// The description in the list.
    what: &'static str,
    /// The key itself; `None` if the scene view or egui handles it.
    key: Option<Pressed>,
}

/// Modifiers, key and action.
type Pressed = (Modifiers, Key, fn() -> Action);

const fn row(group: &'static str, written: &'static str, what: &'static str) -> Shortcut {
    Shortcut { group, written, what, key: None }
}

impl Shortcut {
    const fn on(self, modifiers: Modifiers, key: Key, action: fn() -> Action) -> Self {
        Shortcut { key: Some((modifiers, key, action)), ..self }
    }
}

const SHIFTED: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };
const PICTURE: &str = "In the picture";
const WINDOW: &str = "The window";
const FILES: &str = "Files";
const EXERCISE: &str = "In an exercise, or with your own shaders";

/// All shortcuts. The longer combination of a key comes first, because the shorter one would consume
/// its events.
const TABLE: &[Shortcut] = &[
    row(PICTURE, "Drag", "orbit around the target"),
    row(PICTURE, "Shift + drag", "pan"),
    row(PICTURE, "Right button + drag", "look around"),
    row(PICTURE, "Wheel", "zoom"),
    row(PICTURE, "w a s d, z q s d, arrows", "fly; e and c move up and down; Shift is faster"),
    row(PICTURE, "F", "frame all").on(Modifiers::NONE, Key::F, || Action::Frame),
    row(PICTURE, "Space", "play or pause the animation").on(Modifiers::NONE, Key::Space, || Action::PlayOrPause),
    row(PICTURE, "P", "probe the pixel under the pointer; a click pins it, Esc unpins it").on(
        Modifiers::NONE,
        Key::P,
        || Action::ToggleProbe,
    ),
    row(PICTURE, "O", "show the camera and its frustum from outside")
        .on(Modifiers::NONE, Key::O, || Action::ToggleObserver),
    row(PICTURE, "Shift + W", "wireframe").on(Modifiers::SHIFT, Key::W, || Action::Overlay(PaneOverlay::Wireframe)),
    row(PICTURE, "Shift + N", "normals").on(Modifiers::SHIFT, Key::N, || Action::Overlay(PaneOverlay::Normals)),
    row(PICTURE, "Shift + B", "bounding boxes").on(Modifiers::SHIFT, Key::B, || Action::Overlay(PaneOverlay::Boxes)),
    row(PICTURE, "Shift + U", "checkerboard of the texture coordinates")
        .on(Modifiers::SHIFT, Key::U, || Action::Special(SpecialView::UvChecker)),
    row(PICTURE, "Shift + V", "overdraw: fragments per pixel")
        .on(Modifiers::SHIFT, Key::V, || Action::Special(SpecialView::Overdraw)),
    row(PICTURE, "Shift + T", "the traced picture: the rendering equation in place of the light equation").on(
        Modifiers::SHIFT,
        Key::T,
        || Action::ToggleTruth,
    ),
    row(WINDOW, "Ctrl + Y, Ctrl + Shift + Z", "redo").on(SHIFTED, Key::Z, || Action::Redo),
    row(WINDOW, "", "").on(Modifiers::COMMAND, Key::Y, || Action::Redo),
    row(WINDOW, "Ctrl + Z", "undo").on(Modifiers::COMMAND, Key::Z, || Action::Undo),
    row(WINDOW, "Double click on a value", "reset it to its default"),
    row(WINDOW, "Ctrl + plus, Ctrl + minus", "enlarge or shrink the interface; Ctrl + 0 resets it"),
    row(WINDOW, "T", "switch between light and dark theme").on(Modifiers::NONE, Key::T, || Action::ToggleTheme),
    row(WINDOW, "?", "show this list").on(Modifiers::NONE, Key::Questionmark, || Action::ToggleHelp),
    row(WINDOW, "Esc", "close the open dialog"),
    row(FILES, "Ctrl + O", "open files (or drop them on the window)")
        .on(Modifiers::COMMAND, Key::O, || Action::ChooseFiles),
    row(FILES, "Ctrl + Shift + S", "save the scene").on(SHIFTED, Key::S, || Action::Save(Product::Scene)),
    row(FILES, "Ctrl + B", "bake textures").on(Modifiers::COMMAND, Key::B, || Action::ShowBake),
    row(FILES, "Ctrl + S", "save the picture").on(Modifiers::COMMAND, Key::S, || Action::Save(Product::Picture)),
    row(EXERCISE, "Ctrl + Enter", "check the shaders of an exercise"),
    row(EXERCISE, "Ctrl + F, F3, Shift + F3", "find in the text, go to the next or the previous match"),
    row(EXERCISE, "Tab, Shift + Tab", "indent the selected lines in the editor, or go back a step"),
    row(EXERCISE, "Ctrl + /", "make the selected lines comments, or code again"),
    row(EXERCISE, "Esc", "leave the editor; then Tab goes to the next control"),
    row(EXERCISE, "Click on the picture, F9", "show each line's values at that pixel, or at the picture's middle"),
    row(EXERCISE, "F10, Shift + F10", "next or previous step, over calls; also Alt + Down, Alt + Up"),
    row(EXERCISE, "F11, Shift + F11", "next or previous step, into calls; also Alt + Right, Alt + Left"),
    row(EXERCISE, "Shift + Alt + arrows", "move the pinned pixel"),
    row(EXERCISE, "Alt + Enter", "value and picture of the expression at the cursor; the pointer shows them too"),
];

/// The list of shortcuts by heading.
pub fn list() -> Vec<(&'static str, Vec<(&'static str, String)>)> {
    let in_group = |group: &str| {
        let rows = TABLE.iter().filter(|row| row.group == group && !row.written.is_empty());
        rows.map(|row| (row.written, row.what.to_owned())).collect()
    };
    const DIGITS: [&str; 9] = ["1", "2", "3", "4", "5", "6", "7", "8", "9"];
    let mut views = vec![("0", "the picture".to_owned())];
    for (digit, quantity) in DIGITS.into_iter().zip(VIEW_KEYS) {
        let symbol = quantity.symbol().map(|s| format!(" ({s})")).unwrap_or_default();
        views.push((digit, format!("{quantity}{symbol}")));
    }
    vec![
        (PICTURE, in_group(PICTURE)),
        ("Views in place of the picture", views),
        (WINDOW, in_group(WINDOW)),
        (FILES, in_group(FILES)),
        (EXERCISE, in_group(EXERCISE)),
    ]
}

/// Handles the keys of this frame.
pub fn handle(ui: &Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    navigation::note_combinations(ui);
    // Letters and digits go to the focused text field.
    let is_typing = ui.ctx().memory(|m| m.focused().is_some());
    for (modifiers, key, action) in TABLE.iter().filter_map(|row| row.key) {
        let pressed = match key {
            // Keyboard layouts differ in whether it needs Shift.
            Key::Questionmark => !is_typing && struck(ui, key, |_| true),
            _ if !modifiers.command => !is_typing && struck(ui, key, |held| held.matches_exact(modifiers)),
            _ => ui.input_mut(|i| i.consume_shortcut(&KeyboardShortcut::new(modifiers, key))),
        };
        if pressed {
            actions.push(action());
        }
    }
    if is_typing {
        return;
    }
    let pressed = |key: Key| struck(ui, key, |held| !held.any());
    if pressed(Key::Escape) {
        session.help = false;
        session.probing.pinned = None;
        session.baking.picked = None;
        if let Some(shaders) = &mut session.shaders {
            shaders.stepper.unpin();
        }
    }
    const DIGITS: [Key; 10] =
        [Key::Num0, Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];
    for (number, key) in DIGITS.into_iter().enumerate() {
        if pressed(key)
            && let Some(pane) = document.panes.current_mut()
        {
            let quantity = number.checked_sub(1).and_then(|n| VIEW_KEYS.get(n));
            pane.show_view(quantity.map(|&quantity| ViewSpec { quantity, light: None }));
        }
    }
}

/// Whether a key was pressed in this frame with matching modifiers. Modifiers at the end of the frame may
/// differ: slow frames contain whole key combinations.
fn struck(ui: &Ui, requested: Key, besides: impl Fn(Modifiers) -> bool) -> bool {
    ui.input(|i| {
        i.events.iter().any(|event| match event {
            Event::Key { key, pressed: true, repeat: false, modifiers, .. } => *key == requested && besides(*modifiers),
            _ => false,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_light::Quantity;

    /// The actions of one frame with these events, and the quantity shown then.
    fn asked_in_a_frame(events: Vec<Event>) -> (Vec<Action>, Option<Quantity>) {
        let (mut document, mut session, mut actions) = (Document::default(), Session::default(), Vec::new());
        let ctx = egui::Context::default();
        let input = egui::RawInput { events, ..Default::default() };
        // Nothing is drawn.
        ctx.run_ui(input, |ui| handle(ui, &mut document, &mut session, &mut actions)).textures_delta.clear();
        (actions, document.panes.current().and_then(|pane| pane.view).map(|view| view.quantity))
    }

    fn key(key: Key, pressed: bool, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: None, pressed, repeat: false, modifiers }
    }

    #[test]
    fn a_combination_within_one_frame_counts() {
        let struck = |modifiers: Modifiers, which: Key| {
            asked_in_a_frame(vec![
                key(which, true, modifiers),
                key(which, false, modifiers),
                key(Key::A, false, Modifiers::NONE),
            ])
        };
        let (actions, _) = struck(Modifiers::SHIFT, Key::W);
        assert!(matches!(actions.as_slice(), [Action::Overlay(PaneOverlay::Wireframe)]), "{actions:?}");
        let (actions, _) = struck(Modifiers::NONE, Key::F);
        assert!(matches!(actions.as_slice(), [Action::Frame]), "{actions:?}");
        assert_eq!(struck(Modifiers::NONE, Key::Num1).1, Some(VIEW_KEYS[0]));
        assert_eq!(struck(Modifiers::SHIFT, Key::Num1).1, None);
        assert!(struck(Modifiers::SHIFT, Key::F).0.is_empty());
    }

    #[test]
    fn every_key_is_listed_and_does_one_thing() {
        let listed: Vec<&str> = list().iter().flat_map(|(_, rows)| rows.iter().map(|(key, _)| *key)).collect();
        let keys: Vec<_> = TABLE.iter().filter_map(|row| row.key.map(|(modifiers, key, _)| (modifiers, key))).collect();
        for (index, (modifiers, key)) in keys.iter().enumerate() {
            assert!(!keys[..index].contains(&(*modifiers, *key)), "{key:?} twice");
            // The last part of a combination is the key, by egui's name or its label.
            let names = [key.name(), key.symbol_or_name()];
            let of_key = |written: &&str| {
                written.split(", ").filter_map(|keys| keys.split(" + ").last()).any(|last| names.contains(&last))
            };
            assert!(listed.iter().any(of_key), "{key:?} is not listed");
        }
    }

    #[test]
    fn longer_combinations_of_a_key_go_first() {
        let keys: Vec<_> = TABLE.iter().filter_map(|row| row.key).collect();
        for (index, (modifiers, key, _)) in keys.iter().enumerate() {
            let later = keys[index + 1..].iter().any(|(more, other, _)| other == key && more.shift && !modifiers.shift);
            assert!(!later, "{key:?}");
        }
    }
}
