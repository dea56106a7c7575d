//! Curves over an angle.

use crate::canvas::PlotFigure;
use crate::palette::Rgb8;
use crate::scale::{PlotScale, linear_ticks, number};
use crate::shape::TextAlign;
use crate::{PlotError, PlotSettings, PlottedAngle, PlottedBsdf};
use gonio_bsdf::half_angles::HalfAngles;
use gonio_bsdf::integrate::albedo_with_steps;
use gonio_bsdf::sampling::direction;
use gonio_light::DVec3;
use gonio_light::optics::{brewster_angle_rad, dielectric, f0_from_index, polarised_dielectric, schlick};
use std::f64::consts::{FRAC_PI_2, PI};

/// Sizes of text in pixels.
pub const TEXT: f64 = 12.0;
/// The size of titles.
pub const TITLE: f64 = 14.0;

/// A curve with its label.
#[derive(Clone, Debug)]
pub struct PlotCurve {
    /// The text in the legend.
    pub label: String,
    /// The colour of the line.
    pub color: Rgb8,
    /// Places along x with their values; a value that is not finite interrupts the curve.
    pub points: Vec<[f64; 2]>,
}

/// The ticks along the horizontal axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum XTicks {
    /// Round angles in degrees.
    Angles,
    /// Round numbers.
    Numbers,
}

/// The texts and ranges of the axes.
#[derive(Clone, Debug)]
pub struct PlotAxes {
    /// The text above.
    pub title: String,
    /// The quantity along x with its unit.
    pub x_label: &'static str,
    /// The quantity along y with its unit.
    pub y_label: String,
    /// The ends of the horizontal axis.
    pub x: [f64; 2],
    /// The ticks of the horizontal axis.
    pub x_ticks: XTicks,
    /// The value at the top; a linear axis begins at 0.
    pub top: f64,
    /// The scale of the values.
    pub scale: PlotScale,
    /// A vertical line with its text.
    pub mark: Option<(f64, String)>,
    /// A horizontal line.
    pub level: Option<f64>,
}

/// Draws the legend at the bottom and returns the y above which there is room.
pub fn legend(figure: &mut PlotFigure, labels: &[(&str, Rgb8)]) -> f64 {
    const ROW: f64 = 22.0;
    let [width, height] = figure.size();
    let most = width - 40.0;
    let mut rows: Vec<Vec<(String, Rgb8, f64, f64)>> = vec![Vec::new()];
    let mut used = 0.0;
    for (index, (label, color)) in labels.iter().enumerate() {
        let label = figure.shortened(label, TEXT, most - 40.0);
        let entry = 34.0 + figure.text_width(&label, TEXT) + 18.0;
        if used + entry > most && used > 0.0 {
            rows.push(Vec::new());
            used = 0.0;
        }
        used += entry;
        if let Some(row) = rows.last_mut() {
            row.push((label, *color, line_width(index, labels.len()), entry));
        }
    }
    let top = height - 10.0 - ROW * rows.len() as f64;
    for (index, row) in rows.into_iter().enumerate() {
        let total: f64 = row.iter().map(|entry| entry.3).sum::<f64>() - 18.0;
        let mut x = 0.5 * (width - total);
        let y = top + ROW * (index as f64 + 0.5);
        for (label, color, line_width, entry) in row {
            figure.line(vec![[x, y], [x + 26.0, y]], color, line_width);
            figure.text([x + 34.0, y], &label, TEXT, figure.palette.ink, TextAlign::Start);
            x += entry;
        }
    }
    top
}

