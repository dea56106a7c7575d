//! The eye and its matrices.

mod matrices;

use crate::action::Action;
use crate::document::Document;
use crate::session::Session;
use crate::widgets::{Number, Vector, heading, row};
use egui::Ui;
use glam::DVec3;
use gonio_light::vector::unit;
use gonio_scene::Camera;
use gonio_scene::defaults;
use gonio_scene::settings::{Aim, CameraSettings};

/// The closest that pitch comes to straight up or down, degrees.
const STEEPEST: f64 = 89.0;

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    let _ = actions;
    let Some(loaded) = &session.loaded else { return };
    let before = document.scene.camera.clone();
    let spec = &mut document.scene.camera;
    place(ui, spec);
    lens(ui, spec);
    if spec.position != before.position || spec.aim != before.aim {
        // Near and far planes for the new position, so that nothing is clipped.
        let moved = loaded.with_planes(spec.clone());
        (spec.near, spec.far) = (moved.near, moved.far);
    }
    if !is_possible(spec) {
        document.scene.camera = before;
    }
    let [width, height] = session.facts.size.map(f64::from);
    let aspect = if width > 0.0 && height > 0.0 { width / height } else { 1.0 };
    matrices::show(ui, &document.scene.camera.to_camera(), aspect);
}

fn place(ui: &mut Ui, spec: &mut CameraSettings) {
    heading(ui, "Place");
    let tip = "Camera position in world space";
    row(ui, "Position", tip, |ui| Vector::new("camera-position", "position").tip(tip).show(ui, &mut spec.position));
    let camera = spec.to_camera();
    let (mut yaw, mut pitch) = camera.yaw_pitch_deg();
    // A camera that looks along angles gets the point ahead of it.
    let ahead = (camera.position + camera.front).to_array();
    let mut target = spec.target().unwrap_or(ahead);
    let tip = "The point that the camera looks at, in world space";
    if row(ui, "Target", tip, |ui| Vector::new("camera-target", "target").tip(tip).show(ui, &mut target)) {
        spec.aim = Aim::Target(target);
    }
    let before = (yaw, pitch);
    for (id, label, tip, value, range, default) in [
        (
            "camera-yaw",
            "Yaw",
            "Yaw of the viewing direction; -90\u{b0} looks along -Z",
            &mut yaw,
            -360.0..=360.0,
            defaults::YAW,
        ),
        ("camera-pitch", "Pitch", "Pitch; positive looks up", &mut pitch, -STEEPEST..=STEEPEST, defaults::PITCH),
    ] {
        row(ui, label, tip, |ui| {
            let number = Number::new(id, label).tip(tip).unit("\u{b0}").range(range).default(default).step(0.5);
            number.show(ui, value);
        });
    }
    if (yaw, pitch) != before {
        turn(spec, &camera, target.into(), yaw, pitch);
    }
    let tip = "WorldUp: the up direction, made perpendicular to the viewing direction";
    row(ui, "Up", tip, |ui| {
        Vector::new("camera-up", "up").tip(tip).default(defaults::UP).step(0.01).show(ui, &mut spec.up)
    });
}

/// Turns the camera in place, with its target at the same distance.
fn turn(spec: &mut CameraSettings, camera: &Camera, target: DVec3, yaw: f64, pitch: f64) {
    let distance = camera.position.distance(target);
    let direction = Camera::direction_of(yaw, pitch);
    let target = camera.position + direction * if distance > 0.0 { distance } else { 1.0 };
    spec.aim = Aim::Target(target.to_array());
}

fn lens(ui: &mut Ui, spec: &mut CameraSettings) {
    heading(ui, "Lens");
    row(ui, "Field of view", "Full vertical angle", |ui| {
        let tip = "Full vertical field of view; the lab's 45 rad are 58.3\u{b0}";
        Number::new("camera-fov", "field of view")
            .tip(tip)
            .unit("\u{b0}")
            .range(1.0..=170.0)
            .default(defaults::FOV_Y)
            .show(ui, &mut spec.fov_y);
    });
    let (mut near, mut far) = (spec.near, spec.far);
    let before = (near, far);
    for (id, label, tip, value) in [
        ("camera-near", "Near", "Distance of the near plane, in world units", &mut near),
        ("camera-far", "Far", "Distance of the far plane, in world units", &mut far),
    ] {
        row(ui, label, tip, |ui| {
            Number::new(id, label).tip(tip).range(1e-6..=1e9).show(ui, value);
        });
    }
    if (near, far) != before && near < far {
        (spec.near, spec.far) = (near, far);
    }
}

/// Whether there is such a camera: it looks somewhere, and up is a direction.
fn is_possible(spec: &CameraSettings) -> bool {
    let looks = spec.target().is_none_or(|target| unit(DVec3::from(target) - DVec3::from(spec.position)).is_some());
    looks && unit(spec.up.into()).is_some()
}
