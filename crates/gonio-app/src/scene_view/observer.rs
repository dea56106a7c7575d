//! The observer's view: the scene from a second camera, with frustum, axes and position of the first.

use super::navigation::Dragging;
use super::paint::{picture_size, present};
use super::{Projection, paint};
use crate::exported::{self, WidgetRole};
use crate::scene_view::drawing::PaneRenderer;
use crate::session::Observer;
use crate::theme::{self, colors, icons};
use egui::{Align2, Color32, Painter, Pos2, Rect, RichText, Sense, Stroke, StrokeKind, Ui, pos2, vec2};
use glam::DVec3;
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_scene::{Camera, Frame};

/// Field of view of the observer, radians.
const FOV_Y: f64 = 0.6;
/// Initial azimuth relative to the first camera, and elevation, radians.
const BESIDE: f64 = 1.15;
const ABOVE: f64 = 0.42;
/// Largest elevation, radians.
const HIGHEST: f64 = 1.5;
/// Rotation by a drag of one point, and per second when it rotates automatically, radians.
const PER_POINT: f64 = 0.01;
const PER_SECOND: f64 = 0.35;
/// The far plane is shown at most at this multiple of the scene's extent.
const FARTHEST: f64 = 3.0;

/// The observer's camera for a frame of the first one.
fn observer_camera(observer: &mut Observer, frame: &Frame, aspect: f64) -> Camera {
    let first = &frame.camera;
    let (yaw, pitch) = *observer.angles.get_or_insert_with(|| {
        let back = -first.front;
        (back.x.atan2(back.z) + BESIDE, ABOVE)
    });
    let back = DVec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    let corners = frustum(frame);
    let points: Vec<DVec3> =
        corners.iter().flatten().copied().chain([first.position, frame.bounds_min, frame.bounds_max]).collect();
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let middle = 0.5 * (low + high);
    let radius = points.iter().map(|p| p.distance(middle)).fold(1e-9, f64::max);
    let narrower = (0.5 * FOV_Y).tan() * aspect.min(1.0);
    let distance = 1.04 * radius / narrower.atan().sin();
    let near = (distance - 1.1 * radius).max(1e-3 * distance);
    Camera::looking_along(middle + back * distance, -back, DVec3::Y, FOV_Y, near, distance + 1.5 * radius)
}

/// Corners of the near and of the far plane: lower left, lower right, upper right, upper left.
fn frustum(frame: &Frame) -> [[DVec3; 4]; 2] {
    let camera = &frame.camera;
    let aspect = f64::from(frame.width.max(1)) / f64::from(frame.height.max(1));
    let middle = 0.5 * (frame.bounds_min + frame.bounds_max);
    let extent = (frame.bounds_max - frame.bounds_min).length() + middle.distance(camera.position);
    let far = camera.far.min((FARTHEST * extent).max(2.0 * camera.near));
    [camera.near, far].map(|depth| {
        let up = depth * (0.5 * camera.fov_y_rad).tan();
        let right = up * aspect;
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| camera.position + depth * camera.front + x * right * camera.right + y * up * camera.up)
    })
}

/// The rectangle of the inset in a pane; `None` if there is no room.
pub fn place(pane: Rect) -> Option<Rect> {
    let width = (0.34 * pane.width()).clamp(170.0, 340.0);
    let size = vec2(width, 0.78 * width);
    let rect = Rect::from_min_size(pane.right_bottom() - size - vec2(12.0, 12.0), size);
    pane.shrink(8.0).contains_rect(rect).then_some(rect)
}

/// Shows the inset over the pane whose frame this is.
pub fn show(
    ui: &mut Ui,
    pane: usize,
    rect: Rect,
    frame: &Frame,
    observer: &mut Observer,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    let what = tr!("scene-the-camera-and-its-frustum-from");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, what));
    exported::note(ui, &response, "observer-view", WidgetRole::Picture, what, "");
    let aspect = f64::from(rect.width() / rect.height());
    let _ = observer_camera(observer, frame, aspect);
    if let Some((yaw, pitch)) = &mut observer.angles {
        let way = response.way();
        *yaw -= f64::from(way.x) * PER_POINT;
        *pitch = (*pitch + f64::from(way.y) * PER_POINT).clamp(-HIGHEST, HIGHEST);
        if observer.turning && !response.dragged() {
            *yaw += PER_SECOND * ui.input(|i| f64::from(i.stable_dt)).min(0.1);
            ui.ctx().request_repaint();
        }
    }
    let camera = observer_camera(observer, frame, aspect);
    let size = picture_size(rect, ui.ctx().pixels_per_point()).map(|side| side.max(1));
    if let Some(picture) = pane_renderer.seen_by(pane, camera, size)? {
        present(ui, rect, picture);
    }
    let painter = ui.painter_at(rect);
    draw(&painter, &Projection::new(&camera, rect), frame);
    ui.painter().rect_stroke(rect, 3.0, Stroke::new(1.0, Color32::from_gray(130)), StrokeKind::Outside);
    buttons(ui, rect, observer);
    Ok(())
}

