//! Interference: soap films, bubbles, oil on water, and the grooves of a disc.

mod airy;
mod disc;
mod films;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use airy::{ThinFilm, brightest_sines, order_sine};
use disc::Disc;
use films::{Bubbles, Puddle, Wand};
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_light::optics::polarised_dielectric;
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use std::f64::consts::TAU;

/// The station.
pub const STATION: Station = Station {
    name: "interference",
    title: "Interference",
    assumption: "Light from different places adds up as radiance: two lamps are never darker than one. A surface without pigment has \
                 no colour.",
    nature: "Light is a wave, and waves that meet add their amplitudes. The waves from the two sides of a film, or from the grooves \
             of a grating, strengthen each other where their paths differ by whole wavelengths, and cancel where they differ by half \
             ones. So the colour depends on the thickness of the film and on the angle.",
    formula: "R = |(r_1 + r_2 e^(i phi)) / (1 + r_1 r_2 e^(i phi))|^2    phi = 2 pi (2 n d cos t) / lambda    (film)\n\
              sin(theta_m) = sin(theta_i) + m lambda / d    (grating with grooves at the distance d)",
    source: "G. B. Airy 1833, J. Fraunhofer 1821; M. Born and E. Wolf, Principles of Optics, sections 7.6.1 and 8.6.1; daylight and \
             eye: CIE 15.",
    look: "The film on the wand is thin at the top and thick at the bottom. Where it is thinner than about 30 nm it is black: the \
           waves of its two sides cancel for all wavelengths, because one of them is turned over. Let it drain with `time`: the bands \
           move downwards. On the disc each lamp is spread into its orders.",
    question: "The path through the film shrinks when it is seen at a glancing angle. Which way does its colour change then?",
    parameters: &[
        Parameter::number("thickness", [50.0, 3000.0], 900.0, "thickness of the film when it is new").in_unit("nm"),
        Parameter::number("time", [0.0, 60.0], 12.0, "time for which the film has drained").in_unit("s"),
        Parameter::number("index", [1.05, 2.0], 1.333, "index of refraction of soap film and bubbles"),
        Parameter::number("pitch", [500.0, 5000.0], 1600.0, "distance of the disc's grooves").in_unit("nm"),
    ],
    film_parameter: "time",
    pictures: &[
        StationPicture {
            name: "wand",
            caption: "A soap film on a wand before a dark wall, lit by a white panel. It drains and becomes black at the top.",
            output: filmic(2.2),
            image_plane: |values| Box::new(Wand::new(values)),
        },
        StationPicture {
            name: "bubbles",
            caption: "Soap bubbles in the evening: their outer and inner sides reflect the sky.",
            output: filmic(0.4),
            image_plane: |values| Box::new(Bubbles::new(values)),
        },
        StationPicture {
            name: "puddle",
            caption: "Oil on a puddle. Each ring is a line of equal thickness.",
            output: filmic(1.6),
            image_plane: |values| Box::new(Puddle::new(values)),
        },
        StationPicture {
            name: "disc",
            caption: "A compact disc below three lamps: a grating whose orders depend on the place.",
            output: filmic(0.2),
            image_plane: |values| Box::new(Disc::new(values)),
        },
    ],
    plot,
    checks,
};

/// The film at the bottom of the wand.
fn film(values: &ParameterValues) -> ThinFilm {
    let thickness_nm = values.number("thickness") * films::drained(values.number("time"));
    ThinFilm { index: values.number("index"), index_below: 1.0, thickness_nm }
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let film = film(values);
    let series = figure.palette.series;
    let curve = |label: &str, color: usize, film: ThinFilm, degrees: f64| {
        let boundaries = film.boundaries(degrees.to_radians().cos());
        let points = (3800..=7800).step_by(5).map(|l| 0.1 * f64::from(l)).map(|l| [l, boundaries.reflectance(l)]);
        PlotCurve { label: label.to_owned(), color: series[color], points: points.collect() }
    };
    let tenth = ThinFilm { thickness_nm: 0.1 * film.thickness_nm, ..film };
    let curves = [
        curve("seen from ahead", 0, film, 0.0),
        curve("seen at 60°", 1, film, 60.0),
        curve("a tenth as thick", 4, tenth, 0.0),
    ];
    let top = curves.iter().flat_map(|curve| &curve.points).fold(0.0_f64, |most, point| most.max(point[1]));
    let axes = PlotAxes {
        title: format!("Reflectance of a film of {} nm and index {}", number(film.thickness_nm), number(film.index)),
        x_label: "Wavelength (nm)",
        y_label: "Reflectance".to_owned(),
        x: [380.0, 780.0],
        x_ticks: XTicks::Numbers,
        top: PlotScale::Linear.end(1.15 * top),
        scale: PlotScale::Linear,
        mark: None,
        level: None,
    };
    draw(figure, &curves, &axes)
}

/// The angle of incidence of the checks, degrees.
const CHECKED_DEG: f64 = 40.0;

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let film = film(values);
    let cos_i = CHECKED_DEG.to_radians().cos();
    let boundaries = film.boundaries(cos_i);
    let cos_t = (1.0 - (1.0 - cos_i * cos_i) / film.index.powi(2)).sqrt();
    let mut checks = Vec::new();
    for lambda in [400.0, 480.0, 550.0, 620.0, 700.0] {
        // Airy's formula for equal media on both sides; the value found is the sum of 80 waves.
        let sin2 = (TAU * film.index * film.thickness_nm * cos_t / lambda).sin().powi(2);
        let airy = polarised_dielectric(cos_i, 1.0 / film.index).map(|r| {
            let finesse = 4.0 * r / (1.0 - r).powi(2);
            finesse * sin2 / (1.0 + finesse * sin2)
        });
        checks.push(LawCheck {
            quantity: format!("reflectance of {:.0} nm at {lambda} nm and {CHECKED_DEG} degrees", film.thickness_nm),
            unit: "".into(),
            expected: 0.5 * (airy[0] + airy[1]),
            measured: boundaries.sum_of_waves(lambda, 80),
            bound: 1e-6,
        });
    }
    let (sin_i, pitch, lambda) = (0.2, values.number("pitch"), 550.0);
    let found = brightest_sines(sin_i, lambda, pitch);
    for order in -2..=2 {
        let Some(expected) = order_sine(sin_i, order, lambda, pitch) else { continue };
        let nearest = found.iter().copied().min_by(|a, b| (a - expected).abs().total_cmp(&(b - expected).abs()));
        checks.push(LawCheck {
            quantity: format!("sine of the angle of order {order} of the disc at {lambda} nm"),
            unit: "".into(),
            expected,
            measured: nearest.unwrap_or(f64::INFINITY),
            bound: 1e-6,
        });
    }
    checks
}
