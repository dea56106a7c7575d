//! Image slices and lit spheres, one picture for each function.

use crate::canvas::PlotFigure;
use crate::curves::{TEXT, TITLE};
use crate::scale::{PlotScale, number};
use crate::shape::TextAlign;
use crate::{PlotError, PlotSettings, PlottedBsdf};
use gonio_bsdf::half_angles::HalfAngles;
use gonio_bsdf::sampling::direction;
use gonio_image::EncodedPicture;
use gonio_image::srgb::ENCODER;
use gonio_light::DVec3;
use gonio_light::vector::{half_vector, unit_or};
use std::f64::consts::{FRAC_PI_2, PI};

/// The place of a panel: left, top, width, height.
pub type Panel = [f64; 4];

/// Divides the room below the title among `count` panels, with `margin` around each: left, top, right, bottom.
pub fn panels(figure: &PlotFigure, count: usize, margin: [f64; 4]) -> Vec<Panel> {
    const TITLE_HEIGHT: f64 = 44.0;
    let [width, height] = figure.size();
    let height = height - TITLE_HEIGHT;
    let side = |columns: usize| {
        let rows = count.div_ceil(columns);
        let across = width / columns as f64 - margin[0] - margin[2];
        let down = height / rows as f64 - margin[1] - margin[3];
        across.min(down)
    };
    let columns = (1..=count).max_by(|a, b| side(*a).total_cmp(&side(*b))).unwrap_or(1);
    let side_length = side(columns).max(10.0);
    let rows = count.div_ceil(columns);
    let cell = [width / columns as f64, height / rows as f64];
    (0..count)
        .map(|index| {
            let (row, column) = (index / columns, index % columns);
            // The panels of the last row are centred.
            let in_row = (count - row * columns).min(columns);
            let shift = 0.5 * (columns - in_row) as f64 * cell[0];
            let free = [cell[0] - margin[0] - margin[2] - side_length, cell[1] - margin[1] - margin[3] - side_length];
            let left = shift + cell[0] * column as f64 + margin[0] + 0.5 * free[0];
            let top = TITLE_HEIGHT + cell[1] * row as f64 + margin[1] + 0.5 * free[1];
            [left, top, side_length, side_length]
        })
        .collect()
}

/// Side in pixels below which an image slice has few ticks and no titles of axes.
const SMALL_SLICE: f64 = 160.0;

/// A panel with sides of at most `most` pixels about the same middle.
fn shrunk([left, top, side, _]: Panel, most: f64) -> Panel {
    let less = (side - most).max(0.0);
    [left + 0.5 * less, top + 0.5 * less, side - less, side - less]
}

/// The label above a panel.
pub fn panel_label(figure: &mut PlotFigure, panel: Panel, label: &str, most: f64) {
    let label = figure.shortened(label, TEXT, most);
    let ink = figure.palette.ink;
    figure.text([panel[0] + 0.5 * panel[2], panel[1] - 13.0], &label, TEXT, ink, TextAlign::Middle);
}

/// A value in `[0, 1]` of a scale as 8 bits: light is encoded as sRGB, other scales are shown as they are.
fn tone(value: f64, largest: f64, scale: PlotScale) -> u8 {
    match scale {
        PlotScale::Linear => ENCODER.encode_f64(value / largest),
        _ => (255.0 * scale.position(value, largest).clamp(0.0, 1.0) + 0.5) as u8,
    }
}

