//! The top bar: files, undo, theme. In a narrow window, a menu contains the file actions.

use crate::action::Action;
use crate::document::{Document, History};
use crate::exported::{self, WidgetRole};
use crate::saving::Product;
use crate::session::Session;
use crate::theme::{self, icons};
use egui::{Align, Layout, RichText, ScrollArea, Ui};
use gonio_scene::files;

/// Below this width (points) a menu contains the file actions.
const NARROW: f32 = 680.0;
/// Tooltip of the BRDF bench.
const BENCH: &str = "BRDF bench: reflection functions plotted, compared and checked";
/// Name and tooltip of the stations.
const STATIONS: [&str; 2] = ["Beyond", "Beyond the rendering equation: polarisation, interference, fog and seven more"];
/// Tooltip of the gallery.
const GALLERY: &str = "Every technique on several models, as scenes to open";
/// Tooltip of baking.
const BAKE: &str = "Unwrap the model, and bake its colours, normals or light into textures (Ctrl + B)";
/// Tooltip of the environment's panel.
const ENVIRONMENT: &str = "The environment as six faces, a cross, a panorama or KTX2; the check of its orientation";
/// Tooltip of the exercises.
const EXERCISES: &str = "Shader exercises: edit, compare with the correct answer, and check";

pub fn show(ui: &mut Ui, document: &Document, session: &Session, history: &History, actions: &mut Vec<Action>) {
    let narrow = ui.available_width() < NARROW;
    ui.horizontal(|ui| {
        ui.label(RichText::new("gonio").font(theme::bold(16.0)).color(ui.visuals().strong_text_color()));
        ui.add_space(if narrow { 0.0 } else { 6.0 });
        if narrow {
            let text = RichText::new(icons::LIST).font(theme::icon_font(17.0));
            menu(ui, "menu", text, "Files", |ui| {
                entry(ui, "open", "Open...", "Open a model or a scene (Ctrl + O)", Action::ChooseFiles, actions);
                entry(ui, "exercises", "Exercises", EXERCISES, Action::ShowExercise, actions);
                entry(ui, "bench", "BRDF bench", BENCH, Action::ShowBench, actions);
                entry(
                    ui,
                    "stations",
                    STATIONS[1].split(':').next().unwrap_or_default(),
                    STATIONS[1],
                    Action::ShowStations,
                    actions,
                );
                ui.separator();
                save_entries(ui, actions);
                ui.separator();
                samples_entries(ui, actions);
                recent_entries(ui, session, actions);
            });
        } else {
            if icon(ui, "open", icons::FOLDER_OPEN, "Open a model or a scene (Ctrl + O)", true) {
                actions.push(Action::ChooseFiles);
            }
            let text = RichText::new(icons::FLOPPY_DISK).font(theme::icon_font(17.0));
            menu(ui, "save", text, "Save the picture or the scene, bake textures", |ui| save_entries(ui, actions));
            menu(ui, "samples", "Samples".into(), "Built-in models and scenes", |ui| {
                samples_entries(ui, actions);
            });
            if !session.settings.recent.is_empty() {
                menu(ui, "recent", "Recent".into(), "Recently opened files", |ui| {
                    recent_entries(ui, session, actions);
                });
            }
            let button = ui.add(egui::Button::new("Exercises").frame_when_inactive(false));
            exported::note(ui, &button, "exercises", WidgetRole::Button, "Exercises", "");
            if button.on_hover_text(EXERCISES).clicked() {
                actions.push(Action::ShowExercise);
            }
            let button = ui.add(egui::Button::new("BRDF bench").frame_when_inactive(false));
            exported::note(ui, &button, "bench", WidgetRole::Button, "BRDF bench", "");
            if button.on_hover_text(BENCH).clicked() {
                actions.push(Action::ShowBench);
            }
            let button = ui.add(egui::Button::new(STATIONS[0]).frame_when_inactive(false));
            exported::note(ui, &button, "stations", WidgetRole::Button, STATIONS[0], "");
            if button.on_hover_text(STATIONS[1]).clicked() {
                actions.push(Action::ShowStations);
            }
            ui.add_space(6.0);
        }
        if icon(ui, "undo", icons::ARROW_U_UP_LEFT, "Undo (Ctrl + Z)", history.can_undo(document)) {
            actions.push(Action::Undo);
        }
        if icon(ui, "redo", icons::ARROW_U_UP_RIGHT, "Redo (Ctrl + Y)", history.can_redo()) {
            actions.push(Action::Redo);
        }
        if icon(ui, "frame", icons::FRAME_CORNERS, "Frame all (F)", session.loaded.is_some()) {
            actions.push(Action::Frame);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if icon(ui, "help", icons::QUESTION, "Keyboard shortcuts (?)", true) {
                actions.push(Action::ToggleHelp);
            }
            let dark = ui.visuals().dark_mode;
            if icon(ui, "theme", if dark { icons::SUN } else { icons::MOON }, "Light or dark theme (T)", true) {
                actions.push(Action::ToggleTheme);
            }
            ui.add(egui::Label::new(RichText::new(&session.title).weak()).truncate());
        });
    });
}

