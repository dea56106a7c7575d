//! Keyboard shortcuts, and their list.

use crate::action::Action;
use crate::document::{Document, PaneOverlay, VIEW_KEYS};
use crate::saving::Product;
use crate::scene_view::navigation;
use crate::session::Session;
use egui::{Event, Key, KeyboardShortcut, Modifiers, Ui};
use gonio_language::{name, tr};
use gonio_scene::{SpecialView, ViewSpec};

/// A row of the table: a key, its action, and its description.
struct Shortcut {
    /// The id of the heading in the list.
    group: &'static str,
    /// The key in the list, or the id of its text; empty if another row lists it.
    written: &'static str,
    /// The id of the description in the list.
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
const PICTURE: &str = "window-in-the-picture";
const WINDOW: &str = "window-the-window";
const FILES: &str = "window-files";
const EXERCISE: &str = "window-in-an-exercise-or-with-your";

/// All shortcuts. The longer combination of a key comes first, because the shorter one would consume
/// its events.
const TABLE: &[Shortcut] = &[
    row(PICTURE, "window-drag", "window-orbit-around-the-target"),
    row(PICTURE, "window-shift-drag", "window-pan"),
    row(PICTURE, "window-right-button-drag", "window-look-around"),
    row(PICTURE, "window-wheel", "window-zoom"),
    row(PICTURE, "window-w-a-s-d-z-q", "window-fly-e-and-c-move-up"),
    row(PICTURE, "F", "window-frame-all").on(Modifiers::NONE, Key::F, || Action::Frame),
    row(PICTURE, "window-space", "window-play-or-pause-the-animation")
        .on(Modifiers::NONE, Key::Space, || Action::PlayOrPause),
    row(PICTURE, "P", "window-probe-the-pixel-under-the-pointer").on(Modifiers::NONE, Key::P, || Action::ToggleProbe),
    row(PICTURE, "O", "window-show-the-camera-and-its-frustum").on(Modifiers::NONE, Key::O, || Action::ToggleObserver),
    row(PICTURE, "Shift + W", "scene-wireframe")
        .on(Modifiers::SHIFT, Key::W, || Action::Overlay(PaneOverlay::Wireframe)),
    row(PICTURE, "Shift + N", "scene-normals-overlay")
        .on(Modifiers::SHIFT, Key::N, || Action::Overlay(PaneOverlay::Normals)),
    row(PICTURE, "Shift + B", "window-bounding-boxes")
        .on(Modifiers::SHIFT, Key::B, || Action::Overlay(PaneOverlay::Boxes)),
    row(PICTURE, "Shift + G", "window-ground-with-a-contact-shadow")
        .on(Modifiers::SHIFT, Key::G, || Action::ToggleGround),
    row(PICTURE, "Shift + U", "window-checkerboard-of-the-texture-coordinates")
        .on(Modifiers::SHIFT, Key::U, || Action::Special(SpecialView::UvChecker)),
    row(PICTURE, "Shift + V", "window-overdraw-fragments-per-pixel")
        .on(Modifiers::SHIFT, Key::V, || Action::Special(SpecialView::Overdraw)),
    row(PICTURE, "Shift + T", "window-the-traced-picture-the-rendering-equation")
        .on(Modifiers::SHIFT, Key::T, || Action::ToggleTruth),
    row(WINDOW, "Ctrl + Y, Ctrl + Shift + Z", "window-redo").on(SHIFTED, Key::Z, || Action::Redo),
    row(WINDOW, "", "").on(Modifiers::COMMAND, Key::Y, || Action::Redo),
    row(WINDOW, "Ctrl + Z", "window-undo").on(Modifiers::COMMAND, Key::Z, || Action::Undo),
    row(WINDOW, "window-double-click-on-a-value", "window-reset-it-to-its-default"),
    row(WINDOW, "window-ctrl-plus-ctrl-minus", "window-enlarge-or-shrink-the-interface-ctrl"),
    row(WINDOW, "T", "window-switch-between-light-and-dark-theme").on(Modifiers::NONE, Key::T, || Action::ToggleTheme),
    row(WINDOW, "?", "window-show-this-list").on(Modifiers::NONE, Key::Questionmark, || Action::ToggleHelp),
    row(WINDOW, "Esc", "window-close-the-open-dialog"),
    row(FILES, "Ctrl + O", "window-open-files-or-drop-them-on").on(Modifiers::COMMAND, Key::O, || Action::ChooseFiles),
    row(FILES, "Ctrl + Shift + S", "window-save-the-scene").on(SHIFTED, Key::S, || Action::Save(Product::Scene)),
    row(FILES, "Ctrl + B", "window-bake-textures-2").on(Modifiers::COMMAND, Key::B, || Action::ShowBake),
    row(FILES, "Ctrl + S", "window-save-the-picture").on(Modifiers::COMMAND, Key::S, || Action::Save(Product::Picture)),
    row(EXERCISE, "Ctrl + Enter", "window-check-the-shaders-of-an-exercise"),
    row(EXERCISE, "Ctrl + F, F3, Shift + F3", "window-find-in-the-text-go-to"),
    row(EXERCISE, "Tab, Shift + Tab", "window-indent-the-selected-lines-in-the"),
    row(EXERCISE, "Ctrl + /", "window-make-the-selected-lines-comments-or"),
    row(EXERCISE, "Esc", "window-leave-the-editor-then-tab-goes"),
    row(EXERCISE, "window-click-on-the-picture-f9", "window-show-each-line-s-values-at"),
    row(EXERCISE, "F10, Shift + F10", "window-next-or-previous-step-over-calls"),
    row(EXERCISE, "F11, Shift + F11", "window-next-or-previous-step-into-calls"),
    row(EXERCISE, "window-shift-alt-arrows", "window-move-the-pinned-pixel"),
    row(EXERCISE, "Alt + Enter", "window-value-and-picture-of-the-expression"),
];

/// The list of shortcuts by heading.
pub fn list() -> Vec<(&'static str, Vec<(&'static str, String)>)> {
    let in_group = |group: &str| {
        let rows = TABLE.iter().filter(|row| row.group == group && !row.written.is_empty());
        rows.map(|row| (tr!(row.written), tr!(row.what).to_owned())).collect()
    };
    const DIGITS: [&str; 9] = ["1", "2", "3", "4", "5", "6", "7", "8", "9"];
    let mut views = vec![("0", tr!("window-the-picture").to_owned())];
    for (digit, quantity) in DIGITS.into_iter().zip(VIEW_KEYS) {
        let symbol = quantity.symbol().map(|s| format!(" ({s})")).unwrap_or_default();
        views.push((digit, name(quantity.name()).to_owned() + &symbol));
    }
    vec![
        (tr!(PICTURE), in_group(PICTURE)),
        (tr!("window-views-in-place-of-the-picture"), views),
        (tr!(WINDOW), in_group(WINDOW)),
        (tr!(FILES), in_group(FILES)),
        (tr!(EXERCISE), in_group(EXERCISE)),
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
        session.unpin();
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
