//! The files of the scene: what a model's file holds, where each value comes from, the files that it names, and the model in
//! other formats.

mod contents;
mod lines;
mod materials;
mod names;

use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::files::short;
use crate::inspector::missing;
use crate::saving::Product;
use crate::session::Session;
use crate::theme::{self, colors, icons, touch};
use crate::widgets::{dropdown, heading};
use egui::{Button, Label, Link, Response, RichText, ScrollArea, Ui, Vec2, WidgetInfo, vec2};
use gonio_language::tr;
use gonio_mesh::{Diagnostic, Severity};
use gonio_scene::inspect::Inspection;

/// Width of the column of names, points.
const NAME_WIDTH: f32 = 104.0;
/// Rows of a list that is not opened further.
const MOST_ROWS: usize = 40;
/// Least height of the lines, and their share of the panel, points.
const LINES_HEIGHT: f32 = 220.0;
const LINES_SHARE: f32 = 0.5;

/// Shows the panel. On a phone, lines take its place until they are closed.
pub fn show(ui: &mut Ui, session: &mut Session, is_narrow: bool, actions: &mut Vec<Action>) {
    let has_lines = session.inspector.has_lines();
    if has_lines && is_narrow {
        return lines::show(ui, session, actions);
    }
    let room = ui.available_height();
    let height = if has_lines { (LINES_SHARE * room).max(LINES_HEIGHT) } else { 0.0 };
    let list = ScrollArea::vertical().id_salt("file").auto_shrink([false, false]).max_height((room - height).max(80.0));
    list.show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        content(ui, session, actions);
    });
    if has_lines {
        ui.separator();
        lines::show(ui, session, actions);
    }
}

fn content(ui: &mut Ui, session: &mut Session, actions: &mut Vec<Action>) {
    let Some(loaded) = session.loaded.clone() else {
        ui.label(RichText::new(tr!("file-no-file-is-open")).weak());
        return;
    };
    chooser(ui, session);
    let Some(model) = session.inspector.chosen_model() else {
        return names::of_scene(ui, session, &loaded, actions);
    };
    let name = model.name.clone();
    let result = model.result.clone();
    title(ui, &name);
    match result {
        None => {
            let text = tr!("file-the-file-is-being-read");
            let label = ui.label(RichText::new(text).weak());
            exported::note(ui, &label, "file-reading", WidgetRole::Text, text, &name);
        }
        Some(Err(error)) => {
            let label = ui.add(Label::new(RichText::new(&error).color(colors::ERROR.of(ui))).wrap());
            exported::note(ui, &label, "file-error", WidgetRole::Text, &error, &name);
        }
        Some(Ok(inspection)) => {
            contents::size(ui, &inspection);
            save(ui, session, actions);
            names::of_model(ui, &name, &inspection, actions);
            diagnostics(ui, &inspection.diagnostics, &name, actions);
            contents::show(ui, &inspection);
            materials::show(ui, &name, &inspection, actions);
            contents::after_materials(ui, &inspection);
        }
    }
}

/// The choice among several files.
fn chooser(ui: &mut Ui, session: &mut Session) {
    let inspector = &session.inspector;
    let files: Vec<String> =
        inspector.scenes().iter().cloned().chain(inspector.models().iter().map(|model| model.name.clone())).collect();
    if files.len() < 2 {
        return;
    }
    let titles: Vec<String> = files.iter().map(|file| chooser_entry(session, file)).collect();
    let options: Vec<(usize, &str, &str)> = titles
        .iter()
        .zip(&files)
        .enumerate()
        .map(|(index, (title, file))| (index, title.as_str(), file.as_str()))
        .collect();
    let mut index = files.iter().position(|file| file == inspector.chosen()).unwrap_or(0);
    if dropdown(ui, "file-chosen", tr!("file-file"), &mut index, &options)
        && let Some(file) = files.get(index)
    {
        session.inspector.choose(file.clone());
    }
}

/// A file's name, with the number of files that it lacks.
fn chooser_entry(session: &Session, file: &str) -> String {
    let model = session.inspector.models().iter().find(|model| model.name == file);
    let lacks = model.and_then(|model| model.result.as_ref()?.as_ref().ok()).map_or(0, |found| missing(found).len());
    let name = short(&[file.to_owned()]);
    if lacks > 0 { tr!("file-missing", name = name, lacks = lacks) } else { name }
}

/// The name of a file, with its folder as a tooltip.
fn title(ui: &mut Ui, name: &str) {
    let text = RichText::new(short(&[name.to_owned()])).font(theme::bold(14.5)).color(ui.visuals().strong_text_color());
    let label = ui.add(Label::new(text).wrap());
    exported::note(ui, &label, "file-name", WidgetRole::Text, name, "");
    label.on_hover_text(name);
}

