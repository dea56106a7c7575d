//! Non-linear effects: light that is absorbed two photons at a time, and light of twice the frequency.

mod beam;
mod laboratory;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use beam::{GaussianBeam, harmonic_by_steps, second_harmonic};
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::PlotScale;
use gonio_plot::{PlotError, PlotFigure};
use laboratory::{Crystal, Cuvette};
use std::f64::consts::PI;

/// The station.
pub const STATION: Station = Station {
    name: "nonlinear",
    title: "Non-linear effects",
    assumption: "Radiance is linear: twice the light in, twice the light out. Colours of light add and never make each other.",
    nature: "Where light is intense enough, a molecule absorbs two photons at the same moment, and a crystal makes one photon of twice \
             the frequency out of two. Both need two photons in one place: they grow with the square of the light and happen only where \
             it is concentrated.",
    formula: "two-photon glow = c I^2      I(r, z) = 2 P / (pi w^2) e^(-2 r^2 / w^2)      w(z) = w_0 sqrt(1 + (z / z_R)^2)\n\
              P(2 nu) = P tanh^2(k sqrt(P) L)    (second harmonic; k^2 L^2 P^2 as long as it is small)",
    source: "M. Göppert-Mayer 1931; P. A. Franken et al. 1961; H. Kogelnik and T. Li, Applied Optics 5, 1966; J. A. Armstrong et al., \
             Physical Review 127, 1962.",
    look: "Both beams are focused in the same dye. The blue one is absorbed one photon at a time: it glows along its whole way. The \
           infrared one, which the eye does not see, glows at its focus only. In the crystal green light grows out of infrared light. \
           Double the power: the lower glow becomes four times as bright.",
    question: "Why do microscopes for living brains use two-photon absorption, although it needs far stronger lasers?",
    parameters: &[
        Parameter::number("power", [0.1, 4.0], 1.0, "power of both beams"),
        Parameter::number("focus", [0.02, 0.6], 0.07, "Rayleigh range: length of the focus").in_unit("cm"),
        Parameter::number("coupling", [0.05, 2.0], 0.9, "strength of the crystal"),
    ],
    film_parameter: "power",
    pictures: &[
        StationPicture {
            name: "cuvette",
            caption: "Two focused beams in a green dye: one photon at a time above, two at a time below.",
            output: filmic(0.3),
            image_plane: |values| Box::new(Cuvette::new(values.number("power"), values.number("focus"))),
        },
        StationPicture {
            name: "crystal",
            caption: "A crystal turns infrared light of 1064 nm, which is drawn dark red, into green light of 532 nm.",
            output: filmic(0.3),
            image_plane: |values| Box::new(Crystal::new(values.number("power"), values.number("coupling"))),
        },
    ],
    plot,
    checks,
};

/// Convergence of the beams: `w_0 / z_R`.
const CONVERGENCE: f64 = 0.13;

/// The beam with a Rayleigh range; lengths in cm.
fn beam(power: f64, rayleigh_range: f64) -> GaussianBeam {
    GaussianBeam { power, waist: CONVERGENCE * rayleigh_range, rayleigh_range }
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let coupling = values.number("coupling");
    let series = figure.palette.series;
    let curve = |label: &str, color: usize, value: &dyn Fn(f64) -> f64| PlotCurve {
        label: label.to_owned(),
        color: series[color],
        points: (0..=400).map(|step| 0.01 * f64::from(step)).map(|power| [power, value(power)]).collect(),
    };
    let curves = [
        curve("one-photon glow", 0, &|power| power),
        curve("two-photon glow", 2, &|power| power * power),
        curve("second harmonic of the crystal", 1, &|power| second_harmonic(power, coupling)),
    ];
    let axes = PlotAxes {
        title: "Response to light, relative to that at power 1".to_owned(),
        x_label: "Power (relative)",
        y_label: "Response, relative".to_owned(),
        x: [0.0, 4.0],
        x_ticks: XTicks::Numbers,
        top: 8.0,
        scale: PlotScale::Linear,
        mark: Some((values.number("power"), "picture".to_owned())),
        level: None,
    };
    // Values above the axis would run along its top.
    let curves = curves.map(|mut curve| {
        curve.points.retain(|point| point[1] <= axes.top);
        curve
    });
    draw(figure, &curves, &axes)
}

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let [power, range, coupling] = ["power", "focus", "coupling"].map(|name| values.number(name));
    let (one, two) = (beam(power, range), beam(2.0 * power, range));
    let check = |quantity: &str, expected: f64, measured: f64, bound: f64| LawCheck {
        quantity: quantity.to_owned(),
        unit: "".into(),
        expected,
        measured,
        bound,
    };
    let everything = power * power / (PI * one.waist.powi(2)) * PI * range;
    let [_, harmonic] = harmonic_by_steps(power, coupling);
    let weak = |power: f64| harmonic_by_steps(power, coupling)[1];
    vec![
        check(
            "one-photon glow at twice the power, by the sum over the beam",
            2.0,
            two.glow(1, 1.0) / one.glow(1, 1.0),
            1e-6,
        ),
        check(
            "two-photon glow at twice the power, by the sum over the beam",
            4.0,
            two.glow(2, 1.0) / one.glow(2, 1.0),
            1e-6,
        ),
        check(
            "one-photon glow at 3 Rayleigh ranges, relative to the focus",
            1.0,
            one.slice(1, 3.0 * range) / one.slice(1, 0.0),
            1e-6,
        ),
        check(
            "two-photon glow at 3 Rayleigh ranges, relative to the focus",
            0.1,
            one.slice(2, 3.0 * range) / one.slice(2, 0.0),
            1e-6,
        ),
        check("share of the two-photon glow within the Rayleigh range", 0.5, one.glow(2, range) / everything, 1e-5),
        check("power of the second harmonic, by small steps", second_harmonic(power, coupling), harmonic, 1e-6),
        check("exponent of the second harmonic in weak light", 2.0, (weak(2e-6) / weak(1e-6)).log2(), 1e-4),
    ]
}
