//! Comparison of one to four panes with settings of their own.

mod measured;
mod plot;
mod settings;
mod truth;

use crate::action::Action;
use crate::document::{Document, PaneArrangement, Panes};
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::theme::icons;
use egui::{Response, RichText, Ui};
use gonio_language::tr;

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, _: &mut Vec<Action>) {
    settings::show_presets(ui, document);
    list(ui, document);
    if document.panes.list.len() > 1 {
        arrangement(ui, document, session);
    }
    let current = document.panes.current;
    section(ui, &tr!("scene-pane", current = current + 1));
    settings::show(ui, document, session.loaded.as_deref());
    section(ui, tr!("scene-measured"));
    measured::show(ui, document, session);
    let adaptive = ui.checkbox(&mut session.adaptive, tr!("scene-one-sample-per-pixel-while-something"));
    exported::note(
        ui,
        &adaptive,
        "adaptive",
        WidgetRole::Toggle,
        tr!("scene-one-sample-while-moving"),
        session.adaptive,
    );
    section(ui, tr!("scene-error-against-the-finest-mesh"));
    measured::show_curve(ui, session);
}

/// A heading with space above.
fn section(ui: &mut Ui, title: &str) {
    ui.add_space(8.0);
    ui.label(RichText::new(title).heading());
}

/// Exports a button, and returns its response.
fn noted(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> Response, id: &str, label: &str, value: impl ToString) -> Response {
    let response = add(ui);
    exported::note(ui, &response, id, WidgetRole::Button, label, value);
    response
}

/// The list of panes: select, add, remove.
fn list(ui: &mut Ui, document: &mut Document) {
    section(ui, tr!("scene-panes"));
    let panes = &mut document.panes;
    let mut removed = None;
    for index in 0..panes.list.len() {
        ui.horizontal(|ui| {
            let caption = panes.caption(index);
            let text = format!("{}   {caption}", index + 1);
            // Room for the button beside it.
            let width = (ui.available_width() - 52.0).max(80.0);
            let chosen = panes.current == index;
            // A text at its right aligns the caption to the left.
            let entry = egui::Button::selectable(chosen, text).right_text("").truncate();
            let entry = entry.min_size(egui::vec2(width, 24.0));
            let entry = ui.scope(|ui| {
                ui.set_max_width(width);
                ui.add(entry)
            });
            if noted(ui, |_| entry.inner, &format!("choose-pane-{index}"), &caption, chosen).clicked() {
                panes.current = index;
            }
            if panes.list.len() > 1 {
                let tip = tr!("scene-remove-pane", index = index + 1);
                let icon = RichText::new(icons::X).font(crate::theme::icon_font(14.0));
                let button = noted(ui, |ui| ui.button(icon), &format!("remove-pane-{index}"), &tip, "");
                if button.on_hover_text(&tip).clicked() {
                    removed = Some(index);
                }
            }
        });
    }
    if let Some(index) = removed {
        panes.remove(index);
    }
    ui.horizontal_wrapped(|ui| {
        let room = panes.list.len() < Panes::MOST;
        let add = egui::Button::new(tr!("scene-add-a-copy-of-this-pane"));
        if noted(ui, |ui| ui.add_enabled(room, add), "add-pane", tr!("scene-add-a-copy-of-this-pane"), "").clicked() {
            panes.add();
        }
        if panes.list.len() > 1 {
            let same = noted(
                ui,
                |ui| ui.button(tr!("scene-apply-to-all-panes")),
                "copy-pane",
                tr!("scene-apply-to-all-panes"),
                "",
            );
            if same.on_hover_text(tr!("scene-copies-the-settings-of-the-current")).clicked() {
                let settings = panes.current().cloned().unwrap_or_default();
                panes.list.iter_mut().for_each(|pane| pane.clone_from(&settings));
            }
        }
    });
}

/// Side by side, wipe or difference; and the two panes.
fn arrangement(ui: &mut Ui, document: &mut Document, session: &mut Session) {
    section(ui, tr!("scene-arrangement"));
    let panes = &mut document.panes;
    ui.horizontal_wrapped(|ui| {
        let wipe = if let PaneArrangement::Wipe(at) = panes.arrangement { at } else { 0.5 };
        for (id, label, tip, arrangement) in [
            (
                "side-by-side",
                tr!("scene-side-by-side"),
                tr!("scene-all-panes-next-to-each-other"),
                PaneArrangement::SideBySide,
            ),
            ("wipe-mode", tr!("scene-wipe"), tr!("scene-two-panes-on-top-of-each"), PaneArrangement::Wipe(wipe)),
            (
                "difference-mode",
                tr!("scene-difference"),
                tr!("scene-colour-map-of-the-difference-between"),
                PaneArrangement::Difference,
            ),
        ] {
            let chosen = std::mem::discriminant(&panes.arrangement) == std::mem::discriminant(&arrangement);
            let button = noted(ui, |ui| ui.selectable_label(chosen, label), id, label, chosen);
            if button.on_hover_text(tip).clicked() {
                panes.arrangement = arrangement;
            }
        }
    });
    if panes.arrangement == PaneArrangement::SideBySide {
        return;
    }
    ui.horizontal(|ui| {
        let captions: Vec<String> =
            (0..panes.list.len()).map(|index| format!("{}  {}", index + 1, panes.caption(index))).collect();
        for (place, name) in panes.pair.iter_mut().zip(["first", "second"]) {
            let chosen = captions.get(*place).cloned().unwrap_or_default();
            let combo = egui::ComboBox::from_id_salt(name).width(130.0).truncate().selected_text(chosen.clone());
            let combo = combo.show_ui(ui, |ui| {
                for (index, caption) in captions.iter().enumerate() {
                    let entry = ui.selectable_value(place, index, caption);
                    exported::note(
                        ui,
                        &entry,
                        &format!("pair-{name}-{index}"),
                        WidgetRole::Choice,
                        caption,
                        *place == index,
                    );
                }
            });
            combo.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, name));
            exported::note(ui, &combo.response, &format!("pair-{name}"), WidgetRole::Choice, name, chosen);
        }
    });
    if panes.arrangement == PaneArrangement::Difference {
        let settings = &mut panes.difference;
        ui.horizontal(|ui| {
            let tip = tr!("scene-the-difference-in-8-bit-steps");
            ui.label(tr!("scene-full-scale")).on_hover_text(tip);
            let slider = egui::Slider::new(&mut settings.full_scale, 1.0..=255.0).logarithmic(true).max_decimals(0);
            let slider = ui.add(slider).on_hover_text(tip);
            exported::note(ui, &slider, "full-scale", WidgetRole::Number, tr!("scene-full-scale"), settings.full_scale);
            if slider.double_clicked() {
                *settings = crate::document::DifferenceSettings { signed: settings.signed, ..Default::default() };
            }
        });
        let signed = ui.checkbox(&mut settings.signed, tr!("scene-signed-second-minus-first"));
        exported::note(ui, &signed, "signed", WidgetRole::Toggle, tr!("scene-signed"), settings.signed);
        measured::difference(ui, panes, session);
    }
}
