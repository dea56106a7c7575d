//! Lines of a file around a marked one, and the meaning of the marked line.

use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::files::short;
use crate::session::Session;
use crate::theme::{self, colors, icons};
use crate::widgets::{NumberField, icon_button};
use egui::{
    Align, Align2, Color32, EventFilter, FontId, Frame, Id, Key, Label, Layout, Margin, Modifiers, Rect, RichText,
    ScrollArea, Sense, TextStyle, Ui, WidgetInfo, pos2, vec2,
};
use gonio_language::tr;
use gonio_mesh::Severity;
use gonio_mesh::explain::{Excerpt, LineExplanation};
use std::collections::BTreeSet;

/// Points between the numbers and the text.
const GAP: f32 = 10.0;
/// Share of the height that the explanation has at most.
const EXPLANATION_SHARE: f32 = 0.45;

/// Shows the lines in the rest of the panel.
pub fn show(ui: &mut Ui, session: &mut Session, actions: &mut Vec<Action>) {
    let warned = session.inspector.lines().map(|lines| lines.file.clone()).map(|file| warned_lines(session, &file));
    let (Some(lines), Some(warned)) = (session.inspector.lines(), warned) else { return };
    let file = lines.file.clone();
    let marked = lines.line;
    let is_new = std::mem::take(&mut lines.is_new);
    let result = lines.result.clone();
    let count = result.as_ref().map_or(0, |read| read.excerpt.line_count);
    let mut wanted = None;
    if header(ui, &file, marked, count, &mut wanted) {
        session.inspector.close_lines();
        return;
    }
    let read = match result {
        Ok(read) => read,
        Err(error) => {
            let label = ui.add(Label::new(RichText::new(&error).color(colors::ERROR.of(ui))).wrap());
            exported::note(ui, &label, "file-lines-error", WidgetRole::Text, &error, "");
            return;
        }
    };
    if let Some(explanation) = &read.explanation {
        // It is above the lines, whose place then depends on its height only.
        let most = EXPLANATION_SHARE * ui.available_height();
        let scroll = ScrollArea::vertical().id_salt("explanation").max_height(most).auto_shrink([false, true]);
        scroll.show(ui, |ui| explain(ui, explanation, &mut wanted));
    }
    text(ui, &file, &read.excerpt, (marked, is_new), &warned, &mut wanted);
    if let Some(line) = wanted.filter(|line| (1..=count).contains(line) && *line != marked) {
        actions.push(Action::ShowLine(file, line));
    }
}

/// The lines of a file that warnings are about.
fn warned_lines(session: &Session, file: &str) -> BTreeSet<u64> {
    let inspections = session.inspector.models().iter().filter_map(|model| model.result.as_ref()?.as_ref().ok());
    let of_models = inspections.flat_map(|inspection| &inspection.diagnostics);
    let of_scene = session.loaded.iter().flat_map(|loaded| &loaded.diagnostics);
    let warnings = of_models.chain(of_scene).filter(|found| found.severity == Severity::Warning);
    warnings.filter(|found| found.place.file.as_deref() == Some(file)).filter_map(|found| found.place.line).collect()
}

/// The name of the file and the number of the line. Returns whether the lines were closed.
fn header(ui: &mut Ui, file: &str, marked: u64, count: u64, wanted: &mut Option<u64>) -> bool {
    let mut is_closed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            is_closed = icon_button(ui, "file-lines-close", icons::X, tr!("file-close-the-text")).clicked();
            if icon_button(ui, "file-lines-next", icons::CARET_DOWN, tr!("file-next-line")).clicked() {
                *wanted = Some(marked.saturating_add(1));
            }
            if icon_button(ui, "file-lines-previous", icons::CARET_UP, tr!("file-previous-line")).clicked() {
                *wanted = Some(marked.saturating_sub(1));
            }
            let mut line = marked as f64;
            let field =
                NumberField::new("file-line", "line").tip(tr!("file-number-of-the-marked-line")).width(58.0).whole();
            field.range(1.0..=count.max(1) as f64).show(ui, &mut line);
            if line != marked as f64 {
                *wanted = Some(line as u64);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let name = RichText::new(short(&[file.to_owned()])).font(theme::bold(13.5));
                ui.add(Label::new(name).truncate()).on_hover_text(tr!("file-lines", file = file, count = count));
            });
        });
    });
    is_closed
}

/// The meaning of the marked line.
fn explain(ui: &mut Ui, explanation: &LineExplanation, wanted: &mut Option<u64>) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let label = ui.add(Label::new(RichText::new(&explanation.meaning).small()).wrap());
    exported::note(ui, &label, "file-line-meaning", WidgetRole::Text, &explanation.meaning, explanation.line);
    for detail in &explanation.details {
        ui.add(Label::new(RichText::new(detail).small().weak()).wrap());
    }
    for (index, setting) in explanation.in_force.iter().enumerate() {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            ui.label(RichText::new(format!("{}: {}", setting.what, setting.name)).small().weak());
            let name = tr!("file-line-2", line = setting.line);
            let link = super::link(ui, &name);
            exported::note(ui, &link, &format!("file-in-force-{index}"), WidgetRole::Button, &name, setting.line);
            if link.clicked() {
                *wanted = Some(setting.line);
            }
        });
    }
    for problem in &explanation.problems {
        let tint = if problem.severity == Severity::Warning { colors::WARNING } else { colors::ACCENT };
        ui.add(Label::new(RichText::new(&problem.message).small().color(tint.of(ui))).wrap());
    }
}

