//! Phosphorescence: stars on a bedroom wall glow after the lamp has gone out.

mod decay;
mod night;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use decay::{ALL, GREEN};
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::PlotScale;
use gonio_plot::{PlotError, PlotFigure};
use night::Night;

/// The station.
pub const STATION: Station = Station {
    name: "phosphorescence",
    title: "Phosphorescence",
    assumption: "Light leaves a surface at the moment at which it arrives: the same t stands on both sides of the equation. When the \
                 lamp goes out, the picture is black.",
    nature: "A phosphor keeps the energy of absorbed photons in traps and gives it back slowly, at a longer wavelength. It glows when \
             the lamp is out, and the glow decays exponentially, each pigment with its own time.",
    formula: "dn/dt = p (1 - n) - n / tau  (lamp on)      dn/dt = -n / tau  (lamp off)\n\
              n(t) = n(0) e^(-t / tau)      glow = n / tau\n\
              photons absorbed = photons emitted + full traps",
    source: "E. Becquerel 1861; G. Blasse and B. C. Grabmaier, Luminescent Materials, 1994, section 3.4; pigments: T. Matsuzawa et al., \
             Journal of the Electrochemical Society 143, 1996.",
    look: "At a negative `time` the lamp still shines. Just after it the fast pigments, red and blue, are the brightest for their \
           charge; after half a minute only the green stars are left.",
    question: "Charge the stars for one second and for ten: do they glow ten times as brightly? Why not?",
    parameters: &[
        Parameter::number("time", [-2.0, 60.0], 3.0, "time since the lamp went out").in_unit("s"),
        Parameter::number("charge", [0.1, 30.0], 6.0, "time for which the lamp was on").in_unit("s"),
    ],
    film_parameter: "time",
    pictures: &[StationPicture {
        name: "stars",
        caption: "Stars, a moon and planets of phosphorescent plastic on a wall.",
        output: filmic(1.0),
        image_plane: |values| Box::new(Night::new(values.number("time"), values.number("charge"))),
    }],
    plot,
    checks,
};

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let charge = values.number("charge");
    let series = figure.palette.series;
    let start = -charge.min(10.0);
    let curves: Vec<PlotCurve> = ALL
        .iter()
        .zip([2, 6, 0, 1])
        .map(|(phosphor, color)| PlotCurve {
            label: phosphor.name.to_owned(),
            color: series[color],
            points: (0..=1400)
                .map(|index| start + (60.0 - start) * f64::from(index) / 1400.0)
                .map(|time| [time, phosphor.emitted(time, charge)])
                .collect(),
        })
        .collect();
    let axes = PlotAxes {
        title: "Glow of the pigments: straight lines on a logarithmic scale".to_owned(),
        x_label: "Time since the lamp went out (s)",
        y_label: "Photons per trap (1/s)".to_owned(),
        x: [start, 60.0],
        x_ticks: XTicks::Numbers,
        top: 1.0,
        scale: PlotScale::Log,
        mark: Some((values.number("time"), "picture".to_owned())),
        level: None,
    };
    draw(figure, &curves, &axes)
}

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let charge = values.number("charge");
    let mut checks = Vec::new();
    for phosphor in ALL {
        let at = |time: f64| phosphor.simulated(time, charge)[0];
        checks.push(LawCheck {
            quantity: format!("{}: glow at 1 s plus the decay time, relative to that at 1 s", phosphor.name),
            unit: "".into(),
            expected: (-1.0_f64).exp(),
            measured: at(1.0 + phosphor.decay_s) / at(1.0),
            bound: 1e-6,
        });
        let [_, absorbed, emitted] = phosphor.simulated(30.0 * phosphor.decay_s, charge);
        checks.push(LawCheck {
            quantity: format!("{}: photons emitted in the end for each one absorbed", phosphor.name),
            unit: "".into(),
            expected: 1.0,
            measured: emitted / absorbed,
            bound: 1e-6,
        });
    }
    let time = values.number("time");
    checks.push(LawCheck {
        quantity: format!("{}: share of full traps at {time} s", GREEN.name),
        unit: "".into(),
        expected: GREEN.filled(time, charge),
        measured: GREEN.simulated(time, charge)[0],
        bound: 1e-6,
    });
    checks
}
