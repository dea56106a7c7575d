//! The tray of messages below the picture.

use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::session::{MessageAnswer, MessageCause, MessageSeverity, Messages, UserMessage};
use crate::theme::{self, colors, icons, touch};
use crate::widgets::icon_button;
use egui::{Align, Button, Frame, Label, Layout, Margin, Panel, RichText, ScrollArea, Ui};
use gonio_language::tr;

/// Most messages that are shown before the tray is opened.
const FEW: usize = 3;
/// Largest share of the window's height.
const MOST_HEIGHT: f32 = 0.3;
/// Width of the icons and buttons of a row, and of the button that shows a line, points.
const BUTTONS_WIDTH: f32 = 84.0;
const LINE_BUTTON_WIDTH: f32 = 30.0;

/// Shows the messages in a panel at the bottom, the newest first; none without messages. It takes its room from the picture, so
/// that it never covers it.
pub fn show(ui: &mut Ui, messages: &Messages, actions: &mut Vec<Action>) {
    if messages.list().is_empty() {
        return;
    }
    let most_height = (MOST_HEIGHT * ui.ctx().content_rect().height()).max(72.0);
    let frame = Frame::NONE.inner_margin(Margin::symmetric(10, 4)).fill(ui.visuals().faint_bg_color);
    Panel::bottom("messages").frame(frame).resizable(false).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        let groups = messages.grouped();
        let count = messages.list().len();
        if count > 1 {
            header(ui, messages, actions);
        }
        let list = ScrollArea::vertical().id_salt("message list").auto_shrink([false, true]);
        list.max_height(most_height).min_scrolled_height(most_height).show(ui, |ui| {
            let mut left = if messages.is_expanded { usize::MAX } else { FEW };
            for (file, group) in &groups {
                if left == 0 {
                    break;
                }
                let heading = file.filter(|_| group.len() > 1);
                if let Some(file) = heading {
                    let text = tr!("window-messages-2", file = file, count = group.len());
                    ui.add(Label::new(RichText::new(text).small().weak()).truncate());
                }
                for message in group.iter().take(left) {
                    row(ui, message, heading, actions);
                }
                left -= left.min(group.len());
            }
        });
    });
}

/// The number of messages, with buttons for all of them.
fn header(ui: &mut Ui, messages: &Messages, actions: &mut Vec<Action>) {
    let count = messages.list().len();
    ui.horizontal(|ui| {
        ui.label(RichText::new(tr!("window-messages", count = count)).small().weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let all = ui.add(small(ui, tr!("window-dismiss-all")));
            exported::note(ui, &all, "dismiss-all", WidgetRole::Button, tr!("window-dismiss-all"), "");
            if all.clicked() {
                actions.push(Action::DismissAll);
            }
            if count > FEW {
                let label = if messages.is_expanded { tr!("window-show-fewer") } else { tr!("window-show-all") };
                let more = ui.add(small(ui, label));
                exported::note(ui, &more, "messages-all", WidgetRole::Button, label, messages.is_expanded);
                if more.clicked() {
                    actions.push(Action::ExpandMessages);
                }
            }
        });
    });
}

/// A small button; on a phone one of the usual size.
fn small<'a>(ui: &Ui, text: &'a str) -> Button<'a> {
    if touch::least(ui) > 0.0 { Button::new(text) } else { Button::new(text).small() }
}