/// An icon button. Returns whether it was pressed.
fn icon(ui: &mut Ui, id: &str, icon: &str, tip: &str, enabled: bool) -> bool {
    let text = RichText::new(icon).font(theme::icon_font(17.0));
    let button = ui.add_enabled(enabled, egui::Button::new(text).frame_when_inactive(false));
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, enabled, tip));
    exported::note(ui, &button, id, WidgetRole::Button, tip, "");
    button.on_hover_text(tip).clicked()
}

/// A button that opens a menu, which scrolls in a low window.
fn menu(ui: &mut Ui, id: &str, text: RichText, tip: &str, content: impl FnOnce(&mut Ui)) {
    let height = ui.ctx().content_rect().height() - 60.0;
    // Like the icons beside it, it has a frame only under the pointer.
    let button = egui::Button::new(text).frame_when_inactive(false);
    let content = |ui: &mut Ui| {
        // Without this, egui gives a menu at most 400 points, whatever the window's height.
        ui.set_max_height(height);
        ScrollArea::vertical().max_height(height).show(ui, content)
    };
    let (button, _) = egui::containers::menu::MenuButton::from_button(button).ui(ui, content);
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, tip));
    exported::note(ui, &button, id, WidgetRole::Button, tip, "");
    button.on_hover_text(tip);
}

fn entry(ui: &mut Ui, id: &str, text: &str, tip: &str, action: Action, actions: &mut Vec<Action>) {
    let button = ui.button(text);
    exported::note(ui, &button, id, WidgetRole::Button, text, "");
    let button = if tip.is_empty() { button } else { button.on_hover_text(tip) };
    if button.clicked() {
        actions.push(action);
        ui.close();
    }
}

fn save_entries(ui: &mut Ui, actions: &mut Vec<Action>) {
    for product in Product::OF_SCENE {
        let id = format!("save-{}", product.id());
        let tip = if product == Product::Picture { "Ctrl + S" } else { "" };
        entry(ui, &id, product.title(), tip, Action::Save(product), actions);
    }
    ui.separator();
    entry(ui, "bake", "Bake textures...", BAKE, Action::ShowBake, actions);
    entry(ui, "environment-convert", "Convert the environment...", ENVIRONMENT, Action::ShowEnvironment, actions);
    ui.separator();
    entry(ui, "copy-picture", "Copy the picture", "", Action::CopyPicture, actions);
    let tip = "A link to this page with the scene in it: sample models, lights, camera and all settings";
    entry(ui, "copy-link", "Copy a link to the scene", tip, Action::CopyLink, actions);
}

fn samples_entries(ui: &mut Ui, actions: &mut Vec<Action>) {
    entry(ui, "gallery", "Gallery...", GALLERY, Action::ShowGallery, actions);
    ui.separator();
    for name in files::builtin_names() {
        let action = Action::Open(vec![format!("{}{name}", files::BUILTIN)]);
        entry(ui, &format!("sample-{name}"), &name, sentence(&name), action, actions);
    }
}

fn recent_entries(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
    for (index, path) in session.settings.recent.iter().enumerate() {
        let name = crate::files::base_name(path);
        entry(ui, &format!("recent-{index}"), name, path, Action::OpenPaths(vec![path.clone()]), actions);
    }
}

/// Description of a sample.
fn sentence(sample: &str) -> &'static str {
    match sample {
        "cube" => "Six faces with hard edges: flat and Phong shading look the same",
        "screen" => "A rectangle that emits the light of a picture",
        "sphere-coarse" => "Few triangles with one normal per face: the shadings differ most",
        "sphere-coarse-averaged" => "Few triangles with averaged normals: interpolation hides the edges",
        "sphere-smooth" => "Many triangles: all shadings look the same",
        "still-life" => "Several materials and textures on one table",
        "suzanne" => "Blender's monkey head",
        "easy-to-simplify" => "Each simplification of the rendering equation costs little here",
        "glass-and-mirror" => "Objects that reflect and refract their surroundings",
        "hard-to-simplify" => "Each simplification of the rendering equation costs much here",
        "lab-07" => "The scene of exercise 07",
        "light-kinds" => "A directional, a point and a spot light side by side",
        "shadings" => "Flat, Gouraud and Phong shading side by side",
        "three-spheres" => "Three spheres under three lights",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_has_its_sentence() {
        let names = files::builtin_names();
        assert!(!names.is_empty());
        let silent: Vec<&String> = names.iter().filter(|name| sentence(name).is_empty()).collect();
        assert!(silent.is_empty(), "{silent:?}");
    }
}
