//! Orbit, pan, zoom and fly.
//!
//! | input | effect |
//! |---|---|
//! | drag | orbits around the target |
//! | drag with Shift or the middle button, two fingers | pans |
//! | drag with the right button | looks around, as in the lab's first exercise |
//! | wheel, pinch | zooms towards the pointer |
//! | w a s d, z q s d, arrows | flies |

use super::Projection;
use crate::document::Document;
use crate::session::Session;
use egui::{Event, InputState, Key, PointerButton, Response, Ui, Vec2};
use glam::{DQuat, DVec3};
use gonio_light::vector::unit;
use gonio_scene::Camera;
use gonio_scene::settings::{Aim, CameraSettings};

/// Rotation by a drag of one point, degrees.
const DEGREES_PER_POINT: f64 = 0.4;
/// Smallest angle between the viewing direction and the vertical, radians.
const FROM_THE_POLE: f64 = 0.02;
/// Time in which flying crosses the scene's box, seconds.
const SECONDS_THROUGH: f64 = 3.0;

/// A moving camera: the eye, and the point that it orbits.
#[derive(Clone, Copy, Debug)]
pub struct Rig {
    camera: Camera,
    pivot: DVec3,
    world_up: DVec3,
}

impl Rig {
    /// Creates the rig of a camera. `middle` is the pivot of a camera without target.
    pub fn new(spec: &CameraSettings, middle: DVec3) -> Self {
        let camera = spec.to_camera();
        let depth = camera.depth_of(middle);
        let ahead = camera.position + camera.front * if depth > 0.0 { depth } else { 1.0 };
        let pivot = spec.target().map_or(ahead, DVec3::from);
        let world_up = unit(spec.up.into()).unwrap_or(DVec3::Y);
        Rig { camera, pivot, world_up }
    }

    /// Writes the camera back. Yaw and pitch are replaced by a target.
    pub fn write(&self, spec: &mut CameraSettings) {
        spec.position = self.camera.position.to_array();
        spec.aim = Aim::Target(self.pivot.to_array());
    }

    fn distance(&self) -> f64 {
        self.camera.position.distance(self.pivot).max(1e-9)
    }

    /// Rotates a direction about the world's up axis (yaw) and towards it (pitch), but not beyond the pole.
    fn turned(&self, direction: DVec3, yaw_rad: f64, pitch_rad: f64) -> DVec3 {
        let from_up = direction.angle_between(self.world_up);
        let requested = (from_up - pitch_rad).clamp(FROM_THE_POLE, std::f64::consts::PI - FROM_THE_POLE);
        let tilt = DQuat::from_axis_angle(self.camera.right, from_up - requested);
        DQuat::from_axis_angle(self.world_up, yaw_rad) * (tilt * direction)
    }

    fn look(&mut self, direction: DVec3) {
        let c = self.camera;
        self.camera = Camera::looking_along(c.position, direction, self.world_up, c.fov_y_rad, c.near, c.far);
    }

    /// Orbits around the pivot. Positive yaw moves the eye to the right, positive pitch upwards.
    pub fn orbit(&mut self, yaw_rad: f64, pitch_rad: f64) {
        let distance = self.distance();
        // A rising eye looks farther down.
        let front = self.turned(self.camera.front, yaw_rad, -pitch_rad);
        self.look(front);
        self.camera.position = self.pivot - front * distance;
    }

    /// Orbits around the pivot so that the eye looks along `direction` (unit); slightly tilted from above or below, to keep the up
    /// direction.
    pub fn look_along(&mut self, direction: DVec3) {
        let distance = self.distance();
        let upright = direction.dot(self.world_up);
        let level = unit(self.camera.front - self.world_up * self.camera.front.dot(self.world_up));
        let front = match level {
            Some(level) if upright.abs() > FROM_THE_POLE.cos() => {
                self.world_up * (upright.signum() * FROM_THE_POLE.cos()) + level * FROM_THE_POLE.sin()
            }
            _ => direction,
        };
        self.look(front);
        self.camera.position = self.pivot - self.camera.front * distance;
    }

