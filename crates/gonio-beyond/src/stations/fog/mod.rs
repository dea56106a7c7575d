//! The volume rendering equation: a spotlight's cone and a fire in fog.

mod air;
mod hall;
mod tracking;

use super::filmic;
use crate::random::mean_of;
use crate::station::{LawCheck, Station, StationPicture};
use air::Fog;
use glam::DVec3;
use gonio_bsdf::sampling::SplitMix;
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use hall::Hall;
use std::f64::consts::TAU;
use tracking::{delta_track, phase, ratio_track, scatter};

/// The station.
pub const STATION: Station = Station {
    name: "fog",
    title: "The volume rendering equation",
    assumption: "Between surfaces there is nothing: radiance stays the same along a ray from one surface to the next.",
    nature: "Air with fog, smoke or dust takes light from a ray by absorption and scattering, and adds light by emission and by \
             scattering from other directions. A beam becomes visible from the side, distant things fade, and flames shine although \
             they have no surface.",
    formula: "dL/ds = -s_t L + s_a L_e + s_s integral over the sphere of p(cos) L_i\n\
              T = exp(-integral of s_t ds)      p(cos) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2))\n\
              slab, scattered once: L = w p F mu_0 / (mu + mu_0) (1 - e^(-t (1 / mu + 1 / mu_0)))",
    source: "S. Chandrasekhar, Radiative Transfer, 1950, chapters I and III; L. G. Henyey and J. L. Greenstein, Astrophysical Journal 93, \
             1941; delta tracking: E. R. Woodcock et al. 1965; ratio tracking: J. Novák et al., SIGGRAPH Asia 2014.",
    look: "The spotlight's cone is visible because fog scatters its light to the camera: bars in the lamp and the ball cut shadows out of \
           the air. The fire's flame is a medium that emits. Far columns fade. Set `g` to 0.9 and to -0.9: the cone fades where light would \
           have to turn towards the camera. Make the fog patchy, or as dense as soup.",
    question: "Why should headlights of cars be mounted low and dimmed in fog?",
    parameters: &[
        Parameter::number("density", [0.0, 0.5], 0.09, "extinction of the fog").in_unit("1/m"),
        Parameter::number("g", [-0.9, 0.9], 0.3, "mean cosine of scattering: -0.9 backwards, 0.9 forwards"),
        Parameter::number("patchiness", [0.0, 1.0], 0.5, "from even fog to separate clouds"),
        Parameter::number("albedo", [0.0, 1.0], 0.95, "share of an event's light that is scattered"),
    ],
    film_parameter: "density",
    pictures: &[StationPicture {
        name: "hall",
        caption: "A hall with fog, a spotlight with bars before its lens, and a fire.",
        output: filmic(1.3),
        image_plane: |values| Box::new(Hall::new(fog(values))),
    }],
    plot,
    checks,
};

fn fog(values: &ParameterValues) -> Fog {
    let [density, patchiness, albedo, g] = ["density", "patchiness", "albedo", "g"].map(|name| values.number(name));
    Fog { density, patchiness, albedo, g }
}

/// The place and direction of a ray through the fog: across the hall.
const START: DVec3 = DVec3::new(-6.0, 1.5, -1.0);

/// Paths that pass a distance, and transmittances, by both kinds of tracking.
fn tracked(fog: &Fog, reach: f64, paths: u32) -> [[f64; 2]; 2] {
    let extinction = |s: f64| fog.extinction(START + DVec3::X * s);
    let mut random = SplitMix::new(9);
    let passes =
        (0..paths).map(|_| f64::from(u8::from(delta_track(&extinction, fog.majorant(), reach, &mut random).is_none())));
    let delta = mean_of(passes);
    let ratio = mean_of((0..paths).map(|_| ratio_track(&extinction, fog.majorant(), reach, &mut random)));
    [delta, ratio]
}

