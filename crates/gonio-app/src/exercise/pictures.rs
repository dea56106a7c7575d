//! The pictures beside the editor, with their settings.

use super::preview::{Preview, PreviewPicture, situations};
use super::work::{PictureMode, Work};
use super::{lamp, picture_files};
use crate::exported::{self, WidgetRole};
use crate::scene_view::drawing::PaneRenderer;
use crate::scene_view::{navigation, picture_size, present};
use crate::step::source::{DrawnProgram, SteppedPicture};
use crate::step::{self, Stepper};
use crate::theme::{colors, icons};
use crate::widgets;
use egui::{Align2, Color32, CornerRadius, Label, Rect, RichText, Sense, TextStyle, Ui, pos2, vec2};
use gonio_check::testbench::scene::title;
use gonio_exercises::exercise::ExerciseKind;
use gonio_exercises::preview::PreviewScene;
use gonio_gl::GlError;
use gonio_language::tr;
use std::sync::Arc;

/// Background of captions.
pub(super) const GROUND: Color32 = Color32::from_black_alpha(150);
/// Below this width (points) the scenes have a row of their own.
const NARROW: f32 = 480.0;
const INK: Color32 = Color32::from_gray(0xf2);

/// Shows the pictures in the available room.
pub fn show(
    ui: &mut Ui,
    work: &mut Work,
    preview: Option<&mut Preview>,
    pane_renderer: Option<&mut PaneRenderer>,
    stepper: &mut Stepper,
) -> Result<(), GlError> {
    let whole = ui.available_rect_before_wrap();
    ui.painter().rect_filled(whole, 0.0, ui.visuals().extreme_bg_color);
    if work.exercise.kind != ExerciseKind::Shaders {
        if work.exercise.kind != ExerciseKind::Baking || !picture_files::show(ui, whole, work) {
            sentence(ui, whole, without_picture(work.exercise.kind));
        }
        return Ok(());
    }
    let (Some(preview), Some(pane_renderer)) = (preview, pane_renderer) else {
        sentence(ui, whole, tr!("exercise-nothing-is-drawn-because-opengl-is"));
        return Ok(());
    };
    settings(ui, work, preview, stepper);
    let room = ui.available_rect_before_wrap();
    let pictures = work.shown.pictures();
    for (index, &picture) in pictures.iter().enumerate() {
        let rect = part(room, index, pictures.len(), ui.ctx().pixels_per_point());
        let size = picture_size(rect, ui.ctx().pixels_per_point());
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        let name = caption(picture);
        exported::note(ui, &response, &format!("picture-{}", picture.id()), WidgetRole::Picture, name, "");
        steer(ui, &response, work);
        if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            stepper.pin([(at.x - rect.left()) / rect.width(), (at.y - rect.top()) / rect.height()]);
        }
        match preview.picture(picture, work, size, pane_renderer)? {
            Some(shown) => present(ui, rect, shown),
            None => sentence(ui, rect, nothing_yet(picture, work)),
        }
        step::margin::marker(ui, rect, stepper);
        lamp::show(ui, rect, work, index);
        if pictures.len() > 1 {
            written(ui, rect, Align2::LEFT_BOTTOM, name, GROUND);
        }
        if index == 0 {
            let seen = situations(work, size);
            let stepped = |program: &Arc<DrawnProgram>| SteppedPicture::Exercise {
                program: program.clone(),
                size,
                objects: seen.clone(),
            };
            stepper.note_picture(|| preview.program().map(stepped));
            if picture == PreviewPicture::Yours
                && let (Some(pair), Some((_, first))) = (preview.pair(), seen.first())
            {
                work.program.variables = pair.variable_values(first);
            }
        }
    }
    over(ui, room, work);
    Ok(())
}

/// The caption over the pictures: an older program is shown, or a newer one is being tested.
fn over(ui: &Ui, room: Rect, work: &Work) {
    let text = if work.program.is_trial_slow {
        tr!("exercise-testing-the-new-program-in-a")
    } else if work.program.is_old {
        tr!("exercise-showing-the-last-program-that-compiled")
    } else {
        return;
    };
    let rect = written(ui, room, Align2::CENTER_TOP, text, Color32::from_rgb(0x8a, 0x4b, 0x00));
    let response = ui.interact(rect, ui.scope_id().with(tr!("exercise-older-program")), Sense::hover());
    exported::note(ui, &response, "older-program", WidgetRole::Text, text, "");
}

