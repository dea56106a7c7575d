//! Pictures of thin films: a wand, bubbles, and oil on a puddle.

use super::airy::ThinFilm;
use crate::bands::in_gamut;
use crate::camera::Pinhole;
use crate::noise::{cell, fractal, smooth, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3, IVec2};
use gonio_bsdf::ParameterValues;
use gonio_trace::Sampler;

/// The thickness of a draining film as a share of the first one. A vertical film thins with the root of time (K. J. Mysels,
/// K. Shinoda and S. Frankel, *Soap Films*, 1959).
pub fn drained(time_s: f64) -> f64 {
    1.0 / (1.0 + time_s / 6.0).sqrt()
}

/// Places displaced by slow turbulence.
fn swirled(at: DVec2, strength: f64, seed: u32) -> DVec2 {
    let first = DVec2::new(fractal(at, 4, seed), fractal(at, 4, seed + 20)) - 0.5;
    let second = at + 1.7 * first;
    at + strength * (DVec2::new(fractal(second, 4, seed + 40), fractal(second, 4, seed + 60)) - 0.5)
}

/// A film in a ring.
pub struct Wand {
    index: f64,
    thickness_nm: f64,
    time_s: f64,
}

const RING: DVec2 = DVec2::new(0.0, 0.16);
const RING_RADIUS: f64 = 0.72;
const WIRE: f64 = 0.032;

impl Wand {
    /// The wand with values of the parameters.
    pub fn new(values: &ParameterValues) -> Self {
        let [index, thickness_nm, time_s] = ["index", "thickness", "time"].map(|name| values.number(name));
        Self { index, thickness_nm, time_s }
    }

    /// nm, at a place relative to the ring's radius.
    fn thickness(&self, place: DVec2) -> f64 {
        let swirl = swirled(place * 1.4 + DVec2::new(4.0, 0.02 * self.time_s), 0.9, 3) - place * 1.4;
        let low = 0.5 * (1.0 - place.y);
        // Thin patches rise along the rim (marginal regeneration).
        let rim = step(0.80, 1.0, place.length()) * (0.12 * fractal(place * 6.0, 4, 9) - 0.02);
        let height = low + (swirl.y - 0.02 * self.time_s) * 0.28 * (0.25 + low) - rim;
        // The black film grows downwards from the top.
        let black = 0.016 * self.time_s.sqrt();
        let drop = (height - black).max(0.0);
        self.thickness_nm * drained(self.time_s) * (0.012 + drop.powf(0.75) * 1.05)
    }
}

impl ImagePlane for Wand {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let place = at - RING;
        let radius = place.length();
        let wall = wall(at);
        let from_wire = (radius - RING_RADIUS).abs() / WIRE;
        if from_wire < 1.0 {
            return wire((radius - RING_RADIUS) / WIRE, place / radius);
        }
        if place.y < -RING_RADIUS && at.x.abs() < 0.045 {
            return handle(at);
        }
        if radius > RING_RADIUS {
            return wall;
        }
        let place = place / RING_RADIUS;
        // The film bulges slightly: the panel's reflection is brightest in one half.
        let cos_i = 0.88 - 0.05 * place.x;
        let panel = 0.62 + 0.38 * step(-1.0, 0.9, 0.75 * place.x + 0.65 * place.y);
        let film = ThinFilm { index: self.index, index_below: 1.0, thickness_nm: self.thickness(place) };
        wall * 0.9 + in_gamut(film.color(cos_i)) * panel
    }
}

fn wall(at: DVec2) -> DVec3 {
    let spot = (-(at - DVec2::new(0.5, 0.5)).length_squared() * 0.9).exp();
    DVec3::new(0.0022, 0.0028, 0.0042) * (0.5 + 1.5 * spot) * (0.8 + 0.4 * fractal(at * 3.0, 3, 70))
}

/// A wire of unit radius: `across` from -1 to 1, `out` away from the ring's centre.
fn wire(across: f64, out: DVec2) -> DVec3 {
    let normal = (out * across).extend((1.0 - across * across).max(0.0).sqrt());
    let panel = normal.dot(DVec3::new(0.42, 0.55, 0.72)).max(0.0);
    DVec3::new(0.030, 0.034, 0.042) * (0.15 + 0.9 * panel) + DVec3::new(1.0, 0.97, 0.92) * 0.16 * panel.powi(24)
}