fn draw(painter: &Painter, projection: &Projection, frame: &Frame) {
    let camera = &frame.camera;
    let edge = Color32::from_gray(235);
    let planes = frustum(frame);
    let seen = |p: DVec3| projection.to_window(p);
    let line = |a: DVec3, b: DVec3, width: f32, color: Color32| {
        if let (Some(a), Some(b)) = (seen(a), seen(b)) {
            paint::line(painter, [a, b], width, color);
        }
    };
    for far in planes[1] {
        line(camera.position, far, 1.0, edge);
    }
    for plane in planes {
        let corners: Option<Vec<Pos2>> = plane.into_iter().map(seen).collect();
        if let Some(corners) = corners {
            painter.add(egui::Shape::convex_polygon(corners, edge.gamma_multiply(0.07), Stroke::NONE));
        }
        for i in 0..4 {
            line(plane[i], plane[(i + 1) % 4], 1.2, edge);
        }
    }
    let label = |at: DVec3, text: &str, color: Color32, align: Align2, font: egui::FontId| {
        if let Some(place) = seen(at) {
            // The colours are bright, so the plate is dark in both themes.
            let galley = painter.layout_no_wrap(text.to_owned(), font, color);
            let rect = align.anchor_size(place, galley.size() + vec2(6.0, 0.0));
            painter.rect_filled(rect, 3.0, Color32::from_black_alpha(130));
            painter.galley(rect.min + vec2(3.0, 0.0), galley, color);
        }
    };
    let small = || egui::FontId::proportional(11.0);
    label(planes[0][2], "near", edge, Align2::LEFT_BOTTOM, small());
    label(planes[1][2], "far", edge, Align2::RIGHT_BOTTOM, small());
    let length = 44.0 * projection.units_per_point(camera.position);
    for (axis, name, tint) in [
        (camera.front, "Front", colors::AXIS_Z),
        (camera.right, "Right", colors::AXIS_X),
        (camera.up, "Up", colors::AXIS_Y),
    ] {
        let (color, end) = (tint.in_theme(true), camera.position + length * axis);
        if let (Some(from), Some(to)) = (seen(camera.position), seen(end)) {
            paint::arrow(painter, from, to, 2.2, color);
            let align = if to.x < from.x { Align2::RIGHT_CENTER } else { Align2::LEFT_CENTER };
            label(end, name, color, align, small());
        }
    }
    if let Some(place) = seen(camera.position) {
        painter.circle(place, 4.0, Color32::WHITE, Stroke::new(1.5, Color32::BLACK));
    }
}

fn buttons(ui: &mut Ui, rect: Rect, observer: &mut Observer) {
    let size = vec2(28.0, 24.0);
    let places = [0.0, 1.0].map(|i| Rect::from_min_size(pos2(rect.right() - 32.0 - 31.0 * i, rect.top() + 4.0), size));
    let (close, turn) = (places[0], places[1]);
    let mut button = |place: Rect, id: &str, icon: &str, tip: &str, on: bool| {
        let text = RichText::new(icon).font(theme::icon_font(14.0)).color(Color32::from_gray(235));
        let fill = if on { Color32::from_gray(90) } else { Color32::from_black_alpha(130) };
        let response = ui.put(place, egui::Button::new(text).fill(fill));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, tip));
        exported::note(ui, &response, id, WidgetRole::Button, tip, on);
        response.on_hover_text(tip).clicked()
    };
    if button(close, "observer-close", icons::X, tr!("scene-close-o"), false) {
        observer.open = false;
    }
    let tip = tr!("scene-rotate-automatically");
    if button(turn, "observer-turn", icons::REPEAT, tip, observer.turning) {
        observer.turning = !observer.turning;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::files::Disk;
    use gonio_scene::load;
    use std::path::Path;

    /// The frustum and all objects are in the inset from every direction.
    #[test]
    fn it_shows_the_whole_frustum() {
        let described = load::describe(&["builtin:still-life"], &Disk).unwrap_or_else(|error| panic!("{error}"));
        let loaded = load::load(described, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"));
        let frame = loaded.frame(0.0);
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(300.0, 230.0));
        for yaw in [0.0, 0.9, 2.5, 4.4] {
            for pitch in [-1.2, 0.0, 0.5, 1.4] {
                let mut observer = Observer { open: true, turning: false, angles: Some((yaw, pitch)) };
                let camera = observer_camera(&mut observer, &frame, f64::from(rect.width() / rect.height()));
                let projection = Projection::new(&camera, rect);
                let eye = frame.camera.position;
                let points = frustum(&frame).into_iter().flatten().chain([eye, frame.bounds_min, frame.bounds_max]);
                for point in points {
                    let seen = projection.to_window(point).unwrap_or_else(|| panic!("{point} is behind the eye"));
                    assert!(rect.contains(seen), "{point} is seen at {seen} from {yaw}, {pitch}");
                    let depth = camera.depth_of(point);
                    assert!(camera.near < depth && depth < camera.far, "{point} is cut off from {yaw}, {pitch}");
                }
            }
        }
    }
}
