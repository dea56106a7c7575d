//! Painting in panes: finished pictures, and lines and labels over them that are legible on any background.

use eframe::egui_glow;
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, Vec2, vec2};
use gonio_gl::Gl;
use gonio_render::Presentation;
use std::sync::Arc;

/// The size of a rectangle in pixels, rounded as egui does for paint callbacks, so that a picture is shown pixel for pixel.
pub fn picture_size(rect: Rect, pixels_per_point: f32) -> [u32; 2] {
    let side = |from: f32, to: f32| (to * pixels_per_point).round() - (from * pixels_per_point).round();
    [side(rect.left(), rect.right()), side(rect.top(), rect.bottom())].map(|side| side.max(0.0) as u32)
}

/// Shows a finished picture in a rectangle of its size.
pub fn present(ui: &Ui, rect: Rect, picture: Presentation) {
    let callback = egui_glow::CallbackFn::new(move |_, painter| picture.draw(&Gl::of_window(painter.gl().clone())));
    ui.painter().add(egui::PaintCallback { rect, callback: Arc::new(callback) });
}

/// The shade below lines and labels, which separates them from a bright picture.
const SHADE: Color32 = Color32::from_black_alpha(150);

/// A line with a dark rim.
pub fn line(painter: &Painter, points: [Pos2; 2], width: f32, color: Color32) {
    painter.line_segment(points, Stroke::new(width + 2.0, SHADE));
    painter.line_segment(points, Stroke::new(width, color));
}

/// A line through many points, with a dark rim and gaps at missing points (behind the eye).
pub fn curve(painter: &Painter, points: &[Option<Pos2>], width: f32, color: Color32) {
    for run in points.split(Option::is_none) {
        let run: Vec<Pos2> = run.iter().flatten().copied().collect();
        if run.len() > 1 {
            painter.add(Shape::line(run.clone(), Stroke::new(width + 2.0, SHADE)));
            painter.add(Shape::line(run, Stroke::new(width, color)));
        }
    }
}

/// Dashes with a dark rim.
pub fn dashes(painter: &Painter, points: [Pos2; 2], width: f32, color: Color32) {
    painter.extend(Shape::dashed_line(&points, Stroke::new(width + 1.5, SHADE), 5.0, 4.0));
    painter.extend(Shape::dashed_line(&points, Stroke::new(width, color), 5.0, 4.0));
}

/// An arrow with a filled head and a dark rim.
pub fn arrow(painter: &Painter, from: Pos2, to: Pos2, width: f32, color: Color32) {
    let way = to - from;
    let length = way.length();
    if length < 1.0 {
        painter.circle(from, width + 1.0, color, Stroke::new(1.0, SHADE));
        return;
    }
    let head = (4.0 + 2.5 * width).min(0.6 * length);
    let ahead = way / length;
    let side = ahead.rot90() * (0.42 * head);
    let neck = to - ahead * head;
    painter.line_segment([from, neck], Stroke::new(width + 2.0, SHADE));
    let triangle = vec![to, neck + side, neck - side];
    painter.add(Shape::convex_polygon(triangle, color, Stroke::new(1.0, SHADE)));
    painter.line_segment([from, neck + ahead], Stroke::new(width, color));
}

/// A disc of a light's colour with a white and a dark ring; only the rings if it is `hollow`.
pub fn disc(painter: &Painter, center: Pos2, radius: f32, color: Color32, hollow: bool) {
    painter.circle_filled(center, radius + 2.6, SHADE);
    if hollow {
        painter.circle(center, radius, Color32::from_black_alpha(120), Stroke::new(2.0, color));
    } else {
        painter.circle(center, radius, color, Stroke::new(1.6, Color32::WHITE));
    }
}

/// A text on a plate, moved into `within`. `align` is the corner of the plate at `place`.
pub fn label(ui: &Ui, painter: &Painter, within: Rect, place: Pos2, align: Align2, text: &str, color: Color32) -> Rect {
    let font = FontId::proportional(12.0);
    let galley = painter.layout_no_wrap(text.to_owned(), font, color);
    let padding = vec2(5.0, 2.0);
    let rect = align.anchor_size(place, galley.size() + 2.0 * padding);
    let rect = rect.translate(back_inside(rect, within));
    painter.rect_filled(rect, 4.0, ui.visuals().window_fill.gamma_multiply(0.86));
    painter.galley(rect.min + padding, galley, color);
    rect
}

/// The translation that moves a rectangle into another one, if it fits.
fn back_inside(rect: Rect, within: Rect) -> Vec2 {
    let x = (within.left() - rect.left()).max(0.0) - (rect.right() - within.right()).max(0.0);
    let y = (within.top() - rect.top()).max(0.0) - (rect.bottom() - within.bottom()).max(0.0);
    vec2(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::ViewportInPixels;
    use egui::{Pos2, vec2};

    /// Another size would double or drop a row or a column.
    #[test]
    fn a_picture_has_the_size_of_eguis_viewport() {
        let mut fractional = 0;
        for step in 0..400 {
            let pixels_per_point = [1.0, 1.25, 1.5, 2.0, 1.1][step % 5];
            let [left, top] = [0.37, 0.61].map(|share| share * step as f32);
            let rect = Rect::from_min_size(Pos2::new(left, top), vec2(300.3 + left, 200.7));
            let room = ViewportInPixels::from_points(&rect, pixels_per_point, [4000, 4000]);
            let size = picture_size(rect, pixels_per_point);
            assert_eq!(size, [room.width_px as u32, room.height_px as u32], "{rect:?} at {pixels_per_point}");
            fractional += usize::from(size[1] != (rect.height() * pixels_per_point).round() as u32);
        }
        assert!(fractional > 20, "only {fractional} sizes are not simply rounded");
        assert_eq!(picture_size(Rect::NOTHING, 1.0), [0, 0]);
    }
}
