//! The text of a file: line numbers, marked lines, GLSL in colours, the values of its steps, and messages below.

use super::{Stepper, bar, find, margin, typing};
use crate::exported::{self, WidgetRole};
use crate::theme::colors::{self, Tint};
use crate::theme::{self, icons};
use egui::text::{CCursor, CCursorRange, LayoutJob, TextFormat};
use egui::text_edit::{TextEditOutput, TextEditState};
use egui::{
    Align, Color32, FontId, FontSelection, Frame, Galley, Id, Label, Margin, Pos2, Rect, RichText, ScrollArea, Sense,
    TextBuffer, TextEdit, TextStyle, Ui, pos2, vec2,
};
use gonio_glsl::Class;
use gonio_language::tr;
use std::sync::Arc;

/// Points between the numbers and the text.
const GAP: f32 = 10.0;
/// Width of the mark beside a line number.
const MARK_WIDTH: f32 = 4.0;
/// Most messages that are listed below the text at once.
const MOST_LISTED: usize = 8;

/// Kind of a marked line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MarkKind {
    /// Other compilers may refuse it.
    Warning,
    /// The checker found a mistake.
    Mistake,
    /// It does not compile.
    Error,
}

/// A marked line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Line number, from 1.
    pub line: u32,
    /// Its kind.
    pub kind: MarkKind,
    /// The message.
    pub text: String,
}

/// The file of a text.
#[derive(Clone, Copy)]
pub struct Code<'a> {
    /// Id of the widget, which has its own undo history.
    pub id: Id,
    /// The file's name.
    pub name: &'a str,
    /// The marked lines.
    pub marks: &'a [Mark],
    /// A line to select and to scroll to.
    pub jump: Option<u32>,
    /// Whether the text has neither a cursor nor a selection.
    pub is_fixed: bool,
}

/// Shows the steps, a text and the variables, and below them an error without a line and the messages of the marks. Returns the
/// line of a message that was clicked.
pub fn show(
    ui: &mut Ui,
    of: &Code<'_>,
    text: &mut dyn TextBuffer,
    error: Option<&str>,
    stepper: &mut Stepper,
) -> Option<u32> {
    bar::bar(ui, stepper);
    let found = find::show(ui, of.id, text.as_str());
    let below = messages_height(ui, of.marks, error);
    let table = bar::table_height(stepper, ui.available_height());
    let height = (ui.available_height() - below - table).max(60.0);
    let frame = Frame::NONE.fill(ui.visuals().extreme_bg_color).corner_radius(5).inner_margin(Margin::same(4));
    frame.show(ui, |ui| {
        ui.set_min_size(vec2(ui.available_width(), height - 8.0));
        ui.set_max_height(height - 8.0);
        lines(ui, of, text, found.map(|range| range.start), stepper);
    });
    if table > 0.0 {
        ui.allocate_ui(vec2(ui.available_width(), table), |ui| bar::table(ui, stepper));
    }
    messages(ui, of.marks, error)
}

/// Shows a text with its numbers and marks, and the values of its steps. `found` is a character to scroll to.
fn lines(ui: &mut Ui, of: &Code<'_>, text: &mut dyn TextBuffer, found: Option<usize>, stepper: &mut Stepper) {
    let Code { id, name, marks, jump, is_fixed } = *of;
    let font = TextStyle::Monospace.resolve(ui.style());
    let count = text.as_str().lines().count() + usize::from(text.as_str().ends_with('\n'));
    let digit = ui.painter().layout_no_wrap("0".into(), font.clone(), Color32::WHITE).size().x;
    let digits = count.max(1).to_string().len().max(2) as f32;
    let gutter = MARK_WIDTH + 4.0 + digits * digit + GAP;
    if !is_fixed {
        typing::keys(ui, id, text);
    }
    if let Some(line) = jump {
        put_cursor(ui, id, text.as_str(), line);
    }
    let is_glsl = ![".toml", ".txt", ".py"].iter().any(|end| name.ends_with(end));
    let mut layouter = |ui: &Ui, text: &dyn TextBuffer, _: f32| -> Arc<Galley> {
        let job = highlighted(ui, id, text.as_str(), is_glsl, &font);
        ui.fonts_mut(|fonts| fonts.layout_job(job))
    };
    ScrollArea::both().id_salt(id).auto_shrink([false, false]).show(ui, |ui| {
        let room = ui.available_size();
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            ui.add_space(gutter);
            let edit = TextEdit::multiline(text)
                .id(id)
                .font(FontSelection::FontId(font.clone()))
                .code_editor()
                .interactive(!is_fixed)
                .frame(Frame::NONE)
                .margin(Margin::ZERO)
                .desired_width(f32::INFINITY)
                .min_size(vec2(room.x - gutter, room.y))
                .layouter(&mut layouter);
            let output = edit.show(ui);
            exported::note(ui, &output.response, "editor", WidgetRole::Text, name, count);
            if let Some(line) = jump {
                output.response.request_focus();
                let place = row_rect(&output, line);
                ui.scroll_to_rect(place, Some(Align::Center));
            }
            if let Some(index) = found {
                let place = output.galley.pos_from_cursor(CCursor::new(index)).translate(output.galley_pos.to_vec2());
                ui.scroll_to_rect(place, Some(Align::Center));
            }
            if let Some(steps) = stepper.steps_in(name, text.as_str()) {
                let rows: Vec<Rect> = rows(&output).collect();
                margin::beside(ui, &output, &rows, output.galley_pos.x, stepper, &steps);
            }
            numbers(ui, &output, marks, gutter, id);
        });
    });
}