/// The formats in which the model can be saved.
fn save(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
    let is_busy = session.inspector.converting().is_some();
    ui.horizontal_wrapped(|ui| {
        let tip = tr!("file-the-model-as-its-file-has");
        ui.label(RichText::new(tr!("file-save-as")).weak()).on_hover_text(tip);
        for product in Product::OF_MODEL {
            let tip = match product {
                Product::ModelGlb => tr!("file-one-file-with-the-model-its"),
                Product::ModelObj if cfg!(target_arch = "wasm32") => {
                    tr!("file-the-model-as-obj-with-its-2")
                }
                Product::ModelObj => tr!("file-the-model-as-obj-with-its"),
                _ => tr!("file-vertices-triangles-and-vertex-colours-ply"),
            };
            let icon = RichText::new(icons::FLOPPY_DISK).font(theme::icon_font(15.0));
            let button = ui.add_enabled(!is_busy, egui::Button::new((icon, product.title())));
            let name = tr!("file-save-the-model-as", title = product.title());
            button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, !is_busy, &name));
            exported::note(ui, &button, &format!("save-{}", product.id()), WidgetRole::Button, &name, "");
            if button.on_hover_text(tip).clicked() {
                actions.push(Action::Save(product));
            }
        }
    });
    if is_busy {
        ui.label(RichText::new(tr!("file-the-model-is-being-converted")).small().weak());
    }
}

/// Warnings and notes, with links to their lines.
fn diagnostics(ui: &mut Ui, list: &[Diagnostic], file: &str, actions: &mut Vec<Action>) {
    if list.is_empty() {
        return;
    }
    heading(ui, tr!("file-warnings-and-notes"));
    for (index, found) in list.iter().take(MOST_ROWS).enumerate() {
        let (icon, color) = match found.severity {
            Severity::Warning => (icons::WARNING, colors::WARNING.of(ui)),
            Severity::Note => (icons::INFO, colors::ACCENT.of(ui)),
        };
        ui.horizontal_top(|ui| {
            ui.label(RichText::new(icon).font(theme::icon_font(15.0)).color(color));
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.y = 1.0;
                let label = ui.add(Label::new(&found.message).wrap());
                exported::note(ui, &label, &format!("file-note-{index}"), WidgetRole::Text, &found.message, "");
                let of = found.place.file.as_deref().unwrap_or(file);
                if let Some(line) = found.place.line {
                    line_link(ui, &format!("file-note-{index}-line"), of, line, of != file, actions);
                } else if of != file {
                    ui.label(RichText::new(short(&[of.to_owned()])).small().weak());
                }
            });
        });
    }
    more(ui, list.len());
}

/// A link to a line of a file, which is named if it is another one than the panel's.
fn line_link(ui: &mut Ui, id: &str, file: &str, line: u64, is_named: bool, actions: &mut Vec<Action>) {
    let name = short(&[file.to_owned()]);
    let text = if is_named { tr!("file-line-3", name = name, line = line) } else { tr!("file-line-2", line = line) };
    let link = link(ui, &text);
    exported::note(ui, &link, id, WidgetRole::Button, &tr!("file-show-line-of", line = line, name = name), line);
    let link = link.on_hover_text(tr!("file-show-line-of", line = line, name = name));
    if link.clicked() {
        actions.push(Action::ShowLine(file.to_owned(), line));
    }
}

/// A small link; on a phone as large as a finger.
fn link(ui: &mut Ui, text: &str) -> Response {
    let small = RichText::new(text).small();
    if touch::least(ui) == 0.0 {
        return ui.add(Link::new(small));
    }
    let button = Button::new(small.color(ui.visuals().hyperlink_color)).frame(false);
    ui.add(button.min_size(Vec2::splat(touch::least(ui))))
}

/// The number of rows that a list leaves out.
fn more(ui: &mut Ui, count: usize) {
    if count > MOST_ROWS {
        let text = tr!("file-more-are-not-shown-gonio-inspect", count = count - MOST_ROWS);
        ui.add(Label::new(RichText::new(text).small().weak()).wrap());
    }
}

/// A row: a name, and a value that may take several lines.
fn figure(ui: &mut Ui, name: &str, value: &str) -> Response {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        name_of_row(ui, name);
        ui.add(Label::new(RichText::new(value).small()).wrap());
    })
    .response
}

fn name_of_row(ui: &mut Ui, name: &str) {
    let size = vec2(NAME_WIDTH, ui.text_style_height(&egui::TextStyle::Small));
    ui.allocate_ui_with_layout(size, egui::Layout::top_down(egui::Align::LEFT), |ui| {
        ui.set_width(NAME_WIDTH);
        ui.add(Label::new(RichText::new(name).small().weak()).wrap());
    });
}

/// Whether a model names a file that was not found.
fn lacks_files(inspection: &Inspection) -> bool {
    !missing(inspection).is_empty()
}
