//! The files that a scene or a model names, as a list to check off.

use super::{MOST_ROWS, diagnostics, lacks_files, line_link, more, title};
use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::files::short;
use crate::inspector::missing;
use crate::session::Session;
use crate::theme::{self, colors, icons};
use crate::widgets::heading;
use egui::{Label, Response, RichText, Ui};
use gonio_language::tr;
use gonio_mesh::Diagnostic;
use gonio_scene::inspect::Inspection;
use gonio_scene::scene_file::ObjectSpec;
use gonio_scene::{Scene, environment_file};

/// A file that a model names.
struct ListedFile<'a> {
    name: &'a str,
    found: Option<&'a str>,
    tried: &'a [String],
    refused: Option<&'a str>,
    /// What names it, and where.
    used_by: String,
    place: Option<(&'a str, u64)>,
}

/// The files that a model names, and a hint where some are missing.
pub fn of_model(ui: &mut Ui, model: &str, inspection: &Inspection, actions: &mut Vec<Action>) {
    let files = named_files(model, inspection);
    if files.is_empty() && inspection.images.is_empty() {
        return;
    }
    heading(ui, tr!("file-files"));
    let all = files.len();
    let absent = missing(inspection).len();
    let summary = match (absent, all) {
        _ if all == 0 => tr!("file-the-textures-are-inside-the-model").to_owned(),
        (0, 1) => tr!("file-the-file-that-the-model-names-2").to_owned(),
        (0, _) => tr!("file-all-files-that-the-model-names", all = all),
        (1, 1) => tr!("file-the-file-that-the-model-names").to_owned(),
        (1, _) => tr!("file-one-of-files-that-the-model", all = all),
        _ => tr!("file-of-files-that-the-model-names", absent = absent, all = all),
    };
    let color = if absent > 0 { colors::WARNING.of(ui) } else { ui.visuals().weak_text_color() };
    let label = ui.add(Label::new(RichText::new(&summary).small().color(color)).wrap());
    exported::note(ui, &label, "files-summary", WidgetRole::Text, &summary, absent);
    for (index, file) in files.iter().take(MOST_ROWS).enumerate() {
        row(ui, index, model, file, actions);
    }
    more(ui, files.len());
    for image in inspection.images.iter().take(MOST_ROWS) {
        let name = if image.name.is_empty() { tr!("file-no-name") } else { &image.name };
        let text = tr!("file-inside-the-file", size = super::contents::bytes(image.bytes as u64));
        marked(ui, true, name, |ui| drop(ui.label(RichText::new(text).small().weak())));
    }
    more(ui, inspection.images.len());
    if lacks_files(inspection) {
        let text = tr!("file-drop-the-missing-files-on-the");
        let label = ui.add(Label::new(RichText::new(text).small()).wrap());
        exported::note(ui, &label, "files-hint", WidgetRole::Text, text, "");
        choose(ui, actions);
    }
}

fn choose(ui: &mut Ui, actions: &mut Vec<Action>) {
    let icon = RichText::new(icons::FOLDER_OPEN).font(theme::icon_font(15.0));
    let button = ui.button((icon, tr!("file-choose-files")));
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, tr!("file-choose-files")));
    exported::note(ui, &button, "files-choose", WidgetRole::Button, tr!("file-choose-files"), "");
    if button.clicked() {
        actions.push(Action::ChooseFiles);
    }
}

/// Sidecars and textures; a texture that several materials use is listed once.
fn named_files<'a>(model: &'a str, inspection: &'a Inspection) -> Vec<ListedFile<'a>> {
    let mut files: Vec<ListedFile<'a>> = inspection
        .files
        .iter()
        .map(|file| ListedFile {
            name: &file.name,
            found: file.found.as_deref(),
            tried: &file.tried,
            refused: file.refused.as_deref(),
            used_by: String::new(),
            place: file.line.map(|line| (model, line)),
        })
        .collect();
    for texture in &inspection.textures {
        let is_same = |file: &&ListedFile<'_>| file.name == texture.name && file.found == texture.found.as_deref();
        let is_inside = inspection.images.iter().any(|image| image.name == texture.name) && texture.tried.is_empty();
        if is_inside || files.iter().any(|file| is_same(&file)) {
            continue;
        }
        let library = inspection.materials.iter().find(|material| material.name == texture.material);
        let library = library.and_then(|material| material.file.as_deref()).unwrap_or(model);
        let used_by = match texture.size {
            Some([width, height]) => {
                tr!("file-of-x-texels", key = texture.key, material = texture.material, width = width, height = height)
            }
            None => tr!("file-of", key = texture.key, material = texture.material),
        };
        files.push(ListedFile {
            name: &texture.name,
            found: texture.found.as_deref(),
            tried: &texture.tried,
            refused: texture.refused.as_deref(),
            used_by,
            place: texture.line.map(|line| (library, line)),
        });
    }
    files
}

