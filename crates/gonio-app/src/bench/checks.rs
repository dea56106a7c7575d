//! The checks of the chosen function: computed beside the interface, shown as a table.

use super::functions::BenchFunctions;
use super::job::Job;
use crate::exported::{self, WidgetRole};
use crate::platform::Platform;
use crate::theme::{colors, icons};
use crate::widgets::{compact, heading};
use egui::{Button, Context, Grid, Label, RichText, Ui};
use gonio_bsdf::check::CHECK_PARTS;
use gonio_bsdf::{CheckedProperty, NamedBsdf};
use gonio_language::tr;

/// The checks of one function.
#[derive(Default)]
pub struct BenchChecks {
    /// The function that was checked last, or is being checked, and its version.
    of: Option<(u64, NamedBsdf)>,
    /// The properties measured so far.
    pub found: Vec<CheckedProperty>,
    /// The number of parts that have been started.
    started: usize,
    job: Option<Job<Vec<CheckedProperty>>>,
}

impl BenchChecks {
    /// Checks a function. A check that runs is forgotten.
    pub fn start(&mut self, version: u64, named: NamedBsdf) {
        *self = BenchChecks { of: Some((version, named)), ..BenchChecks::default() };
    }

    /// Whether a check is running.
    pub fn is_running(&self) -> bool {
        self.of.is_some() && (self.job.is_some() || self.started < CHECK_PARTS.len())
    }

    /// The name of the function that was checked.
    pub fn name(&self) -> Option<&str> {
        self.of.as_ref().map(|(_, named)| named.name.as_str())
    }

    /// Takes results, and starts the next part; called in every frame. On a page a part is computed between two frames.
    pub fn follow(&mut self, platform: &mut dyn Platform, ctx: &Context) {
        let Some((_, named)) = &self.of else { return };
        if let Some(result) = self.job.as_ref().and_then(Job::poll) {
            self.found.extend(result.unwrap_or_default());
            self.job = None;
        }
        if self.job.is_none()
            && let Some(part) = CHECK_PARTS.get(self.started)
        {
            self.started += 1;
            let (part, bsdf) = (*part, named.bsdf.clone());
            self.job = Some(Job::start(platform, ctx, move || part(bsdf.as_ref())));
            ctx.request_repaint();
        }
    }
}

/// Shows the table. Returns whether a check is requested.
pub fn show(ui: &mut Ui, functions: &BenchFunctions, checks: &BenchChecks) -> bool {
    let Some(function) = functions.chosen() else { return false };
    let mut is_requested = false;
    heading(ui, tr!("bench-checks"));
    ui.horizontal_wrapped(|ui| {
        ui.add(Label::new(RichText::new(&function.named.name).monospace()).truncate());
        if checks.is_running() {
            ui.spinner();
        } else {
            let button = ui.add(Button::new(tr!("bench-check")));
            exported::note(ui, &button, "check-function", WidgetRole::Button, tr!("bench-check"), "");
            let tip = tr!("bench-reciprocity-energy-positivity-normalisation-and-chi");
            is_requested = button.on_hover_text(tip).clicked();
        }
    });
    let Some((version, named)) = &checks.of else { return is_requested };
    if *version != function.version {
        let sentence = tr!("bench-below", name = named.name);
        ui.add(Label::new(RichText::new(sentence).small().weak()).wrap());
    }
    Grid::new("bench checks").num_columns(3).spacing([10.0, 3.0]).striped(false).show(ui, |ui| {
        for property in &checks.found {
            let (icon, word, tint) = match property.passed {
                true => (icons::CHECK, tr!("bench-pass"), colors::NORMAL),
                false => (icons::WARNING, tr!("bench-fail"), colors::ERROR),
            };
            ui.label(RichText::new(format!("{icon} {word}")).color(tint.of(ui)));
            let name = ui.label(property.property);
            exported::note(ui, &name, &format!("check-{}", property.property), WidgetRole::Text, word, property.value);
            ui.label(RichText::new(compact(property.value)).monospace());
            ui.end_row();
        }
    });
    for property in &checks.found {
        let text = format!("{}: {}.", property.property, property.explanation);
        let color = if property.passed { ui.visuals().weak_text_color() } else { colors::ERROR.of(ui) };
        ui.add(Label::new(RichText::new(text).small().color(color)).wrap());
    }
    is_requested
}
