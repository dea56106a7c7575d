//! The top bar: files, undo, theme. In a narrow window, a menu contains the file actions.

use crate::action::Action;
use crate::document::{Document, History};
use crate::exported::{self, WidgetRole};
use crate::platform::CaptureAccess;
use crate::saving::Product;
use crate::session::Session;
use crate::theme::{self, icons};
use crate::widgets::language_menu;
use egui::{Align, Layout, RichText, ScrollArea, Ui};
use gonio_language::tr;
use gonio_scene::files;

/// Below this width (points) a menu contains the file actions.
const NARROW: f32 = 680.0;
/// Tooltip of the BRDF bench.
const BENCH: &str = "window-brdf-bench-reflection-functions-plotted-compared";
/// Name and tooltip of the stations.
const STATIONS: [&str; 2] = ["window-beyond", "window-beyond-the-rendering-equation-polarisation-interference"];
/// Tooltip of baking.
const BAKE: &str = "window-unwrap-the-model-and-bake-its";
/// Tooltip of the gallery.
const GALLERY: &str = "window-every-technique-on-several-models";
/// Tooltip of the environment's panel.
const ENVIRONMENT: &str = "window-the-environment-as-six-faces";
/// Tooltip of the exercises.
const EXERCISES: &str = "window-shader-exercises-edit-compare-with-the";

