//! Transmission: a pencil in a glass of water, and the sky seen from below the water.

mod diver;
mod tumbler;

use super::filmic;
use crate::station::{LawCheck, Station, StationPicture};
use diver::Diver;
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_light::optics::{Boundary, Fresnel, boundary, dielectric};
use gonio_light::{DVec2, DVec3};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use gonio_trace::Sampler;
use tumbler::Tumbler;

/// The station.
pub const STATION: Station = Station {
    name: "transmission",
    title: "Transmission",
    assumption: "Light that arrives at a surface leaves it on the same side: the integral runs over the hemisphere above.",
    nature: "Glass and water let light through. At the surface it changes its direction, because it is slower in the denser medium; a \
             part is reflected; and inside, each metre takes the same share of it away. From inside, beyond the critical angle, all of \
             it is reflected. The BRDF becomes a BSDF over the whole sphere.",
    formula: "n_1 sin(theta_1) = n_2 sin(theta_2)    (Snell)      sin(theta_c) = n_2 / n_1    (total reflection beyond)\n\
              R_s, R_p: Fresnel      L_2 / n_2^2 = (1 - R) L_1 / n_1^2\n\
              L(d) = L(0) e^(-k d)    (Bouguer, Lambert, Beer)",
    source: "W. Snell 1621; A. Fresnel 1823; P. Bouguer 1729, J. H. Lambert 1760; M. Born and E. Wolf, Principles of Optics, sections \
             1.5 and 4.8; rough boundaries: B. Walter et al., EGSR 2007.",
    look: "The pencil breaks at the water, and the lower arrow on the card points the other way: the water is a lens. Above the water the \
           glass is hollow, and the arrow stays. From below the water the whole sky fits into a disc of 97 degrees; around it the water \
           mirrors the bottom.",
    question: "Fill the glass with a liquid of the glass's own index, 1.5. Which lines disappear, and why?",
    parameters: &[
        Parameter::number("index", [1.0, 2.4], 1.333, "index of refraction of the liquid"),
        Parameter::number("absorption", [0.0, 5.0], 0.3, "absorption of the liquid, for red light").in_unit("1/m"),
        Parameter::number("roughness", [0.0, 0.5], 0.0, "roughness of the glass (GGX alpha)"),
        Parameter::number("ripples", [0.0, 2.0], 0.7, "height of the ripples above the diver"),
    ],
    film_parameter: "index",
    pictures: &[
        StationPicture {
            name: "glass",
            caption: "A pencil in a glass of water, and two arrows on a card behind it that both point to the right.",
            output: filmic(-0.1),
            image_plane: |values| Box::new(Tumbler::new(values)),
        },
        StationPicture {
            name: "diver",
            caption: "Snell's window: the sky above a pool, seen from below the water.",
            output: filmic(-0.2),
            image_plane: |values| Box::new(Diver::new(values)),
        },
    ],
    plot,
    checks,
};

/// The share of light that the liquid takes from each channel, per unit of absorption: red most, as water does.
const ABSORBED: DVec3 = DVec3::new(1.0, 0.22, 0.10);

/// A ray of light at a boundary from index `n_1` to `n_2`: `direction` and `normal` are unit; the normal's side does not matter.
fn meet(direction: DVec3, normal: DVec3, n_1: f64, n_2: f64) -> Boundary {
    let towards = if direction.dot(normal) < 0.0 { normal } else { -normal };
    boundary(towards, -direction, n_2 / n_1, Fresnel::Exact)
}

fn plot(values: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    let index = values.number("index");
    let series = figure.palette.series;
    let curve = |label: &str, color: usize, value: &dyn Fn(f64) -> f64| PlotCurve {
        label: label.to_owned(),
        color: series[color],
        points: (0..=900).map(|step| 0.1 * f64::from(step)).map(|x| [x, value(x.to_radians())]).collect(),
    };
    let curves = [
        curve("light let into the liquid", 0, &|angle| 1.0 - dielectric(angle.cos(), 1.0 / index)),
        curve("light let out of the liquid", 1, &|angle| 1.0 - dielectric(angle.cos(), index)),
        curve("sine of the refracted angle, into the liquid", 2, &|angle| angle.sin() / index),
    ];
    let critical = (1.0 / index).asin().to_degrees();
    let axes = PlotAxes {
        title: format!("A surface between air and a liquid of index {}", number(index)),
        x_label: "Angle of incidence (degrees)",
        y_label: "Share of light; sine".to_owned(),
        x: [0.0, 90.0],
        x_ticks: XTicks::Angles,
        top: 1.2,
        scale: PlotScale::Linear,
        mark: (index > 1.0).then(|| (critical, format!("critical angle {critical:.2}°"))),
        level: None,
    };
    draw(figure, &curves, &axes)
}

/// A liquid of the index of air refracts nothing: the checks are made with a slightly larger one.
const LEAST_INDEX: f64 = 1.001;

