//! The picture of a body that passes: a row of dice on a road.

use super::lorentz::{Effects, ShiftedColors, doppler_factor, gamma};
use crate::camera::{Pinhole, Ray};
use crate::noise::{fractal, smooth, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_trace::Sampler;

/// The camera and a row of dice that move along x.
pub struct Dice {
    camera: Pinhole,
    effects: Effects,
    /// The place of the middle die at the moment at which the picture is taken, m.
    place: f64,
    body: ShiftedColors,
    pips: ShiftedColors,
}

/// Half a die's side, and the distance of two of them, m.
const HALF: f64 = 0.85;
const APART: f64 = 2.6;
/// Dice to either side of the middle one.
const ROW: i32 = 2;
/// The road's distance.
const AWAY: f64 = 7.6;
const EYE: DVec3 = DVec3::new(0.0, 2.3, 0.0);
/// The lamps move with the dice.
const TO_LAMP: DVec3 = DVec3::new(-0.30, 0.72, 0.62);

impl Dice {
    /// `seen_at`: where the middle die is seen, m.
    pub fn new(effects: &Effects, seen_at: f64) -> Self {
        // Its light has been on the way.
        let late = if effects.aberration { effects.speed * DVec2::new(seen_at, AWAY).length() } else { 0.0 };
        let colors = |radiance: fn(f64) -> f64| ShiftedColors::new(effects, radiance);
        Self {
            camera: Pinhole::new(EYE, DVec3::new(0.0, 0.82, -AWAY), 48.0),
            effects: *effects,
            place: seen_at + late,
            // A green that is one band of wavelengths: its shift is a change of hue.
            body: colors(|lambda| 0.04 + 0.75 * (-0.5 * ((lambda - 540.0) / 32.0).powi(2)).exp()),
            pips: colors(|_| 0.93),
        }
    }

    /// A ray in the frame of the dice, where they are at rest. Its direction is a unit of the camera's frame.
    fn in_frame(&self, direction: DVec3) -> Ray {
        let gamma = gamma(self.effects.speed);
        let origin = DVec3::new(gamma * (EYE.x - self.place), EYE.y, EYE.z);
        // Light that arrives now left a place at distance s at the time -s; without that, everything is seen as it is now.
        let drift = if self.effects.aberration { self.effects.speed } else { 0.0 };
        Ray { origin, direction: DVec3::new(gamma * (direction.x + drift), direction.y, direction.z) }
    }
}

/// Whether a place on a face, from -1 to 1, lies on a pip, from 0 (no) to 1.
fn pip(at: DVec2, count: u32) -> f64 {
    const PLACES: [&[(f64, f64)]; 6] = [
        &[(0.0, 0.0)],
        &[(-0.5, -0.5), (0.5, 0.5)],
        &[(-0.5, -0.5), (0.0, 0.0), (0.5, 0.5)],
        &[(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)],
        &[(-0.5, -0.5), (-0.5, 0.5), (0.0, 0.0), (0.5, -0.5), (0.5, 0.5)],
        &[(-0.5, -0.55), (-0.5, 0.0), (-0.5, 0.55), (0.5, -0.55), (0.5, 0.0), (0.5, 0.55)],
    ];
    let nearest = PLACES[count as usize - 1].iter().map(|(x, y)| (at - DVec2::new(*x, *y)).length());
    step(0.19, 0.17, nearest.fold(f64::INFINITY, f64::min))
}

/// The pips of a face: opposite ones sum to 7, and the back, which only a fast die shows, has 6.
fn face_count(normal: DVec3) -> u32 {
    match (normal.x > 0.5, normal.x < -0.5, normal.y > 0.5, normal.z > 0.5) {
        (true, ..) => 1,
        (_, true, ..) => 6,
        (_, _, true, _) => 5,
        (.., true) => 3,
        _ => 4,
    }
}

impl ImagePlane for Dice {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let inside = self.in_frame(ray.direction);
        let middle = |index: i32| DVec3::new(APART * f64::from(index), HALF, -AWAY);
        let hits = (-ROW..=ROW).filter_map(|index| {
            inside.block(middle(index) - HALF, middle(index) + HALF).map(|(t, normal)| (t, normal, index))
        });
        if let Some((distance, normal, index)) = hits.min_by(|a, b| a.0.total_cmp(&b.0)) {
            let point = (inside.at(distance) - middle(index)) / HALF;
            let face = if normal.x != 0.0 {
                DVec2::new(point.z, point.y)
            } else if normal.y != 0.0 {
                DVec2::new(point.x, point.z)
            } else {
                DVec2::new(point.x, point.y)
            };
            let d = doppler_factor(self.effects.speed, -ray.direction.x);
            let lamp = TO_LAMP.normalize();
            let bevel = step(1.0, 0.93, face.abs().max_element());
            // Darker near the road.
            let ground = 0.62 + 0.38 * step(-1.0, 0.2, point.y);
            let shade = (0.34 + 0.78 * normal.dot(lamp).max(0.0))
                * (0.80 + 0.20 * bevel)
                * if normal.y > 0.5 { 1.0 } else { ground };
            return self.body.at(d).lerp(self.pips.at(d), pip(face, face_count(normal))) * shade;
        }
        self.surroundings(ray.direction)
    }
}

impl Dice {
    /// The road and what stands beside it, at rest.
    fn surroundings(&self, direction: DVec3) -> DVec3 {
        let dusk = DVec3::new(0.05, 0.075, 0.14).lerp(DVec3::new(0.34, 0.26, 0.26), step(0.34, -0.02, direction.y));
        // Hills far away.
        let x = direction.x / -direction.z;
        let hill = 0.012 + 0.075 * fractal(DVec2::new(x * 2.6 + 5.0, 0.0), 4, 400);
        let dusk = dusk.lerp(DVec3::new(0.050, 0.060, 0.090), step(hill + 0.004, hill - 0.004, direction.y));
        if direction.y >= 0.0 {
            return dusk;
        }
        let distance = EYE.y / -direction.y;
        let point = EYE + direction * distance;
        let (x, z) = (point.x, point.z + AWAY);
        let fade = (-distance / 70.0).exp();
        let fine = step(45.0, 12.0, distance);
        let grain = 0.85 + 0.3 * (smooth(DVec2::new(x, z) * 9.0, 401) * fine + 0.5 * (1.0 - fine));
        let is_road = z.abs() < 1.9;
        let mut color = if is_road { DVec3::splat(0.085) } else { DVec3::new(0.090, 0.098, 0.062) } * grain;
        // The road's edges, and a mark every metre, all at rest.
        let edge = step(0.07, 0.05, (z.abs() - 1.75).abs());
        let is_mark =
            (1.9..2.5).contains(&z) && (x - x.round()).abs() < if x.round() % 5.0 == 0.0 { 0.10 } else { 0.04 };
        let mark = if is_mark { 0.9 } else { 0.0 };
        color = color.lerp(DVec3::new(0.62, 0.60, 0.55), (0.8 * edge).max(mark) * fine.max(0.3));
        // The dice's shadow moves with them: the event on the road, in their frame.
        let time = if self.effects.aberration { -distance } else { 0.0 };
        let along = gamma(self.effects.speed) * (x - self.place - self.effects.speed * time);
        let nearest = (along / APART).round().clamp(-f64::from(ROW), f64::from(ROW)) * APART;
        let outside = (DVec2::new((along - nearest).abs(), z.abs()) - HALF).max(DVec2::ZERO).length();
        color *= 1.0 - 0.72 * (-(outside / 0.30)).exp();
        dusk.lerp(color, fade)
    }
}
