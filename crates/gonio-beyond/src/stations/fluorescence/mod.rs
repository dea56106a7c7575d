//! Fluorescence: a drawing with highlighters under a lamp of one wavelength.

mod drawing;
mod inks;
mod reradiation;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use drawing::{HighlighterDrawing, MatrixPicture};
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use inks::{ORANGE, PAPER, YELLOW};
use reradiation::{ALL_BANDS, WideSpectrum, bell, lambda_of, photons};

/// The station.
pub const STATION: Station = Station {
    name: "fluorescence",
    title: "Fluorescence",
    assumption: "Each wavelength is reflected by itself: f_r(x, w_i, w_o, lambda) multiplies light of the wavelength lambda, and \
                 returns light of that wavelength. A surface is never brighter than what shines on it.",
    nature: "A dye absorbs a photon and emits another one within nanoseconds, at a longer wavelength: part of the energy has become \
             heat. So invisible ultraviolet light becomes visible, and ink looks brighter than white paper.",
    formula: "L_o(lambda_o) = sum over lambda_i of M(lambda_o, lambda_i) L_i(lambda_i)\n\
              M_ij = q a_j e_i lambda_j / lambda_i  for lambda_i > lambda_j     M_jj = (1 - a_j) r_j     M_ij = 0  for lambda_i < lambda_j",
    source: "G. G. Stokes 1852; R. Donaldson, Spectrophotometry of fluorescent pigments, British Journal of Applied Physics 5, 1954; \
             dyes: H. Du et al., PhotochemCAD, Photochemistry and Photobiology 68, 1998.",
    look: "The lamp shines at 365 nm, where the eye sees nothing: all light in the picture has changed its wavelength. The paper glows \
           too, by its brightener. Move the lamp through the spectrum: beyond 450 nm the yellow ink goes out, later the others.",
    question: "Red light on a red fluorescent ink makes no green light, but blue light makes red. Which law of physics forbids the \
               reverse, and how do two photons get around it?",
    parameters: &[
        Parameter::number("lamp", [320.0, 640.0], 365.0, "wavelength of the lamp").in_unit("nm"),
        Parameter::number("power", [0.0, 4.0], 1.0, "power of the lamp"),
        Parameter::number("room", [0.0, 1.0], 0.01, "daylight in the room"),
        Parameter::number("dye", [0.0, 1.0], 1.0, "share of the dyes, also of the paper's"),
    ],
    film_parameter: "lamp",
    pictures: &[
        StationPicture {
            name: "drawing",
            caption: "A drawing with highlighters below an ultraviolet lamp.",
            output: filmic(0.6),
            image_plane: |values| Box::new(HighlighterDrawing::new(values)),
        },
        StationPicture {
            name: "matrix",
            caption: "The reradiation matrix of the yellow ink: absorbed wavelength to the right, emitted wavelength upwards, from \
                      300 to 780 nm. The diagonal is ordinary reflection; nothing lies below it.",
            output: super::PLAIN,
            image_plane: |values| Box::new(MatrixPicture::new(&YELLOW, values.number("dye"))),
        },
    ],
    plot,
    checks,
};

/// The light of the lamp, a line some 10 nm wide.
fn lamp(values: &ParameterValues) -> WideSpectrum {
    let center = values.number("lamp");
    let line: WideSpectrum = std::array::from_fn(|band| bell(lambda_of(band), center, 5.0));
    let all: f64 = line.iter().sum();
    line.map(|light| values.number("power") * light / all)
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let series = figure.palette.series;
    let curve = |label: String, color: usize, value: &dyn Fn(usize) -> f64| PlotCurve {
        label,
        color: series[color],
        points: (0..ALL_BANDS).map(|band| [lambda_of(band), value(band)]).collect(),
    };
    // Of the lamp at power 1, so that the curves are as high for every power.
    let mut light = values.clone();
    light.set_value("power", gonio_light::DVec3::ONE);
    let light = lamp(&light);
    let dye = values.number("dye");
    let emitted = |ink: &inks::Ink| ink.matrix(dye).fluorescence(&light);
    let spectra = [&YELLOW, &ORANGE, &PAPER].map(|ink| (ink, emitted(ink)));
    let most = spectra.iter().flat_map(|(_, s)| s).fold(0.0_f64, |most, value| most.max(*value)).max(1e-9);
    let mut curves = vec![curve("yellow ink: share of light absorbed".to_owned(), 4, &|band| {
        dye * YELLOW.dye().absorbed(lambda_of(band))
    })];
    for ((ink, spectrum), color) in spectra.iter().zip([2, 1, 0]) {
        curves.push(curve(format!("{}: light emitted", ink.name), color, &|band| spectrum[band] / most));
    }
    let lamp_lambda = values.number("lamp");
    let axes = PlotAxes {
        title: format!("Light that changes its wavelength, under a lamp of {} nm", number(lamp_lambda)),
        x_label: "Wavelength (nm)",
        y_label: "Share; relative light".to_owned(),
        x: [300.0, 780.0],
        x_ticks: XTicks::Numbers,
        top: 1.2,
        scale: PlotScale::Linear,
        mark: Some((lamp_lambda, "lamp".to_owned())),
        level: None,
    };
    draw(figure, &curves, &axes)
}

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let (light, strength) = (lamp(values), values.number("dye"));
    let mut checks = Vec::new();
    for ink in [&YELLOW, &ORANGE] {
        let matrix = ink.matrix(strength);
        let emitted = matrix.fluorescence(&light);
        // By hand: the photons that the dye takes from the lamp, times its yield.
        let taken: f64 = (0..ALL_BANDS)
            .map(|band| light[band] * strength * ink.dye().absorbed(lambda_of(band)) * lambda_of(band))
            .sum();
        checks.push(LawCheck {
            quantity: format!("{}: photons emitted for each one absorbed (quantum yield)", ink.name),
            unit: "".into(),
            expected: if taken > 0.0 { ink.dye().quantum_yield } else { 0.0 },
            measured: if taken > 0.0 { photons(&emitted) / taken } else { 0.0 },
            bound: 1e-6,
        });
        let upwards = (0..ALL_BANDS).flat_map(|from| (0..from).map(move |to| (to, from)));
        checks.push(LawCheck {
            quantity: format!("{}: light moved to shorter wavelengths", ink.name),
            unit: "".into(),
            expected: 0.0,
            measured: upwards.map(|(to, from)| matrix.at(to, from).abs()).sum(),
            bound: 0.0,
        });
    }
    checks
}
