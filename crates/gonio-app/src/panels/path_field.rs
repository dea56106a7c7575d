//! The path field, for systems without file dialogs.

use crate::action::Action;
use crate::exported::{self, Role};
use crate::platform::Purpose;
use crate::session::Session;
use egui::{Align2, Key, Label, RichText, TextEdit, Ui, Window, vec2};
use gonio_scene::files::BUILTIN;

/// Shows the field if a path is requested.
pub fn show(ui: &Ui, session: &mut Session, purpose: Purpose, actions: &mut Vec<Action>) {
    let Some(mut asking) = session.asking.take() else { return };
    let (title, hint, verb) = match asking.saves {
        None if purpose == Purpose::Exercise => {
            ("Open", "Path of a file, folder or zip file; you can also drop files on the window", "Open")
        }
        Some(_) => ("Save as", "Path of the file", "Save"),
        None => ("Open", "Path of a model, scene, zip file or picture; you can also drop files on the window", "Open"),
    };
    let (mut open, mut done) = (true, false);
    let width = 460_f32.min(ui.ctx().content_rect().width() - 48.0);
    Window::new(title)
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0))
        .show(ui.ctx(), |ui| {
            ui.set_width(width);
            ui.add(Label::new(RichText::new(hint).weak()).wrap());
            let edit = TextEdit::singleline(&mut asking.text).desired_width(f32::INFINITY).id_salt("path");
            let field = ui.add(edit);
            exported::note(ui, &field, "path", Role::Text, hint, &asking.text);
            // Enter takes the focus away, and is the answer.
            done |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            if !field.has_focus() && !done && ui.memory(|m| m.focused().is_none()) {
                field.request_focus();
            }
            ui.horizontal(|ui| {
                let button = ui.add_enabled(!asking.text.trim().is_empty(), egui::Button::new(verb));
                exported::note(ui, &button, "path-done", Role::Button, verb, "");
                done |= button.clicked();
                let cancel = ui.button("Cancel");
                exported::note(ui, &cancel, "path-cancel", Role::Button, "Cancel", "");
                if cancel.clicked() {
                    asking.text.clear();
                    done = true;
                }
            });
        });
    if ui.input(|i| i.key_pressed(Key::Escape)) {
        open = false;
    }
    let path = asking.text.trim().to_owned();
    match asking.saves {
        _ if !done => {}
        _ if path.is_empty() => open = false,
        Some(product) => actions.push(Action::SaveTo(product, path)),
        None if path.starts_with(BUILTIN) => actions.push(Action::Open(vec![path])),
        None => actions.push(Action::OpenPaths(vec![path])),
    }
    if open && !done {
        session.asking = Some(asking);
    }
}
