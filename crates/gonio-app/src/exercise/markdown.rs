//! An exercise's text: the part of Markdown that the exercises use, in the window's fonts.

use super::figure;
use crate::theme;
use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Frame, Label, Margin, RichText, TextStyle, Ui, vec2};
use gonio_exercises::exercise::Exercise;

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Block<'a> {
    /// Its level, from 1.
    Heading(usize, &'a str),
    Paragraph(String),
    /// Indentation, number or bullet, and text.
    Item(usize, String, String),
    Code(String),
    /// The first row is the head.
    Table(Vec<Vec<&'a str>>),
    /// Caption and file.
    Figure(&'a str, &'a str),
}

/// Style of letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Style {
    Plain,
    Bold,
    Italic,
    Code,
}

/// Shows an exercise's text with its figures.
pub fn show(ui: &mut Ui, exercise: &Exercise) {
    ui.spacing_mut().item_spacing.y = 7.0;
    for (index, block) in blocks(exercise.text()).iter().enumerate() {
        match block {
            Block::Heading(level, words) => {
                ui.add_space(if *level == 1 { 2.0 } else { 8.0 });
                let size = [20.0, 16.0, 14.5][(level - 1).min(2)];
                let text = RichText::new(*words).font(theme::bold(size)).color(ui.visuals().strong_text_color());
                ui.add(Label::new(text).wrap());
            }
            Block::Paragraph(words) => {
                ui.add(Label::new(inline(ui, words)).wrap());
            }
            Block::Item(indent, dot, words) => {
                ui.horizontal_top(|ui| {
                    ui.add_space(6.0 + 16.0 * *indent as f32);
                    ui.label(dot.as_str());
                    ui.add(Label::new(inline(ui, words)).wrap());
                });
            }
            Block::Code(code) => code_block(ui, code, index),
            Block::Table(rows) => table(ui, rows),
            Block::Figure(shows, file) => {
                // The caption is below the figure, or in its place if it cannot be drawn.
                if let Some(text) = exercise.file(file) {
                    figure::show(ui, file, shows, text);
                }
                ui.add(Label::new(RichText::new(*shows).weak().italics()).wrap());
            }
        }
    }
    ui.add_space(20.0);
}

fn code_block(ui: &mut Ui, code: &str, index: usize) {
    let frame = Frame::NONE.fill(ui.visuals().code_bg_color).corner_radius(5).inner_margin(Margin::symmetric(10, 7));
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        egui::ScrollArea::horizontal().id_salt(("code", index)).auto_shrink([false, true]).show(ui, |ui| {
            ui.add(Label::new(RichText::new(code).monospace()).extend());
        });
    });
}

/// A table. Columns share the available width by the lengths of their texts.
fn table(ui: &mut Ui, rows: &[Vec<&str>]) {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0).max(1);
    let longest = |column: usize| {
        let cells = || rows.iter().filter_map(|row| row.get(column));
        let whole = cells().map(|cell| cell.chars().count()).max().unwrap_or(0).min(40);
        // Words are not broken if possible.
        let word = cells().flat_map(|cell| cell.split(' ')).map(|word| word.chars().count()).max().unwrap_or(0);
        whole.max(word + 2).max(5) as f32
    };
    let weights: Vec<f32> = (0..columns).map(longest).collect();
    let gap = 10.0;
    let room = ui.available_width() - gap * (columns as f32 - 1.0) - 4.0;
    let all: f32 = weights.iter().sum();
    for (index, row) in rows.iter().enumerate() {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            for (cell, weight) in row.iter().zip(&weights) {
                let width = (room * weight / all).max(24.0);
                ui.allocate_ui_with_layout(vec2(width, 0.0), egui::Layout::top_down(egui::Align::LEFT), |ui| {
                    ui.set_width(width);
                    let words = if index == 0 { format!("**{cell}**") } else { (*cell).to_owned() };
                    ui.add(Label::new(inline(ui, &words)).wrap());
                });
            }
        });
        if index == 0 {
            let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 1.0), egui::Sense::hover());
            let stroke = ui.visuals().widgets.noninteractive.bg_stroke;
            ui.painter().hline(rect.x_range(), rect.center().y, stroke);
        }
    }
}