fn checks(values: &ParameterValues) -> Vec<LawCheck> {
    let index = values.number("index").max(LEAST_INDEX);
    let mut checks = Vec::new();
    for degrees in [15.0, 40.0, 65.0] {
        let sin = f64::to_radians(degrees).sin();
        let direction = DVec3::new(sin, -(1.0 - sin * sin).sqrt(), 0.0);
        let refracted = meet(direction, DVec3::Y, 1.0, index).transmitted;
        checks.push(LawCheck {
            quantity: format!("sine of the refracted angle at {degrees} degrees, by the quickest path (Fermat)"),
            unit: "".into(),
            expected: refracted.map_or(f64::NAN, |t| t.x),
            measured: quickest_sine(direction, index),
            bound: 1e-6,
        });
    }
    checks.push(LawCheck {
        quantity: "angle from which no light leaves the liquid".to_owned(),
        unit: "degrees".into(),
        expected: (1.0 / index).asin().to_degrees(),
        measured: critical_angle(index).to_degrees(),
        bound: 1e-6,
    });
    let (thickness, k) = (0.4, values.number("absorption"));
    let [passed, error] = photons_through(index, k * thickness);
    let (r, a) = (dielectric(1.0, 1.0 / index), (-k * thickness).exp());
    checks.push(LawCheck {
        quantity: format!("light through a layer of {thickness} m, by {PHOTONS} photons"),
        unit: "".into(),
        // All reflections between the two surfaces, a geometric series.
        expected: (1.0 - r).powi(2) * a / (1.0 - r * r * a * a),
        measured: passed,
        bound: 4.0 * error,
    });
    checks
}

/// The sine of the angle of the quickest path that begins as `direction` does, above and below a surface.
fn quickest_sine(direction: DVec3, index: f64) -> f64 {
    // From 1 above to 1 below, through the place s on the surface: the end that has its quickest path through the ray's place.
    let hit = direction.x / -direction.y;
    let best_place = |end: f64| {
        let time = |s: f64| DVec2::new(s, 1.0).length() + index * DVec2::new(end - s, 1.0).length();
        // The derivative rises through 0.
        let slope = |s: f64| (time(s + 1e-4) - time(s - 1e-4)) / 2e-4;
        bisect(0.0, end, |s| slope(s) < 0.0)
    };
    let end = bisect(hit, hit + 4.0, |end| best_place(end) < hit);
    let below = DVec2::new(end - hit, 1.0);
    below.x / below.length()
}

/// The place between two others up to which a condition holds.
fn bisect(mut from: f64, mut to: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (from + to);
        if holds(middle) { from = middle } else { to = middle }
    }
    0.5 * (from + to)
}

/// The largest angle at which light leaves a liquid, by trying.
fn critical_angle(index: f64) -> f64 {
    let leaves = |angle: f64| {
        let direction = DVec3::new(angle.sin(), angle.cos(), 0.0);
        meet(direction, DVec3::Y, index, 1.0).transmitted.is_some()
    };
    bisect(0.0, std::f64::consts::FRAC_PI_2, leaves)
}

/// Photons of the random walk.
const PHOTONS: u32 = 40_000;

/// The share of photons that pass a layer with the optical depth `depth` from ahead, one after the other, and its standard error.
fn photons_through(index: f64, depth: f64) -> [f64; 2] {
    let reflectance = meet(DVec3::NEG_Y, DVec3::Y, 1.0, index).reflectance;
    let passes = |photon: u32| {
        let mut sampler = Sampler::new(21, photon, 0);
        let mut chance = || f64::from(sampler.next_1d());
        if chance() < reflectance {
            return false;
        }
        // Across the layer again and again, until it is absorbed or leaves.
        let mut is_at_far_side = false;
        loop {
            let free_path = -(1.0 - chance()).ln();
            if free_path < depth {
                return false;
            }
            is_at_far_side = !is_at_far_side;
            if chance() >= reflectance {
                return is_at_far_side;
            }
        }
    };
    let share = f64::from((0..PHOTONS).map(|photon| u32::from(passes(photon))).sum::<u32>()) / f64::from(PHOTONS);
    [share, (share * (1.0 - share) / f64::from(PHOTONS)).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Issue 21: Snell's law, by Fermat's principle and on paper, from both sides.
    #[test]
    fn light_takes_the_quickest_path() {
        for index in [1.1, 1.333, 1.5, 2.4] {
            for degrees in [5.0, 30.0, 55.0, 80.0] {
                let sin = f64::to_radians(degrees).sin();
                let direction = DVec3::new(sin, -(1.0 - sin * sin).sqrt(), 0.0);
                assert!((quickest_sine(direction, index) - sin / index).abs() < 1e-6, "{index} {degrees}");
                let inside = meet(direction, DVec3::NEG_Y, 1.0, index).transmitted.unwrap_or_default();
                assert!((inside.x - sin / index).abs() < 1e-12, "{index} {degrees}");
                let back = meet(inside, DVec3::Y, index, 1.0).transmitted.unwrap_or_default();
                assert!((back - direction).length() < 1e-9, "{index} {degrees}");
            }
        }
    }

    /// Issue 21: Fresnel and Beer-Lambert. A layer's transmittance is the geometric series of its reflections.
    #[test]
    fn photons_pass_as_the_series_says() {
        for (index, depth) in [(1.0, 0.7), (1.5, 0.0), (1.333, 0.3), (2.4, 1.0)] {
            let [passed, error] = photons_through(index, depth);
            let (r, a) = (((index - 1.0) / (index + 1.0)).powi(2), f64::exp(-depth));
            let expected = (1.0 - r).powi(2) * a / (1.0 - r * r * a * a);
            assert!((passed - expected).abs() < 4.0 * error, "{index} {depth}: {passed} {expected}");
        }
    }

    #[test]
    fn reflection_is_total_beyond_the_critical_angle() {
        for index in [1.2, 1.333, 2.0] {
            assert!((critical_angle(index) - (1.0 / index).asin()).abs() < 1e-9, "{index}");
        }
    }
}
