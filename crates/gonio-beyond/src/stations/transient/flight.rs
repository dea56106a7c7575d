//! The pictures: the light that arrives at one moment, and all of it with its time as colour.

use super::bench::{LIGHT_SPEED, arrivals, camera, steady_lamp};
use crate::camera::Pinhole;
use crate::random::sequence;
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_trace::Sampler;
use std::f64::consts::TAU;

/// The shape of the pulse, 1 at its middle.
///
/// `width_ps`: the standard deviation.
pub fn pulse(since_ps: f64, width_ps: f64) -> f64 {
    (-0.5 * (since_ps / width_ps).powi(2)).exp()
}

/// The area under [`pulse`], ps.
pub fn pulse_area(width_ps: f64) -> f64 {
    width_ps * TAU.sqrt()
}

/// The picture of one moment.
pub struct Flight {
    camera: Pinhole,
    time_ps: f64,
    width_ps: f64,
}

impl Flight {
    /// Light that arrives at a time after the flash; the flash is a pulse with a width.
    pub fn new(time_ps: f64, width_ps: f64) -> Self {
        Self { camera: camera(), time_ps, width_ps }
    }
}

/// The weak lamp beside the flash.
const STEADY: f64 = 0.06;

impl ImagePlane for Flight {
    fn light(&self, at: DVec2, sampler: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let mut light = steady_lamp(&ray) * STEADY;
        arrivals(&ray, &mut sequence(sampler), &mut |(energy, length)| {
            light += energy * pulse(self.time_ps - length / LIGHT_SPEED, self.width_ps);
        });
        light
    }
}

/// The steady picture, with the time of arrival as hue.
pub struct Arrivals {
    camera: Pinhole,
}

impl Arrivals {
    /// The picture.
    pub fn new() -> Self {
        Self { camera: camera() }
    }
}

/// The time after which the hues repeat, and the time between two dark lines, ps.
const CYCLE_PS: f64 = 1000.0;
const LINES_PS: f64 = 100.0;

/// The colour of a time.
fn hue(time_ps: f64) -> DVec3 {
    let phase = time_ps / CYCLE_PS;
    let wave = |shift: f64| 0.5 + 0.5 * (TAU * (phase + shift)).cos();
    let line = (time_ps / LINES_PS).rem_euclid(1.0);
    let shade = if (0.44..0.56).contains(&line) { 0.25 } else { 1.0 };
    DVec3::new(wave(0.0), wave(-0.33), wave(-0.67)).powf(1.4) * (1.5 * shade)
}

impl ImagePlane for Arrivals {
    fn light(&self, at: DVec2, sampler: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let mut light = DVec3::ZERO;
        arrivals(&ray, &mut sequence(sampler), &mut |(energy, length)| {
            let luminance = energy.dot(DVec3::new(0.2126, 0.7152, 0.0722));
            light += hue(length / LIGHT_SPEED) * luminance;
        });
        light
    }
}
