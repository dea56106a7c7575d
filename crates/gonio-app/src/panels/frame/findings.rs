//! Problems found in the recorded frame.

use crate::session::RecordedFrame;
use crate::theme::{self, colors, icons};
use egui::{Frame, Label, Margin, RichText, Stroke, Ui};
use gonio_gl::trace::Severity;

/// Shows it; pressing one shows its draw.
pub fn show(ui: &mut Ui, taken: &mut RecordedFrame) {
    if taken.findings.is_empty() {
        let color = colors::NORMAL.of(ui);
        ui.horizontal(|ui| {
            ui.label(RichText::new(icons::CHECK).font(theme::icon_font(15.0)).color(color));
            ui.add(Label::new(RichText::new("No problems found in this frame").color(color)).wrap());
        })
        .response
        .on_hover_text("Every sampler reads a bound texture, every uniform is set, and every attribute has data.");
        return;
    }
    let mut chosen = taken.draw;
    for finding in &taken.findings {
        let (tint, icon) = match finding.severity {
            Severity::Error => (colors::ERROR, icons::WARNING_CIRCLE),
            Severity::Warning => (colors::WARNING, icons::WARNING),
        };
        let color = tint.of(ui);
        let frame = Frame::NONE.inner_margin(Margin::same(8)).stroke(Stroke::new(1.0, color)).corner_radius(5);
        frame.show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.horizontal(|ui| {
                ui.label(RichText::new(icon).font(theme::icon_font(15.0)).color(color));
                ui.label(RichText::new(finding.rule.name()).font(theme::bold(13.5)).color(color));
                let more = if finding.draws > 1 { format!(" and {} more", finding.draws - 1) } else { String::new() };
                if ui.link(format!("draw {}{more}", finding.draw)).clicked() {
                    chosen = finding.draw;
                }
            });
            ui.add(Label::new(&finding.message).wrap());
            ui.add(Label::new(RichText::new(&finding.advice).weak()).wrap());
        });
        ui.add_space(4.0);
    }
    taken.draw = chosen;
}
