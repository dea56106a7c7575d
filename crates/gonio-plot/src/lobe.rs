//! The lobe: values of all directions as distances from the point, seen from above.

use crate::canvas::PlotFigure;
use crate::curves::{TEXT, TITLE, grey};
use crate::palette::Rgb8;
use crate::pictures::{mirror, panel_label, panels};
use crate::scale::number;
use crate::shape::TextAlign;
use crate::{PlotError, PlotSettings, PlottedBsdf};
use gonio_bsdf::sampling::direction;
use gonio_light::DVec3;
use gonio_light::vector::unit_or;
use std::f64::consts::{PI, TAU};

/// Polar angles this close to the horizon, in radians, are moved away from it.
const HORIZON: f64 = 2e-3;

/// Projects a point, x to the right, y upwards, and its depth, larger is nearer. The view is turned about the normal and raised
/// above the horizon, in degrees.
fn project_from([turn_deg, rise_deg]: [f64; 2], p: DVec3) -> [f64; 3] {
    let ((sin, cos), (sin_rise, cos_rise)) = (turn_deg.to_radians().sin_cos(), rise_deg.to_radians().sin_cos());
    let (across, away) = (cos * p.x - sin * p.y, sin * p.x + cos * p.y);
    [across, p.z * cos_rise + away * sin_rise, p.z * sin_rise - away * cos_rise]
}

/// Angles in radians with `even` equal steps between two ends, and closer ones about `peak`.
pub fn polar_angles(from: f64, to: f64, even: u32, peak: f64) -> Vec<f64> {
    let steady = (0..=even).map(|index| from + (to - from) * f64::from(index) / f64::from(even));
    let close = (-16..=16).map(|index| peak + 0.18 * f64::from(index).signum() * (f64::from(index) / 16.0).powi(2));
    let mut all: Vec<f64> = steady.chain(close).filter(|angle| (from..=to).contains(angle)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1e-4);
    all
}

fn off_horizon(theta: f64) -> f64 {
    let above = theta - 0.5 * PI;
    if above.abs() < HORIZON { 0.5 * PI + HORIZON.copysign(above) } else { theta }
}

/// Draws a lobe for each function.
///
/// # Errors
///
/// A function without finite values.
pub fn draw(figure: &mut PlotFigure, functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<(), PlotError> {
    let wi = settings.light();
    let project = |p: DVec3| project_from(settings.view_deg, p);
    let phi_mirror = settings.phi_i_deg.to_radians() + PI;
    let mut lobes = Vec::new();
    for function in functions {
        // Exactly at the horizon a function has no value.
        let last = if function.bsdf.transmits() { PI } else { 0.5 * PI - HORIZON };
        let thetas =
            polar_angles(0.0, last, if function.bsdf.transmits() { 60 } else { 34 }, settings.theta_i_deg.to_radians());
        let phis = polar_angles(phi_mirror - PI, phi_mirror + PI, 72, phi_mirror);
        let directions: Vec<DVec3> =
            thetas.iter().flat_map(|theta| phis.iter().map(|phi| direction(off_horizon(*theta), *phi))).collect();
        let pairs: Vec<_> = directions.iter().map(|wo| (wi, *wo)).collect();
        let values: Vec<f64> =
            function.bsdf.evaluate_all(&pairs).into_iter().map(|f| grey(f) * settings.factor(wi)).collect();
        let largest = values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
        if largest <= 0.0 {
            return Err(PlotError::Nothing(function.label.to_owned()));
        }
        lobes.push((thetas.len(), phis.len(), directions, values, largest));
    }
    let palette = figure.palette;
    let [width, _] = figure.size();
    let title = format!(
        "{} in all directions for light at {}°, {} scale, mean of the channels",
        settings.quantity(),
        number(settings.theta_i_deg),
        settings.scale
    );
    figure.fitted_text([0.5 * width, 24.0], &title, TITLE, palette.ink);
    let places = panels(figure, functions.len(), [14.0, 26.0, 14.0, 30.0]);
    for (((function, color), lobe), panel) in functions.iter().zip(palette.series).zip(lobes).zip(places) {
        let (rows, columns, directions, values, largest) = lobe;
        let radius = 0.42 * panel[2];
        // A lobe above the surface needs more room there.
        let rise = if function.bsdf.transmits() { 0.5 } else { 0.66 };
        let center = [panel[0] + 0.5 * panel[2], panel[1] + rise * panel[3]];
        let on_paper = |p: [f64; 3]| [center[0] + radius * p[0], center[1] - radius * p[1]];
        let circle = (0..=90).map(|step| on_paper(project(direction(0.5 * PI, TAU * f64::from(step) / 90.0))));
        figure.line(circle.collect(), palette.grid, 1.4);
        let points: Vec<[f64; 3]> = directions
            .iter()
            .zip(&values)
            .map(|(w, value)| {
                let value = if value.is_finite() { *value } else { 0.0 };
                project(*w * settings.scale.position(value, largest).clamp(0.0, 1.0))
            })
            .collect();
        let tip = |w: DVec3, length: f64| on_paper(project(w * length));
        figure.dashed(tip(mirror(wi), 0.0), tip(mirror(wi), 1.06), palette.soft, 1.2);
        draw_surface(figure, &points, rows, columns, color, &on_paper);
        figure.arrow(tip(DVec3::Z, 0.0), tip(DVec3::Z, 1.1), palette.ink, 1.6);
        figure.arrow(tip(wi, 1.1), tip(wi, 0.03), palette.ink, 1.6);
        for (w, name) in [(DVec3::Z, "N"), (wi, "L"), (mirror(wi), "R")] {
            // At normal incidence all three are one direction.
            if name == "N" || w.z < 0.995 {
                figure.text(tip(w, 1.22), name, TEXT, palette.ink, TextAlign::Middle);
            }
        }
        panel_label(figure, panel, function.label, panel[2]);
        let note = format!("circle at {} 1/sr", number(largest));
        let below = [center[0], panel[1] + panel[3] + 14.0];
        figure.text_within(below, &note, TEXT, palette.soft, panel[2] + 24.0);
    }
    Ok(())
}

/// Draws the quads of a surface, the farthest first.
fn draw_surface(
    figure: &mut PlotFigure,
    points: &[[f64; 3]],
    rows: usize,
    columns: usize,
    color: Rgb8,
    on_paper: &dyn Fn([f64; 3]) -> [f64; 2],
) {
    let mut quads = Vec::new();
    for row in 0..rows.saturating_sub(1) {
        for column in 0..columns.saturating_sub(1) {
            let at = |r: usize, c: usize| points[(row + r) * columns + column + c];
            let corners = [at(0, 0), at(0, 1), at(1, 1), at(1, 0)];
            let depth: f64 = corners.iter().map(|corner| corner[2]).sum();
            let [a, b, c, d] = corners.map(DVec3::from_array);
            let normal = unit_or((c - a).cross(d - b), DVec3::ZERO);
            if normal != DVec3::ZERO {
                quads.push((depth, corners, normal));
            }
        }
    }
    quads.sort_by(|a, b| a.0.total_cmp(&b.0));
    let lamp = unit_or(DVec3::new(-0.5, 0.75, 0.9), DVec3::Z);
    for (_, corners, normal) in quads {
        // Both sides of the surface are seen.
        let facing = if normal.z < 0.0 { -normal } else { normal };
        let brightness = 0.4 + 0.7 * facing.dot(lamp).max(0.0);
        let shaded = color.map(|channel| (f64::from(channel) * brightness).min(255.0) as u8);
        figure.area(corners.map(on_paper).to_vec(), shaded);
    }
}
