//! The time bar, shown if a light moves.

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, Role};
use crate::session::Session;
use crate::theme::icons;
use crate::widgets::icon_button;
use egui::{RichText, Slider, Ui};

/// The longest period of a light that moves, seconds; `None` where none does.
pub fn period(document: &Document) -> Option<f64> {
    let motions = document.scene.lights.iter().filter(|light| light.enabled).filter_map(|light| light.motion.as_ref());
    let longest = motions.map(|motion| motion.period).fold(0.0, f64::max);
    (longest > 0.0 && longest.is_finite()).then_some(longest)
}

pub fn show(ui: &mut Ui, document: &Document, session: &Session, actions: &mut Vec<Action>) {
    let Some(period) = period(document) else { return };
    let clock = &session.clock;
    let (icon, tip) = if clock.playing { (icons::PAUSE, "Pause (Space)") } else { (icons::PLAY, "Play (Space)") };
    if icon_button(ui, "play", icon, tip).clicked() {
        actions.push(Action::PlayOrPause);
    }
    if icon_button(ui, "time-start", icons::SKIP_BACK, "Back to time 0").clicked() {
        actions.push(Action::SetTime(0.0));
    }
    let turns = (clock.time / period).floor();
    let mut within = clock.time - turns * period;
    ui.spacing_mut().slider_width = (ui.available_width() - 250.0).clamp(60.0, 260.0);
    let slider = ui.add(Slider::new(&mut within, 0.0..=period).show_value(false));
    exported::note(ui, &slider, "time", Role::Number, "time", clock.time);
    if slider.changed() {
        actions.push(Action::SetTime(turns * period + within));
    }
    let slider = slider.on_hover_text("Time within the longest period. Double click: 0");
    if slider.double_clicked() {
        actions.push(Action::SetTime(0.0));
    }
    // Fixed width, so that nothing jumps while time runs.
    let text = format!("{within:6.2} of {} s", crate::widgets::compact(period));
    ui.label(RichText::new(text).monospace().small());
}
