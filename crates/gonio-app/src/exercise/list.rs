//! The list of exercises.

use super::command::ExerciseCommand;
use super::goal_pictures::GoalPictures;
use super::thumbnails::Thumbnails;
use super::work::Work;
use crate::exported::{self, WidgetRole};
use crate::scene_view::drawing::PaneRenderer;
use crate::scene_view::{picture_size, present};
use crate::theme::{self, colors, colors::Tint, icons};
use egui::{
    Align2, CentralPanel, CornerRadius, Frame, Label, Margin, Rect, RichText, ScrollArea, Sense, Ui, UiBuilder, Vec2,
    vec2,
};
use gonio_check::verdict::Outcome;
use gonio_exercises::exercise::{self, Exercise, ExerciseKind};
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_scene::files::FileSource;
use std::collections::BTreeMap;

/// Longest line of text, points.
const WIDTH: f32 = 760.0;
/// Size of the goal's picture, points.
const THUMBNAIL: Vec2 = vec2(92.0, 69.0);

/// What is known about the exercises: those in progress, and the last outcomes by id.
pub struct ExerciseProgress<'a> {
    /// The exercises in progress.
    pub begun: &'a [&'a Work],
    /// The outcome of the last check of each exercise, also of earlier windows.
    pub outcomes: &'a BTreeMap<String, Outcome>,
}

/// The pictures of the goals.
pub struct Goals<'a> {
    /// Those of pairs of shaders, if there is OpenGL.
    pub drawn: Option<&'a mut Thumbnails>,
    /// All others.
    pub built_in: &'a mut GoalPictures,
    /// Has the built-in files.
    pub files: &'a dyn FileSource,
}

/// Shows the exercises, a card each, with the picture of the goal.
pub fn show(
    ui: &mut Ui,
    progress: &ExerciseProgress<'_>,
    mut goals: Goals<'_>,
    mut panes: Option<&mut PaneRenderer>,
    commands: &mut Vec<ExerciseCommand>,
) -> Result<(), GlError> {
    let (mut result, mut was_one_drawn) = (Ok(()), false);
    let inside = Frame::NONE.inner_margin(Margin::symmetric(14, 10));
    CentralPanel::default().frame(inside).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            let margin = ((ui.available_width() - WIDTH) / 2.0).max(0.0);
            ui.horizontal_top(|ui| {
                ui.add_space(margin);
                ui.vertical(|ui| {
                    ui.set_max_width(WIDTH.min(ui.available_width()));
                    ui.label(
                        RichText::new(tr!("exercise-exercises"))
                            .font(theme::bold(20.0))
                            .color(ui.visuals().strong_text_color()),
                    );
                    let sentence = tr!("exercise-edit-shaders-compare-them-live-with");
                    ui.add(Label::new(RichText::new(sentence).weak()).wrap());
                    ui.add_space(8.0);
                    for exercise in exercise::all() {
                        let picture = card(ui, exercise, state_of(exercise, progress), commands);
                        if !ui.is_rect_visible(picture) {
                            continue;
                        }
                        if exercise.kind != ExerciseKind::Shaders {
                            goals.built_in.show(ui, picture, exercise, goals.files);
                            continue;
                        }
                        let (Some(thumbnails), Some(panes)) = (goals.drawn.as_deref_mut(), panes.as_deref_mut()) else {
                            continue;
                        };
                        if let Some(shown) = thumbnails.picture(exercise, panes) {
                            present(ui, picture, shown);
                        } else if !thumbnails.is_done(exercise) {
                            // One in each frame, so that the list can be used meanwhile.
                            if !std::mem::replace(&mut was_one_drawn, true) {
                                let size = picture_size(picture, ui.ctx().pixels_per_point());
                                result = thumbnails.draw(exercise, size, panes);
                            }
                            ui.ctx().request_repaint();
                        }
                    }
                });
            });
        });
    });
    result
}

/// The state of an exercise in words, with its colour; the colour is `None` for one that was not started.
fn state_of(exercise: &Exercise, progress: &ExerciseProgress<'_>) -> (String, Option<Tint>) {
    let work = progress.begun.iter().find(|work| work.exercise.id == exercise.id);
    let judged = work.and_then(|work| work.judged.as_ref()).and_then(|judged| judged.verdict.as_ref().ok());
    let outcome = judged.map(|verdict| verdict.verdict).or_else(|| progress.outcomes.get(&exercise.id).copied());
    let (word, tint) = match outcome {
        Some(Outcome::Correct) => (tr!("exercise-correct-state"), Some(colors::CORRECT)),
        Some(Outcome::Wrong) => (tr!("exercise-wrong-state"), Some(colors::WRONG)),
        Some(Outcome::DoesNotCompile) => (tr!("exercise-does-not-compile"), Some(colors::WRONG)),
        Some(Outcome::Unsure) => (tr!("exercise-not-judged"), Some(colors::ACCENT)),
        None if work.is_some() => (tr!("exercise-in-progress"), Some(colors::ACCENT)),
        None => (tr!("exercise-not-started"), None),
    };
    match work.is_some_and(|work| work.is_changed()) {
        true => (tr!("exercise-unsaved-changes", word = word), tint),
        false => (word.to_owned(), tint),
    }
}

