//! Polar plots in the plane of incidence.

use crate::canvas::PlotFigure;
use crate::curves::{TEXT, TITLE, grey, legend, line_width};
use crate::palette::Rgb8;
use crate::scale::{PlotScale, number};
use crate::shape::{PolarPlace, TextAlign};
use crate::{PlotError, PlotSettings, PlottedBsdf};
use gonio_bsdf::sampling::direction;
use std::f64::consts::PI;

/// Draws values as distances from the point, with the light on the left.
///
/// # Errors
///
/// A function without finite values.
pub fn draw(figure: &mut PlotFigure, functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<(), PlotError> {
    let transmits = functions.iter().any(|function| function.bsdf.transmits());
    let last = if transmits { 180.0 } else { 90.0 };
    let count = 8 * last as i32;
    // Exactly at the horizon a function has no value.
    let is_off_horizon = |angle: &f64| (angle.abs() - 90.0).abs() > 0.1;
    let angles: Vec<f64> = (-count..=count).map(|index| f64::from(index) / 8.0).filter(is_off_horizon).collect();
    let wi = settings.light();
    let phi = settings.phi_i_deg.to_radians();
    let pairs: Vec<_> = angles
        .iter()
        .map(|angle| (wi, direction(angle.abs().to_radians(), phi + if *angle < 0.0 { 0.0 } else { PI })))
        .collect();
    let mut curves: Vec<(Rgb8, Vec<f64>)> = Vec::new();
    for (function, color) in functions.iter().zip(figure.palette.series) {
        let values = function.bsdf.evaluate_all(&pairs);
        let values: Vec<f64> = values.into_iter().map(|f| grey(f) * settings.factor(wi)).collect();
        if !values.iter().any(|value| value.is_finite()) {
            return Err(PlotError::Nothing(function.label.to_owned()));
        }
        curves.push((color, values));
    }
    let all = curves.iter().flat_map(|(_, values)| values).copied();
    let largest = settings.scale.end(all.filter(|value| value.is_finite()).fold(0.0, f64::max));

    let palette = figure.palette;
    let labels: Vec<(&str, Rgb8)> = functions.iter().zip(palette.series).map(|(f, color)| (f.label, color)).collect();
    let room = legend(figure, &labels);
    let [width, _] = figure.size();
    let (top, below) = (62.0, room - if transmits { 30.0 } else { 46.0 });
    let height = below - top;
    let radius = (0.5 * width - 60.0).min(if transmits { 0.5 * height - 4.0 } else { height });
    let center = [0.5 * width, if transmits { top + 0.5 * height } else { below }];
    let at = |degrees: f64, distance: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [center[0] + radius * distance * sin, center[1] - radius * distance * cos]
    };
    let title = format!(
        "Plane of incidence, light at {}°: {}, mean of the channels",
        number(settings.theta_i_deg),
        settings.quantity()
    );
    figure.fitted_text([center[0], 24.0], &title, TITLE, palette.ink);
    figure.polar = Some(PolarPlace { center, radius });
    let ticks = settings.scale.ticks(largest);
    for tick in &ticks {
        let distance = settings.scale.position(*tick, largest);
        if distance > 0.0 {
            let ring = (-60..=60).map(|step| at(last * f64::from(step) / 60.0, distance)).collect();
            figure.line(ring, palette.grid, 1.0);
        }
    }
    let spokes = (last / 15.0) as i32;
    for spoke in -spokes..=spokes {
        let angle = 15.0 * f64::from(spoke);
        // The two ends of the circle are one.
        if angle == -180.0 {
            continue;
        }
        figure.line(vec![at(angle, 0.0), at(angle, 1.0)], palette.grid, 1.0);
        let place = at(angle, 1.0 + 16.0 / radius);
        let align = if angle.abs() < 1.0 || angle.abs() > 179.0 {
            TextAlign::Middle
        } else if angle < 0.0 {
            TextAlign::End
        } else {
            TextAlign::Start
        };
        figure.text(place, &format!("{}°", angle.abs()), TEXT, palette.soft, align);
    }
    figure.line(vec![at(-90.0, 1.0), at(90.0, 1.0)], palette.ink, 1.4);
    figure.dashed(at(0.0, 0.0), at(0.0, 1.0), palette.ink, 1.2);
    ring_labels(figure, &ticks, settings.scale, largest, center, radius, transmits);
    for (index, (color, values)) in curves.iter().enumerate() {
        let points: Vec<[f64; 2]> = angles
            .iter()
            .zip(values)
            .filter(|(_, value)| value.is_finite())
            .map(|(angle, value)| at(*angle, settings.scale.position(*value, largest).clamp(0.0, 1.0)))
            .collect();
        figure.line(points, *color, line_width(index, curves.len()));
    }
    arrow_of_light(figure, at(-settings.theta_i_deg, 1.0), at(-settings.theta_i_deg, 0.0));
    Ok(())
}

/// The arrow of the light, from the rim to the point.
fn arrow_of_light(figure: &mut PlotFigure, rim: [f64; 2], center: [f64; 2]) {
    let along = |share: f64| [center[0] + share * (rim[0] - center[0]), center[1] + share * (rim[1] - center[1])];
    let ink = figure.palette.ink;
    figure.arrow(along(0.98), along(0.70), ink, 2.0);
    let middle = along(0.84);
    let width = figure.text_width("light", TEXT);
    // Beside the arrow, towards the normal, on paper of its own.
    let place = [middle[0] + 12.0, middle[1] - 10.0];
    let paper = figure.palette.background;
    let (left, right, top, bottom) = (place[0] - 2.0, place[0] + width + 2.0, place[1] - 8.0, place[1] + 8.0);
    figure.area(vec![[left, top], [right, top], [right, bottom], [left, bottom]], paper);
    figure.text(place, "light", TEXT, ink, TextAlign::Start);
}

/// The values of the rings, below the horizon: on the right, or on the light's side if refracted light is on the right.
fn ring_labels(
    figure: &mut PlotFigure,
    ticks: &[f64],
    scale: PlotScale,
    largest: f64,
    center: [f64; 2],
    radius: f64,
    transmits: bool,
) {
    let palette = figure.palette;
    let mut free_from = f64::NEG_INFINITY;
    for tick in ticks {
        let text = number(*tick);
        let distance = radius * scale.position(*tick, largest);
        let half = 0.5 * figure.text_width(&text, TEXT);
        if distance - half < free_from {
            continue;
        }
        free_from = distance + half + 6.0;
        let x = center[0] + if transmits { -distance } else { distance };
        let y = center[1] + if transmits { 12.0 } else { 17.0 };
        let paper = vec![
            [x - half - 2.0, y - 8.0],
            [x + half + 2.0, y - 8.0],
            [x + half + 2.0, y + 8.0],
            [x - half - 2.0, y + 8.0],
        ];
        figure.area(paper, palette.background);
        figure.text([x, y], &text, TEXT, palette.ink, TextAlign::Middle);
    }
}