fn row(ui: &mut Ui, index: usize, model: &str, file: &ListedFile<'_>, actions: &mut Vec<Action>) {
    let state = match (file.found, file.refused) {
        (Some(_), _) => "found",
        (None, Some(_)) => tr!("file-not-read-2"),
        (None, None) => "missing",
    };
    let detail = match (file.found, file.refused) {
        (Some(path), _) if path.replace('\\', "/").ends_with(&file.name.replace('\\', "/")) => String::new(),
        (Some(path), _) => tr!("file-found-as", path = path),
        (None, Some(refused)) => tr!("file-not-read", refused = refused),
        (None, None) if file.tried.is_empty() => tr!("file-missing-there-is-no-folder-to").to_owned(),
        (None, None) => tr!("file-missing-searched", folders = file.tried.join(", ")),
    };
    let row = marked(ui, file.found.is_some(), file.name, |ui| {
        for text in [&file.used_by, &detail].into_iter().filter(|text| !text.is_empty()) {
            ui.add(Label::new(RichText::new(text).small().weak()).wrap());
        }
        if let Some((of, line)) = file.place {
            line_link(ui, &format!("named-file-{index}-line"), of, line, of != model, actions);
        }
    });
    exported::note(ui, &row, &format!("named-file-{index}"), WidgetRole::Text, file.name, state);
}

/// A name with a check mark, or with a warning, and details below it.
fn marked(ui: &mut Ui, is_found: bool, name: &str, details: impl FnOnce(&mut Ui)) -> Response {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let (icon, tint, state) = if is_found {
            (icons::CHECK, colors::CORRECT, "found")
        } else {
            (icons::WARNING_CIRCLE, colors::WARNING, "missing")
        };
        let mark = ui.label(RichText::new(icon).font(theme::icon_font(15.0)).color(tint.of(ui)));
        mark.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, state));
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.add(Label::new(name).wrap());
            details(ui);
        });
    })
    .response
}

/// The files that a scene file names. They were found: a scene that lacks one is not opened.
pub fn of_scene(ui: &mut Ui, session: &mut Session, loaded: &Scene, actions: &mut Vec<Action>) {
    let scene = session.inspector.chosen().to_owned();
    if scene.is_empty() {
        return;
    }
    title(ui, &scene);
    let button = ui.button(tr!("file-show-the-text"));
    exported::note(ui, &button, "file-text", WidgetRole::Button, tr!("file-show-the-text"), &scene);
    if button.clicked() {
        actions.push(Action::ShowLine(scene.clone(), 1));
    }
    heading(ui, tr!("file-files"));
    let models: Vec<String> = session.inspector.models().iter().map(|model| model.name.clone()).collect();
    for (index, model) in models.iter().enumerate() {
        let objects = loaded.settings.objects.iter().filter(|object| object.model == *model).count();
        let lacks = lacks(session, model);
        marked(ui, true, &short(std::slice::from_ref(model)), |ui| {
            let text = if objects == 1 {
                tr!("file-model-of-one-object").to_owned()
            } else {
                tr!("file-model-of-objects", objects = objects)
            };
            ui.label(RichText::new(text).small().weak());
            if lacks > 0 {
                let text = tr!("file-files-that-it-names-and-that", lacks = lacks);
                ui.add(Label::new(RichText::new(text).small().color(colors::WARNING.of(ui))).wrap());
            }
            let link = super::link(ui, tr!("file-show-its-content"));
            exported::note(
                ui,
                &link,
                &format!("scene-model-{index}"),
                WidgetRole::Button,
                tr!("file-show-its-content"),
                model,
            );
            if link.clicked() {
                session.inspector.choose(model.clone());
            }
        });
    }
    let environment = loaded.settings.environment.iter();
    let pictures =
        environment.flat_map(|environment| std::iter::once(&environment.image).chain(&environment.background));
    for picture in pictures.filter(|name| environment_file::builtin_of(name).is_none()) {
        marked(ui, true, picture, |ui| drop(ui.label(RichText::new("environment").small().weak())));
    }
    let materials = loaded.settings.objects.iter().flat_map(ObjectSpec::materials);
    for function in materials.filter_map(|material| material.brdf_file.as_ref()) {
        marked(ui, true, function, |ui| drop(ui.label(RichText::new(tr!("file-brdf-of-an-object")).small().weak())));
    }
    let is_of_model = |found: &&Diagnostic| found.place.file.as_ref().is_some_and(|file| models.contains(file));
    let rest: Vec<Diagnostic> = loaded.diagnostics.iter().filter(|found| !is_of_model(found)).cloned().collect();
    diagnostics(ui, &rest, &scene, actions);
}

/// Number of files that a model lacks, once it was inspected.
fn lacks(session: &Session, model: &str) -> usize {
    let model = session.inspector.models().iter().find(|known| known.name == model);
    let inspection = model.and_then(|model| model.result.as_ref()?.as_ref().ok());
    inspection.map_or(0, |inspection| missing(inspection).len())
}