    /// The pivot, world space.
    pub fn pivot(&self) -> DVec3 {
        self.pivot
    }

    /// Turns the camera in place.
    pub fn look_around(&mut self, yaw_rad: f64, pitch_rad: f64) {
        let distance = self.distance();
        let front = self.turned(self.camera.front, yaw_rad, pitch_rad);
        self.look(front);
        self.pivot = self.camera.position + front * distance;
    }

    /// Moves eye and pivot by world units to the right, up and ahead.
    pub fn shift(&mut self, right: f64, up: f64, ahead: f64) {
        let way = self.camera.right * right + self.camera.up * up + self.camera.front * ahead;
        self.camera.position += way;
        self.pivot += way;
    }

    /// Moves nearer by a factor below 1, away by one above 1. The point seen along `direction` (unit) stays in its place.
    pub fn zoom(&mut self, factor: f64, direction: DVec3) {
        let distance = self.distance();
        let depth = direction.dot(self.camera.front).max(1e-3);
        // The point under the pointer on the plane of the pivot.
        let toward = self.camera.position + direction * (distance / depth);
        self.camera.position = toward + (self.camera.position - toward) * factor;
        self.pivot = toward + (self.pivot - toward) * factor;
    }
}

/// Moves the document's camera by the pointer over a pane and by keys.
pub fn handle(ui: &Ui, response: &Response, document: &mut Document, session: &Session) {
    let Some(loaded) = &session.loaded else { return };
    let (min, max) = loaded.bounds();
    let mut rig = Rig::new(&document.scene.camera, 0.5 * (min + max));
    let projection = Projection::new(&rig.camera, response.rect);
    let mut moved = drag(ui, response, &mut rig, &projection);
    moved |= wheel(ui, response, &mut rig, &projection);
    moved |= fly(ui, response, &mut rig, (max - min).length());
    if moved {
        rig.write(&mut document.scene.camera);
        document.scene.camera = loaded.with_planes(document.scene.camera.clone());
    }
}

/// Moves a camera outside of the document by the pointer over a picture and by keys. It orbits around its target or else `middle`,
/// or turns in place (`looks_around`), and flies at a speed for a scene of size `extent`. Returns whether it moved.
pub fn steer(
    ui: &Ui,
    response: &Response,
    camera: &mut CameraSettings,
    middle: DVec3,
    extent: f64,
    looks_around: bool,
) -> bool {
    let mut rig = Rig::new(camera, middle);
    let projection = Projection::new(&rig.camera, response.rect);
    let mut moved = false;
    if looks_around && response.is_dragged_by(PointerButton::Primary) {
        let (way, angle) = (response.way(), DEGREES_PER_POINT.to_radians());
        rig.look_around(-f64::from(way.x) * 0.5 * angle, -f64::from(way.y) * 0.5 * angle);
        moved = way != egui::Vec2::ZERO;
    } else {
        moved |= drag(ui, response, &mut rig, &projection);
        moved |= wheel(ui, response, &mut rig, &projection);
    }
    moved |= fly(ui, response, &mut rig, extent);
    if moved {
        rig.write(camera);
    }
    moved
}

/// Makes the document's camera look at its target along a direction (unit, world space).
pub fn look_along(document: &mut Document, session: &Session, direction: DVec3) {
    let Some(loaded) = &session.loaded else { return };
    let (min, max) = loaded.bounds();
    let mut rig = Rig::new(&document.scene.camera, 0.5 * (min + max));
    rig.look_along(direction);
    rig.write(&mut document.scene.camera);
    document.scene.camera = loaded.with_planes(document.scene.camera.clone());
}

