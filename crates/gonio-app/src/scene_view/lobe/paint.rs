//! Paints a lobe: on the surface as the eye sees it, and in an inset from the side.

use super::SurfaceLobe;
use crate::exported::{self, WidgetRole};
use crate::scene_view::{Projection, axes, paint};
use crate::theme::{self, colors};
use crate::widgets::compact;
use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::text::LayoutJob;
use egui::{
    Align, Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2,
};
use gonio_language::tr;
use gonio_light::DVec3;
use gonio_light::vector::{any_orthonormal_vector, unit_or};
use std::f64::consts::TAU;

/// Length of the largest value, as a share of the picture's height.
const LENGTH: f64 = 1.0 / 6.0;
/// Size of the inset in points.
const INSET: Vec2 = vec2(196.0, 172.0);
/// The smallest share of it that is drawn: letters and arrows still keep apart.
const LEAST_SCALE: f32 = 0.5;
/// Size of the letters at its arrows, points.
const LETTER: f32 = 14.0;
/// Free space along the left and right sides of a pane, and along the top and bottom, where its own labels are.
const FREE: Vec2 = vec2(8.0, 44.0);
/// Height of the pane's buttons that this leaves room for.
const FINE: f32 = 24.0;
/// Distance to the pinned point, whose arrows need room.
const BESIDE: f32 = 90.0;
/// Distances above or below it, in panes that have no room beside it: the least, and the one where there is room enough.
const ABOVE: [f32; 2] = [24.0, 72.0];
/// Distance from the axes cross, if the inset would cover that.
const GAP: f32 = 4.0;
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
    // The pane's own buttons are larger on a phone.
    let free = FREE + vec2(0.0, (theme::touch::least(ui) - FINE).max(0.0));
    let Some(rect) = inset_place(room, free, projection.to_window(lobe.point.position)) else { return };
    let scale = rect.width() / INSET.x;
    let painter = ui.painter_at(room);
    painter.rect_filled(rect, 7.0, Color32::from_black_alpha(190));
    painter.rect_stroke(rect, 7.0, Stroke::new(1.0, Color32::from_white_alpha(40)), StrokeKind::Inside);

    // V and N lie in the picture's plane.
    let n = lobe.point.normal;
    let right = unit_or(lobe.point.view - n * n.dot(lobe.point.view), any_orthonormal_vector(n));
    let away = n.cross(right);
    let to_viewer = RISE.sin() * n - RISE.cos() * away;
    let share = 100.0 * lobe.eye_share();
    let text = tr!("scene-towards-v-of-the-peak", value = compact(lobe.to_eye), share = format!("{share:.0}"));
    let ink = Color32::from_gray(235);
    let lines = |text: &str, size: f32, rows: usize, align: Align| {
        let mut job = LayoutJob::simple(text.to_owned(), FontId::proportional(size), ink, rect.width() - 14.0);
        job.wrap.max_rows = rows;
        job.halign = align;
        painter.layout_job(job)
    };
    let below = lines(&text, 11.0, 2, Align::Center);
    let above = lines(name, 11.5, 1, Align::Min);
    // The surface is seen from slightly above, so that a third of the radius stays free below its centre.
    let bottom = rect.bottom() - below.size().y - 8.0;
    let free = bottom - rect.top() - above.size().y - 9.0;
    let beyond = 3.0 + 7.0 * scale;
    // A small inset has no room beside its name: the letters stay below it.
    let below_name = if scale < 1.0 { (free - beyond - 0.5 * LETTER) / 1.32 } else { f32::INFINITY };
    let radius = (82.0 * scale).min(0.72 * free).min(below_name);
    let center = pos2(rect.center().x, bottom - 0.3 * radius);
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
        let place = tip + (tip - center).normalized() * beyond;
        painter.text(place, Align2::CENTER_CENTER, letter, theme::math_italic_font(LETTER), color);
    }
    let eye = place(lobe.point.view * lobe.eye_share()).0;
    painter.circle(eye, 4.0, colors::VIEW.in_theme(true), Stroke::new(1.5, Color32::WHITE));

    painter.galley(pos2(rect.center().x, bottom + 2.0), below, ink);
    painter.galley(rect.left_top() + vec2(9.0, 7.0), above, ink);
    let response = ui.interact(rect, ui.scope_id().with(("lobe", pane)), Sense::hover());
    exported::note(ui, &response, &format!("lobe-{pane}"), WidgetRole::Picture, &text, lobe.to_eye);
}

