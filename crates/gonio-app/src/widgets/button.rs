//! Buttons that are icons, and switches.

use crate::exported::{self, Role};
use crate::theme;
use egui::{Button, Color32, Response, RichText, Ui, WidgetInfo, vec2};

/// Points along a side of a small icon's button.
const SIDE: f32 = 22.0;

/// A button that is an icon. `tip` names it, for screen readers too.
pub fn icon_button(ui: &mut Ui, id: &str, icon: &str, tip: &str) -> Response {
    tool_button(ui, id, icon, tip, None, true)
}

/// The same, in a colour, or greyed out.
pub fn tool_button(ui: &mut Ui, id: &str, icon: &str, tip: &str, color: Option<Color32>, enabled: bool) -> Response {
    let color = color.unwrap_or_else(|| ui.visuals().text_color());
    let text = RichText::new(icon).font(theme::icon_font(15.0)).color(color);
    let button = Button::new(text).frame_when_inactive(false).min_size(vec2(SIDE, SIDE));
    let response = ui
        .scope(|ui| {
            ui.spacing_mut().button_padding = vec2(2.0, 2.0);
            ui.add_enabled(enabled, button)
        })
        .inner;
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, enabled, tip));
    exported::note(ui, &response, id, Role::Button, tip, "");
    response.on_hover_text(tip).on_disabled_hover_text(tip)
}

/// A switch with its name beside it; whether it was changed.
pub fn toggle(ui: &mut Ui, id: &str, label: &str, value: &mut bool, tip: &str) -> bool {
    let response = ui.checkbox(value, label);
    exported::note(ui, &response, id, Role::Toggle, label, *value);
    let changed = response.changed();
    if !tip.is_empty() {
        response.on_hover_text(tip);
    }
    changed
}
