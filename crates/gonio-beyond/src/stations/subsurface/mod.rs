//! Subsurface scattering: pawns of marble, milk, skin and potato before a lamp.

mod figures;
mod medium;
mod pawn;
mod surface_cache;

use super::filmic;
use crate::random::mean_of;
use crate::station::{LawCheck, Station, StationPicture};
use figures::{Figures, LightModel};
use glam::DVec3;
use gonio_bsdf::sampling::SplitMix;
use gonio_bsdf::{Parameter, ParameterValues};
use gonio_plot::curves::{PlotAxes, PlotCurve, XTicks, draw};
use gonio_plot::scale::{PlotScale, number};
use gonio_plot::{PlotError, PlotFigure};
use medium::{Dipole, MARBLE, POTATO, SKIM_MILK, SKIN, TranslucentMedium, reflectance, walk};
use std::f64::consts::PI;

/// The station.
pub const STATION: Station = Station {
    name: "subsurface",
    title: "Subsurface scattering",
    assumption: "Light leaves a surface at the point at which it arrived: the same x stands on both sides of the equation, and the BRDF \
                 is a property of that point.",
    nature: "In marble, milk, wax and skin light enters the body, is scattered many times, and leaves elsewhere, or on the other side. \
             Edges of shadows become soft, thin parts glow, and the colour depends on the length of the way. The BRDF becomes a BSSRDF \
             of two points.",
    formula: "free path: p(t) = s e^(-s t), s = s_s + s_a      albedo of an event: w = s_s / s\n\
              half space: R(mu) = 1 - sqrt(1 - w) H(mu)    (Chandrasekhar, isotropic scattering)\n\
              diffusion: R(r) = w / (4 pi) [z_r (1 + k d_r) e^(-k d_r) / d_r^3 + z_v (1 + k d_v) e^(-k d_v) / d_v^3], k = sqrt(3 s_a s)",
    source: "S. Chandrasekhar, Radiative Transfer, 1950, chapters IV and V; coefficients and diffusion: H. W. Jensen et al., A Practical \
             Model for Subsurface Light Transport, SIGGRAPH 2001. Boundaries do not refract here, and scattering is the reduced, isotropic \
             one.",
    look: "The lamp stands behind the pawns: their rims and necks glow, and each medium has its own colour, red where blue light is \
           absorbed on long ways. In the second picture the left pawn is opaque; the middle one is the diffusion approximation, which is \
           good for large bodies and too dark or too bright at thin parts; the right one is the random walk. Make the bodies larger: they \
           become opaque.",
    question: "A toy of marble looks soft, a statue of the same marble hard. Which length decides?",
    parameters: &[
        Parameter::number("height", [4.0, 100.0], 10.0, "height of the pawns").in_unit("mm"),
        Parameter::number("lamp", [0.0, 180.0], 145.0, "direction of the lamp: 0 in front, 180 behind")
            .in_unit("degrees"),
    ],
    film_parameter: "lamp",
    pictures: &[
        StationPicture {
            name: "media",
            caption: "Pawns of marble, skim milk, potato and skin, by random walks.",
            output: filmic(0.35),
            image_plane: |values| Box::new(Figures::new(&MEDIA, values)),
        },
        StationPicture {
            name: "models",
            caption: "Marble as an opaque body, by the diffusion approximation, and by random walks.",
            output: filmic(0.35),
            image_plane: |values| Box::new(Figures::new(&MODELS, values)),
        },
    ],
    plot,
    checks,
};

const MEDIA: [(DVec3, TranslucentMedium, LightModel); 4] = [
    (DVec3::new(-0.88, 0.0, -0.05), MARBLE, LightModel::Walk),
    (DVec3::new(-0.28, 0.0, 0.15), SKIM_MILK, LightModel::Walk),
    (DVec3::new(0.31, 0.0, -0.10), POTATO, LightModel::Walk),
    (DVec3::new(0.90, 0.0, 0.10), SKIN, LightModel::Walk),
];

const MODELS: [(DVec3, TranslucentMedium, LightModel); 3] = [
    (DVec3::new(-0.78, 0.0, 0.0), MARBLE, LightModel::Opaque),
    (DVec3::new(0.0, 0.0, 0.0), MARBLE, LightModel::Diffusion),
    (DVec3::new(0.78, 0.0, 0.0), MARBLE, LightModel::Walk),
];

