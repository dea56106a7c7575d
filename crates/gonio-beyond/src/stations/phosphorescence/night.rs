//! The picture: a bedroom wall with stars, a moon and planets of phosphorescent plastic.

use super::decay::{AQUA, BLUE, GREEN, Phosphor, RED};
use crate::noise::{cell, fractal, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3, IVec2};
use gonio_trace::Sampler;

/// A shape on the wall.
#[derive(Clone, Copy, Debug)]
struct Sticker {
    center: DVec2,
    size: f64,
    turn: f64,
    form: Form,
    /// The index of its light in [`Night::glows`].
    phosphor: usize,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    Star,
    Moon,
    Disc,
    /// An ellipse with a gap, around a disc.
    Ring,
    /// A line that ends in a point.
    Trail,
}

/// The wall at one moment.
pub struct Night {
    stickers: Vec<Sticker>,
    glows: [DVec3; 4],
    is_lit: bool,
}

/// Radiance of a phosphor for one photon per second and trap: the exposure stays the same for the whole film.
const GLOW: f64 = 9.0;
const PHOSPHORS: [Phosphor; 4] = [GREEN, AQUA, BLUE, RED];

impl Night {
    /// The wall at a time after the lamp, which was on for `charge_s`, has gone out.
    pub fn new(time_s: f64, charge_s: f64) -> Self {
        let glows = PHOSPHORS.map(|phosphor| phosphor.color() * (GLOW * phosphor.emitted(time_s, charge_s)));
        Self { stickers: stickers(), glows, is_lit: time_s < 0.0 && time_s >= -charge_s }
    }
}

/// The large shapes, and small stars between them.
fn stickers() -> Vec<Sticker> {
    let new = |x: f64, y: f64, size: f64, turn: f64, form: Form, phosphor: usize| Sticker {
        center: DVec2::new(x, y),
        size,
        turn,
        form,
        phosphor,
    };
    let mut all = vec![
        new(-0.72, 0.36, 0.34, 0.35, Form::Moon, 2),
        new(0.66, -0.28, 0.21, 0.0, Form::Disc, 1),
        new(0.66, -0.28, 0.42, 0.42, Form::Ring, 3),
        new(0.10, 0.52, 0.21, 0.15, Form::Star, 0),
        new(-0.16, -0.42, 0.25, -0.25, Form::Star, 0),
        new(0.98, 0.55, 0.17, 0.4, Form::Star, 0),
        new(-0.90, -0.55, 0.16, 0.1, Form::Star, 1),
        new(0.42, 0.16, 0.12, -0.1, Form::Star, 2),
        new(-0.36, 0.05, 0.10, 0.5, Form::Star, 1),
        new(1.10, 0.02, 0.10, 0.2, Form::Star, 2),
        new(0.28, -0.78, 0.12, 0.6, Form::Star, 1),
        new(-0.30, 0.80, 0.085, 0.0, Form::Star, 3),
        new(-1.12, -0.08, 0.11, 0.8, Form::Star, 3),
        new(1.12, -0.72, 0.12, 0.3, Form::Star, 0),
        new(-0.53, -0.83, 0.09, 0.3, Form::Star, 3),
    ];
    // A shooting star.
    all.push(new(0.62, 0.86, 0.46, 0.42, Form::Trail, 0));
    for index in 0..46 {
        let random = |seed: u32| cell(IVec2::new(index, 9), seed);
        let center = DVec2::new(2.7 * random(1) - 1.35, 2.0 * random(2) - 1.0);
        let size = 0.018 + 0.03 * random(3) * random(3);
        let is_free = |s: &Sticker| (s.center - center).length() > s.size * 1.15 + 0.05;
        if all.iter().all(is_free) {
            all.push(Sticker { center, size, turn: random(4), form: Form::Star, phosphor: (random(5) * 3.0) as usize });
        }
    }
    all
}

