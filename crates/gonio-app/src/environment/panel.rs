//! The panel: where the environment comes from, its pictures, its orientation, and what it can be saved as.

use super::{EnvironmentFacts, EnvironmentProduct, EnvironmentView, pictures};
use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::panels::environment_image;
use crate::saving::Product;
use crate::session::Session;
use crate::theme::{self, colors, icons};
use crate::widgets::{choice, dropdown, heading, icon_button, row};
use egui::{Align, Button, Label, Layout as UiLayout, RichText, Ui, WidgetInfo, vec2};
use gonio_environment::Layout;
use gonio_environment::arrange::Arrangement;
use gonio_environment::encode::{Container, EnvironmentFormat};

const FORMATS: [(EnvironmentFormat, &str, &str); 3] = [
    (EnvironmentFormat::Exr, "EXR", "OpenEXR: linear light with half floats"),
    (EnvironmentFormat::Hdr, "HDR", "Radiance: linear light with a shared exponent"),
    (EnvironmentFormat::Png, "PNG", "Displayed colours, with the exposure and the tone map of the picture"),
];
const SIZES: [(Option<u32>, &str, &str); 6] = [
    (None, "as fine as the environment", "No detail is lost"),
    (Some(128), "128", "Faces of 128 x 128, a panorama of 512 x 256"),
    (Some(256), "256", "Faces of 256 x 256, a panorama of 1024 x 512"),
    (Some(512), "512", "Faces of 512 x 512, a panorama of 2048 x 1024"),
    (Some(1024), "1024", "Faces of 1024 x 1024, a panorama of 4096 x 2048"),
    (Some(2048), "2048", "Faces of 2048 x 2048, a panorama of 8192 x 4096"),
];
const LAYOUTS: [(Layout, &str, &str); 2] = [
    (Layout::OpenGl, "OpenGL", "As texture(samplerCube, direction) expects; an image viewer shows the faces mirrored"),
    (Layout::Photographic, "photographic", "The faces look right in an image viewer"),
];

/// Shows the panel.
pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    if session.loaded.is_none() {
        return;
    }
    ui.horizontal(|ui| {
        heading(ui, "Environment");
        ui.with_layout(UiLayout::right_to_left(Align::Center), |ui| {
            if icon_button(ui, "close-environment", icons::X, "Close the environment panel").clicked() {
                actions.push(Action::CloseEnvironment);
            }
            let tip = "Open a panorama, a cross, a strip, a KTX2 or DDS cubemap, or six faces; dropping them works too";
            if icon_button(ui, "open-environment", icons::FOLDER_OPEN, tip).clicked() {
                actions.push(Action::ChooseFiles);
            }
        });
    });
    environment_image(ui, &mut document.scene);
    let view = &mut session.environment;
    let Some(settings) = &document.scene.environment else {
        weak(ui, "The scene has no environment. Choose one above, or drop a panorama or six faces on the window.");
        return;
    };
    let is_in_memory = view.repaired.as_ref() == Some(&settings.image);
    match &mut view.studied {
        None => weak(ui, "Reading the environment..."),
        Some(Err(error)) => {
            let label = ui.add(Label::new(RichText::new(&*error).color(colors::ERROR.of(ui))).wrap());
            exported::note(ui, &label, "environment-error", WidgetRole::Text, error, "");
        }
        Some(Ok((study, shown))) => {
            origin(ui, &study.facts);
            ui.add_space(4.0);
            pictures::cube(ui, study, shown);
            ui.add_space(6.0);
            pictures::panorama(ui, study, shown);
            orientation(ui, &study.facts, view.conversion.is_some(), actions);
        }
    }
    if is_in_memory {
        weak(ui, "This repaired environment only exists in the window: save it to keep it.");
    }
    if view.facts().is_some() {
        heading(ui, "Convert and save");
        conversions(ui, view, actions);
    }
}

fn weak(ui: &mut Ui, sentence: &str) {
    let label = ui.add(Label::new(RichText::new(sentence).weak()).wrap());
    exported::note(ui, &label, "environment-note", WidgetRole::Text, sentence, "");
}

/// The arrangement in which the environment came, in words.
fn arrangement(facts: &EnvironmentFacts) -> &'static str {
    match (facts.arrangement, facts.files) {
        (_, 0) => "Built in",
        (Arrangement::Equirectangular, _) => "Panorama",
        (Arrangement::Cross, _) => "Horizontal cross",
        (Arrangement::VerticalCross, _) => "Vertical cross",
        (Arrangement::Strip, _) => "Horizontal strip",
        (Arrangement::VerticalStrip, _) => "Vertical strip",
        (Arrangement::Faces, 1) => "Cubemap in one file",
        (Arrangement::Faces, _) => "Six files",
    }
}