/// A message. Below a heading with its file, the file's name is not repeated.
fn row(ui: &mut Ui, message: &UserMessage, heading: Option<&str>, actions: &mut Vec<Action>) {
    let (tint, icon) = match message.severity {
        MessageSeverity::Error => (colors::ERROR, icons::WARNING_CIRCLE),
        MessageSeverity::Warning => (colors::WARNING, icons::WARNING),
        MessageSeverity::Note => (colors::ACCENT, icons::INFO),
    };
    ui.horizontal_top(|ui| {
        let color = tint.of(ui);
        ui.label(RichText::new(icon).font(theme::icon_font(16.0)).color(color));
        let mut text = shortened(&message.text, heading).to_owned();
        if message.severity == MessageSeverity::Warning {
            // The icon says so.
            text = text.replacen("warning: ", "", 1);
        }
        if message.times > 1 {
            text = tr!("window-times", text = text, times = message.times);
        }
        let place = place(message);
        let buttons = BUTTONS_WIDTH + if place.is_some() { LINE_BUTTON_WIDTH } else { 0.0 };
        let width = (ui.available_width() - buttons).max(60.0);
        ui.allocate_ui_with_layout(egui::vec2(width, 0.0), Layout::top_down(Align::LEFT), |ui| {
            ui.set_width(width);
            ui.add_space(2.0);
            let label = ui.add(Label::new(text).wrap());
            exported::note(ui, &label, &format!("message-{}", message.id), WidgetRole::Text, &message.text, "");
            if let Some(answer) = message.answer {
                ui.horizontal(|ui| answers(ui, answer, actions));
            }
        });
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            if icon_button(ui, &format!("dismiss-{}", message.id), icons::X, tr!("window-dismiss")).clicked() {
                actions.push(Action::Dismiss(message.id));
            }
            if icon_button(ui, &format!("copy-{}", message.id), icons::COPY, tr!("window-copy-the-message")).clicked() {
                actions.push(Action::CopyText(message.text.clone()));
            }
            if let Some((file, line)) = place {
                let tip = tr!("environment-show-line-of-the-file", line = line);
                if icon_button(ui, &format!("line-of-{}", message.id), icons::CODE, &tip).clicked() {
                    actions.push(Action::ShowLine(file.to_owned(), line));
                }
            }
        });
    });
}

/// The file and the line that a message about the open scene begins with.
fn place(message: &UserMessage) -> Option<(&str, u64)> {
    let file = message.file.as_deref().filter(|_| message.cause == MessageCause::Scene)?;
    let line = message.text.strip_prefix(file)?.strip_prefix(':')?.split(':').next()?;
    Some((file, line.parse().ok()?))
}

/// A message's text without the file's name at its start, if that is the heading.
fn shortened<'a>(text: &'a str, heading: Option<&str>) -> &'a str {
    heading
        .and_then(|file| text.strip_prefix(file))
        .and_then(|rest| rest.strip_prefix(':'))
        .map_or(text, str::trim_start)
}

/// The buttons of a message.
fn answers(ui: &mut Ui, answer: MessageAnswer, actions: &mut Vec<Action>) {
    let mut button = |id, text, action| {
        let button = ui.add(small(ui, text));
        exported::note(ui, &button, id, WidgetRole::Button, text, "");
        if button.clicked() {
            actions.push(action);
        }
    };
    match answer {
        MessageAnswer::RestoreScene => button("restore-scene", tr!("window-restore"), Action::RestoreScene),
        MessageAnswer::TurnZUp => button("turn-z-up", tr!("window-turn-z-up"), Action::TurnZUp),
        MessageAnswer::RestoreDraft => {
            button("restore-draft", tr!("window-restore"), Action::RestoreDraft);
            button("discard-draft", tr!("window-discard"), Action::DiscardDraft);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_file_is_not_repeated_below_its_heading() {
        assert_eq!(shortened("a.mtl:3: unknown word", Some("a.mtl")), "3: unknown word");
        assert_eq!(shortened("a.mtl: unknown word", Some("a.mtl")), "unknown word");
        assert_eq!(shortened("a.mtl: unknown word", None), "a.mtl: unknown word");
        assert_eq!(shortened("a.mtlx: unknown word", Some("a.mtl")), "a.mtlx: unknown word");
    }

    #[test]
    fn a_warning_about_a_line_of_the_scene_has_its_place() {
        let mut messages = Messages::default();
        let texts = [
            (MessageCause::Scene, "a.mtl:42:3: warning: unknown word"),
            (MessageCause::Scene, "a.mtl: warning: unknown word"),
            (MessageCause::Opening, "a.mtl:42: warning: unknown word"),
        ];
        for (cause, text) in texts {
            messages.report_about(cause, MessageSeverity::Warning, Some("a.mtl".into()), text);
        }
        let places: Vec<_> = messages.list().iter().map(place).collect();
        assert_eq!(places, [Some(("a.mtl", 42)), None, None]);
    }
}
