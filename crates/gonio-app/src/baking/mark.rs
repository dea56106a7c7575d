//! The place of a texel in the picture of the scene, and the outline of its chart.

use super::Baking;
use crate::scene_view::{Projection, line};
use crate::session::probing::Probing;
use crate::theme::colors;
use egui::{Color32, Painter, Pos2, Stroke, Ui};
use glam::DVec3;

/// Most edges of an outline; more are left out evenly.
const MOST_EDGES: usize = 4000;

/// Marks the place in a pane's picture: a ring, hollow if it is on a side that the camera does not see.
pub fn show(ui: &Ui, projection: &Projection, baking: &Baking, probing: &Probing) {
    if !baking.is_open {
        return;
    }
    let (Some(result), Some(place)) = (baking.result(), baking.place(probing)) else { return };
    let painter = ui.painter_at(projection.rect());
    let corner = |triangle: usize, k: usize| DVec3::from(result.atlas.corners[3 * triangle + k].map(f64::from));
    let eye = projection.camera().position;
    if let Some(outline) = result.outlines.get(place.chart as usize) {
        let color = colors::ACCENT.in_theme(true);
        for &(triangle, k) in outline.iter().step_by(outline.len().div_ceil(MOST_EDGES).max(1)) {
            let [a, b, c] = [0, 1, 2].map(|k| corner(triangle, k));
            if (b - a).cross(c - a).dot(eye - a) <= 0.0 {
                continue;
            }
            let ends = [corner(triangle, k), corner(triangle, (k + 1) % 3)].map(|end| projection.to_window(end));
            if let [Some(from), Some(to)] = ends {
                line(&painter, [from, to], 1.5, color);
            }
        }
    }
    if let Some(at) = projection.to_window(place.position) {
        ring(&painter, at, place.normal.dot(eye - place.position) >= 0.0);
    }
}

/// A ring around a place, with a point in it unless that is hidden.
pub fn ring(painter: &Painter, place: Pos2, is_seen: bool) {
    painter.circle_stroke(place, 8.0, Stroke::new(3.5, Color32::from_black_alpha(150)));
    painter.circle_stroke(place, 8.0, Stroke::new(1.6, Color32::WHITE));
    if is_seen {
        painter.circle(place, 2.5, colors::ACCENT.in_theme(true), Stroke::new(1.0, Color32::BLACK));
    }
}
