//! An exercise's figures, painted from the files that the text names.
//!
//! | file | contents |
//! |---|---|
//! | `read` | the file's elements |
//! | `outline` | the points of its curves, and the insides of its shapes |

mod outline;
mod read;

use crate::exported::{self, WidgetRole};
use crate::theme;
use egui::{Color32, CornerRadius, FontId, Pos2, Rect, ScrollArea, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};
use read::{Figure, FigureShape, Letters, Pen, Text};

/// Smallest scale of a figure, so that its letters are legible; a narrower window scrolls it sideways.
const SMALLEST: f32 = 0.55;

/// Shows a figure from its SVG text, as wide as there is room for; `shows` describes it for screen readers. A file that cannot
/// be read is not shown.
pub fn show(ui: &mut Ui, name: &str, shows: &str, text: &str) {
    let Some(figure) = read::figure(text) else { return };
    let room = ui.available_width();
    let scale = (room / figure.size.x).clamp(SMALLEST, 1.0);
    let size = figure.size * scale;
    let area = ScrollArea::horizontal().id_salt(name).auto_shrink([false, true]);
    area.show(ui, |ui| {
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, shows));
        exported::note(ui, &response, &format!("figure-{name}"), WidgetRole::Picture, shows, "");
        if ui.is_rect_visible(rect) {
            paint(ui, rect, scale, &figure);
        }
    });
}

/// The letters of a kind, in points.
fn font(letters: Letters, size: f32) -> FontId {
    match letters {
        Letters::Plain => FontId::proportional(size),
        Letters::Bold => theme::bold(size),
        Letters::Math => theme::math_italic_font(size),
        Letters::Code => FontId::monospace(size),
    }
}

/// Replaces a sign that the fonts lack by another one with a line through it.
fn parts(sign: char) -> (char, bool) {
    if sign == '\u{2260}' { ('=', true) } else { (sign, false) }
}

/// Placement of a figure.
struct Place<'a> {
    ui: &'a Ui,
    min: Pos2,
    scale: f32,
    dark: bool,
}

fn paint(ui: &Ui, rect: Rect, scale: f32, figure: &Figure) {
    let place = Place { ui, min: rect.min, scale, dark: ui.visuals().dark_mode };
    for shape in &figure.shapes {
        place.shape(shape);
    }
}