/// A line of text in several styles.
fn inline(ui: &Ui, words: &str) -> LayoutJob {
    let size = TextStyle::Body.resolve(ui.style()).size;
    let (plain, strong) = (ui.visuals().text_color(), ui.visuals().strong_text_color());
    let code = TextStyle::Monospace.resolve(ui.style());
    let ground = ui.visuals().code_bg_color;
    let mut job = LayoutJob::default();
    for (text, style) in spans(words) {
        let simple = |font: FontId, color: Color32| TextFormat::simple(font, color);
        let format = match style {
            Style::Plain => simple(FontId::proportional(size), plain),
            Style::Bold => simple(theme::bold(size), strong),
            Style::Italic => TextFormat { italics: true, ..simple(FontId::proportional(size), plain) },
            Style::Code => TextFormat { background: ground, ..simple(code.clone(), strong) },
        };
        job.append(&text, 0.0, format);
    }
    job
}

/// Splits a text by style. Unclosed markup is plain text.
fn spans(words: &str) -> Vec<(String, Style)> {
    let mut found: Vec<(String, Style)> = Vec::new();
    let mut plain = String::new();
    let mut rest = words;
    while let Some(first) = rest.chars().next() {
        let closed = |open: &str, close: &str| {
            let inside = rest.strip_prefix(open)?;
            let end = inside.find(close).filter(|&end| end > 0)?;
            Some((inside.get(..end)?, inside.get(end + close.len()..)?))
        };
        let link = || {
            let (label, after) = closed("[", "](")?;
            let end = after.find(')')?;
            Some((label, after.get(end + 1..)?))
        };
        let word_before = plain.chars().next_back().is_some_and(char::is_alphanumeric);
        let next = closed("`", "`")
            .map(|(text, rest)| (text, rest, Style::Code))
            .or_else(|| closed("**", "**").map(|(text, rest)| (text, rest, Style::Bold)))
            .or_else(|| closed("*", "*").filter(|(text, _)| !text.starts_with(' ')).map(|(t, r)| (t, r, Style::Italic)))
            .or_else(|| closed("_", "_").filter(|_| !word_before).map(|(text, rest)| (text, rest, Style::Italic)))
            .or_else(|| link().map(|(text, rest)| (text, rest, Style::Plain)));
        match next {
            Some((text, after, style)) => {
                if !plain.is_empty() {
                    found.push((std::mem::take(&mut plain), Style::Plain));
                }
                found.push((text.to_owned(), style));
                rest = after;
            }
            None => {
                plain.push(first);
                rest = rest.get(first.len_utf8()..).unwrap_or_default();
            }
        }
    }
    if !plain.is_empty() {
        found.push((plain, Style::Plain));
    }
    found
}

/// The beginning of each line of code without a fence.
const INDENT: &str = "    ";

/// The parts of a text.
fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut found: Vec<Block<'_>> = Vec::new();
    let mut lines = text.lines().peekable();
    let mut goes_on = false;
    while let Some(line) = lines.next() {
        let trimmed = line.trim_start();
        let indent = (line.len() - trimmed.len()) / 2;
        let was_text = std::mem::replace(&mut goes_on, false);
        if trimmed.starts_with("```") {
            let code: Vec<&str> = lines.by_ref().take_while(|line| line.trim_start() != "```").collect();
            found.push(Block::Code(code.join("\n")));
        } else if trimmed.is_empty() {
            continue;
        } else if !was_text && line.starts_with(INDENT) {
            let mut code = vec![&line[INDENT.len()..]];
            while let Some(next) = lines.peek().and_then(|next| next.strip_prefix(INDENT)) {
                code.push(next);
                lines.next();
            }
            found.push(Block::Code(code.join("\n")));
        } else if trimmed.starts_with('#') {
            let level = trimmed.chars().take_while(|c| *c == '#').count();
            found.push(Block::Heading(level, trimmed.trim_start_matches('#').trim()));
        } else if trimmed.starts_with('|') {
            let mut rows = vec![row_of(trimmed)];
            while let Some(next) = lines.peek().filter(|next| next.trim_start().starts_with('|')) {
                let row = row_of(next.trim_start());
                if !row.iter().all(|cell| cell.chars().all(|c| matches!(c, '-' | ':' | ' '))) {
                    rows.push(row);
                }
                lines.next();
            }
            found.push(Block::Table(rows));
        } else if let Some((shows, file)) = named_figure(trimmed) {
            found.push(Block::Figure(shows, file));
        } else if let Some((dot, words)) = item(trimmed) {
            found.push(Block::Item(indent, dot, words.to_owned()));
            goes_on = true;
        } else {
            match found.last_mut() {
                Some(Block::Paragraph(words) | Block::Item(_, _, words)) if was_text => {
                    words.push(' ');
                    words.push_str(trimmed.trim_end());
                }
                _ => found.push(Block::Paragraph(trimmed.trim_end().to_owned())),
            }
            goes_on = true;
        }
    }
    found
}

