//! The bars below the picture: status, with progress and facts about the last frame; and time, if a light moves.

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::theme::icons;
use crate::widgets::{SPACE, grouped, icon_button};
use egui::{Align, Label, Layout, RichText, Slider, Ui};
use gonio_language::tr;

/// Below this width (points) only the size and the time are shown.
const NARROW: f32 = 560.0;

pub fn show(ui: &mut Ui, session: &Session) {
    let narrow = ui.available_width() < NARROW;
    // Nothing here is touched.
    ui.spacing_mut().interact_size.y = ui.spacing().interact_size.y.min(24.0);
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let facts = &session.facts;
            let [width, height] = facts.size;
            // Fixed width, so that nothing moves while it changes.
            let mut text =
                tr!("window-x-ms", width = width, height = height, draw_ms = format!("{:6.1}", facts.draw_ms));
            if !narrow && let Some(loaded) = &session.loaded {
                // Fewer than the scene's while something moves and pictures are slow.
                let samples = if facts.samples == 0 { loaded.settings.picture.samples } else { facts.samples };
                text = tr!(
                    "window-triangles-samples",
                    triangles = grouped(exported::triangles(session) as u64, SPACE),
                    samples = samples,
                    time = text
                );
            }
            let label = ui.label(RichText::new(text).monospace().small().weak());
            label.on_hover_ui(|ui| {
                ui.label(&facts.renderer);
                ui.label(tr!("window-size-of-the-current-pane-and"));
                for note in &facts.notes {
                    ui.label(note);
                }
            });
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if let Some(busy) = &session.busy {
                    // A page loads between two frames, where a spinner would not turn; while it fetches files, the frames
                    // of a spinner would slow that down.
                    if cfg!(not(target_arch = "wasm32")) {
                        ui.add(egui::Spinner::new().size(14.0));
                    }
                    let text = match session.progress {
                        Some((files, bytes)) if files > 0 => format!("{busy}: {}", amount(files, bytes)),
                        _ => busy.clone(),
                    };
                    ui.add(Label::new(RichText::new(text).small()).truncate());
                } else {
                    let hint = session.settings.hint().filter(|_| !narrow && session.loaded.is_some());
                    let text = match hint {
                        Some(hint) => format!("{}   {}", session.announcement, hint.sentence()),
                        None => session.announcement.clone(),
                    };
                    ui.add(Label::new(RichText::new(text).small().weak()).truncate());
                }
            });
        });
    });
}

fn amount(files: usize, bytes: u64) -> String {
    tr!("window-files-and-megabytes", count = files, megabytes = format!("{:.1}", bytes as f64 / 1e6))
}

/// Seconds that the time bar shows where only the user's shaders change with the time.
const SHADER_PERIOD: f64 = 10.0;

/// The longest period of all lights and objects that move, in seconds; `None` if nothing changes with the time.
pub fn period(document: &Document, session: &Session) -> Option<f64> {
    let lights = document.scene.lights.iter().filter(|light| light.enabled);
    let of_lights = lights.filter_map(|light| Some(light.motion.as_ref()?.period));
    let of_objects = document.scene.objects.iter().filter_map(|object| Some(object.motion.as_ref()?.period));
    let longest = of_lights.chain(of_objects).fold(0.0, f64::max);
    let is_read =
        || session.shaders.as_ref().and_then(|shaders| shaders.program()).is_some_and(|p| p.inputs.reads_time());
    let longest = if longest == 0.0 && is_read() { SHADER_PERIOD } else { longest };
    (longest > 0.0 && longest.is_finite()).then_some(longest)
}

/// Shows the time bar.
pub fn show_time(ui: &mut Ui, document: &Document, session: &Session, actions: &mut Vec<Action>) {
    let Some(period) = period(document, session) else { return };
    let clock = &session.clock;
    let (icon, tip) =
        if clock.playing { (icons::PAUSE, tr!("window-pause-space")) } else { (icons::PLAY, tr!("window-play-space")) };
    if icon_button(ui, "play", icon, tip).clicked() {
        actions.push(Action::PlayOrPause);
    }
    if icon_button(ui, "time-start", icons::SKIP_BACK, tr!("window-back-to-time-0")).clicked() {
        actions.push(Action::SetTime(0.0));
    }
    let turns = (clock.time / period).floor();
    let mut within = clock.time - turns * period;
    ui.spacing_mut().slider_width = (ui.available_width() - 250.0).clamp(60.0, 260.0);
    let slider = ui.add(Slider::new(&mut within, 0.0..=period).show_value(false));
    exported::note(ui, &slider, "time", WidgetRole::Number, "time", clock.time);
    if slider.changed() {
        actions.push(Action::SetTime(turns * period + within));
    }
    let slider = slider.on_hover_text(tr!("window-time-within-the-longest-period-double"));
    if slider.double_clicked() {
        actions.push(Action::SetTime(0.0));
    }
    // Fixed width, so that nothing moves while time runs.
    let text = tr!("window-of-s", within = format!("{within:6.2}"), period = crate::widgets::compact(period));
    ui.label(RichText::new(text).monospace().small());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_counted_with_their_megabytes() {
        assert_eq!(amount(1, 1_500_000), "1 file, 1.5 MB");
    }
}
