//! A colour: a swatch that opens a picker, and a text field.

use crate::exported::{self, WidgetRole};
use crate::theme::touch;
use egui::widgets::color_picker::{Alpha, color_picker_color32};
use egui::{
    Color32, CornerRadius, Id, Popup, PopupCloseBehavior, Response, RichText, Sense, Stroke, StrokeKind, TextEdit, Ui,
    Vec2, WidgetInfo, vec2,
};
use gonio_language::tr;
use gonio_light::color::{srgb_decode, srgb_encode};
use gonio_scene::color_value::Color;

/// A linear colour for display; channels above 1 are scaled down.
pub fn shown(color: Color) -> Color32 {
    let most = color.0.iter().copied().fold(1.0, f64::max);
    let [r, g, b] = color.0.map(|v| (255.0 * srgb_encode((v / most).clamp(0.0, 1.0))).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// The colour as text: `#rrggbb` if that is exact to an 8-bit step, otherwise linear numbers.
fn written(color: Color) -> String {
    let swatch = shown(color);
    let back = [swatch.r(), swatch.g(), swatch.b()].map(|v| srgb_decode(f64::from(v) / 255.0));
    let exact = back.iter().zip(color.0).all(|(a, b)| (a - b).abs() < 5e-4);
    if exact {
        return format!("#{:02x}{:02x}{:02x}", swatch.r(), swatch.g(), swatch.b());
    }
    let [r, g, b] = color.0.map(super::compact);
    if r == g && g == b { r } else { format!("{r},{g},{b}") }
}

/// A swatch and a text field, which accepts `#rrggbb` (sRGB), `r,g,b` or one number (linear). Returns whether the colour was
/// changed. A double click on the swatch resets it to `default`.
pub fn color(ui: &mut Ui, id: &str, label: &str, value: &mut Color, default: Option<Color>, tip: &str) -> bool {
    let before = *value;
    color_swatch(ui, id, label, value, default, tip);
    text(ui, id, label, value);
    *value != before
}

/// The swatch alone, with its picker.
pub fn color_swatch(ui: &mut Ui, id: &str, label: &str, value: &mut Color, default: Option<Color>, tip: &str) -> bool {
    let before = *value;
    let swatch = swatch(ui, id, label, *value);
    let popup = Popup::menu(&swatch).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    popup.show(|ui| pick(ui, value));
    if let Some(default) = default
        && swatch.double_clicked()
    {
        *value = default;
        Popup::close_all(ui.ctx());
    }
    let [r, g, b] = value.0.map(super::compact);
    swatch.on_hover_ui(|ui| {
        if !tip.is_empty() {
            ui.label(tip);
        }
        ui.label(RichText::new(tr!("window-linear", r = r, g = g, b = b)).monospace());
        if let Some(default) = default {
            ui.label(tr!("window-double-click", default = written(default)));
        }
    });
    *value != before
}

fn swatch(ui: &mut Ui, id: &str, label: &str, value: Color) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(30.0, 22.0).max(Vec2::splat(touch::least(ui))), Sense::click());
    let line = ui.style().interact(&response).fg_stroke.color.gamma_multiply(0.4);
    ui.painter().rect(rect, CornerRadius::same(5), shown(value), Stroke::new(1.0, line), StrokeKind::Inside);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::ColorWell, true, label));
    exported::note(ui, &response, id, WidgetRole::Color, label, written(value));
    response
}

/// The picker: hue, saturation and value. Brightness above 1 is kept.
fn pick(ui: &mut Ui, value: &mut Color) {
    ui.spacing_mut().slider_width = 220.0;
    let most = value.0.iter().copied().fold(1.0, f64::max);
    let mut picked = shown(*value);
    if color_picker_color32(ui, &mut picked, Alpha::Opaque) {
        *value = Color([picked.r(), picked.g(), picked.b()].map(|v| most * srgb_decode(f64::from(v) / 255.0)));
    }
}

/// The text field. The text is applied when typing ends, if it is a colour.
fn text(ui: &mut Ui, id: &str, label: &str, value: &mut Color) {
    let key = Id::unique((tr!("window-color-text"), id));
    let typed: Option<String> = ui.data(|data| data.get_temp(key));
    let mut text = typed.unwrap_or_else(|| written(*value));
    let width = ui.available_width().clamp(60.0, 128.0);
    let edit = TextEdit::singleline(&mut text).id_salt(id).font(egui::TextStyle::Monospace).desired_width(width - 8.0);
    let response = ui.add(edit);
    let parsed = text.parse::<Color>();
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(key, text));
        if parsed.is_err() {
            let color = crate::theme::colors::ERROR.of(ui);
            ui.painter().rect_stroke(response.rect, 4.0, Stroke::new(1.0, color), StrokeKind::Inside);
        }
    } else {
        ui.data_mut(|data| data.remove::<String>(key));
    }
    let own_id = format!("{id}-text");
    exported::note(ui, &response, &own_id, WidgetRole::Text, label, written(*value));
    if response.lost_focus() && !ui.input(|i| i.key_pressed(egui::Key::Escape)) {
        match parsed {
            // An unchanged colour is not rounded to its text.
            Ok(color) if written(*value) != written(color) => *value = color,
            _ => {}
        }
    }
    response.on_hover_text(tr!("window-rrggbb-srgb-or-r-g-b"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_written_as_it_can_be_read() {
        for text in ["#ff8800", "#000000", "2", "0.1,3,0.5"] {
            let color: Color = text.parse().unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(written(color), text);
        }
        assert_eq!(shown(Color([2.0, 1.0, 0.0])).r(), 255);
    }
}
