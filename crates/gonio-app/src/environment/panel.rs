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
use gonio_language::tr;

const FORMATS: [(EnvironmentFormat, &str, &str); 3] = [
    (EnvironmentFormat::Exr, "EXR", "environment-openexr-linear-light-with-half-floats"),
    (EnvironmentFormat::Hdr, "HDR", "environment-radiance-linear-light-with-a-shared"),
    (EnvironmentFormat::Png, "PNG", "environment-displayed-colours-with-the-exposure-and"),
];
const SIZES: [(Option<u32>, &str, &str); 6] = [
    (None, "environment-as-fine-as-the-environment", "environment-no-detail-is-lost"),
    (Some(128), "128", "environment-faces-of-128-x-128-a"),
    (Some(256), "256", "environment-faces-of-256-x-256-a"),
    (Some(512), "512", "environment-faces-of-512-x-512-a"),
    (Some(1024), "1024", "environment-faces-of-1024-x-1024-a"),
    (Some(2048), "2048", "environment-faces-of-2048-x-2048-a"),
];
const LAYOUTS: [(Layout, &str, &str); 2] = [
    (Layout::OpenGl, "OpenGL", "environment-as-texture-samplercube-direction-expects-an"),
    (Layout::Photographic, "photographic", "environment-the-faces-look-right-in-an"),
];

/// Shows the panel.
pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    if session.loaded.is_none() {
        return;
    }
    ui.horizontal(|ui| {
        heading(ui, tr!("environment-environment"));
        ui.with_layout(UiLayout::right_to_left(Align::Center), |ui| {
            if icon_button(ui, "close-environment", icons::X, tr!("environment-close-the-environment-panel")).clicked()
            {
                actions.push(Action::CloseEnvironment);
            }
            let tip = tr!("environment-open-a-panorama-a-cross-a");
            if icon_button(ui, "open-environment", icons::FOLDER_OPEN, tip).clicked() {
                actions.push(Action::ChooseFiles);
            }
        });
    });
    environment_image(ui, &mut document.scene);
    let view = &mut session.environment;
    let Some(settings) = &document.scene.environment else {
        weak(ui, tr!("environment-the-scene-has-no-environment-choose-2"));
        return;
    };
    let is_in_memory = view.repaired.as_ref() == Some(&settings.image);
    match &mut view.studied {
        None => weak(ui, tr!("environment-reading-the-environment")),
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
        weak(ui, tr!("environment-this-repaired-environment-only-exists-in"));
    }
    if view.facts().is_some() {
        heading(ui, tr!("environment-convert-and-save"));
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
        (_, 0) => tr!("environment-built-in"),
        (Arrangement::Equirectangular, _) => tr!("environment-panorama"),
        (Arrangement::Cross, _) => tr!("environment-horizontal-cross"),
        (Arrangement::VerticalCross, _) => tr!("environment-vertical-cross"),
        (Arrangement::Strip, _) => tr!("environment-horizontal-strip"),
        (Arrangement::VerticalStrip, _) => tr!("environment-vertical-strip"),
        (Arrangement::Faces, 1) => tr!("environment-cubemap-in-one-file"),
        (Arrangement::Faces, _) => tr!("environment-six-files"),
    }
}

/// Where the environment comes from.
fn origin(ui: &mut Ui, facts: &EnvironmentFacts) {
    row(ui, tr!("environment-came-as-2"), tr!("environment-the-arrangement-of-the-environment-in"), |ui| {
        let name = arrangement(facts);
        let text = facts.format.map_or_else(|| name.to_owned(), |format| format!("{name} ({format})"));
        let label = ui.add(Label::new(&text).truncate());
        exported::note(ui, &label, "environment-arrangement", WidgetRole::Text, tr!("environment-came-as"), &text);
    });
    row(ui, tr!("environment-form"), tr!("environment-size-of-the-faces-or-of"), |ui| {
        let label = ui.add(Label::new(&facts.description).wrap());
        exported::note(ui, &label, "environment-form", WidgetRole::Text, "form", &facts.description);
    });
}

/// The finding of the check, and the button that repairs.
fn orientation(ui: &mut Ui, facts: &EnvironmentFacts, is_busy: bool, actions: &mut Vec<Action>) {
    heading(ui, tr!("environment-orientation"));
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
        let tip = tr!("environment-puts-every-face-in-its-place");
        if button(ui, "repair-environment", tr!("environment-repair"), tip, !is_busy) {
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
    row(ui, tr!("environment-format"), tr!("environment-the-format-of-pictures-ktx2-has"), |ui| {
        choice(
            ui,
            "environment-format",
            tr!("environment-format-of-pictures"),
            &mut format,
            &FORMATS.map(|(format, name, tip)| (format, name, tr!(tip))),
            preserving,
        );
    });
    view.format = Some(format);
    row(ui, tr!("environment-size"), tr!("environment-texels-along-an-edge-of-a"), |ui| {
        dropdown(
            ui,
            "environment-size",
            "size",
            &mut view.size,
            &SIZES.map(|(size, name, tip)| (size, tr!(name), tr!(tip))),
        );
    });
    row(ui, tr!("environment-layout"), tr!("environment-the-layout-of-the-faces-in"), |ui| {
        choice(
            ui,
            "environment-layout",
            tr!("environment-layout-of-faces"),
            &mut view.layout,
            &LAYOUTS.map(|(layout, name, tip)| (layout, name, tr!(tip))),
            Layout::OpenGl,
        );
    });
    if high_dynamic_range && format == EnvironmentFormat::Png {
        weak(ui, tr!("environment-a-png-holds-displayed-colours-light"));
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
            if button(ui, &format!("save-{}", product.id()), product.title(), tr!(tip), !is_busy) {
                actions.push(Action::Save(Product::Environment(product)));
            }
        }
    });
    if is_busy {
        weak(ui, tr!("environment-converting-the-environment"));
    }
}

const ZIP: (Container, bool, &str) = (Container::Faces, true, "environment-posx-to-negz-six-pictures-in");
const CROSS: (Container, bool, &str) = (Container::Cross, false, "environment-the-unfolded-cube-in-one-picture");
const PANORAMA: (Container, bool, &str) =
    (Container::Equirectangular, false, "environment-one-picture-twice-as-wide-as");
const KTX2: (Container, bool, &str) = (Container::Ktx2, false, "environment-a-cubemap-with-its-mip-levels");
/// What the environment can be saved as. A page cannot save several files at once.
const PRODUCTS: &[(Container, bool, &str)] = if cfg!(target_arch = "wasm32") {
    &[ZIP, CROSS, KTX2, PANORAMA]
} else {
    &[ZIP, (Container::Faces, false, "environment-six-pictures-sky-exr-is-saved"), CROSS, KTX2, PANORAMA]
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