/// The optical depth along the ray, by small steps.
fn depth(fog: &Fog, reach: f64) -> f64 {
    const STEPS: u32 = 4000;
    let at = |step: u32| START + DVec3::X * (reach * (f64::from(step) + 0.5) / f64::from(STEPS));
    (0..STEPS).map(|step| fog.extinction(at(step))).sum::<f64>() * reach / f64::from(STEPS)
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    const PATHS: u32 = 300;
    let fog = fog(values);
    let even = Fog { patchiness: 0.0, ..fog };
    let series = figure.palette.series;
    let places: Vec<f64> = (0..=80).map(|step| 0.25 * f64::from(step)).collect();
    let curve = |label: &str, color: usize, value: &dyn Fn(f64) -> f64| PlotCurve {
        label: label.to_owned(),
        color: series[color],
        points: places.iter().map(|&x| [x, value(x)]).collect(),
    };
    let curves = [
        curve("even fog, closed form", 6, &|x| (-even.density * x).exp()),
        curve("this fog, by small steps", 0, &|x| (-depth(&fog, x)).exp()),
        curve(&format!("delta tracking, {PATHS} paths"), 1, &|x| tracked(&fog, x, PATHS)[0][0]),
        curve(&format!("ratio tracking, {PATHS} paths"), 2, &|x| tracked(&fog, x, PATHS)[1][0]),
    ];
    let axes = PlotAxes {
        title: format!("Light that passes fog with an extinction of {} per metre", number(fog.density)),
        x_label: "Distance (m)",
        y_label: "Transmittance".to_owned(),
        x: [0.0, 20.0],
        x_ticks: XTicks::Numbers,
        top: 1.2,
        scale: PlotScale::Linear,
        mark: None,
        level: None,
    };
    draw(figure, &curves, &axes)
}

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    const PATHS: u32 = 20_000;
    let fog = fog(values);
    let check = |quantity: String, expected: f64, [measured, error]: [f64; 2]| LawCheck {
        quantity,
        unit: "".into(),
        expected,
        measured,
        bound: 4.0 * error + 1e-9,
    };
    let even = Fog { patchiness: 0.0, ..fog };
    let mut checks = Vec::new();
    let reach = 8.0;
    let [delta, ratio] = tracked(&even, reach, PATHS);
    let expected = (-even.density * reach).exp();
    checks.push(check(format!("light through {reach} m of even fog, by delta tracking"), expected, delta));
    // Ratio tracking is exact where the extinction is the majorant everywhere: then a step ends each path.
    checks.push(check(format!("light through {reach} m of even fog, by ratio tracking"), expected, ratio));
    let [delta, ratio] = tracked(&fog, reach, PATHS);
    let both = [delta[0], delta[1].hypot(ratio[1])];
    checks.push(check(format!("light through {reach} m of this fog, delta against ratio tracking"), ratio[0], both));
    // A ray through waves of extinction whose integral is known.
    let wave = |s: f64| 1.0 + 0.8 * (TAU * s).sin();
    let depth = 1.3 + 0.8 * (1.0 - (TAU * 1.3).cos()) / TAU;
    let mut random = SplitMix::new(10);
    let ratio = mean_of((0..PATHS).map(|_| ratio_track(&wave, 1.8, 1.3, &mut random)));
    checks.push(check("light through waves of extinction, by ratio tracking".to_owned(), (-depth).exp(), ratio));
    checks.push(single_scattering(&fog, PATHS));
    let cosines = mean_of((0..PATHS).map(|_| scatter(DVec3::X, fog.g, &mut random).x));
    checks.push(check(format!("mean cosine of {PATHS} scattered directions"), fog.g, cosines));
    // A medium that emits and absorbs, of optical depth 1.5.
    let emission = (0..PATHS).map(|_| {
        let at = random.next_number() * 1.5;
        1.5 * ratio_track(&|_| 1.0, 1.0, at, &mut random)
    });
    checks.push(check(
        "light of a glowing layer of optical depth 1.5".to_owned(),
        1.0 - (-1.5_f64).exp(),
        mean_of(emission),
    ));
    checks
}

/// Light scattered once by a slab of optical depth 1.5 back to a viewer.
fn single_scattering(fog: &Fog, paths: u32) -> LawCheck {
    let [mu, mu_0, thickness] = [0.8_f64, 0.5_f64, 1.5_f64];
    // The sun comes from the other side of the normal than the viewer.
    let cos = -mu * mu_0 - ((1.0 - mu * mu) * (1.0 - mu_0 * mu_0)).sqrt();
    let per_event = fog.albedo * phase(-cos.abs(), fog.g);
    let mut random = SplitMix::new(11);
    let light = (0..paths).map(|_| {
        // Along the line of sight into the slab, then to the sun.
        delta_track(&|_| 1.0, 1.25, thickness / mu, &mut random)
            .map_or(0.0, |s| per_event * ratio_track(&|_| 1.0, 1.25, s * mu / mu_0, &mut random))
    });
    let [measured, error] = mean_of(light);
    LawCheck {
        quantity: format!("light scattered once by a slab, by {paths} paths"),
        unit: "1/sr".into(),
        expected: per_event * mu_0 / (mu + mu_0) * (1.0 - (-thickness * (1.0 / mu + 1.0 / mu_0)).exp()),
        measured,
        bound: 4.0 * error + 1e-12,
    }
}
