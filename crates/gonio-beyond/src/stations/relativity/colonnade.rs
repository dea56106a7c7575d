//! The picture of a flight: a colonnade in sunlight.

use super::lorentz::{Effects, ShiftedColors, aberrated, doppler_factor};
use crate::camera::{Pinhole, Ray};
use crate::noise::{fractal, smooth, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_trace::Sampler;

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Material {
    Marble,
    Brick,
    Grass,
}

/// A place where a ray meets something.
#[derive(Clone, Copy, Debug)]
struct Hit {
    distance: f64,
    normal: DVec3,
    material: Material,
    /// A factor of the reflectance: patterns.
    tone: f64,
}

/// The colonnade, through which the camera flies along -z.
pub struct Colonnade {
    camera: Pinhole,
    effects: Effects,
    marble: ShiftedColors,
    brick: ShiftedColors,
    grass: ShiftedColors,
    sky: ShiftedColors,
    cloud: ShiftedColors,
    to_sun: DVec3,
}

/// Columns: distance of the rows from the middle, of the columns in a row, radius, height; m.
const ROW: f64 = 3.1;
const APART: f64 = 4.0;
const RADIUS: f64 = 0.46;
const HEIGHT: f64 = 4.8;
/// The eye.
const EYE: DVec3 = DVec3::new(-0.35, 1.75, 0.8);
/// Beyond this nothing is met, m.
const FAR: f64 = 160.0;

impl Colonnade {
    /// The flight with its effects.
    pub fn new(effects: &Effects) -> Self {
        let colors = |radiance: fn(f64) -> f64| ShiftedColors::new(effects, radiance);
        Self {
            camera: Pinhole::new(EYE, EYE + DVec3::new(0.0, 0.12, -1.0), 74.0),
            effects: *effects,
            marble: colors(|lambda| 0.70 + 0.10 * step(400.0, 620.0, lambda)),
            brick: colors(|lambda| 0.09 + 0.34 * step(540.0, 640.0, lambda)),
            // Leaves reflect infrared light: the red edge.
            grass: colors(|lambda| {
                0.03 + 0.09 * (-((lambda - 552.0) / 42.0).powi(2)).exp() + 0.42 * step(690.0, 745.0, lambda)
            }),
            // Rayleigh scattering.
            sky: colors(|lambda| 0.30 * (520.0 / lambda).powi(4)),
            cloud: colors(|_| 0.95),
            to_sun: DVec3::new(0.62, 0.66, -0.25).normalize(),
        }
    }

    fn meet(&self, ray: &Ray) -> Option<Hit> {
        let mut found: Option<Hit> = None;
        let mut add = |hit: Option<Hit>| {
            if let Some(hit) = hit.filter(|hit| hit.distance > 1e-4 && hit.distance < FAR)
                && found.is_none_or(|old| hit.distance < old.distance)
            {
                found = Some(hit);
            }
        };
        if let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y).filter(|distance| *distance < FAR) {
            add(Some(floor(ray.at(distance), distance)));
        }
        for side in [-ROW, ROW] {
            // The beam above the columns.
            add(block(ray, DVec3::new(side - 0.6, HEIGHT, -1e3), DVec3::new(side + 0.6, HEIGHT + 0.75, 1e3)));
            for index in candidates(ray, [side - 0.7, side + 0.7], [0.0, HEIGHT]) {
                let center = DVec2::new(side, APART * f64::from(index));
                add(column(ray, center));
                for (half, from, to) in [(0.66, 0.0, 0.28), (0.62, HEIGHT - 0.28, HEIGHT)] {
                    let low = DVec3::new(center.x - half, from, center.y - half);
                    add(block(ray, low, DVec3::new(center.x + half, to, center.y + half)));
                }
            }
        }
        for index in candidates(ray, [-ROW, ROW], [HEIGHT + 0.1, HEIGHT + 0.6]) {
            let z = APART * f64::from(index);
            add(block(ray, DVec3::new(-ROW, HEIGHT + 0.1, z - 0.25), DVec3::new(ROW, HEIGHT + 0.6, z + 0.25)));
        }
        found
    }

    /// Radiance from a direction of the scene, seen with the Doppler factor `d`.
    fn radiance(&self, ray: &Ray, d: f64) -> DVec3 {
        let Some(hit) = self.meet(ray) else { return self.heaven(ray.direction, d) };
        let point = ray.at(hit.distance);
        let lit = hit.normal.dot(self.to_sun).max(0.0);
        let in_sun =
            lit > 0.0 && self.meet(&Ray { origin: point + hit.normal * 1e-3, direction: self.to_sun }).is_none();
        let sky = 0.16 + 0.14 * (0.5 + 0.5 * hit.normal.y);
        let shade = hit.tone * (sky + if in_sun { 0.92 * lit } else { 0.0 });
        let color = match hit.material {
            Material::Marble => &self.marble,
            Material::Brick => &self.brick,
            Material::Grass => &self.grass,
        };
        let haze = 1.0 - (-hit.distance / 120.0).exp();
        (color.at(d) * shade).lerp(self.cloud.at(d) * 0.55, haze)
    }

    fn heaven(&self, direction: DVec3, d: f64) -> DVec3 {
        let up = direction.y.max(0.0);
        let at = DVec2::new(direction.x, direction.z) / (up + 0.15);
        let cloud = step(0.50, 0.78, fractal(at * 0.9 + 2.3, 5, 500));
        let horizon = (1.0 - up).powi(6);
        let sky = self.sky.at(d) * (1.0 + 0.6 * horizon);
        sky.lerp(self.cloud.at(d) * (0.75 + 0.25 * smooth(at * 3.0, 501)), (0.9 * cloud + 0.5 * horizon).min(1.0))
    }
}

