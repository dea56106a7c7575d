//! The list of exercises.

use super::command::ExerciseCommand;
use super::work::Work;
use crate::exported::{self, WidgetRole};
use crate::theme::{self, colors};
use egui::{CentralPanel, CornerRadius, Frame, Label, Margin, RichText, ScrollArea, Sense, Ui, UiBuilder};
use gonio_check::verdict::Outcome;
use gonio_exercises::exercise;

/// Longest line of text, points.
const WIDTH: f32 = 720.0;

/// Shows the exercises, a card each; `begun` are those in progress.
pub fn show(ui: &mut Ui, begun: &[&Work], commands: &mut Vec<ExerciseCommand>) {
    let inside = Frame::NONE.inner_margin(Margin::symmetric(14, 10));
    CentralPanel::default().frame(inside).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            let margin = ((ui.available_width() - WIDTH) / 2.0).max(0.0);
            ui.horizontal_top(|ui| {
                ui.add_space(margin);
                ui.vertical(|ui| {
                    ui.set_max_width(WIDTH.min(ui.available_width()));
                    ui.label(RichText::new("Exercises").font(theme::bold(20.0)).color(ui.visuals().strong_text_color()));
                    let sentence = "Edit shaders, compare them live with the correct answer, and have gonio find the mistakes: \
                                    by name, by line, and how to fix them.";
                    ui.add(Label::new(RichText::new(sentence).weak()).wrap());
                    ui.add_space(8.0);
                    for exercise in exercise::all() {
                        let begun = begun.iter().find(|work| work.exercise.id == exercise.id);
                        card(ui, exercise, begun.map(|work| state_of(work)), commands);
                    }
                });
            });
        });
    });
}

/// State of an exercise, in a word.
fn state_of(work: &Work) -> &'static str {
    let outcome = work.judged.as_ref().and_then(|judged| judged.verdict.as_ref().ok()).map(|found| found.verdict);
    match outcome {
        Some(Outcome::Correct) => "correct",
        _ if work.is_changed() => "unsaved",
        _ => "in progress",
    }
}

fn card(ui: &mut Ui, exercise: &exercise::Exercise, state: Option<&str>, commands: &mut Vec<ExerciseCommand>) {
    let builder = UiBuilder::new().id_salt(&exercise.id).sense(Sense::click());
    let response = ui
        .scope_builder(builder, |ui| {
            let hovered = ui.response().hovered();
            let fill = if hovered { ui.visuals().widgets.hovered.bg_fill } else { ui.visuals().faint_bg_color };
            let frame =
                Frame::NONE.fill(fill).corner_radius(CornerRadius::same(7)).inner_margin(Margin::symmetric(12, 9));
            frame.show(ui, |ui| {
                ui.set_min_width(ui.available_width());
                ui.horizontal(|ui| {
                    ui.add(words(RichText::new(&exercise.id).monospace().color(colors::ACCENT.of(ui))));
                    ui.add(words(
                        RichText::new(&exercise.title).font(theme::bold(14.5)).color(ui.visuals().strong_text_color()),
                    ));
                    if let Some(state) = state {
                        let color = if state == "correct" { colors::NORMAL } else { colors::WARNING };
                        ui.add(words(RichText::new(state).small().color(color.of(ui))));
                    }
                });
                ui.add(words(RichText::new(&exercise.summary)).wrap());
            });
        })
        .response;
    exported::note(ui, &response, &format!("exercise-{}", exercise.id), WidgetRole::Button, &exercise.title, "");
    if response.on_hover_cursor(egui::CursorIcon::PointingHand).clicked() {
        commands.push(ExerciseCommand::Begin(exercise.id.clone()));
    }
}

/// A label that lets clicks through to the card.
fn words(text: RichText) -> Label {
    Label::new(text).selectable(false)
}
