//! The list of keyboard shortcuts.

use crate::session::Session;
use crate::{shortcuts, theme};
use egui::{Align2, Grid, Label, RichText, ScrollArea, Ui, Window, vec2};

/// Shows it where it was asked for.
pub fn show(ui: &Ui, session: &mut Session) {
    let room = ui.ctx().content_rect();
    // On a phone the keys' column is what gives way.
    let key_width = if room.width() < 480.0 { 96.0 } else { 190.0 };
    Window::new("Keyboard shortcuts")
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