impl Place<'_> {
    fn at(&self, point: Pos2) -> Pos2 {
        self.min + point.to_vec2() * self.scale
    }

    /// Inverts lightness in the dark theme; hues stay.
    fn color(&self, color: Color32) -> Color32 {
        if !self.dark {
            return color;
        }
        let [r, g, b] = [color.r(), color.g(), color.b()].map(i32::from);
        let turn = 255 - r.max(g).max(b) - r.min(g).min(b);
        // Not quite to black, because the panel around it is not black either.
        let turned = [r, g, b].map(|value| (24 + (value + turn) * (255 - 24) / 255).clamp(0, 255) as u8);
        Color32::from_rgb(turned[0], turned[1], turned[2])
    }

    fn stroke(&self, pen: Option<&Pen>) -> Stroke {
        pen.map_or(Stroke::NONE, |pen| Stroke::new(pen.width * self.scale, self.color(pen.color)))
    }

    fn shape(&self, shape: &FigureShape) {
        let painter = self.ui.painter();
        match shape {
            FigureShape::Lines { points, closed, fill, pen } => {
                let points: Vec<Pos2> = points.iter().map(|point| self.at(*point)).collect();
                if let Some(fill) = fill {
                    painter.add(outline::inside(&points, self.color(*fill)));
                }
                self.line(points, *closed, pen.as_ref());
            }
            FigureShape::Rectangle { rect, radius, fill, pen } => {
                let rect = Rect::from_min_max(self.at(rect.min), self.at(rect.max));
                let corners = CornerRadius::same((radius * self.scale).round() as u8);
                let fill = fill.map_or(Color32::TRANSPARENT, |fill| self.color(fill));
                painter.rect(rect, corners, fill, self.stroke(pen.as_ref()), StrokeKind::Middle);
            }
            FigureShape::Circle { center, radius, fill, pen } => {
                let fill = fill.map_or(Color32::TRANSPARENT, |fill| self.color(fill));
                painter.circle(self.at(*center), radius * self.scale, fill, self.stroke(pen.as_ref()));
            }
            FigureShape::Text(text) => self.text(text),
        }
    }

    fn line(&self, mut points: Vec<Pos2>, closed: bool, pen: Option<&Pen>) {
        let Some(pen) = pen else { return };
        let (painter, stroke) = (self.ui.painter(), self.stroke(Some(pen)));
        match pen.dashes {
            Some([dash, gap]) => {
                points.extend(points.first().copied().filter(|_| closed));
                painter.extend(egui::Shape::dashed_line(&points, stroke, dash * self.scale, gap * self.scale));
            }
            None if closed => drop(painter.add(egui::Shape::closed_line(points, stroke))),
            None => drop(painter.add(egui::Shape::line(points, stroke))),
        }
    }

    fn text(&self, text: &Text) {
        let painter = self.ui.painter();
        let color = self.color(text.color);
        let laid_out: Vec<_> = text
            .pieces
            .iter()
            .map(|(step, size, words)| {
                let letters: String = words.chars().map(|c| parts(c).0).collect();
                let galley = painter.layout_no_wrap(letters, font(text.letters, size * self.scale), color);
                (*step * self.scale, words, galley)
            })
            .collect();
        let width: f32 = laid_out.iter().map(|(step, _, galley)| step.x + galley.size().x).sum();
        let mut at = self.at(text.at) - vec2(text.anchor * width, 0.0);
        for (step, words, galley) in laid_out {
            at += step;
            // SVG positions the baseline, egui the top of the text.
            let first = galley.rows.first().and_then(|row| Some(row.pos.y + row.row.glyphs.first()?.pos.y));
            let width = galley.size().x;
            let glyphs = galley.rows.iter().flat_map(|row| &row.row.glyphs);
            for (glyph, _) in glyphs.zip(words.chars()).filter(|(_, c)| parts(*c).1) {
                let middle = at + vec2(glyph.pos.x + 0.5 * glyph.advance_width, -0.3 * glyph.line_height);
                let half = vec2(0.12, -0.3) * glyph.line_height;
                painter.line_segment([middle - half, middle + half], Stroke::new(0.07 * glyph.line_height, color));
            }
            painter.galley(at - vec2(0.0, first.unwrap_or(0.0)), galley, color);
            at.x += width;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_exercises::exercise;

    /// The page's fonts have every letter of every figure.
    #[test]
    fn the_fonts_have_every_letter() {
        let ctx = egui::Context::default();
        theme::install(&ctx);
        let mut output = ctx.run_ui(egui::RawInput::default(), |ui| {
            let all = exercise::all().iter().flat_map(|exercise| exercise.start_files());
            for (name, text) in all.filter(|(name, _)| name.ends_with(".svg")) {
                let figure = read::figure(text).unwrap_or_else(|| panic!("{name}"));
                for shape in &figure.shapes {
                    let FigureShape::Text(text) = shape else { continue };
                    let (font, pieces) = (font(text.letters, 15.0), text.pieces.iter());
                    let letters: String = pieces.flat_map(|(_, _, words)| words.chars()).map(|c| parts(c).0).collect();
                    let lacks = |c: &char| !ui.fonts_mut(|fonts| fonts.has_glyph(&font, *c));
                    assert_eq!(letters.chars().filter(lacks).collect::<String>(), "", "{name}: {letters}");
                }
            }
        });
        // The test has no GPU to upload textures to.
        output.textures_delta.clear();
    }
}