/// The lines with their numbers. A click or the arrow keys mark another line.
fn text(
    ui: &mut Ui,
    file: &str,
    excerpt: &Excerpt,
    (marked, is_new): (u64, bool),
    warned: &BTreeSet<u64>,
    wanted: &mut Option<u64>,
) {
    let frame = Frame::NONE.fill(ui.visuals().extreme_bg_color).corner_radius(5).inner_margin(Margin::same(4));
    frame.show(ui, |ui| {
        let font = TextStyle::Monospace.resolve(ui.style());
        let row_height = (ui.text_style_height(&TextStyle::Monospace) + 2.0).ceil();
        let digit = ui.painter().layout_no_wrap("0".into(), font.clone(), Color32::WHITE).size().x;
        let gutter = excerpt.line_count.to_string().len() as f32 * digit + GAP;
        let longest = excerpt.lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        let area = ScrollArea::both().id_salt("file lines").auto_shrink([false, false]);
        area.show(ui, |ui| {
            let room = ui.available_size();
            let size = vec2(
                (gutter + (longest + 2) as f32 * digit).max(room.x),
                (excerpt.lines.len() as f32 * row_height).max(room.y),
            );
            let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
            let response = ui.interact(rect, Id::unique("lines of a file"), Sense::click());
            let row_of = |line: u64| (line.saturating_sub(excerpt.first_line)) as f32 * row_height;
            let marked_text = excerpt.lines.get((marked - excerpt.first_line.min(marked)) as usize);
            let name = tr!(
                "file-line",
                file = short(&[file.to_owned()]),
                marked = marked,
                text = marked_text.map_or("", |text| text)
            );
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, &name));
            exported::note(ui, &response, "file-lines", WidgetRole::Text, &name, marked);
            paint(ui, rect, excerpt, marked, warned, &Look { font, row_height, gutter });
            if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked()) {
                response.request_focus();
                *wanted = Some(excerpt.first_line + ((at.y - rect.top()) / row_height).max(0.0) as u64);
            }
            if response.has_focus() {
                let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
                ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
                let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
                if pressed(Key::ArrowDown) {
                    *wanted = Some(marked.saturating_add(1));
                }
                if pressed(Key::ArrowUp) {
                    *wanted = Some(marked.saturating_sub(1));
                }
            }
            if is_new {
                let top = rect.top() + row_of(marked);
                let place = Rect::from_min_max(pos2(rect.left(), top), pos2(rect.left() + 1.0, top + row_height));
                let is_far = !ui.clip_rect().shrink(row_height).y_range().contains(place.center().y);
                if is_far {
                    ui.scroll_to_rect_animation(place, Some(Align::Center), egui::style::ScrollAnimation::none());
                }
            }
        });
    });
}

/// Sizes of the text.
struct Look {
    font: FontId,
    row_height: f32,
    gutter: f32,
}

/// Paints the visible lines; the numbers stay at the left edge.
fn paint(ui: &Ui, rect: Rect, excerpt: &Excerpt, marked: u64, warned: &BTreeSet<u64>, look: &Look) {
    let clip = ui.clip_rect();
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let row = |index: usize| {
        let top = rect.top() + index as f32 * look.row_height;
        Rect::from_min_max(pos2(clip.left(), top), pos2(clip.right(), top + look.row_height))
    };
    let rows = || {
        let lines =
            excerpt.lines.iter().enumerate().map(|(index, text)| (excerpt.first_line + index as u64, row(index), text));
        lines.filter(|(_, row, _)| row.intersects(clip))
    };
    let tint = |line: u64| match (line == marked, warned.contains(&line)) {
        (true, _) => Some(colors::ACCENT.of(ui)),
        (false, true) => Some(colors::WARNING.of(ui)),
        _ => None,
    };
    for (line, row, text) in rows() {
        if let Some(tint) = tint(line) {
            painter.rect_filled(row, 2.0, tint.gamma_multiply(0.2));
        }
        let place = pos2(rect.left() + look.gutter, row.center().y);
        painter.text(place, Align2::LEFT_CENTER, text.replace('\t', "    "), look.font.clone(), visuals.text_color());
    }
    let edge = clip.left() + look.gutter - 0.5 * GAP;
    let numbers = Rect::from_min_max(clip.left_top(), pos2(edge, clip.bottom()));
    painter.rect_filled(numbers, 0.0, visuals.extreme_bg_color);
    for (line, row, _) in rows() {
        let color = tint(line).unwrap_or(visuals.weak_text_color());
        let place = pos2(edge - 4.0, row.center().y);
        painter.text(place, Align2::RIGHT_CENTER, line.to_string(), look.font.clone(), color);
    }
}
