//! The toolbar of the bench: models to add, files, saving, theme.

use super::command::BenchCommand;
use crate::exported::{self, WidgetRole};
use crate::saving::Product;
use crate::theme::{self, icons};
use egui::containers::menu::MenuButton;
use egui::{
    Align, Button, Frame, Key, KeyboardShortcut, Layout, Margin, Modifiers, Panel, RichText, ScrollArea, Ui, WidgetInfo,
};
use gonio_bsdf::MODELS;
use gonio_language::tr;

/// Below this width (points) the title is left out.
const NARROW: f32 = 620.0;

/// Handles the keys of this frame.
pub fn keys(ui: &Ui, commands: &mut Vec<BenchCommand>) {
    let shortcuts = [(Key::O, BenchCommand::Open), (Key::S, BenchCommand::Save(Product::PlotSvg))];
    for (key, command) in shortcuts {
        if ui.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(Modifiers::COMMAND, key))) {
            commands.push(command);
        }
    }
}

/// Shows the toolbar.
pub fn show(ui: &mut Ui, commands: &mut Vec<BenchCommand>) {
    let bar = Frame::NONE.inner_margin(Margin::symmetric(10, 5));
    Panel::top("bench bar").frame(bar).resizable(false).show(ui, |ui| {
        let narrow = ui.available_width() < NARROW;
        ui.horizontal(|ui| {
            icon(ui, "leave", icons::CARET_LEFT, tr!("bench-back-to-the-scene"), BenchCommand::Leave, commands);
            if !narrow {
                ui.label(
                    RichText::new(tr!("bench-brdf-bench"))
                        .font(theme::bold(16.0))
                        .color(ui.visuals().strong_text_color()),
                );
                ui.add_space(4.0);
            }
            menu(
                ui,
                "add-model",
                tr!("bench-add-a-model").into(),
                tr!("bench-models-of-reflection-and-transmission"),
                |ui| {
                    for model in MODELS {
                        let command = BenchCommand::Add(model);
                        entry(ui, &format!("model-{}", model.name), model.name, model.title, command, commands);
                    }
                },
            );
            let tip = tr!("bench-open-binary-merl-brdf-or-glsl");
            icon(ui, "open-files", icons::FOLDER_OPEN, tip, BenchCommand::Open, commands);
            let disk = RichText::new(icons::FLOPPY_DISK).font(theme::icon_font(17.0));
            menu(ui, "save", disk, tr!("bench-save-the-plot"), |ui| {
                for product in [Product::PlotSvg, Product::PlotPng] {
                    let id = format!("save-{}", product.id());
                    entry(ui, &id, product.title(), "", BenchCommand::Save(product), commands);
                }
            });
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let theme = if ui.visuals().dark_mode { icons::SUN } else { icons::MOON };
                icon(ui, "theme", theme, tr!("bench-light-or-dark-theme"), BenchCommand::Theme, commands);
            });
        });
    });
}

fn menu(ui: &mut Ui, id: &str, text: RichText, tip: &str, content: impl FnOnce(&mut Ui)) {
    let height = ui.ctx().content_rect().height() - 60.0;
    let content = |ui: &mut Ui| {
        // Without this, egui gives a menu at most 400 points, whatever the window's height.
        ui.set_max_height(height);
        ScrollArea::vertical().max_height(height).show(ui, content)
    };
    let (button, _) = MenuButton::from_button(Button::new(text).frame_when_inactive(false)).ui(ui, content);
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, tip));
    exported::note(ui, &button, id, WidgetRole::Button, tip, "");
    button.on_hover_text(tip);
}

fn entry(ui: &mut Ui, id: &str, text: &str, tip: &str, command: BenchCommand, commands: &mut Vec<BenchCommand>) {
    let button = ui.button(text);
    exported::note(ui, &button, id, WidgetRole::Button, text, "");
    let button = if tip.is_empty() { button } else { button.on_hover_text(tip) };
    if button.clicked() {
        commands.push(command);
        ui.close();
    }
}

fn icon(ui: &mut Ui, id: &str, icon: &str, tip: &str, command: BenchCommand, commands: &mut Vec<BenchCommand>) {
    let text = RichText::new(icon).font(theme::icon_font(17.0));
    let button = ui.add(Button::new(text).frame_when_inactive(false));
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, tip));
    exported::note(ui, &button, id, WidgetRole::Button, tip, "");
    if button.on_hover_text(tip).clicked() {
        commands.push(command);
    }
}
