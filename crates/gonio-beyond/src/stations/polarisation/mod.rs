//! Polarisation: a polariser before a pond takes the sky from the water.

mod mueller;
mod pond;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_light::optics::polarised_dielectric;
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use mueller::{UNPOLARISED, boundary, degree_of_polarisation, polarised, polariser};
use pond::{Pond, PondValue};

/// The station.
pub const STATION: Station = Station {
    name: "polarisation",
    title: "Polarisation",
    assumption: "Light is one number for each wavelength: its radiance. A mirror reflects the same share of all light that \
                 arrives at an angle.",
    nature: "Light is a transverse wave, and its field swings in some direction across the ray. A smooth surface reflects light \
             that swings across the plane of incidence (s) better than light that swings in it (p). At Brewster's angle it reflects \
             no p light at all: the reflection is completely polarised, and a polariser can take it away.",
    formula: "R_s = |(cos i - n cos t) / (cos i + n cos t)|^2    R_p = |(n cos i - cos t) / (n cos i + cos t)|^2    sin i = n sin t\n\
              tan(i_Brewster) = n\n\
              I = I_0 cos^2(a)    (Malus: polarised light behind a polariser turned by a)",
    source: "A. Fresnel 1823; E. L. Malus 1809; D. Brewster 1815; M. Born and E. Wolf, Principles of Optics, sections 1.5.2 and \
             1.5.3; Stokes vectors and Mueller matrices: E. Collett, Field Guide to Polarization, 2005.",
    look: "Inside the filter the sky's reflection disappears where you look at the water at Brewster's angle, and the stones show. \
           Turn the filter by 90 degrees: the reflection is back. The sky itself is polarised too, most at a right angle to the sun.",
    question: "Why do polarising sunglasses let through light that swings vertically, and what happens when you lie down on a beach?",
    parameters: &[
        Parameter::number("angle", [0.0, 180.0], 90.0, "axis of the filter from the horizontal").in_unit("degrees"),
        Parameter::number("index", [1.05, 2.0], 1.333, "index of refraction of the water"),
        Parameter::number("ripples", [0.0, 2.0], 0.6, "height of the ripples"),
        Parameter::switch("filter", true, "the polariser in front of the picture"),
    ],
    film_parameter: "angle",
    pictures: &[
        StationPicture {
            name: "pond",
            caption: "A pond through a polarising filter. The marks on its rim show its axis.",
            output: filmic(-0.3),
            image_plane: |values| Box::new(Pond::new(values, PondValue::Light)),
        },
        StationPicture {
            name: "degree",
            caption: "The degree of polarisation of the light from the pond, from dark blue (0) to yellow (1).",
            output: super::PLAIN,
            image_plane: |values| Box::new(Pond::new(values, PondValue::Degree)),
        },
    ],
    plot,
    checks,
};

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let index = values.number("index");
    let series = figure.palette.series;
    let curve = |label: &str, color: usize, value: &dyn Fn(f64) -> f64| PlotCurve {
        label: label.to_owned(),
        color: series[color],
        points: (0..=900).map(|step| 0.1 * f64::from(step)).map(|x| [x, value(x.to_radians().cos())]).collect(),
    };
    let curves = [
        curve("degree of polarisation of the reflection", 2, &|cos| {
            degree_of_polarisation(boundary(cos, 1.0, index)[0] * UNPOLARISED)
        }),
        curve("R_s", 0, &|cos| polarised_dielectric(cos, 1.0 / index)[0]),
        curve("R_p", 1, &|cos| polarised_dielectric(cos, 1.0 / index)[1]),
    ];
    let brewster = index.atan().to_degrees();
    let axes = PlotAxes {
        title: format!("Reflection of unpolarised light by a surface of index {}", number(index)),
        x_label: "Angle of incidence (degrees)",
        y_label: "Share of the light".to_owned(),
        x: [0.0, 90.0],
        x_ticks: XTicks::Angles,
        top: 1.2,
        scale: PlotScale::Linear,
        mark: Some((brewster, format!("Brewster's angle {brewster:.2}°"))),
        level: None,
    };
    draw(figure, &curves, &axes)
}

/// Angles of incidence of the check, degrees.
const CHECKED_DEG: [f64; 4] = [20.0, 40.0, 60.0, 80.0];

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let index = values.number("index");
    let reflected = |angle: f64, q: f64| (boundary(angle.cos(), 1.0, index)[0] * polarised(q)).x;
    let mut checks = Vec::new();
    for degrees in CHECKED_DEG {
        let i = degrees.to_radians();
        let t = (i.sin() / index).asin();
        // Fresnel's laws of sines and tangents; the matrices come from the boundary conditions.
        let laws = [((i - t).sin() / (i + t).sin()).powi(2), ((i - t).tan() / (i + t).tan()).powi(2)];
        for ((name, q), expected) in [("R_s", 1.0), ("R_p", -1.0)].into_iter().zip(laws) {
            checks.push(LawCheck {
                quantity: format!("{name} at {degrees} degrees"),
                unit: "".into(),
                expected,
                measured: reflected(i, q),
                bound: 1e-6,
            });
        }
    }
    let least = least(|angle| reflected(angle, -1.0), 0.1, 1.5);
    checks.push(LawCheck {
        quantity: "angle of the least reflection of p light".to_owned(),
        unit: "degrees".into(),
        expected: index.atan().to_degrees(),
        measured: least.to_degrees(),
        bound: 1e-4,
    });
    let brewster = boundary(index.atan().cos(), 1.0, index)[0] * UNPOLARISED;
    checks.push(LawCheck {
        quantity: "degree of polarisation of the reflection at Brewster's angle".to_owned(),
        unit: "".into(),
        expected: 1.0,
        measured: degree_of_polarisation(brewster),
        bound: 1e-6,
    });
    // The reflection is polarised along x, so that Malus's law begins there.
    let behind = |degrees: f64| (polariser(degrees.to_radians()) * brewster).x / brewster.x;
    for degrees in [0.0, 30.0, 60.0, 90.0] {
        checks.push(LawCheck {
            quantity: format!("share of that reflection behind a filter turned by {degrees} degrees"),
            unit: "".into(),
            expected: f64::to_radians(degrees).cos().powi(2),
            measured: behind(degrees),
            bound: 1e-6,
        });
    }
    checks
}

/// The place of the least value between two others, by thirds.
fn least(value: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    while to - from > 1e-9 {
        let third = (to - from) / 3.0;
        if value(from + third) < value(to - third) {
            to -= third;
        } else {
            from += third;
        }
    }
    0.5 * (from + to)
}
