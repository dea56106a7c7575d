//! Widgets of the panels: numbers, vectors, colours, choices, switches, parameters.
//!
//! Each is exported under a stable id ([`crate::exported::note`]), has a name for screen readers, and is reset to its default by a
//! double click. Widgets edit the document in place and do not handle undo.

mod choice;
mod color;
mod language;
mod number;
mod parameters;
mod spectrum;

pub(crate) use choice::named_options;
pub use choice::{choice, dropdown, page_tabs, slug};
pub use color::{color, color_swatch, shown};
pub use language::language_menu;
pub use number::{NO_BREAK, NumberField, SPACE, Vector, axes, compact, grouped};
pub use parameters::parameter;
pub use spectrum::spectrum;

use crate::exported::{self, WidgetRole};
use crate::theme;
use egui::{Align, Button, Color32, Label, Layout, Response, RichText, Ui, Vec2, WidgetInfo, vec2};

/// Side of an icon button, points.
pub const SIDE: f32 = 22.0;

/// An icon button. `tip` is its tooltip and its name for screen readers.
pub fn icon_button(ui: &mut Ui, id: &str, icon: &str, tip: &str) -> Response {
    tool_button(ui, id, icon, tip, None, true)
}

/// An icon button in a colour, or disabled.
pub fn tool_button(ui: &mut Ui, id: &str, icon: &str, tip: &str, color: Option<Color32>, enabled: bool) -> Response {
    let color = color.unwrap_or_else(|| ui.visuals().text_color());
    let text = RichText::new(icon).font(theme::icon_font(15.0)).color(color);
    let button = Button::new(text).frame_when_inactive(false).min_size(Vec2::splat(theme::touch::least(ui).max(SIDE)));
    let response = ui
        .scope(|ui| {
            ui.spacing_mut().button_padding = vec2(2.0, 2.0);
            ui.add_enabled(enabled, button)
        })
        .inner;
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, enabled, tip));
    exported::note(ui, &response, id, WidgetRole::Button, tip, "");
    response.on_hover_text(tip).on_disabled_hover_text(tip)
}

/// A switch with its name. Returns whether it was changed.
pub fn toggle(ui: &mut Ui, id: &str, label: &str, value: &mut bool, tip: &str) -> bool {
    let label = gonio_language::name(label);
    let response = ui.checkbox(value, label);
    exported::note(ui, &response, id, WidgetRole::Toggle, label, *value);
    let changed = response.changed();
    if !tip.is_empty() {
        response.on_hover_text(tip);
    }
    changed
}

/// Width of the label of a row, points.
pub const LABEL_WIDTH: f32 = 84.0;

/// A row: the name of a value and its widgets. `tip` describes the value, with symbol and unit.
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

/// A heading within a panel.
pub fn heading(ui: &mut Ui, text: &str) -> Response {
    ui.add_space(6.0);
    let color = ui.visuals().strong_text_color();
    let response = ui.label(RichText::new(text).font(theme::bold(13.5)).color(color));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_role(egui::Role::Heading));
    response
}
