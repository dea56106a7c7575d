//! Motion of a light.

use super::edits;
use crate::session::Session;
use crate::theme::icons;
use crate::widgets::{Number, Vector, dropdown, icon_button, row};
use egui::Ui;
use gonio_scene::defaults;
use gonio_scene::scene_file::MotionKind;
use gonio_scene::settings::{LightSettings, Motion, MotionPath};

/// Most points of a path that are shown; more are edited in the scene file.
const MOST_POINTS: usize = 24;

pub fn show(ui: &mut Ui, light: &mut LightSettings, session: &Session, index: usize) {
    let mut kind = light.motion.as_ref().map(|motion| motion.path.kind());
    let mut options = vec![(None, "none", "The light does not move")];
    options.extend(MotionKind::ALL.iter().map(|kind| (Some(*kind), kind.name(), kind.description())));
    let changed = row(ui, "Motion", "Motion over time", |ui| {
        dropdown(ui, &format!("light-{index}-motion"), "motion", &mut kind, &options)
    });
    if changed {
        light.motion = kind.map(|kind| fresh(kind, light, session));
    }
    let Some(motion) = &mut light.motion else { return };
    row(ui, "Period", "Duration of one cycle, in seconds", |ui| {
        let id = format!("light-{index}-period");
        let number = Number::new(&id, "period").tip("Duration of one cycle, in seconds").unit(" s");
        number.range(0.01..=1e6).default(4.0).show(ui, &mut motion.period);
    });
    match &mut motion.path {
        MotionPath::Oscillate { amplitude } => {
            row(ui, "Amplitude", "Largest displacement, in world units", |ui| {
                let id = format!("light-{index}-amplitude");
                Vector::new(&id, "amplitude").tip("Largest displacement, in world units").show(ui, amplitude);
            });
        }
        MotionPath::Circle { center, axis } => {
            row(ui, "Centre", "Centre of the circle, in world space", |ui| {
                Vector::new(&format!("light-{index}-center"), "centre").show(ui, center);
            });
            let before = *axis;
            row(ui, "Axis", "Axis of rotation", |ui| {
                Vector::new(&format!("light-{index}-axis"), "axis").default(defaults::MOTION_AXIS).show(ui, axis);
            });
            // A direction of length 0 is none.
            if *axis == [0.0; 3] {
                *axis = before;
            }
        }
        MotionPath::Path { points } => {
            path(ui, points, index);
            light.position = points.first().copied().or(light.position);
        }
    }
}

fn path(ui: &mut Ui, points: &mut Vec<[f64; 3]>, index: usize) {
    let mut removed = None;
    let count = points.len();
    for (number, point) in points.iter_mut().enumerate().take(MOST_POINTS) {
        row(ui, &format!("Point {}", number + 1), "In world space; the path is closed", |ui| {
            let id = format!("light-{index}-point-{number}");
            ui.scope(|ui| {
                ui.set_max_width(ui.available_width() - 26.0);
                Vector::new(&id, "point").show(ui, point);
            });
            if count > 2 && icon_button(ui, &format!("{id}-remove"), icons::X, "Remove this point").clicked() {
                removed = Some(number);
            }
        });
    }
    if let Some(number) = removed {
        points.remove(number);
    }
    row(ui, "", "", |ui| {
        if icon_button(ui, &format!("light-{index}-add-point"), icons::PLUS, "Add a point").clicked() {
            let last = points.last().copied().unwrap_or_default();
            points.push([last[0] + 0.5, last[1], last[2]]);
        }
    });
}

/// A motion that is seen at once.
fn fresh(kind: MotionKind, light: &LightSettings, session: &Session) -> Motion {
    let (center, radius) = edits::around(session);
    let round = |v: f64| (100.0 * v).round() / 100.0;
    let place = light.position.unwrap_or_default();
    let step = round(radius).max(0.01);
    let path = match kind {
        MotionKind::Oscillate => MotionPath::Oscillate { amplitude: [0.0, 0.0, step] },
        MotionKind::Circle => {
            MotionPath::Circle { center: [round(center.x), place[1], round(center.z)], axis: defaults::MOTION_AXIS }
        }
        MotionKind::Path => {
            let [x, y, z] = place;
            MotionPath::Path { points: vec![place, [x + step, y, z], [x + step, y + step, z]] }
        }
    };
    Motion { period: 4.0, path }
}
