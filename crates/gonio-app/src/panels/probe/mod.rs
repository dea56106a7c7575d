//! The equation at one pixel, with its numbers.

mod bars;
mod lights;
mod sum;
mod surface;

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::probing::{GpuValue, Reading};
use crate::session::{Selection, Session, Tab};
use crate::theme::{self, icons};
use crate::truth::PixelLight;
use egui::{Align, Color32, Grid, Layout, Response, RichText, Sense, TextStyle, TextWrapMode, Ui, WidgetText, vec2};
use glam::DVec3;
use gonio_language::tr;
use gonio_light::is_noise;
use std::fmt::Write;

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    let reading = session.probing.reading().cloned();
    header(ui, session, reading.as_deref(), actions);
    if session.probing.is_building() {
        ui.horizontal(|ui| {
            ui.add(egui::Spinner::new().size(14.0));
            let triangles = session.probing.building_triangles();
            ui.label(RichText::new(tr!("scene-preparing-the-cpu-reference-triangles", triangles = triangles)).weak());
        });
    }
    let Some(reading) = reading else {
        ui.add_space(8.0);
        let hint = tr!("scene-point-at-the-picture-to-see");
        ui.label(RichText::new(hint).weak());
        return;
    };
    let is_traced = document.panes.list.get(session.probing.pane).is_some_and(|pane| pane.truth.is_some());
    values(ui, &reading, session.pixel_light().filter(|_| is_traced));
    if is_traced {
        traced(ui, session, &reading);
    }
    let Some(probe) = &reading.probe else {
        ui.add_space(8.0);
        let sky = reading.frame.surroundings.is_some_and(|s| s.visible);
        let what = if sky { tr!("scene-the-environment") } else { tr!("scene-the-background") };
        ui.label(tr!("scene-this-pixel-shows", what = what));
        return;
    };
    // Beside the rendering equation, it has to be said which one this is.
    heading(ui, if is_traced { tr!("scene-the-light-equation-by-source") } else { tr!("scene-light-by-source") });
    bars::show(ui, &reading, probe);
    heading(
        ui,
        if is_traced { tr!("scene-the-light-equation-in-numbers") } else { tr!("scene-the-equation-in-numbers") },
    );
    sum::show(ui, &reading, probe);
    lights::show(ui, &reading, probe, session.selection);
    surface::show(ui, &reading, probe);
}

/// The light of a traced pixel, by the way it took.
fn traced(ui: &mut Ui, session: &Session, reading: &Reading) {
    heading(ui, tr!("scene-traced-light-by-the-way-it"));
    let Some(light) = session.pixel_light() else {
        let hint = match session.probing.pinned {
            Some(_) => tr!("scene-the-first-paths-are-on-their"),
            None => tr!("scene-a-click-pins-a-pixel-and"),
        };
        ui.label(RichText::new(hint).weak());
        return;
    };
    Grid::new("ways").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        for (name, about, rgb) in reading.ways(light) {
            vector_row(ui, &name, about, rgb, None);
        }
    });
    let text = tr!("scene-linear-rgb-mean-of-paths-through", paths = light.paths);
    let response = ui.label(RichText::new(text).small().weak());
    exported::note(ui, &response, "probe-paths", WidgetRole::Text, tr!("scene-paths-through-the-pixel"), light.paths);
}

/// Buttons beside the pixel's position.
const BUTTONS: f32 = 5.0;
/// The size of their icons, and the distance between them, points.
const ICON: f32 = 15.0;
const BETWEEN: f32 = 2.0;

