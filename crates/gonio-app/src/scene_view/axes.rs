//! The axes cross; a click looks along an axis.

use super::{Projection, navigation, paint};
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::theme::{self, colors};
use egui::{Align2, Color32, Rect, Sense, Ui, Vec2, vec2};
use glam::DVec3;
use gonio_language::tr;

/// Length of an axis parallel to the picture, points.
const LENGTH: f32 = 26.0;
/// Radius of the disc at the end of an axis, points.
const END: f32 = 8.0;
/// Smallest side of a pane that shows the cross, points.
const SMALLEST_PANE: f32 = 220.0;

/// Width and height of the cross with its margin in a pane of this size, points; 0 where it is not shown.
pub fn extent(rect: Rect) -> f32 {
    if rect.width().min(rect.height()) < SMALLEST_PANE { 0.0 } else { 2.0 * (LENGTH + END + 10.0) }
}

/// Shows the cross at the lower left of a pane.
pub fn show(ui: &Ui, projection: &Projection, document: &mut Document, session: &Session) {
    let rect = projection.rect();
    if extent(rect) == 0.0 {
        return;
    }
    let camera = projection.camera();
    let middle = rect.left_bottom() + vec2(LENGTH + END + 10.0, -(LENGTH + END + 10.0));
    let painter = ui.painter_at(rect);
    painter.circle_filled(middle, LENGTH + END + 4.0, Color32::from_black_alpha(60));
    let flat = |axis: DVec3| vec2(axis.dot(camera.right) as f32, -axis.dot(camera.up) as f32);
    let tints = [colors::AXIS_X, colors::AXIS_Y, colors::AXIS_Z];
    let mut ends: Vec<(f64, DVec3, Option<&str>, Color32)> = Vec::new();
    for ((axis, letter), tint) in DVec3::AXES.into_iter().zip(["x", "y", "z"]).zip(tints) {
        let color = tint.in_theme(true);
        ends.push((axis.dot(camera.front), axis, Some(letter), color));
        ends.push((-axis.dot(camera.front), -axis, None, color.gamma_multiply(0.55)));
    }
    // The farthest is drawn first.
    ends.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, axis, letter, color) in ends {
        let end = middle + LENGTH * flat(axis);
        let name = format!("{}{}", if letter.is_some() { "" } else { "-" }, axis_letter(axis));
        let hit = Rect::from_center_size(end, Vec2::splat(2.0 * END + 2.0));
        let response = ui.interact(hit, ui.scope_id().with(("axis", &name)), Sense::click());
        let tip = tr!("scene-look-along", name = name);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &tip));
        exported::note(ui, &response, &format!("look-along-{name}"), WidgetRole::Button, &tip, "");
        let hovered = response.hovered();
        if let Some(letter) = letter {
            paint::line(&painter, [middle, end], 2.0, color);
            painter.circle_filled(end, END, if hovered { Color32::WHITE } else { color });
            painter.text(end, Align2::CENTER_CENTER, letter, theme::bold(11.5), Color32::BLACK);
        } else {
            painter.circle_filled(end, 0.65 * END, if hovered { Color32::WHITE } else { color });
        }
        if response.clicked() {
            navigation::look_along(document, session, -axis);
        }
        response.on_hover_text(tip);
    }
}

fn axis_letter(axis: DVec3) -> &'static str {
    if axis.x != 0.0 {
        "x"
    } else if axis.y != 0.0 {
        "y"
    } else {
        "z"
    }
}
