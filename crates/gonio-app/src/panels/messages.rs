//! Messages over the picture, which stay until they are dismissed.

use crate::action::Action;
use crate::exported::{self, Role};
use crate::session::{Session, Severity};
use crate::theme::{self, colors, icons};
use egui::{Align2, Area, Frame, Id, Margin, Order, RichText, Stroke, Ui, vec2};

/// Most messages that are shown at once.
const MOST: usize = 3;
const WIDTH: f32 = 380.0;

/// Shows them at the lower left.
pub fn show(ui: &Ui, session: &Session, actions: &mut Vec<Action>) {
    let messages = session.messages.list();
    if messages.is_empty() {
        return;
    }
    let offset = vec2(12.0, -44.0);
    Area::new(Id::unique("messages")).order(Order::Foreground).anchor(Align2::LEFT_BOTTOM, offset).show(
        ui.ctx(),
        |ui| {
            ui.set_max_width(WIDTH.min(ui.ctx().content_rect().width() - 24.0));
            for message in messages.iter().take(MOST) {
                let (tint, icon) = match message.severity {
                    Severity::Error => (colors::ERROR, icons::WARNING_CIRCLE),
                    Severity::Warning => (colors::WARNING, icons::WARNING),
                    Severity::Note => (colors::ACCENT, icons::INFO),
                };
                let color = tint.of(ui);
                let frame = Frame::popup(ui.style()).inner_margin(Margin::same(10)).stroke(Stroke::new(1.0, color));
                frame.show(ui, |ui| {
                    ui.horizontal_top(|ui| {
                        ui.label(RichText::new(icon).font(theme::icon_font(18.0)).color(color));
                        ui.vertical(|ui| {
                            ui.add(egui::Label::new(&message.text).wrap());
                            if message.times > 1 {
                                ui.label(RichText::new(format!("{} times", message.times)).small().weak());
                            }
                            ui.horizontal(|ui| {
                                let id = |what: &str| format!("{what}-{}", message.id);
                                let read = ui.small_button("Dismiss");
                                exported::note(ui, &read, &id("dismiss"), Role::Button, "Dismiss", "");
                                if read.clicked() {
                                    actions.push(Action::Dismiss(message.id));
                                }
                                let copy = ui.small_button("Copy");
                                exported::note(ui, &copy, &id("copy"), Role::Button, "Copy", "");
                                if copy.clicked() {
                                    actions.push(Action::CopyText(message.text.clone()));
                                }
                            });
                        });
                    });
                });
            }
            if messages.len() > MOST {
                ui.label(RichText::new(format!("and {} more", messages.len() - MOST)).small().weak());
            }
        },
    );
}
