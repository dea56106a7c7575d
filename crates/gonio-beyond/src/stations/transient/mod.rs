//! The transient rendering equation: a flash crosses a table, seen in picoseconds.

mod bench;
mod flight;

use super::filmic;
use crate::camera::Ray;
use crate::random::mean_of;
use crate::station::{LawCheck, Station, StationPicture};
use bench::{EYE, LAMP, LIGHT_SPEED, arrivals, image};
use flight::{Arrivals, Flight, pulse, pulse_area};
use glam::DVec3;
use gonio_bsdf::sampling::SplitMix;
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::PlotScale;
use gonio_plot::{PlotError, PlotFigure};

/// The station.
pub const STATION: Station = Station {
    name: "transient",
    title: "The transient rendering equation",
    assumption: "Light is everywhere at once: the equation describes the steady state, in which all lamps have burned for ever.",
    nature: "Light travels 0.3 mm in a picosecond. A flash is a shell that grows: surfaces light up one after the other, each diffuse \
             point and each mirror sends its own shell, and a pixel receives a train of echoes. Cameras for such films exist, and lidar \
             measures distances with the first echo.",
    formula: "L_o(x, w, t) = L_e(x, w, t) + integral of f_r L_i(x, w_i, t - d / c) cos(theta_i)\n\
              each echo: t = (length of the path) / c, c = 0.0299792 cm/ps\n\
              sum over all t: the steady rendering equation",
    source: "A. Smith, J. Skorupski and J. Davis, Transient Rendering, UCSC 2008; A. Velten et al., Femto-Photography, SIGGRAPH 2013; A. \
             Jarabo et al., A Framework for Transient Rendering, SIGGRAPH Asia 2014.",
    look: "Lines are 10 cm apart: light needs 334 ps from one to the next. The flash of the lamp at the left runs over the table as a ring \
           and up the wall; the mirror sends a second ring back, as if from a lamp behind it. In the mirror everything happens later. A \
           weak blue lamp burns all the time so that the scene can be seen. In the second picture colours are times of arrival.",
    question: "The front on the table seems to run faster than light in some directions. How can that be?",
    parameters: &[
        Parameter::number("time", [2500.0, 6500.0], 4500.0, "time since the flash, at the camera").in_unit("ps"),
        Parameter::number("pulse", [5.0, 150.0], 45.0, "duration of the flash (standard deviation)").in_unit("ps"),
    ],
    film_parameter: "time",
    pictures: &[
        StationPicture {
            name: "flight",
            caption: "The light of a flash that arrives at the camera at one moment.",
            output: filmic(1.2),
            image_plane: |values| Box::new(Flight::new(values.number("time"), values.number("pulse"))),
        },
        StationPicture {
            name: "arrivals",
            caption: "All light, coloured by its time of arrival: hues repeat after 1000 ps, dark lines are 100 ps apart.",
            output: filmic(0.3),
            image_plane: |_| Box::new(Arrivals::new()),
        },
    ],
    plot,
    checks,
};

/// A place on the table that lamp and camera see, both also by the mirror.
const PLACE: DVec3 = DVec3::new(14.0, 0.0, -5.0);

/// The ray of the camera towards a place.
fn towards(place: DVec3) -> Ray {
    Ray { origin: EYE, direction: (place - EYE).normalize() }
}

/// Light per bin of `bin_ps` that arrives along a ray, and the sum of all light.
fn histogram(ray: &Ray, bin_ps: f64, bins: usize, samples: u32) -> (Vec<f64>, f64) {
    let mut found = vec![0.0; bins];
    let mut total = 0.0;
    let mut random = SplitMix::new(12);
    for _ in 0..samples {
        arrivals(ray, &mut random, &mut |(light, length)| {
            let light = light.y / f64::from(samples);
            total += light;
            if let Some(bin) = found.get_mut((length / LIGHT_SPEED / bin_ps) as usize) {
                *bin += light;
            }
        });
    }
    (found, total)
}