fn handle(at: DVec2) -> DVec3 {
    let across = at.x / 0.045;
    let ridge = 0.85 + 0.15 * (at.y * 90.0).sin();
    let shade = (1.0 - across * across).max(0.0).sqrt() * 0.6 + 0.4 * (1.0 - (across - 0.45).abs());
    DVec3::new(0.085, 0.016, 0.030) * shade * ridge + 0.05 * step(0.12, 0.0, (across - 0.45).abs())
}

/// A bubble: centre, radius, and a number of its own.
type Bubble = (DVec3, f64, u32);

/// Bubbles in the air.
pub struct Bubbles {
    camera: Pinhole,
    film: ThinFilm,
    time_s: f64,
    bubbles: [Bubble; 6],
}

impl Bubbles {
    /// The bubbles with values of the parameters.
    pub fn new(values: &ParameterValues) -> Self {
        let [index, thickness_nm, time_s] = ["index", "thickness", "time"].map(|name| values.number(name));
        Self {
            camera: Pinhole::new(DVec3::new(0.0, 0.0, 6.0), DVec3::ZERO, 36.0),
            film: ThinFilm { index, index_below: 1.0, thickness_nm: thickness_nm * drained(time_s) },
            time_s,
            bubbles: [
                (DVec3::new(-0.28, -0.12, 0.0), 1.12, 1),
                (DVec3::new(1.55, 0.72, -0.6), 0.58, 2),
                (DVec3::new(1.32, -0.95, 0.5), 0.40, 3),
                (DVec3::new(-1.95, 1.12, -1.0), 0.46, 4),
                (DVec3::new(-1.72, -1.18, 0.4), 0.25, 5),
                (DVec3::new(0.72, 1.42, -0.5), 0.20, 6),
            ],
        }
    }

    /// The film where `normal` points outwards.
    fn film_at(&self, normal: DVec3, seed: u32) -> ThinFilm {
        let around = DVec2::new(normal.x - 0.5 * normal.z, normal.y + 0.35 * normal.z);
        let swirl = swirled(around * 1.25 + DVec2::new(f64::from(seed) * 7.0, 0.03 * self.time_s), 1.3, 80 + seed);
        let flow = swirl.y - 0.03 * self.time_s - around.y * 1.25;
        let low = 0.5 * (1.0 - normal.y);
        let share = (0.22 + 0.78 * low.powf(0.8) + 0.42 * flow).max(0.01);
        ThinFilm { thickness_nm: self.film.thickness_nm * share * (0.8 + 0.07 * f64::from(seed)), ..self.film }
    }
}

impl ImagePlane for Bubbles {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let mut hits: Vec<([f64; 2], &Bubble)> =
            self.bubbles.iter().filter_map(|b| ray.sphere(b.0, b.1).map(|hit| (hit, b))).collect();
        hits.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        let (mut sum, mut passed) = (DVec3::ZERO, DVec3::ONE);
        for ([near, far], (center, radius, seed)) in hits {
            for (distance, side) in [(near, 1.0), (far, -1.0)] {
                let normal = (ray.at(distance) - center) / *radius;
                let facing = normal * side;
                let cos = -ray.direction.dot(facing);
                let reflected = ray.direction + 2.0 * cos * facing;
                let share = in_gamut(self.film_at(normal, *seed).color(cos.max(0.02))).min(DVec3::splat(0.95));
                sum += passed * share * evening(reflected);
                passed *= 1.0 - share;
            }
        }
        sum + passed * garden(at)
    }
}

/// The blurred garden behind the bubbles.
fn garden(at: DVec2) -> DVec3 {
    let mut color =
        DVec3::new(0.010, 0.022, 0.030).lerp(DVec3::new(0.055, 0.045, 0.075), step(-0.9, 1.0, at.y + 0.2 * at.x));
    for index in 0..26 {
        let random = |seed: u32| cell(IVec2::new(index, 5), seed);
        let center = DVec2::new(3.0 * random(1) - 1.5, 1.7 * random(2) - 1.0);
        let radius = 0.06 + 0.11 * random(3);
        let warm = DVec3::new(0.10, 0.055, 0.02).lerp(DVec3::new(0.02, 0.07, 0.055), random(4));
        let distance = (at - center).length() / radius;
        color += warm * (0.2 + random(5)) * step(1.0, 0.86, distance) * (0.6 + 0.4 * distance * distance);
    }
    color
}

