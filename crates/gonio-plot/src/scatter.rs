//! Directions drawn by importance sampling.

use crate::canvas::PlotFigure;
use crate::curves::{TEXT, TITLE};
use crate::pictures::{panel_label, panels};
use crate::scale::number;
use crate::shape::TextAlign;
use crate::{PlotError, PlotSettings, PlottedBsdf};
use gonio_bsdf::sampling::SplitMix;
use std::f64::consts::TAU;

/// Samples of each function.
const SAMPLES: u32 = 2000;

/// Draws the directions to the light for a viewer at the angle of incidence, seen along the normal.
///
/// # Errors
///
/// A function that draws no direction.
pub fn draw(figure: &mut PlotFigure, functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<(), PlotError> {
    let palette = figure.palette;
    let [width, _] = figure.size();
    let title = format!(
        "{SAMPLES} sampled directions seen along the normal, viewer at {}°; cross: mirror direction",
        number(settings.theta_i_deg)
    );
    figure.fitted_text([0.5 * width, 24.0], &title, TITLE, palette.ink);
    let wo = settings.light();
    for ((function, color), panel) in
        functions.iter().zip(palette.series).zip(panels(figure, functions.len(), [26.0, 30.0, 26.0, 40.0]))
    {
        let [left, top, side, _] = panel;
        let (center, radius) = ([left + 0.5 * side, top + 0.5 * side], 0.5 * side);
        let at = |x: f64, y: f64| [center[0] + radius * x, center[1] - radius * y];
        for degrees in [30.0, 60.0, 90.0_f64] {
            let ring = degrees.to_radians().sin();
            let points = (0..=90).map(|step| {
                let (sin, cos) = (TAU * f64::from(step) / 90.0).sin_cos();
                at(ring * cos, ring * sin)
            });
            let is_horizon = degrees == 90.0;
            let (ink, line) = if is_horizon { (palette.ink, 1.4) } else { (palette.grid, 1.0) };
            figure.line(points.collect(), ink, line);
        }
        let mut random = SplitMix::new(1);
        let (mut lost, mut below) = (0, 0);
        for _ in 0..SAMPLES {
            let Some(sample) = function.bsdf.sample(wo, random.next_three()) else {
                lost += 1;
                continue;
            };
            let is_below = sample.wi.z < 0.0;
            below += u32::from(is_below);
            let ink = if is_below { palette.soft } else { color };
            figure.dot(at(sample.wi.x, sample.wi.y), 1.3, ink, 0.55);
        }
        if lost == SAMPLES {
            return Err(PlotError::Nothing(function.label.to_owned()));
        }
        // Near the horizon there is room for both labels on large discs only.
        let labelled: &[f64] = if radius > 130.0 { &[30.0, 60.0, 90.0] } else { &[30.0, 90.0] };
        for degrees in labelled {
            let place = at(0.0, -degrees.to_radians().sin());
            let text = format!("{degrees}°");
            let half = 0.5 * figure.text_width(&text, TEXT) + 2.0;
            let paper = [[-half, -8.0], [half, -8.0], [half, 8.0], [-half, 8.0]];
            figure.area(paper.map(|[x, y]| [place[0] + x, place[1] + y]).to_vec(), palette.background);
            figure.text(place, &text, TEXT, palette.soft, TextAlign::Middle);
        }
        let mirrored = at(-wo.x, -wo.y);
        for [x, y] in [[1.0, 1.0], [1.0, -1.0]] {
            let arm = |sign: f64| [mirrored[0] + sign * 6.0 * x, mirrored[1] + sign * 6.0 * y];
            figure.line(vec![arm(-1.0), arm(1.0)], palette.ink, 1.6);
        }
        let percent = |count: u32| number(100.0 * f64::from(count) / f64::from(SAMPLES));
        let mut note = format!("{} % lost", percent(lost));
        if below > 0 {
            note += &format!("; grey: {} % below the surface", percent(below));
        }
        let note = figure.shortened(&note, TEXT, side + 50.0);
        figure.text([center[0], top + side + 24.0], &note, TEXT, palette.soft, TextAlign::Middle);
        panel_label(figure, panel, function.label, side + 40.0);
    }
    Ok(())
}