/// The times of the echoes that are not spread: straight from the lamp and by the mirror.
fn echoes(place: DVec3) -> [f64; 2] {
    [LAMP, image(LAMP)].map(|lamp| ((lamp - place).length() + (place - EYE).length()) / LIGHT_SPEED)
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    const BIN_PS: f64 = 20.0;
    let (light, total) = histogram(&towards(PLACE), BIN_PS, 360, 4000);
    let series = figure.palette.series;
    let bars = light.iter().enumerate().flat_map(|(bin, light)| {
        let [from, to] = [bin as f64 * BIN_PS, (bin + 1) as f64 * BIN_PS];
        [[from, light / total], [to, light / total]]
    });
    let [straight, mirrored] = echoes(PLACE);
    let echo = |label: &str, color: usize, time: f64| PlotCurve {
        label: format!("{label}: {:.1} cm / c", time * LIGHT_SPEED),
        color: series[color],
        points: vec![[time, 1e-5], [time, 0.9]],
    };
    let curves = [
        PlotCurve {
            label: "light of a pixel".to_owned(),
            color: series[0],
            points: bars.filter(|p| (2500.0..=6500.0).contains(&p[0])).collect(),
        },
        echo("lamp, table, camera", 1, straight),
        echo("lamp, mirror, table, camera", 2, mirrored),
    ];
    let axes = PlotAxes {
        title: "Time of flight at a pixel: the light of a flash on the table before the mirror".to_owned(),
        x_label: "Time since the flash (ps)",
        y_label: "Share of the light in 20 ps".to_owned(),
        x: [2500.0, 6500.0],
        x_ticks: XTicks::Numbers,
        top: 1.0,
        scale: PlotScale::Log,
        mark: Some((values.number("time"), "picture".to_owned())),
        level: None,
    };
    draw(figure, &curves, &axes)
}

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    const BIN_PS: f64 = 1.0;
    let mut checks = Vec::new();
    // Straight into the camera, and by the mirror: the place is looked at directly, and its mirror image too.
    let sights = [("", towards(PLACE), EYE), (" in the mirror", towards(image(PLACE)), image(EYE))];
    for (name, ray, eye) in sights {
        let (light, _) = histogram(&ray, BIN_PS, 9000, 400);
        for (by, lamp) in [("straight from the lamp", LAMP), ("by the mirror", image(LAMP))] {
            let expected = ((lamp - PLACE).length() + (PLACE - eye).length()) / LIGHT_SPEED;
            // The largest value of the histogram within 100 ps.
            let near = |bin: usize| (bin as f64 * BIN_PS - expected).abs() < 100.0;
            let peak = (0..light.len()).filter(|bin| near(*bin)).max_by(|a, b| light[*a].total_cmp(&light[*b]));
            checks.push(LawCheck {
                quantity: format!("echo of the table{name}, {by}: path length / c, against the histogram's peak"),
                unit: "ps".into(),
                expected,
                measured: peak.map_or(f64::NAN, |bin| (bin as f64 + 0.5) * BIN_PS),
                bound: 0.5 * BIN_PS + 0.1,
            });
        }
    }
    // The film of a pixel: each of its frames by paths of its own.
    let width = values.number("pulse");
    let film = |random: &mut SplitMix| {
        let mut sum = 0.0;
        let frame = 0.5 * width;
        arrivals(&towards(PLACE), random, &mut |(light, length)| {
            let time = length / LIGHT_SPEED;
            // Frames far from the path's own time receive nothing of it.
            let nearest = (time / frame).round();
            let frames = (-16..=16).map(|index| (nearest + f64::from(index)) * frame);
            sum += light.y * frames.map(|at| pulse(at - time, width) * frame / pulse_area(width)).sum::<f64>();
        });
        sum
    };
    let steady = |random: &mut SplitMix| {
        let mut sum = 0.0;
        arrivals(&towards(PLACE), random, &mut |(light, _)| sum += light.y);
        sum
    };
    let [mut for_film, mut for_steady] = [13, 14].map(SplitMix::new);
    let [film, film_error] = mean_of((0..4000).map(|_| film(&mut for_film)));
    let [steady, steady_error] = mean_of((0..4000).map(|_| steady(&mut for_steady)));
    checks.push(LawCheck {
        quantity: "sum of all frames of a film, against the steady picture".to_owned(),
        unit: "".into(),
        expected: steady,
        measured: film,
        bound: 4.0 * film_error.hypot(steady_error),
    });
    checks
}