pub fn show(ui: &mut Ui, document: &Document, session: &Session, history: &History, actions: &mut Vec<Action>) {
    let narrow = ui.available_width() < NARROW || theme::touch::least(ui) > 0.0;
    ui.horizontal(|ui| {
        if theme::touch::least(ui) > 0.0 {
            ui.spacing_mut().item_spacing.x = 0.0;
        }
        ui.label(RichText::new("gonio").font(theme::bold(16.0)).color(ui.visuals().strong_text_color()));
        ui.add_space(if narrow { 0.0 } else { 6.0 });
        if narrow {
            let text = RichText::new(icons::LIST).font(theme::icon_font(17.0));
            menu(ui, "menu", text, tr!("window-files"), |ui| {
                entry(
                    ui,
                    "open",
                    tr!("window-open-2"),
                    tr!("window-open-a-model-or-a-scene"),
                    Action::ChooseFiles,
                    actions,
                );
                entry(ui, "exercises", tr!("window-exercises"), tr!(EXERCISES), Action::ShowExercise, actions);
                entry(ui, "bench", tr!("window-brdf-bench"), tr!(BENCH), Action::ShowBench, actions);
                entry(
                    ui,
                    "stations",
                    tr!(STATIONS[1]).split(':').next().unwrap_or_default(),
                    tr!(STATIONS[1]),
                    Action::ShowStations,
                    actions,
                );
                ui.separator();
                save_entries(ui, session, actions);
                ui.separator();
                samples_entries(ui, actions);
                recent_entries(ui, session, actions);
            });
        } else {
            if icon(ui, "open", icons::FOLDER_OPEN, tr!("window-open-a-model-or-a-scene"), true) {
                actions.push(Action::ChooseFiles);
            }
            let text = RichText::new(icons::FLOPPY_DISK).font(theme::icon_font(17.0));
            menu(ui, "save", text, tr!("window-save-the-picture-or-the-scene"), |ui| {
                save_entries(ui, session, actions);
            });
            menu(ui, "samples", tr!("window-samples").into(), tr!("window-built-in-models-and-scenes"), |ui| {
                samples_entries(ui, actions);
            });
            if !session.settings.recent.is_empty() {
                menu(ui, "recent", tr!("window-recent").into(), tr!("window-recently-opened-files"), |ui| {
                    recent_entries(ui, session, actions);
                });
            }
            let button = ui.add(egui::Button::new(tr!("window-exercises")).frame_when_inactive(false));
            exported::note(ui, &button, "exercises", WidgetRole::Button, tr!("window-exercises"), "");
            if button.on_hover_text(tr!(EXERCISES)).clicked() {
                actions.push(Action::ShowExercise);
            }
            let button = ui.add(egui::Button::new(tr!("window-brdf-bench")).frame_when_inactive(false));
            exported::note(ui, &button, "bench", WidgetRole::Button, tr!("window-brdf-bench"), "");
            if button.on_hover_text(tr!(BENCH)).clicked() {
                actions.push(Action::ShowBench);
            }
            let button = ui.add(egui::Button::new(tr!(STATIONS[0])).frame_when_inactive(false));
            exported::note(ui, &button, "stations", WidgetRole::Button, tr!(STATIONS[0]), "");
            if button.on_hover_text(tr!(STATIONS[1])).clicked() {
                actions.push(Action::ShowStations);
            }
            ui.add_space(6.0);
        }
        if icon(ui, "undo", icons::ARROW_U_UP_LEFT, tr!("window-undo-ctrl-z"), history.can_undo(document)) {
            actions.push(Action::Undo);
        }
        if icon(ui, "redo", icons::ARROW_U_UP_RIGHT, tr!("window-redo-ctrl-y"), history.can_redo()) {
            actions.push(Action::Redo);
        }
        if icon(ui, "frame", icons::FRAME_CORNERS, tr!("window-frame-all-f"), session.loaded.is_some()) {
            actions.push(Action::Frame);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if icon(ui, "help", icons::QUESTION, tr!("window-keyboard-shortcuts-2"), true) {
                actions.push(Action::ToggleHelp);
            }
            let dark = ui.visuals().dark_mode;
            if icon(ui, "theme", if dark { icons::SUN } else { icons::MOON }, tr!("window-light-or-dark-theme-t"), true)
            {
                actions.push(Action::ToggleTheme);
            }
            if let Some(language) = language_menu(ui) {
                actions.push(Action::SetLanguage(language));
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

fn save_entries(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
    for product in Product::OF_SCENE {
        let id = format!("save-{}", product.id());
        let tip = if product == Product::Picture { "Ctrl + S" } else { "" };
        entry(ui, &id, product.title(), tip, Action::Save(product), actions);
    }
    if session.capture_access != CaptureAccess::Unsupported {
        let tip = session.capture_access.obstacle().unwrap_or(tr!("scene-every-draw-texture-and-uniform"));
        entry(ui, "save-capture", Product::Capture.title(), tip, Action::Save(Product::Capture), actions);
    }
    ui.separator();
    entry(ui, "bake", tr!("window-bake-textures"), tr!(BAKE), Action::ShowBake, actions);
    entry(
        ui,
        "environment-convert",
        tr!("window-convert-the-environment"),
        tr!(ENVIRONMENT),
        Action::ShowEnvironment,
        actions,
    );
    ui.separator();
    entry(ui, "copy-picture", tr!("window-copy-the-picture"), "", Action::CopyPicture, actions);
    let tip = tr!("window-a-link-to-this-page-with");
    entry(ui, "copy-link", tr!("window-copy-a-link-to-the-scene"), tip, Action::CopyLink, actions);
}

fn samples_entries(ui: &mut Ui, actions: &mut Vec<Action>) {
    entry(ui, "gallery", tr!("window-gallery"), tr!(GALLERY), Action::ShowGallery, actions);
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
        "cube" => tr!("window-six-faces-with-hard-edges-flat"),
        "screen" => tr!("window-a-rectangle-that-emits-the-light"),
        "sphere-coarse" => tr!("window-few-triangles-with-one-normal-per"),
        "sphere-coarse-averaged" => tr!("window-few-triangles-with-averaged-normals-interpolation"),
        "sphere-smooth" => tr!("window-many-triangles-all-shadings-look-the"),
        "still-life" => tr!("window-several-materials-and-textures-on-one"),
        "suzanne" => tr!("window-blender-s-monkey-head"),
        "easy-to-simplify" => tr!("window-each-simplification-of-the-rendering-equation-2"),
        "glass-and-mirror" => tr!("window-objects-that-reflect-and-refract-their"),
        "hard-to-simplify" => tr!("window-each-simplification-of-the-rendering-equation"),
        "lab-07" => tr!("window-the-scene-of-exercise-07"),
        "light-kinds" => tr!("window-a-directional-a-point-and-a"),
        "shadings" => tr!("window-flat-gouraud-and-phong-shading-side"),
        "three-spheres" => tr!("window-three-spheres-under-three-lights"),
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
