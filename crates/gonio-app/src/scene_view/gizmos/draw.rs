//! Drawing of the light gizmos: a bulb, a sun with its arrow, a lamp with its cone.

use super::Mark;
use crate::scene_view::{Projection, paint};
use egui::{Color32, Painter, Pos2, Shape, Stroke, Vec2};
use glam::{DQuat, DVec3};
use gonio_light::LightKind;
use gonio_light::vector::{any_orthonormal_vector, unit};
use gonio_scene::frame::position_at;
use gonio_scene::settings::LightSettings;
use gonio_scene::{LightShape, Scene};

/// Radius of a light's disc, points.
pub const RADIUS: f32 = 7.0;
/// Length of the arrows of directional and spot lights, points.
const ARROW: f64 = 46.0;
/// Number of corners of a circle.
const CORNERS: usize = 64;
/// Narrowest and widest half angle of a spot's icon, radians.
const BEAM: (f32, f32) = (0.16, 1.0);

/// Draws one light.
pub fn light(painter: &Painter, projection: &Projection, mark: &Mark, emphasised: bool) {
    let Some(place) = mark.place else { return };
    match mark.kind {
        LightKind::Ambient => {}
        LightKind::Point { .. } => rays(painter, place, mark),
        LightKind::Directional { direction } => {
            if let Some(way) = way_on_screen(projection, mark.anchor, direction) {
                paint::arrow(painter, place + way.normalized() * (RADIUS + 3.0), place + way, 2.5, mark.color);
            }
        }
        LightKind::Spot { axis, outer_rad, .. } => beam(painter, projection, mark, place, axis, outer_rad as f32),
    }
    let radius = if emphasised { RADIUS + 1.0 } else { RADIUS };
    paint::disc(painter, place, radius, mark.color, mark.off);
}

/// The outline of a lamp that is a sphere or a rectangle.
pub fn shape(painter: &Painter, projection: &Projection, mark: &Mark) {
    let outline = match mark.shape {
        LightShape::Point => return,
        LightShape::Sphere { radius } => {
            let towards_eye = projection.camera().position - mark.anchor;
            let Some(axis) = unit(towards_eye) else { return };
            circle(projection, mark.anchor, axis, radius)
        }
        LightShape::Rectangle { half_right, half_up } => {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
                .map(|(x, y)| projection.to_window(mark.anchor + x * half_right + y * half_up))
                .to_vec()
        }
    };
    paint::curve(painter, &outline, 1.5, mark.color);
}

/// A mark at the picture's edge for a light outside of it, which points to the light.
pub fn off_screen(painter: &Painter, rect: egui::Rect, place: Pos2, mark: &Mark) {
    let way = (place - rect.center()).normalized();
    let side = way.rot90();
    let tip = place + way * 14.0;
    let triangle = vec![tip, tip - way * 7.0 + side * 5.0, tip - way * 7.0 - side * 5.0];
    painter.add(Shape::convex_polygon(triangle, mark.color, Stroke::new(1.0, Color32::from_black_alpha(150))));
    paint::disc(painter, place, 0.75 * RADIUS, mark.color, mark.off);
}

/// A ring around the selected light.
pub fn selected(painter: &Painter, place: Pos2, color: Color32) {
    painter.circle_stroke(place, RADIUS + 6.0, Stroke::new(3.5, Color32::from_black_alpha(120)));
    painter.circle_stroke(place, RADIUS + 6.0, Stroke::new(2.0, color));
}

/// Screen vector of an arrow of fixed length along the world direction `direction`.
fn way_on_screen(projection: &Projection, anchor: DVec3, direction: DVec3) -> Option<Vec2> {
    let end = anchor + direction * (ARROW * projection.units_per_point(anchor));
    let way = projection.to_window(end)? - projection.to_window(anchor)?;
    (way.length() > 1.0).then_some(way)
}

/// Short rays in all directions, for a point light.
fn rays(painter: &Painter, place: Pos2, mark: &Mark) {
    for i in 0..8 {
        let ahead = Vec2::angled(i as f32 * std::f32::consts::TAU / 8.0);
        let (from, to) = (place + ahead * (RADIUS + 4.0), place + ahead * (RADIUS + 8.5));
        if mark.off {
            paint::line(painter, [from, to], 1.0, Color32::from_gray(140));
        } else {
            paint::line(painter, [from, to], 2.0, mark.color);
        }
    }
}