/// The pixel's position, with buttons to unpin and copy it.
fn header(ui: &mut Ui, session: &mut Session, reading: Option<&Reading>, actions: &mut Vec<Action>) {
    let light = session.pixel_light().cloned();
    let light = light.as_ref();
    ui.horizontal(|ui| {
        let place = reading.map_or_else(|| tr!("scene-no-pixel").to_owned(), |r| tr!("scene-pixel", x = r.x, y = r.y));
        let place = ui.label(RichText::new(place).font(theme::bold(14.0)));
        if let Some(reading) = reading {
            let of = tr!("scene-of-x-2", width = reading.width, height = reading.height);
            let label = WidgetText::from(RichText::new(of.clone()).weak());
            let label = label.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Body);
            let with_icon = ICON + 2.0 * ui.spacing().button_padding.x;
            let buttons = BUTTONS * (theme::touch::least(ui).max(with_icon) + BETWEEN) + ui.spacing().item_spacing.x;
            // A phone is too narrow for it.
            if label.size().x + buttons <= ui.available_width() {
                ui.label(label);
            } else {
                place.on_hover_text(of);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = BETWEEN;
            let mut wants_unpin = false;
            let probing = &mut session.probing;
            let pinned = probing.pinned.is_some();
            let (icon, tip) = if pinned {
                (icons::PUSH_PIN_SLASH, tr!("scene-unpin-the-pixel-escape"))
            } else {
                (icons::PUSH_PIN, tr!("scene-click-in-the-picture-to-pin"))
            };
            if button(ui, "probe-unpin", icon, tip, pinned).clicked() {
                wants_unpin = true;
            }
            let tip = tr!("scene-show-or-hide-the-lobe-at");
            if button(ui, "probe-lobe", icons::FLASHLIGHT, tip, pinned).clicked() {
                probing.shows_lobe = !probing.shows_lobe;
            }
            if wants_unpin {
                session.unpin();
            }
            let part = reading.and_then(Reading::part);
            let tip = tr!("scene-edit-material-of-part");
            if button(ui, "probe-edit-material", icons::SLIDERS_HORIZONTAL, tip, part.is_some()).clicked()
                && let Some([object, part]) = part
            {
                session.selection = Selection::Part(object, part);
                session.tab = Tab::Objects;
            }
            let tip = tr!("scene-copy-all-numbers-as-json");
            if button(ui, "probe-copy-json", icons::CODE, tip, reading.is_some()).clicked()
                && let Some(reading) = reading
                && let Ok(mut json) = serde_json::to_value(reading)
            {
                json["traced"] = serde_json::json!(light.map(|light| reading.ways(light)));
                actions.push(Action::CopyText(format!("{json:#}")));
            }
            let tip = tr!("scene-copy-as-text");
            if button(ui, "probe-copy-text", icons::COPY, tip, reading.is_some()).clicked()
                && let Some(reading) = reading
            {
                actions.push(Action::CopyText(format_reading(reading, light)));
            }
        });
    });
}

fn button(ui: &mut Ui, id: &str, icon: &str, tip: &str, enabled: bool) -> Response {
    let text = RichText::new(icon).font(theme::icon_font(ICON));
    let response = ui.add_enabled(enabled, egui::Button::new(text).frame_when_inactive(false));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, enabled, tip));
    exported::note(ui, &response, id, WidgetRole::Button, tip, "");
    response.on_hover_text(tip)
}

/// The pixel by the CPU reference, by OpenGL, and traced.
fn values(ui: &mut Ui, reading: &Reading, light: Option<&PixelLight>) {
    Grid::new("probe values").num_columns(6).spacing([4.0, 4.0]).show(ui, |ui| {
        let row = |ui: &mut Ui, name: &str, tip: &str, color: [u8; 3], value: [f64; 3]| {
            ui.label(name).on_hover_text(tip);
            swatch(ui, color);
            ui.label(RichText::new(hex(color)).monospace().size(11.5));
            for v in value {
                cell(ui, v, None);
            }
            ui.end_row();
        };
        let [r, g, b, _] = reading.reference;
        row(ui, "CPU", tr!("scene-light-equation-by-the-cpu-reference"), reading.displayed, [r, g, b]);
        if let Some(GpuValue { value, displayed, .. }) = reading.gpu {
            let [r, g, b, _] = value.map(f64::from);
            row(ui, "OpenGL", tr!("scene-light-equation-by-opengl-with-one"), displayed, [r, g, b]);
        }
        if let Some((displayed, total)) = light.and_then(|light| reading.displayed_total(light)) {
            let tip = tr!("scene-rendering-equation-by-paths-through-the");
            row(ui, gonio_language::name("traced"), tip, displayed, total.to_array());
        }
    });
    ui.horizontal(|ui| match reading.gpu {
        Some(gpu) => {
            let text = tr!("scene-largest-difference-of-cpu-and-opengl", difference = number(gpu.difference));
            let response = ui.label(RichText::new(text).small().weak());
            exported::note(
                ui,
                &response,
                "probe-difference",
                WidgetRole::Text,
                tr!("scene-largest-difference"),
                gpu.difference,
            );
        }
        None => {
            ui.label(RichText::new(tr!("scene-the-opengl-value-could-not-be")).small().weak());
        }
    });
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(10.0);
    ui.label(RichText::new(text).font(theme::bold(13.5)));
}

/// A small square of a colour.
fn swatch(ui: &mut Ui, [r, g, b]: [u8; 3]) {
    let (rect, _) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
    let rim = egui::Stroke::new(1.0, ui.visuals().weak_text_color());
    ui.painter().rect(rect, 3.0, Color32::from_rgb(r, g, b), rim, egui::StrokeKind::Inside);
}

/// A name with a value, wrapped.
fn fact(ui: &mut Ui, name: &str, value: impl Into<egui::WidgetText>) {
    // A grid would not wrap a long text but widen the panel.
    ui.horizontal(|ui| {
        ui.allocate_ui(vec2(64.0, 16.0), |ui| {
            ui.set_min_width(64.0);
            ui.label(RichText::new(gonio_language::name(name)).weak());
        });
        ui.add(egui::Label::new(value).wrap());
    });
}