/// The numbers of the columns that a ray may meet: those along which it lies between two x and two y.
fn candidates(ray: &Ray, x: [f64; 2], y: [f64; 2]) -> std::ops::RangeInclusive<i32> {
    let span = |from: f64, to: f64, origin: f64, direction: f64| {
        let (a, b) = ((from - origin) / direction, (to - origin) / direction);
        if a.is_nan() || b.is_nan() { [0.0, FAR] } else { [a.min(b), a.max(b)] }
    };
    let along_x = span(x[0], x[1], ray.origin.x, ray.direction.x);
    let along_y = span(y[0], y[1], ray.origin.y, ray.direction.y);
    let (from, to) = (along_x[0].max(along_y[0]).max(0.0), along_x[1].min(along_y[1]).min(FAR));
    if from > to {
        #[expect(clippy::reversed_empty_ranges, reason = "no column")]
        return 1..=0;
    }
    let (a, b) = (ray.at(from).z / APART, ray.at(to).z / APART);
    (a.min(b) - 0.7).round() as i32..=(a.max(b) + 0.7).round() as i32
}

fn floor(point: DVec3, distance: f64) -> Hit {
    let hit = |material: Material, tone: f64| Hit { distance, normal: DVec3::Y, material, tone };
    if point.x.abs() > ROW + 1.1 {
        let fine = step(60.0, 10.0, distance);
        let blades = fractal(DVec2::new(point.x, point.z) * 7.0, 3, 502) * fine + 0.5 * (1.0 - fine);
        return hit(Material::Grass, 0.7 + 0.6 * blades);
    }
    let tile = DVec2::new(point.x + 0.5, point.z) / 1.0;
    let (cell, within) = (tile.floor(), (tile - tile.floor() - 0.5).abs());
    let joint = if within.max_element() > 0.485 && distance < 30.0 { 0.55 } else { 1.0 };
    let tone = joint * (0.88 + 0.2 * fractal(DVec2::new(point.x, point.z) * 2.6, 3, 503));
    let is_even = (cell.x + cell.y).rem_euclid(2.0) < 0.5;
    if is_even { hit(Material::Marble, 0.92 * tone) } else { hit(Material::Brick, tone) }
}

/// A column with flutes.
fn column(ray: &Ray, center: DVec2) -> Option<Hit> {
    let distance = ray.cylinder(center, RADIUS)?[0];
    let point = ray.at(distance);
    if distance <= 0.0 || !(0.0..HEIGHT).contains(&point.y) {
        return None;
    }
    let out = (DVec2::new(point.x, point.z) - center) / RADIUS;
    let turn = out.y.atan2(out.x);
    let flute = (turn * 20.0).cos();
    let fine = step(26.0, 8.0, distance);
    let across = DVec2::new(-out.y, out.x) * (0.42 * fine * (turn * 20.0).sin());
    let normal = DVec3::new(out.x + across.x, 0.0, out.y + across.y).normalize();
    Some(Hit { distance, normal, material: Material::Marble, tone: 1.0 - 0.16 * fine * (0.5 - 0.5 * flute) })
}

/// A block of marble.
fn block(ray: &Ray, low: DVec3, high: DVec3) -> Option<Hit> {
    let (distance, normal) = ray.block(low, high)?;
    Some(Hit { distance, normal, material: Material::Marble, tone: 0.96 })
}

impl ImagePlane for Colonnade {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let sight = self.camera.ray(at);
        let forward = DVec3::NEG_Z;
        let d = doppler_factor(self.effects.speed, sight.direction.dot(forward));
        let direction = if self.effects.aberration {
            aberrated(sight.direction, forward, self.effects.speed)
        } else {
            sight.direction
        };
        self.radiance(&Ray { origin: EYE, direction }, d)
    }
}