/// Selects a line, with the cursor at its beginning.
fn put_cursor(ui: &Ui, id: Id, text: &str, line: u32) {
    let before: usize =
        text.split_inclusive('\n').take(line.saturating_sub(1) as usize).map(|l| l.chars().count()).sum();
    let length = text.lines().nth(line.saturating_sub(1) as usize).map_or(0, |line| line.chars().count());
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(CCursor::new(before), CCursor::new(before + length))));
    state.store(ui.ctx(), id);
}

/// The rectangle of a line (from 1) in the window.
fn row_rect(output: &TextEditOutput, line: u32) -> Rect {
    let row = rows(output).nth(line.saturating_sub(1) as usize);
    row.unwrap_or(Rect::from_min_size(output.galley_pos, vec2(1.0, 14.0)))
}

/// The rectangles of the lines in the window. No line is wrapped, so each is a row.
fn rows(output: &TextEditOutput) -> impl Iterator<Item = Rect> + '_ {
    output.galley.rows.iter().map(|row| row.rect().translate(output.galley_pos.to_vec2()))
}

/// Line numbers and marks at the left edge of the visible part, with the messages as tooltips.
fn numbers(ui: &Ui, output: &TextEditOutput, marks: &[Mark], gutter: f32, id: Id) {
    let clip = ui.clip_rect();
    let painter = ui.painter();
    let left = clip.left();
    let ground = Rect::from_min_max(pos2(left, clip.top()), pos2(left + gutter - 2.0, clip.bottom()));
    painter.rect_filled(ground, 0.0, ui.visuals().extreme_bg_color);
    let font = TextStyle::Monospace.resolve(ui.style());
    for (index, row) in rows(output).enumerate() {
        if row.bottom() < clip.top() || row.top() > clip.bottom() {
            continue;
        }
        let line = index as u32 + 1;
        let of_line: Vec<&Mark> = marks.iter().filter(|mark| mark.line == line).collect();
        let worst = of_line.iter().map(|mark| mark.kind).max();
        let color = worst.map_or(ui.visuals().weak_text_color(), |kind| tint(kind).of(ui));
        let right = left + gutter - GAP;
        painter.text(pos2(right, row.center().y), egui::Align2::RIGHT_CENTER, line.to_string(), font.clone(), color);
        if worst.is_none() {
            continue;
        }
        let mark = Rect::from_min_size(pos2(left, row.top()), vec2(MARK_WIDTH, row.height()));
        painter.rect_filled(mark, 1.0, color);
        let whole = Rect::from_min_max(pos2(left, row.top()), pos2(clip.right(), row.bottom()));
        painter.rect_filled(whole, 0.0, color.gamma_multiply(0.13));
        let texts: Vec<&str> = of_line.iter().map(|mark| mark.text.as_str()).collect();
        let place = Rect::from_min_max(pos2(left, row.top()), pos2(left + gutter, row.bottom()));
        ui.interact(place, id.with(("mark", line)), Sense::hover()).on_hover_text(texts.join("\n\n"));
    }
    let edge = Pos2::new(left + gutter - 4.0, clip.top());
    painter.vline(edge.x, clip.y_range(), ui.visuals().widgets.noninteractive.bg_stroke);
}

/// The colour of a mark.
fn tint(kind: MarkKind) -> colors::Tint {
    match kind {
        MarkKind::Error => colors::ERROR,
        MarkKind::Mistake => colors::WRONG,
        MarkKind::Warning => colors::WARNING,
    }
}

/// Height of the list below the text.
fn messages_height(ui: &Ui, marks: &[Mark], error: Option<&str>) -> f32 {
    let count = marks.len().min(MOST_LISTED) + usize::from(error.is_some());
    if count == 0 { 0.0 } else { (16.0 + 40.0 * count as f32).min(0.32 * ui.available_height()) }
}

/// Shows an error without a line and the messages of the marks. Returns the line of a message that was clicked.
fn messages(ui: &mut Ui, marks: &[Mark], error: Option<&str>) -> Option<u32> {
    if marks.is_empty() && error.is_none() {
        return None;
    }
    let mut requested = None;
    ScrollArea::vertical().id_salt("messages of lines").auto_shrink([false, false]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        if let Some(error) = error {
            message_row(ui, icons::WARNING_CIRCLE, colors::ERROR.of(ui), error);
        }
        for (index, mark) in marks.iter().take(MOST_LISTED).enumerate() {
            let icon = if mark.kind == MarkKind::Error { icons::WARNING_CIRCLE } else { icons::WARNING };
            let line = message_row(
                ui,
                icon,
                tint(mark.kind).of(ui),
                &tr!("exercise-line", line = mark.line, text = mark.text),
            );
            exported::note(ui, &line, &format!("note-{index}"), WidgetRole::Button, &mark.text, mark.line);
            if line.on_hover_cursor(egui::CursorIcon::PointingHand).clicked() {
                requested = Some(mark.line);
            }
        }
        if marks.len() > MOST_LISTED {
            ui.label(RichText::new(tr!("exercise-and-more-2", count = marks.len() - MOST_LISTED)).small().weak());
        }
    });
    requested
}

