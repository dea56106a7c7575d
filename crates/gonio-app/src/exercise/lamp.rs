//! The lamp of an exercise in its pictures: it is drawn, and a drag moves it parallel to the picture.

use super::work::Work;
use crate::exported::{self, WidgetRole};
use crate::scene_view::{Projection, disc, in_screen_plane};
use crate::theme::colors;
use egui::{Color32, CursorIcon, Painter, Pos2, Rect, Sense, Stroke, Ui, Vec2, vec2};
use gonio_language::tr;

/// Radius of the lamp's disc, points.
const RADIUS: f32 = 6.0;
/// Radius in which it is hit by the pointer or by a finger, points.
const HIT: f32 = 15.0;
/// Distance from the picture's edge of the mark of a lamp outside of it, points.
const EDGE: f32 = 14.0;

/// Shows the lamp in one of the pictures. `index` tells the pictures apart.
pub fn show(ui: &mut Ui, rect: Rect, work: &mut Work, index: usize) {
    let Some(lamp) = work.lamp() else { return };
    let mut camera = work.camera.to_camera();
    // The field of view is that of the picture's shorter side.
    let longer = f64::from((rect.height() / rect.width().max(1.0)).max(1.0));
    camera.fov_y_rad = 2.0 * ((0.5 * camera.fov_y_rad).tan() * longer).atan();
    let projection = Projection::new(&camera, rect);
    let Some(place) = projection.to_window(lamp.as_dvec3()) else { return };
    let inside = rect.shrink(EDGE);
    let shown = place.clamp(inside.min, inside.max);
    let hit = Rect::from_center_size(shown, Vec2::splat(2.0 * HIT));
    let response = ui.interact(hit, ui.scope_id().with(("lamp", index)), Sense::drag());
    exported::note(ui, &response, &format!("lamp-{index}"), WidgetRole::Picture, tr!("exercise-lamp"), "");
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let pointer = pointer.clamp(rect.min, rect.max);
        let moved = in_screen_plane(&projection, lamp.as_dvec3(), pointer).as_vec3();
        if moved.is_finite() {
            work.lamp_offset += moved - lamp;
        }
        ui.ctx().request_repaint();
    }
    let is_active = response.hovered() || response.dragged();
    let painter = ui.painter().with_clip_rect(rect);
    if shown == place {
        bulb(&painter, shown, is_active)
    } else {
        edge_mark(&painter, rect, shown)
    }
    let response = response.on_hover_cursor(CursorIcon::Grab);
    response.on_hover_text(tr!("exercise-the-lamp-drag-it-reset-the"));
}

/// A disc with rays.
fn bulb(painter: &Painter, place: Pos2, is_active: bool) {
    let color = colors::LIGHT.in_theme(true);
    for ray in 0..8 {
        let ahead = Vec2::angled(ray as f32 * std::f32::consts::TAU / 8.0);
        let stroke = Stroke::new(2.0, color);
        painter.line_segment([place + ahead * (RADIUS + 4.0), place + ahead * (RADIUS + 8.0)], stroke);
    }
    disc(painter, place, if is_active { RADIUS + 1.5 } else { RADIUS }, color, false);
}

/// A triangle at the edge that points to a lamp outside of the picture.
fn edge_mark(painter: &Painter, rect: Rect, place: Pos2) {
    let way = (place - rect.center()).normalized();
    let side = vec2(-way.y, way.x);
    let corners = vec![place + way * 11.0, place - way * 5.0 + side * 8.0, place - way * 5.0 - side * 8.0];
    let rim = Stroke::new(1.5, Color32::from_black_alpha(150));
    painter.add(egui::Shape::convex_polygon(corners, colors::LIGHT.in_theme(true), rim));
}