fn caption(picture: PreviewPicture) -> &'static str {
    match picture {
        PreviewPicture::Yours => tr!("exercise-yours"),
        PreviewPicture::Reference => tr!("exercise-reference"),
        PreviewPicture::Difference => tr!("exercise-difference"),
    }
}

fn nothing_yet(picture: PreviewPicture, work: &Work) -> &'static str {
    match picture {
        PreviewPicture::Yours if work.program.is_tried => "",
        PreviewPicture::Yours if work.program.unusable.is_some() => {
            tr!("exercise-your-program-is-not-drawn-the")
        }
        PreviewPicture::Yours => tr!("exercise-your-program-does-not-compile-the"),
        PreviewPicture::Reference => tr!("exercise-this-exercise-has-no-reference-picture"),
        PreviewPicture::Difference => tr!("exercise-the-difference-is-shown-once-your"),
    }
}

fn without_picture(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Buffers => {
            tr!("exercise-write-a-program-in-any-language")
        }
        ExerciseKind::GlProgram => {
            tr!("exercise-this-exercise-is-a-list-of")
        }
        ExerciseKind::Baking => {
            tr!("exercise-bake-the-model-in-blender-or")
        }
        ExerciseKind::Shaders | ExerciseKind::Faces => {
            tr!("exercise-the-answer-is-six-cube-faces")
        }
    }
}

/// Selection of pictures and scene, and the play button.
fn settings(ui: &mut Ui, work: &mut Work, preview: &Preview, stepper: &mut Stepper) {
    let narrow = ui.available_width() < NARROW;
    ui.add_space(4.0);
    let which = |ui: &mut Ui, work: &mut Work| {
        if preview.has_reference() {
            let options = [
                (PictureMode::Yours, "yours", tr!("exercise-the-picture-of-your-program")),
                (PictureMode::Reference, "reference", tr!("exercise-the-picture-of-the-correct-answer")),
                (PictureMode::Both, "both", tr!("exercise-both-side-by-side")),
                (PictureMode::Difference, "difference", tr!("exercise-the-difference-dark-where-they-agree")),
            ];
            widgets::choice(ui, "shown", tr!("exercise-picture"), &mut work.shown, &options, PictureMode::default());
        }
    };
    let row = |ui: &mut Ui, content: &mut dyn FnMut(&mut Ui)| {
        ui.horizontal(|ui| {
            ui.add_space(6.0);
            ui.spacing_mut().item_spacing.x = 6.0;
            content(ui);
        });
    };
    if narrow {
        row(ui, &mut |ui| which(ui, work));
        row(ui, &mut |ui| scene_and_time(ui, work, stepper));
    } else {
        row(ui, &mut |ui| {
            which(ui, work);
            ui.separator();
            scene_and_time(ui, work, stepper);
        });
    }
    ui.add_space(2.0);
}

fn scene_and_time(ui: &mut Ui, work: &mut Work, stepper: &mut Stepper) {
    if work.scenes.len() > 1 {
        let mut scene = work.scene;
        // Of the checker's scenes, only the one that is shown: the verdict lists them all.
        let offered = work.scenes.iter().enumerate().filter(|(index, scene)| !scene.is_test || *index == work.scene);
        let name = |scene: &PreviewScene| match scene.is_test {
            true => tr!("exercise-test", scene = title(&scene.name)),
            false => scene.name.to_string(),
        };
        let offered: Vec<(usize, String, &str)> =
            offered.map(|(index, scene)| (index, name(scene), scene.shows)).collect();
        let options: Vec<(usize, &str, &str)> =
            offered.iter().map(|(index, name, shows)| (*index, name.as_str(), *shows)).collect();
        if widgets::choice(ui, "scene", tr!("exercise-scene"), &mut scene, &options, 0) {
            work.look_at(scene);
        }
    }
    if work.moves() || work.clock.playing {
        let (icon, tip) = if work.clock.playing {
            (icons::PAUSE, tr!("exercise-pause"))
        } else {
            (icons::PLAY, tr!("exercise-play"))
        };
        if widgets::icon_button(ui, "play", icon, tip).clicked() {
            work.clock.playing = !work.clock.playing;
        }
    }
    if widgets::icon_button(ui, "frame", icons::FRAME_CORNERS, tr!("exercise-reset-the-camera")).clicked() {
        let clock = work.clock;
        work.look_at(work.scene);
        work.clock = clock;
    }
    let tip = tr!("exercise-show-each-line-s-values-at");
    let color = stepper.is_pinned().then(|| colors::ACCENT.of(ui));
    if widgets::tool_button(ui, "step-pin", icons::CROSSHAIR, tip, color, true).clicked() {
        match stepper.is_pinned() {
            true => stepper.unpin(),
            false => stepper.pin_middle(),
        }
    }
    if stepper.is_new() {
        // The values are those of one moment.
        work.clock.playing = false;
    }
}