fn message_row(ui: &mut Ui, icon: &str, color: Color32, text: &str) -> egui::Response {
    ui.horizontal_top(|ui| {
        ui.label(RichText::new(icon).font(theme::icon_font(15.0)).color(color));
        ui.add(Label::new(text).wrap().sense(Sense::click()))
    })
    .inner
}

const KEYWORD: Tint = Tint::new([0x8a, 0x2d, 0xa8], [0xd8, 0x9b, 0xf0]);
const TYPE: Tint = Tint::new([0x0b, 0x6f, 0x75], [0x6f, 0xd3, 0xd0]);
const FUNCTION: Tint = Tint::new([0x1a, 0x5f, 0xb4], [0x82, 0xbc, 0xff]);
const VARIABLE: Tint = Tint::new([0xa8, 0x47, 0x0f], [0xff, 0xa8, 0x6e]);
const NUMBER: Tint = Tint::new([0x92, 0x56, 0x00], [0xf2, 0xc3, 0x6b]);
const COMMENT: Tint = Tint::new([0x53, 0x6a, 0x54], [0x86, 0xa1, 0x88]);
const DIRECTIVE: Tint = Tint::new([0x63, 0x63, 0x6c], [0xa5, 0xa9, 0xb4]);
const STRAY: Tint = crate::theme::colors::ERROR;

/// Longer texts have one colour, because colours cost time in each frame.
const MOST_COLORED_BYTES: usize = 100_000;

fn color_of(class: Class, dark: bool, text: Color32) -> Color32 {
    let tint = match class {
        Class::Keyword => KEYWORD,
        Class::Type => TYPE,
        Class::Function => FUNCTION,
        Class::Variable => VARIABLE,
        Class::Number => NUMBER,
        Class::Comment => COMMENT,
        Class::Directive => DIRECTIVE,
        Class::Stray => STRAY,
        Class::Name | Class::Mark => return text,
    };
    tint.in_theme(dark)
}

/// A text as last laid out, with its font size and theme.
#[derive(Clone)]
struct Kept {
    text: String,
    dark: bool,
    size: f32,
    job: LayoutJob,
}

/// The text in colours; cached until text, size or theme change. Lines are not wrapped.
fn highlighted(ui: &Ui, id: Id, text: &str, is_glsl: bool, font: &FontId) -> LayoutJob {
    let (dark, size) = (ui.visuals().dark_mode, font.size);
    let key = id.with("highlighted");
    let kept = ui.data(|data| data.get_temp::<Arc<Kept>>(key));
    if let Some(kept) = kept.filter(|kept| kept.text == text && kept.dark == dark && kept.size == size) {
        return kept.job.clone();
    }
    let job = colored(text, is_glsl, dark, ui.visuals().text_color(), font);
    let kept = Kept { text: text.to_owned(), dark, size, job: job.clone() };
    ui.data_mut(|data| data.insert_temp(key, Arc::new(kept)));
    job
}

fn colored(text: &str, is_glsl: bool, dark: bool, plain: Color32, font: &FontId) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    let mut append = |part: &str, color: Color32| {
        if !part.is_empty() {
            job.append(part, 0.0, TextFormat::simple(font.clone(), color));
        }
    };
    let mut at = 0;
    let parts = if is_glsl && text.len() <= MOST_COLORED_BYTES { gonio_glsl::classify(text) } else { Vec::new() };
    for part in parts {
        let (start, end) = (part.start as usize, part.end as usize);
        append(text.get(at..start).unwrap_or_default(), plain);
        append(text.get(start..end).unwrap_or_default(), color_of(part.class, dark, plain));
        at = end;
    }
    append(text.get(at..).unwrap_or_default(), plain);
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_in_colours_is_the_same_text() {
        let font = FontId::monospace(12.0);
        for text in ["", "#version 330\nin vec3 é; // ü\n", "void main() {", "\"€\" \\\n /* open"] {
            let job = colored(text, true, true, Color32::WHITE, &font);
            assert_eq!(job.text, text);
        }
        let job = colored("in vec3 a;", true, true, Color32::WHITE, &font);
        assert!(job.sections.iter().any(|section| section.format.color == KEYWORD.in_theme(true)));
        let long = "+0.0".repeat(MOST_COLORED_BYTES / 4 + 1);
        let job = colored(&long, true, true, Color32::WHITE, &font);
        assert_eq!((job.text.len(), job.sections.len()), (long.len(), 1));
    }
}
