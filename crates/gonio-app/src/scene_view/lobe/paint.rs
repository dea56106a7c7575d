//! Paints a lobe: on the surface as the eye sees it, and in an inset from the side.

use super::SurfaceLobe;
use crate::exported::{self, WidgetRole};
use crate::scene_view::{Projection, paint};
use crate::theme::{self, colors};
use crate::widgets::compact;
use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2};
use gonio_language::tr;
use gonio_light::DVec3;
use gonio_light::vector::{any_orthonormal_vector, unit_or};
use std::f64::consts::TAU;

/// Length of the largest value, as a share of the picture's height.
const LENGTH: f64 = 1.0 / 6.0;
/// Size of the inset in points, and of the smallest pane that has one.
const INSET: Vec2 = vec2(196.0, 172.0);
const LEAST_PANE: Vec2 = vec2(300.0, 300.0);
/// The angle by which the inset looks down on the surface, radians.
const RISE: f64 = 0.22;

/// A place in the window, and how near it is to the viewer; larger is nearer.
type Placed = (Pos2, f64);

/// The lobe where it stands.
pub fn on_surface(ui: &Ui, projection: &Projection, lobe: &SurfaceLobe) {
    let origin = lobe.point.position;
    let length = LENGTH * f64::from(projection.rect().height()) * projection.units_per_point(origin);
    let place = |offset: DVec3| {
        let at = projection.to_window(origin + length * offset)?;
        Some((at, offset.dot(lobe.point.view)))
    };
    surface(&ui.painter_at(projection.rect()), lobe, &place, lobe.point.view, 0.62);
}

/// Paints the lobe as quads, the farthest first.
fn surface(
    painter: &Painter,
    lobe: &SurfaceLobe,
    place: &dyn Fn(DVec3) -> Option<Placed>,
    to_viewer: DVec3,
    opacity: f32,
) {
    let ends: Vec<DVec3> = lobe.directions.iter().zip(&lobe.shares).map(|(w, share)| *w * *share).collect();
    let placed: Vec<Option<Placed>> = ends.iter().map(|end| place(*end)).collect();
    let mut quads: Vec<([Pos2; 4], f64, f64)> = Vec::new();
    for row in 0..lobe.rows.saturating_sub(1) {
        for column in 0..lobe.columns.saturating_sub(1) {
            let corner = |r: usize, c: usize| (row + r) * lobe.columns + column + c;
            let [a, b, c, d] = [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)];
            let (Some(p), Some(q), Some(r), Some(s)) = (placed[a], placed[b], placed[c], placed[d]) else { continue };
            let normal = unit_or((ends[c] - ends[a]).cross(ends[d] - ends[b]), DVec3::ZERO);
            quads.push(([p.0, q.0, r.0, s.0], p.1 + q.1 + r.1 + s.1, normal.dot(to_viewer).abs()));
        }
    }
    quads.sort_by(|a, b| a.1.total_cmp(&b.1));
    let tint = colors::SPECULAR.in_theme(true);
    let mut mesh = Mesh::default();
    for (corners, _, facing) in quads {
        let bright = 0.45 + 0.55 * facing as f32;
        let [r, g, b] = [tint.r(), tint.g(), tint.b()].map(|channel| (f32::from(channel) * bright) as u8);
        let color = Color32::from_rgb(r, g, b).gamma_multiply(opacity);
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(corners.map(|pos| Vertex { pos, uv: WHITE_UV, color }));
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    painter.add(Shape::mesh(mesh));
}

