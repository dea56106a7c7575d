//! The camera: position, lens, and its view and projection matrices, which students build in the lab's first exercise.

use crate::action::Action;
use crate::document::Document;
use crate::session::Session;
use crate::theme::colors;
use crate::widgets::{NumberField, Vector, heading, row};
use egui::{Color32, FontFamily, FontId, Grid, RichText, Ui};
use glam::{DMat4, DVec3};
use gonio_language::tr;
use gonio_light::vector::unit;
use gonio_scene::settings::{Aim, CameraSettings};
use gonio_scene::{Camera, defaults};

/// Largest pitch, degrees.
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
    matrices(ui, &document.scene.camera.to_camera(), aspect);
}

fn place(ui: &mut Ui, spec: &mut CameraSettings) {
    heading(ui, tr!("scene-place"));
    let tip = tr!("scene-camera-position-in-world-space");
    row(ui, tr!("scene-position"), tip, |ui| {
        Vector::new("camera-position", "position").tip(tip).show(ui, &mut spec.position)
    });
    let camera = spec.to_camera();
    let (mut yaw, mut pitch) = camera.yaw_pitch_deg();
    // A camera with yaw and pitch gets a target ahead of it.
    let ahead = (camera.position + camera.front).to_array();
    let mut target = spec.target().unwrap_or(ahead);
    let tip = tr!("scene-the-point-that-the-camera-looks");
    if row(ui, tr!("scene-target"), tip, |ui| Vector::new("camera-target", "target").tip(tip).show(ui, &mut target)) {
        spec.aim = Aim::Target(target);
    }
    let before = (yaw, pitch);
    for (id, label, tip, value, range, default) in [
        (
            "camera-yaw",
            tr!("scene-yaw"),
            tr!("scene-yaw-of-the-viewing-direction-90"),
            &mut yaw,
            -360.0..=360.0,
            defaults::YAW,
        ),
        (
            "camera-pitch",
            tr!("scene-pitch"),
            tr!("scene-pitch-positive-looks-up"),
            &mut pitch,
            -STEEPEST..=STEEPEST,
            defaults::PITCH,
        ),
    ] {
        row(ui, label, tip, |ui| {
            let number = NumberField::new(id, label).tip(tip).unit("\u{b0}").range(range).default(default).step(0.5);
            number.show(ui, value);
        });
    }
    if (yaw, pitch) != before {
        turn(spec, &camera, target.into(), yaw, pitch);
    }
    let tip = tr!("scene-worldup-the-up-direction-made-perpendicular");
    row(ui, tr!("scene-up"), tip, |ui| {
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
    heading(ui, tr!("scene-lens"));
    row(ui, tr!("scene-field-of-view-2"), tr!("scene-full-vertical-angle"), |ui| {
        let tip = tr!("scene-full-vertical-field-of-view-the");
        NumberField::new("camera-fov", tr!("scene-field-of-view"))
            .tip(tip)
            .unit("\u{b0}")
            .range(1.0..=170.0)
            .default(defaults::FOV_Y)
            .show(ui, &mut spec.fov_y);
    });
    let (mut near, mut far) = (spec.near, spec.far);
    let before = (near, far);
    for (id, label, tip, value) in [
        ("camera-near", tr!("scene-near"), tr!("scene-distance-of-the-near-plane-in"), &mut near),
        ("camera-far", tr!("scene-far"), tr!("scene-distance-of-the-far-plane-in"), &mut far),
    ] {
        row(ui, label, tip, |ui| {
            NumberField::new(id, label).tip(tip).range(1e-6..=1e9).show(ui, value);
        });
    }
    if (near, far) != before && near < far {
        (spec.near, spec.far) = (near, far);
    }
}

/// Whether the camera is valid: viewing direction and up vector have a length.
fn is_possible(spec: &CameraSettings) -> bool {
    let looks = spec.target().is_none_or(|target| unit(DVec3::from(target) - DVec3::from(spec.position)).is_some());
    looks && unit(spec.up.into()).is_some()
}

/// Labels of one matrix.
struct Table {
    id: &'static str,
    rows: [&'static str; 4],
    columns: [&'static str; 4],
    /// Tooltips with the definition of each entry, row by row.
    tips: [[&'static str; 4]; 4],
}

const VIEW: Table = Table {
    id: "view-matrix",
    rows: ["Right", "Up", "\u{2212}Front", ""],
    columns: ["x", "y", "z", "position"],
    tips: [
        ["Right.x", "Right.y", "Right.z", "\u{2212}Right \u{22c5} Position"],
        ["Up.x", "Up.y", "Up.z", "\u{2212}Up \u{22c5} Position"],
        ["\u{2212}Front.x", "\u{2212}Front.y", "\u{2212}Front.z", "Front \u{22c5} Position"],
        ["0", "0", "0", "scene-1-for-points"],
    ],
};

const PROJECTION: Table = Table {
    id: "projection-matrix",
    rows: ["x", "y", "z", "w"],
    columns: ["", "", "", ""],
    tips: [
        ["f / aspect, f = 1 / tan(fov / 2), aspect = width / height", "0", "0", "0"],
        ["0", "f = 1 / tan(fov / 2)", "0", "0"],
        ["0", "0", "(far + near) / (near \u{2212} far)", "2 far near / (near \u{2212} far)"],
        ["0", "0", "scene-1-w-becomes-the-depth-by", "0"],
    ],
};

/// Shows both matrices.
fn matrices(ui: &mut Ui, camera: &Camera, aspect: f64) {
    heading(ui, tr!("scene-view-matrix-v")).on_hover_text(tr!("scene-from-world-to-eye-space-the"));
    table(ui, &VIEW, camera.view_from_world(), row_tints(ui));
    let [front_x, front_y, front_z] = camera.front.to_array();
    let text = format!("Front = ({front_x:.3}, {front_y:.3}, {front_z:.3})");
    ui.label(RichText::new(text).font(digits()).color(colors::AXIS_Z.of(ui)));
    heading(ui, tr!("scene-projection-matrix-p")).on_hover_text(tr!("scene-from-eye-to-opengl-s-clip"));
    let weak = ui.visuals().weak_text_color();
    table(ui, &PROJECTION, camera.clip_from_view(aspect), [weak; 4]);
}

fn row_tints(ui: &Ui) -> [Color32; 4] {
    let weak = ui.visuals().weak_text_color();
    [colors::AXIS_X.of(ui), colors::AXIS_Y.of(ui), colors::AXIS_Z.of(ui), weak]
}

fn digits() -> FontId {
    FontId::new(11.5, FontFamily::Monospace)
}

fn table(ui: &mut Ui, of: &Table, matrix: DMat4, tints: [Color32; 4]) {
    let weak = ui.visuals().weak_text_color();
    let strong = ui.visuals().strong_text_color();
    // glam stores columns.
    let rows = matrix.transpose().to_cols_array_2d();
    let has_heads = of.columns.iter().any(|head| !head.is_empty());
    Grid::new(of.id).num_columns(5).spacing([4.0, 3.0]).min_col_width(40.0).show(ui, |ui| {
        if has_heads {
            ui.label("");
            for head in of.columns {
                ui.label(RichText::new(format!("{head:>8}")).font(digits()).color(weak));
            }
            ui.end_row();
        }
        for (((entries, name), tips), tint) in rows.iter().zip(of.rows).zip(of.tips).zip(tints) {
            ui.label(RichText::new(name).font(FontId::proportional(11.5)).color(tint));
            for (entry, tip) in entries.iter().zip(tips) {
                let zero = *entry == 0.0;
                let color = if zero { weak } else { strong };
                ui.label(RichText::new(entry_text(*entry)).font(digits()).color(color)).on_hover_text(tr!(tip));
            }
            ui.end_row();
        }
    });
}

/// Formats an entry in eight characters, with the decimal points aligned if possible.
fn entry_text(v: f64) -> String {
    let v = v + 0.0;
    if v == 0.0 {
        return format!("{:>8}", "0    ");
    }
    // A value that is rounded to zero has no sign.
    let text = format!("{v:8.3}").replace("  -0.000", "   0.000");
    if text.chars().count() <= 8 { text } else { format!("{v:8.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_have_the_same_width() {
        for v in [0.0, -0.0, 1.0, -1.0, 0.123456, -123.456, 9999.9, 123_456.0, -1e9] {
            assert_eq!(entry_text(v).chars().count(), 8, "{v}");
        }
        assert_eq!(entry_text(-0.0001).trim(), "0.000");
    }
}
