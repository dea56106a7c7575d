//! The relativistic Doppler effect: dice that pass, and a flight through a colonnade.

mod colonnade;
mod dice;
mod lorentz;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use colonnade::Colonnade;
use dice::Dice;
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use lorentz::{Effects, aberrated_cos, aberration_by_events, doppler_by_crests, doppler_factor, energy_density, gamma};

/// The station.
pub const STATION: Station = Station {
    name: "doppler",
    title: "Relativistic Doppler effect",
    assumption: "Everything is at rest, or so slow that light arrives at once: light keeps its wavelength and direction, whoever looks.",
    nature: "Light of a body that approaches is compressed: its wavelength is shorter, more photons arrive per second, and they come \
             from a smaller cone (the searchlight effect). Behind it everything is stretched. Light also needs time, so different parts \
             of a fast body are seen at different moments: it looks turned and not shortened.",
    formula: "D = 1 / (gamma (1 - v cos theta'))    lambda' = lambda / D    gamma = 1 / sqrt(1 - v^2)    (v in units of c)\n\
              cos theta' = (cos theta + v) / (1 + v cos theta)\n\
              L'(lambda') = D^5 L(D lambda')",
    source: "A. Einstein, Annalen der Physik 17, 1905, sections 7 and 8; R. Penrose and J. Terrell 1959 for the shape of fast bodies; \
             D. Weiskopf, U. Kraus and H. Ruder, ACM Transactions on Graphics 18(3), 1999.",
    look: "The dice drive to the right. They are green where nothing moves. Those that approach are blue and bright, those that leave are red \
           and dark; all are turned and show their back. Switch the effects off one by one. In the flight the view is drawn together ahead, and the grass beside is red: leaves reflect infrared light.",
    question: "Why do you see the back of a die that passes, although it is exactly beside you?",
    parameters: &[
        Parameter::number("speed", [0.0, 0.9], 0.35, "speed as a share of that of light"),
        Parameter::number("position", [-8.0, 8.0], 0.0, "place at which the middle die is seen").in_unit("m"),
        Parameter::switch("doppler", true, "shift of wavelengths"),
        Parameter::switch("searchlight", true, "change of the number of photons"),
        Parameter::switch("aberration", true, "finite speed of light: directions and shapes"),
    ],
    film_parameter: "speed",
    pictures: &[
        StationPicture {
            name: "passing",
            caption: "Dice that drive past from left to right.",
            output: filmic(0.2),
            image_plane: |values| Box::new(Dice::new(&effects(values), values.number("position"))),
        },
        StationPicture {
            name: "flight",
            caption: "A flight through a colonnade.",
            output: filmic(-1.7),
            image_plane: |values| Box::new(Colonnade::new(&effects(values))),
        },
    ],
    plot,
    checks,
};

fn effects(values: &ParameterValues) -> Effects {
    Effects {
        speed: values.number("speed"),
        doppler: values.is_on("doppler"),
        searchlight: values.is_on("searchlight"),
        aberration: values.is_on("aberration"),
    }
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let speed = values.number("speed");
    let series = figure.palette.series;
    let curve = |label: &str, color: usize, value: &dyn Fn(f64) -> f64| PlotCurve {
        label: label.to_owned(),
        color: series[color],
        points: (0..=720).map(|step| 0.25 * f64::from(step)).map(|x| [x, value(x.to_radians().cos())]).collect(),
    };
    let d = |cos: f64| doppler_factor(speed, cos);
    let curves = [
        curve("frequency, D", 0, &d),
        curve("photons from a lamp, D^3", 2, &|cos| d(cos).powi(3)),
        curve("radiance of all wavelengths, D^4", 1, &|cos| d(cos).powi(4)),
    ];
    let axes = PlotAxes {
        title: format!("Light that a traveller at {} c sees", number(speed)),
        x_label: "Direction of sight from that of motion (degrees)",
        y_label: "Factor".to_owned(),
        x: [0.0, 180.0],
        x_ticks: XTicks::Angles,
        top: PlotScale::CubeRoot.end(d(1.0).powi(4)),
        scale: PlotScale::CubeRoot,
        mark: Some((speed.acos().to_degrees(), "abeam at rest".to_owned())),
        level: Some(1.0),
    };
    draw(figure, &curves, &axes)
}

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let speed = values.number("speed");
    let mut checks = Vec::new();
    for along in [-3.0, -1.0, 0.0, 2.0] {
        let [measured, cos] = doppler_by_crests(speed, along);
        checks.push(LawCheck {
            quantity: format!(
                "Doppler factor {:.1} degrees from the direction of approach, by two crests",
                cos.acos().to_degrees()
            ),
            unit: "".into(),
            expected: doppler_factor(speed, cos),
            measured,
            bound: 1e-6,
        });
    }
    for degrees in [30.0, 60.0, 90.0, 120.0] {
        let cos = f64::cos(f64::to_radians(degrees));
        checks.push(LawCheck {
            quantity: format!("angle at rest of what is seen at {degrees} degrees, by two events"),
            unit: "degrees".into(),
            expected: aberrated_cos(speed, cos).acos().to_degrees(),
            measured: aberration_by_events(speed, cos).acos().to_degrees(),
            bound: 1e-6,
        });
    }
    checks.push(LawCheck {
        quantity: "energy density in an even field, by the sum over all directions".to_owned(),
        unit: "".into(),
        expected: gamma(speed).powi(2) * (1.0 + speed * speed / 3.0),
        measured: energy_density(speed),
        bound: 1e-5,
    });
    checks
}