/// The cells of a row; a bar within `code` does not end a cell.
fn row_of(line: &str) -> Vec<&str> {
    let inside = line.trim().trim_start_matches('|').trim_end_matches('|');
    let (mut cells, mut from, mut in_code) = (Vec::new(), 0, false);
    for (at, c) in inside.char_indices() {
        match c {
            '`' => in_code = !in_code,
            '|' if !in_code => {
                cells.push(inside.get(from..at).unwrap_or_default().trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    cells.push(inside.get(from..).unwrap_or_default().trim());
    cells
}

fn named_figure(line: &str) -> Option<(&str, &str)> {
    let (shows, rest) = line.strip_prefix("![")?.split_once("](")?;
    Some((shows, rest.split(')').next()?))
}

fn item(line: &str) -> Option<(String, &str)> {
    if let Some(words) = line.strip_prefix("- ").or_else(|| line.strip_prefix("* ")) {
        return Some(("•".to_owned(), words));
    }
    let (number, words) = line.split_once(". ")?;
    let is_number = !number.is_empty() && number.len() < 4 && number.bytes().all(|b| b.is_ascii_digit());
    is_number.then(|| (format!("{number}."), words))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_exercises::exercise;
    use gonio_language::Language;

    #[test]
    fn a_text_is_split_into_blocks() {
        let text = "# One\n\nWords that\ngo on.\n\n- a `b|c`\n  and on\n- d\n1. first\n\n```glsl\nx\n\ny\n```\n\nSay:\n\n    a b\n      c\n\n| a | b |\n|---|---|\n| `x|y` | 2 |\n![A curve](a.svg)\n";
        assert_eq!(
            blocks(text),
            [
                Block::Heading(1, "One"),
                Block::Paragraph("Words that go on.".into()),
                Block::Item(0, "•".into(), "a `b|c` and on".into()),
                Block::Item(0, "•".into(), "d".into()),
                Block::Item(0, "1.".into(), "first".into()),
                Block::Code("x\n\ny".into()),
                Block::Paragraph("Say:".into()),
                Block::Code("a b\n  c".into()),
                Block::Table(vec![vec!["a", "b"], vec!["`x|y`", "2"]]),
                Block::Figure("A curve", "a.svg"),
            ]
        );
    }

    #[test]
    fn text_is_split_by_style() {
        let plain = |text: &str| (text.to_owned(), Style::Plain);
        assert_eq!(spans("2 * 3 * x and k_l d"), [plain("2 * 3 * x and k_l d")]);
        assert_eq!(
            spans("**b** `c*c` [l](u) *i*"),
            [
                ("b".into(), Style::Bold),
                plain(" "),
                ("c*c".into(), Style::Code),
                plain(" "),
                plain("l"),
                plain(" "),
                ("i".into(), Style::Italic)
            ]
        );
    }

    #[test]
    fn every_word_of_every_exercise_is_shown() {
        let in_each_language = |e: &'static Exercise| Language::ALL.map(|language| (&e.id, e.text_in(language)));
        for (id, text) in exercise::all().iter().flat_map(in_each_language) {
            let blocks = blocks(text);
            let mut shown = format!("{blocks:?}");
            shown.retain(char::is_alphanumeric);
            for word in text.split_whitespace().filter(|word| word.bytes().all(|b| b.is_ascii_lowercase())) {
                assert!(shown.contains(word), "{id}: {word}");
            }
            assert!(matches!(blocks.first(), Some(Block::Heading(1, _))), "{id}");
        }
    }
}