/// Shows the card of an exercise. Returns the place of its picture, where an icon is shown until there is one.
fn card(
    ui: &mut Ui,
    exercise: &Exercise,
    (state, tint): (String, Option<Tint>),
    commands: &mut Vec<ExerciseCommand>,
) -> Rect {
    let builder = UiBuilder::new().id_salt(&exercise.id).sense(Sense::click());
    let mut picture = Rect::NOTHING;
    let response = ui
        .scope_builder(builder, |ui| {
            let hovered = ui.response().hovered();
            let fill = if hovered { ui.visuals().widgets.hovered.bg_fill } else { ui.visuals().faint_bg_color };
            let frame = Frame::NONE.fill(fill).corner_radius(CornerRadius::same(7)).inner_margin(Margin::same(8));
            frame.show(ui, |ui| {
                ui.set_min_width(ui.available_width());
                ui.horizontal_top(|ui| {
                    ui.spacing_mut().item_spacing.x = 12.0;
                    picture = ui.allocate_exact_size(THUMBNAIL, Sense::hover()).0;
                    ui.painter().rect_filled(picture, 4.0, ui.visuals().extreme_bg_color);
                    let color = ui.visuals().weak_text_color();
                    let font = theme::icon_font(30.0);
                    ui.painter().text(picture.center(), Align2::CENTER_CENTER, icon(exercise.kind), font, color);
                    ui.vertical(|ui| {
                        ui.horizontal_wrapped(|ui| {
                            ui.spacing_mut().item_spacing.x = 8.0;
                            ui.add(words(RichText::new(&exercise.id).monospace().color(colors::ACCENT.of(ui))));
                            let title = RichText::new(exercise.title()).font(theme::bold(14.5));
                            ui.add(words(title.color(ui.visuals().strong_text_color())));
                            let color = tint.map_or(ui.visuals().weak_text_color(), |tint| tint.of(ui));
                            ui.add(words(RichText::new(&state).small().color(color)));
                        });
                        ui.add(words(RichText::new(exercise.summary())).wrap());
                    });
                });
            });
        })
        .response;
    let id = format!("exercise-{}", exercise.id);
    exported::note(ui, &response, &id, WidgetRole::Button, exercise.title(), state.as_str());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Button, true, format!("{} {}, {state}", exercise.id, exercise.title()))
    });
    if response.on_hover_cursor(egui::CursorIcon::PointingHand).clicked() {
        commands.push(ExerciseCommand::Begin(exercise.id.clone()));
    }
    picture
}

/// An icon for the kind of answer.
fn icon(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Shaders => icons::SPHERE,
        ExerciseKind::Buffers => icons::POLYGON,
        ExerciseKind::GlProgram => icons::CODE,
        ExerciseKind::Faces => icons::CUBE,
        ExerciseKind::Baking => icons::CHECKERBOARD,
    }
}

/// A label that lets clicks through to the card.
fn words(text: RichText) -> Label {
    Label::new(text).selectable(false)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::exercise::Judged;
    use gonio_check::verdict::Verdict;

    #[test]
    fn an_exercise_has_the_state_of_its_last_check() {
        let ex04 = exercise::find("ex04").unwrap();
        let mut outcomes = BTreeMap::new();
        let state = |begun: &[&Work], outcomes: &BTreeMap<String, Outcome>| {
            state_of(ex04, &ExerciseProgress { begun, outcomes }).0
        };
        assert_eq!(state(&[], &outcomes), "not started");
        let mut work = Work::new(ex04, Vec::new());
        assert_eq!(state(&[&work], &outcomes), "in progress");
        outcomes.insert("ex04".to_owned(), Outcome::Wrong);
        assert_eq!(state(&[], &outcomes), "wrong", "of an earlier window");
        let verdict = Verdict::new("ex04", Outcome::Correct, "right");
        work.judged = Some(Judged { verdict: Ok(verdict), of: work.content() });
        assert_eq!(state(&[&work], &outcomes), "correct");
        let current = work.current;
        work.files[current].text.push(' ');
        assert_eq!(state(&[&work], &outcomes), "correct, unsaved changes");
    }
}