fn steer(ui: &Ui, response: &egui::Response, work: &mut Work) {
    let Some(scene) = work.scene() else { return };
    let looks_around = scene.looks_around;
    let middle = scene.eye.target.as_dvec3();
    let extent = f64::from(scene.eye.position.distance(scene.eye.target)).max(0.5);
    let camera = &mut work.camera;
    if navigation::steer(ui, response, camera, middle, extent, looks_around) {
        ui.ctx().request_repaint();
    }
}

/// One of several rectangles side by side, or stacked in an upright room. All have the same number of pixels, because their
/// pictures are compared.
pub(super) fn part(room: Rect, index: usize, count: usize, pixels_per_point: f32) -> Rect {
    let whole = |points: f32| (points * pixels_per_point).floor() / pixels_per_point;
    let min = pos2(whole(room.left()), whole(room.top()));
    let share = |side: f32| whole(side / count.max(1) as f32);
    let index = index as f32;
    if room.width() >= room.height() {
        let width = share(room.width());
        Rect::from_min_size(min + vec2(index * width, 0.0), vec2(width, whole(room.height())))
    } else {
        let height = share(room.height());
        Rect::from_min_size(min + vec2(0.0, index * height), vec2(whole(room.width()), height))
    }
}

/// A sentence in place of a picture.
fn sentence(ui: &mut Ui, rect: Rect, text: &str) {
    let width = (rect.width() - 40.0).clamp(60.0, 460.0);
    let place = Rect::from_center_size(rect.center(), vec2(width, 90.0_f32.min(rect.height())));
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(place));
    inner.add(Label::new(RichText::new(text).weak()).wrap());
}

/// Writes a caption over a picture. Returns its rectangle.
pub(super) fn written(ui: &Ui, rect: Rect, align: Align2, text: &str, ground: Color32) -> Rect {
    let room = rect.shrink(8.0);
    let style = TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::simple(text.to_owned(), style, INK, (room.width() - 16.0).max(20.0));
    job.halign = egui::Align::LEFT;
    let galley = ui.painter().layout_job(job);
    let place = align.align_size_within_rect(galley.size() + vec2(16.0, 8.0), room);
    let painter = ui.painter().with_clip_rect(rect);
    painter.rect_filled(place, CornerRadius::same(6), ground);
    painter.galley(place.min + vec2(8.0, 4.0), galley, INK);
    place
}

/// The name of a mode in the exported state.
pub fn word(shown: PictureMode) -> &'static str {
    match shown {
        PictureMode::Yours => "yours",
        PictureMode::Reference => "reference",
        PictureMode::Both => "both",
        PictureMode::Difference => "difference",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_side_by_side_have_the_same_size() {
        for step in 0..200 {
            let pixels_per_point = [1.0, 1.25, 1.5, 2.0, 1.1][step % 5];
            let [left, top] = [0.37, 0.61].map(|share| share * step as f32);
            let room = Rect::from_min_size(pos2(left, top), vec2(300.3 + left, 400.7 - 2.0 * top));
            let sizes = [0, 1].map(|index| picture_size(part(room, index, 2, pixels_per_point), pixels_per_point));
            assert_eq!(sizes[0], sizes[1], "{room:?} at {pixels_per_point}");
        }
    }
}