impl Sticker {
    /// The distance to its outline, negative inside.
    fn distance(&self, at: DVec2) -> f64 {
        let place = DVec2::from_angle(-self.turn).rotate(at - self.center);
        match self.form {
            Form::Star => star(place / self.size) * self.size,
            Form::Moon => moon(place / self.size) * self.size,
            Form::Disc => place.length() - self.size,
            Form::Ring => {
                let flat = place * DVec2::new(1.0, 3.4);
                let band = (flat.length() - self.size * 0.84).abs() - self.size * 0.13;
                // The planet hides the ring's far half.
                let planet = 0.5 * self.size - place.length();
                if place.y > 0.0 && planet > 0.0 { planet } else { 0.6 * band }
            }
            Form::Trail => {
                let along = (place.x / self.size).clamp(0.0, 1.0);
                DVec2::new(place.x - along * self.size, place.y).length() - 0.020 * (1.0 - along)
            }
        }
    }
}

/// The distance to a crescent: a circle of radius 1 without a smaller one. Negative inside.
fn moon(at: DVec2) -> f64 {
    const AWAY: f64 = 0.54;
    const SMALLER: f64 = 0.84;
    let at = DVec2::new(at.x, at.y.abs());
    // The horn, where both circles meet.
    let x = (1.0 - SMALLER * SMALLER + AWAY * AWAY) / (2.0 * AWAY);
    let horn = DVec2::new(x, (1.0 - x * x).max(0.0).sqrt());
    if at.x * horn.y - at.y * horn.x > AWAY * (horn.y - at.y).max(0.0) {
        return (at - horn).length();
    }
    (at.length() - 1.0).max(SMALLER - (at - DVec2::X * AWAY).length())
}

/// The distance to a star with five points and circumradius 1, negative inside, with slightly rounded points.
fn star(at: DVec2) -> f64 {
    const POINTS: f64 = 5.0;
    let sector = std::f64::consts::PI / POINTS;
    let from_top = at.x.atan2(at.y).rem_euclid(2.0 * sector);
    let folded = DVec2::from_angle(from_top.min(2.0 * sector - from_top)) * at.length();
    // The edge from a point, at angle 0, to the notch.
    let (tip, notch) = (DVec2::X * 0.94, DVec2::from_angle(sector) * 0.44);
    let edge = notch - tip;
    let along = ((folded - tip).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
    let offset = folded - tip - along * edge;
    let side = edge.perp_dot(folded - tip);
    offset.length() * if side > 0.0 { -1.0 } else { 1.0 } - 0.05
}

impl ImagePlane for Night {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let plaster = 0.86 + 0.28 * fractal(at * 24.0, 4, 301) + 0.10 * (fractal(at * 3.0, 3, 302) - 0.5);
        // Night light from a window.
        let mut wall = DVec3::new(0.0045, 0.0068, 0.016) * plaster * (0.5 + 0.6 * step(-1.4, 1.0, at.y - 0.4 * at.x));
        let lamp = 0.95 / (1.0 + 0.9 * (at - DVec2::new(-0.5, 1.25)).length_squared());
        if self.is_lit {
            wall += DVec3::new(0.10, 0.145, 0.25) * (plaster * lamp);
        }
        let mut cover = None;
        for sticker in &self.stickers {
            let reach = sticker.size * 1.1 + 0.45;
            if (at - sticker.center).length_squared() > reach * reach {
                continue;
            }
            let distance = sticker.distance(at);
            let glow = self.glows[sticker.phosphor];
            if distance < 0.0 {
                cover = Some((sticker, distance));
            } else {
                // Its light on the wall, nearly as a band that lies at the wall.
                let near = 0.16 * (-distance / 0.030).exp() + 0.035 * sticker.size * 3.0 * (-distance / 0.11).exp();
                wall += glow * DVec3::new(0.42, 0.58, 0.95) * near * plaster;
                if self.is_lit {
                    wall *= 1.0 - 0.30 * (-(distance / 0.018)).exp();
                }
            }
        }
        let Some((sticker, distance)) = cover else { return wall };
        // Rounded edges of the plastic, thinner there.
        let depth = (-distance / (0.25 * sticker.size).min(0.035)).min(1.0);
        let mut light =
            self.glows[sticker.phosphor] * (0.72 + 0.28 * depth) * (0.96 + 0.08 * fractal(at * 60.0, 2, 303));
        if self.is_lit {
            let edge = 0.80 + 0.20 * depth;
            let body = DVec3::new(0.62, 0.68, 0.52).lerp(self.glows[sticker.phosphor].normalize_or(DVec3::ONE), 0.15);
            light += body * (lamp * edge);
        }
        light
    }
}
