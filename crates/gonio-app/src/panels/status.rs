//! The status bar: progress, and facts about the last frame.

use crate::exported;
use crate::session::Session;
use crate::widgets::{SPACE, grouped};
use egui::{Align, Label, Layout, RichText, Ui};

/// Below this width (points) only the size and the time are shown.
const NARROW: f32 = 560.0;

pub fn show(ui: &mut Ui, session: &Session) {
    let narrow = ui.available_width() < NARROW;
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let facts = &session.facts;
            let [width, height] = facts.size;
            // Fixed width, so that nothing jumps while it changes.
            let mut text = format!("{width} x {height} {:6.1} ms", facts.draw_ms);
            if !narrow && let Some(loaded) = &session.loaded {
                // Fewer than the scene's while something moves and pictures take long.
                let samples = if facts.samples == 0 { loaded.settings.picture.samples } else { facts.samples };
                text = format!(
                    "{} triangles  {samples} samples  {text}",
                    grouped(exported::triangles(session) as u64, SPACE)
                );
            }
            let label = ui.label(RichText::new(text).monospace().small().weak());
            label.on_hover_ui(|ui| {
                ui.label(&facts.renderer);
                ui.label("Size of the current pane, and time of the last finished frame");
                for note in &facts.notes {
                    ui.label(note);
                }
            });
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if let Some(busy) = &session.busy {
                    // A page reads between two frames, where nothing turns; and while it fetches, frames that turn
                    // something would take the processor from that.
                    if cfg!(not(target_arch = "wasm32")) {
                        ui.add(egui::Spinner::new().size(14.0));
                    }
                    let text = match session.progress {
                        Some((files, bytes)) if files > 0 => format!("{busy}: {}", amount(files, bytes)),
                        _ => busy.clone(),
                    };
                    ui.add(Label::new(RichText::new(text).small()).truncate());
                } else {
                    ui.add(Label::new(RichText::new(&session.announcement).small().weak()).truncate());
                }
            });
        });
    });
}

fn amount(files: usize, bytes: u64) -> String {
    let plural = if files == 1 { "" } else { "s" };
    format!("{files} file{plural}, {:.1} MB", bytes as f64 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_counted_with_their_megabytes() {
        assert_eq!(amount(1, 1_500_000), "1 file, 1.5 MB");
    }
}