/// The image slice of measured BRDFs: half angle to the right, by its square root as in the tables, and difference angle
/// upwards, at 90 degrees of azimuth.
///
/// # Errors
///
/// A function without finite values.
pub fn slices(
    figure: &mut PlotFigure,
    functions: &[PlottedBsdf<'_>],
    settings: &PlotSettings,
) -> Result<(), PlotError> {
    const CELLS: u32 = 180;
    /// The cosine 10 degrees above the horizon.
    const LEAST_COSINE: f64 = 0.173_6;
    let palette = figure.palette;
    let middle = |index: u32| (f64::from(index) + 0.5) / f64::from(CELLS);
    let pairs: Vec<_> = (0..CELLS)
        .rev()
        .flat_map(|row| (0..CELLS).map(move |column| (row, column)))
        .map(|(row, column)| {
            let theta_h = FRAC_PI_2 * middle(column).powi(2);
            HalfAngles { theta_h, theta_d: FRAC_PI_2 * middle(row), phi_d: FRAC_PI_2 }.directions()
        })
        .collect();
    let mut all = Vec::new();
    let mut bright: Vec<f64> = Vec::new();
    for function in functions {
        let values: Vec<DVec3> = function
            .bsdf
            .evaluate_all(&pairs)
            .into_iter()
            .zip(&pairs)
            .map(|(f, (wi, _))| f * settings.factor(*wi))
            .collect();
        // Values near the horizon are large, and would leave the rest black.
        let is_high = |wi: &DVec3, wo: &DVec3| wi.z > LEAST_COSINE && wo.z > LEAST_COSINE;
        let high = values.iter().zip(&pairs).filter(|(f, (wi, wo))| f.is_finite() && is_high(wi, wo));
        bright.extend(high.map(|(f, _)| f.max_element()).filter(|value| *value > 0.0));
        if !values.iter().any(|f| f.is_finite()) {
            return Err(PlotError::Nothing(function.label.to_owned()));
        }
        all.push(values);
    }
    // The brightest values of a narrow lobe fill few cells and would leave the rest black.
    bright.sort_by(f64::total_cmp);
    let largest = bright.get((0.995 * bright.len() as f64) as usize).copied().unwrap_or(1.0);
    let scale_name = match settings.scale {
        PlotScale::Linear => "encoded as sRGB",
        PlotScale::Log => "logarithmic",
        PlotScale::CubeRoot => "by cube roots",
    };
    let title = format!("Image slice at 90° of azimuth, white is {} 1/sr, {scale_name}", number(largest));
    let [width, _] = figure.size();
    figure.fitted_text([0.5 * width, 24.0], &title, TITLE, palette.ink);
    let mut places = panels(figure, functions.len(), [66.0, 26.0, 22.0, 52.0]);
    if places.iter().any(|place| place[2] < SMALL_SLICE) {
        places = panels(figure, functions.len(), [30.0, 26.0, 14.0, 26.0]);
        let most = SMALL_SLICE - 1.0;
        places.iter_mut().for_each(|place| *place = shrunk(*place, most));
    }
    for ((function, values), panel) in functions.iter().zip(all).zip(places) {
        let mut rgba = Vec::with_capacity(4 * values.len());
        for value in values {
            let value = if value.is_finite() { value } else { DVec3::ZERO };
            rgba.extend(value.to_array().map(|channel| tone(channel, largest, settings.scale)));
            rgba.push(255);
        }
        figure.picture(panel, EncodedPicture { width: CELLS, height: CELLS, rgba });
        let [left, top, side, _] = panel;
        let bottom = top + side;
        figure.line(
            vec![[left, top], [left + side, top], [left + side, bottom], [left, bottom], [left, top]],
            palette.ink,
            1.2,
        );
        // Small panels have fewer ticks, and no titles of axes.
        let is_small = side < SMALL_SLICE;
        let ticks: &[f64] = if is_small { &[0.0, 90.0] } else { &[0.0, 5.0, 15.0, 30.0, 60.0, 90.0] };
        for degrees in ticks.iter().copied() {
            let x = left + side * (degrees / 90.0).sqrt();
            figure.line(vec![[x, bottom], [x, bottom + 5.0]], palette.ink, 1.2);
            figure.text([x, bottom + 15.0], &number(degrees), TEXT, palette.ink, TextAlign::Middle);
        }
        let ticks: &[f64] = if is_small { &[0.0, 90.0] } else { &[0.0, 30.0, 60.0, 90.0] };
        for degrees in ticks.iter().copied() {
            let y = bottom - side * degrees / 90.0;
            figure.line(vec![[left - 5.0, y], [left, y]], palette.ink, 1.2);
            figure.text([left - 9.0, y], &number(degrees), TEXT, palette.ink, TextAlign::End);
        }
        if !is_small {
            let middle = left + 0.5 * side;
            figure.text([middle, bottom + 36.0], "Half angle (degrees)", TEXT, palette.ink, TextAlign::Middle);
            figure.text_upwards([left - 42.0, top + 0.5 * side], "Difference angle (degrees)", TEXT, palette.ink);
        }
        panel_label(figure, panel, function.label, side + if is_small { 36.0 } else { 60.0 });
    }
    Ok(())
}

/// Spheres lit by one light, seen from far away. The light is `theta_i` degrees from the viewer, to the upper left.
///
/// # Errors
///
/// A function without finite values.
pub fn spheres(
    figure: &mut PlotFigure,
    functions: &[PlottedBsdf<'_>],
    settings: &PlotSettings,
) -> Result<(), PlotError> {
    let palette = figure.palette;
    let [width, _] = figure.size();
    let title = format!(
        "Sphere, light {}° from the viewer; 1 is a white diffuse surface that faces it",
        number(settings.theta_i_deg)
    );
    figure.fitted_text([0.5 * width, 24.0], &title, TITLE, palette.ink);
    let light = direction(settings.theta_i_deg.to_radians(), 0.75 * PI);
    for (function, panel) in functions.iter().zip(panels(figure, functions.len(), [18.0, 26.0, 18.0, 12.0])) {
        let picture = sphere(
            function,
            light,
            (1.5 * panel[2]).clamp(32.0, f64::from(settings.most_sphere_pixels.max(32))) as u32,
        )?;
        figure.picture(panel, picture);
        panel_label(figure, panel, function.label, panel[2] + 30.0);
    }
    Ok(())
}

fn sphere(function: &PlottedBsdf<'_>, light: DVec3, side: u32) -> Result<EncodedPicture<u8>, PlotError> {
    let radius = 0.5 * f64::from(side) - 1.0;
    let coordinate = |index: u32| (f64::from(index) + 0.5 - 0.5 * f64::from(side)) / radius;
    let mut pairs = Vec::new();
    let mut covered = Vec::new();
    for (index, (row, column)) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))).enumerate() {
        let (x, y) = (coordinate(column), -coordinate(row));
        let distance = x.hypot(y);
        let coverage = (radius * (1.0 - distance) + 0.5).clamp(0.0, 1.0);
        if coverage <= 0.0 {
            continue;
        }
        // A pixel that the rim crosses shows the rim.
        let inside = (1.0 / distance.max(1e-12)).min(1.0) * 0.999_99;
        let (x, y) = (x * inside, y * inside);
        let normal = DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt());
        let tangent = unit_or(DVec3::Y.cross(normal), DVec3::X);
        let bitangent = normal.cross(tangent);
        let local = |w: DVec3| DVec3::new(tangent.dot(w), bitangent.dot(w), normal.dot(w));
        pairs.push((local(light), local(DVec3::Z)));
        covered.push((index, coverage));
    }
    let values = function.bsdf.evaluate_all(&pairs);
    if !values.iter().any(|value| value.is_finite()) {
        return Err(PlotError::Nothing(function.label.to_owned()));
    }
    let mut rgba = vec![0; 4 * (side * side) as usize];
    for (((index, coverage), (wi, _)), f) in covered.into_iter().zip(&pairs).zip(values) {
        let light = if f.is_finite() { f * (PI * wi.z.max(0.0)) } else { DVec3::ZERO };
        let encoded = light.to_array().map(|channel| ENCODER.encode_f64(channel));
        rgba[4 * index..4 * index + 3].copy_from_slice(&encoded);
        rgba[4 * index + 3] = (255.0 * coverage + 0.5) as u8;
    }
    Ok(EncodedPicture { width: side, height: side, rgba })
}

/// The mirror direction of a light.
pub fn mirror(wi: DVec3) -> DVec3 {
    let h = half_vector(wi, DVec3::new(-wi.x, -wi.y, wi.z), DVec3::Z);
    2.0 * h.dot(wi) * h - wi
}