fn drag(ui: &Ui, response: &Response, rig: &mut Rig, projection: &Projection) -> bool {
    let way = response.way();
    // Two fingers pan and zoom, but do not rotate.
    if way == egui::Vec2::ZERO || ui.input(|i| i.multi_touch()).is_some() {
        return false;
    }
    let (x, y) = (f64::from(way.x), f64::from(way.y));
    let angle = DEGREES_PER_POINT.to_radians();
    let shift = ui.input(|i| i.modifiers.shift);
    if response.is_dragged_by(PointerButton::Middle) || (shift && response.is_dragged_by(PointerButton::Primary)) {
        let unit = projection.units_per_point(rig.pivot);
        rig.shift(-x * unit, y * unit, 0.0);
    } else if response.is_dragged_by(PointerButton::Secondary) {
        rig.look_around(-x * 0.5 * angle, -y * 0.5 * angle);
    } else if response.is_dragged_by(PointerButton::Primary) {
        rig.orbit(-x * angle, y * angle);
    }
    true
}

fn wheel(ui: &Ui, response: &Response, rig: &mut Rig, projection: &Projection) -> bool {
    let center = ui.input(|i| i.multi_touch()).map(|touch| touch.center_pos).filter(|&p| response.rect.contains(p));
    let Some(place) = response.hover_pos().or(center) else { return false };
    let (scroll, pinch, touch) =
        ui.input(|i| (f64::from(i.smooth_scroll_delta().y), f64::from(i.zoom_delta()), i.multi_touch()));
    let mut moved = false;
    if let Some(touch) = touch {
        let unit = projection.units_per_point(rig.pivot);
        let way = touch.translation_delta;
        rig.shift(-f64::from(way.x) * unit, f64::from(way.y) * unit, 0.0);
        moved = way != egui::Vec2::ZERO;
    }
    let factor = (-0.003 * scroll).exp() / pinch.max(0.01);
    if factor != 1.0 && factor.is_finite() {
        rig.zoom(factor.clamp(0.2, 5.0), projection.direction(place));
        moved = true;
    }
    moved
}

fn fly(ui: &Ui, response: &Response, rig: &mut Rig, extent: f64) -> bool {
    // Keys go to a focused text field.
    if ui.ctx().memory(|m| m.focused().is_some()) || !response.contains_pointer() {
        return false;
    }
    let spent = spent_keys(ui);
    let (ways, seconds, fast) = ui.input(|i| {
        let is_down = |key| (i.key_down(key) && !spent.contains(&key)) || tapped(i, key);
        let down = |keys: &[Key]| if keys.iter().any(|&key| is_down(key)) { 1.0 } else { 0.0 };
        if i.modifiers.command || i.modifiers.alt {
            return ([0.0; 3], 0.0, false);
        }
        let right = down(&[Key::D, Key::ArrowRight]) - down(&[Key::A, Key::Q, Key::ArrowLeft]);
        let ahead = down(&[Key::W, Key::Z, Key::ArrowUp]) - down(&[Key::S, Key::ArrowDown]);
        let up = down(&[Key::E, Key::PageUp]) - down(&[Key::C, Key::PageDown]);
        ([right, up, ahead], f64::from(i.stable_dt).min(0.1), i.modifiers.shift)
    });
    if ways == [0.0; 3] {
        return false;
    }
    let pace = extent.max(1e-6) / SECONDS_THROUGH * seconds * if fast { 3.0 } else { 1.0 };
    rig.shift(ways[0] * pace, ways[1] * pace, ways[2] * pace);
    ui.ctx().request_repaint();
    true
}

/// Whether a key was pressed without modifiers in this frame. It may be released already on a slow machine.
fn tapped(input: &InputState, requested: Key) -> bool {
    input.events.iter().any(|event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => *key == requested && !modifiers.any(),
        _ => false,
    })
}

fn combinations() -> egui::Id {
    egui::Id::unique("gonio: keys of combinations")
}

/// Records keys that were pressed with Ctrl and are still held, so that Ctrl + Z does not fly if Ctrl is released first. Called
/// before combinations are removed from the frame's events.
pub fn note_combinations(ui: &Ui) {
    let mut spent = spent_keys(ui);
    ui.input(|i| {
        for event in &i.events {
            if let egui::Event::Key { key, pressed, modifiers, .. } = event {
                spent.retain(|known| known != key);
                if *pressed && modifiers.command {
                    spent.push(*key);
                }
            }
        }
        spent.retain(|key| i.key_down(*key));
    });
    ui.data_mut(|data| data.insert_temp(combinations(), spent));
}

