//! The picture: a compact disc, whose grooves are a grating.

use crate::bands::in_gamut;
use crate::camera::Pinhole;
use crate::noise::{fractal, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_bsdf::ParameterValues;
use gonio_light::observer::{COLORIMETRY, daylight, matching};
use gonio_trace::Sampler;

/// The disc on a table.
pub struct Disc {
    camera: Pinhole,
    pitch_nm: f64,
    lamps: [(DVec3, f64); 4],
}

/// Half the angle, as a sine, over which a lamp is spread along the grooves.
const SPREAD: f64 = 0.055;
/// Radii: of the disc, of the grooves' ends, of the transparent ring, of the hole.
const DISC: f64 = 1.0;
const GROOVES: [f64; 2] = [0.40, 0.965];
const CLEAR: f64 = 0.285;
const HOLE: f64 = 0.125;

impl Disc {
    /// The disc with values of the parameters.
    pub fn new(values: &ParameterValues) -> Self {
        Self {
            camera: Pinhole::new(DVec3::new(0.0, 2.6, 2.1), DVec3::new(0.0, -0.02, 0.06), 39.0),
            pitch_nm: values.number("pitch"),
            lamps: [
                (DVec3::new(-2.6, 3.1, -1.0), 1.0),
                (DVec3::new(2.3, 3.4, -1.7), 0.85),
                (DVec3::new(0.9, 2.2, 3.2), 0.7),
                (DVec3::new(-0.4, 3.0, -3.4), 0.8),
            ],
        }
    }

    /// The light of the lamps that the grooves at a place send towards `view`.
    fn diffracted(&self, point: DVec3, view: DVec3) -> DVec3 {
        let radial = point.normalize();
        let along = DVec3::Y.cross(radial);
        let mut sum = DVec3::ZERO;
        for (lamp, power) in self.lamps {
            let to_lamp = (lamp - point).normalize();
            let both = to_lamp + view;
            // Along the grooves the disc is a mirror; across them it is a grating.
            let off = both.dot(along) / SPREAD;
            let mirrored = (-0.5 * off * off).exp();
            if mirrored < 1e-5 {
                continue;
            }
            let sine = both.dot(radial).abs();
            let flat = (-0.5 * (sine / SPREAD).powi(2)).exp();
            sum += DVec3::splat(2.2 * power * mirrored * (flat * flat));
            for order in 1..=12_u32 {
                let lambda = self.pitch_nm * sine / f64::from(order);
                if !(380.0..=780.0).contains(&lambda) {
                    continue;
                }
                // Pits send less light to higher orders. Light of a narrow band lies within a narrow angle.
                let share = 1.5 / f64::from(order).powf(1.3);
                let response = COLORIMETRY.rgb_from_xyz * matching(lambda) * daylight(lambda);
                sum += in_gamut(response) * (share * power * mirrored * to_lamp.y);
            }
        }
        sum
    }
}

impl ImagePlane for Disc {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y) else { return DVec3::ZERO };
        let point = ray.at(distance);
        let radius = point.length();
        let place = DVec2::new(point.x, point.z);
        let mut table = table(place);
        // The disc's shadow on the table.
        table *= 0.35 + 0.65 * step(0.98, 1.12, (place - DVec2::new(0.015, 0.02)).length());
        if !(HOLE..=DISC).contains(&radius) {
            return table;
        }
        let view = -ray.direction;
        let up = DVec3::new(-view.x, view.y, -view.z);
        let room = room(up);
        let gloss = 0.04 + 0.96 * (1.0 - view.y).powi(5);
        if radius < CLEAR {
            let ring = step(0.012, 0.0, (radius - 0.20).abs()) * 0.05 + step(0.006, 0.0, (radius - HOLE).abs()) * 0.12;
            return table * 0.7 + room * (gloss * 1.5 + ring) + 0.012;
        }
        let edge = step(GROOVES[0] - 0.004, GROOVES[0], radius) * step(GROOVES[1] + 0.004, GROOVES[1], radius);
        let aluminium = DVec3::new(0.80, 0.82, 0.84) * room * 0.42;
        // The written part ends where its data end.
        let written = 1.0 - 0.22 * step(0.800, 0.804, radius);
        let lamps = self.diffracted(point, view);
        aluminium * (0.82 + 0.18 * (1.0 - edge)) * written
            + lamps * edge * written
            + room * gloss
            + lamps.min(DVec3::ONE) * 0.02 * (1.0 - edge)
    }
}

fn table(at: DVec2) -> DVec3 {
    let grain = fractal(DVec2::new(at.x * 2.2, at.y * 26.0) + 0.8 * fractal(at * 2.0, 3, 150), 4, 151);
    let plank = ((at.y + 3.0) / 0.62).fract();
    let gap = step(0.0, 0.02, plank) * step(1.0, 0.98, plank);
    let light = (-(at - DVec2::new(-0.3, -0.2)).length_squared() * 0.32).exp();
    DVec3::new(0.050, 0.026, 0.014).lerp(DVec3::new(0.14, 0.075, 0.036), grain)
        * (0.25 + 0.75 * gap)
        * (0.2 + 0.9 * light)
}

/// The dim room that the disc mirrors.
fn room(direction: DVec3) -> DVec3 {
    let wall = DVec3::new(0.05, 0.055, 0.065) + DVec3::new(0.10, 0.11, 0.13) * step(0.55, 0.95, direction.y);
    wall * (0.8 + 0.4 * fractal(DVec2::new(direction.x, direction.z) * 2.0, 2, 160))
}
