//! The page with the meaning and the value of each variable.

use super::work::Work;
use crate::theme::{self, colors};
use egui::{CornerRadius, Frame, Label, Margin, RichText, Ui};
use gonio_exercises::preview::VariableValue;

/// Shows them: those that nothing is known of first.
pub fn show(ui: &mut Ui, work: &Work) {
    ui.spacing_mut().item_spacing.y = 5.0;
    let given = &work.program.variables;
    if given.is_empty() {
        let words = "Once your program compiles, this page lists the meaning and the value of each of your attributes and \
                     uniforms.";
        ui.add(Label::new(RichText::new(words).weak()).wrap());
        return;
    }
    let unknown: Vec<&VariableValue> = given.iter().filter(|given| given.role.is_none()).collect();
    if let Some(first) = unknown.first() {
        hint(ui, &first.name, unknown.len());
    }
    for given in unknown.into_iter().chain(given.iter().filter(|given| given.role.is_some())) {
        row(ui, given);
    }
    for warning in &work.program.warnings {
        ui.add(Label::new(RichText::new(warning).color(colors::WARNING.of(ui))).wrap());
    }
    ui.add_space(16.0);
}

fn hint(ui: &mut Ui, name: &str, count: usize) {
    let frame = Frame::NONE.fill(colors::WARNING.of(ui).gamma_multiply(0.14)).corner_radius(CornerRadius::same(6));
    frame.inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        let which = if count == 1 { "One variable is" } else { "Some variables are" };
        let words = format!(
            "{which} not recognised, and set to 0. Ignore this for variables that you do not need. Otherwise declare their \
             meaning in a file names.toml:"
        );
        ui.add(Label::new(words).wrap());
        let example = format!("[names]\n\"{name}\" = \"light-pos\"   # or a value: [1.0, 0.5, 0.2]");
        ui.add(Label::new(RichText::new(example).monospace()).wrap());
    });
}

fn row(ui: &mut Ui, given: &VariableValue) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(&given.glsl_type).monospace().weak());
        ui.label(RichText::new(&given.name).monospace().color(ui.visuals().strong_text_color()));
        match &given.role {
            Some((role, how)) => {
                ui.label(RichText::new(role).font(theme::bold(13.0)).color(colors::ACCENT.of(ui))).on_hover_text(how);
            }
            None => {
                ui.label(RichText::new("not recognised").color(colors::WARNING.of(ui)));
            }
        }
        if !given.value.contains('\n') {
            ui.label(RichText::new(&given.value).monospace());
        }
    });
    if given.value.contains('\n') {
        ui.indent(&given.name, |ui| ui.label(RichText::new(columns(&given.value)).monospace().size(11.0)));
    }
}

/// A matrix with its columns below each other.
fn columns(matrix: &str) -> String {
    let rows: Vec<Vec<&str>> = matrix.lines().map(|row| row.split_whitespace().collect()).collect();
    let width = rows.iter().flatten().map(|number| number.len()).max().unwrap_or(0);
    let line = |row: &Vec<&str>| row.iter().map(|number| format!("{number:>width$}")).collect::<Vec<_>>().join("  ");
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}
