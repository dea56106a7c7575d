//! Choices among several names: side by side for a few, in a list for many.

use crate::exported::{self, WidgetRole};
use crate::theme::{colors, touch};
use egui::{Button, ComboBox, RichText, Ui, WidgetInfo, vec2};
use gonio_language::name;

/// The variants of a `named_enum!` as options: value, name, description.
macro_rules! named_options {
    ($Enum:ty) => {
        <$Enum>::ALL.iter().map(|v| (*v, v.name(), v.description())).collect::<Vec<_>>()
    };
}
pub(crate) use named_options;

/// A choice among `options` (value, name, description), side by side. Returns whether it was changed. A double click selects
/// `default`.
pub fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    id: &str,
    label: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
    default: T,
) -> bool {
    let words: Vec<(&str, &str)> = options.iter().map(|(_, word, tip)| (*word, *tip)).collect();
    let chosen = options.iter().position(|(option, ..)| option == value);
    match segments(ui, id, label, &words, chosen) {
        Picked::Nothing => false,
        Picked::Default => replace(value, default),
        Picked::Option(index) => options.get(index).is_some_and(|(option, ..)| replace(value, *option)),
    }
}

/// A choice in a drop-down list.
pub fn dropdown<T: Copy + PartialEq>(
    ui: &mut Ui,
    id: &str,
    label: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
) -> bool {
    let words: Vec<(&str, &str)> = options.iter().map(|(_, word, tip)| (*word, *tip)).collect();
    let chosen = options.iter().position(|(option, ..)| option == value);
    let picked = list(ui, id, label, &words, chosen);
    picked.and_then(|index| options.get(index)).is_some_and(|(option, ..)| replace(value, *option))
}

/// The tabs of pages (page, name, id) of which a narrow window shows one.
pub fn page_tabs<T: Copy + PartialEq>(ui: &mut Ui, shown: &mut T, pages: &[(T, &str, &str)]) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (page, name, id) in pages {
            let chosen = shown == page;
            let button = ui.add(Button::new(*name).selected(chosen).frame_when_inactive(false));
            exported::note(ui, &button, &format!("page-{id}"), WidgetRole::Tab, name, chosen);
            if button.clicked() {
                *shown = *page;
            }
        }
    });
    ui.separator();
}

fn replace<T: PartialEq>(value: &mut T, with: T) -> bool {
    let changed = *value != with;
    *value = with;
    changed
}

/// A name as a part of an id: kebab-case.
pub fn slug(word: &str) -> String {
    let words = word.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

enum Picked {
    Nothing,
    Default,
    Option(usize),
}

fn segments(ui: &mut Ui, id: &str, label: &str, words: &[(&str, &str)], chosen: Option<usize>) -> Picked {
    let mut picked = Picked::Nothing;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        ui.spacing_mut().button_padding = vec2(4.5, 2.0);
        let least = touch::least(ui);
        for (index, (word, tip)) in words.iter().enumerate() {
            let is_chosen = chosen == Some(index);
            let text = if is_chosen {
                RichText::new(name(word)).color(ui.visuals().strong_text_color())
            } else {
                RichText::new(name(word)).color(ui.visuals().weak_text_color())
            };
            let mut button = Button::new(text).min_size(vec2(least, least.max(22.0))).frame_when_inactive(is_chosen);
            if is_chosen {
                button = button.fill(colors::ACCENT.of(ui).gamma_multiply(0.28));
            }
            let response = ui.add(button);
            let full = format!("{label}: {}", name(word));
            response.widget_info(|| WidgetInfo::selected(egui::Role::RadioButton, true, is_chosen, &full));
            let own_id = format!("{id}-{}", slug(word));
            exported::note(ui, &response, &own_id, WidgetRole::Choice, &full, is_chosen);
            if response.double_clicked() {
                picked = Picked::Default;
            } else if response.clicked() {
                picked = Picked::Option(index);
            }
            if !tip.is_empty() {
                response.on_hover_text(name(tip.trim()));
            }
        }
    });
    picked
}

fn list(ui: &mut Ui, id: &str, label: &str, words: &[(&str, &str)], chosen: Option<usize>) -> Option<usize> {
    let mut picked = None;
    let shown = chosen.and_then(|index| words.get(index)).map_or("", |(word, _)| name(word));
    let width = ui.available_width().clamp(80.0, 200.0);
    let combo = ComboBox::from_id_salt(id).selected_text(shown).width(width).height(420.0);
    let response = combo
        .show_ui(ui, |ui| {
            for (index, (word, tip)) in words.iter().enumerate() {
                let entry = ui.selectable_label(chosen == Some(index), name(word));
                exported::note(
                    ui,
                    &entry,
                    &format!("{id}-{}", slug(word)),
                    WidgetRole::Choice,
                    name(word),
                    chosen == Some(index),
                );
                if entry.clicked() {
                    picked = Some(index);
                }
                if !tip.is_empty() {
                    entry.on_hover_text(name(tip.trim()));
                }
            }
        })
        .response;
    response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, label));
    exported::note(ui, &response, id, WidgetRole::Choice, label, shown);
    picked
}
