//! The scale beside a map of differences.

use egui::{Align2, Color32, CornerRadius, Mesh, Rect, Stroke, StrokeKind, TextStyle, Ui, pos2, vec2};
use gonio_scene::difference::{heat, signed};

/// The scale of a map of differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// 8-bit steps of the last colour.
    pub full_scale: f64,
    /// Whether it ranges from minus to plus.
    pub signed: bool,
}

impl Scale {
    /// The colour of a share of the scale's length, 0 at its lower end.
    fn color(&self, share: f64) -> Color32 {
        let [r, g, b] = if self.signed { signed(2.0 * share - 1.0) } else { heat(share) };
        Color32::from_rgb(r, g, b)
    }

    /// Labels by their share of the scale's length.
    fn marks(&self) -> Vec<(f64, String)> {
        let number = |steps: f64| {
            let text = if steps.abs() < 10.0 { format!("{steps:.1}") } else { format!("{steps:.0}") };
            text.strip_suffix(".0").map_or(text.clone(), str::to_owned).replace('-', "−")
        };
        let full = self.full_scale;
        if self.signed {
            [(0.0, -full), (0.25, -0.5 * full), (0.5, 0.0), (0.75, 0.5 * full), (1.0, full)]
                .map(|(share, steps)| (share, if steps > 0.0 { format!("+{}", number(steps)) } else { number(steps) }))
                .into()
        } else {
            [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| (share, number(share * full))).into()
        }
    }
}

/// Draws it at the right edge of a map: a bar, upright, with its numbers in 8-bit steps.
pub fn show(ui: &Ui, room: Rect, scale: &Scale) {
    let height = (0.5 * room.height()).clamp(80.0, 260.0);
    let ground = Rect::from_min_size(room.right_top() + vec2(-86.0, 12.0), vec2(74.0, height + 44.0));
    let painter = ui.painter().with_clip_rect(room.intersect(ui.clip_rect()));
    painter.rect_filled(ground, CornerRadius::same(6), Color32::from_black_alpha(170));
    painter.rect_stroke(
        ground,
        CornerRadius::same(6),
        Stroke::new(1.0, Color32::from_white_alpha(40)),
        StrokeKind::Inside,
    );
    let ink = Color32::from_gray(0xf2);
    let font = TextStyle::Small.resolve(ui.style());
    painter.text(ground.center_top() + vec2(0.0, 6.0), Align2::CENTER_TOP, "of 255", font.clone(), ink);
    let bar = Rect::from_min_size(ground.left_top() + vec2(10.0, 30.0), vec2(16.0, height));
    let mut mesh = Mesh::default();
    const PIECES: u32 = 48;
    for piece in 0..=PIECES {
        let share = f64::from(piece) / f64::from(PIECES);
        let y = bar.bottom() - share as f32 * bar.height();
        let color = scale.color(share);
        mesh.colored_vertex(pos2(bar.left(), y), color);
        mesh.colored_vertex(pos2(bar.right(), y), color);
        if piece > 0 {
            let i = 2 * piece;
            mesh.add_triangle(i - 2, i - 1, i);
            mesh.add_triangle(i - 1, i, i + 1);
        }
    }
    painter.add(mesh);
    painter.rect_stroke(bar, CornerRadius::ZERO, Stroke::new(1.0, Color32::from_white_alpha(90)), StrokeKind::Outside);
    for (share, text) in scale.marks() {
        let y = bar.bottom() - share as f32 * bar.height();
        painter.hline(bar.right()..=bar.right() + 4.0, y, Stroke::new(1.0, ink));
        painter.text(pos2(bar.right() + 8.0, y), Align2::LEFT_CENTER, text, font.clone(), ink);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_their_colours_are() {
        let scale = Scale { full_scale: 16.0, signed: false };
        let marks: Vec<String> = scale.marks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(marks, ["0", "4", "8", "12", "16"]);
        let scale = Scale { full_scale: 5.0, signed: true };
        let marks: Vec<String> = scale.marks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(marks, ["−5", "−2.5", "0", "+2.5", "+5"]);
        let [r, g, b] = signed(0.0);
        assert_eq!(scale.color(0.5), Color32::from_rgb(r, g, b));
    }
}