/// The surroundings that the bubbles reflect: an evening sky with bright clouds, a window, a dark ground.
fn evening(direction: DVec3) -> DVec3 {
    let sky = DVec3::new(1.15, 0.78, 0.52).lerp(DVec3::new(0.34, 0.52, 1.0), step(0.0, 0.8, direction.y));
    let at = DVec2::new(direction.x, direction.z) / (direction.y.max(0.0) + 0.3);
    let sky = sky + 0.9 * step(0.5, 0.75, fractal(at * 1.3, 4, 90)) * DVec3::new(1.1, 0.95, 0.85);
    let treeline = 0.05 + 0.09 * smooth(DVec2::new(direction.x.atan2(direction.z) * 6.0, 0.0), 91);
    let ground = DVec3::new(0.05, 0.055, 0.045);
    let mut color = ground.lerp(sky, step(treeline - 0.02, treeline + 0.02, direction.y));
    // A large bright window to the upper left, behind the camera.
    let forward = direction.z.max(1e-3);
    let place = DVec2::new(direction.x / forward + 0.55, direction.y / forward - 0.62);
    let pane = place.abs();
    if direction.z > 0.0 && pane.x < 0.30 && pane.y < 0.36 && pane.x > 0.018 && pane.y > 0.018 {
        color = DVec3::new(9.0, 8.6, 8.0);
    }
    color
}

/// Oil on a puddle on asphalt.
pub struct Puddle {
    camera: Pinhole,
    thickness_nm: f64,
}

/// The index of the oil.
const OIL: f64 = 1.47;

impl Puddle {
    /// The puddle with values of the parameters; oil spreads instead of draining.
    pub fn new(values: &ParameterValues) -> Self {
        Self {
            camera: Pinhole::new(DVec3::new(0.0, 1.25, 1.3), DVec3::new(0.0, 0.0, -0.05), 46.0),
            thickness_nm: values.number("thickness") * drained(values.number("time")) * 1.6,
        }
    }
}

impl ImagePlane for Puddle {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y) else { return DVec3::splat(0.5) };
        let point = ray.at(distance);
        let place = DVec2::new(point.x, point.z);
        let edge = swirled(place * 1.6, 0.55, 110) / 1.6;
        // Above 1 in the puddle's middle, 0 at its shore.
        let depth = 1.0 - (edge * DVec2::new(0.92, 1.25)).length() / 0.92 - 0.10 * fractal(place * 22.0, 3, 112);
        let pebbles = asphalt(place);
        let up = DVec3::new(ray.direction.x, -ray.direction.y, ray.direction.z);
        let sky = 0.95 + 0.35 * fractal(DVec2::new(up.x, up.z) / (up.y + 0.2) * 1.4, 4, 115);
        let sky = DVec3::new(0.98, 1.0, 1.04) * sky * 1.6;
        let cos = -ray.direction.y;
        let wet = step(-0.02, 0.04, depth);
        let swirl = swirled(place * 2.6, 1.15, 120);
        let spread = (1.0 - (swirl / 2.6 * DVec2::new(1.05, 1.3)).length() / 0.80).max(0.0);
        let flow = 0.75 + 0.5 * fractal(swirl * 1.2, 3, 124);
        let thickness = self.thickness_nm * spread.powf(0.9) * flow;
        let film = ThinFilm { index: OIL, index_below: 1.333, thickness_nm: thickness };
        let reflected = in_gamut(film.color(cos)) * sky;
        let below = pebbles * 0.35 * (1.0 - 0.75 * wet);
        let dry = pebbles * (0.8 - 0.35 * step(-0.25, 0.0, depth));
        dry.lerp(below * DVec3::new(0.9, 0.95, 1.0) + reflected, wet)
    }
}

/// Light from dry asphalt: grains of several sizes.
fn asphalt(at: DVec2) -> DVec3 {
    let mut light = 0.010 + 0.012 * fractal(at * 3.0, 3, 130);
    for (size, seed) in [(0.030, 131), (0.017, 132), (0.009, 133)] {
        let place = at / size;
        let base = place.floor().as_ivec2();
        for (x, y) in (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y))) {
            let here = base.wrapping_add(IVec2::new(x, y));
            let center = here.as_dvec2() + DVec2::new(cell(here, seed), cell(here, seed + 10));
            let radius = 0.25 + 0.3 * cell(here, seed + 20);
            let offset = (place - center) / radius;
            let square = 1.0 - offset.length_squared();
            if square > 0.0 && cell(here, seed + 30) > 0.35 {
                let lit = offset.dot(DVec2::new(-0.5, -0.6)) * 0.6 + square.sqrt();
                light = (0.010 + 0.045 * cell(here, seed + 40).powi(2)) * lit.max(0.1);
            }
        }
    }
    DVec3::new(1.0, 0.98, 0.95) * light
}