/// Draws curves with their axes and legend.
///
/// # Errors
///
/// A curve without finite values.
pub fn draw(figure: &mut PlotFigure, curves: &[PlotCurve], axes: &PlotAxes) -> Result<(), PlotError> {
    if let Some(empty) = curves.iter().find(|curve| !curve.points.iter().any(|point| point[1].is_finite())) {
        return Err(PlotError::Nothing(empty.label.clone()));
    }
    let palette = figure.palette;
    let labels: Vec<(&str, Rgb8)> = curves.iter().map(|curve| (curve.label.as_str(), curve.color)).collect();
    let [width, _] = figure.size();
    let (left, right, top) = (78.0, width - 24.0, 46.0);
    let bottom = legend(figure, &labels) - 52.0;
    let x_of = |x: f64| left + (x - axes.x[0]) / (axes.x[1] - axes.x[0]) * (right - left);
    let y_of = |value: f64| bottom - axes.scale.position(value, axes.top).clamp(0.0, 1.0) * (bottom - top);

    figure.fitted_text([0.5 * width, 24.0], &axes.title, TITLE, palette.ink);
    for tick in axes.scale.ticks(axes.top) {
        let y = y_of(tick);
        figure.line(vec![[left, y], [right, y]], palette.grid, 1.0);
        figure.text([left - 8.0, y], &number(tick), TEXT, palette.ink, TextAlign::End);
    }
    let x_ticks = match axes.x_ticks {
        XTicks::Angles => angle_ticks(axes.x, right - left),
        XTicks::Numbers => linear_ticks(axes.x[0], axes.x[1], 8),
    };
    for tick in x_ticks {
        let x = x_of(tick);
        figure.line(vec![[x, top], [x, bottom]], palette.grid, 1.0);
        figure.text([x, bottom + 15.0], &number(tick), TEXT, palette.ink, TextAlign::Middle);
    }
    if let Some(level) = axes.level.filter(|level| *level < axes.top) {
        figure.dashed([left, y_of(level)], [right, y_of(level)], palette.ink, 1.2);
    }
    if let Some((x, text)) = &axes.mark {
        figure.dashed([x_of(*x), top], [x_of(*x), bottom], palette.ink, 1.2);
        let is_left = x_of(*x) > 0.6 * right;
        let (offset, align) = if is_left { (-7.0, TextAlign::End) } else { (7.0, TextAlign::Start) };
        figure.text([x_of(*x) + offset, top + 14.0], text, TEXT, palette.ink, align);
    }
    let frame = vec![[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
    figure.line(frame, palette.ink, 1.2);
    for (index, curve) in curves.iter().enumerate() {
        // Values that are not finite, or below the axis, interrupt the curve.
        let is_off = |[_, value]: &[f64; 2]| !value.is_finite() || *value < axes.scale.least(axes.top);
        for part in curve.points.split(is_off) {
            let points = part.iter().map(|[x, value]| [x_of(*x), y_of(*value)]).collect();
            figure.line(points, curve.color, line_width(index, curves.len()));
        }
    }
    figure.fitted_text([0.5 * (left + right), bottom + 38.0], axes.x_label, TEXT, palette.ink);
    figure.text_upwards([18.0, 0.5 * (top + bottom)], &axes.y_label, TEXT, palette.ink);
    Ok(())
}

/// Ticks of an axis of degrees that is `length` pixels long: every 15, 30, 45, 60 or 90.
fn angle_ticks([from, to]: [f64; 2], length: f64) -> Vec<f64> {
    /// Pixels from one label to the next at least.
    const ROOM: f64 = 36.0;
    let has_room = |step: &f64| step / (to - from) * length >= ROOM;
    let step = [15.0, 30.0, 45.0, 60.0].into_iter().find(has_room).unwrap_or(90.0);
    if to - from < 30.0 {
        return linear_ticks(from, to, 8);
    }
    (0..=((to - from) / step) as i32).map(|index| from + step * f64::from(index)).collect()
}

/// `count + 1` angles in degrees, from one to another.
fn angles([from, to]: [f64; 2], count: u32) -> Vec<f64> {
    (0..=count).map(|index| from + (to - from) * f64::from(index) / f64::from(count)).collect()
}

/// The width of a curve: earlier ones are wider, so that later ones do not hide them where both agree.
pub fn line_width(index: usize, count: usize) -> f64 {
    1.8 + 0.8 * (count - 1 - index).min(3) as f64
}

/// The mean of the channels.
pub fn grey(f: DVec3) -> f64 {
    (f.x + f.y + f.z) / 3.0
}

/// Values over an angle.
///
/// # Errors
///
/// A function without finite values.
pub fn values(
    figure: &mut PlotFigure,
    functions: &[PlottedBsdf<'_>],
    settings: &PlotSettings,
) -> Result<(), PlotError> {
    let transmits = functions.iter().any(|function| function.bsdf.transmits());
    let (theta_i, phi_i) = (settings.theta_i_deg.to_radians(), settings.phi_i_deg.to_radians());
    let (range, x_label) = match settings.over {
        PlottedAngle::ThetaO if transmits => {
            ([-180.0, 180.0], "Viewer from the normal, negative on the light's side (degrees)")
        }
        PlottedAngle::ThetaO => ([-90.0, 90.0], "Viewer from the normal, negative on the light's side (degrees)"),
        PlottedAngle::PhiO => ([-180.0, 180.0], "Azimuth of the viewer from the mirror direction (degrees)"),
        PlottedAngle::ThetaI => ([0.0, 90.0], "Angle of incidence, viewer in the mirror direction (degrees)"),
        PlottedAngle::ThetaH => ([0.0, 90.0], "Half angle, between normal and half vector (degrees)"),
        PlottedAngle::ThetaD => ([0.0, 90.0], "Difference angle, between light and half vector (degrees)"),
    };
    let pair = |degrees: f64| {
        let angle = degrees.to_radians();
        match settings.over {
            PlottedAngle::ThetaO => {
                (settings.light(), direction(angle.abs(), phi_i + if angle < 0.0 { 0.0 } else { PI }))
            }
            PlottedAngle::PhiO => (settings.light(), direction(theta_i, phi_i + PI + angle)),
            PlottedAngle::ThetaI => (direction(angle, phi_i), direction(angle, phi_i + PI)),
            PlottedAngle::ThetaH => HalfAngles { theta_h: angle, theta_d: theta_i, phi_d: FRAC_PI_2 }.directions(),
            PlottedAngle::ThetaD => HalfAngles { theta_h: 0.0, theta_d: angle, phi_d: 0.0 }.directions(),
        }
    };
    // At the horizon a function has no value; where both directions approach it, many grow without bound.
    let margin = match settings.over {
        PlottedAngle::ThetaI | PlottedAngle::ThetaD => 2.0,
        _ => 0.1,
    };
    let is_off_horizon = |x: &f64| settings.over == PlottedAngle::PhiO || (x.abs() - 90.0).abs() > margin;
    let xs: Vec<f64> = angles(range, 1440).into_iter().filter(is_off_horizon).collect();
    let pairs: Vec<_> = xs.iter().map(|x| pair(*x)).collect();
    let mut curves = Vec::new();
    for (function, color) in functions.iter().zip(figure.palette.series) {
        let values = function.bsdf.evaluate_all(&pairs);
        let points = xs.iter().zip(&pairs).zip(values).map(|((x, (wi, _)), f)| [*x, grey(f) * settings.factor(*wi)]);
        curves.push(PlotCurve { label: function.label.to_owned(), color, points: points.collect() });
    }
    let incidence = number(settings.theta_i_deg);
    let title = match settings.over {
        PlottedAngle::ThetaO => format!("Plane of incidence, light at {incidence}°"),
        PlottedAngle::PhiO => format!("Light and viewer at {incidence}° from the normal"),
        PlottedAngle::ThetaI => "Mirror direction".to_owned(),
        PlottedAngle::ThetaH => format!("Difference angle {incidence}°, azimuth of difference 90°"),
        PlottedAngle::ThetaD => "Half vector along the normal".to_owned(),
    };
    let mark = match settings.over {
        PlottedAngle::ThetaO => Some((settings.theta_i_deg, "mirror direction".to_owned())),
        _ => None,
    };
    let axes = PlotAxes {
        title,
        x_label,
        y_label: format!("{}, mean of the channels", settings.quantity()),
        x: range,
        x_ticks: XTicks::Angles,
        top: settings.scale.end(largest(&curves)),
        scale: settings.scale,
        mark,
        level: None,
    };
    draw(figure, &curves, &axes)
}

fn largest(curves: &[PlotCurve]) -> f64 {
    let values = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    values.filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// Directional albedos.
///
/// # Errors
///
/// A function without finite values.
pub fn albedos(figure: &mut PlotFigure, functions: &[PlottedBsdf<'_>]) -> Result<(), PlotError> {
    let mut curves = Vec::new();
    for (function, color) in functions.iter().zip(figure.palette.series) {
        // Some albedos bend within the last degrees.
        let thetas = angles([0.0, 84.0], 42).into_iter().chain(angles([85.0, 89.0], 4)).chain([89.5]);
        let points = thetas.map(|theta| {
            let w = direction(theta.to_radians(), 0.0);
            [theta, grey(albedo_with_steps(function.bsdf, w, 48))]
        });
        curves.push(PlotCurve { label: function.label.to_owned(), color, points: points.collect() });
    }
    let axes = PlotAxes {
        title: "Directional albedo: the share of light that is scattered".to_owned(),
        x_label: "Angle of incidence (degrees)",
        y_label: "Albedo, mean of the channels".to_owned(),
        x: [0.0, 90.0],
        x_ticks: XTicks::Angles,
        top: PlotScale::Linear.end(largest(&curves).max(1.1)),
        scale: PlotScale::Linear,
        mark: None,
        level: Some(1.0),
    };
    draw(figure, &curves, &axes)
}

/// Errors below this are the rounding of `f64`, and drawn at the bottom.
const LEAST_ERROR: f64 = 1e-5;

/// Largest relative differences of `f` when light and viewer change places.
///
/// # Errors
///
/// A function without finite values.
pub fn reciprocity(figure: &mut PlotFigure, functions: &[PlottedBsdf<'_>]) -> Result<(), PlotError> {
    let mut curves = Vec::new();
    for (function, color) in functions.iter().zip(figure.palette.series) {
        let points = angles([0.0, 89.0], 89).into_iter().map(|theta| {
            let wi = direction(theta.to_radians(), 0.2);
            let viewers = (0..60).flat_map(|i| (0..12).map(move |j| (1.5 * f64::from(i) + 0.5, 30.0 * f64::from(j))));
            let pairs: Vec<_> =
                viewers.map(|(polar, turn)| (wi, direction(f64::to_radians(polar), f64::to_radians(turn)))).collect();
            let reversed: Vec<_> = pairs.iter().map(|(wi, wo)| (*wo, *wi)).collect();
            let (forth, back) = (function.bsdf.evaluate_all(&pairs), function.bsdf.evaluate_all(&reversed));
            let errors = forth.into_iter().zip(back).map(|(a, b)| {
                let (a, b) = (grey(a), grey(b));
                let size = a.abs().max(b.abs());
                if size > 1e-6 { (a - b).abs() / size } else { 0.0 }
            });
            [theta, errors.fold(LEAST_ERROR, f64::max)]
        });
        curves.push(PlotCurve { label: function.label.to_owned(), color, points: points.collect() });
    }
    let axes = PlotAxes {
        title: "Reciprocity: the largest relative difference of f(wi, wo) and f(wo, wi)".to_owned(),
        x_label: "Angle of incidence (degrees)",
        y_label: "Relative difference, 1e-5 or more".to_owned(),
        x: [0.0, 90.0],
        x_ticks: XTicks::Angles,
        // Five powers of ten, from the rounding up.
        top: PlotScale::Log.end(largest(&curves).max(LEAST_ERROR * 1e5)),
        scale: PlotScale::Log,
        mark: None,
        level: None,
    };
    draw(figure, &curves, &axes)
}

/// Fresnel factors of the first index of refraction above 1 that a function has, with Brewster's angle.
///
/// # Errors
///
/// No function has such an index.
pub fn fresnel(figure: &mut PlotFigure, functions: &[PlottedBsdf<'_>]) -> Result<(), PlotError> {
    let with_index = functions.iter().find_map(|function| Some((function, function.ior.filter(|ior| *ior > 1.0)?)));
    let (function, ior) = with_index.ok_or(PlotError::NoIndex)?;
    let of = if functions.len() > 1 { format!(", as of {}", function.label) } else { String::new() };
    let eta = 1.0 / ior;
    let series = figure.palette.series;
    let xs = angles([0.0, 90.0], 900);
    let curve = |label: &str, color: usize, value: &dyn Fn(f64) -> f64| PlotCurve {
        label: label.to_owned(),
        color: series[color],
        points: xs.iter().map(|x| [*x, value(x.to_radians().cos())]).collect(),
    };
    let curves = [
        curve("unpolarised", 0, &|cos| dielectric(cos, eta)),
        curve("polarised across the plane of incidence (s)", 1, &|cos| polarised_dielectric(cos, eta)[0]),
        curve("polarised in the plane of incidence (p)", 2, &|cos| polarised_dielectric(cos, eta)[1]),
        curve("Schlick's approximation", 3, &|cos| schlick(cos, f0_from_index(eta))),
    ];
    let brewster = brewster_angle_rad(eta).to_degrees();
    let axes = PlotAxes {
        title: format!("Reflectance of a smooth boundary from air to index {}{of}", number(ior)),
        x_label: "Angle of incidence (degrees)",
        y_label: "Reflectance".to_owned(),
        x: [0.0, 90.0],
        x_ticks: XTicks::Angles,
        top: 1.0,
        scale: PlotScale::Linear,
        mark: Some((brewster, format!("Brewster's angle {brewster:.2}°"))),
        level: None,
    };
    draw(figure, &curves, &axes)
}
