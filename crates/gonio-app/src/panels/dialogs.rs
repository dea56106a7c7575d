//! Windows over the picture: keyboard shortcuts, the path field.

use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::platform::Purpose;
use crate::session::Session;
use crate::shortcuts;
use crate::theme;
use egui::{Align2, Grid, Key, Label, RichText, ScrollArea, TextEdit, Ui, Window, vec2};
use gonio_language::tr;
use gonio_scene::files::BUILTIN;

/// Shows the keyboard shortcuts if they are requested.
pub fn help(ui: &Ui, session: &mut Session) {
    let room = ui.ctx().content_rect();
    // On a phone the column of keys is narrower.
    let key_width = if room.width() < 480.0 { 96.0 } else { 190.0 };
    Window::new(tr!("window-keyboard-shortcuts"))
        .open(&mut session.help)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0))
        .show(ui.ctx(), |ui| {
            ui.set_width(480_f32.min(room.width() - 48.0));
            let height = room.height() - 120.0;
            ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
                for (group, rows) in shortcuts::list() {
                    ui.label(RichText::new(group).font(theme::bold(13.5)));
                    Grid::new(group).num_columns(2).spacing([20.0, 4.0]).min_col_width(key_width).show(ui, |ui| {
                        for (key, what) in rows {
                            ui.scope(|ui| {
                                ui.set_max_width(key_width);
                                ui.add(Label::new(RichText::new(key).strong()).wrap());
                            });
                            ui.add(Label::new(what).wrap());
                            ui.end_row();
                        }
                    });
                    ui.add_space(8.0);
                }
            });
        });
}

/// Shows the path field if a path is requested, on systems without file dialogs.
pub fn path_field(ui: &Ui, session: &mut Session, purpose: Purpose, actions: &mut Vec<Action>) {
    let Some(mut asking) = session.asking.take() else { return };
    let (title, hint, verb) = match asking.saves {
        None if purpose == Purpose::Exercise => {
            (tr!("window-open"), tr!("window-path-of-a-file-folder-or"), tr!("window-open"))
        }
        None if purpose == Purpose::Bench => {
            (tr!("window-open"), tr!("window-path-of-a-binary-merl-brdf"), tr!("window-open"))
        }
        Some(_) => (tr!("window-save-as"), tr!("window-path-of-the-file"), tr!("window-save")),
        None => (tr!("window-open"), tr!("window-path-of-a-model-scene-shader"), tr!("window-open")),
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
            exported::note(ui, &field, "path", WidgetRole::Text, hint, &asking.text);
            // Enter confirms, and removes the focus.
            done |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            if !field.has_focus() && !done && ui.memory(|m| m.focused().is_none()) {
                field.request_focus();
            }
            ui.horizontal(|ui| {
                let button = ui.add_enabled(!asking.text.trim().is_empty(), egui::Button::new(verb));
                exported::note(ui, &button, "path-done", WidgetRole::Button, verb, "");
                done |= button.clicked();
                let cancel = ui.button(tr!("window-cancel"));
                exported::note(ui, &cancel, "path-cancel", WidgetRole::Button, tr!("window-cancel"), "");
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