fn spent_keys(ui: &Ui) -> Vec<Key> {
    ui.data(|data| data.get_temp(combinations())).unwrap_or_default()
}

/// Drags that include the frame of the release.
///
/// egui does not count that frame. In slow frames it contains the last movement of the pointer, and the drag would end too early.
pub trait Dragging {
    /// Whether it is dragged, or was just released.
    fn is_dragged(&self) -> bool;
    /// The same for one button.
    fn is_dragged_by(&self, button: PointerButton) -> bool;
    /// Movement since the last frame, points.
    fn way(&self) -> Vec2;
}

impl Dragging for Response {
    fn is_dragged(&self) -> bool {
        self.dragged() || self.drag_stopped()
    }

    fn is_dragged_by(&self, button: PointerButton) -> bool {
        self.dragged_by(button) || self.drag_stopped_by(button)
    }

    fn way(&self) -> Vec2 {
        if self.drag_stopped() { self.ctx.input(|i| i.pointer.delta()) } else { self.drag_delta() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rig() -> Rig {
        let spec = CameraSettings {
            position: [4.0, 3.0, 8.0],
            aim: Aim::Target([0.5, 0.0, -0.5]),
            ..CameraSettings::default()
        };
        Rig::new(&spec, DVec3::ZERO)
    }

    #[test]
    fn an_orbit_keeps_distance_and_aim() {
        let before = rig();
        let mut after = before;
        after.orbit(0.7, -0.4);
        assert!((after.distance() - before.distance()).abs() < 1e-9);
        let aim = (after.pivot - after.camera.position).normalize();
        assert!((aim - after.camera.front).length() < 1e-9);
        assert!(after.camera.position.distance(before.camera.position) > 1.0);
    }

    #[test]
    fn looking_along_an_axis_keeps_the_target() {
        for axis in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
            let before = rig();
            let mut after = before;
            after.look_along(axis);
            assert!(after.camera.front.angle_between(axis) < FROM_THE_POLE + 1e-9, "{axis}: {}", after.camera.front);
            assert!((after.distance() - before.distance()).abs() < 1e-9);
            let aim = (after.pivot - after.camera.position).normalize();
            assert!((aim - after.camera.front).length() < 1e-9);
            // The world's up direction points up in the picture.
            assert!(after.camera.up.dot(DVec3::Y) > 0.0, "{axis}: {}", after.camera.up);
        }
    }

    #[test]
    fn an_orbit_stops_at_the_pole() {
        let mut up = rig();
        for _ in 0..100 {
            up.orbit(0.0, 0.3);
        }
        assert!(up.camera.front.y < 0.0 && up.camera.front.y > -1.0, "{}", up.camera.front);
        assert!(up.camera.right.is_finite() && up.camera.right.length() > 0.99);
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let mut rig = rig();
        let direction = (rig.camera.front + 0.2 * rig.camera.right + 0.1 * rig.camera.up).normalize();
        let distance = rig.distance() / direction.dot(rig.camera.front);
        let point = rig.camera.position + direction * distance;
        rig.zoom(0.5, direction);
        let now = (point - rig.camera.position).normalize();
        assert!((now - direction).length() < 1e-9);
        assert!((point.distance(rig.camera.position) - 0.5 * distance).abs() < 1e-9);
    }

    #[test]
    fn a_camera_with_angles_gets_a_target() {
        let mut spec = CameraSettings { position: [0.0, 0.0, 5.0], ..CameraSettings::default() };
        let before = spec.to_camera();
        Rig::new(&spec, DVec3::ZERO).write(&mut spec);
        let after = spec.to_camera();
        assert!((before.front - after.front).length() < 1e-9);
        assert_eq!(spec.target().map(DVec3::from).map(|t| t.length() < 1e-9), Some(true));
    }
}