/// The lobe from the side, in a corner of the pane away from the pinned point.
pub fn inset(ui: &Ui, projection: &Projection, lobe: &SurfaceLobe, (pane, name): (usize, &str)) {
    let room = projection.rect();
    let Some(rect) = inset_place(room, projection.to_window(lobe.point.position)) else { return };
    let painter = ui.painter_at(room);
    painter.rect_filled(rect, 7.0, Color32::from_black_alpha(190));
    painter.rect_stroke(rect, 7.0, Stroke::new(1.0, Color32::from_white_alpha(40)), StrokeKind::Inside);

    // V and N lie in the picture's plane.
    let n = lobe.point.normal;
    let right = unit_or(lobe.point.view - n * n.dot(lobe.point.view), any_orthonormal_vector(n));
    let away = n.cross(right);
    let to_viewer = RISE.sin() * n - RISE.cos() * away;
    let (center, radius) = (pos2(rect.center().x, rect.bottom() - 46.0), 82.0);
    let place = |offset: DVec3| -> Placed {
        let (x, y) = (offset.dot(right), offset.dot(n) * RISE.cos() + offset.dot(away) * RISE.sin());
        (center + radius * vec2(x as f32, -y as f32), offset.dot(to_viewer))
    };
    let disc = (0..=48).map(|step| {
        let (sin, cos) = (TAU * f64::from(step) / 48.0).sin_cos();
        place(cos * right + sin * away).0
    });
    painter.add(Shape::line(disc.collect(), Stroke::new(1.0, Color32::from_white_alpha(90))));
    surface(&painter, lobe, &|offset| Some(place(offset)), to_viewer, 0.8);
    let arrows = [
        (lobe.light, "L", colors::LIGHT),
        (lobe.mirror, "R", colors::REFLECTION),
        (n, "N", colors::NORMAL),
        (lobe.point.view, "V", colors::VIEW),
    ];
    for (direction, letter, tint) in arrows {
        let color = tint.in_theme(true);
        let tip = place(direction * 1.02).0;
        paint::arrow(&painter, center, tip, 1.6, color);
        let beyond = tip + (tip - center).normalized() * 10.0;
        painter.text(beyond, Align2::CENTER_CENTER, letter, theme::math_italic_font(14.0), color);
    }
    let eye = place(lobe.point.view * lobe.eye_share()).0;
    painter.circle(eye, 4.0, colors::VIEW.in_theme(true), Stroke::new(1.5, Color32::WHITE));

    let share = 100.0 * lobe.eye_share();
    let text = tr!("scene-towards-v-of-the-peak", value = compact(lobe.to_eye), share = format!("{share:.0}"));
    let ink = Color32::from_gray(235);
    let below = rect.center_bottom() - vec2(0.0, 8.0);
    painter.text(below, Align2::CENTER_BOTTOM, &text, FontId::proportional(11.0), ink);
    painter.text(rect.left_top() + vec2(9.0, 7.0), Align2::LEFT_TOP, name, FontId::proportional(11.5), ink);
    let response = ui.interact(rect, ui.scope_id().with(("lobe", pane)), Sense::hover());
    exported::note(ui, &response, &format!("lobe-{pane}"), WidgetRole::Picture, &text, lobe.to_eye);
}

/// The place of the inset: beside the point, on the side with more room. `None` in a pane that is too small.
fn inset_place(room: Rect, point: Option<Pos2>) -> Option<Rect> {
    if room.width() < LEAST_PANE.x || room.height() < LEAST_PANE.y {
        return None;
    }
    let point = point.unwrap_or(room.center());
    let left = if point.x > room.center().x { point.x - INSET.x - 90.0 } else { point.x + 90.0 };
    let inner = room.shrink2(vec2(8.0, 44.0));
    let x = left.clamp(inner.left(), (inner.right() - INSET.x).max(inner.left()));
    let y = (point.y - 0.5 * INSET.y).clamp(inner.top(), (inner.bottom() - INSET.y).max(inner.top()));
    Some(Rect::from_min_size(pos2(x, y), INSET))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inset_stays_in_its_pane_beside_the_point() {
        let room = Rect::from_min_size(pos2(10.0, 20.0), vec2(420.0, 500.0));
        for x in [10.0, 200.0, 260.0, 429.0] {
            for y in [20.0, 270.0, 519.0] {
                let rect = inset_place(room, Some(pos2(x, y)));
                assert!(rect.is_some_and(|rect| room.contains_rect(rect)), "{x} {y}");
            }
        }
        let beside = inset_place(room, Some(pos2(200.0, 270.0)));
        assert!(beside.is_some_and(|rect| !rect.contains(pos2(200.0, 270.0))));
        assert_eq!(inset_place(Rect::from_min_size(Pos2::ZERO, vec2(200.0, 500.0)), None), None);
    }
}