/// The distance from where a beam enters a half space from above to where it leaves, with its weight.
fn beam(channel: [f64; 2], mu: f64, random: &mut SplitMix) -> [f64; 2] {
    const PRECISION: f64 = 1e-9;
    let start = [DVec3::Y * (-2.0 * PRECISION), DVec3::new((1.0 - mu * mu).max(0.0).sqrt(), -mu, 0.0)];
    let exit = walk(&|p: DVec3| p.y, start, channel, PRECISION, random, |_, _| ());
    exit.map_or([0.0, 0.0], |exit| [exit.point.x.hypot(exit.point.z), exit.weight])
}

fn plot(_: &ParameterValues, figure: &mut PlotFigure) -> Result<(), PlotError> {
    /// The radius up to which the profile is shown, its rings, and the walks.
    const REACH_MM: f64 = 8.0;
    const RINGS: usize = 40;
    const WALKS: u32 = 100_000;
    let series = figure.palette.series;
    let width = REACH_MM / RINGS as f64;
    let middle = |ring: usize| width * (ring as f64 + 0.5);
    let mut curves = Vec::new();
    for (medium, colors) in [(MARBLE, [0, 2]), (SKIN, [1, 6])] {
        let channel = medium.channel(0);
        let mut rings = [0.0; RINGS];
        let mut random = SplitMix::new(2);
        for _ in 0..WALKS {
            let [radius, weight] = beam(channel, 1.0, &mut random);
            if let Some(ring) = rings.get_mut((radius / width) as usize) {
                *ring += weight;
            }
        }
        let area = |ring: usize| 2.0 * PI * middle(ring) * width;
        let measured = |ring: usize| rings[ring] / (f64::from(WALKS) * area(ring));
        let dipole = Dipole::new(channel);
        let curve = |label: &str, color: usize, value: &dyn Fn(usize) -> f64| PlotCurve {
            label: format!("{}, {label}", medium.name),
            color: series[color],
            points: (0..RINGS).map(|ring| [middle(ring), value(ring)]).collect(),
        };
        curves.push(curve("random walks", colors[0], &measured));
        curves.push(curve("diffusion", colors[1], &|ring| dipole.profile(middle(ring))));
    }
    let axes = PlotAxes {
        title: "Where red light leaves a deep medium that a thin beam enters".to_owned(),
        x_label: "Distance from the beam (mm)",
        y_label: "Light per area (1/mm²)".to_owned(),
        x: [0.0, REACH_MM],
        x_ticks: XTicks::Numbers,
        top: 1.0,
        scale: PlotScale::Log,
        mark: None,
        level: None,
    };
    draw(figure, &curves, &axes)
}

fn checks(_: &ParameterValues) -> Vec<LawCheck> {
    const WALKS: u32 = 20_000;
    let mut checks = Vec::new();
    for (medium, channel, name) in
        [(MARBLE, 2, "blue"), (SKIM_MILK, 2, "blue"), (POTATO, 2, "blue"), (SKIN, 1, "green"), (SKIN, 2, "blue")]
    {
        let coefficients = medium.channel(channel);
        for mu in [1.0, 0.4] {
            let mut random = SplitMix::new(21);
            let [measured, error] = mean_of((0..WALKS).map(|_| beam(coefficients, mu, &mut random)[1]));
            checks.push(LawCheck {
                quantity: format!(
                    "{name} light that deep {} reflects, cosine of the angle {}, by {WALKS} walks",
                    medium.name,
                    number(mu)
                ),
                unit: "".into(),
                expected: reflectance(mu, coefficients[1]),
                measured,
                bound: 4.0 * error,
            });
        }
    }
    let dipole = Dipole::new(SKIN.channel(0));
    const STEP_MM: f64 = 0.01;
    let rings = (0..6000).map(|ring| STEP_MM * (f64::from(ring) + 0.5));
    checks.push(LawCheck {
        quantity: "diffusion: total of red light that skin reflects, by the sum over rings".to_owned(),
        unit: "".into(),
        expected: dipole.total(),
        measured: rings.map(|r| 2.0 * PI * r * STEP_MM * dipole.profile(r)).sum(),
        bound: 1e-4,
    });
    checks
}
