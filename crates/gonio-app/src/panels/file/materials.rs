//! Materials: each value, and the line that it comes from.

use super::{MOST_ROWS, line_link, more, name_of_row};
use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::widgets::{NO_BREAK, grouped, heading};
use egui::{CollapsingHeader, FontFamily, Label, RichText, Ui};
use gonio_language::tr;
use gonio_scene::inspect::{Inspection, MaterialReport};

/// Materials that are open at first, if there are no more.
const FEW: usize = 2;

pub fn show(ui: &mut Ui, model: &str, inspection: &Inspection, actions: &mut Vec<Action>) {
    heading(ui, tr!("file-materials"));
    let is_open = inspection.materials.len() <= FEW;
    for (index, material) in inspection.materials.iter().take(MOST_ROWS).enumerate() {
        let name = if material.name.is_empty() { tr!("file-the-default-material") } else { &material.name };
        let title = tr!("file-triangles-3", name = name, count = grouped(material.triangles as u64, NO_BREAK));
        let header = CollapsingHeader::new(RichText::new(title)).id_salt(("material", index)).default_open(is_open);
        let shown = header.show(ui, |ui| values(ui, index, model, material, actions));
        let id = format!("file-material-{index}");
        exported::note(ui, &shown.header_response, &id, WidgetRole::Toggle, name, shown.fully_open());
    }
    more(ui, inspection.materials.len());
}

fn values(ui: &mut Ui, material: usize, model: &str, report: &MaterialReport, actions: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing.y = 3.0;
    let file = report.file.as_deref().unwrap_or(model);
    for value in &report.values {
        let id = format!("file-material-{material}-{}", value.property.replace('_', "-"));
        let property = value.property.replace('_', " ");
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            name_of_row(ui, &property);
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                let label = ui.add(Label::new(RichText::new(&value.value).small()).wrap());
                exported::note(ui, &label, &id, WidgetRole::Text, &property, &value.value);
                source(ui, &id, (file, file != model), (value.line, &value.written, &value.rule), actions);
            });
        });
    }
    for (index, unused) in report.unused.iter().enumerate() {
        let id = format!("file-material-{material}-unused-{index}");
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            name_of_row(ui, tr!("file-not-used"));
            ui.vertical(|ui| source(ui, &id, (file, file != model), (unused.line, &unused.written, ""), actions));
        });
    }
}

/// The text of the file that sets a value, the rule that changed it, and a link to the line.
fn source(
    ui: &mut Ui,
    id: &str,
    (file, is_other): (&str, bool),
    (line, written, rule): (Option<u64>, &str, &str),
    actions: &mut Vec<Action>,
) {
    if !written.is_empty() {
        ui.add(Label::new(RichText::new(written).small().family(FontFamily::Monospace).weak()).wrap());
    }
    if !rule.is_empty() {
        ui.add(Label::new(RichText::new(rule).small().weak()).wrap());
    }
    if let Some(line) = line {
        line_link(ui, &format!("{id}-line"), file, line, is_other, actions);
    }
}