/// Formats a reading in aligned lines: the pixel, its value, and every factor of every light if a surface is visible.
fn format_reading(reading: &Reading, light: Option<&PixelLight>) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:16} {value}");
    };
    line("pixel", tr!("scene-of-x", x = reading.x, y = reading.y, width = reading.width, height = reading.height));
    let [r, g, b, a] = reading.reference;
    line("CPU", format!("{r} {g} {b} {a}, {}", hex(reading.displayed)));
    if let Some(gpu) = reading.gpu {
        let [r, g, b, a] = gpu.value;
        line("OpenGL", format!("{r} {g} {b} {a}, {}", hex(gpu.displayed)));
        line("difference", number(gpu.difference));
    }
    for (name, _, rgb) in light.map(|light| reading.ways(light)).unwrap_or_default() {
        line(&tr!("scene-traced-2", name = name), triple(rgb));
    }
    let Some(probe) = &reading.probe else { return text };
    line("object", probe.object_name.clone());
    line("material", probe.material_name.clone());
    line("triangle", tr!("scene-weights", triangle = probe.triangle, barycentrics = triple(probe.barycentrics)));
    line("position", triple(probe.position));
    line("N", triple(probe.terms.point.normal));
    line("V", triple(probe.terms.point.view));
    line("A", triple(probe.terms.ambient));
    line("E", triple(probe.terms.emitted));
    for light in &probe.terms.lights {
        line("light", reading.light_name(light.light));
        line("  L", triple(light.l));
        let factors = [
            ("N.L", light.cos_theta),
            ("att", light.attenuation),
            ("spot", light.spot),
            ("diff", light.diff),
            ("spec", light.spec),
            ("R.V", light.r_dot_v),
            ("N.H", light.n_dot_h),
        ];
        line(tr!("scene-factors-2"), factors.map(|(name, value)| format!("{name} {}", number(value))).join("  "));
        line(tr!("scene-diffuse-2"), triple(light.diffuse));
        line(tr!("scene-specular-2"), triple(light.specular));
    }
    line("L_o", triple(probe.lit));
    line("L", triple(probe.radiance));
    text
}

/// Width of a number's column, points.
const NUMBER_WIDTH: f32 = 49.0;

/// Formats a number with four decimals, or an exponent where that would hide it. Numerical noise is 0.
fn number(v: f64) -> String {
    if is_noise(v) {
        return "0".to_owned();
    }
    let size = v.abs();
    match size {
        _ if !v.is_finite() => "-".to_owned(),
        _ if (1e-3..10.0).contains(&size) => format!("{v:.4}"),
        _ if (10.0..1000.0).contains(&size) => format!("{v:.2}"),
        _ if (1000.0..1e5).contains(&size) => format!("{v:.0}"),
        _ => format!("{v:.0e}"),
    }
}

/// [`number`] without zeros at its end.
fn short(v: f64) -> String {
    let text = number(v);
    let plain = text.contains('.') && !text.contains('e');
    if plain { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Three numbers in a row.
fn triple(v: DVec3) -> String {
    format!("{} {} {}", number(v.x), number(v.y), number(v.z))
}

/// The colour as `#rrggbb`.
fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A number in a cell of its own, flush right.
fn cell(ui: &mut Ui, v: f64, color: Option<Color32>) {
    let text = RichText::new(number(v)).monospace().size(11.5);
    flush_right(ui, if let Some(color) = color { text.color(color) } else { text });
}

/// A text in a cell of a number's width, flush right.
fn flush_right(ui: &mut Ui, text: RichText) -> Response {
    let layout = Layout::right_to_left(Align::Center);
    let cell = ui.allocate_ui_with_layout(vec2(NUMBER_WIDTH, 16.0), layout, |ui| {
        ui.set_min_width(NUMBER_WIDTH);
        ui.label(text)
    });
    cell.inner
}

/// A row of a grid: a name and three numbers.
fn vector_row(ui: &mut Ui, name: &str, tip: &str, v: DVec3, color: Option<Color32>) {
    let text = RichText::new(gonio_language::name(name));
    let response = ui.label(if let Some(color) = color { text.color(color) } else { text });
    if !tip.is_empty() {
        response.on_hover_text(tip);
    }
    for c in v.to_array() {
        cell(ui, c, None);
    }
    ui.end_row();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_width() {
        for (v, text) in [
            (0.0, "0"),
            (0.51234, "0.5123"),
            (-1.0, "-1.0000"),
            (54.321, "54.32"),
            (12345.6, "12346"),
            (1.2e-7, "1e-7"),
            (0.5e-46, "0"),
            (f64::INFINITY, "-"),
        ] {
            assert_eq!(number(v), text);
            assert!(number(v).len() <= 7);
        }
        assert_eq!(short(0.5), "0.5");
        assert_eq!(short(-2.0), "-2");
    }
}