/// A wedge in the direction of the axis.
fn beam(painter: &Painter, projection: &Projection, mark: &Mark, place: Pos2, axis: DVec3, outer_rad: f32) {
    let Some(way) = way_on_screen(projection, mark.anchor, axis) else { return };
    let half = outer_rad.clamp(BEAM.0, BEAM.1);
    let fan: Vec<Pos2> =
        std::iter::once(place).chain((-4..=4).map(|i| place + rotated(way, half * i as f32 / 4.0))).collect();
    let fill = if mark.off { Color32::TRANSPARENT } else { mark.color.gamma_multiply(0.45) };
    painter.add(Shape::convex_polygon(fan.clone(), fill, Stroke::new(3.5, Color32::from_black_alpha(130))));
    painter.add(Shape::closed_line(fan, Stroke::new(1.5, mark.color)));
}

fn rotated(v: Vec2, angle: f32) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// A circle of `radius` around `center` in the plane perpendicular to `axis`, in the window.
pub fn circle(projection: &Projection, center: DVec3, axis: DVec3, radius: f64) -> Vec<Option<Pos2>> {
    let u = any_orthonormal_vector(axis);
    let v = axis.cross(u);
    (0..=CORNERS)
        .map(|i| {
            let (sin, cos) = (i as f64 / CORNERS as f64 * std::f64::consts::TAU).sin_cos();
            projection.to_window(center + radius * (cos * u + sin * v))
        })
        .collect()
}

/// A spot's cone up to `end`: its inner and outer circle, and lines from the light.
pub fn cone(painter: &Painter, projection: &Projection, mark: &Mark, end: DVec3, angles: (f64, f64)) {
    let reach = end - mark.anchor;
    let (length, axis) = (reach.length(), reach.normalize_or(DVec3::NEG_Y));
    let (inner, outer) = angles;
    let thin = mark.color.gamma_multiply(0.8);
    paint::curve(painter, &circle(projection, end, axis, length * outer.tan()), 1.5, mark.color);
    if inner > 0.0 {
        paint::curve(painter, &circle(projection, end, axis, length * inner.tan()), 1.0, thin);
    }
    let side = any_orthonormal_vector(axis) * (length * outer.tan());
    for quarter in 0..4 {
        let turned = DQuat::from_axis_angle(axis, f64::from(quarter) * std::f64::consts::FRAC_PI_2) * side;
        if let (Some(from), Some(to)) = (projection.to_window(mark.anchor), projection.to_window(end + turned)) {
            paint::line(painter, [from, to], 1.0, thin);
        }
    }
}

/// The path of a moving light in one period.
pub fn path(painter: &Painter, projection: &Projection, spec: &LightSettings, color: Color32) {
    let Some(motion) = &spec.motion else { return };
    let position = DVec3::from(spec.position.unwrap_or_default());
    let points: Vec<Option<Pos2>> = (0..=96)
        .map(|i| projection.to_window(position_at(motion, position, motion.period * f64::from(i) / 96.0)))
        .collect();
    paint::curve(painter, &points, 1.0, color.gamma_multiply(0.75));
}

/// The box of an object, as twelve edges.
pub fn object_box(painter: &Painter, projection: &Projection, loaded: &Scene, object: usize, color: Color32) {
    let Some((mesh, matrix)) =
        loaded.objects.get(object).and_then(|object| Some((loaded.meshes.get(object.mesh)?, object.world_from_model)))
    else {
        return;
    };
    let Some(bounds) = mesh.bounds() else { return };
    let corner = |i: usize| {
        let pick = |axis: usize| f64::from(if (i >> axis) & 1 == 1 { bounds.max[axis] } else { bounds.min[axis] });
        projection.to_window(matrix.transform_point3(DVec3::new(pick(0), pick(1), pick(2))))
    };
    for i in 0..8_usize {
        for axis in (0..3).filter(|axis| (i >> axis) & 1 == 0) {
            if let (Some(from), Some(to)) = (corner(i), corner(i | (1 << axis))) {
                paint::line(painter, [from, to], 1.2, color);
            }
        }
    }
}