/// The place of the inset: beside the point or above or below it, where it is largest. `None` in a pane that is too small.
fn inset_place(room: Rect, free: Vec2, point: Option<Pos2>) -> Option<Rect> {
    let inner = room.shrink2(free);
    let most = (inner.width() / INSET.x).min(inner.height() / INSET.y).min(1.0);
    // NaN is not large enough either.
    if most.is_nan() || most < LEAST_SCALE {
        return None;
    }
    let point = point.unwrap_or(room.center());
    let widest_side = (point.x - inner.left()).max(inner.right() - point.x);
    let highest_side = (point.y - inner.top()).max(inner.bottom() - point.y);
    let beside = most.min((widest_side - BESIDE) / INSET.x);
    let above = most.min((highest_side - ABOVE[0]) / INSET.y);
    let is_beside = beside >= above;
    let size = INSET * beside.max(above).max(LEAST_SCALE);
    let low = if is_beside {
        let left = if point.x > room.center().x { point.x - size.x - BESIDE } else { point.x + BESIDE };
        pos2(left, point.y - 0.5 * size.y)
    } else {
        let is_above = point.y > room.center().y;
        let free = if is_above { point.y - inner.top() } else { inner.bottom() - point.y };
        let gap = (free - size.y).clamp(ABOVE[0], ABOVE[1]);
        let top = if is_above { point.y - size.y - gap } else { point.y + gap };
        pos2(point.x - 0.5 * size.x, top)
    };
    let most = (inner.right_bottom() - size).max(inner.left_top());
    let place = Rect::from_min_size(low.clamp(inner.left_top(), most), size);
    Some(beside_axes(place, room, inner))
}

/// The place moved right of the axes cross in the lower left corner, if it covers that and there is room.
fn beside_axes(place: Rect, room: Rect, inner: Rect) -> Rect {
    let cross = Rect::from_min_max(room.left_bottom() + vec2(0.0, -axes::extent(room)), room.left_bottom());
    let cross = cross.with_max_x(room.left() + axes::extent(room));
    let moved = place.translate(vec2(cross.right() + GAP - place.left(), 0.0));
    if place.intersects(cross) && moved.right() <= inner.right() { moved } else { place }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inset_stays_in_its_pane_beside_the_point() {
        let room = Rect::from_min_size(pos2(10.0, 20.0), vec2(420.0, 500.0));
        for x in [10.0, 200.0, 260.0, 429.0] {
            for y in [20.0, 270.0, 519.0] {
                let rect = inset_place(room, FREE, Some(pos2(x, y)));
                assert!(rect.is_some_and(|rect| room.contains_rect(rect)), "{x} {y}");
            }
        }
        let beside = inset_place(room, FREE, Some(pos2(200.0, 270.0)));
        assert!(beside.is_some_and(|rect| !rect.contains(pos2(200.0, 270.0))));
    }

    /// On a phone, below a point on the left.
    #[test]
    fn the_inset_leaves_the_axes_cross_free() {
        let room = Rect::from_min_size(pos2(0.0, 170.0), vec2(390.0, 371.0));
        for x in [40.0, 136.0, 195.0] {
            let rect = inset_place(room, FREE, Some(pos2(x, 318.0))).unwrap_or(Rect::NOTHING);
            let cross = Rect::from_min_max(pos2(0.0, 541.0 - axes::extent(room)), pos2(axes::extent(room), 541.0));
            assert!(!rect.intersects(cross) && room.contains_rect(rect), "{x}: {rect} over {cross}");
        }
    }

    /// Half of a phone, a third of a window, a flat pane: the inset is smaller and does not hide the point; below that there is none.
    #[test]
    fn narrow_panes_have_a_smaller_inset() {
        for (size, expected) in [
            (vec2(180.0, 600.0), 164.0),
            (vec2(299.0, 500.0), 196.0),
            (vec2(120.0, 400.0), 104.0),
            (vec2(600.0, 190.0), 196.0 * 102.0 / 172.0),
        ] {
            let room = Rect::from_min_size(pos2(5.0, 7.0), size);
            for share in [0.2, 0.5, 0.8] {
                let point = room.lerp_inside(vec2(0.5, share));
                let rect = inset_place(room, FREE, Some(point)).unwrap_or(Rect::NOTHING);
                assert!((rect.width() - expected).abs() < 0.5 && room.contains_rect(rect), "{size} {share}: {rect}");
                assert!(size.y < 200.0 || !rect.contains(point), "{size} {share}: {rect} hides {point}");
            }
        }
        // A phone held sideways.
        let room = Rect::from_min_size(pos2(0.0, 107.0), vec2(452.0, 248.0));
        let rect = inset_place(room, vec2(8.0, 60.0), Some(room.center())).unwrap_or(Rect::NOTHING);
        assert!(rect.width() > 100.0 && room.contains_rect(rect) && !rect.contains(room.center()), "{rect}");
        assert_eq!(inset_place(Rect::from_min_size(Pos2::ZERO, vec2(100.0, 500.0)), FREE, None), None);
        assert_eq!(inset_place(Rect::from_min_size(Pos2::ZERO, vec2(500.0, 150.0)), FREE, None), None);
    }
}
