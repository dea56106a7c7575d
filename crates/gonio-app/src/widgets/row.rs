//! A line of a panel: what it is called on the left, widgets on the right.

use crate::theme;
use egui::{Align, Label, Layout, Response, RichText, Ui, vec2};

/// Room for the name of a value, points.
pub const LABEL_WIDTH: f32 = 84.0;

/// The name of a value and its widgets. `tip` says what it is, with symbol and unit.
pub fn row<R>(ui: &mut Ui, label: &str, tip: &str, add: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let size = vec2(LABEL_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(size);
            let name = ui.add(Label::new(RichText::new(label).color(ui.visuals().weak_text_color())).truncate());
            if !tip.is_empty() {
                name.on_hover_text(tip);
            }
        });
        add(ui)
    })
    .inner
}

/// What the lines below it are about.
pub fn heading(ui: &mut Ui, text: &str) -> Response {
    ui.add_space(6.0);
    let color = ui.visuals().strong_text_color();
    ui.label(RichText::new(text).font(theme::bold(13.5)).color(color))
}