/// Where the environment comes from.
fn origin(ui: &mut Ui, facts: &EnvironmentFacts) {
    row(ui, "Came as", "The arrangement of the environment in its files", |ui| {
        let name = arrangement(facts);
        let text = facts.format.map_or_else(|| name.to_owned(), |format| format!("{name} ({format})"));
        let label = ui.add(Label::new(&text).truncate());
        exported::note(ui, &label, "environment-arrangement", WidgetRole::Text, "came as", &text);
    });
    row(ui, "Form", "Size of the faces or of the panorama, and the layout in which the faces are read", |ui| {
        let label = ui.add(Label::new(&facts.description).wrap());
        exported::note(ui, &label, "environment-form", WidgetRole::Text, "form", &facts.description);
    });
}

/// The finding of the check, and the button that repairs.
fn orientation(ui: &mut Ui, facts: &EnvironmentFacts, is_busy: bool, actions: &mut Vec<Action>) {
    heading(ui, "Orientation");
    let (tint, icon) = if facts.fits { (colors::CORRECT, icons::CHECK) } else { (colors::WARNING, icons::WARNING) };
    for (index, text) in facts.sentences.iter().enumerate() {
        let text = sentence(text);
        ui.horizontal_top(|ui| {
            if index == 0 {
                ui.label(RichText::new(icon).font(theme::icon_font(15.0)).color(tint.of(ui)));
            } else {
                ui.add_space(15.0 + ui.spacing().item_spacing.x);
            }
            let color = if index == 0 { tint.of(ui) } else { ui.visuals().weak_text_color() };
            let label = ui.add(Label::new(RichText::new(&text).color(color)).wrap());
            let id = format!("environment-finding-{index}");
            exported::note(ui, &label, &id, WidgetRole::Text, &text, facts.fits);
        });
    }
    if facts.is_repairable {
        let tip = "Puts every face in its place; no texel changes. The step can be undone.";
        if button(ui, "repair-environment", "Repair", tip, !is_busy) {
            actions.push(Action::RepairEnvironment);
        }
    }
}

/// A finding of the check as a sentence.
fn sentence(finding: &str) -> String {
    let mut letters = finding.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    let text: String = first.chain(letters).collect();
    format!("{text}.")
}

fn button(ui: &mut Ui, id: &str, title: &str, tip: &str, is_enabled: bool) -> bool {
    let response = ui.add_enabled(is_enabled, Button::new(title).min_size(vec2(0.0, 24.0)));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, is_enabled, title));
    exported::note(ui, &response, id, WidgetRole::Button, title, "");
    response.on_hover_text(tip).clicked()
}

/// The settings of conversions, and a button for each product.
fn conversions(ui: &mut Ui, view: &mut EnvironmentView, actions: &mut Vec<Action>) {
    let Some(facts) = view.facts() else { return };
    let (preserving, high_dynamic_range) = (facts.preserving, facts.high_dynamic_range);
    let mut format = view.format.unwrap_or(preserving);
    row(ui, "Format", "The format of pictures; KTX2 has its own", |ui| {
        choice(ui, "environment-format", "format of pictures", &mut format, &FORMATS, preserving);
    });
    view.format = Some(format);
    row(ui, "Size", "Texels along an edge of a face; a panorama is four times as wide", |ui| {
        dropdown(ui, "environment-size", "size", &mut view.size, &SIZES);
    });
    row(ui, "Layout", "The layout of the faces in the files", |ui| {
        choice(ui, "environment-layout", "layout of faces", &mut view.layout, &LAYOUTS, Layout::OpenGl);
    });
    if high_dynamic_range && format == EnvironmentFormat::Png {
        weak(ui, "A PNG holds displayed colours: light above 1 is lost.");
    }
    let is_busy = view.is_converting();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(6.0, 6.0);
        for (container, is_zip, tip) in PRODUCTS {
            let product = EnvironmentProduct {
                container: *container,
                format,
                size: view.size,
                layout: view.layout,
                is_zip: *is_zip,
            };
            if button(ui, &format!("save-{}", product.id()), product.title(), tip, !is_busy) {
                actions.push(Action::Save(Product::Environment(product)));
            }
        }
    });
    if is_busy {
        weak(ui, "Converting the environment...");
    }
}

const ZIP: (Container, bool, &str) = (Container::Faces, true, "posx to negz, six pictures in one zip file");
const CROSS: (Container, bool, &str) = (Container::Cross, false, "The unfolded cube in one picture, 4 by 3 faces");
const PANORAMA: (Container, bool, &str) = (Container::Equirectangular, false, "One picture, twice as wide as high");
const KTX2: (Container, bool, &str) = (Container::Ktx2, false, "A cubemap with its mip levels, in OpenGL's layout");
/// What the environment can be saved as. A page cannot save several files at once.
const PRODUCTS: &[(Container, bool, &str)] = if cfg!(target_arch = "wasm32") {
    &[ZIP, CROSS, KTX2, PANORAMA]
} else {
    &[
        ZIP,
        (Container::Faces, false, "Six pictures: sky.exr is saved as sky_posx.exr to sky_negz.exr"),
        CROSS,
        KTX2,
        PANORAMA,
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_become_sentences() {
        assert_eq!(sentence("12 of the twelve edges meet"), "12 of the twelve edges meet.");
        assert_eq!(sentence("the panorama closes"), "The panorama closes.");
    }
}
