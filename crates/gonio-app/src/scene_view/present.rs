//! Finished pictures in the window.

use eframe::egui_glow;
use egui::{Rect, Ui};
use gonio_gl::Gl;
use gonio_render::Presentation;
use std::sync::Arc;

/// Columns and rows of the window that a rectangle takes: as egui rounds them for a paint callback, so that a picture is
/// shown pixel for pixel.
pub fn picture_size(rect: Rect, pixels_per_point: f32) -> [u32; 2] {
    let side = |from: f32, to: f32| (to * pixels_per_point).round() - (from * pixels_per_point).round();
    [side(rect.left(), rect.right()), side(rect.top(), rect.bottom())].map(|side| side.max(0.0) as u32)
}

/// Shows a finished picture in a rectangle of its size.
pub fn present(ui: &Ui, rect: Rect, picture: Presentation) {
    let callback = egui_glow::CallbackFn::new(move |_, painter| picture.draw(&Gl::of_window(painter.gl().clone())));
    ui.painter().add(egui::PaintCallback { rect, callback: Arc::new(callback) });
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::ViewportInPixels;
    use egui::{Pos2, vec2};

    /// Anything else would be shown with a row or a column doubled or left out.
    #[test]
    fn a_picture_is_as_large_as_egui_makes_room_for() {
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
